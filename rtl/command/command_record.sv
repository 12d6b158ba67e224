// SPDX-License-Identifier: Apache-2.0
// The rows of a triangle's record: how many words the next one has, which part it belongs to, and
// whether the row taken before it is right. A part starts in lane 0 of a row. A small record's
// header is taken with the words behind it that fill a row.
module command_record #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned StreamBits = 32
) (
  input  logic                               clk_i,
  input  logic                               rst_ni,

  input  logic                               start_i,  // header_i begins a triangle
  input  logic [31:0]                        header_i,

  // the next row
  output logic [$clog2(StreamBits/32+1)-1:0] words_o,
  output logic [2:0]                         part_o,
  output logic [4:0]                         row_o,
  output logic                               last_o,   // of the record
  input  logic                               take_i,

  // the row taken last
  input  logic [StreamBits-1:0]              data_i,
  output logic                               bad_o,
  output logic [$clog2(StreamBits/32+1)-1:0] behind_o  // words from the first bad one on
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned CountBits = $clog2(Lanes + 1);

  // Reserved bits of 16 words; the parts are padded with words that have none.
  localparam logic [511:0] WideReserved = 512'(gloss_pkg::EDGES_WIDE_RESERVED);
  localparam logic [511:0] CompactReserved = 512'(gloss_pkg::EDGES_COMPACT_RESERVED);
  localparam logic [511:0] DepthReserved = 512'(gloss_pkg::DEPTH_WIDE_RESERVED);
  // Where first_row and last_row are, in the same bits of both.
  localparam logic [3:0] WideRowsWord = 4'd2;
  localparam logic [3:0] CompactRowsWord = 4'd1;
  localparam logic [6:0] PastTile = 7'(128 - TileSize); // bits that a row of the tile has not
  // Words of PART_SMALL in its first row, and whether these are all.
  localparam int unsigned HeadWords = Lanes < gloss_pkg::SmallWords ? Lanes
                                                                  : gloss_pkg::SmallWords;
  localparam bit HeadIsRow = HeadWords == gloss_pkg::SmallWords;

  // Some fields of each.
  // verilator lint_off UNUSEDSIGNAL
  gloss_pkg::triangle_header_t       header, header_q;
  gloss_pkg::triangle_small_header_t small_now, small_header;
  // verilator lint_on UNUSEDSIGNAL
  logic                 is_small;
  logic [1:0]           shading_then, shading_now;
  logic [2:0]           part_q, part_next, after;
  logic [4:0]           row_q;
  logic [4:0]           rest_q, rest_next;  // words of the part left
  logic [CountBits-1:0] words_q;            // of the row: as many as there are and fit
  logic                 ends_q;             // the row is its part's last

  function automatic logic [4:0] part_words(logic [2:0] part, logic [1:0] geometry,
                                            logic [1:0] shading, logic [2:0] row_words);
    unique case (part)
      gloss_pkg::PART_EDGES:
        part_words = 5'(geometry == gloss_pkg::GEOMETRY_WIDE ? gloss_pkg::EDGES_WIDE_WORDS
                                                             : gloss_pkg::EDGES_COMPACT_WORDS);
      gloss_pkg::PART_DEPTH:
        part_words = 5'(geometry == gloss_pkg::GEOMETRY_COMPACT ? gloss_pkg::DEPTH_COMPACT_WORDS
                                                                : gloss_pkg::DEPTH_WIDE_WORDS);
      gloss_pkg::PART_ALPHA: part_words = 5'(gloss_pkg::ALPHA_LINEAR_WORDS);
      gloss_pkg::PART_SMALL: part_words = 5'(gloss_pkg::SmallWords - HeadWords);
      gloss_pkg::PART_SMALL_COLOUR:
        part_words = 5'(shading == gloss_pkg::SHADING_FLAT ? gloss_pkg::COLOUR_FLAT_WORDS :
                        shading == gloss_pkg::SHADING_LINEAR ?
                        gloss_pkg::COLOUR_LINEAR_SMALL_WORDS :
                        gloss_pkg::COLOUR_SECOND_ORDER_SMALL_WORDS);
      gloss_pkg::PART_SMALL_ROWS: part_words = 5'(row_words);
      default:
        part_words = 5'(shading == gloss_pkg::SHADING_FLAT ? gloss_pkg::COLOUR_FLAT_WORDS :
                        shading == gloss_pkg::SHADING_LINEAR ? gloss_pkg::COLOUR_LINEAR_WORDS :
                        gloss_pkg::COLOUR_SECOND_ORDER_WORDS);
    endcase
  endfunction

  assign header = header_i;
  assign small_now = header_i;
  assign small_header = header_q;
  assign is_small = header.opcode == gloss_pkg::OP_TRIANGLE_SMALL;
  assign shading_now = is_small ? small_now.shading : header.shading;
  assign shading_then = header_q.opcode == gloss_pkg::OP_TRIANGLE_SMALL ? small_header.shading
                                                                   : header_q.shading;
  assign words_o = words_q;
  assign part_o = part_q;
  assign row_o = row_q;
  assign last_o = ends_q && (part_q == gloss_pkg::PART_COLOUR ||
                             part_q == gloss_pkg::PART_SMALL_ROWS ||
                             (part_q == gloss_pkg::PART_SMALL_COLOUR &&
                              small_header.row_words == gloss_pkg::ROW_WORDS_NONE));

  always_comb begin
    unique case (part_q)
      gloss_pkg::PART_EDGES: after = gloss_pkg::PART_DEPTH;
      gloss_pkg::PART_DEPTH: after = header_q.alpha_linear ? gloss_pkg::PART_ALPHA
                                                           : gloss_pkg::PART_COLOUR;
      gloss_pkg::PART_SMALL: after = gloss_pkg::PART_SMALL_COLOUR;
      gloss_pkg::PART_SMALL_COLOUR: after = gloss_pkg::PART_SMALL_ROWS;
      default: after = gloss_pkg::PART_COLOUR;
    endcase
  end

  // The row that comes next is worked out beside this one.
  always_comb begin
    if (start_i) begin
      part_next = is_small && HeadIsRow ? gloss_pkg::PART_SMALL_COLOUR :
                  is_small ? gloss_pkg::PART_SMALL :
                  header.geometry == gloss_pkg::GEOMETRY_COVERING ? gloss_pkg::PART_DEPTH
                                                                  : gloss_pkg::PART_EDGES;
      rest_next = part_words(part_next, header.geometry, shading_now, '0);
    end else begin
      part_next = ends_q ? after : part_q;
      rest_next = ends_q ? part_words(after, header_q.geometry, shading_then,
                                     small_header.row_words)
                         : rest_q - 5'(Lanes);
    end
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      header_q <= '0;
      part_q <= '0;
      row_q <= '0;
      rest_q <= '0;
      words_q <= '0;
      ends_q <= 1'b0;
    end else if (start_i || take_i) begin
      if (start_i) header_q <= header_i;
      part_q <= part_next;
      if (start_i) row_q <= is_small && !HeadIsRow ? 5'd1 : 5'd0;
      else row_q <= ends_q ? '0 : row_q + 1'b1;
      rest_q <= rest_next;
      words_q <= rest_next > 5'(Lanes) ? CountBits'(Lanes) : rest_next[CountBits-1:0];
      ends_q <= rest_next <= 5'(Lanes);
    end
  end

  // ---- the check, one clock behind; what to look for is worked out when the row is taken ----
  logic [CountBits-1:0] checked_words_q;
  logic [Lanes-1:0]     bad_lane;
  logic                 bad_pixels;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) checked_words_q <= '0;
    else if (start_i) checked_words_q <= CountBits'(HeadWords);
    else if (take_i) checked_words_q <= words_o;
  end

  // The second word of a small record.
  // verilator lint_off UNUSEDSIGNAL
  gloss_pkg::pixels_small_t pixels;
  // verilator lint_on UNUSEDSIGNAL
  logic [6:0] last_pixels;
  logic       pixels_here_q, many;  // many: rows that no words are sent for

  always_ff @(posedge clk_i) begin
    if (start_i) pixels_here_q <= is_small && Lanes > 1;
    else if (take_i)
      pixels_here_q <= Lanes == 1 && part_q == gloss_pkg::PART_SMALL && row_q == 5'd1;
  end

  assign pixels = data_i[32*(1 % Lanes) +: 32];
  assign last_pixels = 7'(pixels.first_row) + 7'(pixels.last_row);
  assign many = !small_header.row_words[2] &&
                pixels.last_row > {small_header.row_words[1:0], 2'b01};
  assign bad_pixels = pixels_here_q && (many || (last_pixels & PastTile) != '0);

  for (genvar l = 0; l < Lanes; l++) begin : gen_lane
    logic [31:0] value, reserved, reserved_q;
    logic [3:0]  word;
    logic        rows_here, rows_here_q;
    logic [6:0]  last_row;

    assign word = 4'(row_q * 5'(Lanes)) | 4'(l);

    always_comb begin
      reserved = '0;
      rows_here = 1'b0;
      unique case (part_q)
        gloss_pkg::PART_EDGES:
          if (header_q.geometry == gloss_pkg::GEOMETRY_WIDE) begin
            reserved = WideReserved[{word, 5'b0} +: 32];
            rows_here = word == WideRowsWord;
          end else begin
            reserved = CompactReserved[{word, 5'b0} +: 32];
            rows_here = word == CompactRowsWord;
          end
        gloss_pkg::PART_DEPTH:
          if (header_q.geometry != gloss_pkg::GEOMETRY_COMPACT)
            reserved = DepthReserved[{word, 5'b0} +: 32];
        gloss_pkg::PART_COLOUR, gloss_pkg::PART_SMALL_COLOUR:
          if (shading_then == gloss_pkg::SHADING_FLAT) reserved = gloss_pkg::COLOUR_FLAT_RESERVED;
        default: ;
      endcase
      if (CountBits'(l) >= words_q) begin
        reserved = '0;
        rows_here = 1'b0;
      end
    end

    always_ff @(posedge clk_i) begin
      if (start_i) begin
        reserved_q <= '0;
        rows_here_q <= 1'b0;
      end else if (take_i) begin
        reserved_q <= reserved;
        rows_here_q <= rows_here;
      end
    end

    assign value = data_i[32*l +: 32];
    assign last_row = {1'b0, value[21:16]} + {1'b0, value[29:24]};
    assign bad_lane[l] = (value & reserved_q) != '0 ||
                         (rows_here_q && (last_row & PastTile) != '0) ||
                         (l == 1 % Lanes && bad_pixels);
  end

  always_comb begin
    bad_o = |bad_lane;
    behind_o = '0;
    for (int l = Lanes - 1; l >= 0; l--)
      if (bad_lane[l]) behind_o = checked_words_q - CountBits'(l);
  end

endmodule
