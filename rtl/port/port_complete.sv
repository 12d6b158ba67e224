// SPDX-License-Identifier: Apache-2.0
// The end of a job, step by step: the core's status, the last response words, their
// acknowledgement, the completion record, its acknowledgement. Then, in one clock, done_o: whoever
// sees an effect of that finds all in host memory.
module port_complete #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  // core
  input  logic                  status_valid_i,
  output logic                  status_ready_o,
  // verilator lint_off UNUSEDSIGNAL
  input  gloss_pkg::status_t    status_i,
  // verilator lint_on UNUSEDSIGNAL

  // ring and registers
  input  logic [63:4]           records_i,
  input  logic [7:0]            entry_i,
  input  logic [31:0]           sequence_i,
  output logic                  done_o,
  input  logic                  stop_i,          // the host refused something: not done

  // to port_write and the response's port_list
  output logic                  flush_o,
  input  logic                  written_i,
  output logic                  list_stop_o,
  input  logic                  list_empty_i,

  // host writes
  input  logic                  pending_i,
  output logic                  completion_o,
  output logic                  address_valid_o,
  input  logic                  address_ready_i,
  output logic [63:4]           address_o,
  output logic [7:0]            length_o,
  output logic                  data_valid_o,
  input  logic                  data_ready_i,
  output logic [StreamBits-1:0] data_o
);

  localparam int unsigned Beats = gloss_pkg::COMPLETION_BITS / StreamBits;

  typedef enum logic [2:0] {Idle, Flush, Drop, Address, Data, Answer} state_e;

  state_e state_d, state_q;
  gloss_pkg::completion_t record;
  logic [1:0] beat_q;
  logic last_beat;

  assign record = {status_i.response_words, status_i.offset, 28'd0, status_i.cause, sequence_i};
  assign data_o = record[StreamBits*beat_q +: StreamBits];
  assign last_beat = beat_q == 2'(Beats - 1);

  assign flush_o = state_q == Flush;
  assign list_stop_o = state_q == Drop;
  assign completion_o = state_q == Address || state_q == Data || state_q == Answer;
  assign address_valid_o = state_q == Address;
  assign address_o = records_i + 60'(entry_i);
  assign length_o = 8'(Beats - 1);
  assign data_valid_o = state_q == Data;
  assign done_o = state_q == Answer && !pending_i && !stop_i;
  assign status_ready_o = done_o;

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      Idle: if (status_valid_i) state_d = Flush;
      Flush: if (written_i && !pending_i) state_d = Drop;
      Drop: if (list_empty_i) state_d = Address;
      Address: if (address_ready_i) state_d = Data;
      Data: if (data_ready_i && last_beat) state_d = Answer;
      Answer: if (done_o) state_d = Idle;
      default: state_d = Idle;
    endcase
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
      beat_q <= '0;
    end else begin
      state_q <= state_d;
      if (data_valid_o && data_ready_i) beat_q <= last_beat ? '0 : beat_q + 1'b1;
    end
  end

endmodule
