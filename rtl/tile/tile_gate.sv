// SPDX-License-Identifier: Apache-2.0
// Holds what command wants drawn until a bank is ready for it. RENDER_BEGIN ends here: it waits for
// the bank of its tile (banks take turns) and lets the ops after it through, marked with that bank.
// Combinational from command to raster.
module tile_gate #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  // from command's render queue
  input  logic                  render_valid_i,
  output logic                  render_ready_o,
  input  gloss_pkg::render_op_t render_op_i,
  input  logic [StreamBits-1:0] render_data_i,

  // to raster_shade
  output logic                  raster_valid_o,
  input  logic                  raster_ready_i,
  output gloss_pkg::render_op_t raster_op_o,
  output logic [StreamBits-1:0] raster_data_o,
  output logic                  raster_bank_o,

  // from tile_load
  input  logic                  bank_ready_i,  // pulse: the next bank in turn can be drawn
  output logic                  stall_o        // a tile's ops wait for it
);

  logic begins, open, bank_q;
  logic [1:0] ready_q;  // banks made ready and not begun: one a bank at most

  assign begins = render_valid_i && render_op_i.kind == gloss_pkg::RENDER_BEGIN;
  assign open = begins && ready_q != '0;
  assign stall_o = begins && ready_q == '0;

  assign render_ready_o = render_op_i.kind == gloss_pkg::RENDER_BEGIN ? ready_q != '0
                                                                      : raster_ready_i;
  assign raster_valid_o = render_valid_i && !begins;
  assign raster_op_o = render_op_i;
  assign raster_data_o = render_data_i;
  assign raster_bank_o = bank_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bank_q <= 1'b1;  // tile 0 is in bank 0
      ready_q <= '0;
    end else begin
      if (open) bank_q <= !bank_q;
      ready_q <= ready_q + 2'(bank_ready_i) - 2'(open);
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      one_ready_a_bank: assert (ready_q <= 2'd2);
    end
  end
`endif

endmodule
