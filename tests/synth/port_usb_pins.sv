// SPDX-License-Identifier: Apache-2.0
// port_usb behind four pins, so that it can be placed on a device that has too few for its ports:
// inputs come from a shift register, outputs go into one. Every path of port_usb stays one from
// register to register.
module port_usb_pins #(
  parameter int unsigned TileSize = 32,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic bit_i,
  output logic bit_o
);

  localparam int unsigned Width = 32 * PixelsPerClock;
  localparam int unsigned InBits = 383 + Width;
  localparam int unsigned OutBits = 274 + StreamBits;

  logic [InBits-1:0]  in_q;
  logic [OutBits-1:0] out, out_q;

  port_usb #(
    .TileSize(TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits(StreamBits)
  ) dut (
    .clk_i(clk_i),
    .rst_ni(rst_ni),
    .memory_pages_i(32'd16384),
    .reg_valid_i(in_q[0]),
    .reg_write_i(in_q[1]),
    .out_valid_i(in_q[2]),
    .in_ready_i(in_q[3]),
    .event_ready_i(in_q[4]),
    .job_ready_i(in_q[5]),
    .status_valid_i(in_q[6]),
    .stream_ready_i(in_q[7]),
    .response_valid_i(in_q[8]),
    .memory_stopped_i(in_q[9]),
    .memory_idle_i(in_q[10]),
    .response_count_i(in_q[14:11]),
    .reg_addr_i(in_q[30:15]),
    .reg_wdata_i(in_q[62:31]),
    .out_data_i(in_q[94:63]),
    .status_i(in_q[190:95]),
    .time_i(in_q[382:191]),
    .response_data_i(in_q[383 +: Width]),
    .reg_ready_o(out[0]),
    .out_ready_o(out[1]),
    .in_valid_o(out[2]),
    .in_flush_o(out[3]),
    .event_valid_o(out[4]),
    .core_rst_no(out[5]),
    .slot_write_o(out[6]),
    .job_valid_o(out[7]),
    .status_ready_o(out[8]),
    .stream_valid_o(out[9]),
    .response_ready_o(out[10]),
    .memory_stop_o(out[11]),
    .slot_index_o(out[15:12]),
    .slot_rights_o(out[17:16]),
    .reg_rdata_o(out[49:18]),
    .in_data_o(out[81:50]),
    .event_o(out[145:82]),
    .slot_base_o(out[177:146]),
    .slot_size_o(out[209:178]),
    .job_stream_words_o(out[241:210]),
    .job_response_words_o(out[273:242]),
    .stream_data_o(out[274 +: StreamBits])
  );

  always_ff @(posedge clk_i) begin
    in_q <= {in_q[InBits-2:0], bit_i};
    out_q <= out ^ {out_q[OutBits-2:0], 1'b0};
  end

  assign bit_o = out_q[OutBits-1];

endmodule
