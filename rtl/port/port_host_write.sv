// SPDX-License-Identifier: Apache-2.0
// The host's write channels: response bursts, and the completion when they are all acknowledged.
// The addresses of bursts under way are remembered for the one that is refused.
module port_host_write #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                    clk_i,
  input  logic                    rst_ni,

  input  logic                    completion_i,   // it is the completion's turn

  // from port_write
  input  logic                    response_address_valid_i,
  output logic                    response_address_ready_o,
  input  logic [63:8]             response_address_i,
  input  logic [7:0]              response_length_i,
  input  logic                    response_data_valid_i,
  output logic                    response_data_ready_o,
  input  logic [StreamBits-1:0]   response_data_i,
  input  logic [StreamBits/8-1:0] response_strobe_i,

  // from port_complete
  input  logic                    completion_address_valid_i,
  output logic                    completion_address_ready_o,
  input  logic [63:4]             completion_address_i,
  input  logic [7:0]              completion_length_i,
  input  logic                    completion_data_valid_i,
  output logic                    completion_data_ready_o,
  input  logic [StreamBits-1:0]   completion_data_i,

  output logic                    pending_o,      // some are not acknowledged
  output logic                    error_o,
  output logic [63:0]             error_address_o,

  // host
  output logic                    awvalid_o,
  input  logic                    awready_i,
  output logic [63:0]             awaddr_o,
  output logic [7:0]              awlen_o,
  output logic                    wvalid_o,
  input  logic                    wready_i,
  output logic [StreamBits-1:0]   wdata_o,
  output logic [StreamBits/8-1:0] wstrb_o,
  input  logic                    bvalid_i,
  output logic                    bready_o,
  input  logic [1:0]              bresp_i
);

  localparam int unsigned Outstanding = 8;
  localparam logic [1:0] Okay = 2'b00;

  logic order_ready, order_valid, address_valid, address_ready;

  assign address_valid = completion_i ? completion_address_valid_i : response_address_valid_i;
  assign address_ready = awready_i && order_ready;
  assign completion_address_ready_o = completion_i && address_ready;
  assign response_address_ready_o = !completion_i && address_ready;
  assign awvalid_o = address_valid && order_ready;
  assign awaddr_o = completion_i ? {completion_address_i, 4'd0} : {response_address_i, 8'd0};
  assign awlen_o = completion_i ? completion_length_i : response_length_i;

  assign wvalid_o = completion_i ? completion_data_valid_i : response_data_valid_i;
  assign completion_data_ready_o = completion_i && wready_i;
  assign response_data_ready_o = !completion_i && wready_i;
  assign wdata_o = completion_i ? completion_data_i : response_data_i;
  assign wstrb_o = completion_i ? '1 : response_strobe_i;

  stream_fifo #(
    .Width($bits(completion_address_i)),
    .Depth(Outstanding)
  ) u_order (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(awvalid_o && awready_i),
    .ready_o(order_ready),
    .data_i (awaddr_o[63:4]),
    .valid_o(order_valid),
    .ready_i(bvalid_i),
    .data_o (error_address_o[63:4])
  );
  assign error_address_o[3:0] = '0;
  assign pending_o = order_valid;
  assign bready_o = 1'b1;
  assign error_o = bvalid_i && bresp_i != Okay;

endmodule
