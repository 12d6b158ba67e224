// SPDX-License-Identifier: MIT
/*
 * fragment against the model: random blocks of random state go in at the distances raster keeps, the
 * bench holds the two banks as tile does. LANES and TILE are the module's parameters.
 */
#include "Vfragment.h"
extern "C" {
#include "model/model.h"
}
#include "tb.h"

static const int blocks_x = TILE / LANES, rows = blocks_x * TILE;

struct Block {
	int x, y;
	unsigned int mask;
	uint32_t colour[LANES], depth[LANES];
	bool bank;
	unsigned int func, colour_mask;
	bool depth_write;
};

/* A tile as tile_buffer holds it: rows that are not fresh hold anything. */
struct Bank {
	uint32_t colour[rows][LANES], depth[rows][LANES];
	bool colour_fresh[rows], depth_fresh[rows];
	uint32_t clear_colour, clear_depth;
	struct model model;
};

class FragmentBench : public Bench<Vfragment> {
public:
	explicit FragmentBench(uint64_t seed) : random(seed) {}

	/* A new tile: part of it is as if it had been loaded. */
	void begin(int b)
	{
		Bank &bank = banks[b];

		bank.clear_colour = random.bits();
		bank.clear_depth = some_depth() | random.bits() << 24;
		bank.model.tile_size = TILE;
		bank.model.counters = {};
		for (int row = 0; row < rows; row++) {
			bank.colour_fresh[row] = random.chance(30);
			bank.depth_fresh[row] = random.chance(30);
			for (int l = 0; l < LANES; l++) {
				bank.colour[row][l] = random.bits();
				bank.depth[row][l] = some_depth() | random.bits() << 24;
				bank.model.tile.colour[row * LANES + l] =
					bank.colour_fresh[row] ? bank.colour[row][l] : bank.clear_colour;
				bank.model.tile.depth[row * LANES + l] =
					bank.depth_fresh[row] ? bank.depth[row][l] : bank.clear_depth;
			}
		}
	}

	/* Few different depths, so that all outcomes of the test are common. */
	uint32_t some_depth()
	{
		static const uint32_t few[] = { 0, 1, 0x7fffff, 0x800000, 0xfffffe, 0xffffff };

		return random.chance(80) ? few[random.below(6)] : random.bits() >> 8;
	}

	Block some_block(int b)
	{
		Block block;

		block.x = random.below(blocks_x);
		block.y = random.below(TILE);
		block.mask = random.chance(30) ? (1u << LANES) - 1 : random.between(1, (1 << LANES) - 1);
		for (int l = 0; l < LANES; l++) {
			block.colour[l] = random.bits();
			block.depth[l] = some_depth();
		}
		block.bank = b;
		block.func = random.below(8);
		block.colour_mask = random.chance(50) ? 15 : random.below(16);
		block.depth_write = random.chance(70);
		return block;
	}

	/* What the block does, by the model: a span for each pixel of the mask. */
	void expect(const Block &block)
	{
		struct model &model = banks[block.bank].model;
		uint32_t covered = model.counters.covered, passed = model.counters.passed;

		model.state.depth_func = (enum gloss_compare)block.func;
		model.state.depth_write = block.depth_write;
		model.state.colour_mask = 0;
		for (int c = 0; c < 4; c++)
			model.state.colour_mask |= block.colour_mask >> c & 1 ? 0xffu << 8 * c : 0;
		for (int l = 0; l < LANES; l++) {
			int x = block.x * LANES + l;
			struct model_span span = { block.y, x, x + 1 };

			if (block.mask >> l & 1)
				model_fragment_span(&model, &span, &block.colour[l], &block.depth[l]);
		}
		counted_covered += model.counters.covered - covered;
		counted_passed += model.counters.passed - passed;
	}

	/* One clock with a block, the end of a tile, or neither; plays tile. */
	void clock(const Block *block, bool end, bool end_bank)
	{
		top.block_valid_i = block != nullptr;
		top.end_i = end;
		top.end_bank_i = end_bank;
		if (block)
			drive(*block);
		settle();
		TB_CHECK(top.read_en_o == (block != nullptr), "a block is not read at once");
		/* After the write: what is read in the clock of its write is what is written. */
		write();
		Row read = top.read_en_o ? this->read() : Row();
		if (top.end_o) {
			TB_CHECK(ended >= 0 && ended == top.end_bank_o, "end of a tile that has not ended");
			ended = -1;
		}
		if (end)
			ended = end_bank;
		tick();
		answer(read);
	}

	/* Until the end of a bank has come out: then all of it is written and counted. */
	void end(int b)
	{
		clock(nullptr, true, b);
		for (int n = 0; ended >= 0; n++) {
			TB_CHECK(n < 20, "the end of a tile was lost");
			clock(nullptr, false, false);
		}
		check(b);
	}

	void check(int b)
	{
		Bank &bank = banks[b];

		for (int row = 0; row < rows; row++) {
			for (int l = 0; l < LANES; l++) {
				uint32_t colour = bank.colour_fresh[row] ? bank.colour[row][l] : bank.clear_colour;
				uint32_t depth = bank.depth_fresh[row] ? bank.depth[row][l] : bank.clear_depth;
				int at = row * LANES + l;

				TB_CHECK(colour == bank.model.tile.colour[at], "bank %d pixel %d: colour %08x, model %08x",
					 b, at, colour, bank.model.tile.colour[at]);
				TB_CHECK(depth == bank.model.tile.depth[at], "bank %d pixel %d: depth %08x, model %08x",
					 b, at, depth, bank.model.tile.depth[at]);
			}
		}
		TB_CHECK(top.covered_o == counted_covered, "%u covered, model %u", top.covered_o, counted_covered);
		TB_CHECK(top.passed_o == counted_passed, "%u passed, model %u", top.passed_o, counted_passed);
	}

