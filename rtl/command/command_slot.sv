// SPDX-License-Identifier: Apache-2.0
// The slot table and the check of an access against it: the only way from a stream's offsets to
// addresses. A lookup begins with lookup_i; its other inputs hold until its result, valid_o,
// three clocks later. No sum here can overflow, but the address: whoever writes the table sees to
// base + size <= 2^32.
module command_slot (
  input  logic        clk_i,
  input  logic        rst_ni,

  // the table, written between jobs
  input  logic        slot_write_i,
  input  logic [3:0]  slot_index_i,
  input  logic [31:0] slot_base_i,
  input  logic [31:0] slot_size_i,
  input  logic [1:0]  slot_rights_i,

  // may bytes offset_i to offset_i + extent_i - 1 of the slot be read (written, with write_i)?
  input  logic        lookup_i,
  input  logic [3:0]  slot_i,
  input  logic        write_i,
  input  logic [31:0] offset_i,
  input  logic [gloss_pkg::ExtentBits-1:0] extent_i,

  output logic        valid_o,
  output logic        allowed_o,
  output logic [31:0] address_o
);

  logic [31:0] base, size;
  logic [1:0]  rights;
  logic [gloss_pkg::ExtentBits-1:0] extent_q;
  logic [32:0] end_q;
  logic [31:0] address_q;
  logic        right_q, allowed_q;
  logic [2:0]  lookup_q;

  ram_1r1w #(
    .Width($bits({slot_rights_i, slot_size_i, slot_base_i})),
    .Depth(gloss_pkg::Slots)
  ) u_slots (
    .clk_i       (clk_i),
    .write_en_i  (slot_write_i),
    .write_addr_i(slot_index_i),
    .write_data_i({slot_rights_i, slot_size_i, slot_base_i}),
    .read_en_i   (lookup_i),
    .read_addr_i (slot_i),
    .read_data_o ({rights, size, base})
  );

  assign valid_o = lookup_q[2];
  assign allowed_o = allowed_q;
  assign address_o = address_q;

  always_ff @(posedge clk_i) begin
    extent_q <= extent_i;
    end_q <= {1'b0, offset_i} + 33'(extent_q);
    address_q <= base + offset_i;
    right_q <= |(rights & (write_i ? gloss_pkg::RIGHTS_WRITE : gloss_pkg::RIGHTS_READ));
    allowed_q <= right_q && end_q <= {1'b0, size};
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) lookup_q <= '0;
    else lookup_q <= {lookup_q[1:0], lookup_i};
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      lookup_holds: assert (lookup_q[1:0] == '0 || $stable({write_i, offset_i, extent_i}));
      one_lookup: assert (lookup_q == '0 || !lookup_i);
      table_holds: assert (!slot_write_i || !(lookup_i || lookup_q != '0));
    end
  end
`endif

endmodule
