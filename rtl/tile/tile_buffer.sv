// SPDX-License-Identifier: Apache-2.0
// One bank: a tile's colour and depth in block RAM, a row of K pixels to a word, with one read and
// one write port, and what its readers must know of the tile. A bank goes round between three
// stages: tile_load prepares it, fragment draws in it (drawn_o), tile_store reads it (stored_o)
// while tile_load may already write behind it.
//
// Each row of colour and of depth carries the mark it was written with; it belongs to the tile if
// that is mark_o, else it stands for the clear value. Rows come from a register two clocks after
// the read: block RAM's output is late, and its way to a reader is far. A row of a part must not be
// read in the clock it is written; so tile_store, behind which tile_load writes one part while it
// reads the other, reads each by itself.
module tile_buffer #(
  parameter int unsigned Width = 32,
  parameter int unsigned MarkBits = 4,
  parameter int unsigned Rows = 1024,
  localparam int unsigned RowBits = $clog2(Rows)
) (
  input  logic                clk_i,
  input  logic                rst_ni,

  // from tile_load
  input  logic                load_colour_en_i,
  input  logic                load_depth_en_i,
  input  logic [RowBits-1:0]  load_row_i,
  input  logic [Width-1:0]    load_data_i,
  input  logic [MarkBits-1:0] load_colour_mark_i,
  input  logic [MarkBits-1:0] load_depth_mark_i,
  input  logic                load_done_i,  // the bank is drawn from now on, with these:
  input  logic [MarkBits-1:0] load_mark_i,
  input  logic [31:0]         load_colour_i,
  input  logic [31:0]         load_depth_i,

  // from fragment
  input  logic                draw_read_en_i,
  input  logic [RowBits-1:0]  draw_read_row_i,
  input  logic                draw_write_en_i,
  input  logic [RowBits-1:0]  draw_write_row_i,
  input  logic [Width-1:0]    draw_colour_i,
  input  logic [Width-1:0]    draw_depth_i,
  input  logic                draw_done_i,

  // from tile_store
  input  logic                store_colour_en_i,
  input  logic                store_depth_en_i,
  input  logic [RowBits-1:0]  store_read_row_i,
  input  logic                store_done_i,

  output logic                drawn_o,
  output logic                stored_o,
  output logic [MarkBits-1:0] mark_o,
  output logic                mark_last_o,  // it is the last there is
  output logic [31:0]         clear_colour_o,
  output logic [31:0]         clear_depth_o,
  output logic [Width-1:0]    colour_o,
  output logic [Width-1:0]    depth_o,
  output logic [MarkBits-1:0] colour_mark_o,
  output logic [MarkBits-1:0] depth_mark_o
);

  logic drawn_q, stored_q, mark_last_q;
  logic memory_free_q;  // not drawn_q: drives the ways to and from the memories, which are many
  logic [MarkBits-1:0] mark_q;
  logic [31:0] clear_colour_q, clear_depth_q;
  logic [RowBits-1:0] read_row, write_row;
  logic [Width-1:0] colour, depth;
  logic [MarkBits-1:0] colour_mark, depth_mark;

  assign drawn_o = drawn_q;
  assign stored_o = stored_q;
  assign mark_o = mark_q;
  assign mark_last_o = mark_last_q;
  assign clear_colour_o = clear_colour_q;
  assign clear_depth_o = clear_depth_q;

  assign read_row = memory_free_q ? store_read_row_i : draw_read_row_i;
  assign write_row = memory_free_q ? load_row_i : draw_write_row_i;

  ram_1r1w #(
    .Width(MarkBits + Width),
    .Depth(Rows)
  ) u_colour (
    .clk_i       (clk_i),
    .write_en_i  (memory_free_q ? load_colour_en_i : draw_write_en_i),
    .write_addr_i(write_row),
    .write_data_i(memory_free_q ? {load_colour_mark_i, load_data_i} : {mark_q, draw_colour_i}),
    .read_en_i   (store_colour_en_i || draw_read_en_i),
    .read_addr_i (read_row),
    .read_data_o ({colour_mark, colour})
  );

  ram_1r1w #(
    .Width(MarkBits + Width),
    .Depth(Rows)
  ) u_depth (
    .clk_i       (clk_i),
    .write_en_i  (memory_free_q ? load_depth_en_i : draw_write_en_i),
    .write_addr_i(write_row),
    .write_data_i(memory_free_q ? {load_depth_mark_i, load_data_i} : {mark_q, draw_depth_i}),
    .read_en_i   (store_depth_en_i || draw_read_en_i),
    .read_addr_i (read_row),
    .read_data_o ({depth_mark, depth})
  );

  always_ff @(posedge clk_i) begin
    colour_o <= colour;
    depth_o <= depth;
    colour_mark_o <= colour_mark;
    depth_mark_o <= depth_mark;
  end

  always_ff @(posedge clk_i) begin
    if (load_done_i) begin
      clear_colour_q <= load_colour_i;
      clear_depth_q <= load_depth_i;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      drawn_q <= 1'b0;
      memory_free_q <= 1'b1;
      stored_q <= 1'b0;
      // The last one: the rows hold anything, so they are swept before the first tile.
      mark_q <= '1;
      mark_last_q <= 1'b1;
    end else begin
      if (load_done_i) begin
        drawn_q <= 1'b1;
        memory_free_q <= 1'b0;
        mark_q <= load_mark_i;
        mark_last_q <= load_mark_i == '1;
      end else if (draw_done_i) begin
        drawn_q <= 1'b0;
        memory_free_q <= 1'b1;
        stored_q <= 1'b1;
      end else if (store_done_i) begin
        stored_q <= 1'b0;
      end
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      prepared_when_free: assert (!load_done_i || (!drawn_q && !stored_q));
      loaded_when_not_drawn: assert (!(load_colour_en_i || load_depth_en_i) || !drawn_q);
      drawn_when_prepared: assert (!(draw_read_en_i || draw_write_en_i || draw_done_i) || drawn_q);
      stored_when_drawn: assert (!(store_colour_en_i || store_depth_en_i || store_done_i) ||
                                 stored_q);
    end
  end
`endif

endmodule
