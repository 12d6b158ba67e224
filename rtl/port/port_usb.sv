// SPDX-License-Identifier: Apache-2.0
// The USB port: jobs on one channel of 32-bit words, their answers on another, as gloss.xml
// describes it, in front of the core.
//
//   OUT -> FIFO -> out ---> core's slot table, job and stream
//   IN  <--------- in <---- core's response and status
//   registers, events
//
// The next job's words wait in the FIFO while one runs. The bridge on the other side knows nothing
// of messages: it turns words into transfers and back. in_flush_o with a word tells it to send what
// it has; what it holds is not the port's. It has its own way to the registers, which does not wait
// for the channels; gloss.xml says what else it has to do. A USB core that makes FIFOs of its
// endpoints is one; a FIFO chip that answers control transfers itself is none.
//
// CONTROL.reset resets all but the registers' access, and the core; whoever stands before the
// core's memory stops and lets go as port_gate does (memory_*). From the clock after it was written
// until it reads 0 no word passes; one that was offered on IN, or an event, is taken back.
module port_usb #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32,
  parameter int unsigned TimeCounters = 1   // 0: none of the registers of clocks and stalls
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // what the board has behind the core; constant
  input  logic [31:0]                  memory_pages_i,

  // registers: valid and the rest stay until ready
  input  logic                         reg_valid_i,
  output logic                         reg_ready_o,
  input  logic                         reg_write_i,
  input  logic [15:0]                  reg_addr_i,
  input  logic [31:0]                  reg_wdata_i,
  output logic [31:0]                  reg_rdata_o,

  // channels and events
  input  logic                         out_valid_i,
  output logic                         out_ready_o,
  input  logic [31:0]                  out_data_i,
  output logic                         in_valid_o,
  input  logic                         in_ready_i,
  output logic [31:0]                  in_data_o,
  output logic                         in_flush_o,    // this word ends a burst
  output logic                         event_valid_o,
  input  logic                         event_ready_i,
  output gloss_pkg::usb_event_t        event_o,

  // core
  output logic                         core_rst_no,
  output logic                         slot_write_o,
  output logic [3:0]                   slot_index_o,
  output logic [31:0]                  slot_base_o,
  output logic [31:0]                  slot_size_o,
  output logic [1:0]                   slot_rights_o,
  output logic                         job_valid_o,
  input  logic                         job_ready_i,
  output logic [31:0]                  job_stream_words_o,
  output logic [31:0]                  job_response_words_o,
  input  logic                         status_valid_i,
  output logic                         status_ready_o,
  input  gloss_pkg::status_t           status_i,
  input  gloss_pkg::time_counters_t    time_i,
  output logic                         stream_valid_o,
  input  logic                         stream_ready_i,
  output logic [StreamBits-1:0]        stream_data_o,
  input  logic                         response_valid_i,
  output logic                         response_ready_o,
  input  logic [3:0]                   response_count_i,
  input  logic [32*PixelsPerClock-1:0] response_data_i,

  // the gate before the core's memory
  output logic                         memory_stop_o,
  input  logic                         memory_stopped_i,
  input  logic                         memory_idle_i
);

  core_parameters #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits),
    .TimeCounters  (TimeCounters)
  ) u_parameters ();

  localparam int unsigned OutWords = 512;
  localparam int unsigned Events = 4;

  // reset
  logic reset, resetting, core_rst_n;

  // registers
  logic reg_write, idle, running, lost, lost_event, done, fault;
  logic [15:0] reg_address;
  logic [31:0] nonce_q, boot_q, own, current_sequence;
  logic [2:0] stream_taken;
  logic [3:0] response_taken;

  // channels
  logic fifo_ready, word_valid, word_ready, in_valid;
  logic [31:0] word;
  logic echo, echoed, checked, completed;
  gloss_pkg::usb_sync_t sync;

  // events
  logic event_valid;
  logic [3:0] event_cause;
  logic event_lost;
  logic [31:0] event_sequence;

  assign core_rst_no = core_rst_n;

  port_reset u_reset (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .request_i(reset),
    .busy_o   (resetting),
    .stop_o   (memory_stop_o),
    .stopped_i(memory_stopped_i),
    .idle_i   (memory_idle_i),
    .rst_no   (core_rst_n)
  );

  port_registers #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .TimeCounters  (TimeCounters)
  ) u_registers (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .core_rst_ni     (core_rst_n),
    .reg_valid_i     (reg_valid_i),
    .reg_ready_o     (reg_ready_o),
    .reg_write_i     (reg_write_i),
    .reg_addr_i      (reg_addr_i),
    .reg_wdata_i     (reg_wdata_i),
    .reg_rdata_o     (reg_rdata_o),
    .memory_pages_i  (memory_pages_i),
    .write_o         (reg_write),
    .address_o       (reg_address),
    .own_i           (own),
    .reset_o         (reset),
    .resetting_i     (resetting),
    .enable_i        (1'b0),
    .running_i       (running),
    .idle_i          (idle),
    .dma_error_i     (1'b0),
    .lost_i          (lost),
    .done_i          (done),
    .status_i        (status_i),
    .sequence_i      (current_sequence),
    .time_i          (time_i),
    .fault_o         (fault),
    .stream_taken_i  (stream_taken),
    .response_taken_i(response_taken),
    .dma_event_i     (1'b0),
    .dma_sequence_i  ('0)
  );

  always_comb begin
    unique case (reg_address)
      gloss_pkg::REG_NONCE: own = nonce_q;
      gloss_pkg::REG_BOOT:  own = boot_q;
      default:              own = '0;
    endcase
  end

  // Not reset by CONTROL.reset.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) boot_q <= '0;
    else if (reg_write && reg_address == gloss_pkg::REG_BOOT) boot_q <= reg_wdata_i;
  end

  always_ff @(posedge clk_i or negedge core_rst_n) begin
    if (!core_rst_n) nonce_q <= '0;
    else if (reg_write && reg_address == gloss_pkg::REG_NONCE) nonce_q <= reg_wdata_i;
  end

  // ---- OUT ----
  assign out_ready_o = fifo_ready && !resetting;

  ram_fifo #(
    .Width(32),
    .Depth(OutWords)
  ) u_fifo (
    .clk_i  (clk_i),
    .rst_ni (core_rst_n),
    .valid_i(out_valid_i && !resetting),
    .ready_o(fifo_ready),
    .data_i (out_data_i),
    .valid_o(word_valid),
    .ready_i(word_ready),
    .data_o (word)
  );

  port_usb_out #(
    .StreamBits(StreamBits)
  ) u_out (
    .clk_i               (clk_i),
    .rst_ni              (core_rst_n),
    .word_valid_i        (word_valid),
    .word_ready_o        (word_ready),
    .word_i              (word),
    .nonce_i             (nonce_q),
    .idle_o              (idle),
    .running_o           (running),
    .lost_o              (lost),
    .lost_event_o        (lost_event),
    .taken_o             (stream_taken),
    .echo_o              (echo),
    .sync_o              (sync),
    .echoed_i            (echoed),
    .sequence_o          (current_sequence),
    .checked_o           (checked),
    .completed_i         (completed),
    .slot_write_o        (slot_write_o),
    .slot_index_o        (slot_index_o),
    .slot_base_o         (slot_base_o),
    .slot_size_o         (slot_size_o),
    .slot_rights_o       (slot_rights_o),
    .job_valid_o         (job_valid_o),
    .job_ready_i         (job_ready_i),
    .job_ended_i         (status_valid_i),
    .job_stream_words_o  (job_stream_words_o),
    .job_response_words_o(job_response_words_o),
    .stream_valid_o      (stream_valid_o),
    .stream_ready_i      (stream_ready_i),
    .stream_data_o       (stream_data_o)
  );

  // ---- IN ----
  assign in_valid_o = in_valid && !resetting;

  port_usb_in #(
    .PixelsPerClock(PixelsPerClock)
  ) u_in (
    .clk_i           (clk_i),
    .rst_ni          (core_rst_n),
    .echo_i          (echo),
    .sync_i          (sync),
    .echoed_o        (echoed),
    .sequence_i      (current_sequence),
    .running_i       (running),
    .checked_i       (checked),
    .completed_o     (completed),
    .response_valid_i(response_valid_i),
    .response_ready_o(response_ready_o),
    .response_count_i(response_count_i),
    .response_data_i (response_data_i),
    .status_valid_i  (status_valid_i),
    .status_ready_o  (status_ready_o),
    .status_i        (status_i),
    .taken_o         (response_taken),
    .done_o          (done),
    .word_valid_o    (in_valid),
    .word_ready_i    (in_ready_i && !resetting),
    .word_o          (in_data_o),
    .word_flush_o    (in_flush_o)
  );

  // ---- events ----
  assign event_valid_o = event_valid && !resetting;
  assign event_o = {event_sequence, 16'(gloss_pkg::UsbEventMagic), 11'd0, event_lost, event_cause};

  logic unused; // one that does not fit is dropped
  stream_fifo #(
    .Width($bits({event_lost, event_cause, event_sequence})),
    .Depth(Events)
  ) u_events (
    .clk_i  (clk_i),
    .rst_ni (core_rst_n),
    .valid_i(fault || lost_event),
    .ready_o(unused),
    .data_i (fault ? {1'b0, status_i.cause, current_sequence} : {1'b1, 4'd0, 32'd0}),
    .valid_o(event_valid),
    .ready_i(event_ready_i && !resetting),
    .data_o ({event_lost, event_cause, event_sequence})
  );

endmodule
