/* SPDX-License-Identifier: MIT */
/* The colours and depths that records give pixels, against the surfaces they were made from. */
#include <math.h>

#include "draw_test.h"

#define SIDE 192
#define STEP (1 / 255.0)

static uint8_t counts[SIDE * SIDE];
static uint32_t colours[2][SIDE * SIDE], depths[2][SIDE * SIDE];

/* A random triangle, its edges, and what is drawn of it in tiles of 32 and of 64 pixels. */
struct fixture {
	uint64_t seed;
	struct accel_vertex vertex[3];
	const struct accel_vertex *corner[3];
	struct accel_edge edge[3];
	struct accel_patch patch;
	struct accel_triangle triangle;
	struct accel_depth_plane plane;
	struct accel_basis basis;
	struct accel_bin bin[2];
};

static int setup(void **state)
{
	static struct fixture f;

	memset(&f, 0, sizeof(f));
	f.seed = test_seed();
	for (int i = 0; i < 3; i++) {
		f.corner[i] = f.patch.vertex[i] = &f.vertex[i];
		f.patch.edge[i] = &f.edge[i];
	}
	for (int i = 0; i < 2; i++) {
		accel_bin_init(&f.bin[i], i ? 64 : 32);
		f.bin[i].visible = (struct accel_bounds){ 0, 0, SIDE, SIDE };
	}
	*state = &f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	accel_bin_free(&f->bin[0]);
	accel_bin_free(&f->bin[1]);
	return 0;
}

/* Corners in a square of random size; false: the triangle has no area or crosses no row. */
static bool corners_random(struct fixture *f)
{
	int size = 1 << test_between(&f->seed, 3, 12);
	int x = test_between(&f->seed, 0, SIDE * 16 - size),
	    y = test_between(&f->seed, 0, SIDE * 16 - size);

	for (int i = 0; i < 3; i++) {
		f->vertex[i] = vertex_at(x + test_between(&f->seed, 0, size + 1),
					 y + test_between(&f->seed, 0, size + 1));
		f->vertex[i].z = (double)test_unit(&f->seed);
	}
	return accel_surface_area(f->corner[0], f->corner[1], f->corner[2]) != 0 &&
	       accel_setup_init(&f->triangle.setup, f->corner);
}

static void prepare(struct fixture *f)
{
	accel_surface_basis(&f->basis, f->corner);
	accel_surface_plane(&f->plane, &f->basis,
			    (const double[3]){ f->corner[0]->z, f->corner[1]->z, f->corner[2]->z },
			    f->triangle.setup.narrow);
	f->triangle.plane = &f->plane;
}

/* Colours up to @most; midpoints as far from the straight line as shading lets them be. */
static void colours_random(struct fixture *f, float most, float bend)
{
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 4; j++)
			f->vertex[i].sample.colour[j] = test_unit(&f->seed) * (j < 3 ? most : 1);
	for (int i = 0; i < 3; i++) {
		f->edge[i].curved = true;
		for (int j = 0; j < 3; j++) {
			float line = (f->vertex[i].sample.colour[j] +
				      f->vertex[(i + 1) % 3].sample.colour[j]) /
				     2;
			float middle = line + bend * (2 * test_unit(&f->seed) - 1);
			float highest = (ACCEL_COLOUR_MAX + line) / 2;

			middle = middle < 0 ? 0 : middle;
			f->edge[i].colour[j] = middle < highest ? middle : highest;
		}
	}
}

/* Draws in tiles of both sizes, which must not differ; leaves where in counts. */
static void draw_both(struct fixture *f)
{
	struct coverage coverage = { SIDE, SIDE, counts, 0, 0 };

	memset(counts, 0, sizeof(counts));
	for (int i = 0; i < 2; i++) {
		struct picture picture = { SIDE, colours[i], depths[i] };

		assert_int_equal(accel_bin_begin(&f->bin[i], SIDE, SIDE), 0);
		assert_int_equal(accel_bin_triangle(&f->bin[i], &f->triangle), 0);
		records_of_bin(&f->bin[i], picture_record, &picture);
	}
	records_of_bin(&f->bin[0], coverage_record, &coverage);
	for (int i = 0; i < SIDE * SIDE; i++)
		if (counts[i]) {
			assert_int_equal(colours[0][i], colours[1][i]);
			assert_int_equal(depths[0][i], depths[1][i]);
		}
}

/* Weights of the corners at the centre of a pixel. */
static void weights_at(const struct fixture *f, int pixel, double weight[3])
{
	struct accel_vertex centre = {
		.x = pixel % SIDE * ACCEL_WINDOW_ONE + ACCEL_WINDOW_HALF,
		.y = pixel / SIDE * ACCEL_WINDOW_ONE + ACCEL_WINDOW_HALF,
	};
	double area = (double)accel_surface_area(f->corner[0], f->corner[1], f->corner[2]);

	for (int i = 0; i < 3; i++)
		weight[i] = (double)accel_surface_area(&centre, f->corner[(i + 1) % 3],
						       f->corner[(i + 2) % 3]) /
			    area;
}

