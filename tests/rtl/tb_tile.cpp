// SPDX-License-Identifier: MIT
/*
 * tile with everything around it played by the bench: command and its render queue, raster and
 * fragment, memory, whoever takes answers. What comes out is compared with tiles that are executed
 * one after the other.
 */
#include "Vtile.h"
#include "tile_memory.h"

static const unsigned int render_state = 3, render_end = 4, render_begin = 5;

class TileBench : public Bench<Vtile> {
public:
	explicit TileBench(uint64_t seed) : random(seed), work(random), memory(random)
	{
		memory.words = work.memory;
	}

	/* Runs until all steps are done and all is idle. */
	void run()
	{
		run_steps(0);
		for (int n = 0; !queue.empty() || !drawing.empty() || !quiet(); n++) {
			TB_CHECK(n < 200000, "does not come to rest");
			clock();
		}
		check_idle();
	}

	/* Random work until so many tiles were made. */
	void run(const Wish &wish, int tiles, bool unkind)
	{
		stalls = unkind;
		for (int n = 0; n < tiles; n += 10) {
			if (unkind)
				memory.unkind();
			else
				memory.steady(20);
			for (int m = 0; m < 10; m++) {
				work.tile(steps, wish);
				/* What is expected runs ahead: to compare it, come to its end. */
				run_steps(steps.back().what == Step::IDLE ? 0 : 40);
			}
		}
		run();
	}

	/* Runs until so few steps are left. */
	void run_steps(size_t left)
	{
		for (int n = 0; steps.size() > left; n++) {
			size_t before = steps.size();

			TB_CHECK(n < 200000, "hangs");
			clock();
			if (steps.size() < before)
				n = 0;
		}
	}

	Random random;
	Work work;
	TileMemory memory;
	std::deque<Step> steps;
	bool stalls = false;
	std::vector<uint64_t> end_clocks;	/* of tiles, when they were drawn */

private:
	struct Op {
		unsigned int kind;
		uint32_t data;
		std::shared_ptr<Draw> draw;
		bool bank;
	};

	/* A row between its read and its write. */
	struct Flight {
		bool valid = false, bank;
		int row, n;
		std::shared_ptr<Draw> draw;
		uint32_t clear_colour, clear_depth;
	};

	bool hold(Stall &stall) { return stalls && stall.now(); }

	bool quiet() { return top.tile_idle_o && memory.quiet() && work.answers.empty() && ends.empty(); }

	void clock()
	{
		command();
		raster();
		fragment();
		top.response_ready_i = !hold(response_stall);
		memory.drive(top, clocks);
		settle();
		sample_raster();
		sample_command();
		sample_answer();
		memory.sample(top, clocks);
		tick();
	}

	/* command and the render queue. */
	void command()
	{
		const Step *step = steps.empty() ? nullptr : &steps.front();

		offered_begin |= step && step->what == Step::BEGIN && !hold(command_stall);
		offered_end |= step && step->what == Step::END && !hold(command_stall);
		top.tile_begin_valid_i = offered_begin;
		top.tile_end_valid_i = offered_end;
		if (offered_begin)
			drive_begin(*step);
		if (offered_end)
			drive_end(*step);
		offered_op |= !queue.empty() && !hold(queue_stall);
		top.render_valid_i = offered_op;
		if (offered_op) {
			top.render_op_i = queue.front().kind << 8 | (random.bits() & 0xff);
			top.render_data_i = queue.front().data;
		}
	}

	void drive_begin(const Step &step)
	{
		tb_set(top.tile_begin_i, 0, 16, step.depth.pitch);
		tb_set(top.tile_begin_i, 16, 32, step.depth.address);
		tb_set(top.tile_begin_i, 48, 16, step.colour.pitch);
		tb_set(top.tile_begin_i, 64, 32, step.colour.address);
		tb_set(top.tile_begin_i, 96, 1, step.depth_load);
		tb_set(top.tile_begin_i, 97, 1, step.colour_load);
	}

	void drive_end(const Step &step)
	{
		tb_set(top.tile_end_i, 0, 16, step.depth.pitch);
		tb_set(top.tile_end_i, 16, 32, step.depth.address);
		tb_set(top.tile_end_i, 48, 16, step.colour.pitch);
		tb_set(top.tile_end_i, 64, 32, step.colour.address);
		tb_set(top.tile_end_i, 96, 2, step.depth_output);
		tb_set(top.tile_end_i, 98, 2, step.colour_output);
	}

