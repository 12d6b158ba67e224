/* SPDX-License-Identifier: MIT */
/*
 * The pixels that a triangle's rows and records draw against exact edge functions; records by the
 * model's raster, in triangles that lie across tile borders of both sizes.
 */
#include "draw_test.h"

#define SIDE 192 /* of the target, pixels */
#define GRID 7
#define RANDOM_TRIANGLES 100000
#define RANDOM_RECORDS 100000

static uint8_t counts[SIDE * SIDE];

static void bin_open(struct accel_bin *bin, int tile_size)
{
	accel_bin_init(bin, tile_size);
	assert_int_equal(accel_bin_begin(bin, SIDE, SIDE), 0);
	bin->visible = (struct accel_bounds){ 0, 0, SIDE, SIDE };
}

static void fail_pixel(const struct accel_vertex *const vertex[3], int x, int y)
{
	fail_msg("(%d,%d) (%d,%d) (%d,%d)/%d: pixel %d,%d", vertex[0]->x, vertex[0]->y,
		 vertex[1]->x, vertex[1]->y, vertex[2]->x, vertex[2]->y, ACCEL_WINDOW_ONE, x, y);
}

static int low_of(int32_t a, int32_t b, int32_t c)
{
	int32_t low = a < b ? a : b;

	return (low < c ? low : c) >> ACCEL_WINDOW_BITS;
}

static int high_of(int32_t a, int32_t b, int32_t c)
{
	return -low_of(-a, -b, -c);
}

struct box {
	int x0, y0, x1, y1; /* pixels, x1 and y1 outside */
};

static struct box box_of(const struct accel_vertex *const v[3])
{
	return (struct box){ low_of(v[0]->x, v[1]->x, v[2]->x), low_of(v[0]->y, v[1]->y, v[2]->y),
			     high_of(v[0]->x, v[1]->x, v[2]->x),
			     high_of(v[0]->y, v[1]->y, v[2]->y) };
}

/* The records of a triangle that lies in the target draw each pixel inside once, and no other. */
static void check_records(struct accel_bin *bin, const struct accel_vertex *const vertex[3])
{
	struct coverage coverage = { SIDE, SIDE, counts, 0, 0 };
	struct accel_triangle triangle;
	struct accel_depth_plane plane;
	struct box box = box_of(vertex);
	long inside = 0;

	assert_int_equal(accel_bin_begin(bin, SIDE, SIDE), 0);
	memset(counts, 0, sizeof(counts));
	if (triangle_ready(&triangle, &plane, vertex))
		assert_int_equal(accel_bin_triangle(bin, &triangle), 0);
	records_of_bin(bin, coverage_record, &coverage);
	assert_int_equal(coverage.empty, 0);
	for (int y = box.y0; y < box.y1; y++)
		for (int x = box.x0; x < box.x1; x++) {
			bool wanted = edge_functions_inside(vertex, x, y);

			if (counts[y * SIDE + x] != wanted)
				fail_pixel(vertex, x, y);
			inside += wanted;
		}
	assert_int_equal(coverage.drawn, inside);
}

static void triangles_of_a_grid_cover_what_edge_functions_say(void **state)
{
	const int nodes = GRID * GRID;
	uint64_t seed = test_seed();
	struct accel_vertex node[3];
	const struct accel_vertex *const vertex[3] = { &node[0], &node[1], &node[2] };
	struct accel_bin bin[2];

	(void)state;
	bin_open(&bin[0], 32);
	bin_open(&bin[1], 64);
	for (int n = 0; n < nodes * nodes * nodes; n++) {
		const int pick[3] = { n % nodes, n / nodes % nodes, n / nodes / nodes };

		if (pick[0] >= pick[1] || pick[1] >= pick[2])
			continue;
		for (int i = 0; i < 3; i++)
			node[i] = vertex_at((60 + pick[i] % GRID) * 16 + test_between(&seed, 0, 16),
					    (61 + pick[i] / GRID) * 16 +
						    test_between(&seed, 0, 16));
		if (!accel_surface_area(&node[0], &node[1], &node[2]))
			continue;
		check_records(&bin[0], vertex);
		check_records(&bin[1], vertex);
	}
	accel_bin_free(&bin[0]);
	accel_bin_free(&bin[1]);
}

