// SPDX-License-Identifier: Apache-2.0
// Raster and shade: from render ops to blocks of coloured pixels with depth.
//
//   raster_load -> raster_walk -> raster_row -> shade_surface x 3, shade_plane x 2
//   records        spans          blocks        red, green, blue   alpha, depth
//
// Once a block is on its way nothing stops it, so fragment has to take one every clock. A block is
// out Latency clocks after raster_row sent it; a triangle never touches a block twice, and no block
// comes twice within three clocks.
module raster_shade #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32,
  localparam int unsigned XBits = $clog2(TileSize / PixelsPerClock),
  localparam int unsigned YBits = $clog2(TileSize)
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // from tile's gate
  input  logic                         valid_i,
  output logic                         ready_o,
  input  gloss_pkg::render_op_t        op_i,
  input  logic [StreamBits-1:0]        data_i,
  input  logic                         bank_i,

  // to fragment
  output logic                         block_valid_o,
  output logic [XBits-1:0]             block_x_o,
  output logic [YBits-1:0]             block_y_o,
  output logic [PixelsPerClock-1:0]    block_mask_o,
  output logic [32*PixelsPerClock-1:0] block_colour_o,
  output logic [24*PixelsPerClock-1:0] block_depth_o,
  output gloss_pkg::pixel_state_t      block_state_o,
  output logic                         end_o,
  output logic                         end_bank_o,

  output logic                         stall_raster_o,
  output logic                         idle_o
);

  localparam int unsigned LaneBits = (PixelsPerClock == 1) ? 1 : $clog2(PixelsPerClock);
  localparam int unsigned Latency = (PixelsPerClock == 1) ? 5 : 6 + $clog2(PixelsPerClock);

  // ---- records ----
  logic                    walk_valid, walk_take, row_valid, row_take, row_load, row_end;
  logic                    covering, side;
  logic                    listed, listed_step, listed_busy;
  logic [5:0]              listed_x;
  logic [15:0]             listed_rows;
  logic [7:0]              listed_next;
  logic [5:0]              switch_row;
  logic [YBits-1:0]        first_row, last_row;
  logic [2:0]              anchor;
  logic [31:0]             alpha, alpha_dx, alpha_dy;
  gloss_pkg::edge_line_t   left, right, middle;
  gloss_pkg::scissor_rect_t        scissor;
  gloss_pkg::pixel_state_t state;
  gloss_pkg::surface_t     red, green, blue;
  gloss_pkg::depth_plane_t depth;
  logic                    load_idle, walk_idle, row_idle;

  raster_load #(
    .TileSize  (TileSize),
    .StreamBits(StreamBits)
  ) u_load (
    .clk_i        (clk_i),
    .rst_ni       (rst_ni),
    .valid_i      (valid_i),
    .ready_o      (ready_o),
    .op_i         (op_i),
    .data_i       (data_i),
    .bank_i       (bank_i),
    .walk_valid_o (walk_valid),
    .walk_take_i  (walk_take),
    .walk_idle_i  (walk_idle),
    .left_o       (left),
    .right_o      (right),
    .middle_o     (middle),
    .covering_o   (covering),
    .first_row_o  (first_row),
    .last_row_o   (last_row),
    .switch_row_o (switch_row),
    .side_o       (side),
    .listed_o     (listed),
    .listed_x_o   (listed_x),
    .listed_rows_o(listed_rows),
    .listed_next_o(listed_next),
    .listed_step_i(listed_step),
    .listed_busy_i(listed_busy),
    .scissor_o    (scissor),
    .row_valid_o  (row_valid),
    .row_take_i   (row_take),
    .row_load_i   (row_load),
    .end_o        (row_end),
    .anchor_o     (anchor),
    .state_o      (state),
    .red_o        (red),
    .green_o      (green),
    .blue_o       (blue),
    .alpha_o      (alpha),
    .alpha_dx_o   (alpha_dx),
    .alpha_dy_o   (alpha_dy),
    .depth_o      (depth),
    .idle_o       (load_idle)
  );

  assign stall_raster_o = row_valid && !row_take && !row_end;
  assign idle_o = load_idle && walk_idle && row_idle;

  // ---- rows ----
  logic                span_valid, span_ready, span_last, span_empty;
  logic [XBits-1:0]    span_block, span_more;
  logic [LaneBits-1:0] span_low, span_high;

  raster_walk #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock)
  ) u_walk (
    .clk_i        (clk_i),
    .rst_ni       (rst_ni),
    .valid_i      (walk_valid),
    .take_o       (walk_take),
    .left_i       (left),
    .right_i      (right),
    .middle_i     (middle),
    .covering_i   (covering),
    .listed_i     (listed),
    .listed_x_i   (listed_x),
    .listed_rows_i(listed_rows),
    .listed_next_i(listed_next),
    .listed_step_o(listed_step),
    .listed_busy_o(listed_busy),
    .first_row_i  (first_row),
    .last_row_i   (last_row),
    .switch_row_i (switch_row),
    .side_i       (side),
    .scissor_i    (scissor),
    .span_valid_o (span_valid),
    .span_ready_i (span_ready),
    .span_last_o  (span_last),
    .span_empty_o (span_empty),
    .span_block_o (span_block),
    .span_more_o  (span_more),
    .span_low_o   (span_low),
    .span_high_o  (span_high),
    .idle_o       (walk_idle)
  );

  // ---- blocks ----
  gloss_pkg::shade_command_t command;
  logic [5:0]                anchor_x;
  logic [XBits-1:0]          anchor_block;

  assign anchor_x = {anchor, 3'd0};
  assign anchor_block = XBits'(anchor_x >> $clog2(PixelsPerClock));

  raster_row #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .Latency       (Latency)
  ) u_row (
    .clk_i        (clk_i),
    .rst_ni       (rst_ni),
    .valid_i      (row_valid),
    .take_o       (row_take),
    .load_o       (row_load),
    .end_i        (row_end),
    .anchor_i     (anchor_block),
    .first_row_i  (first_row),
    .state_i      (state),
    .span_valid_i (span_valid),
    .span_ready_o (span_ready),
    .span_last_i  (span_last),
    .span_empty_i (span_empty),
    .span_block_i (span_block),
    .span_more_i  (span_more),
    .span_low_i   (span_low),
    .span_high_i  (span_high),
    .command_o    (command),
    .block_valid_o(block_valid_o),
    .block_x_o    (block_x_o),
    .block_y_o    (block_y_o),
    .block_mask_o (block_mask_o),
    .block_state_o(block_state_o),
    .end_o        (end_o),
    .end_bank_o   (end_bank_o),
    .idle_o       (row_idle)
  );

  // ---- pixels ----
  logic [8*PixelsPerClock-1:0] red_level, green_level, blue_level, alpha_level;

  shade_surface #(
    .PixelsPerClock(PixelsPerClock)
  ) u_shade_red (
    .clk_i    (clk_i),
    .command_i(command),
    .surface_i(red),
    .level_o  (red_level)
  );

  shade_surface #(
    .PixelsPerClock(PixelsPerClock)
  ) u_shade_green (
    .clk_i    (clk_i),
    .command_i(command),
    .surface_i(green),
    .level_o  (green_level)
  );

  shade_surface #(
    .PixelsPerClock(PixelsPerClock)
  ) u_shade_blue (
    .clk_i    (clk_i),
    .command_i(command),
    .surface_i(blue),
    .level_o  (blue_level)
  );

  shade_plane #(
    .PixelsPerClock(PixelsPerClock),
    .Width         ($bits(alpha)),
    .Fraction      (gloss_pkg::ColourFraction),
    .LevelBits     (8)
  ) u_shade_alpha (
    .clk_i    (clk_i),
    .command_i(command),
    .origin_i (alpha),
    .dx_i     (alpha_dx),
    .dy_i     (alpha_dy),
    .level_o  (alpha_level)
  );

  shade_plane #(
    .PixelsPerClock(PixelsPerClock),
    .Width         ($bits(depth) / 3),
    .Fraction      (gloss_pkg::DepthFraction),
    .LevelBits     (24)
  ) u_shade_depth (
    .clk_i    (clk_i),
    .command_i(command),
    .origin_i (depth.z),
    .dx_i     (depth.dx),
    .dy_i     (depth.dy),
    .level_o  (block_depth_o)
  );

  for (genvar l = 0; l < PixelsPerClock; l++) begin : gen_colour
    assign block_colour_o[32*l +: 32] = {alpha_level[8*l +: 8], blue_level[8*l +: 8],
                                         green_level[8*l +: 8], red_level[8*l +: 8]};
  end

endmodule
