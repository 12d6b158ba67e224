// SPDX-License-Identifier: Apache-2.0
// Cuts a range of beats into bursts of at most sixteen that end on a multiple of sixteen beats, at
// most 512 bytes: so none crosses a 4 KiB border. Begins anew whenever start_i gives a range; the
// first burst is out a clock later.
module memory_burst #(
  parameter int unsigned BeatBits = 30
) (
  input  logic                clk_i,
  input  logic                rst_ni,

  input  logic                start_i,
  input  logic [BeatBits-1:0] first_i,
  input  logic [BeatBits-1:0] last_i,

  output logic                valid_o,
  input  logic                ready_i,
  output logic [BeatBits-1:0] beat_o,
  output logic [3:0]          length_o  // beats less one
);

  logic valid_q, final_q;   // final_q: it is the range's last burst
  logic [BeatBits-1:0] beat_q, last_q;
  logic [BeatBits-5:0] next;

  assign next = beat_q[BeatBits-1:4] + 1'b1;
  assign valid_o = valid_q;
  assign beat_o = beat_q;
  assign length_o = (final_q ? last_q[3:0] : 4'd15) - beat_q[3:0];

  always_ff @(posedge clk_i) begin
    if (start_i) begin
      beat_q <= first_i;
      last_q <= last_i;
      final_q <= first_i[BeatBits-1:4] == last_i[BeatBits-1:4];
    end else if (valid_q && ready_i) begin
      beat_q <= {next, 4'd0};
      final_q <= next == last_q[BeatBits-1:4];
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) valid_q <= 1'b0;
    else if (start_i) valid_q <= 1'b1;
    else if (ready_i && final_q) valid_q <= 1'b0;
  end

endmodule
