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

  // to memory: rows of the tile, TileSize / PixelsPerClock beats each; loaded beats are always
  // taken
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

  localparam int unsigned Width = 32 * PixelsPerClock;
  localparam int unsigned Rows = TileSize * TileSize / PixelsPerClock;
  localparam int unsigned UnitBits = $clog2(4 * TileSize);
  localparam int unsigned AddressBits = 32 - UnitBits;
  localparam int unsigned PitchBits = 16 - UnitBits;
  localparam int unsigned FifoBeats = 128;

  // Block RAM has a ninth bit to each byte on most devices: four to a pixel. Eight are enough, a
  // sweep of the marks after 255 tiles of a bank is lost among them; with four, one after 15, it
  // still mostly runs behind the storer.
  localparam int unsigned MarkBits = PixelsPerClock == 1 ? 4 : 8;

  // tiles by number, modulo 16: begun, ended by command, read by tile_store, done
  logic [3:0] begun, ended, read, done;

  // tile_pending
  logic part_depth, hazard_depth;
  logic [1:0] hazard_tile, hazard_output, colour_output, depth_output;
  logic [AddressBits-1:0] part_address, hazard_address;
  logic [PitchBits-1:0] part_pitch, hazard_pitch;
  logic row_answered;

  // tile_hazard, tile_fetch
  logic begin_valid, begin_ready;
  gloss_pkg::tile_begin_op_t begin_op;
  logic [3:0] begin_after;
  logic plan_valid, plan_ready, plan_colour_load, plan_depth_load;
  logic [31:0] plan_colour, plan_depth;
  logic beat_taken;

  // tile_load
  logic load_bank, load_colour_en, load_depth_en, load_done;
  logic [RowBits-1:0] load_row;
  logic [Width-1:0] load_data;
  logic [MarkBits-1:0] load_colour_mark, load_depth_mark, load_mark;
  logic [31:0] load_colour, load_depth;

  // tile_store
  logic [1:0] store_colour_en, store_depth_en;
  logic store_done, store_bank;
  logic [RowBits-1:0] store_row, store_free_row;
  logic colour_reads, colour_free, depth_reads, depth_free;

  // the banks
  logic [1:0] drawn, stored, mark_last;
  logic [2*MarkBits-1:0] mark, colour_mark, depth_mark;
  logic [63:0] clear_colour, clear_depth;
  logic [2*Width-1:0] colour, depth;

  // tile_write
  logic draw_read_en, draw_write_en, draw_write_bank, forward;
  logic [RowBits-1:0] draw_write_row;
  logic [Width-1:0] draw_colour, draw_depth, forward_colour, forward_depth;

  assign tile_idle_o = begun == done;
  assign store_bank = read[0];
  assign response_count_o = 4'(PixelsPerClock);

  tile_gate #(
    .StreamBits(StreamBits)
  ) u_gate (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .render_valid_i(render_valid_i),
    .render_ready_o(render_ready_o),
    .render_op_i   (render_op_i),
    .render_data_i (render_data_i),
    .raster_valid_o(raster_valid_o),
    .raster_ready_i(raster_ready_i),
    .raster_op_o   (raster_op_o),
    .raster_data_o (raster_data_o),
    .raster_bank_o (raster_bank_o),
    .bank_ready_i  (load_done),
    .stall_o       (stall_tile_o)
  );

  tile_pending #(
    .TileSize(TileSize)
  ) u_pending (
    .clk_i                (clk_i),
    .rst_ni               (rst_ni),
    .tile_end_valid_i     (tile_end_valid_i),
    .tile_end_ready_o     (tile_end_ready_o),
    .tile_end_i           (tile_end_i),
    .ended_o              (ended),
    .done_o               (done),
    .store_tile_i         (read[1:0]),
    .store_depth_i        (part_depth),
    .store_colour_output_o(colour_output),
    .store_depth_output_o (depth_output),
    .store_address_o      (part_address),
    .store_pitch_o        (part_pitch),
    .hazard_tile_i        (hazard_tile),
    .hazard_depth_i       (hazard_depth),
    .hazard_output_o      (hazard_output),
    .hazard_address_o     (hazard_address),
    .hazard_pitch_o       (hazard_pitch),
    .read_i               (read),
    .row_stored_i         (store_done_i),
    .row_answered_i       (row_answered)
  );

  tile_hazard #(
    .TileSize(TileSize)
  ) u_hazard (
    .clk_i             (clk_i),
    .rst_ni            (rst_ni),
    .tile_begin_valid_i(tile_begin_valid_i),
    .tile_begin_ready_o(tile_begin_ready_o),
    .tile_begin_i      (tile_begin_i),
    .begun_o           (begun),
    .ended_i           (ended),
    .done_i            (done),
    .store_tile_o      (hazard_tile),
    .store_depth_o     (hazard_depth),
    .store_output_i    (hazard_output),
    .store_address_i   (hazard_address),
    .store_pitch_i     (hazard_pitch),
    .begin_valid_o     (begin_valid),
    .begin_ready_i     (begin_ready),
    .begin_o           (begin_op),
    .begin_after_o     (begin_after)
  );

  tile_fetch #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .FifoBeats     (FifoBeats)
  ) u_fetch (
    .clk_i             (clk_i),
    .rst_ni            (rst_ni),
    .begin_valid_i     (begin_valid),
    .begin_ready_o     (begin_ready),
    .begin_i           (begin_op),
    .begin_after_i     (begin_after),
    .done_i            (done),
    .plan_valid_o      (plan_valid),
    .plan_ready_i      (plan_ready),
    .plan_colour_load_o(plan_colour_load),
    .plan_depth_load_o (plan_depth_load),
    .plan_colour_o     (plan_colour),
    .plan_depth_o      (plan_depth),
    .beat_taken_i      (beat_taken),
    .load_valid_o      (load_valid_o),
    .load_ready_i      (load_ready_i),
    .load_address_o    (load_address_o)
  );

  tile_load #(
    .Width    (Width),
    .MarkBits (MarkBits),
    .Rows     (Rows),
    .FifoBeats(FifoBeats)
  ) u_load (
    .clk_i               (clk_i),
    .rst_ni              (rst_ni),
    .plan_valid_i        (plan_valid),
    .plan_ready_o        (plan_ready),
    .plan_colour_load_i  (plan_colour_load),
    .plan_depth_load_i   (plan_depth_load),
    .plan_colour_i       (plan_colour),
    .plan_depth_i        (plan_depth),
    .beat_taken_o        (beat_taken),
    .load_data_valid_i   (load_data_valid_i),
    .load_data_i         (load_data_i),
    .bank_o              (load_bank),
    .bank_drawn_i        (drawn[load_bank]),
    .bank_stored_i       (stored[load_bank]),
    .bank_mark_i         (mark[load_bank*MarkBits+:MarkBits]),
    .bank_mark_last_i    (mark_last[load_bank]),
    .colour_en_o         (load_colour_en),
    .depth_en_o          (load_depth_en),
    .row_o               (load_row),
    .data_o              (load_data),
    .colour_mark_o       (load_colour_mark),
    .depth_mark_o        (load_depth_mark),
    .done_o              (load_done),
    .mark_o              (load_mark),
    .colour_o            (load_colour),
    .depth_o             (load_depth),
    .store_bank_i        (store_bank),
    .store_colour_reads_i(colour_reads),
    .store_colour_free_i (colour_free),
    .store_depth_reads_i (depth_reads),
    .store_depth_free_i  (depth_free),
    .store_row_i         (store_free_row)
  );

  tile_write #(
    .Width  (Width),
    .RowBits(RowBits)
  ) u_write (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .read_en_i       (read_en_i),
    .read_bank_i     (read_bank_i),
    .read_row_i      (read_row_i),
    .write_en_i      (write_en_i),
    .write_bank_i    (write_bank_i),
    .write_row_i     (write_row_i),
    .write_colour_i  (write_colour_i),
    .write_depth_i   (write_depth_i),
    .read_en_o       (draw_read_en),
    .write_en_o      (draw_write_en),
    .write_bank_o    (draw_write_bank),
    .write_row_o     (draw_write_row),
    .write_colour_o  (draw_colour),
    .write_depth_o   (draw_depth),
    .forward_o       (forward),
    .forward_colour_o(forward_colour),
    .forward_depth_o (forward_depth)
  );

  for (genvar b = 0; b < 2; b++) begin : gen_bank
    tile_buffer #(
      .Width   (Width),
      .MarkBits(MarkBits),
      .Rows    (Rows)
    ) u_buffer (
      .clk_i             (clk_i),
      .rst_ni            (rst_ni),
      .load_colour_en_i  (load_colour_en && load_bank == b),
      .load_depth_en_i   (load_depth_en && load_bank == b),
      .load_row_i        (load_row),
      .load_data_i       (load_data),
      .load_colour_mark_i(load_colour_mark),
      .load_depth_mark_i (load_depth_mark),
      .load_done_i       (load_done && load_bank == b),
      .load_mark_i       (load_mark),
      .load_colour_i     (load_colour),
      .load_depth_i      (load_depth),
      .draw_read_en_i    (draw_read_en && read_bank_i == b),
      .draw_read_row_i   (read_row_i),
      .draw_write_en_i   (draw_write_en && draw_write_bank == b),
      .draw_write_row_i  (draw_write_row),
      .draw_colour_i     (draw_colour),
      .draw_depth_i      (draw_depth),
      .draw_done_i       (end_i && end_bank_i == b),
      .store_colour_en_i (store_colour_en[b]),
      .store_depth_en_i  (store_depth_en[b]),
      .store_read_row_i  (store_row),
      .store_done_i      (store_done && store_bank == b),
      .drawn_o           (drawn[b]),
      .stored_o          (stored[b]),
      .mark_o            (mark[b*MarkBits+:MarkBits]),
      .mark_last_o       (mark_last[b]),
      .clear_colour_o    (clear_colour[b*32+:32]),
      .clear_depth_o     (clear_depth[b*32+:32]),
      .colour_o          (colour[b*Width+:Width]),
      .depth_o           (depth[b*Width+:Width]),
      .colour_mark_o     (colour_mark[b*MarkBits+:MarkBits]),
      .depth_mark_o      (depth_mark[b*MarkBits+:MarkBits])
    );
  end

  tile_row #(
    .Width   (Width),
    .MarkBits(MarkBits)
  ) u_row (
    .clk_i           (clk_i),
    .bank_i          (read_bank_i),
    .mark_i          (mark),
    .clear_colour_i  (clear_colour),
    .clear_depth_i   (clear_depth),
    .colour_i        (colour),
    .depth_i         (depth),
    .colour_mark_i   (colour_mark),
    .depth_mark_i    (depth_mark),
    .forward_i       (forward),
    .forward_colour_i(forward_colour),
    .forward_depth_i (forward_depth),
    .clear_colour_o  (clear_colour_o),
    .clear_depth_o   (clear_depth_o),
    .colour_o        (row_colour_o),
    .depth_o         (row_depth_o),
    .colour_fresh_o  (row_colour_fresh_o),
    .depth_fresh_o   (row_depth_fresh_o)
  );

  tile_store #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .MarkBits      (MarkBits)
  ) u_store (
    .clk_i             (clk_i),
    .rst_ni            (rst_ni),
    .tile_o            (read),
    .part_depth_o      (part_depth),
    .ended_i           (ended),
    .done_i            (done),
    .colour_output_i   (colour_output),
    .depth_output_i    (depth_output),
    .part_address_i    (part_address),
    .part_pitch_i      (part_pitch),
    .bank_stored_i     (stored[store_bank]),
    .colour_en_o       (store_colour_en),
    .depth_en_o        (store_depth_en),
    .row_o             (store_row),
    .bank_done_o       (store_done),
    .mark_i            (mark[store_bank*MarkBits+:MarkBits]),
    .clear_colour_i    (clear_colour[store_bank*32+:32]),
    .clear_depth_i     (clear_depth[store_bank*32+:32]),
    .colour_i          (colour[store_bank*Width+:Width]),
    .depth_i           (depth[store_bank*Width+:Width]),
    .colour_mark_i     (colour_mark[store_bank*MarkBits+:MarkBits]),
    .depth_mark_i      (depth_mark[store_bank*MarkBits+:MarkBits]),
    .free_row_o        (store_free_row),
    .colour_reads_o    (colour_reads),
    .colour_free_o     (colour_free),
    .depth_reads_o     (depth_reads),
    .depth_free_o      (depth_free),
    .response_valid_o  (response_valid_o),
    .response_ready_i  (response_ready_i),
    .response_data_o   (response_data_o),
    .row_answered_o    (row_answered),
    .store_valid_o     (store_valid_o),
    .store_ready_i     (store_ready_i),
    .store_address_o   (store_address_o),
    .store_data_valid_o(store_data_valid_o),
    .store_data_ready_i(store_data_ready_i),
    .store_data_o      (store_data_o),
    .store_data_last_o (store_data_last_o)
  );

endmodule
