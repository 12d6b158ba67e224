// SPDX-License-Identifier: Apache-2.0
// The ends of tiles, from when command hands them over until all they ask for is done: stores
// acknowledged, answers taken. A table of four in stream order. Tiles are numbered modulo 16; an
// end is that of tile ended_o. Addresses and pitches are kept in units of a tile's row, 4 *
// TileSize bytes, of which all are multiples.
module tile_pending #(
  parameter int unsigned TileSize = 64,
  localparam int unsigned UnitBits = $clog2(4 * TileSize),
  localparam int unsigned AddressBits = 32 - UnitBits,
  localparam int unsigned PitchBits = 16 - UnitBits
) (
  input  logic                    clk_i,
  input  logic                    rst_ni,

  // from command
  input  logic                    tile_end_valid_i,
  output logic                    tile_end_ready_o,
  input  gloss_pkg::tile_end_op_t tile_end_i,

  output logic [3:0]              ended_o,      // tiles whose end was taken
  output logic [3:0]              done_o,       // tiles that are done, oldest first

  // to tile_store and tile_hazard: a tile's outputs, address and pitch of its colour or depth
  input  logic [1:0]              store_tile_i,
  input  logic                    store_depth_i,
  output logic [1:0]              store_colour_output_o,
  output logic [1:0]              store_depth_output_o,
  output logic [AddressBits-1:0]  store_address_o,
  output logic [PitchBits-1:0]    store_pitch_o,
  input  logic [1:0]              hazard_tile_i,
  input  logic                    hazard_depth_i,
  output logic [1:0]              hazard_output_o,
  output logic [AddressBits-1:0]  hazard_address_o,
  output logic [PitchBits-1:0]    hazard_pitch_o,

  // from tile_store, memory and whoever takes answers
  input  logic [3:0]              read_i,       // tiles whose rows have all been read
  input  logic                    row_stored_i,
  input  logic                    row_answered_i
);

  localparam int unsigned RowsBits = $clog2(TileSize) + 2;

  logic [AddressBits+PitchBits-1:0] colour [4];
  logic [AddressBits+PitchBits-1:0] depth [4];
  logic [1:0] colour_output [4];
  logic [1:0] depth_output [4];

  logic [3:0] ended_q, done_q;
  logic [RowsBits-1:0] rows_q;  // of tile done_q, stored and acknowledged or answered
  logic [1:0] parts;
  logic take, complete, retire;

  assign take = tile_end_valid_i && tile_end_ready_o;
  assign tile_end_ready_o = ended_q - done_q != 4'd4;
  assign ended_o = ended_q;
  assign done_o = done_q;

  assign store_colour_output_o = colour_output[store_tile_i];
  assign store_depth_output_o = depth_output[store_tile_i];
  assign {store_address_o, store_pitch_o} = store_depth_i ? depth[store_tile_i]
                                                          : colour[store_tile_i];

  assign hazard_output_o = hazard_depth_i ? depth_output[hazard_tile_i]
                                          : colour_output[hazard_tile_i];
  assign {hazard_address_o, hazard_pitch_o} = hazard_depth_i ? depth[hazard_tile_i]
                                                             : colour[hazard_tile_i];

  // Acknowledgements come in order, and an answer begins only when all before it is done: one
  // counter is enough. It may have begun to count for the next tile while one that drops both
  // parts, and so has nothing to wait for, retires.
  assign parts = 2'(colour_output[done_q[1:0]] != gloss_pkg::TILE_OUTPUT_DROP)
      + 2'(depth_output[done_q[1:0]] != gloss_pkg::TILE_OUTPUT_DROP);
  assign complete = rows_q == {parts, {$clog2(TileSize) {1'b0}}};
  assign retire = read_i != done_q && (parts == '0 || complete);

  always_ff @(posedge clk_i) begin
    if (take) begin
      colour[ended_q[1:0]] <= {tile_end_i.colour[31:UnitBits],
                               tile_end_i.colour_pitch[15:UnitBits]};
      depth[ended_q[1:0]] <= {tile_end_i.depth[31:UnitBits], tile_end_i.depth_pitch[15:UnitBits]};
      colour_output[ended_q[1:0]] <= tile_end_i.colour_output;
      depth_output[ended_q[1:0]] <= tile_end_i.depth_output;
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ended_q <= '0;
      done_q <= '0;
      rows_q <= '0;
    end else begin
      if (take) ended_q <= ended_q + 1'b1;
      if (retire) done_q <= done_q + 1'b1;
      rows_q <= (retire && parts != '0 ? '0 : rows_q)
          + RowsBits'(row_stored_i) + RowsBits'(row_answered_i);
    end
  end

  // The units leave these bits out; command has checked that they are zero.
  logic unused;
  assign unused = &{1'b0, tile_end_i.colour[UnitBits-1:0], tile_end_i.colour_pitch[UnitBits-1:0],
                    tile_end_i.depth[UnitBits-1:0], tile_end_i.depth_pitch[UnitBits-1:0]};

`ifndef SYNTHESIS
  logic [3:0] unread, unfinished;  // tiles that have ended and are not yet read, or not yet done
  assign unread = ended_q - read_i;
  assign unfinished = ended_q - done_q;

  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      colour_in_units: assert (!take || tile_end_i.colour_output != gloss_pkg::TILE_OUTPUT_STORE ||
          {tile_end_i.colour[UnitBits-1:0], tile_end_i.colour_pitch[UnitBits-1:0]} == '0);
      depth_in_units: assert (!take || tile_end_i.depth_output != gloss_pkg::TILE_OUTPUT_STORE ||
          {tile_end_i.depth[UnitBits-1:0], tile_end_i.depth_pitch[UnitBits-1:0]} == '0);
      read_after_end: assert (unread <= unfinished);
      row_of_a_tile: assert (!(row_stored_i || row_answered_i) || unfinished != '0);
    end
  end
`endif

endmodule
