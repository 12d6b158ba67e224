// SPDX-License-Identifier: Apache-2.0
// Memory with one read and one write port that infers block RAM: the word at read_addr_i is out one
// clock after read_en_i and stays until the next read. The address that is being written must not
// be read: block RAM gives any word then. The attribute says so to yosys, which else builds a
// bypass of flip-flops around block RAM that has no rule for it; a simulation stops, and one
// without assertions reads a wrong word.
module ram_1r1w #(
  parameter int unsigned Width = 32,
  parameter int unsigned Depth = 256
) (
  input  logic                     clk_i,

  input  logic                     write_en_i,
  input  logic [$clog2(Depth)-1:0] write_addr_i,
  input  logic [Width-1:0]         write_data_i,

  input  logic                     read_en_i,
  input  logic [$clog2(Depth)-1:0] read_addr_i,
  output logic [Width-1:0]         read_data_o
);

  (* no_rw_check *)
  logic [Width-1:0] memory [Depth];
  logic [Width-1:0] word;

`ifdef SYNTHESIS
  assign word = memory[read_addr_i];
`else
  logic clash;
  assign clash = write_en_i && read_en_i && write_addr_i == read_addr_i;
  assign word = clash ? ~memory[read_addr_i] : memory[read_addr_i];

  always_ff @(posedge clk_i) begin
    not_read_while_written: assert (!clash);
  end
`endif

  always_ff @(posedge clk_i) begin
    if (write_en_i) memory[write_addr_i] <= write_data_i;
    if (read_en_i) read_data_o <= word;
  end

endmodule
