// SPDX-License-Identifier: MIT
/*
 * raster_shade against the model: random records, states and gaps, every block compared, the
 * promises of raster_shade.sv checked; and how many clocks triangles take. TILE, LANES and STREAM
 * are the parameters.
 */
#include <deque>

#include "Vraster_shade.h"
#include "raster_record.h"

enum Kind { HEADER, PAYLOAD, GO, STATE, END }; /* gloss_pkg::RENDER_* */
enum Part { EDGES, DEPTH, ALPHA, COLOUR, SMALL, SMALL_COLOUR, SMALL_ROWS, PART_NONE };
enum StatePart { STATE_DEPTH, STATE_MASK, STATE_SCISSOR, STATE_RESET };

static const unsigned int words_per_row = STREAM / 32;

struct Op {
	unsigned int kind, part, row, bank;
	bool go;
	uint32_t data[4];
};

/* What raster_shade has to answer: a block, or the end of a tile. */
struct Event {
	bool end;
	unsigned int x, y, mask, state, bank;
	uint32_t colour[LANES], depth[LANES];
};

/* Makes ops and what they have to lead to. */
class Source {
public:
	explicit Source(Random &random) : random(random) { state_reset(); }

	std::deque<Op> ops;
	std::deque<Event> events;

	void state_reset()
	{
		put(STATE, STATE_RESET, 0, random.bits());
		func = GLOSS_COMPARE_ALWAYS;
		write = 0;
		mask = 15;
		scissor = { 0, 0, TILE, TILE };
	}

	void state_random()
	{
		uint32_t word = random.bits();

		switch (random.below(4)) {
		case STATE_DEPTH:
			put(STATE, STATE_DEPTH, 0, word);
			func = word >> 11 & 7;
			write = word >> 14 & 1;
			break;
		case STATE_MASK:
			put(STATE, STATE_MASK, 0, word);
			mask = word >> 11 & 15;
			break;
		case STATE_SCISSOR:
			scissor_random();
			break;
		default:
			state_reset();
		}
	}

	void triangle(const Record &record)
	{
		triangle_rows(record, 99);
		go = true;
		expect(record);
	}

	/* What makes the last triangle go. */
	void finish() { put(STATE, STATE_DEPTH, 0, random.bits()); }

	/* A triangle that turned out to be faulty after some rows. */
	void abandoned(const Record &record) { triangle_rows(record, random.below(10)); }

	void tile_end()
	{
		Event event = {};

		put(END, random.below(8), 0, random.bits());
		event.end = true;
		event.bank = bank;
		events.push_back(event);
		bank ^= 1;
	}

private:
	Random &random;
	unsigned int bank = 0, func, write, mask;
	bool go = false; /* a triangle is whole */
	model_scissor scissor;

	void put(unsigned int kind, unsigned int part, unsigned int row, uint32_t word)
	{
		Op op = {
			kind, part, row, bank, go, { word, random.bits(), random.bits(), random.bits() }
		};

		go = false;
		ops.push_back(op);
	}

	void scissor_random()
	{
		struct gloss_scissor s = {};
		uint32_t words[2];

		s.x0 = random.below(TILE + 1), s.x1 = random.below(TILE + 1);
		s.y0 = random.below(TILE + 1), s.y1 = random.below(TILE + 1);
		if (s.x0 > s.x1 && random.chance(80))
			std::swap(s.x0, s.x1);
		if (s.y0 > s.y1 && random.chance(80))
			std::swap(s.y0, s.y1);
		gloss_scissor_pack(words, &s);
		put(STATE, STATE_SCISSOR, 0, words[1]);
		scissor = { (int)s.x0, (int)s.y0, (int)s.x1, (int)s.y1 };
	}

	void triangle_rows(const Record &record, unsigned int limit)
	{
		if (!record.header.empty())
			put(HEADER, PART_NONE, 0, record.header[0]);
		for (unsigned int part = 0; part < PART_NONE; part++) {
			const std::vector<uint32_t> &words = record.part[part];

			for (unsigned int at = 0; at < words.size() && limit;
			     at += words_per_row, limit--) {
				put(part == SMALL && !at ? HEADER : PAYLOAD, part,
				    at / words_per_row, 0);
				for (unsigned int n = 0; n < words_per_row && at + n < words.size();
				     n++)
					ops.back().data[n] = words[at + n];
			}
		}
	}

