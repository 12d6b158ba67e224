// SPDX-License-Identifier: Apache-2.0
// An AXI4 master behind this gate can be reset at any clock, and the other side does not notice.
// Told to stop, the gate takes nothing more of the master and brings to its end what is under way:
// addresses it has taken are given, missing data are made up with no byte enabled, answers are
// taken and dropped. From stopped_o on the master may be reset; the gate is opened again by taking
// stop_i back when idle_o says that nothing is under way. Addresses go through in a clock. Data
// wait until their address is out, not until it is taken, and WLAST is made from its length.
module port_gate #(
  parameter int unsigned AddressBits = 32,
  parameter int unsigned DataBits = 32
) (
  input  logic                   clk_i,
  input  logic                   rst_ni,

  input  logic                   stop_i,
  output logic                   stopped_o,
  output logic                   idle_o,

  // from the master
  input  logic                   master_awvalid_i,
  output logic                   master_awready_o,
  input  logic [AddressBits-1:0] master_awaddr_i,
  input  logic [7:0]             master_awlen_i,
  input  logic                   master_wvalid_i,
  output logic                   master_wready_o,
  input  logic [DataBits-1:0]    master_wdata_i,
  input  logic [DataBits/8-1:0]  master_wstrb_i,
  output logic                   master_bvalid_o,
  input  logic                   master_bready_i,
  output logic [1:0]             master_bresp_o,
  input  logic                   master_arvalid_i,
  output logic                   master_arready_o,
  input  logic [AddressBits-1:0] master_araddr_i,
  input  logic [7:0]             master_arlen_i,
  output logic                   master_rvalid_o,
  input  logic                   master_rready_i,
  output logic [DataBits-1:0]    master_rdata_o,
  output logic                   master_rlast_o,
  output logic [1:0]             master_rresp_o,

  // AXI4
  output logic                   axi_awvalid_o,
  input  logic                   axi_awready_i,
  output logic [AddressBits-1:0] axi_awaddr_o,
  output logic [7:0]             axi_awlen_o,
  output logic                   axi_wvalid_o,
  input  logic                   axi_wready_i,
  output logic [DataBits-1:0]    axi_wdata_o,
  output logic [DataBits/8-1:0]  axi_wstrb_o,
  output logic                   axi_wlast_o,
  input  logic                   axi_bvalid_i,
  output logic                   axi_bready_o,
  input  logic [1:0]             axi_bresp_i,
  output logic                   axi_arvalid_o,
  input  logic                   axi_arready_i,
  output logic [AddressBits-1:0] axi_araddr_o,
  output logic [7:0]             axi_arlen_o,
  input  logic                   axi_rvalid_i,
  output logic                   axi_rready_o,
  input  logic [DataBits-1:0]    axi_rdata_i,
  input  logic                   axi_rlast_i,
  input  logic [1:0]             axi_rresp_i
);

  if (DataBits < 8 || DataBits % 8 != 0) begin : gen_data_bits
    $error("DataBits must be whole bytes");
  end

  // Bursts under way are counted, so they have to be few enough.
  localparam int unsigned CountBits = 8;
  localparam int unsigned LengthsDepth = 8;

  logic [CountBits-1:0] writes_q, reads_q;
  logic write_take, read_open, read_ready, read_take;
  logic address_valid_q;
  logic [AddressBits-1:0] address_q;
  logic [7:0] address_length_q;
  logic length_ready, length_valid;
  logic [7:0] length, beat_q;
  logic closed_q;  // for the master's data
  logic beat_take, burst_take;

  assign stopped_o = closed_q;
  assign idle_o = writes_q == '0 && reads_q == '0;

  assign master_awready_o = !stop_i && length_ready && writes_q != '1 &&
                            (!address_valid_q || axi_awready_i);
  assign write_take = master_awvalid_i && master_awready_o;
  assign axi_awvalid_o = address_valid_q;
  assign axi_awaddr_o = address_q;
  assign axi_awlen_o = address_length_q;

  assign read_open = !stop_i && reads_q != '1;
  assign master_arready_o = read_open && read_ready;
  assign read_take = master_arvalid_i && master_arready_o;

  stream_register #(
    .Width(AddressBits + 8)
  ) u_read_address (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(master_arvalid_i && read_open),
    .ready_o(read_ready),
    .data_i ({master_arlen_i, master_araddr_i}),
    .valid_o(axi_arvalid_o),
    .ready_i(axi_arready_i),
    .data_o ({axi_arlen_o, axi_araddr_o})
  );

  // Bursts whose data are still to come.
  stream_fifo #(
    .Width(8),
    .Depth(LengthsDepth)
  ) u_lengths (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(write_take),
    .ready_o(length_ready),
    .data_i (master_awlen_i),
    .valid_o(length_valid),
    .ready_i(burst_take),
    .data_o (length)
  );

  assign axi_wvalid_o = length_valid && (closed_q || master_wvalid_i);
  assign master_wready_o = length_valid && !closed_q && axi_wready_i;
  assign axi_wdata_o = closed_q ? '0 : master_wdata_i;
  assign axi_wstrb_o = closed_q ? '0 : master_wstrb_i;
  assign axi_wlast_o = beat_q == length;
  assign beat_take = axi_wvalid_o && axi_wready_i;
  assign burst_take = beat_take && axi_wlast_o;

  assign master_bvalid_o = axi_bvalid_i && !stop_i;
  assign axi_bready_o = master_bready_i || stop_i;
  assign master_bresp_o = axi_bresp_i;

  assign master_rvalid_o = axi_rvalid_i && !stop_i;
  assign axi_rready_o = master_rready_i || stop_i;
  assign master_rdata_o = axi_rdata_i;
  assign master_rlast_o = axi_rlast_i;
  assign master_rresp_o = axi_rresp_i;

  always_ff @(posedge clk_i) begin
    if (write_take) begin
      address_q <= master_awaddr_i;
      address_length_q <= master_awlen_i;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      address_valid_q <= 1'b0;
      closed_q <= 1'b0;
      beat_q <= '0;
      writes_q <= '0;
      reads_q <= '0;
    end else begin
      address_valid_q <= write_take || (address_valid_q && !axi_awready_i);
      // A beat that is offered stays until it is taken.
      closed_q <= stop_i && (closed_q || !axi_wvalid_o || axi_wready_i);
      if (beat_take) beat_q <= axi_wlast_o ? '0 : beat_q + 1'b1;
      writes_q <= writes_q + CountBits'(write_take) - CountBits'(axi_bvalid_i && axi_bready_o);
      reads_q <= reads_q + CountBits'(read_take)
          - CountBits'(axi_rvalid_i && axi_rready_o && axi_rlast_i);
    end
  end

`ifndef SYNTHESIS
  axi_rules #(
    .AddressBits(AddressBits),
    .DataBits   (DataBits)
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
