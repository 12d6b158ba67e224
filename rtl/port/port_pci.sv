// SPDX-License-Identifier: Apache-2.0
// The PCI port: a job ring in host memory, as gloss.xml describes it, in front of the core.
//
//   registers <-> fetch ------------------> core's slot table, stream
//                   |---> write <---------- core's response
//   registers <- complete <---------------- core's status
//
// While a job runs, the next one's descriptor, slot table and first pages of the stream's list are
// read ahead; the response's list is read when the core answers. All reads share one channel
// (fetch), writes the other (host_write); between them and the host stands a gate, so that
// everything behind it can be reset at any time. The same reset is the core's, and whoever stands
// before the core's memory stops and lets go as the gate does (memory_*).
//
// At the host: a descriptor is one burst, a slot table four of 64 bytes, a list entry one of 8
// bytes, pages are read and written in bursts that end on a multiple of 256 bytes or with the job,
// a completion is one. INCR, no IDs, answers in order, nothing crosses 4 KiB. Beats are of the full
// width and addresses multiples of it: an 8-byte entry comes with the one beside it where a beat
// has both.
module port_pci #(
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
  output logic                         irq_o,         // level
  output logic                         msi_valid_o,   // an MSI is due, for one event or several
  input  logic                         msi_ready_i,   // events

  // host AXI4 master
  output logic                         host_awvalid_o,
  input  logic                         host_awready_i,
  output logic [63:0]                  host_awaddr_o,
  output logic [7:0]                   host_awlen_o,
  output logic                         host_wvalid_o,
  input  logic                         host_wready_i,
  output logic [StreamBits-1:0]        host_wdata_o,
  output logic [StreamBits/8-1:0]      host_wstrb_o,
  output logic                         host_wlast_o,
  input  logic                         host_bvalid_i,
  output logic                         host_bready_o,
  input  logic [1:0]                   host_bresp_i,
  output logic                         host_arvalid_o,
  input  logic                         host_arready_i,
  output logic [63:0]                  host_araddr_o,
  output logic [7:0]                   host_arlen_o,
  input  logic                         host_rvalid_i,
  output logic                         host_rready_o,
  input  logic [StreamBits-1:0]        host_rdata_i,
  input  logic                         host_rlast_i,
  input  logic [1:0]                   host_rresp_i,

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

  // reset and errors
  logic reset, resetting, reset_stop, core_rst_n;
  logic gate_stopped, gate_idle;
  logic read_ahead_error, read_list_error, read_current_error;
  logic failed, error_stop, dma_error, dma_event;
  logic [63:0] read_error_address, write_error_address, dma_address;
  logic [31:0] dma_sequence;
  logic write_error;

  // registers
  logic reg_write, enable, idle, fault;
  logic [15:0] reg_address;
  logic [31:0] reg_own;
  logic [63:6] ring;
  logic [3:0] ring_log2;
  logic [15:0] tail, head;
  logic [63:4] records;

  // jobs
  logic ring_idle, next_valid, listed, current, done;
  logic [7:0] entry;
  logic [31:0] next_sequence, current_sequence;

  // host writes
  logic flush, written, pending, completion;
  logic response_list_stop, response_list_empty, response_page_valid, response_page_ready;
  logic [63:12] response_page;
  logic response_address_valid, response_address_ready, response_data_valid, response_data_ready;
  logic [63:8] response_address;
  logic [7:0] response_length, completion_length;
  logic [StreamBits-1:0] response_data, completion_data;
  logic [StreamBits/8-1:0] response_strobe;
  logic completion_address_valid, completion_address_ready;
  logic completion_data_valid, completion_data_ready;
  logic [63:4] completion_address;

  // to the gate
  logic awvalid, awready, wvalid, wready, bvalid, bready, arvalid, arready, rvalid, rready, rlast;
  logic [63:0] awaddr, araddr;
  logic [7:0] awlen, arlen;
  logic [StreamBits-1:0] wdata, rdata;
  logic [StreamBits/8-1:0] wstrb;
  logic [1:0] bresp, rresp;

  logic [2:0] stream_taken;
  logic [3:0] response_taken;

  assign core_rst_no = core_rst_n;
  assign memory_stop_o = reset_stop;
  assign idle = ring_idle && gate_idle && !error_stop;

  port_reset u_reset (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .request_i(reset),
    .busy_o   (resetting),
    .stop_o   (reset_stop),
    .stopped_i(gate_stopped && memory_stopped_i),
    .idle_i   (gate_idle && memory_idle_i),
    .rst_no   (core_rst_n)
  );

  port_registers #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .TimeCounters  (TimeCounters),
    .RingMaxLog2   (gloss_pkg::RingMaxLog2)
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
    .own_i           (reg_own),
    .reset_o         (reset),
    .resetting_i     (resetting),
    .enable_i        (enable),
    .running_i       (current && !error_stop),
    .idle_i          (idle),
    .dma_error_i     (dma_error),
    .lost_i          (1'b0),
    .done_i          (done),
    .status_i        (status_i),
    .sequence_i      (current_sequence),
    .time_i          (time_i),
    .fault_o         (fault),
    .stream_taken_i  (stream_taken),
    .response_taken_i(response_taken),
    .dma_event_i     (dma_event),
    .dma_sequence_i  (dma_sequence)
  );

  port_pci_registers u_pci_registers (
    .clk_i        (clk_i),
    .core_rst_ni  (core_rst_n),
    .write_i      (reg_write),
    .address_i    (reg_address),
    .wdata_i      (reg_wdata_i),
    .rdata_o      (reg_own),
    .resetting_i  (resetting),
    .irq_o        (irq_o),
    .msi_valid_o  (msi_valid_o),
    .msi_ready_i  (msi_ready_i),
    .enable_o     (enable),
    .ring_o       (ring),
    .ring_log2_o  (ring_log2),
    .tail_o       (tail),
    .head_i       (head),
    .records_o    (records),
    .done_i       (done),
    .fault_i      (fault),
    .dma_error_i  (dma_error),
    .dma_event_i  (dma_event),
    .dma_address_i(dma_address)
  );

  port_fetch #(
    .StreamBits(StreamBits)
  ) u_fetch (
    .clk_i                (clk_i),
    .rst_ni               (core_rst_n),
    .enable_i             (enable),
    .ring_i               (ring),
    .ring_log2_i          (ring_log2),
    .tail_i               (tail),
    .head_o               (head),
    .idle_o               (ring_idle),
    .failed_i             (failed),
    .next_valid_o         (next_valid),
    .next_sequence_o      (next_sequence),
    .listed_o             (listed),
    .current_o            (current),
    .entry_o              (entry),
    .sequence_o           (current_sequence),
    .done_i               (done),
    .slot_write_o         (slot_write_o),
    .slot_index_o         (slot_index_o),
    .slot_base_o          (slot_base_o),
    .slot_size_o          (slot_size_o),
    .slot_rights_o        (slot_rights_o),
    .job_valid_o          (job_valid_o),
    .job_ready_i          (job_ready_i),
    .job_stream_words_o   (job_stream_words_o),
    .job_response_words_o (job_response_words_o),
    .stream_valid_o       (stream_valid_o),
    .stream_ready_i       (stream_ready_i),
    .stream_data_o        (stream_data_o),
    .stream_taken_o       (stream_taken),
    .response_request_i   (response_valid_i || !written),
    .response_list_stop_i (response_list_stop),
    .response_list_empty_o(response_list_empty),
    .response_page_valid_o(response_page_valid),
    .response_page_ready_i(response_page_ready),
    .response_page_o      (response_page),
    .ahead_error_o        (read_ahead_error),
    .list_error_o         (read_list_error),
    .current_error_o      (read_current_error),
    .error_address_o      (read_error_address),
    .arvalid_o            (arvalid),
    .arready_i            (arready),
    .araddr_o             (araddr),
    .arlen_o              (arlen),
    .rvalid_i             (rvalid),
    .rready_o             (rready),
    .rdata_i              (rdata),
    .rlast_i              (rlast),
    .rresp_i              (rresp)
  );

  port_write #(
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits)
  ) u_write (
    .clk_i           (clk_i),
    .rst_ni          (core_rst_n),
    .response_valid_i(response_valid_i),
    .response_ready_o(response_ready_o),
    .response_count_i(response_count_i),
    .response_data_i (response_data_i),
    .taken_o         (response_taken),
    .flush_i         (flush),
    .empty_o         (written),
    .page_valid_i    (response_page_valid),
    .page_ready_o    (response_page_ready),
    .page_i          (response_page),
    .address_valid_o (response_address_valid),
    .address_ready_i (response_address_ready),
    .address_o       (response_address),
    .length_o        (response_length),
    .data_valid_o    (response_data_valid),
    .data_ready_i    (response_data_ready),
    .data_o          (response_data),
    .strobe_o        (response_strobe)
  );

  port_complete #(
    .StreamBits(StreamBits)
  ) u_complete (
    .clk_i          (clk_i),
    .rst_ni         (core_rst_n),
    .status_valid_i (status_valid_i),
    .status_ready_o (status_ready_o),
    .status_i       (status_i),
    .records_i      (records),
    .entry_i        (entry),
    .sequence_i     (current_sequence),
    .done_o         (done),
    .stop_i         (error_stop),
    .flush_o        (flush),
    .written_i      (written),
    .list_stop_o    (response_list_stop),
    .list_empty_i   (response_list_empty),
    .pending_i      (pending),
    .completion_o   (completion),
    .address_valid_o(completion_address_valid),
    .address_ready_i(completion_address_ready),
    .address_o      (completion_address),
    .length_o       (completion_length),
    .data_valid_o   (completion_data_valid),
    .data_ready_i   (completion_data_ready),
    .data_o         (completion_data)
  );

  port_host_write #(
    .StreamBits(StreamBits)
  ) u_host_write (
    .clk_i                     (clk_i),
    .rst_ni                    (core_rst_n),
    .completion_i              (completion),
    .response_address_valid_i  (response_address_valid),
    .response_address_ready_o  (response_address_ready),
    .response_address_i        (response_address),
    .response_length_i         (response_length),
    .response_data_valid_i     (response_data_valid),
    .response_data_ready_o     (response_data_ready),
    .response_data_i           (response_data),
    .response_strobe_i         (response_strobe),
    .completion_address_valid_i(completion_address_valid),
    .completion_address_ready_o(completion_address_ready),
    .completion_address_i      (completion_address),
    .completion_length_i       (completion_length),
    .completion_data_valid_i   (completion_data_valid),
    .completion_data_ready_o   (completion_data_ready),
    .completion_data_i         (completion_data),
    .pending_o                 (pending),
    .error_o                   (write_error),
    .error_address_o           (write_error_address),
    .awvalid_o                 (awvalid),
    .awready_i                 (awready),
    .awaddr_o                  (awaddr),
    .awlen_o                   (awlen),
    .wvalid_o                  (wvalid),
    .wready_i                  (wready),
    .wdata_o                   (wdata),
    .wstrb_o                   (wstrb),
    .bvalid_i                  (bvalid),
    .bready_o                  (bready),
    .bresp_i                   (bresp)
  );

  port_error u_error (
    .clk_i          (clk_i),
    .rst_ni         (core_rst_n),
    .ahead_i        (read_ahead_error),
    .list_i         (read_list_error),
    .current_error_i(read_current_error || write_error),
    .address_i      (write_error ? write_error_address : read_error_address),
    .current_i      (current),
    .listed_i       (listed),
    .next_valid_i   (next_valid),
    .sequence_i     (current_sequence),
    .next_sequence_i(next_sequence),
    .failed_o       (failed),
    .stop_o         (error_stop),
    .idle_i         (gate_idle),
    .reported_o     (dma_error),
    .event_o        (dma_event),
    .address_o      (dma_address),
    .sequence_o     (dma_sequence)
  );

  port_gate #(
    .AddressBits(64),
    .DataBits   (StreamBits)
  ) u_gate (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .stop_i          (reset_stop || error_stop),
    .stopped_o       (gate_stopped),
    .idle_o          (gate_idle),
    .master_awvalid_i(awvalid),
    .master_awready_o(awready),
    .master_awaddr_i (awaddr),
    .master_awlen_i  (awlen),
    .master_wvalid_i (wvalid),
    .master_wready_o (wready),
    .master_wdata_i  (wdata),
    .master_wstrb_i  (wstrb),
    .master_bvalid_o (bvalid),
    .master_bready_i (bready),
    .master_bresp_o  (bresp),
    .master_arvalid_i(arvalid),
    .master_arready_o(arready),
    .master_araddr_i (araddr),
    .master_arlen_i  (arlen),
    .master_rvalid_o (rvalid),
    .master_rready_i (rready),
    .master_rdata_o  (rdata),
    .master_rlast_o  (rlast),
    .master_rresp_o  (rresp),
    .axi_awvalid_o   (host_awvalid_o),
    .axi_awready_i   (host_awready_i),
    .axi_awaddr_o    (host_awaddr_o),
    .axi_awlen_o     (host_awlen_o),
    .axi_wvalid_o    (host_wvalid_o),
    .axi_wready_i    (host_wready_i),
    .axi_wdata_o     (host_wdata_o),
    .axi_wstrb_o     (host_wstrb_o),
    .axi_wlast_o     (host_wlast_o),
    .axi_bvalid_i    (host_bvalid_i),
    .axi_bready_o    (host_bready_o),
    .axi_bresp_i     (host_bresp_i),
    .axi_arvalid_o   (host_arvalid_o),
    .axi_arready_i   (host_arready_i),
    .axi_araddr_o    (host_araddr_o),
    .axi_arlen_o     (host_arlen_o),
    .axi_rvalid_i    (host_rvalid_i),
    .axi_rready_o    (host_rready_o),
    .axi_rdata_i     (host_rdata_i),
    .axi_rlast_i     (host_rlast_i),
    .axi_rresp_i     (host_rresp_i)
  );

endmodule
