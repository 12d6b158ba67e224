// SPDX-License-Identifier: MIT
/*
 * Figures of the core in clocks, from the Verilated core with ports that never stall and a memory
 * of fixed latency: how many pixels a clock it draws, what a small triangle costs, and how much of
 * loading and storing tiles is seen. Each is the difference of two jobs, so that what a job begins
 * and ends with does not count.
 *
 * Prints "name value" lines; fails if a figure misses its aim.
 */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "sim/sim.h"

#define TILE 64
#define MEMORY (1u << 22)
#define WORDS (1u << 18)
#define LIMIT (1u << 26)
#define PITCH (4u * TILE * 16)
#define ARRAY(a) (sizeof(a) / sizeof(*(a)))

struct bench {
	const struct gloss_sim_ops *ops;
	struct gloss_sim *sim;
	uint32_t words[WORDS], count;
	bool missed;
};

static uint8_t memory[MEMORY];

/* ---- streams ---- */

static void emit(struct bench *b, const uint32_t *words, uint32_t count)
{
	memcpy(b->words + b->count, words, 4 * count);
	b->count += count;
}

/* Tile number @n of the colour surface, 16 to a row. */
static uint32_t tile_offset(unsigned int n)
{
	return n % 16 * 4 * TILE + n / 16 * TILE * PITCH;
}

static void tile_begin(struct bench *b, bool load, unsigned int n)
{
	struct gloss_tile_begin p = { .colour_load = load, .depth = 0xffffff };
	uint32_t words[1 + GLOSS_TILE_BEGIN_WORDS];

	p.colour = load ? tile_offset(n) : 0;
	gloss_tile_begin_pack(words, &p);
	emit(b, words, ARRAY(words));
}

static void tile_end(struct bench *b, bool store, unsigned int n)
{
	struct gloss_tile_end p = {
		.colour_output = store ? GLOSS_TILE_OUTPUT_STORE : GLOSS_TILE_OUTPUT_DROP,
		.colour = store ? tile_offset(n) : 0,
	};
	uint32_t words[1 + GLOSS_TILE_END_WORDS];

	gloss_tile_end_pack(words, &p);
	emit(b, words, ARRAY(words));
}

static void begin_stream(struct bench *b)
{
	struct gloss_colour_surface surface = { .slot = 0, .pitch = PITCH };
	struct gloss_depth_state state = { .func = GLOSS_COMPARE_LEQUAL, .write = true };
	uint32_t words[1 + GLOSS_COLOUR_SURFACE_WORDS];

	b->count = 0;
	gloss_colour_surface_pack(words, &surface);
	emit(b, words, ARRAY(words));
	gloss_depth_state_pack(words, &state);
	emit(b, words, 1);
}

/* Three second-order channels that stay in range over the tile. */
static void surfaces(struct bench *b)
{
	struct gloss_colour_second_order p = {
		.red = 20u << GLOSS_COLOUR_FRACTION,
		.red_dx = 3u << 20,
		.red_dy = 1u << 20,
		.red_dxx = 1u << 12,
		.red_dxy = 1u << 11,
		.red_dyy = 1u << 13,
		.green = 90u << GLOSS_COLOUR_FRACTION,
		.green_dx = 1u << 19,
		.green_dyy = 1u << 13,
		.blue = 200u << GLOSS_COLOUR_FRACTION,
		.blue_dy = -(1u << 21),
		.blue_dxy = 1u << 12,
	};
	uint32_t words[GLOSS_COLOUR_SECOND_ORDER_WORDS];

	gloss_colour_second_order_pack(words, &p);
	emit(b, words, ARRAY(words));
}

static void triangle_header(struct bench *b, enum gloss_geometry geometry)
{
	struct gloss_triangle p = { geometry, GLOSS_SHADING_SECOND_ORDER, false, 255 };
	uint32_t header;

	gloss_triangle_pack(&header, &p);
	emit(b, &header, 1);
}