static double second_order_at(const struct fixture *f, const double w[3], int channel)
{
	double sum = 0;

	for (int i = 0; i < 3; i++)
		sum += w[i] * (2 * w[i] - 1) * (double)f->vertex[i].sample.colour[channel] +
		       4 * w[i] * w[(i + 1) % 3] * (double)f->edge[i].colour[channel];
	return fmin(fmax(sum, 0), 1);
}

static double linear_at(const struct fixture *f, const double w[3], int channel)
{
	double sum = 0;

	for (int i = 0; i < 3; i++)
		sum += w[i] * (double)f->vertex[i].sample.colour[channel];
	return fmin(fmax(sum, 0), 1);
}

static void check_pixels(struct fixture *f,
			 double (*at)(const struct fixture *, const double *, int))
{
	for (int pixel = 0; pixel < SIDE * SIDE; pixel++) {
		double w[3], z = 0;

		if (!counts[pixel])
			continue;
		weights_at(f, pixel, w);
		for (int i = 0; i < 3; i++) {
			double got = (colours[0][pixel] >> 8 * i & 0xff) * STEP;

			if (fabs(got - at(f, w, i)) > 0.65 * STEP)
				fail_msg("pixel %d: channel %d is %g, not %g", pixel, i, got / STEP,
					 at(f, w, i) / STEP);
			z += w[i] * f->vertex[i].z * 16777215;
		}
		assert_true(fabs((colours[0][pixel] >> 24) * STEP - linear_at(f, w, 3)) <
			    0.65 * STEP);
		/* Narrow planes have 1/64 of a step, and 63 pixels to go. */
		if (fabs(depths[0][pixel] - z) > (f->plane.narrow ? 1.1 : 0.7))
			fail_msg("pixel %d: depth %u is not %f", pixel, depths[0][pixel], z);
	}
}

static void second_order_surfaces_go_through_their_samples(void **state)
{
	struct fixture *f = *state;
	int curved = 0;

	for (int n = 0; n < 5000; n++) {
		if (!corners_random(f))
			continue;
		prepare(f);
		colours_random(f, n % 2 ? 1 : ACCEL_COLOUR_MAX, n % 3 ? 0.2f : 2);
		accel_surface_patch(&f->triangle, &f->basis, &f->patch);
		draw_both(f);
		curved += f->triangle.shading == GLOSS_SHADING_SECOND_ORDER;
		if (f->triangle.shading == GLOSS_SHADING_SECOND_ORDER)
			check_pixels(f, second_order_at);
	}
	assert_true(curved > 2500);
}

static void linear_surfaces_go_through_their_samples(void **state)
{
	struct fixture *f = *state;

	for (int n = 0; n < 5000; n++) {
		if (!corners_random(f))
			continue;
		prepare(f);
		colours_random(f, 1, 0);
		accel_surface_gouraud(&f->triangle, &f->basis, f->corner);
		draw_both(f);
		assert_int_equal(f->triangle.shading, GLOSS_SHADING_LINEAR);
		check_pixels(f, linear_at);
	}
}

/* As thin as can be: the sides of length up to @length, the area 1/512 of a pixel or so. */
static bool sliver_random(struct fixture *f, int length)
{
	int x = test_between(&f->seed, 0, 16 * SIDE - length),
	    dx = test_between(&f->seed, 1, length);
	int y = test_between(&f->seed, 0, 16 * SIDE - length),
	    dy = test_between(&f->seed, 0, length);
	int cut = test_between(&f->seed, 1, 16);

	f->vertex[0] = vertex_at(x, y);
	f->vertex[1] = vertex_at(x + dx, y + dy);
	f->vertex[2] = vertex_at(x + dx * cut / 16 + test_between(&f->seed, 0, 2),
				 y + dy * cut / 16 + test_between(&f->seed, 0, 2));
	/* A few splits down. */
	f->vertex[2].x += test_between(&f->seed, -3, 4);
	f->vertex[2].y += test_between(&f->seed, -3, 4);
	for (int i = 0; i < 3; i++)
		f->vertex[i].z = (double)test_unit(&f->seed);
	return accel_surface_area(f->corner[0], f->corner[1], f->corner[2]) != 0 &&
	       accel_setup_edge_fits(f->corner[1], f->corner[2]) &&
	       accel_setup_edge_fits(f->corner[2], f->corner[0]) &&
	       accel_setup_init(&f->triangle.setup, f->corner);
}

static double least(const struct fixture *f, int i)
{
	return fmin(f->vertex[0].sample.colour[i],
		    fmin(f->vertex[1].sample.colour[i], f->vertex[2].sample.colour[i]));
}

static double most(const struct fixture *f, int i)
{
	return fmax(f->vertex[0].sample.colour[i],
		    fmax(f->vertex[1].sample.colour[i], f->vertex[2].sample.colour[i]));
}

