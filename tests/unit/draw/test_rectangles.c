/* SPDX-License-Identifier: MIT */
/*
 * Rectangles and clears under masks against a picture that is kept here, pixel by pixel: any order
 * of them on tiles of both sizes.
 */
#include "draw_fixture.h"

#define SIDE 150
#define PIXELS (SIDE * SIDE)

static uint32_t colour[PIXELS], depth[PIXELS]; /* as they are to be */
static uint32_t got[PIXELS];

static void open_on(struct fixture *f, const char *device)
{
	f->device = device_open(device, &f->messages);
	assert_int_equal(accel_target_new(f->device, SIDE, SIDE, &f->target), 0);
	assert_int_equal(accel_draw_new(f->device, &f->draw), 0);
	assert_int_equal(accel_state_new(&f->state), 0);
}

static void close_all(struct fixture *f)
{
	void *state = f;

	fixture_free(&state);
}

/* What a state says of a pixel. */
struct tests {
	struct accel_rectangle scissor;
	enum accel_compare func;
	bool write, mask[4];
};

static bool passes(enum accel_compare func, uint32_t a, uint32_t b)
{
	static const bool result[][3] = {
		/* less, equal, greater */
		[ACCEL_COMPARE_NEVER] = { false, false, false },
		[ACCEL_COMPARE_LESS] = { true, false, false },
		[ACCEL_COMPARE_EQUAL] = { false, true, false },
		[ACCEL_COMPARE_LEQUAL] = { true, true, false },
		[ACCEL_COMPARE_GREATER] = { false, false, true },
		[ACCEL_COMPARE_NOTEQUAL] = { true, false, true },
		[ACCEL_COMPARE_GEQUAL] = { false, true, true },
		[ACCEL_COMPARE_ALWAYS] = { true, true, true },
	};

	return result[func][a < b ? 0 : a == b ? 1 : 2];
}

static bool inside(const struct accel_rectangle *box, int x, int y)
{
	return box->width < 0 ||
	       (x >= box->x && y >= box->y && x - box->x < box->width && y - box->y < box->height);
}

static void fill(const struct tests *tests, const struct accel_rectangle *box, uint32_t rgba,
		 uint32_t z)
{
	uint32_t mask = 0;

	for (int i = 0; i < 4; i++)
		mask |= tests->mask[i] ? 0xffu << 8 * i : 0;
	for (int i = 0; i < PIXELS; i++) {
		if (!inside(&tests->scissor, i % SIDE, i / SIDE) ||
		    !inside(box, i % SIDE, i / SIDE) || !passes(tests->func, z, depth[i]))
			continue;
		colour[i] = (colour[i] & ~mask) | (rgba & mask);
		depth[i] = tests->write ? z : depth[i];
	}
}

static struct accel_rectangle random_box(uint64_t *seed)
{
	const int size = (int)test_below(seed, 2 * SIDE) - 10;

	return (struct accel_rectangle){ (int)test_below(seed, SIDE + 40) - 20,
					 (int)test_below(seed, SIDE + 40) - 20, size,
					 (int)test_below(seed, SIDE + 10) };
}

static struct tests random_tests(uint64_t *seed, struct accel_state *state)
{
	struct tests tests = { { 0, 0, -1, -1 },
			       (enum accel_compare)test_below(seed, ACCEL_COMPARE_ALWAYS + 1),
			       test_below(seed, 2),
			       { true, true, true, true } };

	if (test_below(seed, 2))
		tests.scissor = random_box(seed);
	for (int i = 0; i < 4; i++)
		tests.mask[i] = test_below(seed, 4) != 0;
	accel_state_set_scissor(state, tests.scissor.x, tests.scissor.y, tests.scissor.width,
				tests.scissor.height);
	accel_state_set_depth(state, tests.func, tests.write);
	accel_state_set_colour_mask(state, tests.mask[0], tests.mask[1], tests.mask[2],
				    tests.mask[3]);
	return tests;
}

static uint32_t random_rgba(uint64_t *seed, float rgba[4])
{
	const uint32_t word = (uint32_t)test_random(seed);

	for (int i = 0; i < 4; i++)
		rgba[i] = (float)(word >> 8 * i & 0xff) / 255;
	return word;
}

static void rectangles(struct fixture *f, uint64_t *seed)
{
	const struct tests tests = random_tests(seed, f->state);
	struct accel_fill fills[3];

	for (int i = 0; i < 3; i++) {
		struct accel_rectangle *box = &fills[i].pixels;
		const uint32_t z = test_below(seed, 4), rgba = random_rgba(seed, fills[i].rgba);

		*box = random_box(seed);
		/* A negative size has no pixels; the picture takes it for none at all. */
		box->width = box->width < 0 ? 0 : box->width;
		fills[i].depth = (float)z / 0xffffff;
		fill(&tests, box, rgba, z);
	}
	assert_int_equal(accel_draw_rectangles(f->draw, f->state, fills, 3), 0);
}

