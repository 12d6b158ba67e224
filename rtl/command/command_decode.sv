// SPDX-License-Identifier: Apache-2.0
// Walks a job's stream: takes headers, passes triangles on as rows for the render queue, gives
// other packets to command_packet, and ends the job with its status.
//
// Words move in two steps. In the first they are taken from the aligner into row_q; in the second
// they are checked and go to the render queue. What the check of a row says is known a clock after
// that, of a header two; so a triangle is sent before it is known to be right, and what draws it
// comes with the op after its last row. That is two clocks behind this row and three behind the
// header, just as a fault in them is known, and a fault holds it back. A record takes a clock for
// its header and one for each row; a small one's header is in its first row.
module command_decode #(
  parameter int unsigned TileSize = 64,
  parameter int unsigned StreamBits = 32
) (
  input  logic                               clk_i,
  input  logic                               rst_ni,

  // job and its status
  input  logic                               job_valid_i,
  output logic                               job_ready_o,
  input  logic [31:0]                        job_stream_words_i,
  output logic                               start_o,
  output logic                               status_valid_o,
  input  logic                               status_ready_i,
  output logic [3:0]                         status_cause_o,
  output logic [31:0]                        status_offset_o,

  // from command_align
  input  logic [StreamBits-1:0]              words_i,
  input  logic [$clog2(StreamBits/32+1)-1:0] have_i,
  output logic [$clog2(StreamBits/32+1)-1:0] take_o,
  input  logic                               small_i,
  input  logic                               whole_i,
  input  logic                               end_i,
  input  logic [31:0]                        left_i,       // a clock late

  // to the render queue
  output logic                               render_valid_o,
  input  logic                               render_ready_i,
  output gloss_pkg::render_op_t              render_op_o,
  output logic [StreamBits-1:0]              render_data_o,
  output logic                               triangle_o,   // one was executed

  // to command_packet
  output logic                               packet_start_o,
  output logic                               packet_drop_o,
  input  logic                               packet_done_i,
  input  logic                               packet_refuse_i,
  input  logic [3:0]                         packet_cause_i,
  input  logic                               packet_take_i,
  input  logic                               packet_push_i,
  input  logic [2:0]                         packet_kind_i,
  input  logic [2:0]                         packet_part_i,
  output logic                               packet_push_ready_o,
  output logic [31:0]                        header_o,
  output logic [31:0]                        word_o,
  input  logic                               in_tile_i,

  input  logic                               idle_i,       // tile and memory have nothing to do
  input  logic                               memory_error_i,
  output logic                               stall_stream_o
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned CountBits = $clog2(Lanes + 1);

  typedef enum logic [3:0] {
    Idle,
    Reset,    // the render state
    Header,
    Triangle, // its rows
    Check,    // the header of another packet,
    Verdict,  // and how it went
    Skip,     // the payload of NOP
    Start,    // command_packet,
    Packet,   // and wait for it
    Locate,   // the word of a fault
    Drop,     // an open tile
    Drain,    // the rest of the stream
    Finish,   // until everything is done
    Status
  } state_e;

  state_e               state_q, state_d;
  logic [31:0]          header_q;
  logic [10:0]          skip_q;
  logic [StreamBits-1:0] row_q;
  gloss_pkg::render_op_t op_q;
  logic                 op_valid_q, op_ready;
  logic                 op_push;
  logic [2:0]           op_kind, op_part;
  logic [4:0]           op_row;
  logic                 go_q;               // a record was taken whole, and no op after it

  logic [CountBits-1:0] take, take_q;
  logic                 header_take, row_take, have_row, head_full, row_free;
  logic                 header_check_q, row_check_q;

  logic [3:0]           header_fault;
  logic                 row_bad, row_last;
  logic [CountBits-1:0] row_words, row_behind;
  logic [2:0]           row_part;
  logic [4:0]           row_row;

  // A fault: refused_q for a clock, in which nothing moves. What each check said goes to registers
  // first; the one that counts is chosen in that clock, and then cause and place stay in cause_q
  // and behind_q.
  logic                 refused_q, refuse, step_refuse;
  logic [3:0]           step_cause, step_cause_q, header_fault_q, cause_q;
  logic                 row_refuse, row_refuse_q;
  logic                 step_behind, step_behind_q;  // words taken from the faulty one on
  logic [CountBits-1:0] row_behind_q, header_behind_q, header_words_q;
  // The words beside a small record's header are checked with its rows, and count when the header
  // was found right.
  logic                 head_refuse, head_refuse_q;
  logic [CountBits-1:0] head_behind, head_behind_q;
  logic [3:0]           behind_q;
  logic [31:0]          offset_q;

  command_header u_header (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .check_i  (header_check_q && !refused_q),
    .header_i (row_q[31:0]),
    .left_i   (left_i),
    .in_tile_i(in_tile_i),
    .fault_o  (header_fault)
  );

  command_record #(
    .TileSize  (TileSize),
    .StreamBits(StreamBits)
  ) u_record (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .start_i (header_take),
    .header_i(words_i[31:0]),
    .words_o (row_words),
    .part_o  (row_part),
    .row_o   (row_row),
    .last_o  (row_last),
    .take_i  (row_take),
    .data_i  (row_q),
    .bad_o   (row_bad),
    .behind_o(row_behind)
  );

  assign start_o = job_valid_i && job_ready_o;
  assign have_row = have_i >= row_words;
  assign head_full = have_i == CountBits'(Lanes);

  // ---- first step: what is taken, and what goes to the queue with it ----
  always_comb begin
    state_d = state_q;
    job_ready_o = 1'b0;
    status_valid_o = 1'b0;
    take = '0;
    header_take = 1'b0;
    row_take = 1'b0;
    op_push = 1'b0;
    op_kind = gloss_pkg::RENDER_STATE;
    op_part = gloss_pkg::STATE_RESET;
    op_row = '0;
    packet_start_o = 1'b0;
    packet_drop_o = 1'b0;
    step_refuse = 1'b0;
    step_cause = gloss_pkg::FAULT_NONE;
    step_behind = 1'b1;
    stall_stream_o = 1'b0;

    unique case (state_q)
      Idle: begin
        job_ready_o = 1'b1;
        if (start_o) state_d = Reset;
      end
      Reset: begin
        op_push = 1'b1;
        if (op_ready) state_d = Header;
      end
      Header:
        if (op_ready) begin
          if (memory_error_i) begin
            step_refuse = 1'b1;
            step_cause = gloss_pkg::FAULT_MEMORY;
            step_behind = 1'b0;
          end else if (end_i) begin
            step_refuse = in_tile_i;
            step_cause = gloss_pkg::FAULT_ORDER;
            step_behind = 1'b0;
            state_d = Finish;
          end else if (have_i != '0 && (!small_i || head_full || whole_i)) begin
            // A record that the stream cuts off is its header alone, which is then found wrong.
            take = small_i && head_full ? CountBits'(Lanes) : CountBits'(1);
            header_take = 1'b1;
            op_kind = gloss_pkg::RENDER_HEADER;
            op_part = small_i ? gloss_pkg::PART_SMALL : gloss_pkg::PART_NONE;
            op_push = small_i || words_i[31:24] == gloss_pkg::OP_TRIANGLE;
            state_d = op_push ? Triangle : Check;
          end else begin
            stall_stream_o = 1'b1;
          end
        end
      Triangle: begin
        op_kind = gloss_pkg::RENDER_PAYLOAD;
        op_part = row_part;
        op_row = row_row;
        row_take = op_ready && have_row;
        op_push = row_take;
        if (row_take) take = row_words;
        if (row_take && row_last) state_d = Header;
        stall_stream_o = !have_row;
      end
      Check: state_d = Verdict;
      Verdict: state_d = header_q[31:24] == gloss_pkg::OP_NOP ? Skip : Start;
      Skip: begin
        if (skip_q == '0) state_d = Header;
        else if (have_i != '0) take = CountBits'(1);
        else stall_stream_o = 1'b1;
      end
      Start: begin
        packet_start_o = 1'b1;
        state_d = Packet;
      end
      Packet: begin
        take = CountBits'(packet_take_i);
        op_push = packet_push_i;
        op_kind = packet_kind_i;
        op_part = packet_part_i;
        step_refuse = packet_refuse_i;
        step_cause = packet_cause_i;
        if (packet_done_i) state_d = Header;
      end
      Locate: state_d = Drop;
      Drop: begin
        packet_drop_o = in_tile_i;
        op_push = packet_push_i;
        op_kind = packet_kind_i;
        if (!in_tile_i) state_d = Drain;
      end
      Drain: begin
        take = have_i;
        if (end_i) state_d = Finish;
      end
      Finish: if (idle_i) state_d = Status;
      Status: begin
        status_valid_o = 1'b1;
        if (status_ready_i) state_d = Idle;
      end
      default: state_d = Idle;
    endcase

    if (refused_q) begin
      state_d = Locate;
      take = '0;
      header_take = 1'b0;
      row_take = 1'b0;
      op_push = 1'b0;
      packet_start_o = 1'b0;
    end
  end

  assign take_o = take;
  assign header_o = header_q;
  assign word_o = row_q[31:0];
  assign packet_push_ready_o = op_ready;
  assign status_cause_o = cause_q;
  assign status_offset_o = offset_q;

  // Of triangles it has whatever comes next, taken or not, as soon as the row before is sent: all
  // that is decided about a word would stand before its many enables.
  assign row_free = state_q == Header || state_q == Triangle ? op_ready
                                                             : state_q == Packet && packet_take_i;

  always_ff @(posedge clk_i) begin
    if (row_free) row_q <= words_i;
    if (header_take) header_q <= words_i[31:0];
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Idle;
      header_check_q <= 1'b0;
      row_check_q <= 1'b0;
      skip_q <= '0;
    end else begin
      state_q <= state_d;
      header_check_q <= header_take;
      row_check_q <= row_take;
      if (header_take) skip_q <= words_i[10:0];
      else if (state_q == Skip && have_i != '0) skip_q <= skip_q - 1'b1;
    end
  end

  // ---- second step: to the queue ----
  assign op_ready = !op_valid_q || render_ready_i;
  assign render_valid_o = op_valid_q && !refused_q;
  assign render_op_o = op_q;
  assign render_data_o = row_q;
  assign triangle_o = render_valid_o && render_ready_i && op_q.go;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      op_valid_q <= 1'b0;
      op_q <= '0;
      go_q <= 1'b0;
    end else if (refused_q) begin
      op_valid_q <= 1'b0;
      go_q <= 1'b0;
    end else if (op_ready) begin
      op_valid_q <= op_push;
      op_q <= {go_q, op_kind, op_part, op_row};
      if (op_push) go_q <= row_take && row_last;
    end
  end

  // ---- faults ----
  assign row_refuse = row_check_q && row_bad;
  assign refuse = !refused_q && (step_refuse || row_refuse || head_refuse ||
                                 header_fault != gloss_pkg::FAULT_NONE);

  always_ff @(posedge clk_i) begin
    step_cause_q <= step_cause;
    step_behind_q <= step_behind;
    row_refuse_q <= row_refuse;
    row_behind_q <= row_behind;
    header_fault_q <= header_fault;
    header_behind_q <= take_q;
    header_words_q <= header_behind_q;
    head_behind <= row_behind;
    head_behind_q <= head_behind;
    head_refuse_q <= head_refuse;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      refused_q <= 1'b0;
      head_refuse <= 1'b0;
      take_q <= '0;
      cause_q <= gloss_pkg::FAULT_NONE;
      behind_q <= '0;
      offset_q <= '0;
    end else begin
      refused_q <= refuse;
      head_refuse <= header_check_q && row_bad && !refused_q;
      take_q <= take;
      if (start_o) begin
        cause_q <= gloss_pkg::FAULT_NONE;
        offset_q <= job_stream_words_i;
      end else if (refused_q) begin
        if (header_fault_q != gloss_pkg::FAULT_NONE) begin
          cause_q <= header_fault_q;
          behind_q <= 4'(header_words_q) + 4'(header_behind_q);
        end else if (head_refuse_q) begin
          cause_q <= gloss_pkg::FAULT_VALUE;
          behind_q <= 4'(head_behind_q) + 4'(header_behind_q);
        end else if (row_refuse_q) begin
          cause_q <= gloss_pkg::FAULT_VALUE;
          behind_q <= 4'(row_behind_q);
        end else begin
          cause_q <= step_cause_q;
          behind_q <= {3'b0, step_behind_q};
        end
        // Left is what it was when the fault was found, whatever was taken in that clock.
        offset_q <= offset_q - left_i;
      end else if (state_q == Locate) begin
        offset_q <= offset_q - {28'b0, behind_q};
      end else if (state_q == Finish && memory_error_i && cause_q == gloss_pkg::FAULT_NONE) begin
        cause_q <= gloss_pkg::FAULT_MEMORY;
      end
    end
  end

`ifndef SYNTHESIS
  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      rows_are_ops: assert (!row_take || (op_push && op_ready));
      tile_begins_without_go: assert (!(op_valid_q && op_q.go) ||
                                      op_q.kind != gloss_pkg::RENDER_BEGIN);
      refused_once: assert (!refused_q || state_q != Locate);
    end
  end
`endif

endmodule
