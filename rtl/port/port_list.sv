// SPDX-License-Identifier: Apache-2.0
// Reads a list of pages in host memory, entry by entry, up to two ahead of who takes them: a page
// lasts longer than a read takes, so that one entry at a time is enough. Addresses are multiples of
// a beat, which may have two entries.
module port_list #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  input  logic                  start_i,    // only when idle
  input  logic [63:3]           list_i,
  input  logic [31:0]           words_i,    // in its pages
  input  logic                  request_i,  // hold back while nobody has use for pages
  input  logic                  stop_i,     // read no more, drop what is here
  output logic                  idle_o,     // all is read
  output logic                  drained_o,  // nothing is being read or requested
  output logic                  empty_o,    // idle, and all pages were taken

  // host reads
  output logic                  read_valid_o,
  input  logic                  read_ready_i,
  output logic [63:3]           read_address_o,
  input  logic                  beat_valid_i,
  input  logic                  beat_last_i,
  input  logic [StreamBits-1:0] beat_data_i,

  output logic                  page_valid_o,
  input  logic                  page_ready_i,
  output logic [63:12]          page_o
);

  logic [22:0] left_q;  // entries not asked for
  logic [63:3] address_q;
  logic outstanding_q, room;
  logic [63:12] entry;
  logic pages_valid;

  assign read_valid_o = left_q != '0 && request_i && !outstanding_q && room && !stop_i;
  assign read_address_o = StreamBits == 128 ? {address_q[63:4], 1'b0} : address_q;
  assign idle_o = left_q == '0 && !outstanding_q;
  assign drained_o = !outstanding_q && !read_valid_o;
  assign empty_o = idle_o && !pages_valid;

  // The low bits of an entry are no part of the page's address.
  logic unused;
  if (StreamBits == 128) begin : gen_pair
    logic half_q;
    assign entry = half_q ? beat_data_i[127:76] : beat_data_i[63:12];
    assign unused = ^{beat_data_i[75:64], beat_data_i[11:0]};
    always_ff @(posedge clk_i) if (read_valid_o) half_q <= address_q[3];
  end else if (StreamBits == 64) begin : gen_one
    assign entry = beat_data_i[63:12];
    assign unused = ^beat_data_i[11:0];
  end else begin : gen_half
    logic [31:12] low_q;
    assign entry = {beat_data_i, low_q};
    assign unused = ^beat_data_i[11:0];
    always_ff @(posedge clk_i) if (beat_valid_i && !beat_last_i) low_q <= beat_data_i[31:12];
  end

  stream_fifo #(
    .Width($bits(page_o)),
    .Depth(2)
  ) u_pages (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(beat_valid_i && beat_last_i),
    .ready_o(room),
    .data_i (entry),
    .valid_o(pages_valid),
    .ready_i(page_ready_i || stop_i),
    .data_o (page_o)
  );
  assign page_valid_o = pages_valid && !stop_i;

  always_ff @(posedge clk_i) begin
    if (start_i) address_q <= list_i;
    else if (read_valid_o && read_ready_i) address_q <= address_q + 1'b1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q <= '0;
      outstanding_q <= 1'b0;
    end else begin
      if (start_i) left_q <= {1'b0, words_i[31:10]} + 23'(words_i[9:0] != '0);
      else if (stop_i) left_q <= '0;
      else if (read_valid_o && read_ready_i) left_q <= left_q - 1'b1;
      if (read_valid_o && read_ready_i) outstanding_q <= 1'b1;
      else if (beat_valid_i && beat_last_i) outstanding_q <= 1'b0;
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      start_when_idle: assert (!start_i || idle_o);
      entry_has_room: assert (!(beat_valid_i && beat_last_i) || room);
      beats_asked_for: assert (!beat_valid_i || outstanding_q);
    end
  end
`endif

endmodule
