// SPDX-License-Identifier: Apache-2.0
// Reads tiles that are drawn, in stream order, colour before depth, and sends their rows to memory
// or into the response stream, one row of K pixels a clock. A tile waits here until it is drawn and
// its end is known; the bank is given back when its last row has been read.
//
// What is read can not be stopped: a row has its place in the FIFO at the output before it is asked
// for. So nothing leads from the output back to block RAM, which is far and wide. A row is at the
// output six clocks after it was asked for: one to the bank, two in it.
module tile_store #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned MarkBits = 4,
  localparam int unsigned Width = 32 * PixelsPerClock,
  localparam int unsigned RowBits = $clog2(TileSize * TileSize / PixelsPerClock),
  localparam int unsigned UnitBits = $clog2(4 * TileSize),
  localparam int unsigned AddressBits = 32 - UnitBits,
  localparam int unsigned PitchBits = 16 - UnitBits
) (
  input  logic                   clk_i,
  input  logic                   rst_ni,

  // from tile_pending: what becomes of tile tile_o
  output logic [3:0]             tile_o,         // tiles before this one are read
  output logic                   part_depth_o,
  input  logic [3:0]             ended_i,
  input  logic [3:0]             done_i,
  input  logic [1:0]             colour_output_i,
  input  logic [1:0]             depth_output_i,
  input  logic [AddressBits-1:0] part_address_i,
  input  logic [PitchBits-1:0]   part_pitch_i,

  // the bank of tile_o: see there
  input  logic                   bank_stored_i,
  output logic [1:0]             colour_en_o,    // reads row_o, of bank 0, 1
  output logic [1:0]             depth_en_o,
  output logic [RowBits-1:0]     row_o,
  output logic                   bank_done_o,
  input  logic [MarkBits-1:0]    mark_i,
  input  logic [31:0]            clear_colour_i,
  input  logic [31:0]            clear_depth_i,
  input  logic [Width-1:0]       colour_i,
  input  logic [Width-1:0]       depth_i,
  input  logic [MarkBits-1:0]    colour_mark_i,
  input  logic [MarkBits-1:0]    depth_mark_i,

  // to tile_load: rows below free_row_o of the part that is read are free, a clock later; a part
  // that is gone is free wholly
  output logic [RowBits-1:0]     free_row_o,
  output logic                   colour_reads_o,
  output logic                   colour_free_o,
  output logic                   depth_reads_o,
  output logic                   depth_free_o,

  // answers
  output logic                   response_valid_o,
  input  logic                   response_ready_i,
  output logic [Width-1:0]       response_data_o,
  output logic                   row_answered_o,

  // to memory
  output logic                   store_valid_o,
  input  logic                   store_ready_i,
  output logic [31:0]            store_address_o,
  output logic                   store_data_valid_o,
  input  logic                   store_data_ready_i,
  output logic [Width-1:0]       store_data_o,
  output logic                   store_data_last_o
);

  localparam int unsigned Places = 8;  // a row's way to the output and back is seven clocks
  localparam int unsigned PlaceBits = $clog2(Places + 1);
  localparam int unsigned RowBeatsBits = $clog2(TileSize / PixelsPerClock);

  typedef enum logic [1:0] {Wait, Start, Read, Drain} state_e;

  state_e state_d, state_q;
  logic [3:0] tile_q;
  logic depth_q, answer_q;  // the part that is read, and where it goes
  logic part_answer, turns; // where it is to go; that is not where rows are still going
  logic [RowBits-1:0] row_q;
  logic read_en, row_first, row_last, part_last;
  logic [1:0] part_output;

  logic store_valid_q;
  logic [AddressBits-1:0] address_q;
  logic [PitchBits-1:0] pitch_q;

  // The row that is read, then in the RAM's output, then both parts in the bank's register, where
  // marks are compared, then the one that was chosen, then in the FIFO, the clear value if that is
  // what it is.
  logic read_valid_q, read_is_depth_q, read_last_q;
  logic ram_valid_q, ram_is_depth_q, ram_last_q;
  logic word_valid_q, word_is_depth_q, word_last_q;
  logic [31:0] word_clear_q;
  logic part_valid_q, part_last_q, part_fresh_q;
  logic [Width-1:0] part_q;
  logic [31:0] part_clear_q;

  // The FIFO: all its rows are answers, or none is.
  logic [Width:0] rows [Places];
  logic [$clog2(Places)-1:0] head_q, tail_q;
  logic [PlaceBits-1:0] taken_q, taken_d;  // places of it that are taken, and of these
  logic [PlaceBits-1:0] filled_q, filled_d;
  logic room_q, out_answer_q, out_store_q;
  logic out_taken, out_last;
  logic [Width-1:0] out_word;

  assign tile_o = tile_q;
  assign part_depth_o = depth_q;
  assign free_row_o = row_q;
  assign part_output = depth_q ? depth_output_i : colour_output_i;

  assign colour_reads_o = state_q == Read && !depth_q;
  assign depth_reads_o = state_q == Read && depth_q;
  assign colour_free_o = state_q == Drain || (state_q != Wait && depth_q);
  assign depth_free_o = state_q == Drain
      || (state_q != Wait && depth_output_i == gloss_pkg::TILE_OUTPUT_DROP);

  assign part_answer = part_output == gloss_pkg::TILE_OUTPUT_ANSWER;
  assign turns = part_answer != answer_q && taken_q != '0;

  assign row_first = row_q[RowBeatsBits-1:0] == '0;
  assign row_last = row_q[RowBeatsBits-1:0] == '1;
  assign part_last = read_en && row_q == '1;

  always_comb begin
    state_d = state_q;
    read_en = 1'b0;
    bank_done_o = 1'b0;

    unique case (state_q)
      Wait: begin
        if (ended_i != tile_q && bank_stored_i) begin
          state_d = colour_output_i == gloss_pkg::TILE_OUTPUT_DROP
              && depth_output_i == gloss_pkg::TILE_OUTPUT_DROP ? Drain : Start;
        end
      end
      // The last address of the part before is still to be taken, or answers have to wait for what
      // was before them.
      Start: begin
        if (!store_valid_q && !turns && (!part_answer || done_i == tile_q)) state_d = Read;
      end
      // An address is always out before its data, and the data do not wait for the address to be
      // taken.
      Read: begin
        read_en = room_q && (!row_first || answer_q || !store_valid_q);
        if (part_last)
          state_d = !depth_q && depth_output_i != gloss_pkg::TILE_OUTPUT_DROP ? Start : Drain;
      end
      Drain: begin
        bank_done_o = !read_valid_q && !ram_valid_q && !word_valid_q;
        if (bank_done_o) state_d = Wait;
      end
      default: state_d = Wait;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Wait;
      tile_q <= '0;
      row_q <= '0;
      depth_q <= 1'b0;
    end else begin
      state_q <= state_d;
      if (bank_done_o) tile_q <= tile_q + 1'b1;
      if (read_en) row_q <= row_q + 1'b1;
      if (state_q == Wait) depth_q <= colour_output_i == gloss_pkg::TILE_OUTPUT_DROP;
      else if (part_last) depth_q <= 1'b1;
    end
  end

  // Addresses.
  assign store_valid_o = store_valid_q;
  assign store_address_o = {address_q, {UnitBits{1'b0}}};

  always_ff @(posedge clk_i) begin
    if (state_q == Start && !store_valid_q) begin
      address_q <= part_address_i;
      pitch_q <= part_pitch_i;
      if (!turns) answer_q <= part_answer;
    end else if (store_valid_q && store_ready_i) begin
      address_q <= address_q + AddressBits'(pitch_q);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) store_valid_q <= 1'b0;
    else if (read_en && row_first && !answer_q) store_valid_q <= 1'b1;
    else if (store_ready_i) store_valid_q <= 1'b0;
  end

  // Rows.
  always_ff @(posedge clk_i) begin
    row_o <= row_q;
    read_is_depth_q <= depth_q;
    read_last_q <= row_last;

    ram_is_depth_q <= read_is_depth_q;
    ram_last_q <= read_last_q;

    word_clear_q <= ram_is_depth_q ? clear_depth_i : clear_colour_i;
    word_is_depth_q <= ram_is_depth_q;
    word_last_q <= ram_last_q;

    part_q <= word_is_depth_q ? depth_i : colour_i;
    part_fresh_q <= (word_is_depth_q ? depth_mark_i : colour_mark_i) == mark_i;
    part_clear_q <= word_clear_q;
    part_last_q <= word_last_q;
    if (part_valid_q)
      rows[head_q] <= {part_last_q, part_fresh_q ? part_q : {PixelsPerClock{part_clear_q}}};
  end

  assign {out_last, out_word} = rows[tail_q];
  assign out_taken = (out_answer_q && response_ready_i) || (out_store_q && store_data_ready_i);
  assign filled_d = filled_q + PlaceBits'(part_valid_q) - PlaceBits'(out_taken);
  assign taken_d = taken_q + PlaceBits'(read_en) - PlaceBits'(out_taken);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      colour_en_o <= '0;
      depth_en_o <= '0;
      read_valid_q <= 1'b0;
      ram_valid_q <= 1'b0;
      word_valid_q <= 1'b0;
      part_valid_q <= 1'b0;
      head_q <= '0;
      tail_q <= '0;
      filled_q <= '0;
      taken_q <= '0;
      room_q <= 1'b1;
      out_answer_q <= 1'b0;
      out_store_q <= 1'b0;
    end else begin
      for (int b = 0; b < 2; b++) begin
        colour_en_o[b] <= read_en && !depth_q && tile_q[0] == 1'(b);
        depth_en_o[b] <= read_en && depth_q && tile_q[0] == 1'(b);
      end
      read_valid_q <= read_en;
      ram_valid_q <= read_valid_q;
      word_valid_q <= ram_valid_q;
      part_valid_q <= word_valid_q;
      if (part_valid_q) head_q <= head_q + 1'b1;
      if (out_taken) tail_q <= tail_q + 1'b1;
      filled_q <= filled_d;
      taken_q <= taken_d;
      room_q <= taken_d != PlaceBits'(Places);
      out_answer_q <= filled_d != '0 && answer_q;
      out_store_q <= filled_d != '0 && !answer_q;
    end
  end

  assign response_valid_o = out_answer_q;
  assign response_data_o = out_word;
  assign row_answered_o = response_valid_o && response_ready_i && out_last;

  assign store_data_valid_o = out_store_q;
  assign store_data_o = out_word;
  assign store_data_last_o = out_last;

`ifndef SYNTHESIS
  logic [7:0] ahead_q;     // rows whose address was out, less those whose last data were taken
  logic       offered_q;   // the address that waits is among them

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ahead_q <= '0;
      offered_q <= 1'b0;
    end else begin
      ahead_q <= ahead_q + 8'(store_valid_o && !offered_q)
          - 8'(store_data_valid_o && store_data_ready_i && store_data_last_o);
      offered_q <= store_valid_o && !store_ready_i;
    end
  end

  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      rows_have_places: assert (filled_q != PlaceBits'(Places) || !part_valid_q);
      address_before_data: assert (!store_data_valid_o || ahead_q != '0 ||
                                   (store_valid_o && !offered_q));
    end
  end
`endif

endmodule
