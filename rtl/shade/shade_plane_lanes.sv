// SPDX-License-Identifier: Apache-2.0
// A block of a plane to its K pixels: pixel l has value_i + l*dx_i, as a tree of additions like
// shade_surface_lanes and with its latency, so the tree waits one clock for K > 1. Each block comes
// with its own dx_i.
module shade_plane_lanes #(
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned Width = 40,
  parameter int unsigned Fraction = 12,
  parameter int unsigned LevelBits = 24
) (
  input  logic                                clk_i,
  input  logic [Width-1:0]                    value_i,
  input  logic [Width-1:0]                    dx_i,
  output logic [LevelBits*PixelsPerClock-1:0] level_o
);

  logic [Width*PixelsPerClock-1:0] pixels;

  if (PixelsPerClock == 1) begin : gen_1
    logic unused;
    assign unused = ^dx_i;
    assign pixels = value_i;
  end else begin : gen_many
    // Level s of the tree has 2^s pixels, K/2^s apart.
    localparam int unsigned Levels = $clog2(PixelsPerClock);
    logic [Width-1:0]        first_q;
    logic [Width*Levels-1:0] dx_q;  // of the block in each level but the last
    always_ff @(posedge clk_i) begin
      first_q <= value_i;
      dx_q <= (Width*Levels)'({dx_q, dx_i});
    end
    for (genvar s = 0; s <= Levels; s++) begin : gen_level
      logic [Width*2**s-1:0] nodes;
      if (s == 0) begin : gen_root
        assign nodes = first_q;
      end else begin : gen_split
        for (genvar n = 0; n < 2**s / 2; n++) begin : gen_node
          logic [Width-1:0] parent, left_q, right_q;
          assign parent = gen_level[s-1].nodes[Width*n +: Width];
          always_ff @(posedge clk_i) begin
            left_q <= parent;
            right_q <= parent + (dx_q[Width*(s-1) +: Width] << (Levels - s));
          end
          assign nodes[2*Width*n +: 2*Width] = {right_q, left_q};
        end
      end
    end
    assign pixels = gen_level[Levels].nodes;
  end

  for (genvar l = 0; l < PixelsPerClock; l++) begin : gen_clamp
    logic [Width-1-Fraction:0] whole;
    logic                      unused;
    assign whole = pixels[Width*l+Fraction +: Width-Fraction];
    assign unused = ^pixels[Width*l +: Fraction];
    always_ff @(posedge clk_i) begin
      if (whole[Width-1-Fraction]) level_o[LevelBits*l +: LevelBits] <= '0;
      else if (|whole[Width-2-Fraction:LevelBits]) level_o[LevelBits*l +: LevelBits] <= '1;
      else level_o[LevelBits*l +: LevelBits] <= whole[LevelBits-1:0];
    end
  end

endmodule