/* A triangle over the whole tile, said so or by its edges. */
static void full_tile(struct bench *b, enum gloss_geometry geometry)
{
	struct gloss_edges_wide edges = {
		.left_dy = 1, .last_row = TILE - 1, .right_x = TILE, .right_dy = 1, .middle_dy = 1
	};
	struct gloss_depth_wide depth = { .z = 1000u << GLOSS_DEPTH_FRACTION };
	uint32_t words[GLOSS_EDGES_WIDE_WORDS + GLOSS_DEPTH_WIDE_WORDS], count = 0;

	triangle_header(b, geometry);
	if (geometry == GLOSS_GEOMETRY_WIDE) {
		gloss_edges_wide_pack(words, &edges);
		count = GLOSS_EDGES_WIDE_WORDS;
	}
	gloss_depth_wide_pack(words + count, &depth);
	emit(b, words, count + GLOSS_DEPTH_WIDE_WORDS);
	surfaces(b);
}

/* Where the @n-th triangle with legs of @side pixels lies in the tile. */
static unsigned int place_x(unsigned int side, unsigned int n)
{
	return n * 13 % (TILE - side + 1);
}

static unsigned int place_y(unsigned int side, unsigned int n)
{
	return n * 29 % (TILE - side + 1);
}

/*
 * Pixels of row @row of a right triangle with legs of @side pixels: @side * @side / 2 in all, 1 for
 * a side of 1. The hypotenuse goes a bit more than a pixel a row.
 */
static unsigned int row_pixels(unsigned int side, unsigned int row)
{
	return side == 1 ? 1 : row < side / 2 ? row : row + 1;
}

/* As the library sends it up to 16 pixels a side; rows without a pixel are left off. */
static void small_triangle(struct bench *b, unsigned int side, unsigned int n)
{
	unsigned int first = side > 1, rows = side - first, sent = rows < 2 ? 0 : (rows + 1) / 4;
	struct gloss_triangle_small p = { GLOSS_SHADING_SECOND_ORDER, (enum gloss_row_words)sent,
					  255 };
	struct gloss_pixels_small pixels = {
		.x = place_x(side, n),
		.first_row = place_y(side, n) + first,
		.last_row = rows - 1,
		.last_0 = row_pixels(side, first) - 1,
		.last_1 = row_pixels(side, first + 1) - 1,
	};
	struct gloss_depth_small depth = { .z = 1000 << 4 };
	struct gloss_colour_second_order_small colour = {
		.red = 20,
		.red_dx = 192,
		.red_dy = 64,
		.red_dxx = 4,
		.red_dxy = 2,
		.red_dyy = 8,
		.green = 90,
		.green_dx = 32,
		.green_dyy = 8,
		.blue = 200,
		.blue_dy = -128,
		.blue_dxy = 4,
	};
	uint32_t words[16] = { 0 };

	gloss_triangle_small_pack(words, &p);
	gloss_pixels_small_pack(words + 1, &pixels);
	gloss_depth_small_pack(words + 2, &depth);
	gloss_colour_second_order_small_pack(words + 4, &colour);
	for (unsigned int row = 2; row < rows; row++)
		words[11 + (row - 2) / 4] |= (row_pixels(side, first + row) - 1)
					     << 4 << 8 * ((row - 2) % 4);
	emit(b, words, 11 + sent);
}

/* The same of any size, and with its edges. */
static void compact_triangle(struct bench *b, unsigned int side, unsigned int n)
{
	unsigned int x = place_x(side, n), y = place_y(side, n);
	struct gloss_edges_compact edges = {
		.left_x = (int32_t)x,
		.left_dy = 16,
		.middle_dy = 16,
		.right_x = (int32_t)x + (side == 1),
		.right_step = 1,
		.right_r = 8 * side,
		.right_m = 16,
		.right_dy = 16 * side,
		.first_row = y,
		.last_row = side - 1,
	};
	struct gloss_depth_compact depth = { .z = 1000 << 6 };
	uint32_t words[GLOSS_EDGES_COMPACT_WORDS + GLOSS_DEPTH_COMPACT_WORDS];

	triangle_header(b, GLOSS_GEOMETRY_COMPACT);
	gloss_edges_compact_pack(words, &edges);
	gloss_depth_compact_pack(words + GLOSS_EDGES_COMPACT_WORDS, &depth);
	emit(b, words, ARRAY(words));
	surfaces(b);
}

