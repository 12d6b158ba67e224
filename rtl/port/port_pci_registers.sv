// SPDX-License-Identifier: Apache-2.0
// The registers that only a PCI board has: the ring the driver sets up, interrupts, and what the
// host has refused.
module port_pci_registers (
  input  logic        clk_i,
  input  logic        core_rst_ni,

  // from port_registers
  input  logic        write_i,
  input  logic [15:0] address_i,
  input  logic [31:0] wdata_i,
  output logic [31:0] rdata_o,
  input  logic        resetting_i,

  output logic        irq_o,
  output logic        msi_valid_o,
  input  logic        msi_ready_i,

  // ring
  output logic        enable_o,
  output logic [63:6] ring_o,
  output logic [3:0]  ring_log2_o,
  output logic [15:0] tail_o,
  input  logic [15:0] head_i,
  output logic [63:4] records_o,

  // a job has ended, with a fault
  input  logic        done_i,
  input  logic        fault_i,

  // the host has refused an access
  input  logic        dma_error_i,
  input  logic        dma_event_i,
  input  logic [63:0] dma_address_i
);

  logic enable_q;
  logic [63:0] ring_q, records_q;
  logic [3:0] ring_log2_q;
  logic [15:0] tail_q;
  logic [2:0] events, events_q, mask_q, cleared;  // dma, fault, done

  assign enable_o = enable_q;
  assign ring_o = ring_q[63:6];
  assign ring_log2_o = ring_log2_q;
  assign tail_o = tail_q;
  assign records_o = records_q[63:4];

  always_comb begin
    unique case (address_i)
      gloss_pkg::REG_INTERRUPT_STATUS: rdata_o = {29'd0, events_q};
      gloss_pkg::REG_INTERRUPT_MASK: rdata_o = {29'd0, mask_q};
      gloss_pkg::REG_RING_LOW: rdata_o = ring_q[31:0];
      gloss_pkg::REG_RING_HIGH: rdata_o = ring_q[63:32];
      gloss_pkg::REG_RING_LOG2: rdata_o = {28'd0, ring_log2_q};
      gloss_pkg::REG_HEAD: rdata_o = {16'd0, head_i};
      gloss_pkg::REG_TAIL: rdata_o = {16'd0, tail_q};
      gloss_pkg::REG_COMPLETION_LOW: rdata_o = records_q[31:0];
      gloss_pkg::REG_COMPLETION_HIGH: rdata_o = records_q[63:32];
      gloss_pkg::REG_DMA_ERROR_LOW: rdata_o = dma_error_i ? dma_address_i[31:0] : '0;
      gloss_pkg::REG_DMA_ERROR_HIGH: rdata_o = dma_error_i ? dma_address_i[63:32] : '0;
      default: rdata_o = '0;
    endcase
  end

  always_ff @(posedge clk_i or negedge core_rst_ni) begin
    if (!core_rst_ni) begin
      enable_q <= 1'b0;
      ring_q <= '0;
      ring_log2_q <= '0;
      tail_q <= '0;
      records_q <= '0;
      mask_q <= '0;
    end else if (write_i) begin
      unique case (address_i)
        gloss_pkg::REG_CONTROL: enable_q <= wdata_i[0];
        gloss_pkg::REG_RING_LOW: ring_q[31:0] <= wdata_i;
        gloss_pkg::REG_RING_HIGH: ring_q[63:32] <= wdata_i;
        gloss_pkg::REG_RING_LOG2: ring_log2_q <= wdata_i[3:0];
        gloss_pkg::REG_TAIL: tail_q <= wdata_i[15:0];
        gloss_pkg::REG_COMPLETION_LOW: records_q[31:0] <= wdata_i;
        gloss_pkg::REG_COMPLETION_HIGH: records_q[63:32] <= wdata_i;
        gloss_pkg::REG_INTERRUPT_MASK: mask_q <= wdata_i[2:0];
        default: ;
      endcase
    end
  end

  // ---- events ----
  // A message that waits stands for what happens meanwhile, too. What happens in the clock in which
  // it is taken has the next one: the driver may be looking at the registers already.
  assign events = resetting_i ? '0 : {dma_event_i, fault_i, done_i};
  assign cleared = write_i && address_i == gloss_pkg::REG_INTERRUPT_STATUS ? wdata_i[2:0] : '0;
  assign irq_o = (events_q & mask_q) != '0;

  always_ff @(posedge clk_i or negedge core_rst_ni) begin
    if (!core_rst_ni) begin
      events_q <= '0;
      msi_valid_o <= 1'b0;
    end else begin
      events_q <= (events_q & ~cleared) | events;
      msi_valid_o <= (events & mask_q) != '0 || (msi_valid_o && !msi_ready_i);
    end
  end

endmodule
