// SPDX-License-Identifier: Apache-2.0
// Walks down the rows of a triangle, one a clock: steps both edges, clips the row to tile and
// scissor and says which blocks it spans. Runs ahead of raster_row, which takes the spans, and
// begins the next triangle on its own.
//
// A span is out four clocks after its row began, that of a listed row three. Rows with nothing to
// draw come too, as empty spans: raster_row has to step over them. The next triangle is taken in
// the clock after the last row of this one; so a triangle of n rows takes n + 1 clocks.
module raster_walk #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  localparam int unsigned XBits = $clog2(TileSize / PixelsPerClock),
  localparam int unsigned RowBits = $clog2(TileSize),
  localparam int unsigned LaneBits = (PixelsPerClock == 1) ? 1 : $clog2(PixelsPerClock)
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  // from raster_load
  input  logic                  valid_i,
  output logic                  take_o,      // the record is copied in this clock
  input  gloss_pkg::edge_line_t left_i,
  input  gloss_pkg::edge_line_t right_i,
  input  gloss_pkg::edge_line_t middle_i,
  input  logic                  covering_i,  // whole rows, no edges
  input  logic                  listed_i,    // rows that are listed, no edges
  input  logic [5:0]            listed_x_i,
  input  logic [15:0]           listed_rows_i, // the first two
  input  logic [7:0]            listed_next_i, // the row after those that are here
  output logic                  listed_step_o, // it is taken
  output logic                  listed_busy_o, // and is still to be
  input  logic [RowBits-1:0]    first_row_i,
  input  logic [RowBits-1:0]    last_row_i,
  input  logic [5:0]            switch_row_i,
  input  logic                  side_i,
  input  gloss_pkg::scissor_rect_t scissor_i,  // stays until the walk is idle

  // to raster_row
  output logic                  span_valid_o,
  input  logic                  span_ready_i,
  output logic                  span_last_o,     // of the triangle
  output logic                  span_empty_o,
  output logic [XBits-1:0]      span_block_o,    // first block
  output logic [XBits-1:0]      span_more_o,     // blocks after it
  output logic [LaneBits-1:0]   span_low_o,      // first lane of the first block
  output logic [LaneBits-1:0]   span_high_o,     // last lane of the last block

  output logic                  idle_o
);

  localparam int unsigned Shift = $clog2(PixelsPerClock);

  logic advance; // every stage moves on

  // ---- 1st stage: row counters, remainders ----
  logic       busy_q, first_q, covering_q, side_q;
  logic       next_switches, switched_q;
  logic [5:0] switch_count_q;
  logic [RowBits-1:0] row_q, rows_left_q;
  logic               listed_q, listed_more_q;  // more than are here
  logic [5:0]         listed_x_q;
  logic [15:0]        listed_rows_q;  // this row, the next one

  gloss_pkg::edge_line_t middle_q;

  logic edge_valid_q, column_valid_q; // the 2nd and 3rd stage hold a row
  logic step_r, step_x;

  // The 2nd stage is part of what is copied, so its row has to move on in the same clock. A listed
  // row does not pass it, and must not meet one there.
  assign take_o = valid_i && !busy_q && (!edge_valid_q || (advance && !listed_i));
  assign step_r = advance && busy_q;
  assign step_x = step_r && !first_q;

  assign next_switches = switch_count_q == 6'd1;

  always_ff @(posedge clk_i) begin
    if (take_o) begin
      middle_q <= middle_i;
      covering_q <= covering_i;
      listed_q <= listed_i;
      listed_x_q <= listed_x_i;
      listed_rows_q <= listed_rows_i;
      side_q <= side_i;
      row_q <= first_row_i;
      rows_left_q <= last_row_i;
      switch_count_q <= switch_row_i;
      first_q <= 1'b1;
    end else if (step_r) begin
      row_q <= row_q + 1'b1;
      rows_left_q <= rows_left_q - 1'b1;
      switch_count_q <= switch_count_q - 1'b1;
      switched_q <= next_switches;
      listed_rows_q <= {listed_next_i, listed_rows_q[15:8]};
      first_q <= 1'b0;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_q <= 1'b0;
      listed_more_q <= 1'b0;
      edge_valid_q <= 1'b0;
    end else begin
      if (take_o) busy_q <= 1'b1;
      else if (step_r && rows_left_q == '0) busy_q <= 1'b0;
      if (take_o) listed_more_q <= listed_i && last_row_i > RowBits'(1);
      else if (step_r && rows_left_q == RowBits'(2)) listed_more_q <= 1'b0;
      if (advance) edge_valid_q <= busy_q && !listed_q;
    end
  end

  assign listed_step_o = step_r && listed_more_q;
  assign listed_busy_o = listed_more_q;

  // ---- 2nd stage: columns, 13 bits ----
  logic signed [12:0] left_x, right_x;
  logic               edge_last_q, edge_inside_q;

  raster_edge u_left (
    .clk_i   (clk_i),
    .idle_i  (!busy_q),
    .take_r_i(take_o || (step_r && next_switches && !side_q)),
    .step_r_i(step_r),
    .take_x_i(take_o || (step_x && switched_q && !side_q)),
    .step_x_i(step_x),
    .line_i  (left_i),
    .middle_i(middle_q),
    .x_o     (left_x)
  );

  raster_edge u_right (
    .clk_i   (clk_i),
    .idle_i  (!busy_q),
    .take_r_i(take_o || (step_r && next_switches && side_q)),
    .step_r_i(step_r),
    .take_x_i(take_o || (step_x && switched_q && side_q)),
    .step_x_i(step_x),
    .line_i  (right_i),
    .middle_i(middle_q),
    .x_o     (right_x)
  );

  // ---- 3rd stage: columns 0 to 127, enough to compare with a scissor ----
  function automatic logic [6:0] column(input logic [12:0] x);
    column = x[12] ? 7'd0 : |x[11:7] ? 7'd127 : x[6:0];
  endfunction

  logic       row_inside;
  logic [6:0] listed_left, listed_right;
  logic       column_last_q, column_inside_q;
  logic [6:0] column_left_q, column_right_q;

  assign row_inside = 7'(row_q) >= scissor_i.y0 && 7'(row_q) < scissor_i.y1;
  assign listed_left = 7'(listed_x_q) + 7'(listed_rows_q[3:0]);
  assign listed_right = 7'(listed_x_q) + 7'(listed_rows_q[7:4]) + 7'd1;

  // ---- 4th stage: clipped ----
  logic       clip_valid_q, clip_last_q, clip_inside_q;
  logic [6:0] clip_low_q, clip_high_q; // low <= x < high

  // ---- the span ----
  logic       empty;
  logic [RowBits-1:0] last_pixel;
  logic [XBits-1:0] first_block, last_block;

  assign empty = !clip_inside_q || clip_low_q >= clip_high_q;
  assign last_pixel = clip_high_q[RowBits-1:0] - 1'b1;
  assign first_block = clip_low_q[Shift +: XBits];
  assign last_block = last_pixel[Shift +: XBits];

  always_ff @(posedge clk_i) begin
    if (advance) begin
      edge_last_q <= rows_left_q == '0;
      edge_inside_q <= row_inside;

      column_last_q <= edge_valid_q ? edge_last_q : rows_left_q == '0;
      column_inside_q <= edge_valid_q ? edge_inside_q : row_inside;
      column_left_q <= !edge_valid_q ? listed_left : covering_q ? 7'd0 : column(left_x);
      column_right_q <= !edge_valid_q ? listed_right : covering_q ? 7'd127 : column(right_x);

      clip_last_q <= column_last_q;
      clip_inside_q <= column_inside_q;
      clip_low_q <= column_left_q > scissor_i.x0 ? column_left_q : scissor_i.x0;
      clip_high_q <= column_right_q < scissor_i.x1 ? column_right_q : scissor_i.x1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      column_valid_q <= 1'b0;
      clip_valid_q <= 1'b0;
    end else if (advance) begin
      column_valid_q <= edge_valid_q || (busy_q && listed_q);
      clip_valid_q <= column_valid_q;
    end
  end

  // A FIFO and not a stream_register: taking a span then moves a pointer and enables no wide
  // register, which is what raster_row has time for.
  stream_fifo #(
    .Width($bits({span_last_o, span_empty_o, span_block_o, span_more_o, span_low_o, span_high_o})),
    .Depth(2)
  ) u_spans (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(clip_valid_q),
    .ready_o(advance),
    .data_i ({clip_last_q, empty, first_block, last_block - first_block, clip_low_q[LaneBits-1:0],
              last_pixel[LaneBits-1:0]}),
    .valid_o(span_valid_o),
    .ready_i(span_ready_i),
    .data_o ({span_last_o, span_empty_o, span_block_o, span_more_o, span_low_o, span_high_o})
  );

  assign idle_o = !busy_q && !edge_valid_q && !column_valid_q && !clip_valid_q && !span_valid_o;

`ifndef SYNTHESIS
  gloss_pkg::scissor_rect_t was_scissor_q;
  logic                     was_idle_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) was_idle_q <= 1'b1;
    else was_idle_q <= idle_o;
  end

  always_ff @(posedge clk_i) begin
    was_scissor_q <= scissor_i;
    if (rst_ni) begin
      scissor_stays: assert (was_idle_q || scissor_i == was_scissor_q);
      no_rows_meet: assert (!(edge_valid_q && busy_q && listed_q));
    end
  end
`endif

endmodule
