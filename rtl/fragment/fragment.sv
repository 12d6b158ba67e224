// SPDX-License-Identifier: Apache-2.0
// Tests blocks of pixels against the tile's depth and merges them into the tile: K pixels a clock, never stalls.
//
// A block is read in the clock it arrives and written two clocks later, so a block may come again three clocks after
// itself; nothing is forwarded. raster keeps that distance: no block twice in a triangle, two idle clocks between triangles.
module fragment #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  localparam int unsigned XBits = $clog2(TileSize / PixelsPerClock),
  localparam int unsigned YBits = $clog2(TileSize)
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // from raster_shade
  input  logic                         block_valid_i,
  input  logic [XBits-1:0]             block_x_i,
  input  logic [YBits-1:0]             block_y_i,
  input  logic [PixelsPerClock-1:0]    block_mask_i,
  input  logic [32*PixelsPerClock-1:0] block_colour_i,
  input  logic [24*PixelsPerClock-1:0] block_depth_i,
  input  gloss_pkg::pixel_state_t      block_state_i,
  input  logic                         end_i,
  input  logic                         end_bank_i,

  // to tile: the row {y, x} of a bank; its clear values are there one clock after the read, the row two clocks after.
  // A word that is not fresh was not written in this tile: it stands for the clear value.
  output logic                         read_en_o,
  output logic                         read_bank_o,
  output logic [YBits+XBits-1:0]       read_row_o,
  input  logic [31:0]                  clear_colour_i,
  input  logic [31:0]                  clear_depth_i,
  input  logic [32*PixelsPerClock-1:0] row_colour_i,
  input  logic [32*PixelsPerClock-1:0] row_depth_i,
  input  logic                         row_colour_fresh_i,
  input  logic                         row_depth_fresh_i,
  output logic                         write_en_o,
  output logic                         write_bank_o,
  output logic [YBits+XBits-1:0]       write_row_o,
  output logic [32*PixelsPerClock-1:0] write_colour_o,
  output logic [32*PixelsPerClock-1:0] write_depth_o,
  output logic                         end_o,       // the bank's last block is written and counted
  output logic                         end_bank_o,

  // to command
  input  logic                         work_clear_i,
  output logic [31:0]                  covered_o,
  output logic [31:0]                  passed_o
);

endmodule
