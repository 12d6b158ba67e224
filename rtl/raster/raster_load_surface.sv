// SPDX-License-Identifier: Apache-2.0
// One channel of the colour part of a record. What a shading does not send is zero: the part's
// first row clears all that it does not hold itself. A small record's differences are short numbers
// with a scale; its value is in two parts, whole and fraction. What a row means is worked out in
// the clock of write_i and written in the next one: the fields are many and lie far apart.
module raster_load_surface #(
  parameter int unsigned StreamBits = 32,
  parameter int unsigned Channel = 0
) (
  input  logic                  clk_i,

  // from raster_load
  input  logic                  write_i,
  input  logic                  listed_i,   // a row of a small record's
  input  logic [1:0]            scale_i,    // of its first differences
  input  logic [gloss_pkg::PartRows-1:0] row_i,
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

  // Choices of four; a shift by a number would become a barrel shifter.
  function automatic logic [31:0] slope(logic [11:0] value, logic [1:0] scale);
    logic [31:0] wide;
    wide = {{20{value[11]}}, value};
    unique case (scale)
      2'd0: slope = wide << Unit;
      2'd1: slope = wide << Unit + gloss_pkg::SmallSlopeScaleShift;
      2'd2: slope = wide << Unit + 2 * gloss_pkg::SmallSlopeScaleShift;
      default: slope = wide << Unit + 3 * gloss_pkg::SmallSlopeScaleShift;
    endcase
  endfunction

  function automatic logic [31:0] bend(logic [9:0] value, logic [1:0] scale);
    logic [31:0] wide;
    wide = {{22{value[9]}}, value};
    unique case (scale)
      2'd0: bend = wide << gloss_pkg::SmallBendShift;
      2'd1: bend = wide << gloss_pkg::SmallBendShift + gloss_pkg::SmallBendScaleShift;
      2'd2: bend = wide << gloss_pkg::SmallBendShift + 2 * gloss_pkg::SmallBendScaleShift;
      default: bend = wide << gloss_pkg::SmallBendShift + 3 * gloss_pkg::SmallBendScaleShift;
    endcase
  endfunction

  logic flat, second;
  logic [$bits(surface_o)-1:0] fields; // i, dx, dy, dxx, dxy, dyy

  assign flat = shading_i == gloss_pkg::SHADING_FLAT;
  assign second = shading_i == gloss_pkg::SHADING_SECOND_ORDER;

  // ---- small ----
  logic         slope_here, bend_here;
  logic [31:0]  slope_word, bend_word;
  logic [31:0]  value;       // whole and fraction; the latter may be in a later row
  logic [159:0] differences; // dx, dy, dxx, dxy, dyy, from the low bits on

  assign slope_here = !flat && row_i[SlopeWord/Lanes];
  assign bend_here = second && row_i[BendWord/Lanes];
  assign slope_word = data_i[32*(SlopeWord%Lanes) +: 32];
  assign bend_word = data_i[32*(BendWord%Lanes) +: 32];
  assign value = {flat ? {2'b0, data_i[8*Channel +: 8]} : data_i[10*Channel +: 10], 22'd0} |
                 (slope_here ? 32'(slope_word[7:0]) << Unit : '0);
  assign differences = {bend(bend_word[29:20], bend_word[31:30]),
                        bend(bend_word[19:10], bend_word[31:30]),
                        bend(bend_word[9:0], bend_word[31:30]),
                        slope(slope_word[31:20], scale_i), slope(slope_word[19:8], scale_i)};

  for (genvar f = 0; f < 6; f++) begin : gen_field
    // Its words in the two longer forms; a plane has the first three only.
    localparam int unsigned SecondWord = 6 * Channel + f;
    localparam int unsigned LinearWord = 3 * Channel + f;

    logic        here; // this row holds the field
    logic [31:0] word, word_q, field_q;
    logic        write_q;

    if (f < 3) begin : gen_plane
      logic        longer;
      logic [31:0] sent;
      assign longer = second ? row_i[SecondWord/Lanes] : row_i[LinearWord/Lanes];
      assign sent = second ? data_i[32*(SecondWord%Lanes) +: 32] :
                             data_i[32*(LinearWord%Lanes) +: 32];
      if (f == 0) begin : gen_value
        assign here = listed_i || flat ? row_i[0] : longer;
        assign word = listed_i ? value :
                      flat ? 32'(data_i[8*Channel +: 8]) << Fraction : sent;
      end else begin : gen_slope
        assign here = listed_i ? slope_here : !flat && longer;
        assign word = listed_i ? differences[32*(f-1) +: 32] : sent;
      end
    end else begin : gen_bend
      assign here = listed_i ? bend_here : second && row_i[SecondWord/Lanes];
      assign word = listed_i ? differences[32*(f-1) +: 32] : data_i[32*(SecondWord%Lanes) +: 32];
    end

    always_ff @(posedge clk_i) begin
      write_q <= write_i && (here || row_i[0]);
      word_q <= here ? word : '0;
    end

    if (f == 0) begin : gen_fraction
      logic       fraction_here_q;
      logic [7:0] fraction_q;
      always_ff @(posedge clk_i) begin
        fraction_here_q <= write_i && listed_i && slope_here;
        fraction_q <= listed_i || here ? word[Unit +: 8] : '0;
        if (write_q) field_q <= word_q;
        if (write_q || fraction_here_q) field_q[Unit +: 8] <= fraction_q;
      end
    end else begin : gen_whole
      always_ff @(posedge clk_i) if (write_q) field_q <= word_q;
    end

    assign fields[32*(5-f) +: 32] = field_q;
  end

  assign surface_o = fields;

endmodule
