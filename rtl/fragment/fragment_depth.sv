// SPDX-License-Identifier: Apache-2.0
// The depth test of one pixel; combinational. The bits of a depth function are the outcomes it
// accepts: less, equal, greater.
module fragment_depth (
  input  logic [2:0]  func_i,
  input  logic [23:0] depth_i,
  input  logic [23:0] stored_i,
  output logic        pass_o
);

  logic less, equal;

  assign less = depth_i < stored_i;
  assign equal = depth_i == stored_i;
  assign pass_o = (func_i[0] && less) || (func_i[1] && equal) || (func_i[2] && !less && !equal);

endmodule
