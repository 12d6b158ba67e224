// SPDX-License-Identifier: MIT
/* Small triangles: what rounding them to short numbers changes, and that tiles change nothing. */
#include <string.h>

#include "draw/kernel.h"
#include "draw_test.h"

#define SIDE 128
#define CASES 1000

static uint8_t counts[2][SIDE * SIDE];
static uint32_t colours[3][SIDE * SIDE], depths[3][SIDE * SIDE];

/* A triangle as it is and rounded, the rounded one also in tiles of 64 pixels. */
struct fixture {
	uint64_t seed;
	struct accel_vertex vertex[3];
	const struct accel_vertex *corner[3];
	struct accel_edge edge[3];
	struct accel_patch patch;
	struct accel_triangle exact, rounded;
	struct accel_depth_plane exact_plane, rounded_plane;
	struct accel_leaf_batch
		batch; /* in which it was rounded, and packed for tiles of 64 pixels */
	struct accel_bin bin[3];
};

static int setup(void **state)
{
	static struct fixture f;

	memset(&f, 0, sizeof(f));
	f.seed = test_seed();
	for (int i = 0; i < 3; i++) {
		f.corner[i] = f.patch.vertex[i] = &f.vertex[i];
		f.patch.edge[i] = &f.edge[i];
		accel_bin_init(&f.bin[i], i == 2 ? 64 : 32);
		f.bin[i].visible = (struct accel_bounds){ 0, 0, SIDE, SIDE };
	}
	*state = &f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	for (int i = 0; i < 3; i++)
		accel_bin_free(&f->bin[i]);
	return 0;
}

/* Of up to @size sixteenths of a pixel, sometimes over the borders of target and tiles. */
static bool corners_random(struct fixture *f, int size)
{
	double deep = 1.0 / (1 << test_between(&f->seed, 0, 16));
	int reach = 16 * SIDE;
	int x = test_between(&f->seed, -size, reach), y = test_between(&f->seed, -size, reach);

	for (int i = 0; i < 3; i++) {
		f->vertex[i] = vertex_at(x + test_between(&f->seed, 0, size + 1),
					 y + test_between(&f->seed, 0, size + 1));
		f->vertex[i].z = 0.5 + deep * ((double)test_unit(&f->seed) - 0.5);
	}
	return accel_surface_area(f->corner[0], f->corner[1], f->corner[2]) != 0 &&
	       accel_setup_init(&f->exact.setup, f->corner);
}

/* Differences of corners from 1/64 to all of the range; midpoints a part of that from the line. */
static void colours_random(struct fixture *f)
{
	float range = 1.0f / (float)(1 << test_between(&f->seed, 0, 7));
	float bend = range / (float)(1 << test_between(&f->seed, 1, 4));
	bool curved = test_below(&f->seed, 2);

	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 4; j++)
			f->vertex[i].sample.colour[j] = j < 3 ? 0.5f + range * (test_unit(
											&f->seed) -
										0.5f) :
								1;
	for (int i = 0; i < 3; i++) {
		f->edge[i].curved = curved;
		for (int j = 0; j < 3; j++)
			f->edge[i].colour[j] = (f->vertex[i].sample.colour[j] +
						f->vertex[(i + 1) % 3].sample.colour[j]) /
						       2 +
					       bend * (test_unit(&f->seed) - 0.5f);
	}
}

static void prepare(struct fixture *f)
{
	struct accel_basis basis;

	accel_surface_basis(&basis, f->corner);
	accel_surface_plane(&f->exact_plane, &basis,
			    (const double[3]){ f->corner[0]->z, f->corner[1]->z, f->corner[2]->z },
			    f->exact.setup.narrow);
	f->exact.plane = &f->exact_plane;
	f->exact.small.fits = false;
	accel_surface_patch(&f->exact, &basis, &f->patch);
	f->rounded = f->exact;
	f->rounded_plane = f->exact_plane;
	f->rounded.plane = &f->rounded_plane;
	accel_small_init(&f->rounded.small, &f->rounded.setup);
	if (f->rounded.small.fits)
		accel_small_plane(&f->rounded_plane);
	accel_small_put(&f->batch, 0, &f->rounded.small, &f->rounded.setup, &f->rounded_plane);
	accel_small_surface(&f->batch, 0, &f->rounded);
	accel_kernel()->small(&f->batch, 1, 64);
	accel_small_take(&f->batch, 0, &f->rounded);
}