/* ---- runs ---- */

static _Noreturn void die(const char *what)
{
	fprintf(stderr, "bench_core: %s\n", what);
	exit(1);
}

/* Runs the stream; *@covered, if not NULL, is the number of pixels it covered. */
static uint64_t run(struct bench *b, uint32_t *covered)
{
	uint32_t response[GLOSS_COUNTER_WORDS];
	struct accel_job job = {
		.stream = b->words,
		.response = response,
		.response_words = GLOSS_COUNTER_WORDS,
		.slot[0] = { 0, MEMORY, GLOSS_RIGHTS_READ_WRITE },
	};
	struct gloss_sim_clocks clocks;
	struct gloss_status status;

	gloss_counters_pack(b->words + b->count++);
	job.stream_words = b->count;
	if (b->ops->run(b->sim, &job, LIMIT, &status, &clocks))
		die("a job did not end");
	if (status.cause)
		die("a job had a fault");
	if (covered)
		*covered = response[1];
	return clocks.clocks;
}

/* A job of @count triangles in one tile. */
typedef void (*draw_fn)(struct bench *b, unsigned int arg, unsigned int n);

static uint64_t run_triangles(struct bench *b, draw_fn draw, unsigned int arg, unsigned int count,
			      uint32_t *covered)
{
	begin_stream(b);
	tile_begin(b, false, 0);
	for (unsigned int n = 0; n < count; n++)
		draw(b, arg, n);
	tile_end(b, false, 0);
	return run(b, covered);
}

struct rate {
	double clocks, pixels; /* a triangle */
};

static struct rate triangle_rate(struct bench *b, draw_fn draw, unsigned int arg,
				 unsigned int count)
{
	uint32_t few_pixels, many_pixels;
	uint64_t few = run_triangles(b, draw, arg, count, &few_pixels);
	uint64_t many = run_triangles(b, draw, arg, 3 * count, &many_pixels);

	return (struct rate){ (double)(many - few) / (2 * count),
			      (double)(many_pixels - few_pixels) / (2 * count) };
}

static void draw_full(struct bench *b, unsigned int geometry, unsigned int n)
{
	(void)n;
	full_tile(b, (enum gloss_geometry)geometry);
}

static void draw_one_layer(struct bench *b, unsigned int n)
{
	full_tile(b, GLOSS_GEOMETRY_COVERING);
	small_triangle(b, 8, n);
}

static void draw_triangles(struct bench *b, unsigned int n)
{
	for (unsigned int i = 0; i < 9; i++)
		compact_triangle(b, 32, 9 * n + i);
}

/* Clocks of a tile of just over 4,096 drawn pixels. */
static double tile_clocks(struct bench *b, void (*draw)(struct bench *b, unsigned int n),
			  bool transfer)
{
	const unsigned int few = 8, many = 40;
	uint64_t clocks[2];

	for (int i = 0; i < 2; i++) {
		begin_stream(b);
		for (unsigned int n = 0; n < (i ? many : few); n++) {
			tile_begin(b, transfer, n);
			draw(b, n);
			tile_end(b, transfer, n);
		}
		clocks[i] = run(b, NULL);
	}
	return (double)(clocks[1] - clocks[0]) / (many - few);
}

/* ---- figures ---- */

enum aim { AT_LEAST, AT_MOST, NO_AIM };

static void figure(struct bench *b, const char *name, double value, enum aim aim, double limit)
{
	bool missed = (aim == AT_LEAST && value < limit) || (aim == AT_MOST && value > limit);

	printf("%-34s %10.4g", name, value);
	if (aim != NO_AIM)
		printf("   # %s %g%s", aim == AT_LEAST ? "at least" : "at most", limit,
		       missed ? ": MISSED" : "");
	printf("\n");
	fflush(stdout);
	b->missed |= missed;
}

