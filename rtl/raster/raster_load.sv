// SPDX-License-Identifier: Apache-2.0
// Collects the rows of a triangle's record, whatever form it was sent in, and keeps the state that
// triangles use. When an op with go comes, the record before it is offered to raster_walk and, two
// clocks later, to raster_row: until then shade works at what it needs of the last row. When both
// have copied it, rows of the next one are taken, one a clock, while this one is drawn. The scissor
// is not copied: it changes when the walk is idle.
//
// Shade may read the record in the clocks after row_take_i, and relies on this: depth and colours
// do not change in the two clocks after it. So the next record's header comes a clock after it at
// the earliest, that of a small one with it: what small rows mean is worked out before it is
// written, colours a clock later and depth, which is beside the header, two.
module raster_load #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned StreamBits = 32,
  localparam int unsigned RowBits = $clog2(TileSize)
) (
  input  logic                    clk_i,
  input  logic                    rst_ni,

  // from the gate
  input  logic                    valid_i,
  output logic                    ready_o,
  input  gloss_pkg::render_op_t   op_i,
  input  logic [StreamBits-1:0]   data_i,
  input  logic                    bank_i,

  // to raster_walk
  output logic                    walk_valid_o,
  input  logic                    walk_take_i,
  input  logic                    walk_idle_i,
  output gloss_pkg::edge_line_t   left_o,
  output gloss_pkg::edge_line_t   right_o,
  output gloss_pkg::edge_line_t   middle_o,
  output logic                    covering_o,
  output logic [RowBits-1:0]      first_row_o,
  output logic [RowBits-1:0]      last_row_o,
  output logic [5:0]              switch_row_o,
  output logic                    side_o,
  output logic                    listed_o,   // no edges: rows are listed, from listed_x_o on
  output logic [5:0]              listed_x_o,
  output logic [15:0]             listed_rows_o, // rows 0 and 1
  output logic [7:0]              listed_next_o, // row 2; and with each
  input  logic                    listed_step_i, // of these the next one
  input  logic                    listed_busy_i, // the walk needs them
  output gloss_pkg::scissor_rect_t scissor_o,

  // to raster_row
  output logic                    row_valid_o,
  input  logic                    row_take_i,
  input  logic                    row_load_i, // what it takes is a record
  output logic                    end_o,      // not a record but a tile's end
  output logic [2:0]              anchor_o,   // x / 8
  output gloss_pkg::pixel_state_t state_o,

  // to shade
  output gloss_pkg::surface_t     red_o,
  output gloss_pkg::surface_t     green_o,
  output gloss_pkg::surface_t     blue_o,
  output logic [31:0]             alpha_o,
  output logic [31:0]             alpha_dx_o,
  output logic [31:0]             alpha_dy_o,
  output gloss_pkg::depth_plane_t depth_o,

  output logic                    idle_o
);

  // ---- the op in hand ----
  // It is decoded on its way into registers, so that few gates are left before the many enables.
  logic                  held_q, header_q, set_q, end_q, scissor_held_q;
  logic [6:0]            part_q; // payload, by PART_*
  logic [2:0]            what_q; // STATE_*
  logic [gloss_pkg::PartRows-1:0] row_q;
  logic [StreamBits-1:0] data_q;
  logic                  bank_q;

  logic                  walk_full_q, walk_idle_q, row_full_q, free, open, open_small;
  logic [1:0]            row_fresh_q;  // that raster_row has to wait for, one bit a clock
  logic                  take_header, take_go, take_set, take_end;
  logic [6:0]            take_part;

  // Each waits for no more than it has to, because what is decided here enables all fields of the
  // record. Only a small record's header may come with row_load_i, which is known late.
  assign free = !walk_full_q && !row_full_q;
  assign open = free && !(part_q[gloss_pkg::PART_SMALL_ROWS] && listed_busy_i) &&
                !(scissor_held_q && !walk_idle_q);
  assign open_small = !walk_full_q && (!row_full_q || row_load_i);
  assign ready_o = !held_q || (header_q && is_small ? open_small : open);
  assign idle_o = !held_q && !walk_full_q && !row_full_q;
  assign walk_valid_o = walk_full_q;
  assign row_valid_o = row_full_q && !row_fresh_q[0];

  assign take_header = header_q && (is_small ? open_small : free);
  always_comb begin
    take_part = free ? part_q : '0;
    take_part[gloss_pkg::PART_SMALL] = part_q[gloss_pkg::PART_SMALL] &&
                                       (header_q ? open_small : free);
    take_part[gloss_pkg::PART_SMALL_ROWS] = part_q[gloss_pkg::PART_SMALL_ROWS] && open;
  end
  assign take_go = valid_i && ready_o && op_i.go;
  assign take_set = set_q && open;
  assign take_end = end_q && free;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {held_q, header_q, part_q, set_q, end_q, scissor_held_q} <= '0;
    end else if (ready_o) begin
      held_q <= valid_i;
      header_q <= valid_i && op_i.kind == gloss_pkg::RENDER_HEADER;
      for (int p = 0; p < 7; p++) begin
        part_q[p] <= valid_i && op_i.part == 3'(p) && (op_i.kind == gloss_pkg::RENDER_PAYLOAD ||
                                                       op_i.kind == gloss_pkg::RENDER_HEADER);
      end
      set_q <= valid_i && op_i.kind == gloss_pkg::RENDER_STATE;
      scissor_held_q <= valid_i && op_i.kind == gloss_pkg::RENDER_STATE &&
                        (op_i.part == gloss_pkg::STATE_SCISSOR ||
                         op_i.part == gloss_pkg::STATE_RESET);
      end_q <= valid_i && op_i.kind == gloss_pkg::RENDER_END;
    end
  end

  always_ff @(posedge clk_i) begin
    if (ready_o) begin
      what_q <= op_i.part;
      for (int r = 0; r < gloss_pkg::PartRows; r++) row_q[r] <= op_i.row == 5'(r);
      data_q <= data_i;
      bank_q <= bank_i;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      walk_full_q <= 1'b0;
      row_full_q <= 1'b0;
      row_fresh_q <= '0;
      walk_idle_q <= 1'b1;
    end else begin
      walk_idle_q <= walk_idle_i && !walk_full_q;
      row_fresh_q <= take_go ? 2'b11 : row_fresh_q >> 1;
      if (take_go) walk_full_q <= 1'b1;
      else if (walk_take_i) walk_full_q <= 1'b0;
      if (take_go || take_end) row_full_q <= 1'b1;
      else if (row_take_i) row_full_q <= 1'b0;
    end
  end

  // ---- state ----
  gloss_pkg::depth_state_header_t depth_state;
  gloss_pkg::colour_mask_header_t colour_mask;
  gloss_pkg::scissor_t            scissor;
  gloss_pkg::pixel_state_t        state_q;
  gloss_pkg::scissor_rect_t               scissor_q;
  logic                           is_end_q;
  logic                           unused_state;

  assign depth_state = data_q[31:0];
  assign colour_mask = data_q[31:0];
  assign scissor = data_q[31:0];
  assign unused_state = ^{depth_state, colour_mask, scissor};

  always_ff @(posedge clk_i) begin
    if (take_set) begin
      unique case (what_q)
        gloss_pkg::STATE_DEPTH: begin
          state_q.depth_func <= depth_state.func;
          state_q.depth_write <= depth_state.write;
        end
        gloss_pkg::STATE_MASK: begin
          state_q.colour_mask <= {colour_mask.alpha, colour_mask.blue, colour_mask.green,
                                  colour_mask.red};
        end
        gloss_pkg::STATE_SCISSOR: begin
          scissor_q <= {scissor.y1, scissor.x1, scissor.y0, scissor.x0};
        end
        default: begin
          state_q.depth_func <= gloss_pkg::COMPARE_ALWAYS;
          state_q.depth_write <= 1'b0;
          state_q.colour_mask <= '1;
          scissor_q <= {7'(TileSize), 7'(TileSize), 14'd0};
        end
      endcase
    end
    if (take_go || take_end) begin
      state_q.bank <= take_go ? bank_i : bank_q;
      is_end_q <= take_end;
    end
  end

  assign state_o = state_q;
  assign scissor_o = scissor_q;
  assign end_o = is_end_q;

  // ---- header ----
  gloss_pkg::triangle_header_t header;
  gloss_pkg::triangle_small_header_t small_header;
  logic                        is_small, compact_q, covering_q, listed_q, alpha_linear_q;
  logic [1:0]                  shading_q;
  logic [7:0]                  alpha_constant_q;
  logic                        unused_header;

  assign header = data_q[31:0];
  assign small_header = data_q[31:0];
  assign unused_header = ^{header.opcode, header.length, small_header};
  assign is_small = part_q[gloss_pkg::PART_SMALL];
  assign covering_o = covering_q;
  assign listed_o = listed_q;

  always_ff @(posedge clk_i) begin
    if (take_header) begin
      listed_q <= is_small;
      compact_q <= !is_small && header.geometry == gloss_pkg::GEOMETRY_COMPACT;
      covering_q <= !is_small && header.geometry == gloss_pkg::GEOMETRY_COVERING;
      shading_q <= is_small ? small_header.shading : header.shading;
      alpha_linear_q <= !is_small && header.alpha_linear;
      alpha_constant_q <= header.alpha;
    end
  end

  // ---- the parts ----
  logic                     take_pixels;
  gloss_pkg::pixels_small_t pixels;

  raster_load_rows #(
    .StreamBits(StreamBits)
  ) u_rows (
    .clk_i      (clk_i),
    .head_i     (take_part[gloss_pkg::PART_SMALL]),
    .rows_i     (take_part[gloss_pkg::PART_SMALL_ROWS]),
    .row_i      (row_q),
    .data_i     (data_q),
    .step_i     (listed_step_i),
    .take_o     (take_pixels),
    .pixels_o   (pixels),
    .x_o        (listed_x_o),
    .head_rows_o(listed_rows_o),
    .next_row_o (listed_next_o)
  );

  raster_load_edges #(
    .TileSize  (TileSize),
    .StreamBits(StreamBits)
  ) u_edges (
    .clk_i       (clk_i),
    .clear_i     (take_header),
    .write_i     (take_part[gloss_pkg::PART_EDGES]),
    .row_i       (row_q),
    .data_i      (data_q),
    .compact_i   (compact_q),
    .small_i     (take_pixels),
    .pixels_i    (pixels),
    .left_o      (left_o),
    .right_o     (right_o),
    .middle_o    (middle_o),
    .first_row_o (first_row_o),
    .last_row_o  (last_row_o),
    .switch_row_o(switch_row_o),
    .side_o      (side_o)
  );

  // left.x to a column of the tile, in units of 8
  always_comb begin
    anchor_o = '0;
    anchor_o[RowBits-4:0] = left_o.x[RowBits-1:3];
    if (|left_o.x[11:RowBits]) anchor_o[RowBits-4:0] = '1;
    if (left_o.x[12] || covering_q) anchor_o = '0;
  end

  raster_load_depth #(
    .StreamBits(StreamBits)
  ) u_depth (
    .clk_i    (clk_i),
    .write_i  (take_part[gloss_pkg::PART_DEPTH]),
    .small_i  (take_part[gloss_pkg::PART_SMALL]),
    .row_i    (row_q),
    .data_i   (data_q),
    .compact_i(compact_q),
    .depth_o  (depth_o)
  );

  // A part that is not sent is set a clock after the colour part's first row.
  logic take_colour, set_constant_q;

  assign take_colour = take_part[gloss_pkg::PART_COLOUR] ||
                       take_part[gloss_pkg::PART_SMALL_COLOUR];

  always_ff @(posedge clk_i) set_constant_q <= take_colour && row_q[0] && !alpha_linear_q;

  raster_load_alpha #(
    .StreamBits(StreamBits)
  ) u_alpha (
    .clk_i     (clk_i),
    .write_i   (take_part[gloss_pkg::PART_ALPHA]),
    .row_i     (row_q),
    .data_i    (data_q),
    .set_i     (set_constant_q),
    .constant_i(alpha_constant_q),
    .alpha_o   (alpha_o),
    .dx_o      (alpha_dx_o),
    .dy_o      (alpha_dy_o)
  );

  // The scale of a small record's slopes comes with the first of its colour's words.
  logic [1:0] slope_scale_q, slope_scale;

  assign slope_scale = row_q[0] ? data_q[31:30] : slope_scale_q;

  always_ff @(posedge clk_i) begin
    if (take_part[gloss_pkg::PART_SMALL_COLOUR]) slope_scale_q <= slope_scale;
  end

  localparam int unsigned SurfaceBits = $bits(red_o);
  logic [3*SurfaceBits-1:0] surfaces;

  for (genvar c = 0; c < 3; c++) begin : gen_colour
    raster_load_surface #(
      .StreamBits(StreamBits),
      .Channel   (c)
    ) u_colour (
      .clk_i    (clk_i),
      .write_i  (take_colour),
      .listed_i (listed_q),
      .scale_i  (slope_scale),
      .row_i    (row_q),
      .data_i   (data_q),
      .shading_i(shading_q),
      .surface_o(surfaces[SurfaceBits*c +: SurfaceBits])
    );
  end

  assign {blue_o, green_o, red_o} = surfaces;

`ifndef SYNTHESIS
  logic [1:0] row_taken_q;  // the record was taken one, two clocks ago

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) row_taken_q <= '0;
    else row_taken_q <= {row_taken_q[0], row_take_i};
  end

  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      header_a_clock_late: assert (!take_header || is_small || !row_take_i);
      depth_two_clocks_late: assert (!take_part[gloss_pkg::PART_DEPTH] ||
                                     !(row_take_i || row_taken_q[0]));
      colour_three_clocks_late: assert (
          !(take_part[gloss_pkg::PART_COLOUR] || take_part[gloss_pkg::PART_ALPHA]) ||
          !(row_take_i || row_taken_q != '0));
      small_colour_a_clock_late: assert (!take_part[gloss_pkg::PART_SMALL_COLOUR] || !row_take_i);
      go_after_a_whole_record: assert (!take_go || !(walk_full_q || row_full_q || take_end));
      alpha_set_once: assert (!(set_constant_q && take_part[gloss_pkg::PART_ALPHA]));
    end
  end
`endif

endmodule
