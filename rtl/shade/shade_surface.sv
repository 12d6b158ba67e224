// SPDX-License-Identifier: Apache-2.0
// One colour channel: a second-order surface, evaluated for a block of K pixels a clock by
// additions and shifts.
//
// Row state: value, across = 2*dx + (K-1)*dxx (so that K/2*across is the difference to the next
// block) and down, the difference to the next row. A run copies value and across at its first block
// and steps them on its own, while the row state moves to the next row's first block. From a run's
// block shade_lanes makes its K pixels.
//
// A command is taken at the end of a clock and changes, counted from there: operands in the 1st
// clock, the slopes and the run's slope in the 2nd, values in the 3rd, and the level is out after
// the Latency-th. Nothing flows back to raster. origin_i and its differences must stay for 1 clock
// after the command MOVE_LOAD was taken, i for 2.
module shade_surface #(
  parameter int unsigned PixelsPerClock = 1
) (
  input  logic                        clk_i,

  // from raster_row
  input  gloss_pkg::shade_command_t   command_i,

  // from raster_load
  input  gloss_pkg::surface_t         surface_i,

  // to fragment
  output logic [8*PixelsPerClock-1:0] level_o
);

  localparam int unsigned Shift = $clog2(PixelsPerClock);

  gloss_pkg::shade_command_t command_q;
  logic                      value_en_q, start_q, step_q;
  logic [1:0]                value_move_q;
  logic                      run_start_q, run_step_q;

  always_ff @(posedge clk_i) begin
    command_q <= command_i;
    value_en_q <= command_q.values;
    value_move_q <= command_q.move;
    start_q <= command_q.start;
    step_q <= command_q.step;
    run_start_q <= start_q;
    run_step_q <= step_q;
  end

  // across at the anchor; ready before the record is complete
  logic [32:0] origin_across;

  if (PixelsPerClock == 1) begin : gen_across_1
    assign origin_across = {surface_i.dx, 1'b0};
  end else begin : gen_across
    logic [32:0] bend_q, across_q;
    always_ff @(posedge clk_i) begin
      bend_q <= ({1'b0, surface_i.dxx} << Shift) - {1'b0, surface_i.dxx};
      across_q <= {surface_i.dx, 1'b0} + bend_q;
    end
    assign origin_across = across_q;
  end

  // ---- 1st clock: operands of the slopes; subtracting is adding the complement and one ----
  logic [31:0] dxx_q, dxy_q, dyy_q;
  logic [32:0] across_op_q;
  logic [31:0] down_op_q;
  logic        slope_one_q, slope_clear;

  assign slope_clear = command_q.slopes && command_q.move == gloss_pkg::MOVE_LOAD;

  always_ff @(posedge clk_i) begin
    if (slope_clear) begin
      dxx_q <= surface_i.dxx;
      dxy_q <= surface_i.dxy;
      dyy_q <= surface_i.dyy;
    end
    slope_one_q <= command_q.slopes && command_q.move == gloss_pkg::MOVE_LEFT;
    if (!command_q.slopes) begin
      across_op_q <= '0;
      down_op_q <= '0;
    end else begin
      unique case (command_q.move)
        gloss_pkg::MOVE_LOAD: begin
          across_op_q <= origin_across;
          down_op_q <= surface_i.dy;
        end
        gloss_pkg::MOVE_DOWN: begin
          across_op_q <= {dxy_q, 1'b0};
          down_op_q <= dyy_q;
        end
        gloss_pkg::MOVE_RIGHT: begin
          across_op_q <= {1'b0, dxx_q} << (Shift + 1);
          down_op_q <= dxy_q << Shift;
        end
        default: begin
          across_op_q <= ~({1'b0, dxx_q} << (Shift + 1));
          down_op_q <= ~(dxy_q << Shift);
        end
      endcase
    end
  end

  // ---- 2nd clock: slopes; operand of the value ----
  logic [32:0] across_q;
  logic [31:0] down_q;
  logic [32:0] across_sum;
  logic [31:0] down_sum;
  logic [31:0] stride;      // K/2*across
  logic [31:0] value_op_q;
  logic        value_one_q;
  logic        unused_across, unused_down; // where the one comes in

  assign {across_sum, unused_across} = {across_q, 1'b1} + {across_op_q, slope_one_q};
  assign {down_sum, unused_down} = {down_q, 1'b1} + {down_op_q, slope_one_q};

  if (PixelsPerClock == 1) begin : gen_stride_1
    assign stride = across_q[32:1];
  end else begin : gen_stride
    assign stride = across_q[31:0] << (Shift - 1);
  end

  always_ff @(posedge clk_i) begin
    if (slope_clear) begin
      across_q <= '0;
      down_q <= '0;
    end else begin
      across_q <= across_sum;
      down_q <= down_sum;
    end
    value_one_q <= value_en_q && value_move_q == gloss_pkg::MOVE_LEFT;
    if (!value_en_q) begin
      value_op_q <= '0;
    end else begin
      unique case (value_move_q)
        gloss_pkg::MOVE_LOAD: value_op_q <= surface_i.i;
        gloss_pkg::MOVE_DOWN: value_op_q <= down_q;
        gloss_pkg::MOVE_RIGHT: value_op_q <= stride;
        default: value_op_q <= ~stride;
      endcase
    end
  end

  // ---- 3rd clock: value ----
  logic [31:0] value_q;
  logic [31:0] value_sum;
  logic        unused_value;

  assign {value_sum, unused_value} = {value_q, 1'b1} + {value_op_q, value_one_q};

  always_ff @(posedge clk_i) begin
    if (value_en_q && value_move_q == gloss_pkg::MOVE_LOAD) value_q <= '0;
    else value_q <= value_sum;
  end

  // ---- the run: its slope in the 2nd clock, its value in the 3rd ----
  logic [31:0] run_dxx_q, run_bend_q;     // the next block's dxx, this block's
  logic [32:0] run_slope_q, run_across_q; // the slope of the next block, of this block
  logic [31:0] run_value_q, run_stride;

  if (PixelsPerClock == 1) begin : gen_run_stride_1
    assign run_stride = run_across_q[32:1];
  end else begin : gen_run_stride
    assign run_stride = run_across_q[31:0] << (Shift - 1);
  end

  always_ff @(posedge clk_i) begin
    if (start_q) begin
      run_dxx_q <= dxx_q;
      run_slope_q <= across_q;
    end else if (step_q) begin
      run_slope_q <= run_slope_q + ({1'b0, run_dxx_q} << (Shift + 1));
    end
    run_bend_q <= run_dxx_q;
    run_across_q <= run_slope_q;
    if (run_start_q) run_value_q <= value_q;
    else if (run_step_q) run_value_q <= run_value_q + run_stride;
  end

  shade_surface_lanes #(
    .PixelsPerClock(PixelsPerClock)
  ) u_lanes (
    .clk_i   (clk_i),
    .value_i (run_value_q),
    .across_i(run_across_q),
    .dxx_i   (run_bend_q),
    .level_o (level_o)
  );

`ifndef SYNTHESIS
  gloss_pkg::surface_t surface_q;  // a clock ago
  logic                value_load, value_held_q;
  logic [4:0]          clocked = '0;  // anything for two clocks, then for three more here

  assign value_load = value_en_q && value_move_q == gloss_pkg::MOVE_LOAD;

  always_ff @(posedge clk_i) begin
    surface_q <= surface_i;
    value_held_q <= surface_q.i == surface_i.i;
    clocked <= {clocked[3:0], 1'b1};
    if (clocked[4]) begin
      slopes_stay: assert (!slope_clear ||
          {surface_q.dx, surface_q.dy, surface_q.dxx, surface_q.dxy, surface_q.dyy} ==
          {surface_i.dx, surface_i.dy, surface_i.dxx, surface_i.dxy, surface_i.dyy});
      value_stays: assert (!value_load || (surface_q.i == surface_i.i && value_held_q));
      across_ready: assert (!slope_clear || origin_across == {surface_i.dx, 1'b0} +
                            ({1'b0, surface_i.dxx} << Shift) - {1'b0, surface_i.dxx});
    end
  end
`endif

endmodule
