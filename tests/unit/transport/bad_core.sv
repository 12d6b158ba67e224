// SPDX-License-Identifier: MIT
// A core of one lane for test_sim_wrapper.c: it takes a stream, writes two words
// to slot 0, reads four, answers with them, and does one thing wrong, which the
// low byte of the stream's first word names. A state lasts until its port moves.
module gloss_core #(
    parameter int unsigned TileSize = 32,
    parameter int unsigned PixelsPerClock = 1,
    parameter int unsigned StreamBits = 32
) (
    input  logic         clk_i,
    input  logic         rst_ni,
    input  logic         slot_write_i,
    input  logic [3:0]   slot_index_i,
    input  logic [31:0]  slot_base_i,
    input  logic [31:0]  slot_size_i,
    input  logic [1:0]   slot_rights_i,
    input  logic         job_valid_i,
    output logic         job_ready_o,
    input  logic [31:0]  job_stream_words_i,
    input  logic [31:0]  job_response_words_i,
    output logic         status_valid_o,
    input  logic         status_ready_i,
    output logic [95:0]  status_o,
    output logic [191:0] time_o,
    input  logic         stream_valid_i,
    output logic         stream_ready_o,
    input  logic [31:0]  stream_data_i,
    output logic         response_valid_o,
    input  logic         response_ready_i,
    output logic [3:0]   response_count_o,
    output logic [31:0]  response_data_o,
    output logic         axi_awvalid_o,
    input  logic         axi_awready_i,
    output logic [31:0]  axi_awaddr_o,
    output logic [7:0]   axi_awlen_o,
    output logic         axi_wvalid_o,
    input  logic         axi_wready_i,
    output logic [31:0]  axi_wdata_o,
    output logic [3:0]   axi_wstrb_o,
    output logic         axi_wlast_o,
    input  logic         axi_bvalid_i,
    output logic         axi_bready_o,
    input  logic [1:0]   axi_bresp_i,
    output logic         axi_arvalid_o,
    input  logic         axi_arready_i,
    output logic [31:0]  axi_araddr_o,
    output logic [7:0]   axi_arlen_o,
    input  logic         axi_rvalid_i,
    output logic         axi_rready_o,
    input  logic [31:0]  axi_rdata_i,
    input  logic         axi_rlast_i,
    input  logic [1:0]   axi_rresp_i
);
  localparam logic [7:0] HANG = 1, AR_CROSS = 2, AW_CROSS = 3, LAST_EARLY = 4, LAST_NEVER = 5,
      AW_CHANGE = 6, AW_DROP = 7, W_CHANGE = 8, AR_CHANGE = 9, RESPONSE_CHANGE = 10,
      STATUS_CHANGE = 11, COUNT_NONE = 12, COUNT_MORE = 13, STATUS_FEWER = 14, STREAM_LEFT = 15,
      WRITE_LEFT = 16, READ_EARLY = 17;

  typedef enum logic [3:0] { IDLE, STREAM, ADDRESS, WORD0, WORD1, ANSWER, ASK, READ, DONE } state_e;
  state_e state;

  logic [31:0] base, left, words, first, count, clocks;
  logic [7:0]  wrong;
  logic        begun, failed, waited;

  assign wrong = first[7:0];
  assign job_ready_o = state == IDLE;
  assign stream_ready_o = state == STREAM;

  assign axi_awvalid_o = state == ADDRESS && !(wrong == AW_DROP && waited);
  assign axi_awaddr_o = wrong == AW_CROSS ? base + 4092 :
      base + (wrong == AW_CHANGE && waited ? 8 : 0);
  assign axi_awlen_o = 1;
  assign axi_wvalid_o = state == WORD0 || state == WORD1;
  assign axi_wdata_o = (wrong == W_CHANGE && waited ? 99 : first) + (state == WORD1 ? 256 : 0);
  assign axi_wstrb_o = first[8] ? 4'b0010 : 4'b1111;
  assign axi_wlast_o = wrong == LAST_EARLY || (state == WORD1 && wrong != LAST_NEVER);
  assign axi_bready_o = state != IDLE;

  assign axi_arvalid_o = state == ASK;
  assign axi_araddr_o = wrong == AR_CROSS ? base + 4092 :
      base + (wrong == AR_CHANGE && waited ? 4 : 0);
  assign axi_arlen_o = 3;
  assign axi_rready_o = state == READ && response_ready_i;
  assign response_valid_o = state == READ && axi_rvalid_i;
  assign response_count_o = wrong == COUNT_NONE ? 0 : wrong == COUNT_MORE ? 2 : 1;
  assign response_data_o = axi_rdata_i + (wrong == RESPONSE_CHANGE && waited ? 1 : 0);

  assign status_valid_o = state == DONE;
  assign status_o = {count - (wrong == STATUS_FEWER ? 1 : 0),
      words + (wrong == STATUS_CHANGE && waited ? 1 : 0), failed ? 32'd7 : 32'd0};
  assign time_o = {160'd0, clocks};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state <= IDLE;
      waited <= 0;
    end else begin
      clocks <= clocks + 1;
      // A port that waits for its first clock has waited from the second on.
      waited <= (axi_awvalid_o && !axi_awready_i) || (axi_wvalid_o && !axi_wready_i) ||
          (axi_arvalid_o && !axi_arready_i) || (response_valid_o && !response_ready_i) ||
          (status_valid_o && !status_ready_i);
      failed <= failed || (axi_bvalid_i && axi_bresp_i != 0) ||
          (axi_rvalid_i && axi_rresp_i != 0);
      unique case (state)
        IDLE: begin
          {begun, failed, count, clocks, first} <= '0;
          {left, words} <= {2{job_stream_words_i}};
          if (job_valid_i) state <= STREAM;
        end
        STREAM: if (stream_valid_i) begin
          begun <= 1;
          if (!begun) first <= stream_data_i;
          left <= left - 1;
          if (left == 1) state <= ADDRESS;
          else if (begun && wrong == STREAM_LEFT) state <= DONE;
        end
        ADDRESS: if (axi_awready_i && axi_awvalid_o) state <= wrong == HANG ? STREAM : WORD0;
        WORD0: if (axi_wready_i) state <= WORD1;
        WORD1: if (axi_wready_i)
          state <= wrong == WRITE_LEFT ? DONE : wrong == READ_EARLY ? ASK : ANSWER;
        ANSWER: if (axi_bvalid_i) state <= ASK;
        ASK: if (axi_arready_i) state <= READ;
        READ: if (axi_rvalid_i && response_ready_i) begin
          count <= count + 1;
          if (axi_rlast_i) state <= DONE;
        end
        DONE: if (status_ready_i) state <= IDLE;
        default: state <= IDLE;
      endcase
    end
  end

  always_ff @(posedge clk_i) if (slot_write_i && slot_index_i == 0) base <= slot_base_i;
endmodule
