// SPDX-License-Identifier: Apache-2.0
// One channel of the colour part of a record. What a shading does not send is zero: the part's
// first row clears all that it does not hold itself. A small record's differences are short numbers
// with a scale; its value is in two parts, whole and fraction.
module raster_load_surface #(
  parameter int unsigned StreamBits = 32,
  parameter int unsigned Channel = 0
) (
  input  logic                  clk_i,

  // from raster_load
  input  logic                  write_i,
  input  logic                  small_i,    // write a small record's; not with write_i
  input  logic [1:0]            scale_i,    // of its first differences
  input  logic [4:0]            row_i,
  input  logic [StreamBits-1:0] data_i,
  input  logic [1:0]            shading_i,

  // to shade
  output gloss_pkg::surface_t   surface_o
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned Fraction = gloss_pkg::ColourFraction;

  // Words of the small form, and what they are shifted by.
  localparam int unsigned SlopeWord = 1 + Channel;
  localparam int unsigned BendWord = 4 + Channel;
  localparam int unsigned Unit = gloss_pkg::SmallSlopeShift;

  logic flat, second;
  logic [$bits(surface_o)-1:0] fields; // i, dx, dy, dxx, dxy, dyy

  assign flat = shading_i == gloss_pkg::SHADING_FLAT;
  assign second = shading_i == gloss_pkg::SHADING_SECOND_ORDER;

  logic        slope_here, bend_here;
  logic [31:0] slope_word, bend_word;
  logic [4:0]  slope_shift, bend_shift;
  logic        unused_fraction;

  assign slope_here = !flat && row_i == 5'(SlopeWord / Lanes);
  assign bend_here = second && row_i == 5'(BendWord / Lanes);
  assign slope_word = data_i[32*(SlopeWord%Lanes) +: 32];
  assign bend_word = data_i[32*(BendWord%Lanes) +: 32];
  assign slope_shift = 5'(Unit) + 5'(scale_i) * 5'(gloss_pkg::SmallSlopeScaleShift);
  assign bend_shift = 5'(gloss_pkg::SmallBendShift) +
                      5'(bend_word[31:30]) * 5'(gloss_pkg::SmallBendScaleShift);
  assign unused_fraction = ^slope_word;

  for (genvar f = 0; f < 6; f++) begin : gen_field
    // Its words in the two longer forms; a plane has the first three only.
    localparam int unsigned SecondWord = 6 * Channel + f;
    localparam int unsigned LinearWord = 3 * Channel + f;

    logic        here; // this row holds the field
    logic [31:0] word, field_q;

    if (f < 3) begin : gen_plane
      logic        longer;
      logic [31:0] sent;
      assign longer = row_i == (second ? 5'(SecondWord / Lanes) : 5'(LinearWord / Lanes));
      assign sent = second ? data_i[32*(SecondWord%Lanes) +: 32] :
                             data_i[32*(LinearWord%Lanes) +: 32];
      if (f == 0) begin : gen_value
        assign here = flat ? row_i == '0 : longer;
        assign word = flat ? 32'(data_i[8*Channel +: 8]) << Fraction : sent;
      end else begin : gen_slope
        assign here = !flat && longer;
        assign word = sent;
      end
    end else begin : gen_bend
      assign here = second && row_i == 5'(SecondWord / Lanes);
      assign word = data_i[32*(SecondWord%Lanes) +: 32];
    end

    // What a small record's row holds of it; the value has its fraction in a word of its own.
    logic        small_here;
    logic [31:0] small_word;

    if (f == 0) begin : gen_small_value
      assign small_here = row_i == '0;
      assign small_word = flat ? word : {data_i[10*Channel +: 10], 22'd0};
    end else if (f < 3) begin : gen_small_slope
      assign small_here = slope_here;
      assign small_word = {{20{slope_word[12*f+7]}}, slope_word[12*f-4 +: 12]} << slope_shift;
    end else begin : gen_small_bend
      assign small_here = bend_here;
      assign small_word = {{22{bend_word[10*f-21]}}, bend_word[10*f-30 +: 10]} << bend_shift;
    end

    always_ff @(posedge clk_i) begin
      if (write_i && (here || row_i == '0)) field_q <= here ? word : '0;
      if (small_i && (small_here || row_i == '0)) field_q <= small_here ? small_word : '0;
      if (f == 0 && small_i && slope_here) field_q[Unit +: 8] <= slope_word[7:0];
    end

    assign fields[32*(5-f) +: 32] = field_q;
  end

  assign surface_o = fields;

endmodule
