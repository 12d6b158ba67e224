// SPDX-License-Identifier: Apache-2.0
// The alpha plane of a record, or a constant.
module raster_load_alpha #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                  clk_i,

  // from raster_load
  input  logic                  write_i,
  input  logic [gloss_pkg::PartRows-1:0] row_i,
  input  logic [StreamBits-1:0] data_i,
  input  logic                  set_i,      // not with write_i
  input  logic [7:0]            constant_i,

  // to shade
  output logic [31:0]           alpha_o,
  output logic [31:0]           dx_o,
  output logic [31:0]           dy_o
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned Fraction = gloss_pkg::ColourFraction;

  logic unused;
  assign unused = ^{data_i, row_i}; // up to three of its lanes, three of its bits are

  always_ff @(posedge clk_i) begin
    if (set_i) begin
      alpha_o <= 32'(constant_i) << Fraction;
      dx_o <= '0;
      dy_o <= '0;
    end else if (write_i) begin
      if (row_i[0]) alpha_o <= data_i[31:0];
      if (row_i[1/Lanes]) dx_o <= data_i[32*(1%Lanes) +: 32];
      if (row_i[2/Lanes]) dy_o <= data_i[32*(2%Lanes) +: 32];
    end
  end

endmodule