	void expect(const Record &record)
	{
		std::vector<uint32_t> packet = record.packet();
		model_triangle triangle;
		model_walk walk;
		model_span span;

		if (record.header.empty())
			model_triangle_small_unpack(packet.data(), &triangle);
		else
			model_triangle_unpack(packet.data(), TILE, &triangle);
		model_raster_begin(&walk, &triangle);
		while (model_raster_next(&walk, &scissor, &span))
			expect_row(triangle, span);
	}

	void expect_row(const model_triangle &triangle, const model_span &span)
	{
		uint32_t colour[TILE + MODEL_LANES], depth[TILE + MODEL_LANES];

		model_shade_span(&triangle, model_raster_anchor(&triangle, TILE), &span, colour,
				 depth);
		for (int block = span.x0 / LANES; block * LANES < span.x1; block++) {
			Event event = {};

			event.x = block;
			event.y = span.y;
			event.state = bank << 8 | mask << 4 | write << 3 | func;
			for (int l = 0; l < LANES; l++) {
				int x = block * LANES + l;

				if (x < span.x0 || x >= span.x1)
					continue;
				event.mask |= 1u << l;
				event.colour[l] = colour[x - span.x0];
				event.depth[l] = depth[x - span.x0];
			}
			events.push_back(event);
		}
	}
};

/* Drives the ops in and compares what comes out, clock by clock. */
class Run {
public:
	explicit Run(Random &random) : random(random), stall(random) {}

	Bench<Vraster_shade> bench;
	uint64_t blocks = 0, pixels = 0;

	void drain(Source &source, bool stalls)
	{
		uint64_t last = bench.clocks;

		while (!source.ops.empty() || !source.events.empty()) {
			size_t left = source.ops.size() + source.events.size();

			clock(source, stalls);
			if (source.ops.size() + source.events.size() != left)
				last = bench.clocks;
			TB_CHECK(bench.clocks - last < 1000,
				 "nothing happens: %zu ops, %zu events left", source.ops.size(),
				 source.events.size());
		}
	}

	/* Nothing may come any more, and it has to say so. */
	void rest(Source &source)
	{
		for (int n = 0; n < 100; n++)
			clock(source, false);
		TB_CHECK(bench.top.idle_o, "not idle at the end");
		TB_CHECK(!bench.top.stall_raster_o, "a record waits at the end");
	}

private:
	Random &random;
	Stall stall;
	bool held = false;
	int blocks_before[2] = { -1, -1 }; /* in the two clocks before, or -1 */

	void clock(Source &source, bool stalls)
	{
		Vraster_shade &top = bench.top;

		/* once offered, an op stays until it is taken */
		held = !source.ops.empty() && (held || !stalls || !stall.now());
		top.valid_i = held;
		drive(held ? source.ops.front() : noise());
		bench.settle();
		TB_CHECK(!held || !top.idle_o || top.ready_o, "idle but not ready");
		if (top.valid_i && top.ready_o) {
			source.ops.pop_front();
			held = false;
		}
		int place = sample(source);

		blocks_before[1] = blocks_before[0];
		blocks_before[0] = place;
		bench.tick();
	}

	Op noise()
	{
		return { random.below(8),
			 random.below(8),
			 random.below(32),
			 random.below(2),
			 random.chance(50),
			 { random.bits(), random.bits(), random.bits(), random.bits() } };
	}

	void drive(const Op &op)
	{
		bench.top.op_i = op.go << 11 | op.kind << 8 | op.part << 5 | op.row;
		bench.top.bank_i = op.bank;
		for (unsigned int n = 0; n < words_per_row; n++)
			tb_set(bench.top.data_i, 32 * n, 32, op.data[n]);
	}

