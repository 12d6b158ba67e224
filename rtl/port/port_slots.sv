// SPDX-License-Identifier: Apache-2.0
// A job's slot table: read from host memory ahead of the job, in four bursts of 64 bytes, and kept;
// copied to the core, an entry a clock, when the job before has ended. Nothing of a base's low bits
// reaches the core: the bursts of its memory port rely on it.
module port_slots #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  input  logic                  load_i,
  input  logic [63:6]           table_i,
  output logic                  loaded_o,
  input  logic                  copy_i,
  output logic                  copied_o,

  // host reads
  output logic                  read_valid_o,
  input  logic                  read_ready_i,
  output logic [63:6]           read_address_o,
  input  logic                  beat_valid_i,
  input  logic [StreamBits-1:0] beat_data_i,

  // core
  output logic                  slot_write_o,
  output logic [3:0]            slot_index_o,
  output logic [31:0]           slot_base_o,
  output logic [31:0]           slot_size_o,
  output logic [1:0]            slot_rights_o
);

  localparam int unsigned EntryBeats = gloss_pkg::SLOT_ENTRY_BITS / StreamBits;
  localparam int unsigned BeatBits = $clog2(gloss_pkg::Slots * EntryBeats);

  logic [2:0] left_q;  // bursts not asked for
  logic [63:6] address_q;
  logic [BeatBits-1:0] beat_q;
  logic beat_ends;     // an entry
  logic write_q;
  logic [3:0] index_q;
  // verilator lint_off UNUSEDSIGNAL
  gloss_pkg::slot_entry_t entry;
  // verilator lint_on UNUSEDSIGNAL
  logic [gloss_pkg::SLOT_ENTRY_BITS-1:0] entry_q;
  logic loaded_q, copy_q, copied_q;
  logic [3:0] copy_index_q, slot_index_q;

  assign read_valid_o = left_q != '0;
  assign read_address_o = address_q;
  assign loaded_o = loaded_q;
  assign copied_o = copied_q && slot_index_q == '1;
  assign entry = entry_q;

  assign beat_ends = (beat_q & BeatBits'(EntryBeats - 1)) == BeatBits'(EntryBeats - 1);

  if (EntryBeats == 1) begin : gen_whole
    always_ff @(posedge clk_i) if (beat_valid_i) entry_q <= beat_data_i;
  end else begin : gen_part
    always_ff @(posedge clk_i)
      if (beat_valid_i)
        entry_q <= {beat_data_i, entry_q[gloss_pkg::SLOT_ENTRY_BITS-1:StreamBits]};
  end

  ram_1r1w #(
    .Width($bits({slot_rights_o, slot_size_o, slot_base_o[31:12]})),
    .Depth(gloss_pkg::Slots)
  ) u_entries (
    .clk_i       (clk_i),
    .write_en_i  (write_q),
    .write_addr_i(index_q),
    .write_data_i({entry.rights, entry.size, entry.base[31:12]}),
    .read_en_i   (copy_q),
    .read_addr_i (copy_index_q),
    .read_data_o ({slot_rights_o, slot_size_o, slot_base_o[31:12]})
  );
  assign slot_base_o[11:0] = '0;
  assign slot_write_o = copied_q;
  assign slot_index_o = slot_index_q;

  always_ff @(posedge clk_i) begin
    if (load_i) address_q <= table_i;
    else if (read_valid_o && read_ready_i) address_q <= address_q + 1'b1;
    index_q <= 4'(beat_q >> $clog2(EntryBeats));
    slot_index_q <= copy_index_q;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q <= '0;
      beat_q <= '0;
      write_q <= 1'b0;
      loaded_q <= 1'b0;
      copy_q <= 1'b0;
      copy_index_q <= '0;
      copied_q <= 1'b0;
    end else begin
      if (load_i) left_q <= 3'd4;
      else if (read_valid_o && read_ready_i) left_q <= left_q - 1'b1;
      if (beat_valid_i) beat_q <= beat_q + 1'b1;
      write_q <= beat_valid_i && beat_ends;
      if (load_i) loaded_q <= 1'b0;
      else if (write_q && index_q == '1) loaded_q <= 1'b1;
      if (copy_i) copy_q <= 1'b1;
      else if (copy_index_q == '1) copy_q <= 1'b0;
      if (copy_q) copy_index_q <= copy_index_q + 1'b1;
      copied_q <= copy_q;
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      loaded_before_copied: assert (!copy_i || loaded_o);
    end
  end
`endif

endmodule
