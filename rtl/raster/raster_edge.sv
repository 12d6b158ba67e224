// SPDX-License-Identifier: Apache-2.0
// Steps one edge of a triangle down the rows, exactly: x is the first pixel of the row that is not left of the edge and
// r what the division left over. To the next row r += m, x += step, and if r >= dy then r -= dy and x += 1.
//
// The remainder goes one step ahead of x, so that neither waits for the other: the carry of a step of r is used by the
// step of x after it.
module raster_edge (
  input  logic                   clk_i,

  // from raster_walk
  input  logic                   load_i,     // take line_i as it is
  input  logic                   step_r_i,
  input  logic                   switch_r_i, // with step_r_i: go on with middle_i instead
  input  logic                   step_x_i,   // for the step of r before
  input  logic                   switch_x_i,

  // from raster_load
  input  gloss_pkg::edge_line_t  line_i,
  input  gloss_pkg::edge_line_t  middle_i,   // must stay until it is switched to

  // to raster_walk
  output logic signed [12:0]     x_o
);

  logic signed [12:0] x_q, step_q;
  logic [15:0]        r_q, m_q, dy_q;
  logic               carry_q;

  // r + m loses its carry, as the interface says.
  logic [15:0] sum;
  logic [16:0] rest;

  assign sum = r_q + m_q;
  assign rest = {1'b0, sum} - {1'b0, dy_q};
  assign x_o = x_q;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      r_q <= line_i.r;
      m_q <= line_i.m;
      dy_q <= line_i.dy;
    end else if (step_r_i) begin
      if (switch_r_i) begin
        r_q <= middle_i.r;
        m_q <= middle_i.m;
        dy_q <= middle_i.dy;
      end else begin
        r_q <= rest[16] ? sum : rest[15:0];
      end
      carry_q <= !rest[16];
    end
  end

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      x_q <= line_i.x;
      step_q <= line_i.step;
    end else if (step_x_i) begin
      if (switch_x_i) begin
        x_q <= middle_i.x;
        step_q <= middle_i.step;
      end else begin
        x_q <= x_q + step_q + {12'b0, carry_q};
      end
    end
  end

endmodule
