// SPDX-License-Identifier: Apache-2.0
// Executes the packets that set state, open and close tiles, copy memory or answer counters: takes
// the payload a word at a time, checks it, and hands on what it asks for. These packets are rare
// beside triangles, so each step has its own clock. Answers start_i or drop_i with either done_o or
// refuse_o; nothing of a refused packet was handed on.
module command_packet #(
  parameter int unsigned TileSize = 64
) (
  input  logic                      clk_i,
  input  logic                      rst_ni,

  input  logic                      clear_i,    // a job starts: no surface is set
  input  logic                      start_i,
  input  logic                      drop_i,     // close the open tile and keep nothing of it
  output logic                      done_o,
  output logic                      refuse_o,
  output logic [3:0]                cause_o,    // FAULT_*, at the word taken last
  output logic                      in_tile_o,

  input  logic [31:0]               header_i,   // holds

  // payload: word_i is the word taken last, the header before any
  input  logic                      word_valid_i,
  output logic                      word_take_o,
  input  logic [31:0]               word_i,
  input  logic [31:0]               word_next_i,

  // to the render queue; the data are word_i
  output logic                      push_o,
  output logic [2:0]                push_kind_o,
  output logic [2:0]                push_part_o,
  input  logic                      push_ready_i,

  // to command_slot
  output logic                      lookup_o,
  output logic [3:0]                lookup_slot_o,
  output logic                      lookup_write_o,
  output logic [gloss_pkg::ExtentBits-1:0] lookup_extent_o,
  input  logic                      lookup_valid_i,
  input  logic                      lookup_allowed_i,
  input  logic [31:0]               lookup_address_i,

  // to command_answer
  output logic [15:0]               answer_words_o,
  input  logic                      answer_short_i,
  output logic                      answer_reserve_o,
  output logic                      answer_send_o,
  input  logic                      answer_sent_i,
  output logic                      tile_ended_o,

  // to tile
  output logic                      tile_begin_valid_o,
  input  logic                      tile_begin_ready_i,
  output gloss_pkg::tile_begin_op_t tile_begin_o,
  output logic                      tile_end_valid_o,
  input  logic                      tile_end_ready_i,
  output gloss_pkg::tile_end_op_t   tile_end_o,
  input  logic                      tile_idle_i,

  // to memory
  output logic                      copy_valid_o,
  input  logic                      copy_ready_i,
  output gloss_pkg::copy_op_t       copy_o,
  output logic                      copy_data_valid_o,
  input  logic                      copy_data_ready_i,
  output logic [31:0]               copy_data_o,
  input  logic                      copy_idle_i,

  output logic                      stall_stream_o,
  output logic                      stall_memory_o
);

  typedef enum logic [3:0] {
    Idle,
    WaitIdle, // until everything before is finished
    Fetch,    // a payload word,
    Lookup,   // ask what the slot table says,
    Verdict,  // and with its answer all that can be wrong is known
    State,    // hand on to the render queue
    Surface,
    Begin,    // tile first,
    Mark,     // then the render queue
    End,      // RENDER_END goes first: the tile can not end before its drawing has
    Close,
    Copy,
    CopyData,
    Counters
  } state_e;

  state_e      state_q, state_d, act;
  logic        second_q, dropping_q, in_tile_q;
  logic [31:0] first_q, last_q;     // payload words, offsets turned into addresses
  logic [10:0] rest_q;              // words of a write left
  logic [3:0]  colour_slot_q, depth_slot_q;
  logic [15:0] colour_pitch_q, depth_pitch_q;

  logic [7:0]  opcode;
  logic        two_words, accept, about_depth;
  logic        bad_value, not_set, access, bad_value_q, not_set_q, access_q;
  logic [3:0]  fault;
  logic [31:0] operand;
  // Some fields of each.
  // verilator lint_off UNUSEDSIGNAL
  gloss_pkg::tile_begin_header_t begin_header;
  gloss_pkg::tile_end_header_t   end_header;
  gloss_pkg::colour_surface_t    surface;
  // verilator lint_on UNUSEDSIGNAL

  assign opcode = header_i[31:24];
  assign begin_header = header_i;
  assign end_header = header_i;
  assign surface = word_i;
  assign two_words = header_i[10:0] >= 11'd2;
  assign about_depth = second_q;

  command_access #(
    .TileSize(TileSize)
  ) u_access (
    .header_i       (header_i),
    .second_i       (second_q),
    .word_i         (word_i),
    .first_i        (first_q),
    .surface_slot_i (about_depth ? depth_slot_q : colour_slot_q),
    .surface_pitch_i(about_depth ? depth_pitch_q : colour_pitch_q),
    .bad_value_o    (bad_value),
    .not_set_o      (not_set),
    .access_o       (access),
    .slot_o         (lookup_slot_o),
    .write_o        (lookup_write_o),
    .extent_o       (lookup_extent_o),
    .answer_o       (answer_words_o)
  );

  always_comb begin
    unique case (opcode)
      gloss_pkg::OP_COLOUR_SURFACE, gloss_pkg::OP_DEPTH_SURFACE: act = Surface;
      gloss_pkg::OP_TILE_BEGIN: act = Begin;
      gloss_pkg::OP_TILE_END: act = End;
      gloss_pkg::OP_WRITE_MEMORY, gloss_pkg::OP_READ_MEMORY: act = Copy;
      gloss_pkg::OP_COUNTERS: act = Counters;
      default: act = State;
    endcase
  end

  always_comb begin
    fault = gloss_pkg::FAULT_NONE;
    if (bad_value_q) fault = gloss_pkg::FAULT_VALUE;
    else if (not_set_q) fault = gloss_pkg::FAULT_ORDER;
    else if (access_q && !lookup_allowed_i) fault = gloss_pkg::FAULT_SLOT;
    else if (answer_short_i) fault = gloss_pkg::FAULT_RESPONSE;
  end

  always_comb begin
    state_d = state_q;
    done_o = 1'b0;
    refuse_o = 1'b0;
    accept = 1'b0;
    word_take_o = 1'b0;
    push_o = 1'b0;
    push_kind_o = gloss_pkg::RENDER_STATE;
    lookup_o = 1'b0;
    answer_send_o = 1'b0;
    tile_begin_valid_o = 1'b0;
    tile_end_valid_o = 1'b0;
    copy_valid_o = 1'b0;
    copy_data_valid_o = 1'b0;
    unique case (state_q)
      Idle: begin
        if (drop_i) state_d = End;
        if (start_i) begin
          unique case (opcode)
            gloss_pkg::OP_WRITE_MEMORY, gloss_pkg::OP_READ_MEMORY, gloss_pkg::OP_COUNTERS:
              state_d = WaitIdle;
            gloss_pkg::OP_DEPTH_STATE, gloss_pkg::OP_COLOUR_MASK: state_d = State;
            default: state_d = Fetch;
          endcase
        end
      end
      WaitIdle:
        if (tile_idle_i && copy_idle_i)
          state_d = opcode == gloss_pkg::OP_COUNTERS ? Lookup : Fetch;
      Fetch: begin
        word_take_o = word_valid_i;
        if (word_valid_i) state_d = Lookup;
      end
      Lookup: begin
        lookup_o = 1'b1;
        state_d = Verdict;
      end
      Verdict:
        if (lookup_valid_i) begin
          accept = fault == gloss_pkg::FAULT_NONE;
          refuse_o = !accept;
        end
      State: begin
        push_o = 1'b1;
        done_o = push_ready_i;
      end
      Surface: done_o = 1'b1;
      Begin: begin
        // A copy never runs beside a tile.
        tile_begin_valid_o = copy_idle_i;
        if (tile_begin_valid_o && tile_begin_ready_i) state_d = Mark;
      end
      Mark: begin
        push_o = 1'b1;
        push_kind_o = gloss_pkg::RENDER_BEGIN;
        done_o = push_ready_i;
      end
      End: begin
        push_o = 1'b1;
        push_kind_o = gloss_pkg::RENDER_END;
        if (push_ready_i) state_d = Close;
      end
      Close: begin
        tile_end_valid_o = 1'b1;
        done_o = tile_end_ready_i;
      end
      Copy: begin
        copy_valid_o = 1'b1;
        if (copy_ready_i && copy_o.write) state_d = CopyData;
        else done_o = copy_ready_i;
      end
      CopyData: begin
        copy_data_valid_o = word_valid_i;
        word_take_o = word_valid_i && copy_data_ready_i;
        done_o = word_take_o && rest_q == 11'd1;
      end
      Counters: begin
        answer_send_o = 1'b1;
        done_o = answer_sent_i;
      end
      default: state_d = Idle;
    endcase
    if (accept) state_d = two_words && !second_q ? Fetch : act;
    if (done_o || refuse_o) state_d = Idle;
  end

  assign cause_o = fault;
  assign in_tile_o = in_tile_q;
  assign answer_reserve_o = accept;
  assign tile_ended_o = done_o && state_q == Close && !dropping_q;
  assign operand = access_q ? lookup_address_i : word_i;

  always_comb begin
    unique case (opcode)
      gloss_pkg::OP_DEPTH_STATE: push_part_o = gloss_pkg::STATE_DEPTH;
      gloss_pkg::OP_COLOUR_MASK: push_part_o = gloss_pkg::STATE_MASK;
      default: push_part_o = gloss_pkg::STATE_SCISSOR;
    endcase
  end

  assign tile_begin_o = {begin_header.colour_load, begin_header.depth_load,
                         first_q, colour_pitch_q, last_q, depth_pitch_q};
  assign tile_end_o = {dropping_q ? gloss_pkg::TILE_OUTPUT_DROP : end_header.colour_output,
                       dropping_q ? gloss_pkg::TILE_OUTPUT_DROP : end_header.depth_output,
                       first_q, colour_pitch_q, last_q, depth_pitch_q};
  assign copy_o = {opcode == gloss_pkg::OP_WRITE_MEMORY, last_q,
                   opcode == gloss_pkg::OP_WRITE_MEMORY ? {5'b0, rest_q} : first_q[31:16]};
  assign copy_data_o = word_next_i;

  assign stall_stream_o = (state_q == Fetch || state_q == CopyData) && !word_valid_i;
  assign stall_memory_o = state_q == WaitIdle || (state_q == Begin && !copy_idle_i) ||
                          (state_q == Copy && !copy_ready_i) ||
                          (state_q == CopyData && word_valid_i && !copy_data_ready_i);

  always_ff @(posedge clk_i) begin
    bad_value_q <= bad_value;
    not_set_q <= not_set;
    access_q <= access;
    if (accept && !second_q) first_q <= operand;
    if (accept) last_q <= operand;
    if (start_i) rest_q <= header_i[10:0] - 11'd2;
    else if (state_q == CopyData && word_take_o) rest_q <= rest_q - 1'b1;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
      second_q <= 1'b0;
      dropping_q <= 1'b0;
      in_tile_q <= 1'b0;
      {colour_slot_q, colour_pitch_q, depth_slot_q, depth_pitch_q} <= '0;
    end else begin
      state_q <= state_d;
      if (state_q == Idle) begin
        second_q <= 1'b0;
        dropping_q <= drop_i;
      end else if (accept) begin
        second_q <= 1'b1;
      end
      if (done_o && state_q == Mark) in_tile_q <= 1'b1;
      if (done_o && state_q == Close) in_tile_q <= 1'b0;
      if (clear_i) begin
        colour_pitch_q <= '0;
        depth_pitch_q <= '0;
      end else if (state_q == Surface && opcode == gloss_pkg::OP_COLOUR_SURFACE) begin
        colour_slot_q <= surface.slot;
        colour_pitch_q <= surface.pitch;
      end else if (state_q == Surface) begin
        depth_slot_q <= surface.slot;
        depth_pitch_q <= surface.pitch;
      end
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      header_holds: assert (state_q == Idle || $stable(header_i));
    end
  end
`endif

endmodule
