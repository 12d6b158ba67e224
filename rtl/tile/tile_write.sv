// SPDX-License-Identifier: Apache-2.0
// Brings the rows that fragment writes to the banks, a clock later: they come at the end of a
// clock, and block RAM is far and wide. A row that is read in the clock it comes here, which is the
// nearest that fragment comes to its own writes, or in the next one, when it is written, is not in
// its bank yet and is handed on from here.
module tile_write #(
  parameter int unsigned Width = 32,
  parameter int unsigned RowBits = 10
) (
  input  logic               clk_i,
  input  logic               rst_ni,

  // from fragment
  input  logic               read_en_i,
  input  logic               read_bank_i,
  input  logic [RowBits-1:0] read_row_i,
  input  logic               write_en_i,
  input  logic               write_bank_i,
  input  logic [RowBits-1:0] write_row_i,
  input  logic [Width-1:0]   write_colour_i,
  input  logic [Width-1:0]   write_depth_i,

  // to the banks
  output logic               read_en_o,
  output logic               write_en_o,
  output logic               write_bank_o,
  output logic [RowBits-1:0] write_row_o,
  output logic [Width-1:0]   write_colour_o,
  output logic [Width-1:0]   write_depth_o,

  // to tile_row: the row that was read two clocks ago
  output logic               forward_o,
  output logic [Width-1:0]   forward_colour_o,
  output logic [Width-1:0]   forward_depth_o
);

  logic meets, meets_q, clash, clash_q;
  logic [Width-1:0] colour_q, depth_q;  // what was written a clock ago

  assign meets = write_en_i && {write_bank_i, write_row_i} == {read_bank_i, read_row_i};
  assign clash = write_en_o && {write_bank_o, write_row_o} == {read_bank_i, read_row_i};
`ifdef SYNTHESIS
  // Block RAM gives any word then, and nobody takes it. The compare would stand in front of the
  // enables of all of it.
  assign read_en_o = read_en_i;
`else
  assign read_en_o = read_en_i && !clash;
`endif

  always_ff @(posedge clk_i) begin
    write_bank_o <= write_bank_i;
    write_row_o <= write_row_i;
    write_colour_o <= write_colour_i;
    write_depth_o <= write_depth_i;

    meets_q <= meets;
    clash_q <= clash;
    colour_q <= write_colour_o;
    depth_q <= write_depth_o;
    forward_o <= meets_q || clash_q;
    forward_colour_o <= meets_q ? write_colour_o : colour_q;
    forward_depth_o <= meets_q ? write_depth_o : depth_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) write_en_o <= 1'b0;
    else write_en_o <= write_en_i;
  end

endmodule
