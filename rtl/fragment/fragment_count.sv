// SPDX-License-Identifier: Apache-2.0
// Counts the set bits of a mask a clock, modulo 2^32: bits given in a clock are in the count three
// clocks later.
module fragment_count #(
  parameter int unsigned Width = 8
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  input  logic             clear_i,
  input  logic [Width-1:0] mask_i,
  output logic [31:0]      count_o
);

  logic [Width-1:0] mask_q;
  logic [3:0] sum_d, sum_q;

  always_comb begin
    sum_d = '0;
    for (int unsigned l = 0; l < Width; l++) sum_d += 4'(mask_q[l]);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      mask_q <= '0;
      sum_q <= '0;
      count_o <= '0;
    end else begin
      mask_q <= mask_i;
      sum_q <= sum_d;
      count_o <= clear_i ? '0 : count_o + 32'(sum_q);
    end
  end

endmodule
