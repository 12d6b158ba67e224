/* SPDX-License-Identifier: MIT */
/* What the draw calls refuse, and that the board takes whatever they make of the rest. */
#include "draw_mesh.h"
#include "draw_square.h"

/* ---- what is refused ---- */

static void a_clear_with_a_wrong_argument_is_refused(void **state)
{
	static const struct accel_clear wrong[] = {
		{ .mask = ACCEL_CLEAR_DEPTH },
		ACCEL_CLEAR(.mask = 0),
		ACCEL_CLEAR(.mask = 4),
		ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR, .rgba = { 0, NAN, 0, 0 }),
		ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH, .depth = -0.1f),
		ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH, .depth = NAN),
		ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH, .depth = 1.1f),
	};
	static const struct accel_clear depth = ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH,
							    .rgba = { NAN }, .depth = 1);
	static const struct accel_clear colour = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR,
							     .depth = NAN);
	struct fixture *f = *state;

	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		assert_int_equal(accel_draw_clear(f->draw, &wrong[i]), -EINVAL);
		assert_message(&f->messages, i ? "a clear of mask" : "begin it with ACCEL_CLEAR()");
		assert_int_equal(accel_draw_begin(f->draw, f->target, &wrong[i]), -EINVAL);
	}
	assert_message(&f->messages, "a clear of mask 2");
	assert_int_equal(accel_draw_clear(f->draw, &depth), 0);
	assert_int_equal(accel_draw_clear(f->draw, &colour), 0);
}

static void a_mesh_that_is_none_is_refused(void **state)
{
	struct fixture *f = *state;
	const uint32_t beyond[3] = { 0, 1, 4 };
	struct accel_mesh mesh = square_mesh();

	mesh.position.data = NULL;
	assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
	assert_message(&f->messages, "without positions");
	mesh = square_mesh();
	mesh.topology = (enum accel_topology)10;
	assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
	assert_message(&f->messages, "topology");
	mesh = square_mesh();
	mesh.index = beyond;
	mesh.indices = 3;
	assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
	assert_message(&f->messages, "index 2 is of vertex 4, and the mesh has 4");
	assert_int_equal(stats_of(f).triangles_in, 0);
}

static void a_matrix_that_is_not_finite_draws_no_mesh(void **state)
{
	static const float wrong[] = { NAN, INFINITY, -INFINITY };
	struct accel_mesh mesh = square_mesh();
	struct fixture *f = *state;

	for (int n = 0; n < 3 * 16; n++) {
		float matrix[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }, old[16];

		memcpy(old, matrix, sizeof(old));
		matrix[n / 3] = wrong[n % 3];
		accel_state_set_modelview(f->state, matrix);
		assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
		accel_state_set_modelview(f->state, old);
		accel_state_set_projection(f->state, matrix);
		assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
		accel_state_set_projection(f->state, old);
	}
	assert_int_equal(mesh_draw(f, &mesh), 0);
}

static void a_mesh_that_is_not_finite_is_refused_and_nothing_of_it_drawn(void **state)
{
	struct fixture *f = *state;
	float position[4][3], normal[4][3] = { { 0 } }, colour[4][4] = { { 0 } };
	struct accel_mesh mesh = square_mesh();

	mesh.position.data = position;
	mesh.normal.data = normal;
	mesh.colour.data = colour;
	memcpy(position, square, sizeof(square));
	position[3][1] = INFINITY;
	assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
	assert_message(&f->messages, "vertex 3 of the mesh is not finite");
	position[3][1] = 1;
	colour[2][3] = NAN;
	assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
	accel_state_set_lighting(f->state, true);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	normal[1][0] = NAN;
	assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
	assert_int_equal(stats_of(f).triangles_in, 2);
}

/* ---- anything ---- */

static float random_float(uint64_t *seed)
{
	static const float special[] = { 0, -0.0f, 1, 3e38f, -3e38f, 1e-45f, 1e20f, 1e-20f };

	if (!test_below(seed, 30))
		return special[test_below(seed, 8)];
	return ldexpf((float)(int)test_below(seed, 2001) / 1000 - 1, (int)test_below(seed, 12) - 4);
}

