// SPDX-License-Identifier: Apache-2.0
// A FIFO of Depth words (a power of two, at least 2), first word falls through. No path from
// ready_i to ready_o or from valid_i to valid_o; a word is at the output one clock after it was
// taken. The first word is in a register, not in the memory, so nothing has to wait for a read.
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
  logic [Width-1:0] data_q;
  logic [Bits-1:0] head_q, tail_q;  // of the memory
  logic [Bits:0] words_q;           // in all
  logic valid_q, stored_q;          // there is a first word; there are more behind it
  logic take, give, moves;

  assign ready_o = !words_q[Bits];
  assign valid_o = valid_q;
  assign data_o = data_q;

  assign take = valid_i && ready_o;
  assign give = valid_q && ready_i;
  assign moves = !valid_q || ready_i;

  always_ff @(posedge clk_i) begin
    if (take) memory[head_q] <= data_i;
    if (moves) data_q <= stored_q ? memory[tail_q] : data_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= '0;
      tail_q <= '0;
      words_q <= '0;
      valid_q <= 1'b0;
      stored_q <= 1'b0;
    end else begin
      // A word that goes to the register at once leaves its place in the memory at once.
      if (take) head_q <= head_q + 1'b1;
      if (moves && (stored_q || take)) tail_q <= tail_q + 1'b1;
      words_q <= words_q + (Bits+1)'(take) - (Bits+1)'(give);
      valid_q <= !moves || stored_q || take;
      stored_q <= words_q + (Bits+1)'(take) - (Bits+1)'(give) > (Bits+1)'(1);
    end
  end

endmodule
