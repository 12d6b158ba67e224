// SPDX-License-Identifier: Apache-2.0
// What a payload word asks for in the packets other than TRIANGLE: whether its own bits are right,
// which bytes of which slot it names, how much it wants to answer. COUNTERS, which has no payload,
// is asked about with its header. Combinational.
module command_access #(
  parameter int unsigned TileSize = 64
) (
  input  logic [31:0] header_i,
  input  logic        second_i,         // word_i is the second payload word, not the first
  input  logic [31:0] word_i,
  input  logic [31:0] first_i,          // the first payload word, at the second

  // the surface that the word is about, pitch 0 if it was not set
  input  logic [3:0]  surface_slot_i,
  input  logic [15:0] surface_pitch_i,

  output logic        bad_value_o,
  output logic        not_set_o,        // the surface it needs
  output logic        access_o,         // check slot, write and extent; the offset is word_i
  output logic [3:0]  slot_o,
  output logic        write_o,
  output logic [gloss_pkg::ExtentBits-1:0] extent_o, // bytes
  output logic [15:0] answer_o          // words
);

  localparam int unsigned TileBits = $clog2(TileSize);

  // Some fields of each.
  // verilator lint_off UNUSEDSIGNAL
  gloss_pkg::tile_begin_header_t begin_header;
  gloss_pkg::tile_end_header_t   end_header;
  gloss_pkg::scissor_t           scissor;
  gloss_pkg::colour_surface_t    surface;
  gloss_pkg::read_memory_t       read_memory;
  // verilator lint_on UNUSEDSIGNAL
  logic        off_word, off_tile;       // not a multiple of a word, of a row of a tile
  logic        load;
  logic [1:0]  tile_output;
  logic [gloss_pkg::ExtentBits-1:0] rows, tile_extent;
  logic [15:0] copy_words;
  logic        copy_write;

  assign begin_header = header_i;
  assign end_header = header_i;
  assign scissor = word_i;
  assign surface = word_i;
  assign read_memory = {word_i, second_i ? first_i : word_i};
  assign off_word = word_i[1:0] != '0;
  assign off_tile = word_i[TileBits+1:0] != '0;
  assign load = second_i ? begin_header.depth_load : begin_header.colour_load;
  assign tile_output = second_i ? end_header.depth_output : end_header.colour_output;

  // T-1 rows and the pixels of the last one.
  assign rows = gloss_pkg::ExtentBits'(surface_pitch_i);
  assign tile_extent = (rows << TileBits) - rows + gloss_pkg::ExtentBits'(4 * TileSize);

  assign copy_write = header_i[31:24] == gloss_pkg::OP_WRITE_MEMORY;
  assign copy_words = copy_write ? {5'b0, header_i[10:0]} - 16'd2 : read_memory.count;

  always_comb begin
    bad_value_o = 1'b0;
    not_set_o = 1'b0;
    access_o = 1'b0;
    slot_o = surface_slot_i;
    write_o = 1'b0;
    extent_o = tile_extent;
    answer_o = '0;
    unique case (header_i[31:24])
      gloss_pkg::OP_WRITE_MEMORY, gloss_pkg::OP_READ_MEMORY: begin
        slot_o = read_memory.slot;
        write_o = copy_write;
        extent_o = gloss_pkg::ExtentBits'({copy_words, 2'b0});
        if (second_i) begin
          bad_value_o = off_word;
          access_o = 1'b1;
          if (!copy_write) answer_o = copy_words;
        end else if (copy_write) begin
          bad_value_o = (word_i & gloss_pkg::WRITE_MEMORY_RESERVED[31:0]) != '0;
        end else begin
          bad_value_o = (word_i & gloss_pkg::READ_MEMORY_RESERVED[31:0]) != '0 ||
                        read_memory.count == '0;
        end
      end
      gloss_pkg::OP_COUNTERS: answer_o = 16'(gloss_pkg::CounterWords);
      gloss_pkg::OP_COLOUR_SURFACE, gloss_pkg::OP_DEPTH_SURFACE:
        bad_value_o = (word_i & gloss_pkg::COLOUR_SURFACE_RESERVED) != '0 ||
                      surface.pitch == '0 || surface.pitch[TileBits+1:0] != '0;
      gloss_pkg::OP_TILE_BEGIN:
        if (load) begin
          bad_value_o = off_tile;
          not_set_o = surface_pitch_i == '0;
          access_o = 1'b1;
        end
      gloss_pkg::OP_TILE_END:
        unique case (tile_output)
          gloss_pkg::TILE_OUTPUT_STORE: begin
            bad_value_o = off_tile;
            not_set_o = surface_pitch_i == '0;
            access_o = 1'b1;
            write_o = 1'b1;
          end
          gloss_pkg::TILE_OUTPUT_ANSWER: begin
            bad_value_o = word_i != '0;
            answer_o = 16'(TileSize * TileSize);
          end
          default: bad_value_o = word_i != '0;
        endcase
      gloss_pkg::OP_SCISSOR:
        bad_value_o = (word_i & gloss_pkg::SCISSOR_RESERVED) != '0 ||
                      scissor.x0 > 7'(TileSize) || scissor.y0 > 7'(TileSize) ||
                      scissor.x1 > 7'(TileSize) || scissor.y1 > 7'(TileSize);
      default: ;
    endcase
  end

endmodule
