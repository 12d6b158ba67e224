// SPDX-License-Identifier: Apache-2.0
// Turns the spans of a triangle into blocks and drives shade. Shade's row state stands at a block;
// this module moves it to the first block of the next row, one block or one row a clock (two clocks
// for a block to the left), while the run of the present row sends a block a clock. A row starts
// its run in the clock in which the row state goes down.
//
// No block comes twice within three clocks: tile memory relies on it. In a triangle none does at
// all. The next triangle's first block follows this one's last as soon as it is loaded, if this one
// ends in neither of its first two rows, and else two clocks later. So much passes before the mark
// of a tile's end in any case. The block of a command is out Latency clocks after the command was
// taken, together with its colours.
module raster_row #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned Latency = 5, // at least 5
  localparam int unsigned XBits = $clog2(TileSize / PixelsPerClock),
  localparam int unsigned YBits = $clog2(TileSize),
  localparam int unsigned LaneBits = (PixelsPerClock == 1) ? 1 : $clog2(PixelsPerClock)
) (
  input  logic                      clk_i,
  input  logic                      rst_ni,

  // from raster_load
  input  logic                      valid_i,      // a record, or a tile's end
  output logic                      take_o,
  output logic                      load_o,       // it takes a record
  input  logic                      end_i,        // a tile's end; then only state_i.bank matters
  input  logic [XBits-1:0]          anchor_i,     // block
  input  logic [YBits-1:0]          first_row_i,
  input  gloss_pkg::pixel_state_t   state_i,

  // from raster_walk
  input  logic                      span_valid_i,
  output logic                      span_ready_o,
  input  logic                      span_last_i,
  input  logic                      span_empty_i,
  input  logic [XBits-1:0]          span_block_i,
  input  logic [XBits-1:0]          span_more_i,
  input  logic [LaneBits-1:0]       span_low_i,
  input  logic [LaneBits-1:0]       span_high_i,

  // to shade
  output gloss_pkg::shade_command_t command_o,

  // to fragment
  output logic                      block_valid_o,
  output logic [XBits-1:0]          block_x_o,
  output logic [YBits-1:0]          block_y_o,
  output logic [PixelsPerClock-1:0] block_mask_o,
  output gloss_pkg::pixel_state_t   block_state_o,
  output logic                      end_o,
  output logic                      end_bank_o,

  output logic                      idle_o
);

  if (Latency < 5) begin : gen_latency
    $error("Latency must be at least 5");
  end

  // ---- what to do in this clock ----
  logic             busy_q;       // a triangle is under way
  logic             new_q;        // and none of its blocks is out yet
  logic             left_q;       // second clock of a move to the left
  logic [XBits-1:0] column_q;     // block the row state stands at
  logic [YBits-1:0] row_q;        // its row; steps a clock late
  logic             down_q;
  logic             step_q;       // the run sends a block in this clock
  logic [XBits-1:0] run_more_q;   // and so many after it
  logic             may_start_q;  // the run is over, and no block can come again too soon
  logic             apart_q;      // no block of the triangle before can
  logic [1:0]       recent_q;     // a block or mark was sent one, two clocks ago
  logic             load, walking, here, down, start, aside, right, send_end;

  assign walking = busy_q && !left_q && span_valid_i;
  assign here = span_empty_i || column_q == span_block_i;
  assign right = column_q < span_block_i;

  assign load = !busy_q && valid_i && !end_i;
  assign send_end = !busy_q && valid_i && end_i && !step_q && recent_q == '0;
  assign down = walking && here && (span_empty_i || may_start_q);
  assign start = walking && here && !span_empty_i && may_start_q;
  assign aside = walking && !here;

  assign take_o = load || send_end;
  assign load_o = load;
  assign span_ready_o = down;

  always_comb begin
    command_o.slopes = load || down || aside;
    command_o.values = load || down || (aside && right) || left_q;
    command_o.move = !busy_q ? gloss_pkg::MOVE_LOAD :
                     left_q ? gloss_pkg::MOVE_LEFT :
                     here ? gloss_pkg::MOVE_DOWN :
                     right ? gloss_pkg::MOVE_RIGHT : gloss_pkg::MOVE_LEFT;
    command_o.start = start;
    command_o.step = step_q;
  end

  // of the run's block
  logic [XBits-1:0]    run_x_q;
  logic [YBits-1:0]    run_y_q;
  logic                run_first_q, run_last_q;
  logic [LaneBits-1:0] run_low_q, run_high_q;

  // The last two blocks of the triangle before are in the row of its last run, or too far back; the
  // first two of this one are in its first two rows, or too far on. A start ends the wait of a new
  // triangle, so only steps have to be looked at for one that still waits.
  logic [YBits-1:0] last_row;
  logic             more, apart, gap_over;
  assign more = start ? span_more_i != '0 : step_q && run_more_q != '0;
  assign last_row = run_first_q ? row_q : run_y_q;
  assign apart = busy_q ? !new_q || (apart_q && !(span_valid_i && span_empty_i))
                        : last_row != first_row_i && last_row != first_row_i + 1'b1;
  assign gap_over = !(step_q || recent_q[0]);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      busy_q <= 1'b0;
      left_q <= 1'b0;
      step_q <= 1'b0;
      may_start_q <= 1'b0;
      recent_q <= '0;
    end else begin
      if (!busy_q) busy_q <= load;
      else if (down && span_last_i) busy_q <= 1'b0;
      left_q <= aside && !right;
      step_q <= more;
      may_start_q <= !more && (start || apart || gap_over);
      recent_q <= {recent_q[0], start || step_q || send_end};
    end
  end

  gloss_pkg::pixel_state_t state_q;

  always_ff @(posedge clk_i) begin
    if (take_o) begin
      column_q <= anchor_i;
      row_q <= first_row_i;
      new_q <= 1'b1;
      state_q <= state_i;
    end else begin
      if (aside) column_q <= right ? column_q + 1'b1 : column_q - 1'b1;
      if (down_q) row_q <= row_q + 1'b1;
      if (start) new_q <= 1'b0;
    end
    apart_q <= apart;
    down_q <= down;
    run_more_q <= (start ? span_more_i : run_more_q) - 1'b1;
  end

  // ---- the run's block ----
  always_ff @(posedge clk_i) begin
    run_first_q <= start;
    run_last_q <= !more;
    if (start) begin
      run_x_q <= column_q;
      run_low_q <= span_low_i;
      run_high_q <= span_high_i;
    end else if (step_q) begin
      run_x_q <= run_x_q + 1'b1;
    end
    if (run_first_q) run_y_q <= row_q;
  end

  logic [PixelsPerClock-1:0] run_mask;

  if (PixelsPerClock == 1) begin : gen_mask_1
    logic unused;
    assign unused = ^{run_last_q, run_low_q, run_high_q};
    assign run_mask = 1'b1;
  end else begin : gen_mask
    // yosys would take '1 for one bit here
    localparam logic [PixelsPerClock-1:0] All = {PixelsPerClock{1'b1}};
    assign run_mask = (run_first_q ? All << run_low_q : All) &
                      (run_last_q ? ~((All << 1) << run_high_q) : All);
  end

  // ---- beside shade's pipeline ----
  // valid_q[n] is n + 1 clocks after the command, part n of place_q another clock, of rows_q two.
  localparam int unsigned PlaceBits = XBits + PixelsPerClock;
  logic [Latency-1:0]                        valid_q, end_q;
  logic [(Latency-1)*PlaceBits-1:0]          place_q;
  logic [(Latency-2)*YBits-1:0]              rows_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      valid_q <= '0;
      end_q <= '0;
    end else begin
      valid_q <= {valid_q[Latency-2:0], start || step_q};
      end_q <= {end_q[Latency-2:0], send_end};
    end
  end

  always_ff @(posedge clk_i) begin
    place_q <= {place_q[(Latency-2)*PlaceBits-1:0], run_x_q, run_mask};
    rows_q <= {rows_q[(Latency-3)*YBits-1:0], run_y_q};
  end

  // A block's state is taken with the first block of its run.
  localparam int unsigned StateBits = $bits(state_i);
  logic [(Latency-1)*StateBits-1:0] states_q;

  always_ff @(posedge clk_i) begin
    if (run_first_q || end_q[0]) states_q[StateBits-1:0] <= state_q;
    states_q[StateBits +: (Latency-2)*StateBits] <= states_q[0 +: (Latency-2)*StateBits];
  end

  assign block_valid_o = valid_q[Latency-1];
  assign {block_x_o, block_mask_o} = place_q[(Latency-2)*PlaceBits +: PlaceBits];
  assign block_y_o = rows_q[(Latency-3)*YBits +: YBits];
  assign block_state_o = states_q[StateBits*(Latency-2) +: StateBits];
  assign end_o = end_q[Latency-1];
  assign end_bank_o = block_state_o.bank;

  assign idle_o = !busy_q && !step_q && valid_q == '0 && end_q == '0;

`ifndef SYNTHESIS
  logic [1:0] late_q;   // a block was out one, two clocks ago
  logic       taken_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      late_q <= '0;
      taken_q <= 1'b0;
    end else begin
      late_q <= {late_q[0], block_valid_o};
      taken_q <= take_o;
    end
  end

  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      gap_before_triangle: assert (!(start && new_q) || apart_q || (!step_q && recent_q == '0));
      gap_before_end: assert (!end_o || (valid_q[Latency-1] == 1'b0 && late_q == '0));
      state_stays_for_run: assert (!run_first_q || !taken_q);
      run_in_tile: assert (!start || {1'b0, span_block_i} + {1'b0, span_more_i}
                                     < (XBits+1)'(TileSize / PixelsPerClock));
    end
  end
`endif

endmodule