static void draw(struct fixture *f)
{
	memset(counts, 0, sizeof(counts));
	for (int i = 0; i < 3; i++) {
		struct picture picture = { SIDE, colours[i], depths[i] };
		struct coverage coverage = { SIDE, SIDE, counts[i != 0], 0, 0 };

		assert_int_equal(accel_bin_begin(&f->bin[i], SIDE, SIDE), 0);
		assert_int_equal(accel_bin_triangle(&f->bin[i], i ? &f->rounded : &f->exact), 0);
		records_of_bin(&f->bin[i], picture_record, &picture);
		if (i < 2)
			records_of_bin(&f->bin[i], coverage_record, &coverage);
	}
	assert_memory_equal(counts[0], counts[1], sizeof(counts[0]));
}

static int level(uint32_t word, int channel)
{
	return (int)(word >> 8 * channel & 0xff);
}

/* Half a step of z and of each scale, and what a slope is rounded by, up to 16 pixels away. */
static int64_t depth_bound(const struct accel_depth_plane *plane)
{
	int64_t dx = plane->dx < 0 ? -plane->dx : plane->dx;
	int64_t dy = plane->dy < 0 ? -plane->dy : plane->dy;

	return 2 + ((dx > dy ? dx : dy) >> (GLOSS_DEPTH_FRACTION + 6));
}

static void check_pixel(const struct fixture *f, int pixel)
{
	int64_t depth = (int64_t)depths[1][pixel] - (int64_t)depths[0][pixel];

	for (int i = 0; i < 4; i++) {
		int change = level(colours[1][pixel], i) - level(colours[0][pixel], i);

		if (change < -1 || change > 1)
			fail_msg("pixel %d: channel %d changes by %d", pixel, i, change);
	}
	if (depth < -depth_bound(&f->exact_plane) || depth > depth_bound(&f->exact_plane))
		fail_msg("pixel %d: depth changes by %lld", pixel, (long long)depth);
	assert_int_equal(colours[1][pixel], colours[2][pixel]);
	assert_int_equal(depths[1][pixel], depths[2][pixel]);
}

/* The records that a bin has, of each kind. */
struct kinds {
	int small, large, words;
};

static void kinds_record(void *data, const uint32_t *packet, int tile_x, int tile_y, int tile_size)
{
	struct kinds *kinds = data;

	(void)tile_x;
	(void)tile_y;
	(void)tile_size;
	if (gloss_header_opcode(packet[0]) == GLOSS_OP_TRIANGLE_SMALL)
		kinds->small++;
	else
		kinds->large++;
	kinds->words = (int)(1 + gloss_header_length(packet[0]));
}

/*
 * Coverage stays, colours change by a level and depths by next to nothing, whatever the tile size;
 * and most are sent small.
 */
static void rounding_changes_a_level_at_most(void **state)
{
	struct fixture *f = *state;
	struct kinds kinds = { 0 };
	int rounded = 0, drawn = 0;

	for (int n = 0; n < CASES; n++) {
		if (!corners_random(f, 1 << test_between(&f->seed, 4, 9)))
			continue;
		colours_random(f);
		prepare(f);
		draw(f);
		drawn++;
		rounded += f->rounded.small.fits;
		records_of_bin(&f->bin[1], kinds_record, &kinds);
		for (int pixel = 0; pixel < SIDE * SIDE; pixel++)
			if (counts[0][pixel])
				check_pixel(f, pixel);
	}
	assert_true(rounded * 3 > drawn);
	assert_true(kinds.small > kinds.large / 3);
}

/* What is sent small means the same as what is sent large. */
static void the_form_changes_nothing(void **state)
{
	struct fixture *f = *state;
	int rounded = 0;

	for (int n = 0; n < CASES / 2; n++) {
		if (!corners_random(f, 1 << test_between(&f->seed, 4, 9)))
			continue;
		colours_random(f);
		prepare(f);
		if (!f->rounded.small.fits)
			continue;
		f->exact = f->rounded;
		f->exact.small.fits = false;
		draw(f);
		rounded++;
		for (int pixel = 0; pixel < SIDE * SIDE; pixel++)
			if (counts[0][pixel]) {
				assert_int_equal(colours[0][pixel], colours[1][pixel]);
				assert_int_equal(depths[0][pixel], depths[1][pixel]);
			}
	}
	assert_true(rounded > 20);
}

