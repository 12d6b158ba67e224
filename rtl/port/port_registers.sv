// SPDX-License-Identifier: Apache-2.0
// The registers of gloss.xml: what the driver sets, what has happened, and interrupts. An access takes two clocks; it
// acts, and its answer is there, in the clock of ready. Registers of the engine are reset with it by core_rst_ni.
module port_registers #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned PixelsPerClock = 1
) (
  input  logic                      clk_i,
  input  logic                      rst_ni,
  input  logic                      core_rst_ni,

  input  logic                      reg_valid_i,
  output logic                      reg_ready_o,
  input  logic                      reg_write_i,
  // Accesses are of whole words.
  // verilator lint_off UNUSEDSIGNAL
  input  logic [15:0]               reg_addr_i,
  // verilator lint_on UNUSEDSIGNAL
  input  logic [31:0]               reg_wdata_i,
  output logic [31:0]               reg_rdata_o,
  output logic                      irq_o,
  output logic                      irq_event_o,

  input  logic [31:0]               memory_pages_i,

  // reset
  output logic                      reset_o,        // CONTROL.reset was written
  input  logic                      resetting_i,

  // ring
  output logic                      enable_o,
  output logic [63:6]               ring_o,
  output logic [3:0]                ring_log2_o,
  output logic [15:0]               tail_o,
  input  logic [15:0]               head_i,
  output logic [63:4]               records_o,
  input  logic                      running_i,
  input  logic                      idle_i,

  // a job has ended
  input  logic                      done_i,
  // verilator lint_off UNUSEDSIGNAL
  input  gloss_pkg::status_t        status_i,
  // verilator lint_on UNUSEDSIGNAL
  input  logic [31:0]               sequence_i,
  input  gloss_pkg::time_counters_t time_i,
  input  logic [2:0]                stream_taken_i,
  input  logic [3:0]                response_taken_i,

  // the host has refused an access
  input  logic                      dma_error_i,
  input  logic                      dma_event_i,
  input  logic [63:0]               dma_address_i,
  input  logic [31:0]               dma_sequence_i
);

  logic ready_q, write;
  logic [15:0] address;
  logic [31:0] rdata_d, rdata_q;

  logic enable_q;
  logic [63:0] ring_q, records_q;
  logic [3:0] ring_log2_q;
  logic [15:0] tail_q;

  logic [2:0] events, events_q, mask_q, cleared;  // dma, fault, done
  logic fault;
  logic [3:0] fault_cause_q;
  logic [31:0] fault_offset_q, fault_sequence_q;

  logic [31:0] progress_q, jobs_q;
  gloss_pkg::time_counters_t sums_q;
  logic [32:0] clocks;
  logic [31:0] clocks_high_q;

  assign address = {reg_addr_i[15:2], 2'b00};
  assign reg_ready_o = ready_q;
  assign reg_rdata_o = rdata_q;
  assign write = reg_valid_i && ready_q && reg_write_i;

  assign reset_o = write && address == gloss_pkg::REG_CONTROL && reg_wdata_i[1];
  assign enable_o = enable_q;
  assign ring_o = ring_q[63:6];
  assign ring_log2_o = ring_log2_q;
  assign tail_o = tail_q;
  assign records_o = records_q[63:4];

  always_comb begin
    unique case (address)
      gloss_pkg::REG_IDENTITY: rdata_d = gloss_pkg::Identity;
      gloss_pkg::REG_VERSION: rdata_d = gloss_pkg::Version;
      gloss_pkg::REG_CAPABILITIES:
        rdata_d = {8'd0, 8'(gloss_pkg::RingMaxLog2), 8'(PixelsPerClock), 8'(TileSize)};
      gloss_pkg::REG_MEMORY_PAGES: rdata_d = memory_pages_i;
      gloss_pkg::REG_CONTROL: rdata_d = {30'd0, resetting_i, enable_q};
      gloss_pkg::REG_STATUS: rdata_d = {29'd0, dma_error_i, idle_i, running_i};
      gloss_pkg::REG_INTERRUPT_STATUS: rdata_d = {29'd0, events_q};
      gloss_pkg::REG_INTERRUPT_MASK: rdata_d = {29'd0, mask_q};
      gloss_pkg::REG_RING_LOW: rdata_d = ring_q[31:0];
      gloss_pkg::REG_RING_HIGH: rdata_d = ring_q[63:32];
      gloss_pkg::REG_RING_LOG2: rdata_d = {28'd0, ring_log2_q};
      gloss_pkg::REG_HEAD: rdata_d = {16'd0, head_i};
      gloss_pkg::REG_TAIL: rdata_d = {16'd0, tail_q};
      gloss_pkg::REG_COMPLETION_LOW: rdata_d = records_q[31:0];
      gloss_pkg::REG_COMPLETION_HIGH: rdata_d = records_q[63:32];
      gloss_pkg::REG_FAULT_CAUSE: rdata_d = {28'd0, fault_cause_q};
      gloss_pkg::REG_FAULT_OFFSET: rdata_d = fault_offset_q;
      gloss_pkg::REG_FAULT_SEQUENCE: rdata_d = fault_sequence_q;
      gloss_pkg::REG_DMA_ERROR_LOW: rdata_d = dma_error_i ? dma_address_i[31:0] : '0;
      gloss_pkg::REG_DMA_ERROR_HIGH: rdata_d = dma_error_i ? dma_address_i[63:32] : '0;
      gloss_pkg::REG_PROGRESS: rdata_d = progress_q;
      gloss_pkg::REG_JOBS: rdata_d = jobs_q;
      gloss_pkg::REG_CLOCKS_LOW: rdata_d = sums_q.clocks;
      gloss_pkg::REG_CLOCKS_HIGH: rdata_d = clocks_high_q;
      gloss_pkg::REG_STALL_STREAM: rdata_d = sums_q.stall_stream;
      gloss_pkg::REG_STALL_RASTER: rdata_d = sums_q.stall_raster;
      gloss_pkg::REG_STALL_TILE: rdata_d = sums_q.stall_tile;
      gloss_pkg::REG_STALL_MEMORY: rdata_d = sums_q.stall_memory;
      gloss_pkg::REG_STALL_RESPONSE: rdata_d = sums_q.stall_response;
      default: rdata_d = '0;
    endcase
  end

  always_ff @(posedge clk_i) rdata_q <= rdata_d;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) ready_q <= 1'b0;
    else ready_q <= reg_valid_i && !ready_q;
  end

  always_ff @(posedge clk_i or negedge core_rst_ni) begin
    if (!core_rst_ni) begin
      enable_q <= 1'b0;
      ring_q <= '0;
      ring_log2_q <= '0;
      tail_q <= '0;
      records_q <= '0;
      mask_q <= '0;
    end else if (write) begin
      unique case (address)
        gloss_pkg::REG_CONTROL: enable_q <= reg_wdata_i[0];
        gloss_pkg::REG_RING_LOW: ring_q[31:0] <= reg_wdata_i;
        gloss_pkg::REG_RING_HIGH: ring_q[63:32] <= reg_wdata_i;
        gloss_pkg::REG_RING_LOG2: ring_log2_q <= reg_wdata_i[3:0];
        gloss_pkg::REG_TAIL: tail_q <= reg_wdata_i[15:0];
        gloss_pkg::REG_COMPLETION_LOW: records_q[31:0] <= reg_wdata_i;
        gloss_pkg::REG_COMPLETION_HIGH: records_q[63:32] <= reg_wdata_i;
        gloss_pkg::REG_INTERRUPT_MASK: mask_q <= reg_wdata_i[2:0];
        default: ;
      endcase
    end
  end

  // ---- events ----
  assign fault = done_i && status_i.cause != gloss_pkg::FAULT_NONE;
  assign events = resetting_i ? '0 : {dma_event_i, fault, done_i};
  assign cleared = write && address == gloss_pkg::REG_INTERRUPT_STATUS ? reg_wdata_i[2:0] : '0;
  assign irq_o = (events_q & mask_q) != '0;

  always_ff @(posedge clk_i or negedge core_rst_ni) begin
    if (!core_rst_ni) begin
      events_q <= '0;
      irq_event_o <= 1'b0;
      fault_cause_q <= '0;
      fault_offset_q <= '0;
      fault_sequence_q <= '0;
    end else begin
      events_q <= (events_q & ~cleared) | events;
      irq_event_o <= (events & mask_q) != '0;
      if (dma_event_i) begin
        fault_cause_q <= gloss_pkg::FAULT_DMA;
        fault_offset_q <= '0;
        fault_sequence_q <= dma_sequence_i;
      end else if (fault) begin
        fault_cause_q <= status_i.cause;
        fault_offset_q <= status_i.offset;
        fault_sequence_q <= sequence_i;
      end
    end
  end

  // ---- counters ----
  assign clocks = {1'b0, sums_q.clocks} + {1'b0, time_i.clocks};

  always_ff @(posedge clk_i or negedge core_rst_ni) begin
    if (!core_rst_ni) begin
      progress_q <= '0;
      jobs_q <= '0;
      clocks_high_q <= '0;
      sums_q <= '0;
    end else begin
      progress_q <= progress_q + 32'(stream_taken_i) + 32'(response_taken_i);
      if (done_i) begin
        jobs_q <= jobs_q + 1'b1;
        sums_q.clocks <= clocks[31:0];
        clocks_high_q <= clocks_high_q + 32'(clocks[32]);
        sums_q.stall_stream <= sums_q.stall_stream + time_i.stall_stream;
        sums_q.stall_raster <= sums_q.stall_raster + time_i.stall_raster;
        sums_q.stall_tile <= sums_q.stall_tile + time_i.stall_tile;
        sums_q.stall_memory <= sums_q.stall_memory + time_i.stall_memory;
        sums_q.stall_response <= sums_q.stall_response + time_i.stall_response;
      end
    end
  end

endmodule
