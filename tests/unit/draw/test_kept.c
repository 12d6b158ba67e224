/* SPDX-License-Identifier: MIT */
/*
 * What a draw keeps of a state from call to call: whatever is changed, of one state or by another,
 * the next call draws as a draw does that has seen neither.
 */
#include <math.h>

#include "draw_fixture.h"

#define SIDE 48
#define PIXELS (SIDE * SIDE)

static uint32_t colour[2][PIXELS], depth[2][PIXELS];

static int setup(void **state)
{
	*state = fixture_new(SIDE, NULL);
	return 0;
}

static float unit(uint64_t *seed)
{
	return (float)test_below(seed, 1001) / 1000;
}

static void fill(uint64_t *seed, float *value, int count, float low, float high)
{
	for (int i = 0; i < count; i++)
		value[i] = low + unit(seed) * (high - low);
}

/* ---- every setter, with something else ---- */

static void change_modelview(struct accel_state *state, uint64_t *seed)
{
	const float s = 0.5f + unit(seed), c = unit(seed) - 0.5f;
	const float matrix[16] = { s, 0.1f, 0, 0, c, s, 0, 0, 0, c, s, 0, c, 0, 0, 1 };

	accel_state_set_modelview(state, matrix);
}

static void change_projection(struct accel_state *state, uint64_t *seed)
{
	const float s = 0.5f + unit(seed);
	const float matrix[16] = { s, 0, 0, 0, 0, s, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 1 };

	accel_state_set_projection(state, matrix);
}

static void change_window(struct accel_state *state, uint64_t *seed)
{
	const int at = (int)test_below(seed, 20);

	switch (test_below(seed, 4)) {
	case 0:
		accel_state_set_viewport(state, at, 2, SIDE - at, SIDE);
		break;
	case 1:
		accel_state_set_scissor(state, 2, at, SIDE - 3, SIDE);
		break;
	case 2:
		accel_state_set_depth_range(state, 0.4f * unit(seed), 0.5f + 0.5f * unit(seed));
		break;
	default:
		accel_state_set_origin(state, test_below(seed, 2));
		break;
	}
}

static void change_plane(struct accel_state *state, uint64_t *seed)
{
	float plane[4];

	fill(seed, plane, 4, -1, 1);
	plane[3] += 0.5f;
	assert_int_equal(accel_state_set_clip_plane(state, (int)test_below(seed, 2),
						    test_below(seed, 2) ? plane : NULL),
			 0);
}

static void change_tests(struct accel_state *state, uint64_t *seed)
{
	accel_state_set_depth(state,
			      test_below(seed, 2) ? ACCEL_COMPARE_LESS : ACCEL_COMPARE_ALWAYS,
			      test_below(seed, 2));
	accel_state_set_colour_mask(state, test_below(seed, 4), test_below(seed, 4), true, true);
	accel_state_set_cull(state, (enum accel_cull)test_below(seed, 3));
	accel_state_set_front_face(state, test_below(seed, 2));
}

static void change_sides(struct accel_state *state, uint64_t *seed)
{
	switch (test_below(seed, 6)) {
	case 0:
		accel_state_set_normals(state, (enum accel_normals)test_below(seed, 3));
		break;
	case 1:
		accel_state_set_lighting(state, test_below(seed, 3));
		break;
	case 2:
		accel_state_set_colour_material(state, (enum accel_tracks)test_below(seed, 6),
						(enum accel_tracks)test_below(seed, 6));
		break;
	case 3:
		accel_state_set_two_sided(state, test_below(seed, 2));
		break;
	case 4:
		accel_state_set_local_viewer(state, test_below(seed, 2));
		break;
	default:
		accel_state_set_shading(state, (enum accel_shading)test_below(seed, 4));
		break;
	}
}

static void change_light(struct accel_state *state, uint64_t *seed)
{
	struct accel_light light = ACCEL_LIGHT(.enabled = test_below(seed, 4));
	struct accel_material material = ACCEL_MATERIAL(.shininess = 40 * unit(seed));
	float ambient[4];

	fill(seed, light.position, 3, -1, 1);
	fill(seed, light.diffuse, 4, 0, 1);
	fill(seed, light.specular, 4, 0, 1);
	fill(seed, material.diffuse, 4, 0, 1);
	fill(seed, material.ambient, 4, 0, 1);
	fill(seed, material.specular, 4, 0, 1);
	fill(seed, ambient, 4, 0, 1);
	switch (test_below(seed, 3)) {
	case 0:
		assert_int_equal(accel_state_set_light(state, (int)test_below(seed, 2), &light), 0);
		break;
	case 1:
		assert_int_equal(accel_state_set_material(state, &material, NULL), 0);
		break;
	default:
		assert_int_equal(accel_state_set_ambient(state, ambient), 0);
		break;
	}
}

static void change_polygons(struct accel_state *state, uint64_t *seed)
{
	accel_state_set_polygon_mode(state, (enum accel_polygon_mode)test_below(seed, 3),
				     ACCEL_POLYGON_FILL);
	assert_int_equal(accel_state_set_polygon_offset(state, unit(seed), 1000 * unit(seed),
							test_below(seed, 8)),
			 0);
}

