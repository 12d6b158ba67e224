// SPDX-License-Identifier: Apache-2.0
// CONTROL.reset: stops both AXI masters, holds the port and the core in reset until nothing of them
// is under way at the host or in board memory, and lets go. Ends when those two have answered.
// Power-on comes in through the same door. busy_o stays until rst_no is let go, so that nobody
// gives to what is still in reset.
module port_reset (
  input  logic clk_i,
  input  logic rst_ni,

  input  logic request_i,
  output logic busy_o,

  // to the two gates
  output logic stop_o,
  input  logic stopped_i,  // both
  input  logic idle_i,     // both

  output logic rst_no
);

  typedef enum logic [1:0] {Hold, Run, Close} state_e;

  state_e state_d, state_q;
  logic rst_nq;

  assign busy_o = state_q != Run || !rst_nq;
  assign stop_o = state_q != Run;
  assign rst_no = rst_nq;

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      Hold: if (!rst_nq && idle_i) state_d = Run;
      Run: if (request_i) state_d = Close;
      Close: if (stopped_i) state_d = Hold;
      default: state_d = Hold;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Hold;
      rst_nq <= 1'b0;
    end else begin
      state_q <= state_d;
      rst_nq <= state_q != Hold;
    end
  end

endmodule
