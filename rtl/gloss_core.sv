// SPDX-License-Identifier: Apache-2.0
// The core: jobs in, pixels in board memory and words of answer out.
//
//   stream -> command -> tile's gate -> raster_shade -> fragment <-> tile buffers
//                   \-> memory <-> AXI4                     tile <-> memory
//
// The slot table is written between jobs, all of it before the first. A job's stream has as many
// beats as its words need and is taken to its end, also after a fault. The status comes when
// nothing of the job is left: writes are acknowledged, answers are taken. Words 0 to count-1 of a
// response beat are valid.
module gloss_core #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned StreamBits = 32,
  parameter int unsigned TimeCounters = 1   // 0: none of the registers of clocks and stalls
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,

  input  logic                         slot_write_i,
  input  logic [3:0]                   slot_index_i,
  input  logic [31:0]                  slot_base_i,
  input  logic [31:0]                  slot_size_i,
  input  logic [1:0]                   slot_rights_i,

  input  logic                         job_valid_i,
  output logic                         job_ready_o,
  input  logic [31:0]                  job_stream_words_i,
  input  logic [31:0]                  job_response_words_i,

  output logic                         status_valid_o,
  input  logic                         status_ready_i,
  output gloss_pkg::status_t           status_o,
  output gloss_pkg::time_counters_t    time_o,      // of the job whose status came last

  input  logic                         stream_valid_i,
  output logic                         stream_ready_o,
  input  logic [StreamBits-1:0]        stream_data_i,

  output logic                         response_valid_o,
  input  logic                         response_ready_i,
  output logic [3:0]                   response_count_o,
  output logic [32*PixelsPerClock-1:0] response_data_o,

  // AXI4 master: INCR, full width, no IDs, answers in order
  output logic                         axi_awvalid_o,
  input  logic                         axi_awready_i,
  output logic [31:0]                  axi_awaddr_o,
  output logic [7:0]                   axi_awlen_o,
  output logic                         axi_wvalid_o,
  input  logic                         axi_wready_i,
  output logic [32*PixelsPerClock-1:0] axi_wdata_o,
  output logic [4*PixelsPerClock-1:0]  axi_wstrb_o,
  output logic                         axi_wlast_o,
  input  logic                         axi_bvalid_i,
  output logic                         axi_bready_o,
  input  logic [1:0]                   axi_bresp_i,
  output logic                         axi_arvalid_o,
  input  logic                         axi_arready_i,
  output logic [31:0]                  axi_araddr_o,
  output logic [7:0]                   axi_arlen_o,
  input  logic                         axi_rvalid_i,
  output logic                         axi_rready_o,
  input  logic [32*PixelsPerClock-1:0] axi_rdata_i,
  input  logic                         axi_rlast_i,
  input  logic [1:0]                   axi_rresp_i
);

  core_parameters #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits),
    .TimeCounters  (TimeCounters)
  ) u_parameters ();

  localparam int unsigned XBits = $clog2(TileSize / PixelsPerClock);
  localparam int unsigned YBits = $clog2(TileSize);
  localparam int unsigned RowBits = XBits + YBits;
  localparam int unsigned Width = 32 * PixelsPerClock;

  // command to tile's gate, and from there to raster_shade
  logic                      render_valid, render_ready, raster_valid, raster_ready, raster_bank;
  gloss_pkg::render_op_t     render_op, raster_op;
  logic [StreamBits-1:0]     render_data, raster_data;

  // command to tile
  logic                      tile_begin_valid, tile_begin_ready, tile_end_valid, tile_end_ready;
  gloss_pkg::tile_begin_op_t tile_begin;
  gloss_pkg::tile_end_op_t   tile_end;
  logic                      tile_idle;

  // command to memory
  logic                      copy_valid, copy_ready, copy_data_valid, copy_data_ready, copy_idle;
  gloss_pkg::copy_op_t       copy;
  logic [31:0]               copy_data;
  logic                      memory_error, memory_error_clear;

  // raster_shade to fragment
  logic                      block_valid, block_end, block_end_bank;
  logic [XBits-1:0]          block_x;
  logic [YBits-1:0]          block_y;
  logic [PixelsPerClock-1:0] block_mask;
  logic [Width-1:0]          block_colour;
  logic [24*PixelsPerClock-1:0] block_depth;
  gloss_pkg::pixel_state_t   block_state;

  // fragment and tile
  logic                      read_en, read_bank, write_en, write_bank, tile_drawn, tile_drawn_bank;
  logic [RowBits-1:0]        read_row, write_row;
  logic [31:0]               clear_colour, clear_depth;
  logic [Width-1:0]          row_colour, row_depth, write_colour, write_depth;
  logic                      row_colour_fresh, row_depth_fresh;

  // tile and memory
  logic                      load_valid, load_ready, load_data_valid;
  logic                      store_valid, store_ready, store_data_valid, store_data_ready;
  logic                      store_data_last, store_done;
  logic [31:0]               load_address, store_address;
  logic [Width-1:0]          load_data, store_data;

  // work and answers
  logic [31:0]               covered, passed;
  logic                      work_clear;
  logic                      counters_valid, counters_ready, answer_valid, answer_ready;
  logic                      words_valid, words_ready;
  logic [3:0]                counters_count, answer_count, words_count;
  logic [Width-1:0]          counters_data, answer_data, words_data;

  logic                      stall_stream, stall_memory, stall_tile, stall_raster, stall_response;

  command #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits)
  ) u_command (
    .clk_i               (clk_i),
    .rst_ni              (rst_ni),
    .slot_write_i        (slot_write_i),
    .slot_index_i        (slot_index_i),
    .slot_base_i         (slot_base_i),
    .slot_size_i         (slot_size_i),
    .slot_rights_i       (slot_rights_i),
    .job_valid_i         (job_valid_i),
    .job_ready_o         (job_ready_o),
    .job_stream_words_i  (job_stream_words_i),
    .job_response_words_i(job_response_words_i),
    .stream_valid_i      (stream_valid_i),
    .stream_ready_o      (stream_ready_o),
    .stream_data_i       (stream_data_i),
    .status_valid_o      (status_valid_o),
    .status_ready_i      (status_ready_i),
    .status_o            (status_o),
    .render_valid_o      (render_valid),
    .render_ready_i      (render_ready),
    .render_op_o         (render_op),
    .render_data_o       (render_data),
    .tile_begin_valid_o  (tile_begin_valid),
    .tile_begin_ready_i  (tile_begin_ready),
    .tile_begin_o        (tile_begin),
    .tile_end_valid_o    (tile_end_valid),
    .tile_end_ready_i    (tile_end_ready),
    .tile_end_o          (tile_end),
    .tile_idle_i         (tile_idle),
    .copy_valid_o        (copy_valid),
    .copy_ready_i        (copy_ready),
    .copy_o              (copy),
    .copy_data_valid_o   (copy_data_valid),
    .copy_data_ready_i   (copy_data_ready),
    .copy_data_o         (copy_data),
    .copy_idle_i         (copy_idle),
    .memory_error_i      (memory_error),
    .memory_error_clear_o(memory_error_clear),
    .covered_i           (covered),
    .passed_i            (passed),
    .work_clear_o        (work_clear),
    .response_valid_o    (counters_valid),
    .response_ready_i    (counters_ready),
    .response_count_o    (counters_count),
    .response_data_o     (counters_data),
    .stall_stream_o      (stall_stream),
    .stall_memory_o      (stall_memory)
  );

  raster_shade #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits)
  ) u_raster_shade (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .valid_i       (raster_valid),
    .ready_o       (raster_ready),
    .op_i          (raster_op),
    .data_i        (raster_data),
    .bank_i        (raster_bank),
    .block_valid_o (block_valid),
    .block_x_o     (block_x),
    .block_y_o     (block_y),
    .block_mask_o  (block_mask),
    .block_colour_o(block_colour),
    .block_depth_o (block_depth),
    .block_state_o (block_state),
    .end_o         (block_end),
    .end_bank_o    (block_end_bank),
    .stall_raster_o(stall_raster),
    /* verilator lint_off PINCONNECTEMPTY */
    .idle_o        () // tile_idle says more
    /* verilator lint_on PINCONNECTEMPTY */
  );

  fragment #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock)
  ) u_fragment (
    .clk_i             (clk_i),
    .rst_ni            (rst_ni),
    .block_valid_i     (block_valid),
    .block_x_i         (block_x),
    .block_y_i         (block_y),
    .block_mask_i      (block_mask),
    .block_colour_i    (block_colour),
    .block_depth_i     (block_depth),
    .block_state_i     (block_state),
    .end_i             (block_end),
    .end_bank_i        (block_end_bank),
    .read_en_o         (read_en),
    .read_bank_o       (read_bank),
    .read_row_o        (read_row),
    .clear_colour_i    (clear_colour),
    .clear_depth_i     (clear_depth),
    .row_colour_i      (row_colour),
    .row_depth_i       (row_depth),
    .row_colour_fresh_i(row_colour_fresh),
    .row_depth_fresh_i (row_depth_fresh),
    .write_en_o        (write_en),
    .write_bank_o      (write_bank),
    .write_row_o       (write_row),
    .write_colour_o    (write_colour),
    .write_depth_o     (write_depth),
    .end_o             (tile_drawn),
    .end_bank_o        (tile_drawn_bank),
    .work_clear_i      (work_clear),
    .covered_o         (covered),
    .passed_o          (passed)
  );

  tile #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock),
    .StreamBits    (StreamBits)
  ) u_tile (
    .clk_i             (clk_i),
    .rst_ni            (rst_ni),
    .render_valid_i    (render_valid),
    .render_ready_o    (render_ready),
    .render_op_i       (render_op),
    .render_data_i     (render_data),
    .raster_valid_o    (raster_valid),
    .raster_ready_i    (raster_ready),
    .raster_op_o       (raster_op),
    .raster_data_o     (raster_data),
    .raster_bank_o     (raster_bank),
    .tile_begin_valid_i(tile_begin_valid),
    .tile_begin_ready_o(tile_begin_ready),
    .tile_begin_i      (tile_begin),
    .tile_end_valid_i  (tile_end_valid),
    .tile_end_ready_o  (tile_end_ready),
    .tile_end_i        (tile_end),
    .tile_idle_o       (tile_idle),
    .stall_tile_o      (stall_tile),
    .read_en_i         (read_en),
    .read_bank_i       (read_bank),
    .read_row_i        (read_row),
    .clear_colour_o    (clear_colour),
    .clear_depth_o     (clear_depth),
    .row_colour_o      (row_colour),
    .row_depth_o       (row_depth),
    .row_colour_fresh_o(row_colour_fresh),
    .row_depth_fresh_o (row_depth_fresh),
    .write_en_i        (write_en),
    .write_bank_i      (write_bank),
    .write_row_i       (write_row),
    .write_colour_i    (write_colour),
    .write_depth_i     (write_depth),
    .end_i             (tile_drawn),
    .end_bank_i        (tile_drawn_bank),
    .response_valid_o  (answer_valid),
    .response_ready_i  (answer_ready),
    .response_count_o  (answer_count),
    .response_data_o   (answer_data),
    .load_valid_o      (load_valid),
    .load_ready_i      (load_ready),
    .load_address_o    (load_address),
    .load_data_valid_i (load_data_valid),
    .load_data_i       (load_data),
    .store_valid_o     (store_valid),
    .store_ready_i     (store_ready),
    .store_address_o   (store_address),
    .store_data_valid_o(store_data_valid),
    .store_data_ready_i(store_data_ready),
    .store_data_o      (store_data),
    .store_data_last_o (store_data_last),
    .store_done_i      (store_done)
  );

  memory #(
    .TileSize      (TileSize),
    .PixelsPerClock(PixelsPerClock)
  ) u_memory (
    .clk_i               (clk_i),
    .rst_ni              (rst_ni),
    .copy_valid_i        (copy_valid),
    .copy_ready_o        (copy_ready),
    .copy_i              (copy),
    .copy_data_valid_i   (copy_data_valid),
    .copy_data_ready_o   (copy_data_ready),
    .copy_data_i         (copy_data),
    .copy_idle_o         (copy_idle),
    .memory_error_o      (memory_error),
    .memory_error_clear_i(memory_error_clear),
    .response_valid_o    (words_valid),
    .response_ready_i    (words_ready),
    .response_count_o    (words_count),
    .response_data_o     (words_data),
    .load_valid_i        (load_valid),
    .load_ready_o        (load_ready),
    .load_address_i      (load_address),
    .load_data_valid_o   (load_data_valid),
    .load_data_o         (load_data),
    .store_valid_i       (store_valid),
    .store_ready_o       (store_ready),
    .store_address_i     (store_address),
    .store_data_valid_i  (store_data_valid),
    .store_data_ready_o  (store_data_ready),
    .store_data_i        (store_data),
    .store_data_last_i   (store_data_last),
    .store_done_o        (store_done),
    .axi_awvalid_o       (axi_awvalid_o),
    .axi_awready_i       (axi_awready_i),
    .axi_awaddr_o        (axi_awaddr_o),
    .axi_awlen_o         (axi_awlen_o),
    .axi_wvalid_o        (axi_wvalid_o),
    .axi_wready_i        (axi_wready_i),
    .axi_wdata_o         (axi_wdata_o),
    .axi_wstrb_o         (axi_wstrb_o),
    .axi_wlast_o         (axi_wlast_o),
    .axi_bvalid_i        (axi_bvalid_i),
    .axi_bready_o        (axi_bready_o),
    .axi_bresp_i         (axi_bresp_i),
    .axi_arvalid_o       (axi_arvalid_o),
    .axi_arready_i       (axi_arready_i),
    .axi_araddr_o        (axi_araddr_o),
    .axi_arlen_o         (axi_arlen_o),
    .axi_rvalid_i        (axi_rvalid_i),
    .axi_rready_o        (axi_rready_o),
    .axi_rdata_i         (axi_rdata_i),
    .axi_rlast_i         (axi_rlast_i),
    .axi_rresp_i         (axi_rresp_i)
  );

  // Only one of the three answers at a time: counters and words wait for tiles, and each for the
  // other.
  assign counters_ready = response_ready_i;
  assign answer_ready = response_ready_i;
  assign words_ready = response_ready_i;
  assign response_valid_o = counters_valid || answer_valid || words_valid;
  assign stall_response = response_valid_o && !response_ready_i;

  always_comb begin
    response_count_o = counters_count;
    response_data_o = counters_data;
    if (answer_valid) begin
      response_count_o = answer_count;
      response_data_o = answer_data;
    end else if (words_valid) begin
      response_count_o = words_count;
      response_data_o = words_data;
    end
  end

  if (TimeCounters != 0) begin : gen_clocks
    command_clocks u_clocks (
      .clk_i           (clk_i),
      .rst_ni          (rst_ni),
      .start_i         (job_valid_i && job_ready_o),
      .end_i           (status_valid_o),
      .stall_stream_i  (stall_stream),
      .stall_raster_i  (stall_raster),
      .stall_tile_i    (stall_tile),
      .stall_memory_i  (stall_memory),
      .stall_response_i(stall_response),
      .time_o          (time_o)
    );
  end else begin : gen_no_clocks
    logic unused;
    assign unused = ^{stall_stream, stall_raster, stall_tile, stall_memory, stall_response};
    assign time_o = '0;
  end

`ifndef SYNTHESIS
  logic begun_q, copied_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {begun_q, copied_q} <= '0;
    else {begun_q, copied_q} <= {tile_begin_valid && tile_begin_ready, copy_valid && copy_ready};
  end

  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      tile_busy_at_once: assert (!begun_q || !tile_idle);
      copy_busy_at_once: assert (!copied_q || !copy_idle);
      one_answer: assert (2'(counters_valid) + 2'(answer_valid) + 2'(words_valid) <= 2'd1);
    end
  end
`endif

endmodule