static void change(struct accel_state *state, uint64_t *seed)
{
	static void (*const changes[])(struct accel_state *, uint64_t *) = {
		change_modelview, change_projection, change_window, change_plane,
		change_tests,     change_sides,      change_light,  change_polygons,
	};

	changes[test_below(seed, sizeof(changes) / sizeof(changes[0]))](state, seed);
}

/* ---- the two draws ---- */

static const float corner[4][3] = {
	{ -0.8f, -0.7f, -0.5f }, { 0.7f, -0.6f, 0.3f }, { 0.6f, 0.8f, 0.5f }, { -0.7f, 0.6f, -0.2f }
};
static const float normal[4][3] = {
	{ 0.2f, 0, 1 }, { 0, 0.3f, 0.9f }, { 0.5f, 0, 1.2f }, { 0, -0.4f, 0.7f }
};
static const float paint[4][4] = {
	{ 1.6f, -0.5f, 0.5f, 1 }, { 0, 1.4f, 0.5f, 1 }, { 1, 1, 0.2f, 1 }, { 0.3f, 0.3f, 1, 0.5f }
};

static void take(void *data, enum accel_captured what, const struct accel_captured_vertex *vertex,
		 uint32_t vertices)
{
	(void)data;
	(void)what;
	(void)vertex;
	(void)vertices;
}

static void draw(struct fixture *f, struct accel_draw *on, const struct accel_state *state,
		 bool painted, int number)
{
	static const struct accel_primitive quad = { ACCEL_TOPOLOGY_QUADS, 0, 4 };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &quad, .primitives = 1);
	const struct accel_arrays arrays = ACCEL_ARRAYS(
			.vertices = 4, .position = { .data = corner, .components = 3 },
			.normal = { .data = normal }, .colour = { .data = painted ? paint : NULL });

	assert_int_equal(accel_draw_arrays(on, state, &arrays, &elements), 0);
	assert_int_equal(accel_draw_finish(on), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, colour[number],
					   SIDE * 4),
			 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_DEPTH, NULL, depth[number],
					   SIDE * 4),
			 0);
}

static void begin(struct fixture *f, struct accel_draw *on)
{
	assert_int_equal(draw_begin(on, f->target, (const float[4]){ 0.2f, 0, 0, 1 }, 0.6f), 0);
}

static void a_draw_that_saw_other_states_draws_as_a_new_one(void **unused)
{
	uint64_t seed = test_seed();
	struct fixture *f = *unused;
	struct accel_state *states[2];

	for (int i = 0; i < 2; i++)
		assert_int_equal(accel_state_new(&states[i]), 0);
	for (int n = 0; n < 3000; n++) {
		struct accel_state *state = states[test_below(&seed, 2)];
		const bool painted = test_below(&seed, 2);
		struct accel_draw *fresh;

		change(state, &seed);
		begin(f, f->draw);
		/* A capture is cut elsewhere. */
		if (test_below(&seed, 8) == 0)
			assert_int_equal(accel_draw_capture(f->draw, take, NULL), 0);
		draw(f, f->draw, state, painted, 0);
		begin(f, f->draw);
		draw(f, f->draw, state, painted, 0);
		assert_int_equal(accel_draw_new(f->device, &fresh), 0);
		begin(f, fresh);
		draw(f, fresh, state, painted, 1);
		accel_draw_free(fresh);
		assert_memory_equal(colour[0], colour[1], sizeof(colour[0]));
		assert_memory_equal(depth[0], depth[1], sizeof(depth[0]));
	}
	for (int i = 0; i < 2; i++)
		accel_state_free(states[i]);
}

/* A viewport that is the whole target is another on another target. */
static void a_draw_goes_on_to_a_target_of_another_size(void **unused)
{
	struct fixture *f = *unused;
	struct accel_target *small, *large = f->target;
	struct accel_state *state;
	uint32_t pixel = 0;

	assert_int_equal(accel_state_new(&state), 0);
	assert_int_equal(accel_target_new(f->device, SIDE / 2, SIDE, &small), 0);
	begin(f, f->draw);
	draw(f, f->draw, state, false, 0);
	f->target = small;
	begin(f, f->draw);
	assert_int_equal(
		accel_draw_mesh(f->draw, state,
				&(struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_QUADS,
							       .vertices = 4,
							       .position = { .data = corner })),
		0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	/* Right of the quad, which would reach farther on the target before. */
	assert_int_equal(accel_target_read(small, ACCEL_PLANE_COLOUR,
					   &(struct accel_rectangle){ 22, 24, 1, 1 }, &pixel, 4),
			 0);
	assert_int_equal(pixel, 0xff000033);
	f->target = large;
	accel_target_free(small);
	accel_state_free(state);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_draw_that_saw_other_states_draws_as_a_new_one),
		cmocka_unit_test(a_draw_goes_on_to_a_target_of_another_size),
	};

	return cmocka_run_group_tests(tests, setup, fixture_free);
}
