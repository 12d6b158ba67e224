// SPDX-License-Identifier: Apache-2.0
// Cuts a valid/ready stream: every output, ready_o too, comes from a register. Full rate, one clock
// of latency.
module stream_register #(
  parameter int unsigned Width = 32
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

  logic             full_q, spare_full_q;
  logic [Width-1:0] data_q, spare_q;

  assign ready_o = !spare_full_q;
  assign valid_o = full_q;
  assign data_o = data_q;

  always_ff @(posedge clk_i) begin
    if (!full_q || ready_i) data_q <= spare_full_q ? spare_q : data_i;
    if (valid_i && ready_o) spare_q <= data_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      full_q <= 1'b0;
      spare_full_q <= 1'b0;
    end else if (!full_q || ready_i) begin
      full_q <= valid_i || spare_full_q;
      spare_full_q <= 1'b0;
    end else if (valid_i) begin
      spare_full_q <= 1'b1;
    end
  end

endmodule
