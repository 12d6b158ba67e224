// SPDX-License-Identifier: Apache-2.0
// A plane, alpha or depth, for a block of K pixels a clock: shade_surface without the second
// differences, with the same commands and the same latency. plane_i must stay for 2 clocks after
// the command MOVE_LOAD was taken.
module shade_plane #(
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned Width = 40,   // of the accumulators
  parameter int unsigned Fraction = 12,
  parameter int unsigned LevelBits = 24
) (
  input  logic                                clk_i,

  // from raster_row
  input  gloss_pkg::shade_command_t           command_i,

  // from raster_load
  input  logic [Width-1:0]                    origin_i,
  input  logic [Width-1:0]                    dx_i,
  input  logic [Width-1:0]                    dy_i,

  // to fragment
  output logic [LevelBits*PixelsPerClock-1:0] level_o
);

  localparam int unsigned Shift = $clog2(PixelsPerClock);

  gloss_pkg::shade_command_t command_q;
  logic                      en_q, start_q, step_q, run_start_q, run_step_q;
  logic [1:0]                move_q;
  logic                      unused_slopes;

  assign unused_slopes = command_q.slopes;

  always_ff @(posedge clk_i) begin
    command_q <= command_i;
    en_q <= command_q.values;
    move_q <= command_q.move;
    start_q <= command_q.start;
    step_q <= command_q.step;
    run_start_q <= start_q;
    run_step_q <= step_q;
  end

  // ---- 2nd clock: operand ----
  logic [Width-1:0] dx_q, dy_q, op_q;
  logic             one_q, clear;

  assign clear = en_q && move_q == gloss_pkg::MOVE_LOAD;

  always_ff @(posedge clk_i) begin
    if (clear) begin
      dx_q <= dx_i;
      dy_q <= dy_i;
    end
    one_q <= en_q && move_q == gloss_pkg::MOVE_LEFT;
    if (!en_q) begin
      op_q <= '0;
    end else begin
      unique case (move_q)
        gloss_pkg::MOVE_LOAD: op_q <= origin_i;
        gloss_pkg::MOVE_DOWN: op_q <= dy_q;
        gloss_pkg::MOVE_RIGHT: op_q <= dx_q << Shift;
        default: op_q <= ~(dx_q << Shift);
      endcase
    end
  end

  // ---- 3rd clock: the row's value, and the run's ----
  logic [Width-1:0] value_q, run_dx_q, run_value_q;
  logic [Width-1:0] sum;
  logic             unused_sum; // where the one comes in

  assign {sum, unused_sum} = {value_q, 1'b1} + {op_q, one_q};

  always_ff @(posedge clk_i) begin
    if (clear) value_q <= '0;
    else value_q <= sum;
    if (run_start_q) begin
      run_dx_q <= dx_q;
      run_value_q <= value_q;
    end else if (run_step_q) begin
      run_value_q <= run_value_q + (run_dx_q << Shift);
    end
  end

  shade_plane_lanes #(
    .PixelsPerClock(PixelsPerClock),
    .Width         (Width),
    .Fraction      (Fraction),
    .LevelBits     (LevelBits)
  ) u_lanes (
    .clk_i  (clk_i),
    .value_i(run_value_q),
    .dx_i   (run_dx_q),
    .level_o(level_o)
  );

`ifndef SYNTHESIS
  logic [3*Width-1:0] plane_q;  // a clock ago
  logic               held_q;
  logic [4:0]         clocked = '0;  // anything for two clocks, then for three more here

  always_ff @(posedge clk_i) begin
    plane_q <= {origin_i, dx_i, dy_i};
    held_q <= plane_q == {origin_i, dx_i, dy_i};
    clocked <= {clocked[3:0], 1'b1};
    if (clocked[4]) begin
      plane_stays: assert (!clear || (plane_q == {origin_i, dx_i, dy_i} && held_q));
    end
  end
`endif

endmodule
