// SPDX-License-Identifier: Apache-2.0
// Command: reads a job's stream, checks every packet against gloss.xml and the slot table before it
// has any effect, and hands on what it asks for.
//
//   stream -> command_align -> command_decode -> render queue           triangles, a row a clock
//                                 command_packet -> tile, memory        all else, a step a clock
//
// TILE_BEGIN and TILE_END go to tile at once and leave a mark in the render queue; so loading runs
// ahead of drawing. The queue is as deep as block RAM is anyway; it is what lets a tile of small
// triangles be loaded and stored beside the drawing of others. tile_idle_i and copy_idle_i fall a
// clock after their op was taken at the latest, and rise when nothing more of it can be seen:
// writes acknowledged, answers delivered.
module command #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  // slot table, written between jobs
  input  logic                         slot_write_i,
  input  logic [3:0]                   slot_index_i,
  input  logic [31:0]                  slot_base_i,
  input  logic [31:0]                  slot_size_i,
  input  logic [1:0]                   slot_rights_i,

  // job, its stream and its status
  input  logic                         job_valid_i,
  output logic                         job_ready_o,
  input  logic [31:0]                  job_stream_words_i,
  input  logic [31:0]                  job_response_words_i,
  input  logic                         stream_valid_i,
  output logic                         stream_ready_o,
  input  logic [StreamBits-1:0]        stream_data_i,
  output logic                         status_valid_o,
  input  logic                         status_ready_i,
  output gloss_pkg::status_t           status_o,

  // to tile's gate
  output logic                         render_valid_o,
  input  logic                         render_ready_i,
  output gloss_pkg::render_op_t        render_op_o,
  output logic [StreamBits-1:0]        render_data_o,

  // to tile
  output logic                         tile_begin_valid_o,
  input  logic                         tile_begin_ready_i,
  output gloss_pkg::tile_begin_op_t    tile_begin_o,
  output logic                         tile_end_valid_o,
  input  logic                         tile_end_ready_i,
  output gloss_pkg::tile_end_op_t      tile_end_o,
  input  logic                         tile_idle_i,

  // to memory
  output logic                         copy_valid_o,
  input  logic                         copy_ready_i,
  output gloss_pkg::copy_op_t          copy_o,
  output logic                         copy_data_valid_o,
  input  logic                         copy_data_ready_i,
  output logic [31:0]                  copy_data_o,
  input  logic                         copy_idle_i,
  input  logic                         memory_error_i,
  output logic                         memory_error_clear_o,

  // from fragment
  input  logic [31:0]                  covered_i,
  input  logic [31:0]                  passed_i,
  output logic                         work_clear_o,

  // COUNTERS' answer
  output logic                         response_valid_o,
  input  logic                         response_ready_i,
  output logic [3:0]                   response_count_o,
  output logic [32*PixelsPerClock-1:0] response_data_o,

  output logic                         stall_stream_o,
  output logic                         stall_memory_o
);

  localparam int unsigned CountBits = $clog2(StreamBits / 32 + 1);
  localparam int unsigned QueueDepth = StreamBits == 32 ? 256 : 512;

  logic                  start;
  logic [StreamBits-1:0] words;
  logic [CountBits-1:0]  have, take;
  logic                  at_small, whole, at_end;
  logic [31:0]           left;

  logic                  queue_valid, queue_ready, queued_valid, queued_ready;
  gloss_pkg::render_op_t queue_op, queued_op;
  logic [StreamBits-1:0] queue_data, queued_data;
  logic                  triangle;

  logic                  packet_start, packet_drop, packet_done, packet_refuse, packet_take;
  logic                  packet_push, packet_push_ready, packet_stall_stream, decode_stall_stream;
  logic [3:0]            packet_cause;
  logic [2:0]            packet_kind, packet_part;
  logic [31:0]           header, word;
  logic                  in_tile;

  logic                  lookup, lookup_write, lookup_valid, lookup_allowed;
  logic [3:0]            lookup_slot;
  logic [gloss_pkg::ExtentBits-1:0] lookup_extent;
  logic [31:0]           lookup_address;

  logic [15:0]           answer_words;
  logic                  answer_short, answer_reserve, answer_send, answer_sent, tile_ended;

  assign memory_error_clear_o = start;
  assign work_clear_o = start;
  assign status_o.reserved_0 = '0;
  assign stall_stream_o = decode_stall_stream || packet_stall_stream;

  command_align #(
    .StreamBits(StreamBits)
  ) u_align (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .start_i       (start),
    .words_i       (job_stream_words_i),
    .stream_valid_i(stream_valid_i),
    .stream_ready_o(stream_ready_o),
    .stream_data_i (stream_data_i),
    .words_o       (words),
    .have_o        (have),
    .take_i        (take),
    .small_o       (at_small),
    .whole_o       (whole),
    .end_o         (at_end),
    .left_o        (left)
  );

  command_decode #(
    .TileSize  (TileSize),
    .StreamBits(StreamBits)
  ) u_decode (
    .clk_i              (clk_i),
    .rst_ni             (rst_ni),
    .job_valid_i        (job_valid_i),
    .job_ready_o        (job_ready_o),
    .job_stream_words_i (job_stream_words_i),
    .start_o            (start),
    .status_valid_o     (status_valid_o),
    .status_ready_i     (status_ready_i),
    .status_cause_o     (status_o.cause),
    .status_offset_o    (status_o.offset),
    .words_i            (words),
    .have_i             (have),
    .take_o             (take),
    .small_i            (at_small),
    .whole_i            (whole),
    .end_i              (at_end),
    .left_i             (left),
    .render_valid_o     (queue_valid),
    .render_ready_i     (queue_ready),
    .render_op_o        (queue_op),
    .render_data_o      (queue_data),
    .triangle_o         (triangle),
    .packet_start_o     (packet_start),
    .packet_drop_o      (packet_drop),
    .packet_done_i      (packet_done),
    .packet_refuse_i    (packet_refuse),
    .packet_cause_i     (packet_cause),
    .packet_take_i      (packet_take),
    .packet_push_i      (packet_push),
    .packet_kind_i      (packet_kind),
    .packet_part_i      (packet_part),
    .packet_push_ready_o(packet_push_ready),
    .header_o           (header),
    .word_o             (word),
    .in_tile_i          (in_tile),
    .idle_i             (tile_idle_i && copy_idle_i),
    .memory_error_i     (memory_error_i),
    .stall_stream_o     (decode_stall_stream)
  );

  ram_fifo #(
    .Width($bits(queue_op) + StreamBits),
    .Depth(QueueDepth)
  ) u_queue (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(queue_valid),
    .ready_o(queue_ready),
    .data_i ({queue_op, queue_data}),
    .valid_o(queued_valid),
    .ready_i(queued_ready),
    .data_o ({queued_op, queued_data})
  );

  // Block RAM's output comes late in its clock, and what becomes of an op is decided at once.
  stream_register #(
    .Width($bits(queue_op) + StreamBits)
  ) u_queued (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(queued_valid),
    .ready_o(queued_ready),
    .data_i ({queued_op, queued_data}),
    .valid_o(render_valid_o),
    .ready_i(render_ready_i),
    .data_o ({render_op_o, render_data_o})
  );

  command_packet #(
    .TileSize(TileSize)
  ) u_packet (
    .clk_i             (clk_i),
    .rst_ni            (rst_ni),
    .clear_i           (start),
    .start_i           (packet_start),
    .drop_i            (packet_drop),
    .done_o            (packet_done),
    .refuse_o          (packet_refuse),
    .cause_o           (packet_cause),
    .in_tile_o         (in_tile),
    .header_i          (header),
    .word_valid_i      (have != '0),
    .word_take_o       (packet_take),
    .word_i            (word),
    .word_next_i       (words[31:0]),
    .push_o            (packet_push),
    .push_kind_o       (packet_kind),
    .push_part_o       (packet_part),
    .push_ready_i      (packet_push_ready),
    .lookup_o          (lookup),
    .lookup_slot_o     (lookup_slot),
    .lookup_write_o    (lookup_write),
    .lookup_extent_o   (lookup_extent),
    .lookup_valid_i    (lookup_valid),
    .lookup_allowed_i  (lookup_allowed),
    .lookup_address_i  (lookup_address),
    .answer_words_o    (answer_words),
    .answer_short_i    (answer_short),
    .answer_reserve_o  (answer_reserve),
    .answer_send_o     (answer_send),
    .answer_sent_i     (answer_sent),
    .tile_ended_o      (tile_ended),
    .tile_begin_valid_o(tile_begin_valid_o),
    .tile_begin_ready_i(tile_begin_ready_i),
    .tile_begin_o      (tile_begin_o),
    .tile_end_valid_o  (tile_end_valid_o),
    .tile_end_ready_i  (tile_end_ready_i),
    .tile_end_o        (tile_end_o),
    .tile_idle_i       (tile_idle_i),
    .copy_valid_o      (copy_valid_o),
    .copy_ready_i      (copy_ready_i),
    .copy_o            (copy_o),
    .copy_data_valid_o (copy_data_valid_o),
    .copy_data_ready_i (copy_data_ready_i),
    .copy_data_o       (copy_data_o),
    .copy_idle_i       (copy_idle_i),
    .stall_stream_o    (packet_stall_stream),
    .stall_memory_o    (stall_memory_o)
  );

  command_slot u_slot (
    .clk_i        (clk_i),
    .rst_ni       (rst_ni),
    .slot_write_i (slot_write_i),
    .slot_index_i (slot_index_i),
    .slot_base_i  (slot_base_i),
    .slot_size_i  (slot_size_i),
    .slot_rights_i(slot_rights_i),
    .lookup_i     (lookup),
    .slot_i       (lookup_slot),
    .write_i      (lookup_write),
    .offset_i     (word),
    .extent_i     (lookup_extent),
    .valid_o      (lookup_valid),
    .allowed_o    (lookup_allowed),
    .address_o    (lookup_address)
  );

  command_answer #(
    .PixelsPerClock(PixelsPerClock)
  ) u_answer (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .start_i         (start),
    .room_i          (job_response_words_i),
    .words_i         (answer_words),
    .short_o         (answer_short),
    .reserve_i       (answer_reserve),
    .commit_i        (packet_done),
    .cancel_i        (packet_refuse),
    .used_o          (status_o.response_words),
    .triangle_i      (triangle),
    .tile_i          (tile_ended),
    .covered_i       (covered_i),
    .passed_i        (passed_i),
    .send_i          (answer_send),
    .sent_o          (answer_sent),
    .response_valid_o(response_valid_o),
    .response_ready_i(response_ready_i),
    .response_count_o(response_count_o),
    .response_data_o (response_data_o)
  );

`ifndef SYNTHESIS
  logic response_waits_q, status_waits_q;  // it was offered a clock ago, and not taken

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {response_waits_q, status_waits_q} <= '0;
    else {response_waits_q, status_waits_q} <= {response_valid_o && !response_ready_i,
                                                status_valid_o && !status_ready_i};
  end

  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      response_stays: assert (!response_waits_q || (response_valid_o &&
                              $stable({response_count_o, response_data_o})));
      response_has_words: assert (!response_valid_o || (response_count_o != '0 &&
                                  response_count_o <= 4'(PixelsPerClock)));
      status_stays: assert (!status_waits_q || (status_valid_o && $stable(status_o)));
    end
  end
`endif

endmodule
