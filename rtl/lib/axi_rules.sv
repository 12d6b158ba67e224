// SPDX-License-Identifier: Apache-2.0
// Stops a simulation where an AXI4 master breaks a rule: what is offered stays as it is until it is
// taken, and no burst crosses a border of 4 KiB. No logic.
module axi_rules #(
  parameter int unsigned AddressBits = 32,
  parameter int unsigned DataBits = 32
) (
  input logic                   clk_i,
  input logic                   rst_ni,

  input logic                   awvalid_i,
  input logic                   awready_i,
  input logic [AddressBits-1:0] awaddr_i,
  input logic [7:0]             awlen_i,
  input logic                   wvalid_i,
  input logic                   wready_i,
  input logic [DataBits-1:0]    wdata_i,
  input logic [DataBits/8-1:0]  wstrb_i,
  input logic                   wlast_i,
  input logic                   arvalid_i,
  input logic                   arready_i,
  input logic [AddressBits-1:0] araddr_i,
  input logic [7:0]             arlen_i
);

`ifndef SYNTHESIS
  localparam int unsigned BeatShift = $clog2(DataBits / 8);
  localparam logic [13:0] PageBytes = 14'd4096;

  logic        aw_waits_q, w_waits_q, ar_waits_q;  // it was offered a clock ago, and not taken
  logic [13:0] aw_end, ar_end;                     // of the burst, in the page of its first byte
  logic        unused;

  // The first beat may begin inside its word.
  assign aw_end = 14'({awaddr_i[11:BeatShift], {BeatShift{1'b0}}}) +
                  ((14'(awlen_i) + 14'd1) << BeatShift);
  assign ar_end = 14'({araddr_i[11:BeatShift], {BeatShift{1'b0}}}) +
                  ((14'(arlen_i) + 14'd1) << BeatShift);
  assign unused = ^{awaddr_i, araddr_i};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      aw_waits_q <= 1'b0;
      w_waits_q <= 1'b0;
      ar_waits_q <= 1'b0;
    end else begin
      aw_waits_q <= awvalid_i && !awready_i;
      w_waits_q <= wvalid_i && !wready_i;
      ar_waits_q <= arvalid_i && !arready_i;
    end
  end

  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      aw_stays: assert (!aw_waits_q || (awvalid_i && $stable({awaddr_i, awlen_i})));
      w_stays: assert (!w_waits_q || (wvalid_i && $stable({wdata_i, wstrb_i, wlast_i})));
      ar_stays: assert (!ar_waits_q || (arvalid_i && $stable({araddr_i, arlen_i})));
      aw_in_a_page: assert (!awvalid_i || aw_end <= PageBytes);
      ar_in_a_page: assert (!arvalid_i || ar_end <= PageBytes);
    end
  end
`endif

endmodule
