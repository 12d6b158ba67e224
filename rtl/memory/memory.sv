// SPDX-License-Identifier: Apache-2.0
// Board memory: one AXI4 master for the tiles' rows and for copies. A copy never runs while a tile is unfinished.
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

endmodule
