// SPDX-License-Identifier: Apache-2.0
// A FIFO in block RAM for Depth words (a power of two) and one more; first word falls through. Full
// rate; a word is at the output two clocks after it was taken. ready_o and valid_o come from
// registers.
module ram_fifo #(
  parameter int unsigned Width = 32,
  parameter int unsigned Depth = 256
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

  logic [Bits:0] head_q, tail_q;
  logic valid_q, full_q, fetch, fills;

  assign ready_o = !full_q;
  assign valid_o = valid_q;

  // The RAM's own output register is the place of the first word.
  assign fetch = head_q != tail_q && (!valid_q || ready_i);
  // The next word taken is the last that fits.
  assign fills = head_q[Bits-1:0] + 1'b1 == tail_q[Bits-1:0];

  ram_1r1w #(
    .Width(Width),
    .Depth(Depth)
  ) u_ram (
    .clk_i       (clk_i),
    .write_en_i  (valid_i && ready_o),
    .write_addr_i(head_q[Bits-1:0]),
    .write_data_i(data_i),
    .read_en_i   (fetch),
    .read_addr_i (tail_q[Bits-1:0]),
    .read_data_o (data_o)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= '0;
      tail_q <= '0;
      valid_q <= 1'b0;
      full_q <= 1'b0;
    end else begin
      if (valid_i && ready_o) head_q <= head_q + 1'b1;
      if (fetch) tail_q <= tail_q + 1'b1;
      valid_q <= fetch || (valid_q && !ready_i);
      full_q <= !fetch && (full_q || (valid_i && fills));
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      full_is_full: assert (full_q == ((head_q ^ tail_q) == {1'b1, {Bits{1'b0}}}));
    end
  end
`endif

endmodule
