// SPDX-License-Identifier: Apache-2.0
// memory_burst: whatever the range, its bursts cover it once and in order, and none crosses sixteen beats.
module formal_memory_burst (
  input logic clk_i
);

  localparam int unsigned BeatBits = 8;

  (* anyconst *) logic [BeatBits-1:0] first;
  (* anyconst *) logic [BeatBits-1:0] last;
  (* anyseq *)   logic                start;
  (* anyseq *)   logic                ready;

  logic                rst_n = 1'b0, started = 1'b0;
  logic                valid;
  logic [BeatBits-1:0] beat;
  logic [3:0]          length;
  logic [BeatBits:0]   next;  // beats below it are covered

  memory_burst #(.BeatBits(BeatBits)) dut (
    .clk_i, .rst_ni(rst_n),
    .start_i(start), .first_i(first), .last_i(last),
    .valid_o(valid), .ready_i(ready), .beat_o(beat), .length_o(length)
  );

  always_ff @(posedge clk_i) begin
    rst_n <= 1'b1;
    if (start) begin
      started <= 1'b1;
      next <= {1'b0, first};
    end else if (valid && ready) begin
      next <= {1'b0, beat} + (BeatBits+1)'(length) + 1'b1;
    end

    assume (first <= last);
    assume (!start || (rst_n && !started));
    if (rst_n && valid) begin
      started_once: assert (started);
      in_order: assert ({1'b0, beat} == next);
      in_sixteen: assert (beat[BeatBits-1:4] == BeatBits'(beat + length) >> 4);
      in_range: assert ({1'b0, beat} + (BeatBits+1)'(length) <= {1'b0, last});
    end
    if (rst_n && started && !valid) covered: assert (next == {1'b0, last} + 1'b1);
    reached: cover (started && !valid && first == 8'd5 && last == 8'd50);
  end

endmodule
