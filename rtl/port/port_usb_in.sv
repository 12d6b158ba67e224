// SPDX-License-Identifier: Apache-2.0
// The IN channel: the echo of a usb_sync; and of each job its response in chunks, then its
// usb_completion. A chunk goes out when all of its words are here, or all of the job's are. The
// FIFO has room for two, so that the core goes on while one leaves. The job is counted as soon as
// the core has ended it and its checksum was right, whether or not anyone takes words; the core
// gets its next one when its usb_completion is taken. Without the right checksum the job has
// nothing but full chunks.
module port_usb_in #(
  parameter int unsigned PixelsPerClock = 1
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // from port_usb_out
  input  logic                         echo_i,
  input  gloss_pkg::usb_sync_t         sync_i,
  output logic                         echoed_o,
  input  logic [31:0]                  sequence_i,
  input  logic                         running_i,
  input  logic                         checked_i,
  output logic                         completed_o,

  // core
  input  logic                         response_valid_i,
  output logic                         response_ready_o,
  input  logic [3:0]                   response_count_i,
  input  logic [32*PixelsPerClock-1:0] response_data_i,
  input  logic                         status_valid_i,
  output logic                         status_ready_o,
  // verilator lint_off UNUSEDSIGNAL
  input  gloss_pkg::status_t           status_i,
  // verilator lint_on UNUSEDSIGNAL

  // registers
  output logic [3:0]                   taken_o,        // words the core gives in this clock
  output logic                         done_o,         // its job has ended as it should

  output logic                         word_valid_o,
  input  logic                         word_ready_i,
  output logic [31:0]                  word_o,
  output logic                         word_flush_o
);

  localparam int unsigned Depth = 2 * gloss_pkg::UsbChunkWords;
  localparam int unsigned HaveBits = $clog2(Depth) + 1;
  localparam int unsigned CountBits = $clog2(gloss_pkg::UsbChunkWords) + 1;

  typedef enum logic [2:0] {Idle, Header, Words, Completion, Sum, Checksum, Echo} state_e;

  state_e state_d, state_q;
  logic give;

  logic packed_valid, packed_ready, pack_empty, push;
  logic [31:0] packed_word;
  logic fifo_valid, fifo_ready;
  logic [31:0] fifo_word;

  logic [HaveBits-1:0] have_q;    // words that are in no chunk
  logic full, last, begin_chunk;
  logic [CountBits-1:0] count, count_q;

  gloss_pkg::usb_response_t header;
  gloss_pkg::usb_completion_t completion;
  logic [127:0] message;
  logic [1:0] place_q;
  logic message_ends;
  logic [31:0] given_q, sum_q;
  logic sum_given_q;
  logic ended, ended_q, reported_q;

  // ---- response ----
  port_pack #(
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (32)
  ) u_pack (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(response_valid_i),
    .ready_o(response_ready_o),
    .count_i(response_count_i),
    .data_i (response_data_i),
    .flush_i(1'b0),
    .empty_o(pack_empty),
    .valid_o(packed_valid),
    .ready_i(packed_ready),
    .data_o (packed_word),
    /* verilator lint_off PINCONNECTEMPTY */
    .words_o() // always one
    /* verilator lint_on PINCONNECTEMPTY */
  );
  assign taken_o = response_valid_i && response_ready_o ? response_count_i : '0;
  assign push = packed_valid && packed_ready;

  ram_fifo #(
    .Width(32),
    .Depth(Depth)
  ) u_words (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(packed_valid),
    .ready_o(packed_ready),
    .data_i (packed_word),
    .valid_o(fifo_valid),
    .ready_i(fifo_ready),
    .data_o (fifo_word)
  );

  // ---- chunks ----
  assign full = have_q >= HaveBits'(gloss_pkg::UsbChunkWords);
  assign ended = status_valid_i && checked_i;
  assign last = ended && pack_empty;
  assign count = full ? CountBits'(gloss_pkg::UsbChunkWords) : CountBits'(have_q);
  assign begin_chunk = state_q == Idle && (full || (last && have_q != '0));

  // ---- messages ----
  assign header = {16'(gloss_pkg::UsbResponseMagic), 16'(count_q)};
  assign completion = {sum_q, status_i.response_words, status_i.offset, sequence_i,
                       16'(gloss_pkg::UsbCompletionMagic), 12'd0, status_i.cause};
  assign message = state_q == Echo ? sync_i : completion[127:0];
  assign message_ends = give && place_q == '1;

  assign give = word_valid_o && word_ready_i;
  assign word_valid_o = state_q == Words ? fifo_valid : state_q != Idle && state_q != Sum;
  assign word_flush_o = state_q == Checksum || (state_q == Echo && place_q == '1);
  assign fifo_ready = state_q == Words && word_ready_i;

  assign echoed_o = state_q == Echo && message_ends;
  assign completed_o = state_q == Checksum && give;
  assign status_ready_o = completed_o;
  // A clock after the status, when the core's counters of time hold.
  assign done_o = ended_q && !reported_q;

  always_comb begin
    unique case (state_q)
      Header: word_o = header;
      Words: word_o = fifo_word;
      Checksum: word_o = completion.checksum;
      default: word_o = message[32*place_q +: 32];
    endcase
  end

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      Idle: begin
        if (begin_chunk) state_d = Header;
        else if (last) state_d = Completion;
        else if (echo_i) state_d = Echo;
      end
      Header: if (give) state_d = Words;
      Words: if (give && count_q == CountBits'(1)) state_d = Idle;
      Completion: if (message_ends) state_d = Sum;
      Sum: state_d = Checksum; // the last word is added
      Checksum: if (give) state_d = Idle;
      Echo: if (message_ends) state_d = Idle;
      default: state_d = Idle;
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (begin_chunk) count_q <= count;
    else if (state_q == Words && give) count_q <= count_q - 1'b1;
    if (!running_i) sum_q <= '0;
    else if (sum_given_q) sum_q <= {sum_q[30:0], sum_q[31]} + given_q;
    sum_given_q <= give && state_q != Header;
    given_q <= word_o;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
      have_q <= '0;
      place_q <= '0;
      ended_q <= 1'b0;
      reported_q <= 1'b0;
    end else begin
      state_q <= state_d;
      have_q <= have_q + HaveBits'(push) - (begin_chunk ? HaveBits'(count) : '0);
      if (state_q == Idle) place_q <= '0;
      else if (give) place_q <= place_q + 1'b1;
      ended_q <= ended && !completed_o;
      reported_q <= ended_q;
    end
  end

endmodule
