// SPDX-License-Identifier: Apache-2.0
// The edge part of a record, from either form. clear_i makes its rows those of a covering triangle.
// A small record has no edges, only rows, and in left.x where its first one begins.
module raster_load_edges #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned StreamBits = 32,
  localparam int unsigned RowBits = $clog2(TileSize)
) (
  input  logic                   clk_i,

  // from raster_load
  input  logic                   clear_i,
  input  logic                   write_i,
  input  logic [gloss_pkg::PartRows-1:0] row_i,
  input  logic [StreamBits-1:0]  data_i,
  input  logic                   compact_i,
  input  logic                   small_i,   // pixels_i; beside clear_i, too
  input  gloss_pkg::pixels_small_t pixels_i,

  // to raster_walk and raster_row
  output gloss_pkg::edge_line_t  left_o,
  output gloss_pkg::edge_line_t  right_o,
  output gloss_pkg::edge_line_t  middle_o,
  output logic [RowBits-1:0]     first_row_o,
  output logic [RowBits-1:0]     last_row_o,
  output logic [5:0]             switch_row_o,
  output logic                   side_o
);

  localparam int unsigned Lanes = StreamBits / 32;

  localparam int unsigned LineBits = $bits(left_o);

  logic [3*LineBits-1:0]       lines;
  logic [6:0]                  listed_left;
  logic                        unused_pixels;
  logic [1:0]                  take_rows; // the word with the rows, that with the switch
  logic [63:0]                 rows_word;

  assign listed_left = 7'(pixels_i.x) + 7'(pixels_i.first_0);
  assign unused_pixels = ^{pixels_i, row_i};

  // Left, right, middle: three words of a wide edge, two of a compact one. What else is in those
  // words is at the same bits in both forms: in the last word of a wide edge, in the second of a
  // compact one.
  for (genvar e = 0; e < 3; e++) begin : gen_edge
    logic [31:0] wide_x, wide_rm, wide_dy, compact_rmd, compact_x;
    logic        take_x, take_rm, take_dy;

    assign wide_x = data_i[32*((3*e)%Lanes) +: 32];
    assign wide_rm = data_i[32*((3*e+1)%Lanes) +: 32];
    assign wide_dy = data_i[32*((3*e+2)%Lanes) +: 32];
    assign compact_rmd = data_i[32*((2*e)%Lanes) +: 32];
    assign compact_x = data_i[32*((2*e+1)%Lanes) +: 32];

    assign take_x = write_i && (compact_i ? row_i[(2*e+1)/Lanes] : row_i[(3*e)/Lanes]);
    assign take_rm = write_i && (compact_i ? row_i[(2*e)/Lanes] : row_i[(3*e+1)/Lanes]);
    assign take_dy = write_i && (compact_i ? row_i[(2*e)/Lanes] : row_i[(3*e+2)/Lanes]);

    // no struct here: yosys does not find the members of one inside a generate block
    logic [12:0] x_q, step_q;
    logic [15:0] r_q, m_q, dy_q;
    logic        unused;
    assign unused = ^{wide_x, wide_dy, compact_rmd, compact_x};

    always_ff @(posedge clk_i) begin
      if (e == 0 && small_i) begin
        x_q <= {6'd0, listed_left};
      end else if (take_x) begin
        x_q <= compact_i ? {{5{compact_x[7]}}, compact_x[7:0]} : wide_x[12:0];
        step_q <= compact_i ? {{5{compact_x[15]}}, compact_x[15:8]} : wide_x[28:16];
      end
      if (take_rm) begin
        r_q <= compact_i ? {6'd0, compact_rmd[9:0]} : wide_rm[15:0];
        m_q <= compact_i ? {6'd0, compact_rmd[19:10]} : wide_rm[31:16];
      end
      if (take_dy) dy_q <= compact_i ? {6'd0, compact_rmd[29:20]} : wide_dy[15:0];
    end

    assign lines[LineBits*e +: LineBits] = {x_q, step_q, r_q, m_q, dy_q};

    if (e < 2) begin : gen_rows
      assign rows_word[32*e +: 32] = compact_i ? compact_x : wide_dy;
      assign take_rows[e] = compact_i ? take_x : take_dy;
    end
  end

  assign {middle_o, right_o, left_o} = lines;

  logic unused_rows;
  assign unused_rows = ^rows_word;

  always_ff @(posedge clk_i) begin
    if (small_i) begin
      first_row_o <= pixels_i.first_row[RowBits-1:0];
      last_row_o <= RowBits'(pixels_i.last_row);
    end else if (clear_i) begin
      first_row_o <= '0;
      last_row_o <= RowBits'(TileSize - 1);
    end else if (take_rows[0]) begin
      first_row_o <= rows_word[16 +: RowBits];
      last_row_o <= rows_word[24 +: RowBits];
    end
    if (take_rows[1]) begin
      switch_row_o <= rows_word[53:48];
      side_o <= rows_word[56];
    end
  end

endmodule
