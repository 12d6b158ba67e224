// SPDX-License-Identifier: Apache-2.0
// The job's response: how much room is left, what COUNTERS says, and the beats that say it. The
// words of a packet are reserved as it is checked and count only when it is executed. That it was
// is taken into a register first: nobody asks for the sums before the header of the next packet is
// checked.
module command_answer #(
  parameter int unsigned PixelsPerClock = 1
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  input  logic                         start_i,     // of a job: room_i words may be answered
  input  logic [31:0]                  room_i,

  input  logic [15:0]                  words_i,     // a packet asks for this many
  output logic                         short_o,     // more than is left; two clocks after words_i
  input  logic                         reserve_i,
  input  logic                         commit_i,    // the packet is executed,
  input  logic                         cancel_i,    // or it is not
  output logic [31:0]                  used_o,      // by packets executed

  // work of the job
  input  logic                         triangle_i,  // one more executed
  input  logic                         tile_i,      // one more ended
  input  logic [31:0]                  covered_i,
  input  logic [31:0]                  passed_i,

  input  logic                         send_i,      // holds until sent_o
  output logic                         sent_o,
  output logic                         response_valid_o,
  input  logic                         response_ready_i,
  output logic [3:0]                   response_count_o,
  output logic [32*PixelsPerClock-1:0] response_data_o
);

  localparam int unsigned Words = gloss_pkg::CounterWords;
  localparam int unsigned Count = PixelsPerClock < Words ? PixelsPerClock : Words;

  logic [31:0] room_q, used_q, triangles_q, tiles_q;
  logic [16:0] reserved_q, requested_q; // a tile's colour and depth, or 65535 words read
  logic        short_q, commit_q, cancel_q, triangle_q, tile_q;
  gloss_pkg::work_counters_t work;

  assign short_o = short_q;
  assign used_o = used_q;

  always_ff @(posedge clk_i) begin
    requested_q <= reserved_q + {1'b0, words_i};
    short_q <= {15'b0, requested_q} > room_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      room_q <= '0;
      used_q <= '0;
      reserved_q <= '0;
      triangles_q <= '0;
      tiles_q <= '0;
      {commit_q, cancel_q, triangle_q, tile_q} <= '0;
    end else if (start_i) begin
      room_q <= room_i;
      used_q <= '0;
      reserved_q <= '0;
      triangles_q <= '0;
      tiles_q <= '0;
    end else begin
      {commit_q, cancel_q, triangle_q, tile_q} <= {commit_i, cancel_i, triangle_i, tile_i};
      if (reserve_i) reserved_q <= requested_q;
      if (commit_q) begin
        room_q <= room_q - {15'b0, reserved_q};
        used_q <= used_q + {15'b0, reserved_q};
      end
      if (commit_q || cancel_q) reserved_q <= '0;
      if (triangle_q) triangles_q <= triangles_q + 1'b1;
      if (tile_q) tiles_q <= tiles_q + 1'b1;
    end
  end

  assign work = {tiles_q, passed_i, covered_i, triangles_q};
  assign response_valid_o = send_i;
  assign response_count_o = 4'(Count);

  if (Count == Words) begin : gen_one_beat
    assign response_data_o = (32*PixelsPerClock)'(work);
    assign sent_o = response_ready_i;
  end else begin : gen_beats
    localparam int unsigned Bits = $clog2(Words / Count);

    logic [Bits-1:0] beat_q;

    assign response_data_o = work[32*Count*beat_q +: 32*Count];
    assign sent_o = response_ready_i && &beat_q;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) beat_q <= '0;
      else if (send_i && response_ready_i) beat_q <= beat_q + 1'b1;
    end
  end

endmodule
