// SPDX-License-Identifier: Apache-2.0
// The job ring: reads the next job's descriptor as soon as TAIL covers it, has its slot table and
// its stream's list read ahead, and starts it when the job before has ended. A job is current from
// there until it has ended. What was read ahead is kept while enable is 0, and counts as nothing
// under way.
module port_ring #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // registers
  input  logic                         enable_i,
  input  logic [63:6]                  ring_i,
  input  logic [3:0]                   ring_log2_i,
  input  logic [15:0]                  tail_i,
  output logic [15:0]                  head_o,
  output logic                         idle_o,        // nothing begins until a register is written

  // host reads: descriptors
  output logic                         read_valid_o,
  input  logic                         read_ready_i,
  output logic [63:6]                  read_address_o,
  input  logic                         beat_valid_i,
  input  logic                         beat_last_i,
  input  logic [StreamBits-1:0]        beat_data_i,

  // the next job, read ahead
  // Low bits of addresses are taken as zero.
  // verilator lint_off UNUSEDSIGNAL
  output gloss_pkg::job_descriptor_t   job_o,
  // verilator lint_on UNUSEDSIGNAL
  input  logic                         failed_i,       // the host refused some of it
  output logic                         next_valid_o,   // its descriptor is here
  output logic                         listed_o,       // the stream's list is read for it
  output logic                         load_o,         // its slot table
  input  logic                         loaded_i,
  output logic                         list_o,         // begin the stream's list
  input  logic                         list_idle_i,
  input  logic                         list_drained_i,

  // start: the stream and the response's list begin, the slots are copied, the core gets it
  output logic                         start_o,
  input  logic                         copied_i,
  output logic                         job_valid_o,
  input  logic                         job_ready_i,

  // the current job
  output logic                         current_o,
  output logic [7:0]                   entry_o,        // in the ring
  output logic [31:0]                  sequence_o,
  input  logic                         done_i
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned BeatBits = $clog2(gloss_pkg::JOB_DESCRIPTOR_BITS / StreamBits);
  localparam int unsigned EntryBits = gloss_pkg::RingMaxLog2;

  typedef enum logic [2:0] {Idle, Request, Descriptor, Load, List, Ready, Copy, Offer} state_e;

  state_e state_d, state_q;
  logic [15:0] requested_q, head_q;   // jobs whose descriptor was requested; that have ended
  logic current_q;
  logic [31:0] sequence_q;
  logic [BeatBits-1:0] beat_q;
  logic [511:0] descriptor;
  logic [EntryBits-1:0] mask, request_entry;

  assign head_o = head_q;
  assign current_o = current_q;
  assign entry_o = head_q[EntryBits-1:0] & mask;
  assign sequence_o = sequence_q;
  assign job_o = descriptor;
  assign next_valid_o = state_q == List || state_q == Ready;
  assign listed_o = state_q == Ready;
  assign idle_o = !current_q && ((state_q == Idle && (!enable_i || requested_q == tail_i)) ||
                                  (state_q == Ready && !enable_i && loaded_i && list_drained_i));

  // More than RingMaxLog2 is the same as that.
  assign mask = ~({EntryBits{1'b1}} << ring_log2_i);
  assign read_valid_o = state_q == Request;
  assign request_entry = requested_q[EntryBits-1:0] & mask;
  assign read_address_o = ring_i + 58'(request_entry);

  assign load_o = state_q == Load && !failed_i;
  assign list_o = state_q == List && list_idle_i && !failed_i;
  assign start_o = state_q == Ready && loaded_i && !failed_i && enable_i && !current_q;
  assign job_valid_o = state_q == Offer;

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      Idle: if (enable_i && requested_q != tail_i) state_d = Request;
      Request: if (read_ready_i) state_d = Descriptor;
      Descriptor: if (beat_valid_i && beat_last_i) state_d = Load;
      Load: if (load_o) state_d = List;
      List: if (list_o) state_d = Ready;
      Ready: if (start_o) state_d = Copy;
      Copy: if (copied_i) state_d = Offer;
      Offer: if (job_ready_i) state_d = Idle;
      default: state_d = Idle;
    endcase
  end

  for (genvar w = 0; w < gloss_pkg::JOB_DESCRIPTOR_BITS / 32; w++) begin : gen_word
    if (gloss_pkg::JOB_DESCRIPTOR_RESERVED[32*w +: 32] == '1) begin : gen_none
      assign descriptor[32*w +: 32] = '0;
    end else begin : gen_kept
      logic [31:0] word_q;
      assign descriptor[32*w +: 32] = word_q;
      always_ff @(posedge clk_i)
        if (beat_valid_i && beat_q == BeatBits'(w / Lanes))
          word_q <= beat_data_i[32*(w%Lanes) +: 32];
    end
  end

  always_ff @(posedge clk_i) begin
    if (start_o) sequence_q <= job_o.sequence_;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
      requested_q <= '0;
      head_q <= '0;
      current_q <= 1'b0;
      beat_q <= '0;
    end else begin
      state_q <= state_d;
      if (read_valid_o && read_ready_i) requested_q <= requested_q + 1'b1;
      if (done_i) head_q <= head_q + 1'b1;
      current_q <= start_o || (current_q && !done_i);
      if (beat_valid_i) beat_q <= beat_q + 1'b1;
    end
  end

endmodule