	Random random;
	Bank banks[2];
	uint32_t counted_covered = 0, counted_passed = 0;

private:
	/* A row on its way from the bank to fragment; without a read, anything. */
	struct Row {
		bool valid = false;
		uint32_t clear_colour, clear_depth;
		uint32_t colour[LANES], depth[LANES];
		bool colour_fresh, depth_fresh;
	};

	void drive(const Block &block)
	{
		top.block_x_i = block.x;
		top.block_y_i = block.y;
		top.block_mask_i = block.mask;
		for (int l = 0; l < LANES; l++) {
			tb_set(top.block_colour_i, 32 * l, 32, block.colour[l]);
			tb_set(top.block_depth_i, 24 * l, 24, block.depth[l]);
		}
		top.block_state_i = block.bank << 8 | block.colour_mask << 4 | block.depth_write << 3 | block.func;
	}

	Row read() const
	{
		const Bank &bank = banks[top.read_bank_o];
		Row row;

		row.valid = true;
		row.clear_colour = bank.clear_colour;
		row.clear_depth = bank.clear_depth;
		for (int l = 0; l < LANES; l++) {
			row.colour[l] = bank.colour[top.read_row_o][l];
			row.depth[l] = bank.depth[top.read_row_o][l];
		}
		row.colour_fresh = bank.colour_fresh[top.read_row_o];
		row.depth_fresh = bank.depth_fresh[top.read_row_o];
		return row;
	}

	void write()
	{
		if (!top.write_en_o)
			return;
		Bank &bank = banks[top.write_bank_o];

		for (int l = 0; l < LANES; l++) {
			bank.colour[top.write_row_o][l] = tb_get(top.write_colour_o, 32 * l, 32);
			bank.depth[top.write_row_o][l] = tb_get(top.write_depth_o, 32 * l, 32);
		}
		bank.colour_fresh[top.write_row_o] = true;
		bank.depth_fresh[top.write_row_o] = true;
	}

	/* Two clocks after a read its clear values are there, one later its row. */
	void answer(const Row &now)
	{
		top.clear_colour_i = last.valid ? last.clear_colour : random.bits();
		top.clear_depth_i = last.valid ? last.clear_depth : random.bits();
		for (int l = 0; l < LANES; l++) {
			tb_set(top.row_colour_i, 32 * l, 32, before.valid ? before.colour[l] : random.bits());
			tb_set(top.row_depth_i, 32 * l, 32, before.valid ? before.depth[l] : random.bits());
		}
		top.row_colour_fresh_i = before.valid ? before.colour_fresh : random.chance(50);
		top.row_depth_fresh_i = before.valid ? before.depth_fresh : random.chance(50);
		before = last;
		last = now;
	}

	Row last, before;	/* read one and two clocks ago */
	int ended = -1;
};

/* As raster: every clock a block, but none within three clocks of itself. */
static void blocks_as_the_model(FragmentBench &bench, int tiles, unsigned int percent)
{
	for (int tile = 0; tile < tiles; tile++) {
		int last[2] = { -1, -1 };

		bench.begin(tile % 2);
		for (int n = 0; n < 2 * rows; n++) {
			Block block = bench.some_block(tile % 2);
			int at = block.y * blocks_x + block.x;
			bool send = bench.random.chance(percent) && at != last[0] && at != last[1];

			if (send)
				bench.expect(block);
			bench.clock(send ? &block : nullptr, false, false);
			last[1] = last[0];
			last[0] = send ? at : -1;
		}
		bench.end(tile % 2);
	}
}

/* The nearest that raster may bring a block again. */
static void the_same_block_after_three_clocks(FragmentBench &bench)
{
	bench.begin(1);
	for (int n = 0; n < 500; n++) {
		Block block = bench.some_block(1);

		block.x = block.y = 3;
		bench.expect(block);
		bench.clock(&block, false, false);
		bench.clock(nullptr, false, false);
		bench.clock(nullptr, false, false);
	}
	bench.end(1);
}

/* A tile's blocks may follow the last one of the tile before at once. */
static void banks_do_not_mix(FragmentBench &bench)
{
	bench.begin(0);
	bench.begin(1);
	for (int n = 0; n < 1000; n++) {
		Block block = bench.some_block(n % 2);

		block.x = n % blocks_x;
		bench.expect(block);
		bench.clock(&block, false, false);
	}
	bench.end(0);
	bench.end(1);
}

static void counts_from_the_clear(FragmentBench &bench)
{
	bench.top.work_clear_i = 1;
	bench.clock(nullptr, false, false);
	bench.top.work_clear_i = 0;
	bench.counted_covered = bench.counted_passed = 0;
	TB_CHECK(bench.top.covered_o == 0 && bench.top.passed_o == 0, "counters are not cleared");
	blocks_as_the_model(bench, 1, 50);
}

int main(int argc, char **argv)
{
	static FragmentBench bench(tb_seed());
	int tiles = argc > 1 ? atoi(argv[1]) : 6;

	bench.top.work_clear_i = 1;
	bench.clock(nullptr, false, false);
	bench.top.work_clear_i = 0;
	blocks_as_the_model(bench, tiles, 100);
	blocks_as_the_model(bench, tiles, 40);
	the_same_block_after_three_clocks(bench);
	banks_do_not_mix(bench);
	counts_from_the_clear(bench);
	printf("tb_fragment: T %d, K %d passed, %" PRIu64 " clocks\n", TILE, LANES, bench.clocks);
	return 0;
}
