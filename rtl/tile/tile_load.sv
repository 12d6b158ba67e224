// SPDX-License-Identifier: Apache-2.0
// Prepares a bank for the next tile: writes loaded rows, as soon as tile_store has read what was
// there, sweeps the marks when they have run out, and hands the bank to fragment. Banks take turns.
//
// The tiles of a bank are marked 1, 2, ...; after the last mark all rows are given mark 0, which no
// tile has, and the next tile has mark 1 again. That is done beside a load, or else as soon as the
// bank is free: mostly no tile waits for it.
//
// Whether a row is free is found out a clock before, and rows are written a clock after: the way
// from tile_store's counter to the enables of all block RAM would be too long for one.
module tile_load #(
  parameter int unsigned Width = 32,
  parameter int unsigned MarkBits = 4,
  parameter int unsigned Rows = 1024,
  parameter int unsigned FifoBeats = 128,
  localparam int unsigned RowBits = $clog2(Rows)
) (
  input  logic                clk_i,
  input  logic                rst_ni,

  // from tile_fetch
  input  logic                plan_valid_i,
  output logic                plan_ready_o,
  input  logic                plan_colour_load_i,
  input  logic                plan_depth_load_i,
  input  logic [31:0]         plan_colour_i,
  input  logic [31:0]         plan_depth_i,
  output logic                beat_taken_o,

  // from memory
  input  logic                load_data_valid_i,
  input  logic [Width-1:0]    load_data_i,

  // to the bank: all but data and row only for bank_o; a write is there in the clock of done_o at
  // the latest
  output logic                bank_o,
  input  logic                bank_drawn_i,
  input  logic                bank_stored_i,
  input  logic [MarkBits-1:0] bank_mark_i,
  input  logic                bank_mark_last_i,
  output logic                colour_en_o,
  output logic                depth_en_o,
  output logic [RowBits-1:0]  row_o,
  output logic [Width-1:0]    data_o,
  output logic [MarkBits-1:0] colour_mark_o,
  output logic [MarkBits-1:0] depth_mark_o,
  output logic                done_o,
  output logic [MarkBits-1:0] mark_o,
  output logic [31:0]         colour_o,
  output logic [31:0]         depth_o,

  // from tile_store: it is at the tile in store_bank_i; a part of which it reads rows, those below
  // store_row_i are read; a part that is gone is read wholly or not wanted
  input  logic                store_bank_i,
  input  logic                store_colour_reads_i,
  input  logic                store_colour_free_i,
  input  logic                store_depth_reads_i,
  input  logic                store_depth_free_i,
  input  logic [RowBits-1:0]  store_row_i
);

  typedef enum logic [2:0] {Idle, Sweep, Colour, Depth, Done} state_e;

  state_e state_d, state_q;
  logic bank_q, swept_q, depth_load_q;
  logic [RowBits-1:0] row_q;
  logic [31:0] colour_q, depth_q;

  logic take, exhausted, colour_en, depth_en, write, last;
  logic bank_free, behind, colour_free_q, depth_free_q;
  logic fifo_valid, fifo_ready, data_valid;
  logic [Width-1:0] fifo_data, data;

  logic room;  // always: tile_fetch leaves room for all it asks for

  ram_fifo #(
    .Width(Width),
    .Depth(FifoBeats)
  ) u_fifo (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(load_data_valid_i),
    .ready_o(room),
    .data_i (load_data_i),
    .valid_o(fifo_valid),
    .ready_i(fifo_ready),
    .data_o (fifo_data)
  );

  // Whether a beat is taken is known late, and the FIFO's block RAM is far and wide.
  stream_register #(
    .Width(Width)
  ) u_data (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(fifo_valid),
    .ready_o(fifo_ready),
    .data_i (fifo_data),
    .valid_o(data_valid),
    .ready_i(beat_taken_o),
    .data_o (data)
  );

  assign bank_free = !bank_drawn_i && !bank_stored_i;
  // The next row too, which may be the one that is asked for when this is known.
  assign behind = {1'b0, row_q} + 1'b1 < {1'b0, store_row_i};

  // What is free stays so until the bank is handed over.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      colour_free_q <= 1'b0;
      depth_free_q <= 1'b0;
    end else begin
      colour_free_q <= !done_o && (bank_free || (bank_stored_i && store_bank_i == bank_q
          && (store_colour_free_i || (store_colour_reads_i && behind))));
      depth_free_q <= !done_o && (bank_free || (bank_stored_i && store_bank_i == bank_q
          && (store_depth_free_i || (store_depth_reads_i && behind))));
    end
  end

  // Marks have run out, and rows may still have any.
  assign exhausted = bank_mark_last_i && !swept_q;

  assign take = plan_valid_i && plan_ready_o;
  assign plan_ready_o = state_q == Idle && (!exhausted || plan_colour_load_i || plan_depth_load_i);

  assign bank_o = bank_q;
  assign colour_o = colour_q;
  assign depth_o = depth_q;

  assign write = colour_en || depth_en;
  assign last = write && row_q == '1;
  assign beat_taken_o = write && state_q != Sweep;

  always_comb begin
    state_d = state_q;
    colour_en = 1'b0;
    depth_en = 1'b0;
    done_o = 1'b0;

    unique case (state_q)
      Idle: begin
        if (take) state_d = plan_colour_load_i ? Colour : plan_depth_load_i ? Depth : Done;
        else if (exhausted && (plan_valid_i || bank_free)) state_d = Sweep;
      end
      Sweep: begin
        colour_en = colour_free_q && depth_free_q;
        depth_en = colour_en;
        if (last) state_d = Idle;
      end
      // While marks are exhausted, the other part is swept beside the first one that is loaded.
      Colour: begin
        colour_en = data_valid && colour_free_q && (depth_free_q || !exhausted);
        depth_en = colour_en && exhausted;
        if (last) state_d = depth_load_q ? Depth : Done;
      end
      Depth: begin
        depth_en = data_valid && depth_free_q && (colour_free_q || !exhausted);
        colour_en = depth_en && exhausted;
        if (last) state_d = Done;
      end
      Done: begin
        done_o = bank_free;
        if (done_o) state_d = Idle;
      end
      default: state_d = Idle;
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (take) begin
      colour_q <= plan_colour_i;
      depth_q <= plan_depth_i;
      depth_load_q <= plan_depth_load_i;
    end
    // The bank's own stays until done_o, and a tile is not done or loaded so soon after that.
    mark_o <= bank_mark_last_i ? MarkBits'(1) : bank_mark_i + 1'b1;
    row_o <= row_q;
    data_o <= data;
    colour_mark_o <= state_q == Colour ? mark_o : '0;
    depth_mark_o <= state_q == Depth ? mark_o : '0;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
      bank_q <= 1'b0;
      swept_q <= 1'b0;
      row_q <= '0;
      colour_en_o <= 1'b0;
      depth_en_o <= 1'b0;
    end else begin
      state_q <= state_d;
      colour_en_o <= colour_en;
      depth_en_o <= depth_en;
      if (write) row_q <= row_q + 1'b1;
      if (last) swept_q <= 1'b1;
      if (done_o) begin
        bank_q <= !bank_q;
        swept_q <= 1'b0;
      end
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      loaded_beats_have_room: assert (room || !load_data_valid_i);
    end
  end
`endif

endmodule
