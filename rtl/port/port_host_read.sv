// SPDX-License-Identifier: Apache-2.0
// The host's read channels shared by those who read, the first of them first. They take their beats
// at once, so that nobody waits behind another; who a burst is for, and its address, is remembered
// until its last beat. While an address waits it may give way to one of an earlier reader, or be
// taken back: AXI does not allow that, so a register that takes addresses has to follow, as in
// port_gate.
module port_host_read #(
  parameter int unsigned StreamBits = 32,
  parameter int unsigned Readers = 2,
  localparam int unsigned IndexBits = $clog2(Readers)
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  // from the readers
  input  logic [Readers-1:0]    valid_i,
  output logic [Readers-1:0]    ready_o,
  input  logic [64*Readers-1:0] address_i,
  input  logic [8*Readers-1:0]  length_i,      // beats less one

  // to the readers
  output logic [Readers-1:0]    beat_valid_o,
  output logic                  beat_last_o,
  output logic [StreamBits-1:0] beat_data_o,

  // the host refused the burst that this beat is of
  output logic [Readers-1:0]    error_o,
  output logic [63:0]           error_address_o,

  // host
  output logic                  arvalid_o,
  input  logic                  arready_i,
  output logic [63:0]           araddr_o,
  output logic [7:0]            arlen_o,
  input  logic                  rvalid_i,
  output logic                  rready_o,
  input  logic [StreamBits-1:0] rdata_i,
  input  logic                  rlast_i,
  input  logic [1:0]            rresp_i
);

  if (Readers < 2) begin : gen_readers
    $error("Readers must be at least 2");
  end

  localparam int unsigned Outstanding = 16;
  localparam logic [1:0] Okay = 2'b00;

  logic [IndexBits-1:0] reader, owner;
  logic order_ready, order_valid, take, beat;

  always_comb begin
    reader = '0;
    araddr_o = '0;
    arlen_o = '0;
    for (int r = Readers - 1; r >= 0; r--)
      if (valid_i[r]) begin
        reader = IndexBits'(r);
        araddr_o = address_i[64*r +: 64];
        arlen_o = length_i[8*r +: 8];
      end
  end

  assign arvalid_o = valid_i != '0 && order_ready;
  assign take = arvalid_o && arready_i;

  stream_fifo #(
    .Width($bits({reader, araddr_o})),
    .Depth(Outstanding)
  ) u_order (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(take),
    .ready_o(order_ready),
    .data_i ({reader, araddr_o}),
    .valid_o(order_valid),
    .ready_i(beat && rlast_i),
    .data_o ({owner, error_address_o})
  );

  assign rready_o = order_valid;
  assign beat = rvalid_i && rready_o;
  assign beat_last_o = rlast_i;
  assign beat_data_o = rdata_i;

  for (genvar r = 0; r < Readers; r++) begin : gen_reader
    assign ready_o[r] = take && reader == IndexBits'(r);
    assign beat_valid_o[r] = beat && owner == IndexBits'(r);
    assign error_o[r] = beat_valid_o[r] && rresp_i != Okay;
  end

endmodule
