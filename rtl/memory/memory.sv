// SPDX-License-Identifier: Apache-2.0
// Board memory: one AXI4 master for the tiles' rows and for copies. A copy never runs while a tile
// is unfinished.
module memory #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // from command: WRITE_MEMORY and READ_MEMORY
  input  logic                         copy_valid_i,
  output logic                         copy_ready_o,
  input  gloss_pkg::copy_op_t          copy_i,
  input  logic                         copy_data_valid_i,
  output logic                         copy_data_ready_o,
  input  logic [31:0]                  copy_data_i,
  output logic                         copy_idle_o,
  output logic                         memory_error_o,
  input  logic                         memory_error_clear_i,

  // words read
  output logic                         response_valid_o,
  input  logic                         response_ready_i,
  output logic [3:0]                   response_count_o,
  output logic [32*PixelsPerClock-1:0] response_data_o,

  // from tile: see there
  input  logic                         load_valid_i,
  output logic                         load_ready_o,
  input  logic [31:0]                  load_address_i,
  output logic                         load_data_valid_o,
  output logic [32*PixelsPerClock-1:0] load_data_o,
  input  logic                         store_valid_i,
  output logic                         store_ready_o,
  input  logic [31:0]                  store_address_i,
  input  logic                         store_data_valid_i,
  output logic                         store_data_ready_o,
  input  logic [32*PixelsPerClock-1:0] store_data_i,
  input  logic                         store_data_last_i,
  output logic                         store_done_o,

  // AXI4 master: INCR, full width, no IDs
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

  logic copy_busy;
  logic copy_write_valid, copy_write_ready, copy_read_valid, copy_read_ready;
  logic [31:0] copy_address;
  logic [3:0] copy_length;
  logic copy_write_data_valid, copy_write_data_ready, copy_write_last, copy_write_done;
  logic [32*PixelsPerClock-1:0] copy_write_data, read_data;
  logic [4*PixelsPerClock-1:0] copy_write_strobe;
  logic copy_read_data_valid, copy_read_data_ready;

  assign copy_busy = !copy_idle_o;
  assign load_data_o = read_data;

  memory_copy #(
    .PixelsPerClock(PixelsPerClock)
  ) u_copy (
    .clk_i             (clk_i),
    .rst_ni            (rst_ni),
    .copy_valid_i      (copy_valid_i),
    .copy_ready_o      (copy_ready_o),
    .copy_i            (copy_i),
    .copy_data_valid_i (copy_data_valid_i),
    .copy_data_ready_o (copy_data_ready_o),
    .copy_data_i       (copy_data_i),
    .copy_idle_o       (copy_idle_o),
    .response_valid_o  (response_valid_o),
    .response_ready_i  (response_ready_i),
    .response_count_o  (response_count_o),
    .response_data_o   (response_data_o),
    .write_valid_o     (copy_write_valid),
    .write_ready_i     (copy_write_ready),
    .read_valid_o      (copy_read_valid),
    .read_ready_i      (copy_read_ready),
    .address_o         (copy_address),
    .length_o          (copy_length),
    .write_data_valid_o(copy_write_data_valid),
    .write_data_ready_i(copy_write_data_ready),
    .write_data_o      (copy_write_data),
    .write_strobe_o    (copy_write_strobe),
    .write_last_o      (copy_write_last),
    .write_done_i      (copy_write_done),
    .read_data_valid_i (copy_read_data_valid),
    .read_data_ready_o (copy_read_data_ready),
    .read_data_i       (read_data)
  );

  memory_axi #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock)
  ) u_axi (
    .clk_i                  (clk_i),
    .rst_ni                 (rst_ni),
    .copy_busy_i            (copy_busy),
    .memory_error_o         (memory_error_o),
    .memory_error_clear_i   (memory_error_clear_i),
    .copy_write_valid_i     (copy_write_valid),
    .copy_write_ready_o     (copy_write_ready),
    .copy_read_valid_i      (copy_read_valid),
    .copy_read_ready_o      (copy_read_ready),
    .copy_address_i         (copy_address),
    .copy_length_i          (copy_length),
    .copy_write_data_valid_i(copy_write_data_valid),
    .copy_write_data_ready_o(copy_write_data_ready),
    .copy_write_data_i      (copy_write_data),
    .copy_write_strobe_i    (copy_write_strobe),
    .copy_write_last_i      (copy_write_last),
    .copy_write_done_o      (copy_write_done),
    .copy_read_data_valid_o (copy_read_data_valid),
    .copy_read_data_ready_i (copy_read_data_ready),
    .load_valid_i           (load_valid_i),
    .load_ready_o           (load_ready_o),
    .load_address_i         (load_address_i),
    .load_data_valid_o      (load_data_valid_o),
    .store_valid_i          (store_valid_i),
    .store_ready_o          (store_ready_o),
    .store_address_i        (store_address_i),
    .store_data_valid_i     (store_data_valid_i),
    .store_data_ready_o     (store_data_ready_o),
    .store_data_i           (store_data_i),
    .store_data_last_i      (store_data_last_i),
    .store_done_o           (store_done_o),
    .read_data_o            (read_data),
    .axi_awvalid_o          (axi_awvalid_o),
    .axi_awready_i          (axi_awready_i),
    .axi_awaddr_o           (axi_awaddr_o),
    .axi_awlen_o            (axi_awlen_o),
    .axi_wvalid_o           (axi_wvalid_o),
    .axi_wready_i           (axi_wready_i),
    .axi_wdata_o            (axi_wdata_o),
    .axi_wstrb_o            (axi_wstrb_o),
    .axi_wlast_o            (axi_wlast_o),
    .axi_bvalid_i           (axi_bvalid_i),
    .axi_bready_o           (axi_bready_o),
    .axi_bresp_i            (axi_bresp_i),
    .axi_arvalid_o          (axi_arvalid_o),
    .axi_arready_i          (axi_arready_i),
    .axi_araddr_o           (axi_araddr_o),
    .axi_arlen_o            (axi_arlen_o),
    .axi_rvalid_i           (axi_rvalid_i),
    .axi_rready_o           (axi_rready_o),
    .axi_rdata_i            (axi_rdata_i),
    .axi_rresp_i            (axi_rresp_i)
  );

  // Bursts end where they were asked to end: beats are counted instead.
  logic unused;
  assign unused = axi_rlast_i;

`ifndef SYNTHESIS
  axi_rules #(
    .AddressBits(32),
    .DataBits   (32 * PixelsPerClock)
  ) u_rules (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .awvalid_i(axi_awvalid_o),
    .awready_i(axi_awready_i),
    .awaddr_i (axi_awaddr_o),
    .awlen_i  (axi_awlen_o),
    .wvalid_i (axi_wvalid_o),
    .wready_i (axi_wready_i),
    .wdata_i  (axi_wdata_o),
    .wstrb_i  (axi_wstrb_o),
    .wlast_i  (axi_wlast_o),
    .arvalid_i(axi_arvalid_o),
    .arready_i(axi_arready_i),
    .araddr_i (axi_araddr_o),
    .arlen_i  (axi_arlen_o)
  );
`endif

endmodule
