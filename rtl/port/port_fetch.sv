// SPDX-License-Identifier: Apache-2.0
// All that the PCI port reads of a job: its descriptor in the ring, its slot table, the lists of
// its stream and response, its stream.
//
//   ring -> slots --------> core's slot table
//    |---> list -> read --> core's stream
//    |---> list ----------> pages for the response
//
// All of them share one channel of reads (host_read).
module port_fetch #(
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
  output logic                         idle_o,

  // the next job, read ahead
  input  logic                         failed_i,              // the host refused some of it
  output logic                         next_valid_o,          // its descriptor is here
  output logic [31:0]                  next_sequence_o,
  output logic                         listed_o,              // the stream's list is read for it

  // the current job
  output logic                         current_o,
  output logic [7:0]                   entry_o,               // in the ring
  output logic [31:0]                  sequence_o,
  input  logic                         done_i,

  // core
  output logic                         slot_write_o,
  output logic [3:0]                   slot_index_o,
  output logic [31:0]                  slot_base_o,
  output logic [31:0]                  slot_size_o,
  output logic [1:0]                   slot_rights_o,
  output logic                         job_valid_o,
  input  logic                         job_ready_i,
  output logic [31:0]                  job_stream_words_o,
  output logic [31:0]                  job_response_words_o,
  output logic                         stream_valid_o,
  input  logic                         stream_ready_i,
  output logic [StreamBits-1:0]        stream_data_o,
  output logic [2:0]                   stream_taken_o,

  // pages for the response
  input  logic                         response_request_i,    // there is some
  input  logic                         response_list_stop_i,
  output logic                         response_list_empty_o,
  output logic                         response_page_valid_o,
  input  logic                         response_page_ready_i,
  output logic [63:12]                 response_page_o,

  // refused reads: for the next job, for the stream's list, for the current job
  output logic                         ahead_error_o,
  output logic                         list_error_o,
  output logic                         current_error_o,
  output logic [63:0]                  error_address_o,

  // host reads
  output logic                         arvalid_o,
  input  logic                         arready_i,
  output logic [63:0]                  araddr_o,
  output logic [7:0]                   arlen_o,
  input  logic                         rvalid_i,
  output logic                         rready_o,
  input  logic [StreamBits-1:0]        rdata_i,
  input  logic                         rlast_i,
  input  logic [1:0]                   rresp_i
);

  // Who reads, the first first.
  localparam int unsigned Readers = 5;
  localparam int unsigned StreamList = 0;
  localparam int unsigned ResponseList = 1;
  localparam int unsigned Ring = 2;
  localparam int unsigned SlotTable = 3;
  localparam int unsigned Stream = 4;
  localparam logic [7:0] DescriptorLength = 8'(512 / StreamBits - 1);
  localparam logic [7:0] SlotsLength = 8'(512 / StreamBits - 1);
  localparam logic [7:0] EntryLength = StreamBits == 32 ? 8'd1 : 8'd0;

  // ring
  // Low bits of addresses are taken as zero.
  // verilator lint_off UNUSEDSIGNAL
  gloss_pkg::job_descriptor_t job;
  // verilator lint_on UNUSEDSIGNAL
  logic load, loaded, list_start, start, copied;

  // the stream's list
  logic stream_list_idle, stream_list_drained;
  logic stream_page_valid, stream_page_ready;
  logic [63:12] stream_page;

  // host reads
  logic [Readers-1:0] read_valid, read_ready, beat_valid, read_error;
  logic [64*Readers-1:0] read_address;
  logic [8*Readers-1:0] read_length;
  logic beat_last;
  logic [StreamBits-1:0] beat_data;

  assign job_stream_words_o = job.stream_words;
  assign job_response_words_o = job.response_words;
  assign next_sequence_o = job.sequence_;
  assign ahead_error_o = read_error[Ring] || read_error[SlotTable];
  assign list_error_o = read_error[StreamList];
  assign current_error_o = read_error[ResponseList] || read_error[Stream];

  port_ring #(
    .StreamBits(StreamBits)
  ) u_ring (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .enable_i      (enable_i),
    .ring_i        (ring_i),
    .ring_log2_i   (ring_log2_i),
    .tail_i        (tail_i),
    .head_o        (head_o),
    .idle_o        (idle_o),
    .read_valid_o  (read_valid[Ring]),
    .read_ready_i  (read_ready[Ring]),
    .read_address_o(read_address[64*Ring+6 +: 58]),
    .beat_valid_i  (beat_valid[Ring]),
    .beat_last_i   (beat_last),
    .beat_data_i   (beat_data),
    .job_o         (job),
    .failed_i      (failed_i),
    .next_valid_o  (next_valid_o),
    .listed_o      (listed_o),
    .load_o        (load),
    .loaded_i      (loaded),
    .list_o        (list_start),
    .list_idle_i   (stream_list_idle),
    .list_drained_i(stream_list_drained),
    .start_o       (start),
    .copied_i      (copied),
    .job_valid_o   (job_valid_o),
    .job_ready_i   (job_ready_i),
    .current_o     (current_o),
    .entry_o       (entry_o),
    .sequence_o    (sequence_o),
    .done_i        (done_i)
  );
  assign read_address[64*Ring +: 6] = '0;
  assign read_length[8*Ring +: 8] = DescriptorLength;

  port_slots #(
    .StreamBits(StreamBits)
  ) u_slots (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .load_i        (load),
    .table_i       ({job.slot_table_high, job.slot_table_low[31:6]}),
    .loaded_o      (loaded),
    .copy_i        (start),
    .copied_o      (copied),
    .read_valid_o  (read_valid[SlotTable]),
    .read_ready_i  (read_ready[SlotTable]),
    .read_address_o(read_address[64*SlotTable+6 +: 58]),
    .beat_valid_i  (beat_valid[SlotTable]),
    .beat_data_i   (beat_data),
    .slot_write_o  (slot_write_o),
    .slot_index_o  (slot_index_o),
    .slot_base_o   (slot_base_o),
    .slot_size_o   (slot_size_o),
    .slot_rights_o (slot_rights_o)
  );
  assign read_address[64*SlotTable +: 6] = '0;
  assign read_length[8*SlotTable +: 8] = SlotsLength;

  port_list #(
    .StreamBits(StreamBits)
  ) u_stream_list (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .start_i       (list_start),
    .list_i        ({job.stream_list_high, job.stream_list_low[31:3]}),
    .words_i       (job.stream_words),
    .request_i     (1'b1),
    .stop_i        (1'b0),
    .idle_o        (stream_list_idle),
    .drained_o     (stream_list_drained),
    /* verilator lint_off PINCONNECTEMPTY */
    .empty_o       (), // a stream takes all of its pages
    /* verilator lint_on PINCONNECTEMPTY */
    .read_valid_o  (read_valid[StreamList]),
    .read_ready_i  (read_ready[StreamList]),
    .read_address_o(read_address[64*StreamList+3 +: 61]),
    .beat_valid_i  (beat_valid[StreamList]),
    .beat_last_i   (beat_last),
    .beat_data_i   (beat_data),
    .page_valid_o  (stream_page_valid),
    .page_ready_i  (stream_page_ready),
    .page_o        (stream_page)
  );
  assign read_address[64*StreamList +: 3] = '0;
  assign read_length[8*StreamList +: 8] = EntryLength;

  port_list #(
    .StreamBits(StreamBits)
  ) u_response_list (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .start_i       (start),
    .list_i        ({job.response_list_high, job.response_list_low[31:3]}),
    .words_i       (job.response_words),
    .request_i     (response_request_i),
    .stop_i        (response_list_stop_i),
    /* verilator lint_off PINCONNECTEMPTY */
    .idle_o        (),
    .drained_o     (), // empty says more, and it is never read ahead
    /* verilator lint_on PINCONNECTEMPTY */
    .empty_o       (response_list_empty_o),
    .read_valid_o  (read_valid[ResponseList]),
    .read_ready_i  (read_ready[ResponseList]),
    .read_address_o(read_address[64*ResponseList+3 +: 61]),
    .beat_valid_i  (beat_valid[ResponseList]),
    .beat_last_i   (beat_last),
    .beat_data_i   (beat_data),
    .page_valid_o  (response_page_valid_o),
    .page_ready_i  (response_page_ready_i),
    .page_o        (response_page_o)
  );
  assign read_address[64*ResponseList +: 3] = '0;
  assign read_length[8*ResponseList +: 8] = EntryLength;

  port_read #(
    .StreamBits(StreamBits)
  ) u_read (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .start_i       (start),
    .words_i       (job.stream_words),
    .page_valid_i  (stream_page_valid),
    .page_ready_o  (stream_page_ready),
    .page_i        (stream_page),
    .read_valid_o  (read_valid[Stream]),
    .read_ready_i  (read_ready[Stream]),
    .read_address_o(read_address[64*Stream+8 +: 56]),
    .read_length_o (read_length[8*Stream +: 8]),
    .beat_valid_i  (beat_valid[Stream]),
    .beat_data_i   (beat_data),
    .stream_valid_o(stream_valid_o),
    .stream_ready_i(stream_ready_i),
    .stream_data_o (stream_data_o),
    .taken_o       (stream_taken_o)
  );
  assign read_address[64*Stream +: 8] = '0;

  port_host_read #(
    .StreamBits(StreamBits),
    .Readers   (Readers)
  ) u_host_read (
    .clk_i          (clk_i),
    .rst_ni         (rst_ni),
    .valid_i        (read_valid),
    .ready_o        (read_ready),
    .address_i      (read_address),
    .length_i       (read_length),
    .beat_valid_o   (beat_valid),
    .beat_last_o    (beat_last),
    .beat_data_o    (beat_data),
    .error_o        (read_error),
    .error_address_o(error_address_o),
    .arvalid_o      (arvalid_o),
    .arready_i      (arready_i),
    .araddr_o       (araddr_o),
    .arlen_o        (arlen_o),
    .rvalid_i       (rvalid_i),
    .rready_o       (rready_o),
    .rdata_i        (rdata_i),
    .rlast_i        (rlast_i),
    .rresp_i        (rresp_i)
  );

endmodule
