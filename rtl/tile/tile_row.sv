// SPDX-License-Identifier: Apache-2.0
// Brings a row that fragment reads from either bank to it: clear values two clocks after the read,
// the row from a register three clocks after it. Marks are compared before that register: behind it
// they would stand in front of the depth test of all lanes. A row that is not yet in its bank when
// it is read comes from tile_write instead.
module tile_row #(
  parameter int unsigned Width = 32,
  parameter int unsigned MarkBits = 4
) (
  input  logic                  clk_i,

  input  logic                  bank_i,          // in the clock of the read

  // both banks; rows and their marks two clocks after the read
  input  logic [2*MarkBits-1:0] mark_i,
  input  logic [63:0]           clear_colour_i,
  input  logic [63:0]           clear_depth_i,
  input  logic [2*Width-1:0]    colour_i,
  input  logic [2*Width-1:0]    depth_i,
  input  logic [2*MarkBits-1:0] colour_mark_i,
  input  logic [2*MarkBits-1:0] depth_mark_i,

  // from tile_write, two clocks after the read
  input  logic                  forward_i,
  input  logic [Width-1:0]      forward_colour_i,
  input  logic [Width-1:0]      forward_depth_i,

  // to fragment
  output logic [31:0]           clear_colour_o,
  output logic [31:0]           clear_depth_o,
  output logic [Width-1:0]      colour_o,
  output logic [Width-1:0]      depth_o,
  output logic                  colour_fresh_o,
  output logic                  depth_fresh_o
);

  logic bank_q, row_bank_q;
  logic [1:0] colour_fresh, depth_fresh;

  // For each bank by itself: choosing one of them first would make it later still.
  for (genvar b = 0; b < 2; b++) begin : gen_bank
    assign colour_fresh[b] = colour_mark_i[b*MarkBits+:MarkBits] == mark_i[b*MarkBits+:MarkBits];
    assign depth_fresh[b] = depth_mark_i[b*MarkBits+:MarkBits] == mark_i[b*MarkBits+:MarkBits];
  end

  always_ff @(posedge clk_i) begin
    bank_q <= bank_i;
    row_bank_q <= bank_q;
    clear_colour_o <= clear_colour_i[bank_q*32+:32];
    clear_depth_o <= clear_depth_i[bank_q*32+:32];

    colour_fresh_o <= forward_i || colour_fresh[row_bank_q];
    depth_fresh_o <= forward_i || depth_fresh[row_bank_q];
    colour_o <= forward_i ? forward_colour_i : colour_i[row_bank_q*Width+:Width];
    depth_o <= forward_i ? forward_depth_i : depth_i[row_bank_q*Width+:Width];
  end

endmodule
