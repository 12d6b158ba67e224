// SPDX-License-Identifier: Apache-2.0
// In place of rtl/lib/ram_1r1w.sv where a stage is placed on a device that has too little block RAM for it: memories of
// 512 words and more have half as many. The paths to and from them stay what they are; what is read is not.
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

  localparam int unsigned Kept = Depth >= 512 ? Depth / 2 : Depth;
  localparam int unsigned Bits = $clog2(Kept);

  (* no_rw_check *)
  logic [Width-1:0] memory [Kept];

  always_ff @(posedge clk_i) begin
    if (write_en_i) memory[write_addr_i[Bits-1:0]] <= write_data_i;
    if (read_en_i) read_data_o <= memory[read_addr_i[Bits-1:0]];
  end

endmodule
