// SPDX-License-Identifier: Apache-2.0
// The registers of gloss.xml that a board has on every bus: what it is, its reset, what has
// happened. Those of one bus are its port's: it sees every write, and gives what is read at the
// offsets that are not here. An access takes two clocks; it acts, and its answer is there, in the
// clock of ready. Registers of the engine are reset with it by core_rst_ni.
module port_registers #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1,
  parameter int unsigned TimeCounters = 1,
  parameter int unsigned RingMaxLog2 = 0
) (
  input  logic                      clk_i,
  input  logic                      rst_ni,
  input  logic                      core_rst_ni,

  input  logic                      reg_valid_i,
  output logic                      reg_ready_o,
  input  logic                      reg_write_i,
  // Accesses are of whole words; CONTROL.reset is all that can be written here.
  // verilator lint_off UNUSEDSIGNAL
  input  logic [15:0]               reg_addr_i,
  input  logic [31:0]               reg_wdata_i,
  // verilator lint_on UNUSEDSIGNAL
  output logic [31:0]               reg_rdata_o,

  input  logic [31:0]               memory_pages_i,

  // the bus's own registers
  output logic                      write_o,        // reg_wdata_i
  output logic [15:0]               address_o,
  input  logic [31:0]               own_i,          // at that address; 0 where nothing is

  // control and state; what a bus does not have is 0
  output logic                      reset_o,        // CONTROL.reset was written
  input  logic                      resetting_i,
  input  logic                      enable_i,
  input  logic                      running_i,
  input  logic                      idle_i,
  input  logic                      dma_error_i,
  input  logic                      lost_i,

  // a job has ended
  input  logic                      done_i,
  // verilator lint_off UNUSEDSIGNAL
  input  gloss_pkg::status_t        status_i,
  // verilator lint_on UNUSEDSIGNAL
  input  logic [31:0]               sequence_i,
  input  gloss_pkg::time_counters_t time_i,
  output logic                      fault_o,        // with done_i: by a fault
  input  logic [2:0]                stream_taken_i,
  input  logic [3:0]                response_taken_i,

  // the host has refused an access
  input  logic                      dma_event_i,
  input  logic [31:0]               dma_sequence_i
);

  logic ready_q;
  logic [31:0] rdata_d, rdata_q;

  logic [3:0] fault_cause_q;
  logic [31:0] fault_offset_q, fault_sequence_q;

  logic [3:0] moved_q;
  logic [31:0] progress_q, jobs_q;
  gloss_pkg::time_counters_t sums;
  logic [31:0] clocks_high;

  assign address_o = {reg_addr_i[15:2], 2'b00};
  assign reg_ready_o = ready_q;
  assign reg_rdata_o = rdata_q;
  assign write_o = reg_valid_i && ready_q && reg_write_i;

  assign reset_o = write_o && address_o == gloss_pkg::REG_CONTROL && reg_wdata_i[1];

  always_comb begin
    unique case (address_o)
      gloss_pkg::REG_IDENTITY: rdata_d = gloss_pkg::Identity;
      gloss_pkg::REG_VERSION: rdata_d = gloss_pkg::Version;
      gloss_pkg::REG_CAPABILITIES:
        rdata_d = {8'd0, 8'(RingMaxLog2), 8'(PixelsPerClock), 8'(TileSize)};
      gloss_pkg::REG_MEMORY_PAGES: rdata_d = memory_pages_i;
      gloss_pkg::REG_CONTROL: rdata_d = {30'd0, resetting_i, enable_i};
      gloss_pkg::REG_STATUS: rdata_d = {28'd0, lost_i, dma_error_i, idle_i, running_i};
      gloss_pkg::REG_FAULT_CAUSE: rdata_d = {28'd0, fault_cause_q};
      gloss_pkg::REG_FAULT_OFFSET: rdata_d = fault_offset_q;
      gloss_pkg::REG_FAULT_SEQUENCE: rdata_d = fault_sequence_q;
      gloss_pkg::REG_PROGRESS: rdata_d = progress_q;
      gloss_pkg::REG_JOBS: rdata_d = jobs_q;
      gloss_pkg::REG_CLOCKS_LOW: rdata_d = sums.clocks;
      gloss_pkg::REG_CLOCKS_HIGH: rdata_d = clocks_high;
      gloss_pkg::REG_STALL_STREAM: rdata_d = sums.stall_stream;
      gloss_pkg::REG_STALL_RASTER: rdata_d = sums.stall_raster;
      gloss_pkg::REG_STALL_TILE: rdata_d = sums.stall_tile;
      gloss_pkg::REG_STALL_MEMORY: rdata_d = sums.stall_memory;
      gloss_pkg::REG_STALL_RESPONSE: rdata_d = sums.stall_response;
      default: rdata_d = own_i;
    endcase
  end

  always_ff @(posedge clk_i) rdata_q <= rdata_d;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) ready_q <= 1'b0;
    else ready_q <= reg_valid_i && !ready_q;
  end

  assign fault_o = done_i && status_i.cause != gloss_pkg::FAULT_NONE;

  always_ff @(posedge clk_i or negedge core_rst_ni) begin
    if (!core_rst_ni) begin
      fault_cause_q <= '0;
      fault_offset_q <= '0;
      fault_sequence_q <= '0;
    end else if (dma_event_i) begin
      fault_cause_q <= gloss_pkg::FAULT_DMA;
      fault_offset_q <= '0;
      fault_sequence_q <= dma_sequence_i;
    end else if (fault_o) begin
      fault_cause_q <= status_i.cause;
      fault_offset_q <= status_i.offset;
      fault_sequence_q <= sequence_i;
    end
  end

  if (TimeCounters != 0) begin : gen_clocks
    port_clocks u_clocks (
      .clk_i        (clk_i),
      .core_rst_ni  (core_rst_ni),
      .done_i       (done_i),
      .time_i       (time_i),
      .sums_o       (sums),
      .clocks_high_o(clocks_high)
    );
  end else begin : gen_no_clocks
    logic unused;
    assign unused = ^time_i;
    assign sums = '0;
    assign clocks_high = '0;
  end

  always_ff @(posedge clk_i or negedge core_rst_ni) begin
    if (!core_rst_ni) begin
      moved_q <= '0;
      progress_q <= '0;
      jobs_q <= '0;
    end else begin
      moved_q <= 4'(stream_taken_i) + response_taken_i;
      progress_q <= progress_q + 32'(moved_q);
      if (done_i) jobs_q <= jobs_q + 1'b1;
    end
  end

endmodule
