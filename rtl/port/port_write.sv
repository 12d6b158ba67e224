// SPDX-License-Identifier: Apache-2.0
// The response: words of the core into pages of host memory, in bursts of 256 bytes as soon as one
// is full; what is left when the job has ended goes out in a shorter one.
module port_write #(
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // core
  input  logic                         response_valid_i,
  output logic                         response_ready_o,
  input  logic [3:0]                   response_count_i,
  input  logic [32*PixelsPerClock-1:0] response_data_i,
  output logic [3:0]                   taken_o,        // words the core gives in this clock

  // from port_complete
  input  logic                         flush_i,        // all words of the job have come
  output logic                         empty_o,        // all is written but not acknowledged

  // from port_list
  input  logic                         page_valid_i,
  output logic                         page_ready_o,
  input  logic [63:12]                 page_i,

  // host writes
  output logic                         address_valid_o,
  input  logic                         address_ready_i,
  output logic [63:8]                  address_o,
  output logic [7:0]                   length_o,
  output logic                         data_valid_o,
  input  logic                         data_ready_i,
  output logic [StreamBits-1:0]        data_o,
  output logic [StreamBits/8-1:0]      strobe_o
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned BurstBeats = 64 / Lanes;
  localparam int unsigned BurstBits = $clog2(BurstBeats);

  typedef enum logic [1:0] {Idle, Address, Data} state_e;

  state_e state_d, state_q;
  logic packed_valid, packed_ready, pack_empty, push;
  logic [StreamBits-1:0] packed_data;
  logic [2:0] packed_words, tail_q;  // of the beat that came last
  logic [BurstBits+1:0] have_q;      // beats that are in no burst
  logic burst_full, burst_short, begin_burst;
  logic [BurstBits-1:0] length_q;
  logic short_q, beat_valid, last_beat;
  logic [3:0] burst_q;               // in the page

  assign taken_o = response_valid_i && response_ready_o ? response_count_i : '0;
  assign push = packed_valid && packed_ready;

  port_pack #(
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits)
  ) u_pack (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(response_valid_i),
    .ready_o(response_ready_o),
    .count_i(response_count_i),
    .data_i (response_data_i),
    .flush_i(flush_i),
    .empty_o(pack_empty),
    .valid_o(packed_valid),
    .ready_i(packed_ready),
    .data_o (packed_data),
    .words_o(packed_words)
  );

  ram_fifo #(
    .Width(StreamBits),
    .Depth(2 * BurstBeats)
  ) u_beats (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(packed_valid),
    .ready_o(packed_ready),
    .data_i (packed_data),
    .valid_o(beat_valid),
    .ready_i(data_valid_o && data_ready_i),
    .data_o (data_o)
  );

  assign burst_full = have_q[BurstBits+1:BurstBits] != '0;
  assign burst_short = flush_i && pack_empty && have_q != '0;
  assign begin_burst = state_q == Idle && page_valid_i && (burst_full || burst_short);
  assign empty_o = state_q == Idle && pack_empty && have_q == '0;

  assign address_valid_o = state_q == Address;
  assign address_o = {page_i, burst_q};
  assign length_o = 8'(length_q);
  assign page_ready_o = address_valid_o && address_ready_i && burst_q == '1;

  assign data_valid_o = state_q == Data && beat_valid;
  assign last_beat = data_valid_o && data_ready_i && length_q == '0;

  always_comb begin
    strobe_o = '1;
    if (short_q && length_q == '0 && tail_q != '0)
      for (int l = 0; l < Lanes; l++) strobe_o[4*l +: 4] = {4{3'(l) < tail_q}};
  end

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      Idle: if (begin_burst) state_d = Address;
      Address: if (address_ready_i) state_d = Data;
      Data: if (last_beat) state_d = Idle;
      default: state_d = Idle;
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (push) tail_q <= packed_words;
    if (begin_burst) begin
      length_q <= burst_full ? '1 : have_q[BurstBits-1:0] - 1'b1;
      // The job's last, when nothing can come behind it.
      short_q <= burst_short && (!burst_full || have_q == (BurstBits + 2)'(BurstBeats));
    end else if (data_valid_o && data_ready_i) begin
      length_q <= length_q - 1'b1;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
      have_q <= '0;
      burst_q <= '0;
    end else begin
      state_q <= state_d;
      have_q <= have_q + (BurstBits + 2)'(push) -
                (!begin_burst ? '0 : burst_full ? (BurstBits + 2)'(BurstBeats) : have_q);
      if (flush_i && empty_o) burst_q <= '0;
      else if (address_valid_o && address_ready_i) burst_q <= burst_q + 1'b1;
    end
  end

endmodule