/* Corners within a square of random size and place in @low to @high. */
static void random_corners(uint64_t *seed, int low, int high, struct accel_vertex node[3])
{
	int size = 1 << test_between(seed, 0, 17), x, y;

	size = size < (high - low) * 16 ? size : (high - low) * 16;
	x = low * 16 + test_between(seed, 0, (high - low) * 16 - size + 1);
	y = low * 16 + test_between(seed, 0, (high - low) * 16 - size + 1);
	for (int i = 0; i < 3; i++)
		node[i] = vertex_at(x + test_between(seed, 0, size + 1),
				    y + test_between(seed, 0, size + 1));
}

static void random_triangles_are_drawn_once_across_tiles(void **state)
{
	uint64_t seed = test_seed();
	struct accel_vertex node[3];
	const struct accel_vertex *const vertex[3] = { &node[0], &node[1], &node[2] };
	struct accel_bin bin[2];

	(void)state;
	bin_open(&bin[0], 32);
	bin_open(&bin[1], 64);
	for (int n = 0; n < RANDOM_RECORDS; n++) {
		random_corners(&seed, 0, SIDE, node);
		if (accel_surface_area(&node[0], &node[1], &node[2]))
			check_records(&bin[n % 2], vertex);
	}
	accel_bin_free(&bin[0]);
	accel_bin_free(&bin[1]);
}

/* Pixels of a row that are inside are neighbours, so the ends of the row tell all of it. */
static void check_row(const struct accel_vertex *const vertex[3], const struct accel_row *row,
		      int y)
{
	struct box box = box_of(vertex);

	if (row->left < row->right) {
		if (!edge_functions_inside(vertex, row->left, y) ||
		    edge_functions_inside(vertex, row->left - 1, y))
			fail_pixel(vertex, row->left, y);
		if (!edge_functions_inside(vertex, row->right - 1, y) ||
		    edge_functions_inside(vertex, row->right, y))
			fail_pixel(vertex, row->right, y);
		return;
	}
	for (int x = box.x0; x < box.x1; x++)
		if (edge_functions_inside(vertex, x, y))
			fail_pixel(vertex, x, y);
}

static void check_rows(const struct accel_vertex *const vertex[3], uint64_t *seed)
{
	struct accel_row room[ACCEL_BAND_ROWS];
	const struct accel_row *row;
	struct accel_setup setup;
	struct box box = box_of(vertex);
	int first, end;

	if (!accel_setup_init(&setup, vertex))
		setup.first = setup.end = box.y0;
	for (first = setup.first; first < setup.end; first = end) {
		end = first + test_between(seed, 1, ACCEL_BAND_ROWS + 1);
		end = end < setup.end ? end : setup.end;
		row = accel_setup_rows(&setup, first, end, room);
		for (int y = first; y < end; y++)
			check_row(vertex, &row[y - first], y);
	}
	for (int y = box.y0; y < box.y1; y++)
		for (int x = box.x0; x < box.x1 && (y < setup.first || y >= setup.end); x++)
			if (edge_functions_inside(vertex, x, y))
				fail_pixel(vertex, x, y);
}

static void random_triangles_have_the_rows_edge_functions_say(void **state)
{
	uint64_t seed = test_seed();
	struct accel_vertex node[3];
	const struct accel_vertex *const vertex[3] = { &node[0], &node[1], &node[2] };

	(void)state;
	for (int n = 0; n < RANDOM_TRIANGLES; n++) {
		/* The whole guard band now and then. */
		random_corners(&seed, n % 8 ? -100 : -1000, n % 8 ? 200 : 1048, node);
		if (accel_surface_area(&node[0], &node[1], &node[2]))
			check_rows(vertex, &seed);
	}
}

