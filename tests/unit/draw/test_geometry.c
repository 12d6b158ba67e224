/* SPDX-License-Identifier: MIT */
/* Vertices to the window, and triangles that leave what can be drawn. */
#include "draw_mesh.h"
#include "draw_test.h"

#define SIDE 128

struct fixture {
	struct accel_state *state;
	struct accel_transform transform;
};

static int setup(void **state)
{
	static struct fixture f;

	f.state = state_shiny(10);
	accel_geometry_init(&f.transform, f.state, SIDE, SIDE);
	*state = &f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	accel_state_free(f->state);
	return 0;
}

static const float identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

static struct accel_vertex transformed(const struct fixture *f, float x, float y, float z)
{
	const float position[3] = { x, y, z };
	struct accel_vertex vertex;

	assert_int_equal(accel_geometry_vertex(&f->transform, position, NULL, &vertex), 0);
	return vertex;
}

static void the_window_has_its_first_row_at_the_top(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex vertex;

	accel_state_set_modelview(f->state, identity);
	accel_state_set_projection(f->state, identity);
	accel_state_set_viewport(f->state, 10, 20, 80, 40);
	accel_state_set_depth_range(f->state, 0.25f, 0.5f);
	accel_geometry_init(&f->transform, f->state, SIDE, SIDE);
	vertex = transformed(f, -1, 1, -1);
	assert_int_equal(vertex.x, 10 << ACCEL_WINDOW_BITS);
	assert_int_equal(vertex.y, 20 << ACCEL_WINDOW_BITS);
	assert_float_equal(vertex.z, 0.25, 1e-9);
	vertex = transformed(f, 1, -1, 1);
	assert_int_equal(vertex.x, 90 << ACCEL_WINDOW_BITS);
	assert_int_equal(vertex.y, 60 << ACCEL_WINDOW_BITS);
	assert_float_equal(vertex.z, 0.5, 1e-9);
	assert_int_equal(vertex.outside, 0);
}

static void vertices_are_snapped_to_the_nearest_sixteenth(void **state)
{
	struct fixture *f = *state;
	uint64_t seed = test_seed();

	accel_state_set_modelview(f->state, identity);
	accel_state_set_projection(f->state, identity);
	accel_geometry_init(&f->transform, f->state, SIDE, SIDE);
	for (int n = 0; n < 10000; n++) {
		float x = 2 * test_unit(&seed) - 1, y = 2 * test_unit(&seed) - 1;
		struct accel_vertex vertex = transformed(f, x, y, 0);
		double px = (double)(x + 1) * SIDE / 2, py = (double)(1 - y) * SIDE / 2;

		assert_int_equal(vertex.x % 64, 0);
		assert_int_equal(vertex.y % 64, 0);
		assert_true(fabs(vertex.x / 1024.0 - px) < 1 / 32.0 + 1e-5);
		assert_true(fabs(vertex.y / 1024.0 - py) < 1 / 32.0 + 1e-5);
	}
}

static void what_is_visible_is_viewport_scissor_and_target_together(void **state)
{
	struct fixture *f = *state;
	const struct accel_bounds *visible = &f->transform.window.visible;

	accel_state_set_viewport(f->state, -5, 10, 1000, 50);
	accel_state_set_scissor(f->state, 20, 0, 30, 1000);
	accel_geometry_init(&f->transform, f->state, SIDE, SIDE);
	assert_int_equal(visible->x0, 20);
	assert_int_equal(visible->y0, 10);
	assert_int_equal(visible->x1, 50);
	assert_int_equal(visible->y1, 60);
	/* Sums that an int does not hold. */
	accel_state_set_viewport(f->state, INT32_MAX - 1, INT32_MIN, INT32_MAX, INT32_MAX);
	accel_geometry_init(&f->transform, f->state, SIDE, SIDE);
	assert_true(visible->x0 >= visible->x1);
	assert_true(visible->y0 >= visible->y1);
}

static void whatever_the_numbers_what_is_visible_is_in_the_target_and_in_order(void **state)
{
	static const int end[] = { INT32_MIN, INT32_MIN + 1, -SIDE,         -1,       0,
				   1,         SIDE,          INT32_MAX - 1, INT32_MAX };
	struct fixture *f = *state;
	const struct accel_bounds *visible = &f->transform.window.visible;
	uint64_t seed = test_seed();

	for (int n = 0; n < 20000; n++) {
		int number[8];

		for (int i = 0; i < 8; i++)
			number[i] = end[test_below(&seed, 9)];
		accel_state_set_viewport(f->state, number[0], number[1], number[2], number[3]);
		accel_state_set_scissor(f->state, number[4], number[5], number[6], number[7]);
		accel_geometry_init(&f->transform, f->state, SIDE, SIDE);
		assert_in_range(visible->x0, 0, visible->x1);
		assert_in_range(visible->x1, 0, SIDE);
		assert_in_range(visible->y0, 0, visible->y1);
		assert_in_range(visible->y1, 0, SIDE);
		if ((number[2] >= 0 && number[3] < 0) || (number[6] >= 0 && number[7] < 0))
			assert_int_equal(visible->y0, visible->y1);
	}
}