static void random_state(uint64_t *seed, struct accel_state *s)
{
	struct accel_material material = ACCEL_MATERIAL(.shininess = (float)test_below(seed, 1001));
	struct accel_light light = ACCEL_LIGHT(.enabled = true, .attenuation[0] = 1,
					       .spot_cutoff = 180);

	state_look(s, random_float(seed));
	for (int i = 0; i < 4; i++) {
		material.specular[i] = random_float(seed);
		material.emission[i] = random_float(seed);
		light.position[i] = random_float(seed);
		light.specular[i] = random_float(seed);
		light.diffuse[i] = random_float(seed);
	}
	if (test_below(seed, 2)) {
		light.spot_cutoff = (float)test_below(seed, 91);
		light.spot_exponent = (float)test_below(seed, 129);
		light.spot_direction[1] = random_float(seed);
	}
	assert_int_equal(accel_state_set_material(s, &material, NULL), 0);
	assert_int_equal(accel_state_set_light(s, (int)test_below(seed, 8), &light), 0);
	accel_state_set_lighting(s, test_below(seed, 4));
	accel_state_set_two_sided(s, test_below(seed, 2));
	accel_state_set_local_viewer(s, test_below(seed, 2));
	accel_state_set_cull(s, (enum accel_cull)test_below(seed, 3));
	accel_state_set_shading(s, (enum accel_shading)test_below(seed, 4));
	accel_state_set_depth(s, (enum accel_compare)test_below(seed, 8), test_below(seed, 2));
	accel_state_set_colour_mask(s, test_below(seed, 2), true, test_below(seed, 2), true);
	accel_state_set_viewport(s, (int)test_below(seed, 200) - 100, (int)test_random(seed) % 300,
				 (int)test_random(seed) % 500, (int)test_below(seed, 3000));
	accel_state_set_scissor(s, (int)test_random(seed) % 99, -5, (int)test_random(seed) % 99,
				80);
}

static void whatever_is_drawn_the_board_takes_it(void **state)
{
	struct fixture *f = *state;
	uint64_t seed = test_seed();
	struct accel_clear clear = ACCEL_CLEAR(.depth = 0.5f);
	int taken = 0, in_frame = 0;
	uint64_t drawn = 0;

	for (int n = 0; n < 3000; n++) {
		float position[12][3], normal[12][3], colour[12][4];
		const struct accel_mesh mesh = ACCEL_MESH(
				.topology = (enum accel_topology)(ACCEL_TOPOLOGY_TRIANGLES +
								  test_below(&seed, 3)),
				.vertices = 12, .position = { .data = position },
				.normal = { .data = test_below(&seed, 2) ? normal : NULL },
				.colour = { .data = test_below(&seed, 2) ? colour : NULL });

		for (int i = 0; i < 36; i++) {
			position[i / 3][i % 3] = random_float(&seed);
			normal[i / 3][i % 3] = random_float(&seed);
		}
		for (int i = 0; i < 48; i++)
			colour[i / 4][i % 4] = random_float(&seed);
		random_state(&seed, f->state);
		in_frame += !mesh_draw(f, &mesh);
		clear.mask = 1 + test_below(&seed, 3);
		if (in_frame && test_below(&seed, 3))
			accel_draw_clear(f->draw, &clear);
		if (n % 4 != 3)
			continue;
		assert_int_equal(accel_draw_finish(f->draw), 0);
		drawn += stats_of(f).records;
		taken += in_frame;
		in_frame = 0;
		assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	}
	print_message("%d of 3000 meshes were taken\n", taken);
	assert_true(taken > 1000 && drawn > 1000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		square_test(a_clear_with_a_wrong_argument_is_refused),
		square_test(a_mesh_that_is_none_is_refused),
		square_test(a_matrix_that_is_not_finite_draws_no_mesh),
		square_test(a_mesh_that_is_not_finite_is_refused_and_nothing_of_it_drawn),
		square_test(whatever_is_drawn_the_board_takes_it),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
