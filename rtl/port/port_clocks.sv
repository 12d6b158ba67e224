// SPDX-License-Identifier: Apache-2.0
// Where the clocks of all jobs since the reset went: the sums of what the core counted for each.
// The upper half of the clocks follows a clock later.
module port_clocks (
  input  logic                      clk_i,
  input  logic                      core_rst_ni,

  input  logic                      done_i,         // a job has ended
  input  gloss_pkg::time_counters_t time_i,
  output gloss_pkg::time_counters_t sums_o,
  output logic [31:0]               clocks_high_o
);

  gloss_pkg::time_counters_t sums_q;
  logic                      carry, carry_q;
  logic [31:0]               clocks, clocks_high_q;

  assign sums_o = sums_q;
  assign clocks_high_o = clocks_high_q;
  assign {carry, clocks} = {1'b0, sums_q.clocks} + {1'b0, time_i.clocks};

  always_ff @(posedge clk_i or negedge core_rst_ni) begin
    if (!core_rst_ni) begin
      carry_q <= 1'b0;
      clocks_high_q <= '0;
      sums_q <= '0;
    end else begin
      carry_q <= done_i && carry;
      clocks_high_q <= clocks_high_q + 32'(carry_q);
      if (done_i) begin
        sums_q.clocks <= clocks;
        sums_q.stall_stream <= sums_q.stall_stream + time_i.stall_stream;
        sums_q.stall_raster <= sums_q.stall_raster + time_i.stall_raster;
        sums_q.stall_tile <= sums_q.stall_tile + time_i.stall_tile;
        sums_q.stall_memory <= sums_q.stall_memory + time_i.stall_memory;
        sums_q.stall_response <= sums_q.stall_response + time_i.stall_response;
      end
    end
  end

endmodule
