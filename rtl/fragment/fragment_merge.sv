// SPDX-License-Identifier: Apache-2.0
// The words of one pixel after a fragment was tested; combinational. The stencil byte of the depth
// word is kept.
module fragment_merge (
  input  logic        pass_i,
  input  logic [3:0]  colour_mask_i,
  input  logic        depth_write_i,
  input  logic [31:0] colour_i,
  input  logic [23:0] depth_i,

  // what the tile holds: a word that is not fresh stands for the clear value
  input  logic        colour_fresh_i,
  input  logic        depth_fresh_i,
  input  logic [31:0] stored_colour_i,
  input  logic [31:0] stored_depth_i,
  input  logic [31:0] clear_colour_i,
  input  logic [31:0] clear_depth_i,

  output logic [31:0] colour_o,
  output logic [31:0] depth_o
);

  logic [31:0] old_colour, old_depth;

  assign old_colour = colour_fresh_i ? stored_colour_i : clear_colour_i;
  assign old_depth = depth_fresh_i ? stored_depth_i : clear_depth_i;

  for (genvar c = 0; c < 4; c++) begin : gen_channel
    assign colour_o[8*c+:8] = pass_i && colour_mask_i[c] ? colour_i[8*c+:8] : old_colour[8*c+:8];
  end

  assign depth_o = {old_depth[31:24], pass_i && depth_write_i ? depth_i : old_depth[23:0]};

endmodule
