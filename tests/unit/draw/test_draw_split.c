/* SPDX-License-Identifier: MIT */
/* Splitting changes colours, and nothing else: not the pixels a mesh covers, not their depth. */
#include "draw/draw.c"

#include "draw_mesh.h"
#include "draw_test.h"

#define SIDE 256

static struct shape shape;
static uint8_t counts[2][SIDE * SIDE];
static uint32_t pixels[2][SIDE * SIDE];

struct fixture {
	struct messages messages;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
	struct accel_state *state;
};

static struct fixture *fixture_new(const char *name)
{
	struct fixture *f = calloc(1, sizeof(*f));

	assert_non_null(f);
	f->device = device_open(name, &f->messages);
	assert_int_equal(accel_target_new(f->device, SIDE, SIDE, &f->target), 0);
	assert_int_equal(accel_draw_new(f->device, &f->draw), 0);
	f->state = state_shiny(60);
	return f;
}

static void fixture_free(struct fixture *f)
{
	accel_state_free(f->state);
	accel_draw_free(f->draw);
	accel_target_free(f->target);
	accel_device_free(f->device);
	free(f);
}

static int setup(void **state)
{
	*state = fixture_new("model:");
	return 0;
}

static int teardown(void **state)
{
	fixture_free(*state);
	return 0;
}

/* Collects the shape's records, adds up how often they draw each pixel, and sends them. */
static struct accel_draw_stats draw_counted(struct fixture *f, enum accel_shading shading,
					    uint8_t *count)
{
	struct coverage coverage = { SIDE, SIDE, count, 0, 0 };
	const float black[4] = { 0, 0, 0, 0 };
	struct accel_draw_stats stats;

	memset(count, 0, SIDE * SIDE);
	accel_state_set_shading(f->state, shading);
	assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &shape.mesh), 0);
	records_of_bin(&f->draw->bin, coverage_record, &coverage);
	assert_int_equal(coverage.empty, 0);
	assert_true(coverage.drawn > SIDE * SIDE / 8);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	accel_draw_stats(f->draw, &stats, sizeof(stats));
	return stats;
}

static void check_split_covers_the_same(struct fixture *f)
{
	struct accel_draw_stats plain, adaptive;

	plain = draw_counted(f, ACCEL_SHADING_FLAT, counts[0]);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_DEPTH, NULL, pixels[0], SIDE * 4),
			 0);
	adaptive = draw_counted(f, ACCEL_SHADING_ADAPTIVE, counts[1]);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_DEPTH, NULL, pixels[1], SIDE * 4),
			 0);
	assert_int_equal(plain.split, 0);
	assert_true(adaptive.split > 0);
	assert_true(adaptive.flat + adaptive.linear + adaptive.second_order >
		    plain.flat + plain.linear);
	assert_memory_equal(counts[0], counts[1], sizeof(counts[0]));
	assert_memory_equal(pixels[0], pixels[1], sizeof(pixels[0]));
}

static void a_smooth_mesh_covers_the_same_pixels_split_or_not(void **state)
{
	shape_torus(&shape, 8);
	check_split_covers_the_same(*state);
}

/* Neighbours across a crease do not agree on what to split. */
static void a_creased_mesh_covers_the_same_pixels_split_or_not(void **state)
{
	struct fixture *f = *state;

	shape_drum(&shape, 7);
	check_split_covers_the_same(f);
	f->state->light[0].position[3] = 1;
	check_split_covers_the_same(f);
}

static void a_mesh_that_is_cut_by_the_near_plane_covers_the_same_split_or_not(void **state)
{
	struct fixture *f = *state;

	shape_torus(&shape, 8);
	state_look(f->state, 0.8f);
	check_split_covers_the_same(f);
}

static void the_front_of_a_closed_mesh_is_drawn_once(void **state)
{
	struct fixture *f = *state;
	long covered = 0;

	accel_state_set_cull(f->state, ACCEL_CULL_BACK);
	for (int n = 1; n <= 16; n *= 2) {
		shape_sphere(&shape, n);
		for (int shading = 0; shading <= ACCEL_SHADING_FLAT; shading++) {
			draw_counted(f, (enum accel_shading)shading, counts[0]);
			for (int i = 0; i < SIDE * SIDE; i++) {
				assert_true(counts[0][i] <= 1);
				covered += counts[0][i];
			}
		}
	}
	assert_true(covered > SIDE * SIDE);
}

