// SPDX-License-Identifier: Apache-2.0
// Gives the words of a read on: a beat each time, count_o words of it from the lowest. Only the
// first beat may begin with words that were not asked for; it is shifted down, a word a clock.
// A register stands between these words and who takes them, for they are many.
module memory_copy_read #(
  parameter int unsigned PixelsPerClock = 1,
  localparam int unsigned Width = 32 * PixelsPerClock
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  input  logic             start_i,
  input  logic [2:0]       word_i,   // low bits of the first word's address
  input  logic [15:0]      words_i,
  output logic             busy_o,

  // beats from memory
  input  logic             valid_i,
  output logic             ready_o,
  input  logic [Width-1:0] data_i,

  // words
  output logic             valid_o,
  input  logic             ready_i,
  output logic [3:0]       count_o,
  output logic [Width-1:0] data_o
);

  localparam logic [2:0] LastLane = 3'(PixelsPerClock - 1);

  logic [15:0] words_q;  // still to be given
  logic full_q;
  logic [2:0] shift_q;   // words of the first beat that are in the way
  logic [3:0] room_q;    // words of the beat that may be given
  logic [Width-1:0] data_q;
  logic [2:0] first_lane;
  logic [3:0] count;
  logic take, give, whole, out_ready;

  assign first_lane = word_i & LastLane;
  assign busy_o = words_q != '0 || valid_o;
  assign ready_o = !full_q || give;
  assign whole = full_q && shift_q == '0;
  assign count = words_q < 16'(room_q) ? words_q[3:0] : room_q;
  assign take = valid_i && ready_o;
  assign give = whole && out_ready;

  stream_register #(
    .Width(4 + Width)
  ) u_out (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(whole),
    .ready_o(out_ready),
    .data_i ({count, data_q}),
    .valid_o(valid_o),
    .ready_i(ready_i),
    .data_o ({count_o, data_o})
  );

  always_ff @(posedge clk_i) begin
    if (ready_o) data_q <= data_i;
    else if (shift_q != '0) data_q <= Width'({32'd0, data_q} >> 32);

    if (start_i) room_q <= 4'(PixelsPerClock) - 4'(first_lane);
    else if (give) room_q <= 4'(PixelsPerClock);

    if (start_i) shift_q <= first_lane;
    else if (full_q && shift_q != '0) shift_q <= shift_q - 1'b1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      words_q <= '0;
      full_q <= 1'b0;
    end else begin
      if (start_i) words_q <= words_i;
      else if (give) words_q <= words_q - 16'(count);
      full_q <= take || (full_q && !give);
    end
  end

endmodule
