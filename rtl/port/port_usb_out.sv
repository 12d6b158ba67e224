// SPDX-License-Identifier: Apache-2.0
// The OUT channel: a usb_sync is looked for, then jobs are taken apart: their slots, those not sent
// as empty ones, and their stream go to the core, their checksum is compared. A word that no job
// begins or ends with ends that; what comes behind it is dropped. With a wrong checksum that is
// when the core has ended the job, whose status it keeps.
//
// A window of the last four words is all there is of a message. A usb_sync is seen in it, an entry
// of a slot table is written from it, and its newest words are the beat for the core: 32-bit words
// in, beats of StreamBits out, a word a clock. What a stream's last beat has behind its words is
// whatever pads it.
module port_usb_out #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  input  logic                  word_valid_i,
  output logic                  word_ready_o,
  input  logic [31:0]           word_i,

  // registers
  input  logic [31:0]           nonce_i,
  output logic                  idle_o,
  output logic                  running_o,
  output logic                  lost_o,
  output logic                  lost_event_o,
  output logic [2:0]            taken_o,        // words of the stream the core takes in this clock

  // to port_usb_in
  output logic                  echo_o,
  output gloss_pkg::usb_sync_t  sync_o,
  input  logic                  echoed_i,
  output logic [31:0]           sequence_o,
  output logic                  checked_o,      // the job's checksum was there, and right
  input  logic                  completed_i,

  // core
  output logic                  slot_write_o,
  output logic [3:0]            slot_index_o,
  output logic [31:0]           slot_base_o,
  output logic [31:0]           slot_size_o,
  output logic [1:0]            slot_rights_o,
  output logic                  job_valid_o,
  input  logic                  job_ready_i,
  input  logic                  job_ended_i,
  output logic [31:0]           job_stream_words_o,
  output logic [31:0]           job_response_words_o,
  output logic                  stream_valid_o,
  input  logic                  stream_ready_i,
  output logic [StreamBits-1:0] stream_data_o
);

  localparam int unsigned Lanes = StreamBits / 32;

  typedef enum logic [2:0] {Search, Echo, Idle, Head, Slots, Start, Run, Lost} state_e;

  state_e state_d, state_q;
  logic take, shift;

  logic [127:0] window_q;
  logic [1:0] place_q, lane;    // where the next word of a message, of a beat is
  logic fourth;
  logic synchronised_q;         // by the word that came last

  // Only its first word is seen as such.
  // verilator lint_off UNUSEDSIGNAL
  gloss_pkg::usb_job_t head;
  // verilator lint_on UNUSEDSIGNAL
  logic head_right, head_wrong_q;   // by the word that came last
  logic [4:0] slots_q, index_q;
  logic slot_sent, slot_next, slot_write_q, slot_sent_q;
  // verilator lint_off UNUSEDSIGNAL
  gloss_pkg::slot_entry_t entry;
  // verilator lint_on UNUSEDSIGNAL

  logic [31:0] sequence_q, room_q;
  logic [31:0] left_q;          // of the stream, not in the window
  logic more_q;                 // left_q is not 0
  logic pad, move, beat_ends, beat_q;
  logic [2:0] words_q;          // of the stream that are in the beat

  logic [31:0] sum_q;
  logic last;                   // the next word is the job's usb_job_end
  logic ended_q, right_q, wrong;

  assign shift = (take && !last) || pad;
  assign take = word_valid_i && word_ready_o;
  assign fourth = take && place_q == '1;

  // ---- usb_sync ----
  assign sync_o = window_q;
  assign echo_o = state_q == Echo;

  // ---- usb_job ----
  assign head = {96'd0, word_i};
  assign head_right = {8'd0, head.mark} == gloss_pkg::UsbJobMagic && head.reserved_0 == '0 &&
                      head.slots <= 5'(gloss_pkg::Slots);
  assign sequence_o = sequence_q;

  // ---- slots ----
  assign slot_sent = index_q < slots_q;
  assign slot_next = state_q == Slots && (!slot_sent || fourth);
  assign entry = window_q;
  assign slot_write_o = slot_write_q;
  assign slot_index_o = 4'(index_q - 1'b1);
  // Nothing of a base's low bits reaches the core: the bursts of its memory port rely on it.
  assign slot_base_o = slot_sent_q ? {entry.base[31:12], 12'd0} : '0;
  assign slot_size_o = slot_sent_q ? entry.size : '0;
  assign slot_rights_o = slot_sent_q ? entry.rights : gloss_pkg::RIGHTS_NONE;

  // ---- stream ----
  assign job_valid_o = state_q == Start && !slot_write_q; // the last slot is written in Start
  assign job_stream_words_o = left_q;
  assign job_response_words_o = room_q;
  assign lane = place_q & 2'(Lanes - 1);
  assign move = state_q == Run && (!beat_q || stream_ready_i);
  assign pad = move && !more_q && lane != '0;
  assign beat_ends = lane == 2'(Lanes - 1);
  assign stream_valid_o = beat_q;
  assign stream_data_o = window_q[127 -: StreamBits];
  assign taken_o = beat_q && stream_ready_i ? words_q : '0;

  // ---- usb_job_end ----
  // It does not enter the window: the core may not have taken the last beat.
  assign last = state_q == Run && !more_q;
  assign checked_o = right_q;
  assign wrong = ended_q && !right_q && job_ended_i;

  assign idle_o = state_q == Search || state_q == Lost || (state_q == Idle && !word_valid_i);
  assign running_o = state_q == Run;
  assign lost_o = state_q == Lost;
  assign lost_event_o = (state_q == Head && head_wrong_q) || (state_q == Run && wrong);

  always_comb begin
    state_d = state_q;
    word_ready_o = 1'b0;
    unique case (state_q)
      Search: begin
        word_ready_o = !synchronised_q;
        if (synchronised_q) state_d = Echo;
      end
      Echo: if (echoed_i) state_d = Idle;
      Idle: begin
        word_ready_o = 1'b1;
        if (word_valid_i) state_d = Head;
      end
      Head: begin
        word_ready_o = !head_wrong_q;
        if (head_wrong_q) state_d = Lost;
        else if (fourth) state_d = Slots;
      end
      Slots: begin
        word_ready_o = slot_sent;
        if (slot_next && index_q == 5'(gloss_pkg::Slots - 1)) state_d = Start;
      end
      Start: if (job_valid_o && job_ready_i) state_d = Run;
      Run: begin
        word_ready_o = more_q ? move : !ended_q;
        if (wrong) state_d = Lost;
        else if (completed_i) state_d = Idle;
      end
      Lost: word_ready_o = 1'b1;
      default: state_d = Search;
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (state_q == Idle) slots_q <= head.slots;
    // The last time it is with the fourth word before it.
    if (state_q == Head) begin
      sequence_q <= window_q[95:64];
      room_q <= word_i;
      left_q <= window_q[127:96];
      more_q <= window_q[127:96] != '0;
    end else if (state_q == Run && take && !last) begin
      left_q <= left_q - 1'b1;
      more_q <= left_q != 32'd1;
    end
    if (shift) words_q <= (lane == '0 ? '0 : words_q) + 3'(!pad);
    // From the third word on.
    if (state_q == Idle || (state_q == Head && !place_q[1])) sum_q <= '0;
    else if (take) sum_q <= {sum_q[30:0], sum_q[31]} + word_i;
    slot_sent_q <= slot_sent;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Search;
      window_q <= '0;
      synchronised_q <= 1'b0;
      head_wrong_q <= 1'b0;
      place_q <= '0;
      index_q <= '0;
      slot_write_q <= 1'b0;
      beat_q <= 1'b0;
      ended_q <= 1'b0;
      right_q <= 1'b0;
    end else begin
      state_q <= state_d;
      if (shift) window_q <= {word_i, window_q[127:32]};
      head_wrong_q <= state_q == Idle && take && !head_right;
      synchronised_q <= take && nonce_i != '0 &&
                        {word_i, window_q[127:32]} ==
                        {~gloss_pkg::UsbSyncMagic, ~nonce_i, nonce_i, gloss_pkg::UsbSyncMagic};
      if (state_q == Idle) place_q <= 2'(take);
      else if (shift) place_q <= place_q + 1'b1;
      if (state_q == Head) index_q <= '0;
      else if (slot_next) index_q <= index_q + 1'b1;
      slot_write_q <= slot_next;
      if (state_q == Run && shift) beat_q <= beat_ends;
      else if (stream_ready_i) beat_q <= 1'b0;
      if (state_q != Run) begin
        ended_q <= 1'b0;
        right_q <= 1'b0;
      end else if (last && take) begin
        ended_q <= 1'b1;
        right_q <= word_i == sum_q;
      end
    end
  end

endmodule
