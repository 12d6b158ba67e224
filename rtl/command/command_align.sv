// SPDX-License-Identifier: Apache-2.0
// Beats to words: shows the next StreamBits/32 words of the job at whatever word they start, and
// counts the words left. A beat is fetched only if the job has words in it, so the next job's wait;
// what is left over of a job's last beat is forgotten at the next start. From the port to words_o a
// beat takes one clock, with several words a beat two or three.
module command_align #(
  parameter int unsigned StreamBits = 32
) (
  input  logic                               clk_i,
  input  logic                               rst_ni,

  input  logic                               start_i, // nothing is taken in this clock and the next
  input  logic [31:0]                        words_i, // of the job

  input  logic                               stream_valid_i,
  output logic                               stream_ready_o,
  input  logic [StreamBits-1:0]              stream_data_i,

  output logic [StreamBits-1:0]              words_o, // the next word in the low bits
  output logic [$clog2(StreamBits/32+1)-1:0] have_o,  // how many of them are there
  input  logic [$clog2(StreamBits/32+1)-1:0] take_i,  // at most have_o
  output logic                               small_o, // the next word may begin a TRIANGLE_SMALL
  output logic                               whole_o, // the job has no more words than have_o
  output logic                               end_o,   // all words of the job were taken
  output logic [31:0]                        left_o   // of the job, a clock late
);

  localparam int unsigned Lanes = StreamBits / 32;
  localparam int unsigned CountBits = $clog2(Lanes + 1);

  // Keeps the wide counter out of the way from the stream to the decoder and back: it follows a
  // clock later. Ample is that at least 8*Lanes words were left two clocks ago, so more than Lanes
  // are now; else the low bits tell all.
  logic [31:0]           left_q;
  logic [CountBits-1:0]  take_q;
  logic                  ample_q;
  logic [CountBits+1:0]  few_q;

  logic                  beat_valid, beat_ready;
  logic [StreamBits-1:0] beat;

  stream_register #(
    .Width(StreamBits)
  ) u_input (
    .clk_i  (clk_i),
    .rst_ni (rst_ni),
    .valid_i(stream_valid_i),
    .ready_o(stream_ready_o),
    .data_i (stream_data_i),
    .valid_o(beat_valid),
    .ready_i(beat_ready),
    .data_o (beat)
  );

  assign end_o = !ample_q && few_q == '0;
  assign left_o = left_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      left_q <= '0;
      few_q <= '0;
      take_q <= '0;
      ample_q <= 1'b0;
    end else begin
      left_q <= start_i ? words_i : left_q - 32'(take_q);
      few_q <= start_i ? words_i[CountBits+1:0] : few_q - (CountBits+2)'(take_i);
      take_q <= take_i;
      ample_q <= |left_q[31:CountBits+2];
    end
  end

  if (Lanes == 1) begin : gen_word
    assign words_o = beat;
    assign have_o = beat_valid && !end_o;
    assign beat_ready = take_i;
    assign small_o = beat[31:24] == gloss_pkg::OP_TRIANGLE_SMALL;
    assign whole_o = !ample_q && few_q == (CountBits+2)'(have_o);
  end else begin : gen_window
    localparam int unsigned LaneBits = $clog2(Lanes);
    localparam logic [Lanes:0] More = {(Lanes+1){1'b1}};  // than Lanes

    // words_o starts in the first beat or the second and ends in the input's at the latest. What is
    // taken moves skip_q at once, and beats a clock later: so take_i, which is known late, enables
    // no wide register, nor the stream's port.
    logic [StreamBits-1:0]  first_q, second_q;
    logic                   first_full_q, second_full_q;
    logic [LaneBits:0]      skip_q;    // words of the two that were taken
    logic [32-LaneBits:0]   wanted_q;  // beats of the job that are still to be taken
    logic                   needed_q;  // there are some
    // Numbers of words as masks, a bit for each word up to Lanes, one more in few: the least of two
    // is their conjunction, and there is no carry on the way from have_o to take_i and back.
    logic [Lanes:0]         some, few, have;
    logic                   third, spent, move;
    logic [Lanes-1:0]       is_small, first_small_q, second_small_q;

    assign third = second_full_q && beat_valid && needed_q;
    assign some = {1'b0, Lanes'({{Lanes{third}}, {Lanes{second_full_q}}, {Lanes{first_full_q}}}
                                >> skip_q)};
    assign few = ample_q || |few_q[CountBits+1:CountBits] ? More : ~(More << few_q[CountBits-1:0]);
    assign have = some & few;
    assign whole_o = (few & ~some) == '0;

    always_comb begin
      have_o = '0;
      for (int n = 0; n < Lanes; n++) if (have[n] && !have[n+1]) have_o = CountBits'(n + 1);
    end

    assign words_o = StreamBits'({beat, second_q, first_q} >> {skip_q, 5'b0});

    assign spent = skip_q[LaneBits];
    assign beat_ready = needed_q && (!second_full_q || spent);
    assign move = beat_valid && beat_ready;

    // Found out before the words are shifted.
    for (genvar l = 0; l < Lanes; l++) begin : gen_small
      assign is_small[l] = beat[32*l+24 +: 8] == gloss_pkg::OP_TRIANGLE_SMALL;
    end
    assign small_o = 1'({second_small_q, first_small_q} >> skip_q);

    always_ff @(posedge clk_i) begin
      if (!first_full_q || spent) begin
        first_q <= second_full_q ? second_q : beat;
        first_small_q <= second_full_q ? second_small_q : is_small;
      end
      if (!second_full_q || spent) begin
        second_q <= beat;
        second_small_q <= is_small;
      end
    end

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        first_full_q <= 1'b0;
        second_full_q <= 1'b0;
        skip_q <= '0;
        wanted_q <= '0;
        needed_q <= 1'b0;
      end else if (start_i) begin
        first_full_q <= 1'b0;
        second_full_q <= 1'b0;
        skip_q <= '0;
        wanted_q <= (33-LaneBits)'(({1'b0, words_i} + 33'(Lanes - 1)) >> LaneBits);
        needed_q <= words_i != '0;
      end else begin
        if (!first_full_q || (spent && !second_full_q)) first_full_q <= move;
        if (spent || (first_full_q && !second_full_q)) second_full_q <= move && (second_full_q ||
                                                                                 !spent);
        skip_q <= {1'b0, skip_q[LaneBits-1:0]} + (LaneBits+1)'(take_i);
        if (move) begin
          wanted_q <= wanted_q - 1'b1;
          needed_q <= wanted_q != (33-LaneBits)'(1);
        end
      end
    end
  end

`ifndef SYNTHESIS
  logic started_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) started_q <= 1'b0;
    else started_q <= start_i;
  end

  always_ff @(posedge clk_i) begin
    if (rst_ni) begin
      take_what_is_there: assert (take_i <= have_o);
      nothing_taken_at_start: assert (take_i == '0 || !(start_i || started_q));
      end_when_none_left: assert (!end_o || started_q || left_q == 32'(take_q));
    end
  end
`endif

endmodule