static void figure_full(struct bench *b)
{
	unsigned int k = b->ops->pixels_per_clock;
	struct rate covering = triangle_rate(b, draw_full, GLOSS_GEOMETRY_COVERING, 20);
	struct rate wide = triangle_rate(b, draw_full, GLOSS_GEOMETRY_WIDE, 20);
	double ppc = covering.pixels / covering.clocks, wide_ppc = wide.pixels / wide.clocks;
	char name[32];

	snprintf(name, sizeof(name), "core.ppc.full.k%u", k);
	figure(b, name, ppc < wide_ppc ? ppc : wide_ppc, AT_LEAST, 0.95 * k);
}

static void figure_transfer(struct bench *b)
{
	static const struct {
		const char *name;
		void (*draw)(struct bench *b, unsigned int n);
	} tiles[] = {
		{ "core.ratio.load_store", draw_one_layer },
		{ "core.ratio.load_store.tri_512px", draw_triangles },
	};
	char name[48];

	for (unsigned int n = 0; n < ARRAY(tiles); n++) {
		double with = tile_clocks(b, tiles[n].draw, true);
		double without = tile_clocks(b, tiles[n].draw, false);

		snprintf(name, sizeof(name), "%s.k%u", tiles[n].name, b->ops->pixels_per_clock);
		figure(b, name, with / without, AT_MOST, 1.05);
	}
}

static void figure_small(struct bench *b)
{
	static const struct {
		const char *name;
		draw_fn draw;
		unsigned int side, pixels;
		double limit;
	} sizes[] = {
		{ "core.clk.tri_1px", small_triangle, 1, 1, 5 },
		{ "core.clk.tri_32px", small_triangle, 8, 32, 10.5 },
		{ "core.clk.tri_512px", compact_triangle, 32, 512, 200 },
	};

	for (unsigned int n = 0; n < ARRAY(sizes); n++) {
		struct rate rate = triangle_rate(b, sizes[n].draw, sizes[n].side, 1000);

		if (rate.pixels != sizes[n].pixels)
			die("a small triangle has not the pixels it should");
		figure(b, sizes[n].name, rate.clocks, AT_MOST, sizes[n].limit);
	}
}

/* How fast the simulation is: full tiles for about a second. */
static void figure_simulation(struct bench *b)
{
	struct timespec start, end;
	uint64_t clocks = 0, pixels = 0;
	uint32_t covered;
	double seconds;

	clock_gettime(CLOCK_MONOTONIC, &start);
	do {
		clocks += run_triangles(b, draw_full, GLOSS_GEOMETRY_COVERING, 200, &covered);
		pixels += covered;
		clock_gettime(CLOCK_MONOTONIC, &end);
		seconds = (double)(end.tv_sec - start.tv_sec) +
			  1e-9 * (double)(end.tv_nsec - start.tv_nsec);
	} while (seconds < 1);
	figure(b, "sim.kclk_s", (double)clocks / seconds / 1e3, NO_AIM, 0);
	figure(b, "sim.mpix_s", (double)pixels / seconds / 1e6, NO_AIM, 0);
}

static void load_plugin(struct bench *b, const char *path)
{
	void *plugin = dlopen(path, RTLD_NOW | RTLD_LOCAL);

	if (!plugin)
		die(dlerror());
	b->ops = dlsym(plugin, GLOSS_SIM_SYMBOL);
	if (!b->ops || b->ops->abi != GLOSS_SIM_ABI || b->ops->tile_size != TILE)
		die("not a plugin for tiles of 64");
	b->sim = b->ops->create(memory, MEMORY);
	if (!b->sim)
		die("out of memory");
}

static void bench_plugin(struct bench *b, const char *path)
{
	load_plugin(b, path);
	figure_full(b);
	figure_transfer(b);
	if (b->ops->pixels_per_clock == 8) {
		figure_small(b);
		figure_simulation(b);
	}
	b->ops->destroy(b->sim);
}

int main(int argc, char **argv)
{
	static struct bench bench;

	if (argc < 2)
		die("usage: bench_core PLUGIN...");
	for (int n = 1; n < argc; n++)
		bench_plugin(&bench, argv[n]);
	return bench.missed;
}
