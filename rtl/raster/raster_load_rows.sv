// SPDX-License-Identifier: Apache-2.0
// The rows of a small record. Those of its second word go to raster_walk with the record; the
// others stay here, and walk takes one after the other while it draws.
module raster_load_rows #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                     clk_i,

  // from raster_load
  input  logic                     head_i,      // PART_SMALL
  input  logic                     rows_i,      // PART_SMALL_ROWS; not with step_i
  input  logic [gloss_pkg::PartRows-1:0] row_i,
  input  logic [StreamBits-1:0]    data_i,
  output logic                     take_o,      // the second word is here: pixels_o
  output gloss_pkg::pixels_small_t pixels_o,

  // to raster_walk
  input  logic                     step_i,      // the row after next_row_o
  output logic [5:0]               x_o,
  output logic [15:0]              head_rows_o, // rows 0 and 1
  output logic [7:0]               next_row_o
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned Rows = 16 - gloss_pkg::SmallHeadRows;

  logic [8*Rows-1:0] rows_q;
  logic              unused;

  assign take_o = head_i && row_i[1/Lanes];
  assign pixels_o = data_i[32*(1%Lanes) +: 32];
  assign next_row_o = rows_q[7:0];
  assign unused = ^{data_i, row_i};

  always_ff @(posedge clk_i) begin
    if (take_o) begin
      x_o <= pixels_o.x;
      head_rows_o <= {pixels_o.last_1, pixels_o.first_1, pixels_o.last_0, pixels_o.first_0};
    end
  end

  for (genvar r = 0; r < Rows; r++) begin : gen_row
    localparam int unsigned Word = r / gloss_pkg::SmallWordRows;
    localparam int unsigned Byte = r % gloss_pkg::SmallWordRows;
    localparam int unsigned After = r == Rows - 1 ? r : r + 1;

    always_ff @(posedge clk_i) begin
      if (rows_i && row_i[Word/Lanes])
        rows_q[8*r +: 8] <= data_i[32*(Word%Lanes) + 8*Byte +: 8];
      else if (step_i)
        rows_q[8*r +: 8] <= rows_q[8*After +: 8];
    end
  end

endmodule