	void sample_command()
	{
		if (top.render_valid_i && top.render_ready_o) {
			if (queue.front().kind == render_begin)
				bank = !bank;
			queue.pop_front();
			offered_op = false;
		}
		if (steps.empty())
			return;
		Step &step = steps.front();

		switch (step.what) {
		case Step::BEGIN:
			if (!offered_begin || !top.tile_begin_ready_o)
				return;
			offered_begin = false;
			break;
		case Step::END:
			if (!offered_end || !top.tile_end_ready_o)
				return;
			offered_end = false;
			break;
		case Step::RENDER:
			if (queue.size() >= 32)
				return;
			queue.push_back({ step.kind, step.data, step.draw, false });
			break;
		case Step::IDLE:
			if (!top.tile_idle_o)
				return;
			check_idle();
			break;
		}
		steps.pop_front();
	}

	void check_idle()
	{
		TB_CHECK(work.answers.empty(), "idle with answers to come");
		for (size_t at = 0; at < work.memory.size(); at++)
			TB_CHECK(memory.words[at] == work.memory[at], "word %zx of memory is %08x, not %08x", at,
				 memory.words[at], work.memory[at]);
	}

	/* raster takes ops as fast as it likes and has room for some. */
	void raster()
	{
		top.raster_ready_i = drawing.size() < 4 && !hold(raster_stall);
	}

	void sample_raster()
	{
		if (!top.raster_valid_o)
			return;
		TB_CHECK(top.render_valid_i, "an op comes from nowhere");
		Op op = queue.front();

		TB_CHECK(top.raster_op_o == top.render_op_i && top.raster_data_o == op.data,
			 "the gate changes an op");
		TB_CHECK(op.kind != render_begin, "raster meets a RENDER_BEGIN");
		TB_CHECK(op.kind == render_state || top.raster_bank_o == bank, "wrong bank");
		op.bank = bank;
		if (top.raster_ready_i && op.kind != render_state)
			drawing.push_back(op);
	}

	/* A row a clock, read, and written three clocks later; then the end. */
	void fragment()
	{
		flight[3] = flight[2];
		flight[2] = flight[1];
		flight[1] = flight[0];
		flight[0] = Flight();
		flight[2].clear_colour = top.clear_colour_o;
		flight[2].clear_depth = top.clear_depth_o;
		top.write_en_i = flight[3].valid;
		if (flight[3].valid)
			write_row(flight[3]);
		top.end_i = !ends.empty() && ends.front().first <= clocks;
		if (top.end_i) {
			top.end_bank_i = ends.front().second;
			ends.pop_front();
			end_clocks.push_back(clocks);
		}
		top.read_en_i = false;
		if (drawing.empty() || hold(fragment_stall))
			return;
		if (drawing.front().kind == render_end) {
			ends.push_back({ clocks + 3, drawing.front().bank });
			drawing.pop_front();
			return;
		}
		start_row(drawing.front());
	}

	void start_row(const Op &op)
	{
		int row = (op.draw->first + drawn) % rows;

		/* Not within three clocks of itself. */
		for (int n = 1; n < 3; n++)
			if (flight[n].valid && flight[n].row == row && flight[n].bank == op.bank)
				return;
		flight[0].valid = true;
		flight[0].bank = op.bank;
		flight[0].row = row;
		flight[0].n = drawn;
		flight[0].draw = op.draw;
		top.read_en_i = true;
		top.read_bank_i = op.bank;
		top.read_row_i = row;
		if (++drawn == op.draw->count) {
			drawn = 0;
			drawing.pop_front();
		}
	}

	/* The row that was read three clocks ago is there: is it what it should be? Writes the new one. */
	void write_row(const Flight &row)
	{
		const Draw &draw = *row.draw;

		for (int l = 0; l < LANES; l++) {
			uint32_t colour = top.row_colour_fresh_o ? tb_get(top.row_colour_o, 32 * l, 32)
								 : row.clear_colour;
			uint32_t depth = top.row_depth_fresh_o ? tb_get(top.row_depth_o, 32 * l, 32)
							       : row.clear_depth;
			int at = row.n * LANES + l;

			TB_CHECK(colour == draw.old_colour[at], "row %d lane %d: colour %08x, not %08x", row.row, l,
				 colour, draw.old_colour[at]);
			TB_CHECK(depth == draw.old_depth[at], "row %d lane %d: depth %08x, not %08x", row.row, l,
				 depth, draw.old_depth[at]);
			tb_set(top.write_colour_i, 32 * l, 32, draw.colour[at]);
			tb_set(top.write_depth_i, 32 * l, 32, draw.depth[at]);
		}
		top.write_bank_i = row.bank;
		top.write_row_i = row.row;
	}

	void sample_answer()
	{
		if (!top.response_valid_o || !top.response_ready_i)
			return;
		TB_CHECK(top.response_count_o == LANES, "an answer of %d words", top.response_count_o);
		for (int l = 0; l < LANES; l++) {
			uint32_t word = tb_get(top.response_data_o, 32 * l, 32);

			TB_CHECK(!work.answers.empty(), "an answer too many");
			TB_CHECK(word == work.answers.front(), "answered %08x, not %08x", word,
				 work.answers.front());
			work.answers.pop_front();
		}
	}

