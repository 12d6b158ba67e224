/* SPDX-License-Identifier: MIT */
/*
 * command with random stalls on every port, between streams and stages that take what comes out of
 * it; each thing that comes must be the next expected of its port.
 */
#ifndef TESTS_COMMAND_BENCH_H
#define TESTS_COMMAND_BENCH_H

#include "Vcommand.h"
#include "command_expected.h"
#include "tb.h"

enum { ROW = STREAM / 32 };

/* Parts of a triangle's payload, as in gloss_pkg.sv. */
enum { EDGES, DEPTH, ALPHA, COLOUR, SMALL, SMALL_COLOUR, SMALL_ROWS, PART_NONE };

/* Collects a triangle's rows; its words are right only once an op with go has come. */
class Record
{
      public:
	template <class Data> void begin(unsigned int part, const Data &data)
	{
		uint32_t word = tb_get(data, 0, 32);
		bool is_small = gloss_header_opcode(word) == GLOSS_OP_TRIANGLE_SMALL;

		words = { GO };
		valid = gloss_header_valid(word);
		row = 0;
		for (unsigned int &count : left)
			count = 0;
		TB_CHECK(part == (is_small ? SMALL : PART_NONE), "a header of part %u", part);
		if (is_small) {
			begin_small(word);
			add(SMALL, 0, data);
		} else {
			begin_large(word);
			words.push_back(word);
		}
	}

	template <class Data> void add(unsigned int part, unsigned int at, const Data &data)
	{
		unsigned int expected = 0;

		if (!valid)
			return;
		while (expected < SMALL_ROWS && !left[expected])
			expected++;
		TB_CHECK(part == expected, "row of part %u instead of %u", part, expected);
		TB_CHECK(at == row, "row %u instead of %u of part %u", at, row, part);
		for (unsigned int n = 0; n < ROW && left[part]; n++, left[part]--)
			words.push_back(tb_get(data, 32 * n, 32));
		row = left[part] ? row + 1 : 0;
	}

	std::vector<uint64_t> words;

      private:
	void begin_small(uint32_t word)
	{
		gloss_triangle_small p;

		gloss_triangle_small_unpack(&word, &p);
		left[SMALL] = 1 + GLOSS_PIXELS_SMALL_WORDS + GLOSS_DEPTH_SMALL_WORDS;
		left[SMALL_COLOUR] =
			p.shading == GLOSS_SHADING_FLAT   ? GLOSS_COLOUR_FLAT_WORDS :
			p.shading == GLOSS_SHADING_LINEAR ? GLOSS_COLOUR_LINEAR_SMALL_WORDS :
							    GLOSS_COLOUR_SECOND_ORDER_SMALL_WORDS;
		left[SMALL_ROWS] = p.row_words;
	}

	void begin_large(uint32_t word)
	{
		gloss_triangle p;

		gloss_triangle_unpack(&word, &p);
		bool wide = p.geometry == GLOSS_GEOMETRY_WIDE;
		bool compact = p.geometry == GLOSS_GEOMETRY_COMPACT;

		left[0] = wide ? GLOSS_EDGES_WIDE_WORDS : compact ? GLOSS_EDGES_COMPACT_WORDS : 0;
		left[1] = compact ? GLOSS_DEPTH_COMPACT_WORDS : GLOSS_DEPTH_WIDE_WORDS;
		left[2] = p.alpha_linear ? GLOSS_ALPHA_LINEAR_WORDS : 0;
		left[3] = p.shading == GLOSS_SHADING_FLAT   ? GLOSS_COLOUR_FLAT_WORDS :
			  p.shading == GLOSS_SHADING_LINEAR ? GLOSS_COLOUR_LINEAR_WORDS :
							      GLOSS_COLOUR_SECOND_ORDER_WORDS;
	}

	unsigned int left[PART_NONE], row;
	bool valid; /* else the rows have no meaning, and no op has go */
};

class CommandBench : public Bench<Vcommand>
{
      public:
	explicit CommandBench(uint64_t seed) : random(seed)
	{
		for (int n = 0; n < PORTS; n++)
			stall.emplace_back(random);
	}

	gloss_status run(const accel_job &job, const Expected &expected);

	Random random;
	bool stalls = true;
	uint64_t record_clocks[3]; /* of the first and last op with go, and how many */
	bool spoil = false;        /* memory fails at some time */

      private:
	enum { STREAM_IN, RENDER, BEGIN_OP, END_OP, COPY, COPY_DATA, RESPONSE, STATUS, PORTS };

