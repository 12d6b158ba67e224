// SPDX-License-Identifier: Apache-2.0
// The stream: pages of host memory to beats for the core, in order. Bursts of 256 bytes at most,
// which never leave a page, are asked for as long as there is room for all of their beats; the room
// hides a host latency of about (256 beats less one burst). Past the stream's end only the rest of
// its last beat is read.
module port_read #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  input  logic                  start_i,
  input  logic [31:0]           words_i,

  // from port_list
  input  logic                  page_valid_i,
  output logic                  page_ready_o,
  input  logic [63:12]          page_i,

  // host reads
  output logic                  read_valid_o,
  input  logic                  read_ready_i,
  output logic [63:8]           read_address_o,
  output logic [7:0]            read_length_o,
  input  logic                  beat_valid_i,
  input  logic [StreamBits-1:0] beat_data_i,

  // core
  output logic                  stream_valid_o,
  input  logic                  stream_ready_i,
  output logic [StreamBits-1:0] stream_data_o,
  output logic [2:0]            taken_o         // words of the stream the core takes in this clock
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned LaneBits = $clog2(Lanes);
  localparam int unsigned BurstWords = 64;
  localparam int unsigned BurstBits = $clog2(BurstWords / Lanes);
  localparam int unsigned Room = 256;
  localparam int unsigned RoomBits = $clog2(Room) + 1;

  logic [31:0] unrequested_q, untaken_q;  // words
  logic [3:0] burst_q;                // in the page
  logic [RoomBits-1:0] room_q;        // beats not asked for
  logic last_burst, request, give;
  logic [BurstBits-1:0] length;

  assign last_burst = unrequested_q <= BurstWords;
  assign length = last_burst ? BurstBits'((unrequested_q[6:0] - 7'd1) >> LaneBits) : '1;
  assign read_valid_o = unrequested_q != '0 && page_valid_i && room_q[RoomBits-1:BurstBits] != '0;
  assign read_address_o = {page_i, burst_q};
  assign read_length_o = 8'(length);
  assign request = read_valid_o && read_ready_i;
  assign page_ready_o = request && (last_burst || burst_q == '1);

  assign give = stream_valid_o && stream_ready_i;
  always_comb begin
    taken_o = '0;
    if (give) taken_o = untaken_q < Lanes ? untaken_q[2:0] : 3'(Lanes);
  end

  logic room;  // always: only beats that have their place are requested
  ram_fifo #(
    .Width(StreamBits),
    .Depth(Room)
  ) u_beats (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(beat_valid_i),
    .ready_o(room),
    .data_i (beat_data_i),
    .valid_o(stream_valid_o),
    .ready_i(stream_ready_i),
    .data_o (stream_data_o)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      unrequested_q <= '0;
      untaken_q <= '0;
      burst_q <= '0;
      room_q <= RoomBits'(Room);
    end else begin
      if (start_i) unrequested_q <= words_i;
      else if (request) unrequested_q <= last_burst ? '0 : unrequested_q - BurstWords;
      if (start_i) untaken_q <= words_i;
      else untaken_q <= untaken_q - 32'(taken_o);
      if (request) burst_q <= page_ready_o ? '0 : burst_q + 1'b1;
      room_q <= room_q - (request ? RoomBits'(length) + 1'b1 : '0) + RoomBits'(give);
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      beat_has_room: assert (room || !beat_valid_i);
    end
  end
`endif

endmodule