static void normals_stay_at_right_angles_under_any_matrix(void **state)
{
	struct fixture *f = *state;
	uint64_t seed = test_seed();

	for (int n = 0; n < 1000; n++) {
		float matrix[16], position[2][3] = { { 0 } }, normal[3] = { 0, 0, 1 };
		struct accel_vertex vertex[2];
		float length = 0, along = 0;

		for (int i = 0; i < 16; i++)
			matrix[i] = 2 * test_unit(&seed) - 1;
		matrix[3] = matrix[7] = matrix[11] = 0;
		matrix[15] = 1;
		position[1][0] = test_unit(&seed);
		position[1][1] = test_unit(&seed);
		accel_state_set_modelview(f->state, matrix);
		accel_geometry_init(&f->transform, f->state, SIDE, SIDE);
		for (int i = 0; i < 2; i++)
			assert_int_equal(accel_geometry_vertex(&f->transform, position[i], normal,
							       &vertex[i]),
					 0);
		for (int i = 0; i < 3; i++) {
			length += vertex[0].normal[i] * vertex[0].normal[i];
			along += vertex[0].normal[i] * (vertex[1].eye[i] - vertex[0].eye[i]);
		}
		assert_float_equal(length, 1, 1e-5);
		assert_float_equal(along, 0, 1e-5);
	}
}

/* A mirror turns winding over, but a normal stays on its side. */
static void a_mirrored_normal_stays_on_its_side_of_the_surface(void **state)
{
	struct fixture *f = *state;
	const float mirror[16] = { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
	struct accel_vertex vertex;

	accel_state_set_modelview(f->state, mirror);
	accel_geometry_init(&f->transform, f->state, SIDE, SIDE);
	assert_int_equal(accel_geometry_vertex(&f->transform, (const float[3]){ 0, 0, -1 },
					       (const float[3]){ 3, 0, 4 }, &vertex),
			 0);
	assert_float_equal(vertex.normal[0], -0.6, 1e-6);
	assert_float_equal(vertex.normal[2], 0.8, 1e-6);
}

static void what_is_not_finite_is_refused(void **state)
{
	struct fixture *f = *state;
	const float bad[] = { NAN, INFINITY, -INFINITY };
	struct accel_vertex vertex;

	for (int n = 0; n < 9; n++) {
		float v[3] = { 0, 0, -1 }, good[3] = { 0, 0, -1 };

		v[n / 3] = bad[n % 3];
		assert_int_equal(accel_geometry_vertex(&f->transform, v, NULL, &vertex), -EINVAL);
		assert_int_equal(accel_geometry_vertex(&f->transform, good, v, &vertex), -EINVAL);
	}
	/* Finite, but not after the matrix. */
	f->state->modelview[0] = 3e38f;
	accel_geometry_init(&f->transform, f->state, SIDE, SIDE);
	assert_int_equal(accel_geometry_vertex(&f->transform, (const float[3]){ 3e38f, 0, 0 }, NULL,
					       &vertex),
			 -EINVAL);
}

/* Any corners whatever: what is left is inside, and inside the coordinates' range. */
static void what_clipping_leaves_is_inside(void **state)
{
	struct fixture *f = *state;
	const struct accel_window *window = &f->transform.window;
	uint64_t seed = test_seed();
	int clipped = 0;

	for (int n = 0; n < 100000; n++) {
		struct accel_corner polygon[ACCEL_POLYGON_MAX], spare[ACCEL_POLYGON_MAX];
		const struct accel_clipped clipping = { polygon, spare, ACCEL_POLYGON_MAX };
		uint32_t planes = 0;
		int corners;

		memset(polygon, 0, sizeof(polygon));
		for (int i = 0; i < 3; i++) {
			for (int j = 0; j < 4; j++)
				polygon[i].clip[j] = (2 * (double)test_unit(&seed) - 1) *
						     ldexp(1, test_between(&seed, -10, 20));
			for (int plane = 0; plane < ACCEL_CLIP_PLANES; plane++)
				if (accel_geometry_distance(window, plane, polygon[i].clip) < 0)
					planes |= 1u << plane;
		}
		corners = accel_clip_polygon(window, planes, &clipping, 3);
		assert_true(corners == 0 || (corners >= 3 && corners <= ACCEL_POLYGON_MAX));
		clipped += corners > 0;
		for (int i = 0; i < corners; i++) {
			const struct accel_vertex *v = &polygon[i].vertex;

			assert_true(v->w > 0);
			assert_true(v->z >= 0 && v->z <= 1);
			assert_true(v->x >= -2000 * ACCEL_WINDOW_ONE);
			assert_true(v->x <= (SIDE + 2000) * ACCEL_WINDOW_ONE);
			for (int j = 0; j < corners; j++)
				assert_true(accel_setup_edge_fits(v, &polygon[j].vertex));
		}
	}
	assert_true(clipped > 5000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(the_window_has_its_first_row_at_the_top, setup,
						teardown),
		cmocka_unit_test_setup_teardown(vertices_are_snapped_to_the_nearest_sixteenth,
						setup, teardown),
		cmocka_unit_test_setup_teardown(
			what_is_visible_is_viewport_scissor_and_target_together, setup, teardown),
		cmocka_unit_test_setup_teardown(
			whatever_the_numbers_what_is_visible_is_in_the_target_and_in_order, setup,
			teardown),
		cmocka_unit_test_setup_teardown(normals_stay_at_right_angles_under_any_matrix,
						setup, teardown),
		cmocka_unit_test_setup_teardown(a_mirrored_normal_stays_on_its_side_of_the_surface,
						setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_not_finite_is_refused, setup, teardown),
		cmocka_unit_test_setup_teardown(what_clipping_leaves_is_inside, setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
