// SPDX-License-Identifier: Apache-2.0
// raster_shade behind four pins, so that it can be placed on a device that has too few for its
// ports: inputs come from a shift register, outputs go into one. Every path of raster_shade stays
// one from register to register.
module raster_shade_pins #(
  parameter int unsigned TileSize = 32,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic bit_i,
  output logic bit_o
);

  localparam int unsigned XBits = $clog2(TileSize / PixelsPerClock);
  localparam int unsigned YBits = $clog2(TileSize);
  localparam int unsigned InBits = 12 + StreamBits;
  localparam int unsigned OutBits = XBits + YBits + 57 * PixelsPerClock + 15;

  logic [InBits-1:0]  in_q;
  logic [OutBits-1:0] out, out_q;

  raster_shade #(
    .TileSize(TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits(StreamBits)
  ) dut (
    .clk_i(clk_i),
    .rst_ni(rst_ni),
    .valid_i(in_q[0]),
    .ready_o(out[0]),
    .op_i(in_q[10:1]),
    .data_i(in_q[12 +: StreamBits]),
    .bank_i(in_q[11]),
    .block_valid_o(out[1]),
    .end_o(out[2]),
    .end_bank_o(out[3]),
    .stall_raster_o(out[4]),
    .idle_o(out[5]),
    .block_state_o(out[14:6]),
    .block_x_o(out[15 +: XBits]),
    .block_y_o(out[15+XBits +: YBits]),
    .block_mask_o(out[15+XBits+YBits +: PixelsPerClock]),
    .block_colour_o(out[15+XBits+YBits+PixelsPerClock +: 32*PixelsPerClock]),
    .block_depth_o(out[15+XBits+YBits+33*PixelsPerClock +: 24*PixelsPerClock])
  );

  always_ff @(posedge clk_i) begin
    in_q <= {in_q[InBits-2:0], bit_i};
    out_q <= out ^ {out_q[OutBits-2:0], 1'b0};
  end

  assign bit_o = out_q[OutBits-1];

endmodule
