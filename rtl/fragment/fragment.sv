// SPDX-License-Identifier: Apache-2.0
// Tests blocks of pixels against the tile's depth and merges them into the tile: K pixels a clock,
// never stalls.
//
// A block is read in the clock it arrives and written three clocks later. It may come again in that
// clock: tile then hands on what is written. raster keeps that distance.
module fragment #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  localparam int unsigned XBits = $clog2(TileSize / PixelsPerClock),
  localparam int unsigned YBits = $clog2(TileSize)
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // from raster_shade
  input  logic                         block_valid_i,
  input  logic [XBits-1:0]             block_x_i,
  input  logic [YBits-1:0]             block_y_i,
  input  logic [PixelsPerClock-1:0]    block_mask_i,
  input  logic [32*PixelsPerClock-1:0] block_colour_i,
  input  logic [24*PixelsPerClock-1:0] block_depth_i,
  input  gloss_pkg::pixel_state_t      block_state_i,
  input  logic                         end_i,
  input  logic                         end_bank_i,

  // to tile: the row {y, x} of a bank; its clear values are there two clocks after the read, the
  // row three clocks after. A word that is not fresh was not written in this tile: it stands for
  // the clear value.
  output logic                         read_en_o,
  output logic                         read_bank_o,
  output logic [YBits+XBits-1:0]       read_row_o,
  input  logic [31:0]                  clear_colour_i,
  input  logic [31:0]                  clear_depth_i,
  input  logic [32*PixelsPerClock-1:0] row_colour_i,
  input  logic [32*PixelsPerClock-1:0] row_depth_i,
  input  logic                         row_colour_fresh_i,
  input  logic                         row_depth_fresh_i,
  output logic                         write_en_o,
  output logic                         write_bank_o,
  output logic [YBits+XBits-1:0]       write_row_o,
  output logic [32*PixelsPerClock-1:0] write_colour_o,
  output logic [32*PixelsPerClock-1:0] write_depth_o,
  output logic                         end_o,       // the bank's last block is written and counted
  output logic                         end_bank_o,

  // to command
  input  logic                         work_clear_i,
  output logic [31:0]                  covered_o,
  output logic [31:0]                  passed_o
);

  localparam int unsigned K = PixelsPerClock;

  // One clock after the block came it waits for tile.
  logic                    wait_valid_q;
  logic [YBits+XBits-1:0]  wait_row_q;
  logic [K-1:0]            wait_mask_q;
  logic [32*K-1:0]         wait_colour_q;
  logic [24*K-1:0]         wait_depth_q;
  gloss_pkg::pixel_state_t wait_state_q;

  // Two clocks after: its test against the clear value, for words that turn out not to be fresh.
  logic                    test_valid_q;
  logic [YBits+XBits-1:0]  test_row_q;
  logic [K-1:0]            test_mask_q, test_pass;
  logic [32*K-1:0]         test_colour_q;
  logic [24*K-1:0]         test_depth_q;
  gloss_pkg::pixel_state_t test_state_q;

  // Three clocks after: the row is there, tested and written.
  logic                    merge_valid_q;
  logic [YBits+XBits-1:0]  merge_row_q;
  logic [K-1:0]            merge_mask_q, merge_clear_pass_q, merge_stored_pass, merge_pass;
  logic [32*K-1:0]         merge_colour_q;
  logic [24*K-1:0]         merge_depth_q;
  gloss_pkg::pixel_state_t merge_state_q;
  logic [31:0]             merge_clear_colour_q, merge_clear_depth_q;

  // The last block of a tile came a clock before end_i at the latest; six clocks after a block it
  // is counted.
  logic [4:0] end_q, end_bank_q;

  assign read_en_o = block_valid_i;
  assign read_bank_o = block_state_i.bank;
  assign read_row_o = {block_y_i, block_x_i};

  assign merge_pass = merge_mask_q & (row_depth_fresh_i ? merge_stored_pass : merge_clear_pass_q);

  assign write_en_o = merge_valid_q;
  assign write_bank_o = merge_state_q.bank;
  assign write_row_o = merge_row_q;

  assign end_o = end_q[4];
  assign end_bank_o = end_bank_q[4];

  for (genvar l = 0; l < K; l++) begin : gen_lane
    fragment_depth u_test_clear (
      .func_i  (test_state_q.depth_func),
      .depth_i (test_depth_q[24*l+:24]),
      .stored_i(clear_depth_i[23:0]),
      .pass_o  (test_pass[l])
    );

    fragment_depth u_test_stored (
      .func_i  (merge_state_q.depth_func),
      .depth_i (merge_depth_q[24*l+:24]),
      .stored_i(row_depth_i[32*l+:24]),
      .pass_o  (merge_stored_pass[l])
    );

    fragment_merge u_merge (
      .pass_i         (merge_pass[l]),
      .colour_mask_i  (merge_state_q.colour_mask),
      .depth_write_i  (merge_state_q.depth_write),
      .colour_i       (merge_colour_q[32*l+:32]),
      .depth_i        (merge_depth_q[24*l+:24]),
      .colour_fresh_i (row_colour_fresh_i),
      .depth_fresh_i  (row_depth_fresh_i),
      .stored_colour_i(row_colour_i[32*l+:32]),
      .stored_depth_i (row_depth_i[32*l+:32]),
      .clear_colour_i (merge_clear_colour_q),
      .clear_depth_i  (merge_clear_depth_q),
      .colour_o       (write_colour_o[32*l+:32]),
      .depth_o        (write_depth_o[32*l+:32])
    );
  end

  fragment_count #(
    .Width(K)
  ) u_covered (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .clear_i(work_clear_i),
    .mask_i (merge_valid_q ? merge_mask_q : '0),
    .count_o(covered_o)
  );

  fragment_count #(
    .Width(K)
  ) u_passed (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .clear_i(work_clear_i),
    .mask_i (merge_valid_q ? merge_pass : '0),
    .count_o(passed_o)
  );

  always_ff @(posedge clk_i) begin
    wait_row_q <= {block_y_i, block_x_i};
    wait_mask_q <= block_mask_i;
    wait_colour_q <= block_colour_i;
    wait_depth_q <= block_depth_i;
    wait_state_q <= block_state_i;

    test_row_q <= wait_row_q;
    test_mask_q <= wait_mask_q;
    test_colour_q <= wait_colour_q;
    test_depth_q <= wait_depth_q;
    test_state_q <= wait_state_q;

    merge_row_q <= test_row_q;
    merge_mask_q <= test_mask_q;
    merge_clear_pass_q <= test_pass;
    merge_colour_q <= test_colour_q;
    merge_depth_q <= test_depth_q;
    merge_state_q <= test_state_q;
    merge_clear_colour_q <= clear_colour_i;
    merge_clear_depth_q <= clear_depth_i;

    end_bank_q <= {end_bank_q[3:0], end_bank_i};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      wait_valid_q <= 1'b0;
      test_valid_q <= 1'b0;
      merge_valid_q <= 1'b0;
      end_q <= '0;
    end else begin
      wait_valid_q <= block_valid_i;
      test_valid_q <= wait_valid_q;
      merge_valid_q <= test_valid_q;
      end_q <= {end_q[3:0], end_i};
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      no_block_twice_in_three_clocks: assert (!block_valid_i ||
          (!(wait_valid_q && {wait_state_q.bank, wait_row_q} == {read_bank_o, read_row_o}) &&
           !(test_valid_q && {test_state_q.bank, test_row_q} == {read_bank_o, read_row_o})));
      end_after_last_block: assert (!end_i || !block_valid_i);
    end
  end
`endif

endmodule