	bool ready(int port)
	{
		return !stalls || !stall[port].now();
	}
	void start(const accel_job &job);
	void drive(const accel_job &job);
	void clock();
	void settle_queue();
	void sample_render();
	void sample_tile();
	void sample_copy();
	void take(Port &port, const std::vector<uint64_t> &value, const char *name);

	std::vector<Stall> stall;
	Expected left;
	Record record;
	uint32_t beat, beats;
	unsigned int open, drawing; /* tiles between begin and end, and not yet drawn */
	unsigned int finishing, copying, copy_words;
	bool error, check;
};

inline void CommandBench::take(Port &port, const std::vector<uint64_t> &value, const char *name)
{
	if (!check)
		return;
	TB_CHECK(!port.empty(), "%s: %" PRIx64 " came and nothing was expected", name, value[0]);
	TB_CHECK(value.size() == port.front().size(), "%s: %zu words instead of %zu", name,
		 value.size(), port.front().size());
	for (size_t n = 0; n < value.size(); n++)
		TB_CHECK(value[n] == port.front()[n],
			 "%s: word %zu is %" PRIx64 " instead of %" PRIx64, name, n, value[n],
			 port.front()[n]);
	port.pop_front();
}

inline void CommandBench::start(const accel_job &job)
{
	top.job_valid_i = top.stream_valid_i = top.render_ready_i = 0;
	top.tile_begin_ready_i = top.tile_end_ready_i = 0;
	top.copy_ready_i = top.copy_data_ready_i = top.response_ready_i = top.status_ready_i = 0;
	top.tile_idle_i = top.copy_idle_i = 1;
	top.memory_error_i = 0;
	top.covered_i = COVERED;
	top.passed_i = PASSED;
	for (unsigned int n = 0; n < GLOSS_SLOTS; n++) {
		top.slot_write_i = 1;
		top.slot_index_i = n;
		top.slot_base_i = job.slot[n].base;
		top.slot_size_i = job.slot[n].size;
		top.slot_rights_i = job.slot[n].rights;
		clock();
	}
	top.slot_write_i = 0;
	top.render_ready_i = 1;
	top.job_valid_i = 1;
	top.job_stream_words_i = job.stream_words;
	top.job_response_words_i = job.response_words;
	for (int n = 0; settle(), !top.job_ready_o; n++) {
		TB_CHECK(n < 1000, "does not take the next job");
		clock();
	}
	clock();
	top.job_valid_i = 0;
	open = drawing = finishing = copying = copy_words = 0;
	beat = 0;
	beats = (job.stream_words + ROW - 1) / ROW;
	error = false;
	record_clocks[2] = 0;
}

inline void CommandBench::drive(const accel_job &job)
{
	if (!top.stream_valid_i && beat < beats && ready(STREAM_IN)) {
		top.stream_valid_i = 1;
		for (unsigned int n = 0; n < ROW; n++) {
			uint32_t at = beat * ROW + n;

			tb_set(top.stream_data_i, 32 * n, 32,
			       at < job.stream_words ? job.stream[at] : random.bits());
		}
	}
	top.render_ready_i = ready(RENDER);
	top.tile_begin_ready_i = ready(BEGIN_OP);
	top.tile_end_ready_i = ready(END_OP);
	top.copy_ready_i = ready(COPY);
	top.copy_data_ready_i = ready(COPY_DATA);
	top.response_ready_i = ready(RESPONSE);
	top.status_ready_i = ready(STATUS);
	if (finishing && !stall[END_OP].now())
		finishing--;
	if (copying && !copy_words && !stall[COPY].now())
		copying = 0;
	top.tile_idle_i = !open && !finishing && !drawing;
	top.copy_idle_i = !copying;
	error |= spoil && random.below(100) == 0;
	top.memory_error_i = error;
}

inline void CommandBench::sample_render()
{
	unsigned int kind = tb_get(top.render_op_o, 8, 3), part = tb_get(top.render_op_o, 5, 3);
	uint64_t word = tb_get(top.render_data_o, 0, 32);

	if (tb_get(top.render_op_o, 11, 1)) {
		record_clocks[record_clocks[2]++ != 0] = clocks;
		take(left.render, record.words, "render");
	}
	switch (kind) {
	case HEADER:
		return record.begin(part, top.render_data_o);
	case PAYLOAD:
		return record.add(part, tb_get(top.render_op_o, 0, 5), top.render_data_o);
	case STATE:
		if (part == STATE_RESET)
			return take(left.render, { STATE, part }, "render");
		return take(left.render, { STATE, part, word }, "render");
	default:
		/* Of a tile that a fault drops, the triangle before it need not be drawn. */
		if (left.dropped && left.render.size() == 2 && left.render.front()[0] == GO)
			left.render.pop_front();
		drawing -= kind == END;
		return take(left.render, { kind }, "render");
	}
}

