// SPDX-License-Identifier: Apache-2.0
// Finds out which tiles before a new one have to be done before its loads may read memory: those
// that store to rows it loads. Takes a begin, looks at every load of it against every store of the
// tiles that are not done, and gives the begin on with the tile that has to be waited for. This
// runs while tiles before are loaded and drawn.
//
// Two tiles' rows start at a + i * p and b + j * q, i and j from 0 to TileSize - 1, all in units of
// a row's length. Let a be the lower one: subtracting p from b - a again and again meets 0 within
// TileSize steps if and only if a row starts in the same place, for p = q. With different pitches
// the ranges must not overlap, which is to wait too often: they overlap if the difference passes
// zero within these steps.
module tile_hazard #(
  parameter int unsigned TileSize = 64,
  localparam int unsigned UnitBits = $clog2(4 * TileSize),
  localparam int unsigned AddressBits = 32 - UnitBits,
  localparam int unsigned PitchBits = 16 - UnitBits
) (
  input  logic                      clk_i,
  input  logic                      rst_ni,

  // from command
  input  logic                      tile_begin_valid_i,
  output logic                      tile_begin_ready_o,
  input  gloss_pkg::tile_begin_op_t tile_begin_i,

  output logic [3:0]                begun_o,    // tiles whose begin was taken

  // the stores before it, from tile_pending
  input  logic [3:0]                ended_i,
  input  logic [3:0]                done_i,
  output logic [1:0]                store_tile_o,
  output logic                      store_depth_o,
  input  logic [1:0]                store_output_i,
  input  logic [AddressBits-1:0]    store_address_i,
  input  logic [PitchBits-1:0]      store_pitch_i,

  // to tile_fetch
  output logic                      begin_valid_o,
  input  logic                      begin_ready_i,
  output gloss_pkg::tile_begin_op_t begin_o,
  output logic [3:0]                begin_after_o  // load when this many tiles are done
);

  localparam int unsigned StepBits = $clog2(TileSize);

  typedef enum logic [2:0] {
    Idle,
    Pick,   // the next pair,
    Sign,   // which of it starts lower,
    Swap,   // that is to be subtracted,
    Apart,  // and by how much it does
    Walk,
    Done
  } state_e;

  state_e state_d, state_q;
  gloss_pkg::tile_begin_op_t op_q;
  logic [3:0] begun_q, after_q;

  // The pair under test: a load of op_q and a store of tile_q.
  logic [3:0] tile_q;
  logic store_depth_q, load_depth_q;
  logic applies, next_pair, conflict;

  // Both addresses, then distance and pitch: registers, so that nothing is chosen before it is
  // subtracted.
  logic signed [AddressBits:0] minuend_q, difference;
  logic [AddressBits-1:0] subtrahend_q;
  logic [PitchBits-1:0] load_pitch, pitch_q;
  logic same_pitch_q, below_q, zero_q;  // zero_q: minuend_q, in Walk the distance, is
  logic [StepBits-1:0] step_q;
  logic [AddressBits-1:0] load_address;

  logic take;

  assign take = tile_begin_valid_i && tile_begin_ready_o;
  // A begin comes when all ends before it are in the table: then its number is the number of ends.
  assign tile_begin_ready_o = state_q == Idle && begun_q == ended_i;
  assign begun_o = begun_q;
  assign begin_valid_o = state_q == Done;
  assign begin_o = op_q;
  assign begin_after_o = after_q;
  assign store_tile_o = tile_q[1:0];
  assign store_depth_o = store_depth_q;

  assign load_address = load_depth_q ? op_q.depth[31:UnitBits] : op_q.colour[31:UnitBits];
  assign load_pitch = load_depth_q ? op_q.depth_pitch[15:UnitBits] : op_q.colour_pitch[15:UnitBits];
  assign applies = (load_depth_q ? op_q.depth_load : op_q.colour_load)
      && store_output_i == gloss_pkg::TILE_OUTPUT_STORE;

  assign difference = minuend_q - signed'({1'b0, subtrahend_q});

  always_comb begin
    state_d = state_q;
    next_pair = 1'b0;
    conflict = 1'b0;

    unique case (state_q)
      Idle: if (take) state_d = Pick;
      Pick: begin
        if (tile_q == begun_q - 1'b1) state_d = Done;
        else if (applies) state_d = Sign;
        else next_pair = 1'b1;
      end
      Sign: state_d = Swap;
      Swap: state_d = Apart;
      Apart: state_d = Walk;
      Walk: begin
        conflict = zero_q || (minuend_q < 0 && !same_pitch_q);
        if (zero_q || minuend_q < 0 || step_q == '1) begin
          next_pair = 1'b1;
          state_d = Pick;
        end
      end
      Done: if (begin_ready_i) state_d = Idle;
      default: state_d = Idle;
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (take) op_q <= tile_begin_i;
    zero_q <= minuend_q == signed'({1'b0, subtrahend_q});
    step_q <= state_q == Walk ? step_q + 1'b1 : '0;
    below_q <= difference < 0;
    same_pitch_q <= load_pitch == store_pitch_i;
    unique case (state_q)
      Pick: begin
        minuend_q <= signed'({1'b0, load_address});
        subtrahend_q <= store_address_i;
      end
      Sign: ;
      Swap: begin
        if (below_q) begin
          minuend_q <= signed'({1'b0, subtrahend_q});
          subtrahend_q <= minuend_q[AddressBits-1:0];
        end
        pitch_q <= below_q ? load_pitch : store_pitch_i;
      end
      default: begin
        minuend_q <= difference;
        subtrahend_q <= AddressBits'(pitch_q);
      end
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
      begun_q <= '0;
      after_q <= '0;
      tile_q <= '0;
      store_depth_q <= 1'b0;
      load_depth_q <= 1'b0;
    end else begin
      state_q <= state_d;
      if (take) begin
        begun_q <= begun_q + 1'b1;
        after_q <= done_i;
        tile_q <= done_i;
        store_depth_q <= 1'b0;
        load_depth_q <= 1'b0;
      end else begin
        if (next_pair)
          {tile_q, store_depth_q, load_depth_q} <= {tile_q, store_depth_q, load_depth_q} + 1'b1;
        if (conflict) after_q <= tile_q + 1'b1;
      end
    end
  end

endmodule
