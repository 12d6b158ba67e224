// SPDX-License-Identifier: MIT
/* Lanes and closed forms draw what gloss.xml says a pixel at a time, bit for bit. */
#include "accel_test.h"
#include "reference.h"

struct draw_test {
	struct model model;
	struct model_tile tile;
	struct model_counters counters;
	uint64_t seed;
};

/* Any number of up to @bits bits, small ones as likely as large. */
static uint64_t spread(uint64_t *seed, int bits)
{
	uint64_t value = test_random(seed);

	value >>= 64 - 1 - test_below(seed, (uint32_t)bits);
	return test_below(seed, 2) ? value : 0 - value;
}

static struct model_edge random_edge(uint64_t *seed, int tile_size)
{
	bool wild = test_below(seed, 4) == 0;
	struct model_edge edge;

	edge.x = (int32_t)test_below(seed, wild ? 8192 : (uint32_t)tile_size + 16);
	edge.x -= wild ? 4096 : 8;
	edge.step = (int32_t)test_below(seed, wild ? 8192 : 9);
	edge.step -= wild ? 4096 : 4;
	edge.r = test_below(seed, 1 << 16);
	edge.m = test_below(seed, 1 << 16);
	edge.dy = test_below(seed, 4) ? test_below(seed, 1 << 16) : test_below(seed, 4);
	return edge;
}

/* Values near what is drawn, or any bits; second differences or none. */
static struct model_surface random_surface(uint64_t *seed)
{
	bool wild = test_below(seed, 3) == 0, flat = test_below(seed, 4) == 0;
	struct model_surface surface = { .i = test_below(seed, 256u << GLOSS_COLOUR_FRACTION) };

	if (wild)
		surface.i = (uint32_t)test_random(seed);
	if (flat)
		return surface;
	surface.dx = (uint32_t)spread(seed, wild ? 32 : 25);
	surface.dy = (uint32_t)spread(seed, wild ? 32 : 25);
	if (test_below(seed, 2))
		return surface;
	surface.dxx = (uint32_t)spread(seed, wild ? 32 : 19);
	surface.dxy = (uint32_t)spread(seed, wild ? 32 : 19);
	surface.dyy = (uint32_t)spread(seed, wild ? 32 : 19);
	return surface;
}

/* Bits above the 40 are set too: they have no meaning. */
static struct model_plane random_plane(uint64_t *seed)
{
	bool wild = test_below(seed, 3) == 0;
	struct model_plane plane;

	plane.z = (uint64_t)test_below(seed, 1 << 24) << GLOSS_DEPTH_FRACTION;
	if (wild)
		plane.z = test_random(seed);
	plane.dx = spread(seed, wild ? 40 : 30);
	plane.dy = spread(seed, wild ? 40 : 30);
	return plane;
}

static struct model_triangle random_triangle(uint64_t *seed, int tile_size)
{
	struct model_triangle t = { .side = (int)test_below(seed, 2) };

	t.left = random_edge(seed, tile_size);
	t.right = random_edge(seed, tile_size);
	t.middle = random_edge(seed, tile_size);
	t.first_row = (int)test_below(seed, (uint32_t)tile_size);
	t.last_row = (int)test_below(seed, (uint32_t)(tile_size - t.first_row));
	t.switch_row = (int)test_below(seed, 2) * (int)test_below(seed, 64);
	t.red = random_surface(seed);
	t.green = random_surface(seed);
	t.blue = random_surface(seed);
	t.alpha = random_surface(seed);
	t.depth = random_plane(seed);
	return t;
}

static void random_range(uint64_t *seed, int size, int *low, int *high)
{
	bool any = test_below(seed, 4) == 0;

	*low = any ? (int)test_below(seed, (uint32_t)size + 1) : 0;
	*high = any ? (int)test_below(seed, (uint32_t)size + 1) : size;
}

