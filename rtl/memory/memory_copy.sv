// SPDX-License-Identifier: Apache-2.0
// WRITE_MEMORY and READ_MEMORY, one at a time: bursts of up to sixteen beats for either, words to
// beats in memory_copy_write, beats to words in memory_copy_read.
module memory_copy #(
  parameter int unsigned PixelsPerClock = 1,
  localparam int unsigned Width = 32 * PixelsPerClock
) (
  input  logic                        clk_i,
  input  logic                        rst_ni,

  // from command
  input  logic                        copy_valid_i,
  output logic                        copy_ready_o,
  input  gloss_pkg::copy_op_t         copy_i,
  input  logic                        copy_data_valid_i,
  output logic                        copy_data_ready_o,
  input  logic [31:0]                 copy_data_i,
  output logic                        copy_idle_o,

  // words read
  output logic                        response_valid_o,
  input  logic                        response_ready_i,
  output logic [3:0]                  response_count_o,
  output logic [Width-1:0]            response_data_o,

  // to memory_axi: the bursts of a write or of a read
  output logic                        write_valid_o,
  input  logic                        write_ready_i,
  output logic                        read_valid_o,
  input  logic                        read_ready_i,
  output logic [31:0]                 address_o,
  output logic [3:0]                  length_o,
  output logic                        write_data_valid_o,
  input  logic                        write_data_ready_i,
  output logic [Width-1:0]            write_data_o,
  output logic [4*PixelsPerClock-1:0] write_strobe_o,
  output logic                        write_last_o,
  input  logic                        write_done_i,
  input  logic                        read_data_valid_i,
  output logic                        read_data_ready_o,
  input  logic [Width-1:0]            read_data_i
);

  localparam int unsigned LaneBits = $clog2(PixelsPerClock);
  localparam int unsigned BeatBits = 30 - LaneBits;

  // Addresses more than a few ahead of their data would only fill memory's queues.
  localparam logic signed [2:0] AheadMax = 3'sd3;

  typedef enum logic [1:0] {Idle, Start, Run} state_e;

  state_e state_d, state_q;
  logic idle_q;                    // drives the ways to and from AXI's data, which are many
  gloss_pkg::copy_op_t op_q;
  logic [BeatBits-1:0] last_beat;

  logic burst_valid, burst_ready;
  logic [BeatBits-1:0] burst_beat;
  logic signed [2:0] ahead_q;      // bursts whose address was taken, less those whose data were
  logic [12:0] unacknowledged_q;   // bursts whose address was taken
  logic write_address_taken, write_burst_taken, write_addressed;
  logic write_busy, read_busy;
  logic word_valid, word_ready;
  logic [31:0] word;
  logic beat_valid, beat_ready, beat_last, beat_out;
  logic [4*PixelsPerClock-1:0] beat_strobe;
  logic [Width-1:0] beat;

  assign copy_ready_o = idle_q;
  assign copy_idle_o = idle_q;
  assign last_beat = BeatBits'((op_q.address[31:2] + 30'(op_q.words) - 30'd1) >> LaneBits);

  assign write_valid_o = burst_valid && op_q.write && ahead_q != AheadMax;
  assign read_valid_o = burst_valid && !op_q.write;
  assign burst_ready = op_q.write ? write_ready_i && ahead_q != AheadMax : read_ready_i;
  assign address_o = {burst_beat, {(LaneBits + 2) {1'b0}}};
  // Data never come before their address, and never wait for it to be taken.
  assign write_addressed = ahead_q > 0 || (ahead_q == 0 && write_valid_o);
  assign write_address_taken = write_valid_o && write_ready_i;
  assign write_burst_taken = write_data_valid_o && write_data_ready_i && write_last_o;

  always_comb begin
    state_d = state_q;
    unique case (state_q)
      Idle: if (copy_valid_i) state_d = Start;
      Start: state_d = Run;
      Run: begin
        if (!burst_valid && !write_busy && !beat_out && !read_busy && unacknowledged_q == '0)
          state_d = Idle;
      end
      default: state_d = Idle;
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (copy_ready_o) op_q <= copy_i;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
      idle_q <= 1'b1;
      ahead_q <= '0;
      unacknowledged_q <= '0;
    end else begin
      state_q <= state_d;
      idle_q <= state_d == Idle;
      ahead_q <= ahead_q + 3'(write_address_taken) - 3'(write_burst_taken);
      unacknowledged_q <= unacknowledged_q + 13'(write_address_taken) - 13'(write_done_i);
    end
  end

  memory_burst #(
    .BeatBits(BeatBits)
  ) u_burst (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .start_i (state_q == Start),
    .first_i (op_q.address[31:2+LaneBits]),
    .last_i  (last_beat),
    .valid_o (burst_valid),
    .ready_i (burst_ready),
    .beat_o  (burst_beat),
    .length_o(length_o)
  );

  // Keeps the two ends of a way apart that else leads from the stream's port through to AXI's, and
  // back.
  stream_register #(
    .Width(32)
  ) u_word (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(copy_data_valid_i),
    .ready_o(copy_data_ready_o),
    .data_i (copy_data_i),
    .valid_o(word_valid),
    .ready_i(word_ready),
    .data_o (word)
  );

  memory_copy_write #(
    .PixelsPerClock(PixelsPerClock)
  ) u_write (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .start_i (state_q == Start && op_q.write),
    .word_i  (op_q.address[8:2]),
    .words_i (op_q.words),
    .busy_o  (write_busy),
    .valid_i (word_valid),
    .ready_o (word_ready),
    .data_i  (word),
    .valid_o (beat_valid),
    .ready_i (beat_ready),
    .data_o  (beat),
    .strobe_o(beat_strobe),
    .last_o  (beat_last)
  );

  // The same for AXI's ready and the registers in which beats are gathered.
  stream_register #(
    .Width(1 + 4 * PixelsPerClock + Width)
  ) u_beat (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(beat_valid),
    .ready_o(beat_ready),
    .data_i ({beat_last, beat_strobe, beat}),
    .valid_o(beat_out),
    .ready_i(write_data_ready_i && write_addressed),
    .data_o ({write_last_o, write_strobe_o, write_data_o})
  );

  assign write_data_valid_o = beat_out && write_addressed;

  memory_copy_read #(
    .PixelsPerClock(PixelsPerClock)
  ) u_read (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .start_i(state_q == Start && !op_q.write),
    .word_i (op_q.address[4:2]),
    .words_i(op_q.words),
    .busy_o (read_busy),
    .valid_i(read_data_valid_i),
    .ready_o(read_data_ready_o),
    .data_i (read_data_i),
    .valid_o(response_valid_o),
    .ready_i(response_ready_i),
    .count_o(response_count_o),
    .data_o (response_data_o)
  );

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      data_after_address: assert (ahead_q >= 0 || (ahead_q == -1 && write_valid_o));
    end
  end
`endif

endmodule