	/* The block that is there, as a number, or -1. */
	int sample(Source &source)
	{
		Vraster_shade &top = bench.top;

		TB_CHECK(!top.block_valid_o || !top.end_o, "a block and a tile's end at once");
		if (!top.block_valid_o && !top.end_o)
			return -1;
		TB_CHECK(!source.events.empty(), "more blocks than there should be");
		Event event = source.events.front();

		source.events.pop_front();
		TB_CHECK(event.end == (bool)top.end_o,
			 event.end ? "a block after the last" : "the tile's end too early");
		if (event.end) {
			TB_CHECK(top.end_bank_o == event.bank, "the end of bank %d",
				 top.end_bank_o);
			return -1;
		}
		return block(event);
	}

	int block(const Event &event)
	{
		Vraster_shade &top = bench.top;
		int place = event.y * TILE + event.x;

		TB_CHECK(top.block_x_o == event.x && top.block_y_o == event.y,
			 "block %d, %d instead of %u, %u", top.block_x_o, top.block_y_o, event.x,
			 event.y);
		TB_CHECK(top.block_mask_o != 0, "an empty block");
		TB_CHECK(top.block_mask_o == event.mask, "mask %02x instead of %02x at %u, %u",
			 top.block_mask_o, event.mask, event.x, event.y);
		TB_CHECK(top.block_state_o == event.state, "state %03x instead of %03x",
			 top.block_state_o, event.state);
		for (unsigned int l = 0; l < LANES; l++) {
			uint32_t colour = tb_get(top.block_colour_o, 32 * l, 32);
			uint32_t depth = tb_get(top.block_depth_o, 24 * l, 24);

			if (!(event.mask >> l & 1))
				continue;
			TB_CHECK(colour == event.colour[l], "colour %08x instead of %08x at %u, %u",
				 colour, event.colour[l], event.x * LANES + l, event.y);
			TB_CHECK(depth == event.depth[l], "depth %06x instead of %06x at %u, %u",
				 depth, event.depth[l], event.x * LANES + l, event.y);
			pixels++;
		}
		for (int before : blocks_before)
			TB_CHECK(place != before, "block %u, %u twice within three clocks",
				 event.x, event.y);
		blocks++;
		return place;
	}
};

static void random_records_match_the_model(Random &random, int tiles)
{
	Source source(random);
	Run run(random);
	int triangles = 0;

	for (int tile = 0; tile < tiles; tile++) {
		for (int n = random.below(30); n > 0; n--, triangles++) {
			if (random.chance(20))
				source.state_random();
			if (random.chance(3))
				source.abandoned(record_random(random, TILE));
			source.triangle(record_random(random, TILE));
		}
		source.tile_end();
		/* mostly the next tile's records come while this one is drawn */
		if (random.chance(20))
			run.drain(source, true);
	}
	run.drain(source, true);
	run.rest(source);
	printf("%d-%d-%d: %d triangles, %" PRIu64 " blocks, %" PRIu64
	       " pixels as the model has them\n",
	       TILE, LANES, STREAM, triangles, run.blocks, run.pixels);
}

/* Clocks a triangle takes, back to back, wherever in the tile it lies. */
static double clocks_of(Random &random, Point a, Point b, Point c, double *pixels)
{
	static const int count = 400;
	Source source(random);
	Run run(random);

	for (int n = 0; n < count; n++) {
		int dx = 16 * random.below(TILE - 31), dy = 16 * random.below(TILE - 31);
		Point p[3] = { { a.x + dx, a.y + dy },
			       { b.x + dx, b.y + dy },
			       { c.x + dx, c.y + dy } };
		model_triangle t = {};
		Record record;

		triangle_between(p, TILE, t);
		do
			record = record_make(random, t, GLOSS_GEOMETRY_COMPACT,
					     GLOSS_SHADING_SECOND_ORDER);
		while (!record.part[ALPHA].empty());
		source.triangle(record);
	}
	source.finish();
	run.drain(source, false);
	*pixels = (double)run.pixels / count;
	return (double)run.bench.clocks / count;
}

