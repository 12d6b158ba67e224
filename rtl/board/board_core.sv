// SPDX-License-Identifier: Apache-2.0
// What stands behind the port of any board: the core, and a gate before its memory. The core may be
// reset while it uses board memory: the gate brings what is under way there to its end, so that the
// memory controller need not be reset with it.
module board_core #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32,
  parameter int unsigned TimeCounters = 1   // 0: none of the registers of clocks and stalls
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // port
  input  logic                         core_rst_ni,
  input  logic                         slot_write_i,
  input  logic [3:0]                   slot_index_i,
  input  logic [31:0]                  slot_base_i,
  input  logic [31:0]                  slot_size_i,
  input  logic [1:0]                   slot_rights_i,
  input  logic                         job_valid_i,
  output logic                         job_ready_o,
  input  logic [31:0]                  job_stream_words_i,
  input  logic [31:0]                  job_response_words_i,
  output logic                         status_valid_o,
  input  logic                         status_ready_i,
  output gloss_pkg::status_t           status_o,
  output gloss_pkg::time_counters_t    time_o,
  input  logic                         stream_valid_i,
  output logic                         stream_ready_o,
  input  logic [StreamBits-1:0]        stream_data_i,
  output logic                         response_valid_o,
  input  logic                         response_ready_i,
  output logic [3:0]                   response_count_o,
  output logic [32*PixelsPerClock-1:0] response_data_o,
  input  logic                         memory_stop_i,
  output logic                         memory_stopped_o,
  output logic                         memory_idle_o,

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

  localparam int unsigned Width = 32 * PixelsPerClock;

  logic awvalid, awready, wvalid, wready, bvalid, bready, arvalid, arready, rvalid, rready, rlast;
  logic [31:0] awaddr, araddr;
  logic [7:0] awlen, arlen;
  logic [Width-1:0] wdata, rdata;
  logic [4*PixelsPerClock-1:0] wstrb;
  logic [1:0] bresp, rresp;

  gloss_core #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits),
    .TimeCounters  (TimeCounters)
  ) u_core (
    .clk_i               (clk_i),
    .rst_ni              (core_rst_ni),
    .slot_write_i        (slot_write_i),
    .slot_index_i        (slot_index_i),
    .slot_base_i         (slot_base_i),
    .slot_size_i         (slot_size_i),
    .slot_rights_i       (slot_rights_i),
    .job_valid_i         (job_valid_i),
    .job_ready_o         (job_ready_o),
    .job_stream_words_i  (job_stream_words_i),
    .job_response_words_i(job_response_words_i),
    .status_valid_o      (status_valid_o),
    .status_ready_i      (status_ready_i),
    .status_o            (status_o),
    .time_o              (time_o),
    .stream_valid_i      (stream_valid_i),
    .stream_ready_o      (stream_ready_o),
    .stream_data_i       (stream_data_i),
    .response_valid_o    (response_valid_o),
    .response_ready_i    (response_ready_i),
    .response_count_o    (response_count_o),
    .response_data_o     (response_data_o),
    .axi_awvalid_o       (awvalid),
    .axi_awready_i       (awready),
    .axi_awaddr_o        (awaddr),
    .axi_awlen_o         (awlen),
    .axi_wvalid_o        (wvalid),
    .axi_wready_i        (wready),
    .axi_wdata_o         (wdata),
    .axi_wstrb_o         (wstrb),
    /* verilator lint_off PINCONNECTEMPTY */
    .axi_wlast_o         (), // the gate makes its own
    /* verilator lint_on PINCONNECTEMPTY */
    .axi_bvalid_i        (bvalid),
    .axi_bready_o        (bready),
    .axi_bresp_i         (bresp),
    .axi_arvalid_o       (arvalid),
    .axi_arready_i       (arready),
    .axi_araddr_o        (araddr),
    .axi_arlen_o         (arlen),
    .axi_rvalid_i        (rvalid),
    .axi_rready_o        (rready),
    .axi_rdata_i         (rdata),
    .axi_rlast_i         (rlast),
    .axi_rresp_i         (rresp)
  );

  port_gate #(
    .AddressBits(32),
    .DataBits   (Width)
  ) u_gate (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .stop_i          (memory_stop_i),
    .stopped_o       (memory_stopped_o),
    .idle_o          (memory_idle_o),
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
    .axi_awvalid_o   (axi_awvalid_o),
    .axi_awready_i   (axi_awready_i),
    .axi_awaddr_o    (axi_awaddr_o),
    .axi_awlen_o     (axi_awlen_o),
    .axi_wvalid_o    (axi_wvalid_o),
    .axi_wready_i    (axi_wready_i),
    .axi_wdata_o     (axi_wdata_o),
    .axi_wstrb_o     (axi_wstrb_o),
    .axi_wlast_o     (axi_wlast_o),
    .axi_bvalid_i    (axi_bvalid_i),
    .axi_bready_o    (axi_bready_o),
    .axi_bresp_i     (axi_bresp_i),
    .axi_arvalid_o   (axi_arvalid_o),
    .axi_arready_i   (axi_arready_i),
    .axi_araddr_o    (axi_araddr_o),
    .axi_arlen_o     (axi_arlen_o),
    .axi_rvalid_i    (axi_rvalid_i),
    .axi_rready_o    (axi_rready_o),
    .axi_rdata_i     (axi_rdata_i),
    .axi_rlast_i     (axi_rlast_i),
    .axi_rresp_i     (axi_rresp_i)
  );

endmodule
