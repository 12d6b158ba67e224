// SPDX-License-Identifier: Apache-2.0
// A FIFO of Depth words (a power of two, at least 2), first word falls through. No path from
// ready_i to ready_o or from valid_i to valid_o; a word is at the output one clock after it was
// taken.
module stream_fifo #(
  parameter int unsigned Width = 32,
  parameter int unsigned Depth = 16
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  input  logic             valid_i,
  output logic             ready_o,
  input  logic [Width-1:0] data_i,

  output logic             valid_o,
  input  logic             ready_i,
  output logic [Width-1:0] data_o
);

  if (Depth < 2 || (Depth & (Depth - 1)) != 0) begin : gen_depth
    $error("Depth must be a power of two, at least 2");
  end

  localparam int unsigned Bits = $clog2(Depth);

  logic [Width-1:0] memory [Depth];
  logic [Bits:0] head_q, tail_q;

  assign ready_o = (head_q ^ tail_q) != {1'b1, {Bits{1'b0}}};
  assign valid_o = head_q != tail_q;
  assign data_o = memory[tail_q[Bits-1:0]];

  always_ff @(posedge clk_i) begin
    if (valid_i && ready_o) memory[head_q[Bits-1:0]] <= data_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= '0;
      tail_q <= '0;
    end else begin
      if (valid_i && ready_o) head_q <= head_q + 1'b1;
      if (valid_o && ready_i) tail_q <= tail_q + 1'b1;
    end
  end

endmodule