/* The same of small records of @rows rows of one block each, and @shading. */
static double clocks_of_small(Random &random, unsigned int rows, enum gloss_shading shading)
{
	static const int count = 400;
	Source source(random);
	Run run(random);

	for (int n = 0; n < count; n++) {
		Record record = record_small_make(random, random.below(TILE - rows + 1), rows,
						  shading);
		struct gloss_pixels_small pixels;

		gloss_pixels_small_unpack(&record.part[SMALL][1], &pixels);
		pixels.x = 8 * random.below(TILE / 8);
		pixels.first_0 = pixels.first_1 = 3;
		pixels.last_0 = pixels.last_1 = 3;
		gloss_pixels_small_pack(&record.part[SMALL][1], &pixels);
		for (uint32_t &word : record.part[SMALL_ROWS])
			word = 0x33333333;
		source.triangle(record);
	}
	source.finish();
	run.drain(source, false);
	return (double)run.bench.clocks / count;
}

static double clocks_of_covering(Random &random)
{
	static const int count = 20;
	Source source(random);
	Run run(random);

	for (int n = 0; n < count; n++)
		source.triangle(record_make(random, {}, GLOSS_GEOMETRY_COVERING,
					    GLOSS_SHADING_SECOND_ORDER));
	source.finish();
	run.drain(source, false);
	return (double)run.bench.clocks / count;
}

static void triangles_take_few_clocks(Random &random)
{
	static const struct {
		const char *name;
		Point a, b, c;
		double most; /* clocks, with 8 lanes and 128 stream bits */
	} cases[] = {
		{ "1 pixel", { 4, 4 }, { 14, 4 }, { 4, 14 }, 12.1 },
		{ "8x8 box, upright left edge", { 0, 0 }, { 0, 128 }, { 128, 128 }, 20 },
		{ "8x8 box, upright right edge", { 128, 0 }, { 0, 128 }, { 128, 128 }, 20 },
		{ "32x32 box, upright left edge", { 0, 0 }, { 0, 512 }, { 512, 512 }, 200 },
		{ "32x32 box, upright right edge", { 512, 0 }, { 0, 512 }, { 512, 512 }, 200 },
	};

	for (const auto &c : cases) {
		double pixels, clocks = clocks_of(random, c.a, c.b, c.c, &pixels);

		printf("%d-%d-%d: %.1f clocks for %.0f pixels, %s\n", TILE, LANES, STREAM, clocks,
		       pixels, c.name);
		TB_CHECK(LANES < 8 || STREAM < 128 || clocks <= c.most, "more than %.1f clocks",
			 c.most);
	}

	static const struct {
		unsigned int rows;
		enum gloss_shading shading;
		double most;
	} small[] = {
		{ 1, GLOSS_SHADING_FLAT, 4.2 },
		{ 1, GLOSS_SHADING_LINEAR, 4.2 },
		{ 1, GLOSS_SHADING_SECOND_ORDER, 5.1 },
		{ 2, GLOSS_SHADING_LINEAR, 5.1 },
		{ 2, GLOSS_SHADING_SECOND_ORDER, 5.6 },
		{ 8, GLOSS_SHADING_SECOND_ORDER, 9.2 },
	};

	for (const auto &c : small) {
		double clocks = clocks_of_small(random, c.rows, c.shading);

		printf("%d-%d-%d: %.2f clocks for a small record of %u rows, shading %d\n", TILE,
		       LANES, STREAM, clocks, c.rows, c.shading);
		TB_CHECK(LANES < 8 || STREAM < 128 || clocks <= c.most, "more than %.1f clocks",
			 c.most);
	}

	double rate = TILE * TILE / clocks_of_covering(random);

	printf("%d-%d-%d: %.3f pixels a clock on covering triangles\n", TILE, LANES, STREAM, rate);
	TB_CHECK(rate >= 0.95 * LANES, "less than 0.95 of %d", LANES);
}

int main(int argc, char **argv)
{
	int tiles = argc > 1 ? atoi(argv[1]) : 40;
	Random random(tb_seed());

	random_records_match_the_model(random, tiles);
	triangles_take_few_clocks(random);
	return 0;
}