/* Front and back together: where there is a front there is a back, and nothing more. */
static void each_layer_of_a_closed_mesh_is_drawn_once(void **state)
{
	struct fixture *f = *state;

	for (int n = 2; n <= 16; n *= 2) {
		shape_sphere(&shape, n);
		accel_state_set_cull(f->state, ACCEL_CULL_BACK);
		draw_counted(f, ACCEL_SHADING_ADAPTIVE, counts[0]);
		accel_state_set_cull(f->state, ACCEL_CULL_FRONT);
		draw_counted(f, ACCEL_SHADING_ADAPTIVE, counts[1]);
		assert_memory_equal(counts[0], counts[1], sizeof(counts[0]));
	}
}

/* Two passes over the same geometry: the second is drawn where depth is equal. */
static void depth_is_equal_in_a_second_pass_with_other_shading(void **state)
{
	struct fixture *f = *state;
	const float white[4] = { 1, 1, 1, 1 };

	shape_torus(&shape, 8);
	assert_int_equal(draw_begin(f->draw, f->target, white, 1), 0);
	accel_state_set_colour_mask(f->state, false, false, false, false);
	accel_state_set_shading(f->state, ACCEL_SHADING_FLAT);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &shape.mesh), 0);
	accel_state_set_colour_mask(f->state, true, true, true, true);
	accel_state_set_shading(f->state, ACCEL_SHADING_ADAPTIVE);
	accel_state_set_depth(f->state, ACCEL_COMPARE_EQUAL, false);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &shape.mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels[0],
					   SIDE * 4),
			 0);
	accel_state_set_depth(f->state, ACCEL_COMPARE_LESS, true);
	draw_counted(f, ACCEL_SHADING_ADAPTIVE, counts[0]);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels[1],
					   SIDE * 4),
			 0);
	for (int i = 0; i < SIDE * SIDE; i++)
		assert_int_equal(pixels[0][i], counts[0][i] ? pixels[1][i] : 0xffffffff);
}

static void read_all(struct fixture *f, uint32_t *colour, uint32_t *depth)
{
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, colour, SIDE * 4),
			 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_DEPTH, NULL, depth, SIDE * 4), 0);
}

static void a_picture_is_the_same_for_either_tile_size(void **state)
{
	static void (*const make[])(struct shape *, int) = { shape_sphere, shape_torus,
							     shape_drum };
	static uint32_t depth[2][SIDE * SIDE];
	const float distances[] = { 3.2f, 0.8f };
	struct fixture *f[2] = { fixture_new("model:tile=32"), fixture_new("model:tile=64") };

	(void)state;
	for (unsigned int n = 0; n < 3 * 2 * (ACCEL_SHADING_FLAT + 1); n++) {
		make[n % 3](&shape, n % 3 == 0 ? 2 : 9);
		for (int i = 0; i < 2; i++) {
			state_look(f[i]->state, distances[n / 3 % 2]);
			accel_state_set_scissor(f[i]->state, 5, 7, n % 5 ? -1 : 200, 190);
			draw_counted(f[i], (enum accel_shading)(n / 6), counts[i]);
			read_all(f[i], pixels[i], depth[i]);
		}
		assert_memory_equal(pixels[0], pixels[1], sizeof(pixels[0]));
		assert_memory_equal(depth[0], depth[1], sizeof(depth[0]));
	}
	fixture_free(f[0]);
	fixture_free(f[1]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(a_smooth_mesh_covers_the_same_pixels_split_or_not,
						setup, teardown),
		cmocka_unit_test_setup_teardown(a_creased_mesh_covers_the_same_pixels_split_or_not,
						setup, teardown),
		cmocka_unit_test_setup_teardown(
			a_mesh_that_is_cut_by_the_near_plane_covers_the_same_split_or_not, setup,
			teardown),
		cmocka_unit_test_setup_teardown(the_front_of_a_closed_mesh_is_drawn_once, setup,
						teardown),
		cmocka_unit_test_setup_teardown(each_layer_of_a_closed_mesh_is_drawn_once, setup,
						teardown),
		cmocka_unit_test_setup_teardown(depth_is_equal_in_a_second_pass_with_other_shading,
						setup, teardown),
		cmocka_unit_test(a_picture_is_the_same_for_either_tile_size),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