static void clear(struct fixture *f, uint64_t *seed, bool masked)
{
	static const struct accel_rectangle all = { 0, 0, SIDE, SIDE };
	struct tests tests = random_tests(seed, f->state);
	struct accel_clear clear = ACCEL_CLEAR(.mask = 1 + test_below(seed, 3));
	const uint32_t z = test_below(seed, 4), rgba = random_rgba(seed, clear.rgba);

	clear.depth = (float)z / 0xffffff;
	if (!masked)
		tests = (struct tests){
			all, ACCEL_COMPARE_ALWAYS, true, { true, true, true, true }
		};
	tests.func = ACCEL_COMPARE_ALWAYS;
	tests.write = clear.mask & ACCEL_CLEAR_DEPTH;
	for (int i = 0; i < 4; i++)
		tests.mask[i] = tests.mask[i] && clear.mask & ACCEL_CLEAR_COLOUR;
	fill(&tests, &all, rgba, z);
	if (masked)
		assert_int_equal(accel_draw_clear_masked(f->draw, f->state, &clear), 0);
	else
		assert_int_equal(accel_draw_clear(f->draw, &clear), 0);
}

static void assert_planes(struct fixture *f)
{
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, got, SIDE * 4), 0);
	assert_memory_equal(got, colour, sizeof(got));
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_DEPTH, NULL, got, SIDE * 4), 0);
	assert_memory_equal(got, depth, sizeof(got));
}

static void rectangles_and_clears_draw_each_pixel_that_the_state_lets_them(void **unused)
{
	static const char *const devices[] = { "model:tile=32", "model:tile=64" };
	uint64_t seed = test_seed();
	struct fixture f;

	(void)unused;
	for (size_t n = 0; n < sizeof(devices) / sizeof(devices[0]); n++) {
		open_on(&f, devices[n]);
		memset(colour, 0, sizeof(colour));
		memset(depth, 0, sizeof(depth));
		for (int frame = 0; frame < 60; frame++) {
			assert_int_equal(accel_draw_begin(f.draw, f.target, NULL), 0);
			for (uint32_t i = test_below(&seed, 8); i; i--) {
				const uint32_t kind = test_below(&seed, 6);

				if (kind < 3)
					rectangles(&f, &seed);
				else
					clear(&f, &seed, kind < 5);
			}
			assert_int_equal(accel_draw_finish(f.draw), 0);
			assert_planes(&f);
		}
		close_all(&f);
	}
}

static void a_masked_clear_of_everything_costs_no_record(void **unused)
{
	const struct accel_clear all = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH);
	struct accel_draw_stats stats;
	struct fixture f;

	(void)unused;
	open_on(&f, "model:");
	accel_state_set_scissor(f.state, -5, 0, SIDE + 10, SIDE);
	assert_int_equal(accel_draw_begin(f.draw, f.target, NULL), 0);
	assert_int_equal(accel_draw_clear_masked(f.draw, f.state, &all), 0);
	assert_int_equal(accel_draw_finish(f.draw), 0);
	accel_draw_stats(f.draw, &stats, sizeof(stats));
	assert_int_equal(stats.records, 0);
	close_all(&f);
}

static void a_rectangle_that_is_wrong_draws_nothing_of_the_others(void **unused)
{
	const struct accel_fill fills[2] = { { { 0, 0, 9, 9 }, { 1, 1, 1, 1 }, 0 },
					     { { 0, 0, 9, 9 }, { 1, 1, 1, 1 }, -0.5f } };
	struct fixture f;

	(void)unused;
	open_on(&f, "model:");
	assert_int_equal(accel_draw_rectangles(f.draw, f.state, fills, 1), -EINVAL);
	assert_message(&f.messages, "rectangles without a frame");
	assert_int_equal(accel_draw_begin(f.draw, f.target, NULL), 0);
	assert_int_equal(accel_draw_rectangles(f.draw, f.state, fills, 2), -EINVAL);
	assert_message(&f.messages, "rectangle 1: a colour has four finite numbers");
	assert_int_equal(accel_draw_finish(f.draw), 0);
	memset(colour, 0, sizeof(colour));
	memset(depth, 0, sizeof(depth));
	assert_planes(&f);
	close_all(&f);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(rectangles_and_clears_draw_each_pixel_that_the_state_lets_them),
		cmocka_unit_test(a_masked_clear_of_everything_costs_no_record),
		cmocka_unit_test(a_rectangle_that_is_wrong_draws_nothing_of_the_others),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
