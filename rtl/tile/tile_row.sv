// SPDX-License-Identifier: Apache-2.0
// Brings a row that fragment reads from either bank to it: clear values one clock after the read,
// the row from a register two clocks after it. Marks are compared behind that register, because
// block RAM's output comes late in its clock. A row that is being written when it would be read
// comes from tile_write instead.
module tile_row #(
  parameter int unsigned Width = 32,
  parameter int unsigned MarkBits = 4
) (
  input  logic                  clk_i,

  input  logic                  bank_i,          // in the clock of the read

  // both banks; rows and their marks one clock after the read
  input  logic [2*MarkBits-1:0] mark_i,
  input  logic [63:0]           clear_colour_i,
  input  logic [63:0]           clear_depth_i,
  input  logic [2*Width-1:0]    colour_i,
  input  logic [2*Width-1:0]    depth_i,
  input  logic [2*MarkBits-1:0] colour_mark_i,
  input  logic [2*MarkBits-1:0] depth_mark_i,

  // from tile_write, one clock after the read
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

  logic bank_q, forward_q;
  logic [MarkBits-1:0] mark_q, colour_mark_q, depth_mark_q;

  always_ff @(posedge clk_i) begin
    bank_q <= bank_i;
    clear_colour_o <= clear_colour_i[bank_i*32+:32];
    clear_depth_o <= clear_depth_i[bank_i*32+:32];

    mark_q <= mark_i[bank_q*MarkBits+:MarkBits];
    colour_mark_q <= colour_mark_i[bank_q*MarkBits+:MarkBits];
    depth_mark_q <= depth_mark_i[bank_q*MarkBits+:MarkBits];
    colour_o <= forward_i ? forward_colour_i : colour_i[bank_q*Width+:Width];
    depth_o <= forward_i ? forward_depth_i : depth_i[bank_q*Width+:Width];
    forward_q <= forward_i;
  end

  assign colour_fresh_o = forward_q || colour_mark_q == mark_q;
  assign depth_fresh_o = forward_q || depth_mark_q == mark_q;

endmodule