	std::deque<Op> queue, drawing;
	std::deque<std::pair<uint64_t, bool>> ends;
	Flight flight[4];	/* read in this clock, in the one before, two before, three before */
	int drawn = 0;
	bool bank = true;
	bool offered_begin = false, offered_end = false, offered_op = false;
	Stall command_stall{ random }, queue_stall{ random }, raster_stall{ random }, fragment_stall{ random },
		response_stall{ random };
};

static void tiles_in_stream_order(TileBench &bench, int tiles)
{
	/* load, store, answer, places, odd pitch, idle, draws, longest */
	static const Wish often = { 50, 45, 30, 8, 0, 10, 6, rows };
	static const Wish same_place = { 80, 80, 10, 1, 0, 5, 3, 20 };
	static const Wish empty = { 10, 20, 10, 8, 0, 5, 0, 1 };
	static const Wish any_pitch = { 60, 80, 10, 4, 50, 5, 3, 20 };

	for (bool unkind : { false, true }) {
		bench.run(often, tiles, unkind);
		bench.run(same_place, tiles, unkind);
		bench.run(empty, 4 * tiles, unkind);
		bench.run(any_pitch, tiles, unkind);
	}
}

/* A load of one row that the tile before stores, its first or last, with the same and another pitch. */
static void loads_wait_for_the_one_row_in_common(TileBench &bench)
{
	bench.stalls = false;
	bench.memory.late(100);
	for (uint32_t pitch = 1; pitch <= 3; pitch++) {
		for (uint32_t other = pitch; other <= pitch + 1; other++) {
			Surface low = { 0, unit * pitch };
			Surface high = { low.pitch * (TILE - 1), unit * other };

			for (bool up : { false, true }) {
				bench.work.begin(bench.steps, false, false, { 1, 0 }, { 2, 0 });
				bench.work.draw(bench.steps, 0, rows);
				bench.work.end(bench.steps, GLOSS_TILE_OUTPUT_DROP, GLOSS_TILE_OUTPUT_STORE,
					       { 0, 0 }, up ? low : high);
				bench.work.begin(bench.steps, true, false, up ? high : low, { 3, 0 });
				bench.work.end(bench.steps, GLOSS_TILE_OUTPUT_ANSWER, GLOSS_TILE_OUTPUT_DROP,
					       { 0, 0 }, { 0, 0 });
			}
		}
	}
	bench.run();
}

/* More tiles than there are marks, in both banks, with rows of them written long ago. */
static void cleared_rows_show_no_former_tile(TileBench &bench)
{
	static const Wish drop = { 1, 1, 1, 4, 0, 1, 4, 30 };

	bench.run(drop, 1200, false);
}

/* Clocks per tile when each is drawn wholly by one draw, with memory that takes so long. */
static double clocks_per_tile(TileBench &bench, bool loads, bool stores, int latency)
{
	const int tiles = 48, skip = 8;

	bench.stalls = false;
	bench.memory.steady(latency);
	bench.end_clocks.clear();
	for (int n = 0; n < tiles; n++) {
		Surface place = bench.work.place(n % 8);

		bench.work.begin(bench.steps, loads, false, place, { 0, 0 });
		bench.work.draw(bench.steps, 0, rows);
		bench.work.end(bench.steps, stores ? GLOSS_TILE_OUTPUT_STORE : GLOSS_TILE_OUTPUT_DROP,
			       GLOSS_TILE_OUTPUT_DROP, place, { 0, 0 });
		bench.run_steps(8);
	}
	bench.run();
	return (double)(bench.end_clocks.back() - bench.end_clocks[skip]) / (tiles - 1 - skip);
}

static void memory_is_hidden_behind_drawing(TileBench &bench)
{
	double alone = clocks_per_tile(bench, false, false, 20);

	for (int latency : { 20, 40, 60 }) {
		double stored = clocks_per_tile(bench, false, true, latency);
		double both = clocks_per_tile(bench, true, true, latency);

		printf("  clocks of a tile drawn once: alone %.1f; memory of %d clocks: stored %.1f, loaded and stored %.1f\n",
		       alone, latency, stored, both);
		TB_CHECK(stored <= 1.05 * alone && both <= 1.05 * alone, "memory is not hidden");
	}
}

int main(int argc, char **argv)
{
	static TileBench bench(tb_seed());
	int tiles = argc > 1 ? atoi(argv[1]) : 40;

	tiles_in_stream_order(bench, tiles);
	loads_wait_for_the_one_row_in_common(bench);
	cleared_rows_show_no_former_tile(bench);
	memory_is_hidden_behind_drawing(bench);
	printf("tb_tile: T %d, K %d passed, %" PRIu64 " clocks\n", TILE, LANES, bench.clocks);
	return 0;
}