/* Around a point that is not on the grid's corners: all triangles of the fan share edges. */
static void a_fan_covers_each_pixel_once(void **state)
{
	struct coverage coverage = { SIDE, SIDE, counts, 0, 0 };
	uint64_t seed = test_seed();
	struct accel_vertex rim[16], centre;
	struct accel_bin bin;

	(void)state;
	bin_open(&bin, 32);
	for (int n = 0; n < 300; n++) {
		assert_int_equal(accel_bin_begin(&bin, SIDE, SIDE), 0);
		memset(counts, 0, sizeof(counts));
		centre = vertex_at(test_between(&seed, 1, SIDE * 16),
				   test_between(&seed, 1, SIDE * 16));
		for (int i = 0; i < 16; i++) {
			/* Four points on each side of the square, corners among them. */
			int along = i % 4 ? test_between(&seed, (i % 4 - 1) * 60 * 16 + 1,
							 (i % 4) * 60 * 16) :
					    0;
			const int place[4][2] = { { along, 0 },
						  { SIDE * 16, along },
						  { SIDE * 16 - along, SIDE * 16 },
						  { 0, SIDE * 16 - along } };

			rim[i] = vertex_at(place[i / 4][0], place[i / 4][1]);
		}
		for (int i = 0; i < 16; i++) {
			const struct accel_vertex *const vertex[3] = { &centre, &rim[i],
								       &rim[(i + 1) % 16] };
			struct accel_triangle triangle;
			struct accel_depth_plane plane;

			if (accel_surface_area(vertex[0], vertex[1], vertex[2]) &&
			    triangle_ready(&triangle, &plane, vertex))
				assert_int_equal(accel_bin_triangle(&bin, &triangle), 0);
		}
		records_of_bin(&bin, coverage_record, &coverage);
		for (int i = 0; i < SIDE * SIDE; i++)
			if (counts[i] != 1)
				fail_msg("fan %d: pixel %d,%d is drawn %d times", n, i % SIDE,
					 i / SIDE, counts[i]);
	}
	accel_bin_free(&bin);
}

static void midpoints_are_on_their_edge(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	for (int n = 0; n < 10000; n++) {
		struct accel_vertex a = vertex_at(test_between(&seed, -1000, 3000),
						  test_between(&seed, -1000, 3000));
		struct accel_vertex b = vertex_at(test_between(&seed, -1000, 3000),
						  test_between(&seed, -1000, 3000));

		for (int level = 0; level < ACCEL_SPLIT_LEVELS; level++) {
			struct accel_vertex middle;

			accel_patch_middle(&a, &b, &middle);
			assert_int_equal(2 * middle.x, a.x + b.x);
			assert_int_equal(2 * middle.y, a.y + b.y);
			assert_int_equal(accel_surface_area(&a, &middle, &b), 0);
			if (test_below(&seed, 2))
				a = middle;
			else
				b = middle;
		}
	}
}

static void what_a_split_edge_needs_is_what_the_edge_needed(void **state)
{
	struct accel_vertex top = vertex_at(0, 0), bottom = vertex_at(77, ACCEL_EDGE_HEIGHT_MAX);
	struct accel_vertex far = vertex_at(78, ACCEL_EDGE_HEIGHT_MAX + 1), middle;

	(void)state;
	assert_true(accel_setup_edge_fits(&top, &bottom));
	assert_false(accel_setup_edge_fits(&top, &far));
	accel_patch_middle(&top, &bottom, &middle);
	assert_true(accel_setup_edge_fits(&top, &middle));
	assert_true(accel_setup_edge_fits(&middle, &bottom));
	/* From the middle of another edge, the same height has one digit more. */
	accel_patch_middle(&top, &(struct accel_vertex){ .x = 64, .w = 1 }, &middle);
	assert_false(accel_setup_edge_fits(&middle, &bottom));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(triangles_of_a_grid_cover_what_edge_functions_say),
		cmocka_unit_test(random_triangles_are_drawn_once_across_tiles),
		cmocka_unit_test(random_triangles_have_the_rows_edge_functions_say),
		cmocka_unit_test(a_fan_covers_each_pixel_once),
		cmocka_unit_test(midpoints_are_on_their_edge),
		cmocka_unit_test(what_a_split_edge_needs_is_what_the_edge_needed),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
