// SPDX-License-Identifier: Apache-2.0
// Steps one edge of a triangle down the rows, exactly: x is the first pixel of the row that is not
// left of the edge and r what the division left over. To the next row r += m, x += step, and if r
// >= dy then r -= dy and x += 1.
//
// The remainder goes one step ahead of x, so that neither waits for the other: the carry of a step
// of r is used by the step of x after it.
module raster_edge (
  input  logic                   clk_i,

  // from raster_walk
  input  logic                   idle_i,     // what is taken is line_i, otherwise middle_i
  input  logic                   take_r_i,   // take r, m and dy
  input  logic                   step_r_i,   // or step r
  input  logic                   take_x_i,   // take x and step
  input  logic                   step_x_i,   // or step x, by the carry of the step of r before

  // from raster_load
  input  gloss_pkg::edge_line_t  line_i,
  input  gloss_pkg::edge_line_t  middle_i,

  // to raster_walk
  output logic signed [12:0]     x_o
);

  gloss_pkg::edge_line_t source;
  logic signed [12:0]    x_q, step_q;
  logic [15:0]           r_q, m_q;
  logic [16:0]           drop_q; // m - dy
  logic                  carry_q;

  // Both outcomes side by side. r + m loses its carry before it is compared with dy, as the
  // interface says; so r was large enough if taking dy away borrowed as often as adding m carried.
  logic [16:0] stay, dropped;
  logic        carry;

  assign source = idle_i ? line_i : middle_i;
  assign stay = {1'b0, r_q} + {1'b0, m_q};
  assign dropped = {1'b0, r_q} + drop_q;
  assign carry = stay[16] == dropped[16];
  assign x_o = x_q;

  always_ff @(posedge clk_i) begin
    if (take_r_i) begin
      r_q <= source.r;
      m_q <= source.m;
      drop_q <= {1'b0, source.m} - {1'b0, source.dy};
    end else if (step_r_i) begin
      r_q <= carry ? dropped[15:0] : stay[15:0];
    end
    if (step_r_i) carry_q <= carry;
  end

  always_ff @(posedge clk_i) begin
    if (take_x_i) begin
      x_q <= source.x;
      step_q <= source.step;
    end else if (step_x_i) begin
      x_q <= x_q + step_q + {12'b0, carry_q};
    end
  end

endmodule