inline void CommandBench::sample_tile()
{
	if (top.tile_begin_valid_o && top.tile_begin_ready_i) {
		uint64_t colour = tb_get(top.tile_begin_o, 97, 1);
		uint64_t depth = tb_get(top.tile_begin_o, 96, 1);

		TB_CHECK(!copying, "a tile begins beside a copy");
		take(left.begin,
		     { colour, depth, tb_get(top.tile_begin_o, 64, 32),
		       tb_get(top.tile_begin_o, 16, 32),
		       colour ? tb_get(top.tile_begin_o, 48, 16) : 0,
		       depth ? tb_get(top.tile_begin_o, 0, 16) : 0 },
		     "tile_begin");
		open++;
		drawing++;
	}
	if (top.tile_end_valid_o && top.tile_end_ready_i) {
		uint64_t colour = tb_get(top.tile_end_o, 98, 2),
			 depth = tb_get(top.tile_end_o, 96, 2);
		bool dropped = !left.end.empty() && left.end.front().size() == 2;

		if (dropped)
			take(left.end, { colour, depth }, "tile_end");
		else
			take(left.end,
			     { colour, depth, colour == 1 ? tb_get(top.tile_end_o, 64, 32) : 0,
			       depth == 1 ? tb_get(top.tile_end_o, 16, 32) : 0,
			       colour == 1 ? tb_get(top.tile_end_o, 48, 16) : 0,
			       depth == 1 ? tb_get(top.tile_end_o, 0, 16) : 0 },
			     "tile_end");
		open--;
		finishing += 1 + random.below(20);
	}
}

inline void CommandBench::sample_copy()
{
	if (top.copy_valid_o && top.copy_ready_i) {
		TB_CHECK(top.tile_idle_i && top.copy_idle_i,
			 "a copy starts beside a tile or a copy");
		take(left.copy,
		     { tb_get(top.copy_o, 48, 1), tb_get(top.copy_o, 16, 32),
		       tb_get(top.copy_o, 0, 16) },
		     "copy");
		copying = 1;
		copy_words = tb_get(top.copy_o, 48, 1) ? tb_get(top.copy_o, 0, 16) : 0;
	}
	if (top.copy_data_valid_o && top.copy_data_ready_i) {
		take(left.copy_data, { top.copy_data_o }, "copy_data");
		TB_CHECK(copy_words, "data without a copy");
		copy_words--;
	}
	if (top.response_valid_o && top.response_ready_i) {
		TB_CHECK(top.tile_idle_i && top.copy_idle_i,
			 "counters answer beside a tile or a copy");
		for (unsigned int n = 0; n < top.response_count_o; n++)
			take(left.response, { tb_get(top.response_data_o, 32 * n, 32) },
			     "response");
	}
}

inline void CommandBench::clock()
{
	settle();
	if (top.render_valid_o && top.render_ready_i)
		sample_render();
	sample_tile();
	sample_copy();
	if (top.stream_valid_i && top.stream_ready_o) {
		beat++;
		tick();
		top.stream_valid_i = 0;
	} else {
		tick();
	}
}

/* State set after the last tile may still be in the queue. */
inline void CommandBench::settle_queue()
{
	top.status_ready_i = 0;
	top.render_ready_i = 1;
	for (int n = 0; n < 100; n++)
		clock();
	if (!check)
		return;
	for (const Port *port :
	     { &left.render, &left.begin, &left.end, &left.copy, &left.copy_data, &left.response })
		TB_CHECK(port->empty(), "something expected did not come");
}

inline gloss_status CommandBench::run(const accel_job &job, const Expected &expected)
{
	gloss_status status = {};
	uint64_t limit;

	left = expected;
	check = !spoil;
	start(job);
	limit = clocks + 20000 + 100ull * job.stream_words;
	for (bool ended = false; !ended;) {
		TB_CHECK(clocks < limit, "does not end");
		drive(job);
		settle();
		ended = top.status_valid_o && top.status_ready_i;
		status = { (gloss_fault)tb_get(top.status_o, 0, 4),
			   (uint32_t)tb_get(top.status_o, 32, 32),
			   (uint32_t)tb_get(top.status_o, 64, 32) };
		clock();
	}
	settle_queue();
	TB_CHECK(beat == beats, "%u of %u beats were taken", beat, beats);
	TB_CHECK(!open && !drawing && !finishing && !copying, "ended before tile and memory had");
	return status;
}

#endif
