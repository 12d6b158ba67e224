// SPDX-License-Identifier: Apache-2.0
// A block of a second-order surface to its K pixels, in closed form by additions and shifts: no
// pixel waits for the one before it. With i and p the value and first difference of pixel 0 and a
// the second difference, a pixel l has i + l*p + l(l-1)/2*a; across_i is 2*p + (K-1)*a.
//
// The pixels are a tree: 4 from 0, then 2 and 6, then the odd ones; far_q, near_q and step_q are
// the differences that lead there. Each block comes with its own dxx_i.
// Latency in clocks: 1, 3, 4, 5 for K = 1, 2, 4, 8.
module shade_surface_lanes #(
  parameter int unsigned PixelsPerClock = 1
) (
  input  logic                        clk_i,
  input  logic [31:0]                 value_i,
  input  logic [32:0]                 across_i,
  input  logic [31:0]                 dxx_i,
  output logic [8*PixelsPerClock-1:0] level_o
);

  logic [32*PixelsPerClock-1:0] pixels;

  if (PixelsPerClock == 1) begin : gen_1
    logic unused;
    assign unused = ^{across_i, dxx_i};
    assign pixels = value_i;
  end

  if (PixelsPerClock == 2) begin : gen_2
    logic [31:0] step_q, first_q, even_q, odd_q;
    logic        unused_half_q;
    always_ff @(posedge clk_i) begin
      {step_q, unused_half_q} <= across_i - {1'b0, dxx_i};
      first_q <= value_i;
      even_q <= first_q;
      odd_q <= first_q + step_q;
    end
    assign pixels = {odd_q, even_q};
  end

  if (PixelsPerClock == 4) begin : gen_4
    logic [31:0] first_q, near_q, step2_q, step0_q, step2_late_q, even0_q, even2_q;
    logic [30:0] dxx_q;
    logic        unused_half_q;
    logic [127:0] pixels_q;
    always_ff @(posedge clk_i) begin
      near_q <= across_i[31:0] - {dxx_i[30:0], 1'b0};
      {step2_q, unused_half_q} <= across_i + {1'b0, dxx_i};
      first_q <= value_i;
      dxx_q <= dxx_i[30:0];

      even0_q <= first_q;
      even2_q <= first_q + near_q;
      step0_q <= step2_q - {dxx_q, 1'b0};
      step2_late_q <= step2_q;

      pixels_q <= {even2_q + step2_late_q, even2_q, even0_q + step0_q, even0_q};
    end
    assign pixels = pixels_q;
  end

  if (PixelsPerClock == 8) begin : gen_8
    logic [31:0]  first_q, far_q, near4_q, step4_q;
    logic [30:0]  dxx_q;
    logic         unused_half_q;
    logic [31:0]  half0_q, half4_q, near0_late_q, near4_late_q;
    logic [127:0] steps_q, steps_late_q; // from pixel 0, 2, 4, 6 to the next
    logic [127:0] evens_q;
    logic [255:0] pixels_q;
    always_ff @(posedge clk_i) begin
      first_q <= value_i;
      dxx_q <= dxx_i[30:0];
      far_q <= {across_i[30:0], 1'b0} - {dxx_i[28:0], 3'b0};
      near4_q <= across_i[31:0] + {dxx_i[30:0], 1'b0};
      {step4_q, unused_half_q} <= across_i + {1'b0, dxx_i};

      half0_q <= first_q;
      half4_q <= first_q + far_q;
      near0_late_q <= near4_q - {dxx_q[28:0], 3'b0};
      near4_late_q <= near4_q;
      steps_q <= {step4_q + {dxx_q, 1'b0}, step4_q, step4_q - {dxx_q, 1'b0},
                  step4_q - {dxx_q[29:0], 2'b0}};

      evens_q <= {half4_q + near4_late_q, half4_q, half0_q + near0_late_q, half0_q};
      steps_late_q <= steps_q;

      for (int l = 0; l < 4; l++) begin
        pixels_q[64*l +: 32] <= evens_q[32*l +: 32];
        pixels_q[64*l+32 +: 32] <= evens_q[32*l +: 32] + steps_late_q[32*l +: 32];
      end
    end
    assign pixels = pixels_q;
  end

  // 10 bits of integer: negative to 0, above 255 to 255
  for (genvar l = 0; l < PixelsPerClock; l++) begin : gen_level
    logic [9:0] whole;
    logic       unused;
    assign whole = pixels[32*l+22 +: 10];
    assign unused = ^pixels[32*l +: 22];
    always_ff @(posedge clk_i) begin
      level_o[8*l +: 8] <= whole[9] ? 8'd0 : whole[8] ? 8'd255 : whole[7:0];
    end
  end

endmodule
