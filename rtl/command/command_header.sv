// SPDX-License-Identifier: Apache-2.0
// What is wrong with a header word, in the order gloss.xml gives, a clock later.
module command_header (
  input  logic        clk_i,
  input  logic        rst_ni,

  input  logic        check_i,
  input  logic [31:0] header_i,
  input  logic [31:0] left_i,    // words of the stream from it on
  input  logic        in_tile_i,
  output logic [3:0]  fault_o    // FAULT_*, for one clock
);

  // Some fields of each.
  // verilator lint_off UNUSEDSIGNAL
  gloss_pkg::triangle_header_t       triangle;
  gloss_pkg::triangle_small_header_t small_header;
  gloss_pkg::tile_end_header_t       tile_end;
  // verilator lint_on UNUSEDSIGNAL
  logic [10:0] length, triangle_length, small_length;
  // Payloads by shading and what else counts, 16 bits for each: sums would be a chain of carries.
  logic [16*32-1:0] triangle_lengths, small_lengths;
  logic        opcode_valid, free, too_short;
  logic [31:0] reserved;
  logic [10:0] words;       // of the payload, unless any number is free
  logic        misplaced, bad_value, past_end;
  logic        checked_q, bad_opcode_q, bad_value_q, bad_end_q, misplaced_q, free_q, bad_length;
  logic [10:0] length_q, words_q;

  assign triangle = header_i;
  assign small_header = header_i;
  assign tile_end = header_i;
  assign length = header_i[10:0];

  function automatic logic [10:0] triangle_words(logic [1:0] geometry, logic alpha_linear,
                                                 logic [1:0] shading);
    triangle_words = '0;
    if (geometry == gloss_pkg::GEOMETRY_WIDE)
      triangle_words = gloss_pkg::EDGES_WIDE_WORDS + gloss_pkg::DEPTH_WIDE_WORDS;
    if (geometry == gloss_pkg::GEOMETRY_COMPACT)
      triangle_words = gloss_pkg::EDGES_COMPACT_WORDS + gloss_pkg::DEPTH_COMPACT_WORDS;
    if (geometry == gloss_pkg::GEOMETRY_COVERING)
      triangle_words = gloss_pkg::DEPTH_WIDE_WORDS;
    if (alpha_linear) triangle_words += gloss_pkg::ALPHA_LINEAR_WORDS;
    if (shading == gloss_pkg::SHADING_FLAT)
      triangle_words += gloss_pkg::COLOUR_FLAT_WORDS;
    if (shading == gloss_pkg::SHADING_LINEAR)
      triangle_words += gloss_pkg::COLOUR_LINEAR_WORDS;
    if (shading == gloss_pkg::SHADING_SECOND_ORDER)
      triangle_words += gloss_pkg::COLOUR_SECOND_ORDER_WORDS;
  endfunction

  function automatic logic [10:0] small_words(logic [2:0] row_words, logic [1:0] shading);
    small_words = gloss_pkg::PIXELS_SMALL_WORDS + gloss_pkg::DEPTH_SMALL_WORDS + 11'(row_words);
    if (shading == gloss_pkg::SHADING_FLAT)
      small_words += gloss_pkg::COLOUR_FLAT_WORDS;
    if (shading == gloss_pkg::SHADING_LINEAR)
      small_words += gloss_pkg::COLOUR_LINEAR_SMALL_WORDS;
    if (shading == gloss_pkg::SHADING_SECOND_ORDER)
      small_words += gloss_pkg::COLOUR_SECOND_ORDER_SMALL_WORDS;
  endfunction

  for (genvar n = 0; n < 32; n++) begin : gen_length
    localparam logic [4:0] Number = 5'(n);
    assign triangle_lengths[16*n +: 16] = 16'(triangle_words(Number[4:3], Number[2], Number[1:0]));
    assign small_lengths[16*n +: 16] = 16'(small_words(Number[4:2], Number[1:0]));
  end

  assign triangle_length = triangle_lengths[{triangle.geometry, triangle.alpha_linear,
                                             triangle.shading, 4'b0} +: 11];
  assign small_length = small_lengths[{small_header.row_words, small_header.shading, 4'b0} +: 11];

  always_comb begin
    opcode_valid = 1'b1;
    reserved = '0;
    words = '0;
    free = 1'b0;
    too_short = 1'b0;
    misplaced = 1'b0;
    bad_value = 1'b0;
    unique case (header_i[31:24])
      gloss_pkg::OP_NOP: begin
        reserved = gloss_pkg::NOP_HEADER_RESERVED;
        free = 1'b1;
      end
      gloss_pkg::OP_WRITE_MEMORY: begin
        reserved = gloss_pkg::WRITE_MEMORY_HEADER_RESERVED;
        free = 1'b1;
        too_short = length <= 11'd2;
        misplaced = in_tile_i;
      end
      gloss_pkg::OP_READ_MEMORY: begin
        reserved = gloss_pkg::READ_MEMORY_HEADER_RESERVED;
        words = gloss_pkg::READ_MEMORY_WORDS;
        misplaced = in_tile_i;
      end
      gloss_pkg::OP_COUNTERS: begin
        reserved = gloss_pkg::COUNTERS_HEADER_RESERVED;
        words = gloss_pkg::COUNTERS_WORDS;
        misplaced = in_tile_i;
      end
      gloss_pkg::OP_COLOUR_SURFACE: begin
        reserved = gloss_pkg::COLOUR_SURFACE_HEADER_RESERVED;
        words = gloss_pkg::COLOUR_SURFACE_WORDS;
      end
      gloss_pkg::OP_DEPTH_SURFACE: begin
        reserved = gloss_pkg::DEPTH_SURFACE_HEADER_RESERVED;
        words = gloss_pkg::DEPTH_SURFACE_WORDS;
      end
      gloss_pkg::OP_TILE_BEGIN: begin
        reserved = gloss_pkg::TILE_BEGIN_HEADER_RESERVED;
        words = gloss_pkg::TILE_BEGIN_WORDS;
        misplaced = in_tile_i;
      end
      gloss_pkg::OP_TILE_END: begin
        reserved = gloss_pkg::TILE_END_HEADER_RESERVED;
        bad_value = tile_end.colour_output > gloss_pkg::TILE_OUTPUT_ANSWER ||
                    tile_end.depth_output > gloss_pkg::TILE_OUTPUT_ANSWER;
        words = gloss_pkg::TILE_END_WORDS;
        misplaced = !in_tile_i;
      end
      gloss_pkg::OP_DEPTH_STATE: begin
        reserved = gloss_pkg::DEPTH_STATE_HEADER_RESERVED;
        words = gloss_pkg::DEPTH_STATE_WORDS;
      end
      gloss_pkg::OP_COLOUR_MASK: begin
        reserved = gloss_pkg::COLOUR_MASK_HEADER_RESERVED;
        words = gloss_pkg::COLOUR_MASK_WORDS;
      end
      gloss_pkg::OP_SCISSOR: begin
        reserved = gloss_pkg::SCISSOR_HEADER_RESERVED;
        words = gloss_pkg::SCISSOR_WORDS;
      end
      gloss_pkg::OP_TRIANGLE: begin
        reserved = gloss_pkg::TRIANGLE_HEADER_RESERVED;
        bad_value = triangle.geometry > gloss_pkg::GEOMETRY_COVERING ||
                    triangle.shading > gloss_pkg::SHADING_SECOND_ORDER;
        words = triangle_length;
        misplaced = !in_tile_i;
      end
      gloss_pkg::OP_TRIANGLE_SMALL: begin
        reserved = gloss_pkg::TRIANGLE_SMALL_HEADER_RESERVED;
        bad_value = small_header.shading > gloss_pkg::SHADING_SECOND_ORDER ||
                    small_header.row_words > gloss_pkg::ROW_WORDS_FOUR;
        words = small_length;
        misplaced = !in_tile_i;
      end
      default: opcode_valid = 1'b0;
    endcase
  end

  assign past_end = left_i[31:11] == '0 && length >= left_i[10:0];

  always_ff @(posedge clk_i) begin
    bad_opcode_q <= !opcode_valid;
    bad_value_q <= (header_i & reserved) != '0 || bad_value;
    bad_end_q <= too_short || past_end;
    free_q <= free;
    length_q <= length;
    words_q <= words;
    misplaced_q <= misplaced;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) checked_q <= 1'b0;
    else checked_q <= check_i;
  end

  // Compared a clock after the words were summed up.
  assign bad_length = bad_end_q || (!free_q && length_q != words_q);

  always_comb begin
    fault_o = gloss_pkg::FAULT_NONE;
    if (checked_q) begin
      if (bad_opcode_q) fault_o = gloss_pkg::FAULT_OPCODE;
      else if (bad_value_q) fault_o = gloss_pkg::FAULT_VALUE;
      else if (bad_length) fault_o = gloss_pkg::FAULT_LENGTH;
      else if (misplaced_q) fault_o = gloss_pkg::FAULT_ORDER;
    end
  end

endmodule