static void random_state(uint64_t *seed, int tile_size, struct model_state *state)
{
	static const uint32_t bytes[] = { 0xff, 0xff00, 0xff0000, 0xff000000 };

	state->depth_func = (enum gloss_compare)test_below(seed, 8);
	state->depth_write = test_below(seed, 4) != 0;
	state->colour_mask = 0;
	for (int n = 0; n < 4; n++)
		state->colour_mask |= test_below(seed, 4) ? bytes[n] : 0;
	random_range(seed, tile_size, &state->scissor.x0, &state->scissor.x1);
	random_range(seed, tile_size, &state->scissor.y0, &state->scissor.y1);
}

/* A third of the depths are 0, a third the farthest, so that each function has both answers. */
static void random_tile(struct draw_test *test)
{
	static const uint32_t depth[] = { 0, 0xffffff };
	int words = test->model.tile_size * test->model.tile_size;

	for (int n = 0; n < words; n++) {
		uint32_t kind = test_below(&test->seed, 3);

		test->tile.colour[n] = (uint32_t)test_random(&test->seed);
		test->tile.depth[n] = (uint32_t)test_random(&test->seed);
		if (kind < 2)
			test->tile.depth[n] = (test->tile.depth[n] & 0xff000000) | depth[kind];
	}
	memcpy(test->model.tile.colour, test->tile.colour, 4 * (size_t)words);
	memcpy(test->model.tile.depth, test->tile.depth, 4 * (size_t)words);
}

static void assert_same(const struct draw_test *test, int number)
{
	const struct model *model = &test->model;

	assert_int_equal(model->counters.covered, test->counters.covered);
	assert_int_equal(model->counters.passed, test->counters.passed);
	assert_int_equal(model->counters.triangles, test->counters.triangles);
	for (int n = 0; n < model->tile_size * model->tile_size; n++)
		if (model->tile.colour[n] != test->tile.colour[n] ||
		    model->tile.depth[n] != test->tile.depth[n])
			fail_msg("triangle %d, pixel (%d, %d): %08x %08x is not %08x %08x", number,
				 n % model->tile_size, n / model->tile_size, model->tile.colour[n],
				 model->tile.depth[n], test->tile.colour[n], test->tile.depth[n]);
}

static void draw_whole(struct model *model, const struct model_triangle *triangle)
{
	model_draw_triangle(model, triangle);
}

/* As the benches of raster, shade and fragment do it. */
static void draw_by_spans(struct model *model, const struct model_triangle *triangle)
{
	uint32_t colour[MODEL_TILE_MAX], depth[MODEL_TILE_MAX];
	int anchor = model_raster_anchor(triangle, model->tile_size);
	struct model_walk walk;
	struct model_span span;

	model_raster_begin(&walk, triangle);
	while (model_raster_next(&walk, &model->state.scissor, &span)) {
		model_shade_span(triangle, anchor, &span, colour, depth);
		model_fragment_span(model, &span, colour, depth);
	}
	model->counters.triangles++;
}

/* Triangles fall on each other, as in a tile; every so often the tile is filled anew. */
static void compare(void (*draw)(struct model *, const struct model_triangle *), int tile_size,
		    int triangles)
{
	static struct draw_test test;
	struct model_triangle triangle;

	memset(&test, 0, sizeof(test));
	test.seed = test_seed();
	assert_int_equal(model_init(&test.model, tile_size, NULL, 0), 0);
	for (int n = 0; n < triangles; n++) {
		if (n % 16 == 0)
			random_tile(&test);
		triangle = random_triangle(&test.seed, tile_size);
		random_state(&test.seed, tile_size, &test.model.state);
		draw(&test.model, &triangle);
		reference_draw(&triangle, tile_size, &test.model.state, &test.tile, &test.counters);
		assert_same(&test, n);
	}
	assert_true(test.counters.passed > (uint32_t)triangles);
	assert_true(test.counters.covered - test.counters.passed > (uint32_t)triangles);
}

static void draw_random_triangles_64(void **state)
{
	(void)state;
	compare(draw_whole, 64, 3000);
}

static void draw_random_triangles_32(void **state)
{
	(void)state;
	compare(draw_whole, 32, 6000);
}

static void draw_spans_one_by_one(void **state)
{
	(void)state;
	compare(draw_by_spans, 64, 2000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(draw_random_triangles_64),
		cmocka_unit_test(draw_random_triangles_32),
		cmocka_unit_test(draw_spans_one_by_one),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