static void slivers_stay_between_the_values_of_their_corners(void **state)
{
	struct fixture *f = *state;
	long pixels = 0;

	for (int n = 0; n < 30000; n++) {
		if (!sliver_random(f, n % 2 ? 1000 : SIDE * 16 - 1))
			continue;
		prepare(f);
		colours_random(f, 1, 0);
		accel_surface_patch(&f->triangle, &f->basis, &f->patch);
		draw_both(f);
		for (int pixel = 0; pixel < SIDE * SIDE; pixel++) {
			double near, far;

			if (!counts[pixel])
				continue;
			pixels++;
			for (int i = 0; i < 4; i++) {
				double got = (colours[0][pixel] >> 8 * i & 0xff) * STEP;

				assert_true(got > least(f, i) - STEP && got < most(f, i) + STEP);
			}
			near = fmin(f->vertex[0].z, fmin(f->vertex[1].z, f->vertex[2].z));
			far = fmax(f->vertex[0].z, fmax(f->vertex[1].z, f->vertex[2].z));
			assert_true(depths[0][pixel] > near * 16777215 - 2);
			assert_true(depths[0][pixel] < far * 16777215 + 2);
		}
	}
	assert_true(pixels > 10000);
}

static void what_varies_by_less_than_a_step_is_flat(void **state)
{
	struct fixture *f = *state;

	while (!corners_random(f))
		;
	prepare(f);
	colours_random(f, 0, 0);
	f->vertex[0].sample.colour[1] = 0.9f / 255;
	f->edge[0].colour[1] = f->edge[2].colour[1] = 0.45f / 255;
	accel_surface_patch(&f->triangle, &f->basis, &f->patch);
	assert_int_equal(f->triangle.shading, GLOSS_SHADING_FLAT);
	f->vertex[0].sample.colour[1] = 1.1f / 255;
	f->edge[0].colour[1] = f->edge[2].colour[1] = 0.55f / 255;
	for (int i = 0; i < 3; i++)
		f->edge[i].curved = false;
	accel_surface_patch(&f->triangle, &f->basis, &f->patch);
	assert_int_equal(f->triangle.shading, GLOSS_SHADING_LINEAR);
	/* All above white is white. */
	colours_random(f, 0, 0);
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++) {
			f->vertex[i].sample.colour[j] = 1.2f + 0.2f * (float)i;
			f->edge[i].colour[j] = 1.5f;
		}
	accel_surface_patch(&f->triangle, &f->basis, &f->patch);
	assert_int_equal(f->triangle.shading, GLOSS_SHADING_FLAT);
	assert_int_equal(f->triangle.constant[0], 255);
}

static void equal_colours_are_flat_and_equal_alpha_is_constant(void **state)
{
	struct fixture *f = *state;

	while (!corners_random(f))
		;
	prepare(f);
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 4; j++)
			f->vertex[i].sample.colour[j] = 0.25f * (float)(j + 1);
	accel_surface_gouraud(&f->triangle, &f->basis, f->corner);
	assert_int_equal(f->triangle.shading, GLOSS_SHADING_FLAT);
	assert_int_equal(f->triangle.constant[3], 255);
	f->vertex[1].sample.colour[0] = 0;
	f->vertex[2].sample.colour[3] = 0.5f;
	accel_surface_gouraud(&f->triangle, &f->basis, f->corner);
	assert_int_equal(f->triangle.shading, GLOSS_SHADING_LINEAR);
	assert_true(f->triangle.alpha_linear);
	f->vertex[2].sample.colour[3] = 1;
	accel_surface_gouraud(&f->triangle, &f->basis, f->corner);
	assert_false(f->triangle.alpha_linear);
}

/* Steep depth does not fit the compact form, however small the triangle. */
static void a_steep_plane_is_wide(void **state)
{
	struct fixture *f = *state;

	f->vertex[0] = vertex_at(160, 160);
	f->vertex[1] = vertex_at(176, 160);
	f->vertex[2] = vertex_at(160, 800);
	assert_true(accel_setup_init(&f->triangle.setup, f->corner));
	prepare(f);
	assert_true(f->triangle.setup.narrow && f->plane.narrow);
	f->vertex[1].z = 1;
	prepare(f);
	assert_false(f->plane.narrow);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(second_order_surfaces_go_through_their_samples,
						setup, teardown),
		cmocka_unit_test_setup_teardown(linear_surfaces_go_through_their_samples, setup,
						teardown),
		cmocka_unit_test_setup_teardown(slivers_stay_between_the_values_of_their_corners,
						setup, teardown),
		cmocka_unit_test_setup_teardown(what_varies_by_less_than_a_step_is_flat, setup,
						teardown),
		cmocka_unit_test_setup_teardown(equal_colours_are_flat_and_equal_alpha_is_constant,
						setup, teardown),
		cmocka_unit_test_setup_teardown(a_steep_plane_is_wide, setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
