// SPDX-License-Identifier: Apache-2.0
// Where the clocks of a job went: counted from the clock it is taken to the one its status is
// there, then held. Stalls are counted a clock late, because what stalls is known late in a clock.
module command_clocks (
  input  logic                      clk_i,
  input  logic                      rst_ni,

  input  logic                      start_i,
  input  logic                      end_i,
  input  logic                      stall_stream_i,
  input  logic                      stall_raster_i,
  input  logic                      stall_tile_i,
  input  logic                      stall_memory_i,
  input  logic                      stall_response_i,
  output gloss_pkg::time_counters_t time_o
);

  localparam int unsigned Counters = 6;

  logic                   running_q;
  logic [Counters-2:0]    stall_q;
  logic [Counters-1:0]    count_en; // in the order of time_counters_t
  logic [32*Counters-1:0] count_q;

  assign count_en = {stall_q, 1'b1};
  assign time_o = count_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      running_q <= 1'b0;
      stall_q <= '0;
      count_q <= '0;
    end else if (start_i) begin
      running_q <= 1'b1;
      stall_q <= '0;
      count_q <= '0;
    end else begin
      if (end_i) running_q <= 1'b0;
      stall_q <= {stall_response_i, stall_memory_i, stall_tile_i, stall_raster_i, stall_stream_i};
      for (int c = 0; c < Counters; c++)
        if (running_q && count_en[c]) count_q[32*c +: 32] <= count_q[32*c +: 32] + 1'b1;
    end
  end

endmodule
