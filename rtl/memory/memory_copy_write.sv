// SPDX-License-Identifier: Apache-2.0
// Gathers the words of a write into beats of K words with strobes: a word a clock. The last beat of
// a burst is the one that ends a block of sixteen, as memory_burst cuts them, or the last of the
// write.
module memory_copy_write #(
  parameter int unsigned PixelsPerClock = 1,
  localparam int unsigned Width = 32 * PixelsPerClock
) (
  input  logic                        clk_i,
  input  logic                        rst_ni,

  input  logic                        start_i,
  input  logic [6:0]                  word_i,       // low bits of the first word's address
  input  logic [15:0]                 words_i,
  output logic                        busy_o,

  // words from command
  input  logic                        valid_i,
  output logic                        ready_o,
  input  logic [31:0]                 data_i,

  // beats
  output logic                        valid_o,
  input  logic                        ready_i,
  output logic [Width-1:0]            data_o,
  output logic [4*PixelsPerClock-1:0] strobe_o,
  output logic                        last_o
);

  localparam logic [2:0] LastLane = 3'(PixelsPerClock - 1);

  logic [6:0] word_q;
  logic [15:0] words_q;  // still to come
  logic full_q, last_q;  // the beat is complete
  logic [Width-1:0] data_q;
  logic [PixelsPerClock-1:0] lanes_q;
  logic [2:0] lane;
  logic [3:0] beat;
  logic take, give, final_word;

  assign lane = word_q[2:0] & LastLane;
  assign beat = 4'(word_q >> $clog2(PixelsPerClock));
  assign final_word = words_q == 16'd1;

  assign busy_o = words_q != '0 || full_q;
  assign ready_o = words_q != '0 && (!full_q || give);
  assign valid_o = full_q;
  assign data_o = data_q;
  assign last_o = last_q;
  assign take = valid_i && ready_o;
  assign give = valid_o && ready_i;

  for (genvar l = 0; l < PixelsPerClock; l++) begin : gen_lane
    assign strobe_o[4*l+:4] = {4{lanes_q[l]}};

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) lanes_q[l] <= 1'b0;
      else if (take && lane == l) lanes_q[l] <= 1'b1;
      else if (give) lanes_q[l] <= 1'b0;
    end

    always_ff @(posedge clk_i) begin
      if (take && lane == l) data_q[32*l+:32] <= data_i;
    end
  end

  always_ff @(posedge clk_i) begin
    if (start_i) word_q <= word_i;
    else if (take) word_q <= word_q + 1'b1;
    if (take) last_q <= beat == '1 || final_word;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      words_q <= '0;
      full_q <= 1'b0;
    end else begin
      if (start_i) words_q <= words_i;
      else if (take) words_q <= words_q - 1'b1;
      if (take) full_q <= lane == LastLane || final_word;
      else if (give) full_q <= 1'b0;
    end
  end

endmodule
