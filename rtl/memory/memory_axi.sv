// SPDX-License-Identifier: Apache-2.0
// The AXI4 master: hands its five channels to the copy while one is under way, else to the tiles,
// and remembers errors. The two never overlap, so there is nothing to arbitrate. All responses are
// taken at once but the words a copy reads.
module memory_axi #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  localparam int unsigned Width = 32 * PixelsPerClock
) (
  input  logic                        clk_i,
  input  logic                        rst_ni,

  input  logic                        copy_busy_i,
  output logic                        memory_error_o,
  input  logic                        memory_error_clear_i,

  // from memory_copy
  input  logic                        copy_write_valid_i,
  output logic                        copy_write_ready_o,
  input  logic                        copy_read_valid_i,
  output logic                        copy_read_ready_o,
  input  logic [31:0]                 copy_address_i,
  input  logic [3:0]                  copy_length_i,
  input  logic                        copy_write_data_valid_i,
  output logic                        copy_write_data_ready_o,
  input  logic [Width-1:0]            copy_write_data_i,
  input  logic [4*PixelsPerClock-1:0] copy_write_strobe_i,
  input  logic                        copy_write_last_i,
  output logic                        copy_write_done_o,
  output logic                        copy_read_data_valid_o,
  input  logic                        copy_read_data_ready_i,

  // from tile: rows
  input  logic                        load_valid_i,
  output logic                        load_ready_o,
  input  logic [31:0]                 load_address_i,
  output logic                        load_data_valid_o,
  input  logic                        store_valid_i,
  output logic                        store_ready_o,
  input  logic [31:0]                 store_address_i,
  input  logic                        store_data_valid_i,
  output logic                        store_data_ready_o,
  input  logic [Width-1:0]            store_data_i,
  input  logic                        store_data_last_i,
  output logic                        store_done_o,

  // what is read, for either
  output logic [Width-1:0]            read_data_o,

  // AXI4
  output logic                        axi_awvalid_o,
  input  logic                        axi_awready_i,
  output logic [31:0]                 axi_awaddr_o,
  output logic [7:0]                  axi_awlen_o,
  output logic                        axi_wvalid_o,
  input  logic                        axi_wready_i,
  output logic [Width-1:0]            axi_wdata_o,
  output logic [4*PixelsPerClock-1:0] axi_wstrb_o,
  output logic                        axi_wlast_o,
  input  logic                        axi_bvalid_i,
  output logic                        axi_bready_o,
  input  logic [1:0]                  axi_bresp_i,
  output logic                        axi_arvalid_o,
  input  logic                        axi_arready_i,
  output logic [31:0]                 axi_araddr_o,
  output logic [7:0]                  axi_arlen_o,
  input  logic                        axi_rvalid_i,
  output logic                        axi_rready_o,
  input  logic [Width-1:0]            axi_rdata_i,
  input  logic [1:0]                  axi_rresp_i
);

  localparam logic [7:0] RowLength = 8'(TileSize / PixelsPerClock - 1);
  localparam logic [1:0] Okay = 2'b00;

  logic error_q;

  assign memory_error_o = error_q;

  assign axi_awvalid_o = copy_busy_i ? copy_write_valid_i : store_valid_i;
  assign axi_awaddr_o = copy_busy_i ? copy_address_i : store_address_i;
  assign axi_awlen_o = copy_busy_i ? 8'(copy_length_i) : RowLength;
  assign copy_write_ready_o = copy_busy_i && axi_awready_i;
  assign store_ready_o = !copy_busy_i && axi_awready_i;

  assign axi_wvalid_o = copy_busy_i ? copy_write_data_valid_i : store_data_valid_i;
  assign axi_wdata_o = copy_busy_i ? copy_write_data_i : store_data_i;
  assign axi_wstrb_o = copy_busy_i ? copy_write_strobe_i : '1;
  assign axi_wlast_o = copy_busy_i ? copy_write_last_i : store_data_last_i;
  assign copy_write_data_ready_o = copy_busy_i && axi_wready_i;
  assign store_data_ready_o = !copy_busy_i && axi_wready_i;

  assign axi_bready_o = 1'b1;
  assign copy_write_done_o = copy_busy_i && axi_bvalid_i;
  assign store_done_o = !copy_busy_i && axi_bvalid_i;

  assign axi_arvalid_o = copy_busy_i ? copy_read_valid_i : load_valid_i;
  assign axi_araddr_o = copy_busy_i ? copy_address_i : load_address_i;
  assign axi_arlen_o = copy_busy_i ? 8'(copy_length_i) : RowLength;
  assign copy_read_ready_o = copy_busy_i && axi_arready_i;
  assign load_ready_o = !copy_busy_i && axi_arready_i;

  assign axi_rready_o = !copy_busy_i || copy_read_data_ready_i;
  assign read_data_o = axi_rdata_i;
  assign copy_read_data_valid_o = copy_busy_i && axi_rvalid_i;
  assign load_data_valid_o = !copy_busy_i && axi_rvalid_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) error_q <= 1'b0;
    else if (memory_error_clear_i) error_q <= 1'b0;
    else if ((axi_bvalid_i && axi_bresp_i != Okay) ||
             (axi_rvalid_i && axi_rresp_i != Okay)) error_q <= 1'b1;
  end

`ifndef SYNTHESIS
  logic [15:0] rows_q;  // stored or loaded, and not yet answered

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) rows_q <= '0;
    else rows_q <= rows_q + 16'(store_valid_i && store_ready_o) - 16'(store_done_o)
        + (load_valid_i && load_ready_o ? 16'(RowLength) + 1'b1 : '0) - 16'(load_data_valid_o);
  end

  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      copy_alone: assert (!copy_busy_i || (!load_valid_i && !store_valid_i &&
                                           !store_data_valid_i && rows_q == '0));
      tiles_alone: assert (copy_busy_i || (!copy_write_valid_i && !copy_read_valid_i &&
                                           !copy_write_data_valid_i));
      answers_expected: assert (copy_busy_i || rows_q != '0 || !axi_bvalid_i);
    end
  end
`endif

endmodule
