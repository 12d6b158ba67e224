// SPDX-License-Identifier: Apache-2.0
// A USB board: the port and the core. A real board's USB bridge stands at reg_*, out_*, in_* and
// event_*, its memory controller at axi_*; the virtual board has both in software. All in one clock
// domain.
module board_usb #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32,
  parameter int unsigned TimeCounters = 1   // 0: none of the registers of clocks and stalls
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  input  logic [31:0]                  memory_pages_i,  // of board memory; constant

  input  logic                         reg_valid_i,
  output logic                         reg_ready_o,
  input  logic                         reg_write_i,
  input  logic [15:0]                  reg_addr_i,
  input  logic [31:0]                  reg_wdata_i,
  output logic [31:0]                  reg_rdata_o,

  input  logic                         out_valid_i,
  output logic                         out_ready_o,
  input  logic [31:0]                  out_data_i,
  output logic                         in_valid_o,
  input  logic                         in_ready_i,
  output logic [31:0]                  in_data_o,
  output logic                         in_flush_o,
  output logic                         event_valid_o,
  input  logic                         event_ready_i,
  output gloss_pkg::usb_event_t        event_o,

  // AXI4 master to board memory
  output logic                         axi_awvalid_o,
  input  logic                         axi_awready_i,
  output logic [31:0]                  axi_awaddr_o,
  output logic [7:0]                   axi_awlen_o,
  output logic                         axi_wvalid_o,
  input  logic                         axi_wready_i,
  output logic [32*PixelsPerClock-1:0] axi_wdata_o,
  output logic [4*PixelsPerClock-1:0]  axi_wstrb_o,
  output logic                         axi_wlast_o,
  input  logic                         axi_bvalid_i,
  output logic                         axi_bready_o,
  input  logic [1:0]                   axi_bresp_i,
  output logic                         axi_arvalid_o,
  input  logic                         axi_arready_i,
  output logic [31:0]                  axi_araddr_o,
  output logic [7:0]                   axi_arlen_o,
  input  logic                         axi_rvalid_i,
  output logic                         axi_rready_o,
  input  logic [32*PixelsPerClock-1:0] axi_rdata_i,
  input  logic                         axi_rlast_i,
  input  logic [1:0]                   axi_rresp_i
);

  // port and core
  logic core_rst_n, slot_write, job_valid, job_ready, status_valid, status_ready;
  logic stream_valid, stream_ready, response_valid, response_ready;
  logic [3:0] slot_index, response_count;
  logic [31:0] slot_base, slot_size, job_stream_words, job_response_words;
  logic [1:0] slot_rights;
  gloss_pkg::status_t status;
  gloss_pkg::time_counters_t time_counters;
  logic [StreamBits-1:0] stream_data;
  logic [32*PixelsPerClock-1:0] response_data;
  logic memory_stop, memory_stopped, memory_idle;

  port_usb #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits),
    .TimeCounters  (TimeCounters)
  ) u_port (
    .clk_i               (clk_i),
    .rst_ni              (rst_ni),
    .memory_pages_i      (memory_pages_i),
    .reg_valid_i         (reg_valid_i),
    .reg_ready_o         (reg_ready_o),
    .reg_write_i         (reg_write_i),
    .reg_addr_i          (reg_addr_i),
    .reg_wdata_i         (reg_wdata_i),
    .reg_rdata_o         (reg_rdata_o),
    .out_valid_i         (out_valid_i),
    .out_ready_o         (out_ready_o),
    .out_data_i          (out_data_i),
    .in_valid_o          (in_valid_o),
    .in_ready_i          (in_ready_i),
    .in_data_o           (in_data_o),
    .in_flush_o          (in_flush_o),
    .event_valid_o       (event_valid_o),
    .event_ready_i       (event_ready_i),
    .event_o             (event_o),
    .core_rst_no         (core_rst_n),
    .slot_write_o        (slot_write),
    .slot_index_o        (slot_index),
    .slot_base_o         (slot_base),
    .slot_size_o         (slot_size),
    .slot_rights_o       (slot_rights),
    .job_valid_o         (job_valid),
    .job_ready_i         (job_ready),
    .job_stream_words_o  (job_stream_words),
    .job_response_words_o(job_response_words),
    .status_valid_i      (status_valid),
    .status_ready_o      (status_ready),
    .status_i            (status),
    .time_i              (time_counters),
    .stream_valid_o      (stream_valid),
    .stream_ready_i      (stream_ready),
    .stream_data_o       (stream_data),
    .response_valid_i    (response_valid),
    .response_ready_o    (response_ready),
    .response_count_i    (response_count),
    .response_data_i     (response_data),
    .memory_stop_o       (memory_stop),
    .memory_stopped_i    (memory_stopped),
    .memory_idle_i       (memory_idle)
  );

  board_core #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits),
    .TimeCounters  (TimeCounters)
  ) u_core (
    .clk_i               (clk_i),
    .rst_ni              (rst_ni),
    .core_rst_ni         (core_rst_n),
    .slot_write_i        (slot_write),
    .slot_index_i        (slot_index),
    .slot_base_i         (slot_base),
    .slot_size_i         (slot_size),
    .slot_rights_i       (slot_rights),
    .job_valid_i         (job_valid),
    .job_ready_o         (job_ready),
    .job_stream_words_i  (job_stream_words),
    .job_response_words_i(job_response_words),
    .status_valid_o      (status_valid),
    .status_ready_i      (status_ready),
    .status_o            (status),
    .time_o              (time_counters),
    .stream_valid_i      (stream_valid),
    .stream_ready_o      (stream_ready),
    .stream_data_i       (stream_data),
    .response_valid_o    (response_valid),
    .response_ready_i    (response_ready),
    .response_count_o    (response_count),
    .response_data_o     (response_data),
    .memory_stop_i       (memory_stop),
    .memory_stopped_o    (memory_stopped),
    .memory_idle_o       (memory_idle),
    .axi_awvalid_o       (axi_awvalid_o),
    .axi_awready_i       (axi_awready_i),
    .axi_awaddr_o        (axi_awaddr_o),
    .axi_awlen_o         (axi_awlen_o),
    .axi_wvalid_o        (axi_wvalid_o),
    .axi_wready_i        (axi_wready_i),
    .axi_wdata_o         (axi_wdata_o),
    .axi_wstrb_o         (axi_wstrb_o),
    .axi_wlast_o         (axi_wlast_o),
    .axi_bvalid_i        (axi_bvalid_i),
    .axi_bready_o        (axi_bready_o),
    .axi_bresp_i         (axi_bresp_i),
    .axi_arvalid_o       (axi_arvalid_o),
    .axi_arready_i       (axi_arready_i),
    .axi_araddr_o        (axi_araddr_o),
    .axi_arlen_o         (axi_arlen_o),
    .axi_rvalid_i        (axi_rvalid_i),
    .axi_rready_o        (axi_rready_o),
    .axi_rdata_i         (axi_rdata_i),
    .axi_rlast_i         (axi_rlast_i),
    .axi_rresp_i         (axi_rresp_i)
  );

endmodule
