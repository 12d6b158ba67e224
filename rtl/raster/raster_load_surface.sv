// SPDX-License-Identifier: Apache-2.0
// One channel of the colour part of a record. What a shading does not send is zero: the part's
// first row clears all that it does not hold itself.
module raster_load_surface #(
  parameter int unsigned StreamBits = 32,
  parameter int unsigned Channel = 0
) (
  input  logic                  clk_i,

  // from raster_load
  input  logic                  write_i,
  input  logic [4:0]            row_i,
  input  logic [StreamBits-1:0] data_i,
  input  logic [1:0]            shading_i,

  // to shade
  output gloss_pkg::surface_t   surface_o
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned Fraction = gloss_pkg::ColourFraction;

  logic flat, second;
  logic [$bits(surface_o)-1:0] fields; // i, dx, dy, dxx, dxy, dyy

  assign flat = shading_i == gloss_pkg::SHADING_FLAT;
  assign second = shading_i == gloss_pkg::SHADING_SECOND_ORDER;

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

    always_ff @(posedge clk_i) begin
      if (write_i && (here || row_i == '0)) field_q <= here ? word : '0;
    end

    assign fields[32*(5-f) +: 32] = field_q;
  end

  assign surface_o = fields;

endmodule
