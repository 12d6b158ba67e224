// SPDX-License-Identifier: Apache-2.0
// The depth part of a record. Wide: 40 bits each, the high bytes in a fourth word. Compact: a word
// each, sign-extended and shifted left. Small: a word for z, one for both differences and their
// scale, in the third and fourth word of PART_SMALL; depth_o has them three clocks after small_i.
module raster_load_depth #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                    clk_i,

  // from raster_load
  input  logic                    write_i,
  input  logic                    small_i,
  input  logic [gloss_pkg::PartRows-1:0] row_i,
  input  logic [StreamBits-1:0]   data_i,
  input  logic                    compact_i,

  // to shade
  output gloss_pkg::depth_plane_t depth_o
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned Low = gloss_pkg::DepthCompactShift;

  localparam int unsigned CoefficientBits = $bits(depth_o) / 3;

  logic [$bits(depth_o)-1:0] plane; // z, dx, dy
  logic [31:0]  high;
  logic         take_high, unused_high;

  assign high = data_i[32*(3%Lanes) +: 32];
  assign take_high = write_i && row_i[3/Lanes];
  assign unused_high = ^{high, row_i};

  // ---- small: what the words mean, kept for a clock ----
  logic                    take_small_z, take_small_slopes;
  logic [1:0]              small_z_q, small_slopes_q;  // that they came, one and two clocks ago
  gloss_pkg::depth_small_t words;
  logic [$bits(depth_o)-1:0] small_plane_q;

  // A choice of four; a shift by a number would become a barrel shifter.
  function automatic logic [CoefficientBits-1:0] scaled(logic [14:0] value, logic [1:0] scale);
    logic [CoefficientBits-1:0] wide;
    wide = {{(CoefficientBits-15){value[14]}}, value};
    unique case (scale)
      2'd0: scaled = wide << gloss_pkg::SmallDepthShift;
      2'd1: scaled = wide << gloss_pkg::SmallDepthShift + gloss_pkg::SmallDepthScaleShift;
      2'd2: scaled = wide << gloss_pkg::SmallDepthShift + 2 * gloss_pkg::SmallDepthScaleShift;
      default: scaled = wide << gloss_pkg::SmallDepthShift + 3 * gloss_pkg::SmallDepthScaleShift;
    endcase
  endfunction

  assign words = {data_i[32*(3%Lanes) +: 32], data_i[32*(2%Lanes) +: 32]};
  assign take_small_z = small_i && row_i[2/Lanes];
  assign take_small_slopes = small_i && row_i[3/Lanes];

  always_ff @(posedge clk_i) begin
    small_z_q <= {small_z_q[0], take_small_z};
    small_slopes_q <= {small_slopes_q[0], take_small_slopes};
    if (take_small_z) begin
      small_plane_q[CoefficientBits*2 +: CoefficientBits] <=
          CoefficientBits'(words.z) << gloss_pkg::SmallDepthShift;
    end
    if (take_small_slopes) begin
      small_plane_q[0 +: 2*CoefficientBits] <= {scaled(words.dx, words.scale),
                                                scaled(words.dy, words.scale)};
    end
  end

  for (genvar n = 0; n < 3; n++) begin : gen_word
    logic [31:0] word;
    logic        take, take_small;
    logic [CoefficientBits-1:0] value_q;

    assign word = data_i[32*(n%Lanes) +: 32];
    assign take = write_i && row_i[n/Lanes];

    assign take_small = n == 0 ? small_z_q[1] : small_slopes_q[1];

    always_ff @(posedge clk_i) begin
      // First, for it may be late from a record that was given up.
      if (take_small) value_q <= small_plane_q[CoefficientBits*(2-n) +: CoefficientBits];
      if (take) value_q[31:0] <= compact_i ? {word[31-Low:0], {Low{1'b0}}} : word;
      if (compact_i ? take : take_high) begin
        value_q[39:32] <= compact_i ? {{(8-Low){word[31]}}, word[31:32-Low]} : high[8*n +: 8];
      end
    end

    assign plane[CoefficientBits*(2-n) +: CoefficientBits] = value_q;
  end

  assign depth_o = plane;

endmodule