/* The record that is packed with others is the one that a tile would be given by itself. */
static void records_of_whole_triangles_are_packed_alike(void **state)
{
	struct fixture *f = *state;
	int packed = 0;

	for (int n = 0; n < 10 * CASES; n++) {
		const struct accel_small *small = &f->rounded.small;
		uint32_t wanted[ACCEL_RECORD_WORDS], got[ACCEL_RECORD_WORDS], count;
		struct accel_place place = { .tile_size = 64 };

		if (!corners_random(f, 1 << test_between(&f->seed, 4, 9)))
			continue;
		colours_random(f);
		prepare(f);
		if (!small->fits || small->x0 < 0 || small->y0 < 0 ||
		    small->x0 / 64 != (small->x1 - 1) / 64 ||
		    small->y0 / 64 != (small->y1 - 1) / 64)
			continue;
		place.x = small->x0 & ~63;
		place.y = small->y0 & ~63;
		place.first = small->y0;
		place.end = small->y1;
		if (f->rounded.setup.end - f->rounded.setup.first > ACCEL_SETUP_ROWS)
			continue;
		place.row = &f->rounded.setup.row[small->y0 - f->rounded.setup.first];
		count = accel_record_small(wanted, &f->rounded, &place);
		assert_int_equal(accel_small_words(&f->batch, 0, &f->rounded.setup, got), count);
		assert_memory_equal(got, wanted, count * sizeof(*got));
		packed++;
	}
	assert_true(packed > CASES);
}

static struct kinds kinds_of(struct fixture *f)
{
	struct kinds kinds = { 0 };

	prepare(f);
	draw(f);
	records_of_bin(&f->bin[1], kinds_record, &kinds);
	return kinds;
}

/* A right triangle with legs of @side pixels; of its rows the last one has no pixel. */
static void corners_right(struct fixture *f, int side)
{
	f->vertex[0] = vertex_at(16 * 40, 16 * 40);
	f->vertex[1] = vertex_at(16 * 40, 16 * (40 + side));
	f->vertex[2] = vertex_at(16 * (40 + side), 16 * 40);
	assert_true(accel_setup_init(&f->exact.setup, f->corner));
	for (int i = 0; i < 3; i++) {
		f->vertex[i].z = 0.5;
		f->edge[i].curved = false;
	}
}

static void colour_all(struct fixture *f, float corner, float others, float middle)
{
	for (int i = 0; i < 3; i++) {
		for (int j = 0; j < 4; j++)
			f->vertex[i].sample.colour[j] = j == 3 ? 1 : i ? others : corner;
		for (int j = 0; j < 3; j++)
			f->edge[i].colour[j] = middle;
	}
}

static void words_grow_with_shading_and_rows(void **state)
{
	static const struct {
		int side, words;
	} sides[] = { { 3, 5 }, { 4, 6 }, { 8, 7 }, { 12, 8 }, { 16, 9 } };
	struct fixture *f = *state;

	for (size_t i = 0; i < sizeof(sides) / sizeof(*sides); i++) {
		corners_right(f, sides[i].side);
		colour_all(f, 0.5f, 0.5f, 0.5f);
		assert_int_equal(kinds_of(f).words, sides[i].words);
		colour_all(f, 0.4f, 0.5f, 0.45f);
		assert_int_equal(kinds_of(f).words, sides[i].words + 3);
		f->edge[1].curved = true;
		colour_all(f, 0.5f, 0.5f, 0.52f);
		assert_int_equal(kinds_of(f).words, sides[i].words + 6);
	}
}

static void what_is_too_large_or_too_steep_stays_large(void **state)
{
	struct fixture *f = *state;

	corners_right(f, 17);
	colour_all(f, 0.5f, 0.5f, 0.5f);
	assert_int_equal(kinds_of(f).small, 0);
	corners_right(f, 16);
	colour_all(f, 0, 1, 0.5f);
	assert_int_equal(kinds_of(f).small, 1);
	f->edge[0].curved = true;
	colour_all(f, 0, 0, 0.99f);
	assert_int_equal(kinds_of(f).small, 0);
	corners_right(f, 4);
	colour_all(f, 0.5f, 0.5f, 0.5f);
	f->vertex[0].sample.colour[3] = 0;
	assert_int_equal(kinds_of(f).small, 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(rounding_changes_a_level_at_most, setup, teardown),
		cmocka_unit_test_setup_teardown(the_form_changes_nothing, setup, teardown),
		cmocka_unit_test_setup_teardown(records_of_whole_triangles_are_packed_alike, setup,
						teardown),
		cmocka_unit_test_setup_teardown(words_grow_with_shading_and_rows, setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_too_large_or_too_steep_stays_large, setup,
						teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
