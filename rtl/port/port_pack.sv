// SPDX-License-Identifier: Apache-2.0
// Response words, up to K at a time, one after the other into beats of the host's width: a beat a
// clock. When flush_i says that all has come, what is left goes into a last beat.
module port_pack #(
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // core
  input  logic                         valid_i,
  output logic                         ready_o,
  input  logic [3:0]                   count_i,
  input  logic [32*PixelsPerClock-1:0] data_i,

  input  logic                         flush_i,
  output logic                         empty_o,

  output logic                         valid_o,
  input  logic                         ready_i,
  output logic [StreamBits-1:0]        data_o,
  output logic [2:0]                   words_o   // of the beat; 0: all
);

  localparam int unsigned Lanes = StreamBits / 32;

  // What the core gave, and from its low end a part as wide as a beat.
  logic [32*PixelsPerClock-1:0] given_q;
  logic [3:0] left_q, part_words;
  logic part_take, part_ends;

  // The beat that is being filled.
  logic [2:0] fill_q;
  logic [3:0] sum;
  logic full, flush;
  logic [StreamBits-1:0] turned, beat_q;

  assign part_words = left_q < 4'(Lanes) ? left_q : 4'(Lanes);
  assign part_ends = left_q <= 4'(Lanes);
  assign sum = 4'(fill_q) + part_words;
  assign full = sum >= 4'(Lanes);
  assign part_take = left_q != '0 && (!full || ready_i);
  assign ready_o = left_q == '0 || (part_take && part_ends);

  assign flush = flush_i && left_q == '0 && fill_q != '0;
  assign valid_o = (left_q != '0 && full) || flush;
  assign empty_o = left_q == '0 && fill_q == '0;
  assign words_o = flush ? fill_q : '0;

  // The part's word for lane l is its word l - fill.
  always_comb begin
    turned = '0;
    for (int f = 0; f < Lanes; f++)
      if (fill_q == 3'(f))
        for (int l = 0; l < Lanes; l++)
          turned[32*l +: 32] = given_q[32*((l+Lanes-f)%Lanes) +: 32];
  end

  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    logic kept;
    assign kept = 3'(l) < fill_q;
    assign data_o[32*l +: 32] = kept ? beat_q[32*l +: 32] : turned[32*l +: 32];
    always_ff @(posedge clk_i)
      if (part_take && (full || !kept)) beat_q[32*l +: 32] <= turned[32*l +: 32];
  end

  if (PixelsPerClock > Lanes) begin : gen_parts
    always_ff @(posedge clk_i) begin
      if (ready_o) given_q <= data_i;
      else if (part_take) given_q <= given_q >> StreamBits;
    end
  end else begin : gen_part
    always_ff @(posedge clk_i) if (ready_o) given_q <= data_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q <= '0;
      fill_q <= '0;
    end else begin
      if (ready_o) left_q <= valid_i ? count_i : '0;
      else if (part_take) left_q <= left_q - 4'(Lanes);
      if (part_take) fill_q <= 3'(sum & 4'(Lanes - 1));
      else if (flush && ready_i) fill_q <= '0;
    end
  end

endmodule
