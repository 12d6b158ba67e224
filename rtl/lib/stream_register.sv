// SPDX-License-Identifier: Apache-2.0
// Cuts a valid/ready stream: no path from ready_i to ready_o or from an input to an output. Full
// rate, one clock of latency.
//
// Two words are written in turn and read in turn. So what is known late, whether a word is taken
// from here, sets single bits only: the enables of the words come from registers, and data_o is a
// choice of two.
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

  logic [Width-1:0] even_q, odd_q;
  logic [1:0]       open_q;         // even_q or odd_q is the next to be written, and free
  logic             ready_q;        // one of them is
  logic             valid_q, both_q;
  logic             write_q, read_q;  // 1: odd_q is the next
  logic             take, give, write_d, both_d;

  assign ready_o = ready_q;
  assign valid_o = valid_q;
  assign data_o = read_q ? odd_q : even_q;

  assign take = valid_i && ready_q;
  assign give = valid_q && ready_i;
  assign write_d = write_q ^ take;
  assign both_d = give ? 1'b0 : both_q || (valid_q && take);

  // A word that is not there yet is written over until it is.
  always_ff @(posedge clk_i) begin
    if (open_q[0]) even_q <= data_i;
    if (open_q[1]) odd_q <= data_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      open_q <= 2'b01;
      ready_q <= 1'b1;
      valid_q <= 1'b0;
      both_q <= 1'b0;
      write_q <= 1'b0;
      read_q <= 1'b0;
    end else begin
      open_q <= both_d ? 2'b00 : {write_d, !write_d};
      ready_q <= !both_d;
      valid_q <= take || (give ? both_q : valid_q);
      both_q <= both_d;
      write_q <= write_d;
      read_q <= read_q ^ give;
    end
  end

endmodule
