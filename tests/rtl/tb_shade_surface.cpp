// SPDX-License-Identifier: MIT
/*
 * shade_surface: whatever way the row state takes, a block shows the polynomial of gloss.xml.
 * LANES is the parameter.
 */
#include <deque>

#include "Vshade_surface.h"
#include "tb.h"

enum Move { LOAD, DOWN, RIGHT, LEFT }; /* gloss_pkg::MOVE_* */

static const unsigned int latency = LANES == 1 ? 5 : LANES == 2 ? 7 : LANES == 4 ? 8 : 9;

struct Surface {
	uint32_t i, dx, dy, dxx, dxy, dyy;

	uint32_t level(int u, int v) const
	{
		uint32_t value = i + u * dx + (uint32_t)(u * (u - 1) / 2) * dxx + v * dy +
				 (uint32_t)(v * (v - 1) / 2) * dyy + (uint32_t)(u * v) * dxy;
		int32_t whole = (int32_t)value >> 22;

		return whole < 0 ? 0 : whole > 255 ? 255 : whole;
	}
};

/* Sends commands as raster_row may, and compares the blocks they start. */
class Channel {
public:
	explicit Channel(Random &random) : random(random) {}

	uint64_t blocks = 0;

	void triangle()
	{
		Surface next = surface_any();

		/* complete some clocks before it is taken, and gone two clocks after */
		offer(next);
		for (int n = random.between(2, 6); n > 0; n--)
			clock(0, 0, LOAD, false);
		surface = next;
		u = v = 0;
		clock(1, 1, LOAD, false);
		moves_left = random.between(2, 60);
		move();
		move();
		offer(surface_any());
		while (moves_left > 0)
			move();
	}

	void finish()
	{
		while (!expected.empty())
			clock(0, 0, LOAD, false);
	}

private:
	struct Block {
		uint64_t at; /* the clock its levels are out */
		Surface surface;
		int u, v;
	};

	Random &random;
	Bench<Vshade_surface> bench;
	Surface surface = {};
	int u = 0, v = 0; /* where the row state is, seen from the anchor */
	int moves_left = 0;
	Block run = {};	      /* the last block sent */
	int run_more = 0;     /* blocks of its run after it */
	std::deque<Block> expected;

	Surface surface_any()
	{
		Surface s;

		for (uint32_t *word : { &s.i, &s.dx, &s.dy, &s.dxx, &s.dxy, &s.dyy })
			*word = (uint32_t)((int32_t)random.bits() >> random.between(0, 20));
		return s;
	}

	void offer(const Surface &s)
	{
		const uint32_t words[] = { s.dyy, s.dxy, s.dxx, s.dy, s.dx, s.i };

		for (int n = 0; n < 6; n++)
			bench.top.surface_i[n] = words[n];
	}

	void move()
	{
		moves_left--;
		switch (random.below(5)) {
		case 0:
			clock(1, 1, RIGHT, false);
			u += LANES;
			break;
		case 1:
			clock(1, 0, LEFT, false);
			clock(0, 1, LEFT, false);
			u -= LANES;
			break;
		case 2:
			clock(0, 0, LOAD, false);
			break;
		default:
			clock(1, 1, DOWN, !run_more && random.chance(80));
			v++;
		}
	}

	void send(const Block &block)
	{
		run = block;
		run.at = bench.clocks + latency;
		expected.push_back(run);
	}

	void clock(int slopes, int values, Move move, bool start)
	{
		bool step = run_more > 0;

		bench.top.command_i = slopes << 5 | values << 4 | move << 2 | start << 1 | step;
		if (start) {
			send({ 0, surface, u, v });
			run_more = random.below(8);
		} else if (step) {
			send({ 0, run.surface, run.u + LANES, run.v });
			run_more--;
		}
		bench.settle();
		if (!expected.empty() && expected.front().at == bench.clocks)
			compare();
		bench.tick();
	}

	void compare()
	{
		const Block &block = expected.front();

		for (int l = 0; l < LANES; l++) {
			uint32_t is = tb_get(bench.top.level_o, 8 * l, 8);
			uint32_t should = block.surface.level(block.u + l, block.v);

			TB_CHECK(is == should, "lane %d: %u instead of %u at %d, %d", l, is, should,
				 block.u, block.v);
		}
		expected.pop_front();
		blocks++;
	}
};

int main()
{
	Random random(tb_seed());
	Channel channel(random);

	for (int n = 0; n < 3000; n++)
		channel.triangle();
	channel.finish();
	printf("shade_surface, %d lanes: %" PRIu64 " blocks show the polynomial\n", LANES,
	       channel.blocks);
	return 0;
}
