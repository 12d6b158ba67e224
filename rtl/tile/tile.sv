// SPDX-License-Identifier: Apache-2.0
// The tiles on the chip: two banks, one drawn while the other is stored and loaded.
module tile #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32,
  localparam int unsigned RowBits = $clog2(TileSize * TileSize / PixelsPerClock)
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // from command's render queue
  input  logic                         render_valid_i,
  output logic                         render_ready_o,
  input  gloss_pkg::render_op_t        render_op_i,
  input  logic [StreamBits-1:0]        render_data_i,

  // to raster_shade
  output logic                         raster_valid_o,
  input  logic                         raster_ready_i,
  output gloss_pkg::render_op_t        raster_op_o,
  output logic [StreamBits-1:0]        raster_data_o,
  output logic                         raster_bank_o,

  // from command: a begin is taken when the end before it was
  input  logic                         tile_begin_valid_i,
  output logic                         tile_begin_ready_o,
  input  gloss_pkg::tile_begin_op_t    tile_begin_i,
  input  logic                         tile_end_valid_i,
  output logic                         tile_end_ready_o,
  input  gloss_pkg::tile_end_op_t      tile_end_i,
  output logic                         tile_idle_o,
  output logic                         stall_tile_o,

  // from fragment: see there
  input  logic                         read_en_i,
  input  logic                         read_bank_i,
  input  logic [RowBits-1:0]           read_row_i,
  output logic [31:0]                  clear_colour_o,
  output logic [31:0]                  clear_depth_o,
  output logic [32*PixelsPerClock-1:0] row_colour_o,
  output logic [32*PixelsPerClock-1:0] row_depth_o,
  output logic                         row_colour_fresh_o,
  output logic                         row_depth_fresh_o,
  input  logic                         write_en_i,
  input  logic                         write_bank_i,
  input  logic [RowBits-1:0]           write_row_i,
  input  logic [32*PixelsPerClock-1:0] write_colour_i,
  input  logic [32*PixelsPerClock-1:0] write_depth_i,
  input  logic                         end_i,
  input  logic                         end_bank_i,

  // answers
  output logic                         response_valid_o,
  input  logic                         response_ready_i,
  output logic [3:0]                   response_count_o,
  output logic [32*PixelsPerClock-1:0] response_data_o,

  // to memory: rows of the tile, TileSize / PixelsPerClock beats each; loaded beats are always taken
  output logic                         load_valid_o,
  input  logic                         load_ready_i,
  output logic [31:0]                  load_address_o,
  input  logic                         load_data_valid_i,
  input  logic [32*PixelsPerClock-1:0] load_data_i,
  output logic                         store_valid_o,
  input  logic                         store_ready_i,
  output logic [31:0]                  store_address_o,
  output logic                         store_data_valid_o,
  input  logic                         store_data_ready_i,
  output logic [32*PixelsPerClock-1:0] store_data_o,
  output logic                         store_data_last_o,
  input  logic                         store_done_i  // a row was acknowledged
);

endmodule
