/* SPDX-License-Identifier: MIT */
/*
 * Random work for the tile stage and what has to come of it: tiles are executed here one after the
 * other, as the order of the stream says, when they are made.
 */
#ifndef TESTS_TILE_WORK_H
#define TESTS_TILE_WORK_H

#include <cstring>
#include <deque>
#include <memory>
#include <vector>

#include "gloss_packets.h"
#include "tb.h"

static const int row_beats = TILE / LANES, rows = row_beats * TILE, pixels = TILE * TILE;
static const uint32_t unit = 4 * TILE; /* bytes of a tile's row */
static const uint32_t memory_units = 512;

/* Rows from @first on, around the end, and what they hold before and after. */
struct Draw {
	int first, count;
	std::vector<uint32_t> old_colour, old_depth, colour, depth;
};

struct Surface {
	uint32_t address, pitch; /* bytes */
};

/* What command does: hand over an op, or put one into the render queue, or wait. */
struct Step {
	enum { BEGIN, END, RENDER, IDLE } what;
	/* BEGIN, END */
	bool colour_load, depth_load;
	unsigned int colour_output, depth_output;
	Surface colour, depth; /* or the clear value as address */
	/* RENDER */
	unsigned int kind;
	uint32_t data;
	std::shared_ptr<Draw> draw; /* of an op that draws */
};

/* How a test wants its tiles. */
struct Wish {
	unsigned int load, store, answer; /* percent of colours and of depths */
	unsigned int places;              /* that are used, up to eight */
	unsigned int odd_pitch;           /* percent that are anywhere, with any pitch */
	unsigned int idle;                /* percent of tiles after which command waits */
	int draws, longest;               /* of a tile; rows of a draw */
};

class Work
{
      public:
	explicit Work(Random &random) : memory(memory_units * TILE), random(random)
	{
		for (uint32_t &word : memory)
			word = random.bits();
	}

	/* Appends a random tile's steps. */
	void tile(std::deque<Step> &steps, const Wish &wish)
	{
		bool colour_load = random.chance(wish.load), depth_load = random.chance(wish.load);

		begin(steps, colour_load, depth_load, colour_load ? place(wish) : clear(),
		      depth_load ? place(wish) : clear());
		for (int n = random.between(0, wish.draws); n > 0; n--)
			draw(steps, random.below(rows), random.between(1, wish.longest));
		end(steps, output(wish), output(wish), place(wish), place(wish));
		/* A state between tiles goes through the gate untouched. */
		render(steps, 3);
		if (random.chance(wish.idle))
			idle(steps);
	}

	void begin(std::deque<Step> &steps, bool colour_load, bool depth_load, Surface colour_from,
		   Surface depth_from)
	{
		Step step = {};

		step.what = Step::BEGIN;
		step.colour_load = colour_load;
		step.depth_load = depth_load;
		step.colour = colour_from;
		step.depth = depth_from;
		load(colour, colour_load, colour_from);
		load(depth, depth_load, depth_from);
		steps.push_back(step);
		render(steps, 5);
	}

	void draw(std::deque<Step> &steps, int first, int count)
	{
		auto draw = std::make_shared<Draw>();

		draw->first = first;
		draw->count = count;
		for (int n = 0; n < count; n++) {
			for (int l = 0; l < LANES; l++) {
				int at = (first + n) % rows * LANES + l;

				draw->old_colour.push_back(colour[at]);
				draw->old_depth.push_back(depth[at]);
				draw->colour.push_back(colour[at] = random.bits());
				draw->depth.push_back(depth[at] = random.bits());
			}
		}
		render(steps, 2);
		steps.back().draw = draw;
	}

	void end(std::deque<Step> &steps, unsigned int colour_output, unsigned int depth_output,
		 Surface colour_to, Surface depth_to)
	{
		Step step = {};

		step.what = Step::END;
		step.colour_output = colour_output;
		step.depth_output = depth_output;
		step.colour = colour_to;
		step.depth = depth_to;
		put(colour, colour_output, colour_to);
		put(depth, depth_output, depth_to);
		render(steps, 4);
		steps.push_back(step);
	}

	void idle(std::deque<Step> &steps)
	{
		Step step = {};

		step.what = Step::IDLE;
		steps.push_back(step);
	}

	/* One of the tiles side by side in a surface four tiles wide. */
	Surface place(uint32_t n) const
	{
		return { unit * (n % 4 + n / 4 * 4 * TILE), unit * 4 };
	}

	std::vector<uint32_t> memory;
	std::deque<uint32_t> answers;

      private:
	Surface clear()
	{
		return { random.bits(), random.bits() };
	}

	void render(std::deque<Step> &steps, unsigned int kind)
	{
		Step step = {};

		step.what = Step::RENDER;
		step.kind = kind;
		step.data = random.bits();
		steps.push_back(step);
	}

	unsigned int output(const Wish &wish)
	{
		unsigned int percent = random.below(100);

		if (percent < wish.store)
			return GLOSS_TILE_OUTPUT_STORE;
		return percent < wish.store + wish.answer ? GLOSS_TILE_OUTPUT_ANSWER :
							    GLOSS_TILE_OUTPUT_DROP;
	}

	Surface place(const Wish &wish)
	{
		if (random.chance(wish.odd_pitch)) {
			uint32_t pitch = random.between(1, 6);

			return { unit * random.below(memory_units - (TILE - 1) * pitch),
				 unit * pitch };
		}
		return place(random.below(wish.places));
	}

	void load(uint32_t *part, bool loads, const Surface &from)
	{
		for (int at = 0; at < pixels; at++) {
			uint32_t address = from.address + at / TILE * from.pitch + at % TILE * 4;

			part[at] = loads ? memory[address / 4] : from.address;
		}
	}

	void put(const uint32_t *part, unsigned int output, const Surface &to)
	{
		for (int at = 0; at < pixels; at++) {
			if (output == GLOSS_TILE_OUTPUT_STORE)
				memory[(to.address + at / TILE * to.pitch) / 4 + at % TILE] =
					part[at];
			else if (output == GLOSS_TILE_OUTPUT_ANSWER)
				answers.push_back(part[at]);
		}
	}

	Random &random;
	uint32_t colour[pixels], depth[pixels];
};

#endif
