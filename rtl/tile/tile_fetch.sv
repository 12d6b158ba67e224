// SPDX-License-Identifier: Apache-2.0
// Asks memory for the rows of tiles that are loaded, colour before depth, as soon as nothing
// earlier can still write to them. It asks for no more than there is room for in tile_load's FIFO,
// so that loaded beats never wait for a bank: memory may stop writes while reads wait, and the bank
// could be waiting for its writes.
module tile_fetch #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned FifoBeats = 128       // at least twice a row
) (
  input  logic                      clk_i,
  input  logic                      rst_ni,

  // from tile_hazard
  input  logic                      begin_valid_i,
  output logic                      begin_ready_o,
  input  gloss_pkg::tile_begin_op_t begin_i,
  input  logic [3:0]                begin_after_i,
  input  logic [3:0]                done_i,

  // to tile_load: what the tile begins with
  output logic                      plan_valid_o,
  input  logic                      plan_ready_i,
  output logic                      plan_colour_load_o,
  output logic                      plan_depth_load_o,
  output logic [31:0]               plan_colour_o,
  output logic [31:0]               plan_depth_o,
  input  logic                      beat_taken_i,  // a beat has left the FIFO

  // to memory
  output logic                      load_valid_o,
  input  logic                      load_ready_i,
  output logic [31:0]               load_address_o
);

  localparam int unsigned RowBeats = TileSize / PixelsPerClock;
  localparam int unsigned RowBeatsBits = $clog2(RowBeats);
  localparam int unsigned RoomBits = $clog2(FifoBeats) + 1;
  localparam int unsigned YBits = $clog2(TileSize);

  logic plan_q, colour_q, depth_q;  // still to do: hand on the plan, ask for colour, for depth
  gloss_pkg::tile_begin_op_t begin_q;
  logic [YBits-1:0] row_q;
  logic [RoomBits-1:0] room_q;  // beats of the FIFO that were not asked for
  logic [3:0] ahead;
  logic taken_q;
  logic take, request, last;

  assign ahead = begin_after_i - done_i;
  assign begin_ready_o = !plan_q && !colour_q && !depth_q && (ahead[3] || ahead == '0);
  assign take = begin_valid_i && begin_ready_o;

  assign plan_valid_o = plan_q;
  assign plan_colour_load_o = begin_q.colour_load;
  assign plan_depth_load_o = begin_q.depth_load;
  assign plan_colour_o = begin_q.colour;
  assign plan_depth_o = begin_q.depth;

  assign load_valid_o = (colour_q || depth_q) && room_q[RoomBits-1:RowBeatsBits] != '0;
  assign load_address_o = colour_q ? begin_q.colour : begin_q.depth;
  assign request = load_valid_o && load_ready_i;
  assign last = request && row_q == '1;

  // A loaded part needs no clear value: its place holds the address of the next row.
  always_ff @(posedge clk_i) begin
    if (take) begin_q <= begin_i;
    if (request && colour_q) begin_q.colour <= begin_q.colour + 32'(begin_q.colour_pitch);
    if (request && !colour_q) begin_q.depth <= begin_q.depth + 32'(begin_q.depth_pitch);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      plan_q <= 1'b0;
      colour_q <= 1'b0;
      depth_q <= 1'b0;
      row_q <= '0;
      room_q <= RoomBits'(FifoBeats);
      taken_q <= 1'b0;
    end else begin
      if (take) begin
        plan_q <= 1'b1;
        colour_q <= begin_i.colour_load;
        depth_q <= begin_i.depth_load;
      end else begin
        if (plan_ready_i) plan_q <= 1'b0;
        if (last && colour_q) colour_q <= 1'b0;
        if (last && !colour_q) depth_q <= 1'b0;
      end
      if (request) row_q <= row_q + 1'b1;
      // Whether a beat leaves is known late in its clock; room for it may be known later.
      taken_q <= beat_taken_i;
      room_q <= room_q - (request ? RoomBits'(RowBeats) : '0) + RoomBits'(taken_q);
    end
  end

endmodule
