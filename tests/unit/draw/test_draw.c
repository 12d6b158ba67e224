/* SPDX-License-Identifier: MIT */
/* What a mesh puts on the target: its topology, state and viewport, each seen on a square. */
#include <limits.h>

#include "accel_priv.h"
#include "draw_square.h"

static void without_colours_a_mesh_is_white(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();

	picture(f, &mesh, pixels);
	assert_all(WHITE);
	assert_int_equal(stats_of(f).flat, 2);
}

static void the_topologies_draw_the_same(void **state)
{
	struct fixture *f = *state;
	const uint32_t strip_index[4] = { 0, 1, 3, 2 };
	float colour[4][4];
	struct accel_mesh mesh = square_mesh();
	uint64_t seed = test_seed();

	for (int i = 0; i < 16; i++)
		colour[i / 4][i % 4] = (float)test_below(&seed, 100) / 300 + 0.33f;
	/* The strip has the square's other diagonal, which a plane of colours does not show. */
	for (int i = 0; i < 4; i++)
		colour[2][i] = colour[1][i] + colour[3][i] - colour[0][i];
	mesh.colour.data = colour;
	accel_state_set_shading(f->state, ACCEL_SHADING_GOURAUD);
	accel_state_set_cull(f->state, ACCEL_CULL_BACK);
	picture(f, &mesh, pixels);
	mesh.topology = ACCEL_TOPOLOGY_TRIANGLE_FAN;
	mesh.index = NULL;
	picture(f, &mesh, others);
	assert_memory_equal(pixels, others, sizeof(pixels));
	mesh.topology = ACCEL_TOPOLOGY_TRIANGLE_STRIP;
	mesh.index = strip_index;
	mesh.indices = 4;
	picture(f, &mesh, others);
	for (int i = 0; i < SIDE * SIDE; i++)
		for (int byte = 0; byte < 32; byte += 8) {
			int a = pixels[i] >> byte & 0xff, b = others[i] >> byte & 0xff;

			assert_true(abs(a - b) <= 1);
		}
	assert_int_equal(stats_of(f).culled, 0);
	assert_int_equal(stats_of(f).linear, 2);
}

static void a_long_strip_turns_no_triangle_over(void **state)
{
	struct fixture *f = *state;
	float position[20][3];
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLE_STRIP,
						  .vertices = 20, .position = { .data = position });

	for (int i = 0; i < 20; i++) {
		position[i][0] = -1 + 2 * (float)(i / 2) / 9;
		position[i][1] = i % 2 ? -1 : 1;
		position[i][2] = 0;
	}
	accel_state_set_cull(f->state, ACCEL_CULL_BACK);
	picture(f, &mesh, pixels);
	assert_all(WHITE);
	accel_state_set_cull(f->state, ACCEL_CULL_FRONT);
	picture(f, &mesh, pixels);
	assert_all(0);
	assert_int_equal(stats_of(f).culled, 18);
}

static void what_is_left_over_of_three_is_not_drawn(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();

	mesh.indices = 5;
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(stats_of(f).triangles_in, 1);
	mesh.indices = 2;
	assert_int_equal(mesh_draw(f, &mesh), 0);
	mesh.indices = 0;
	assert_int_equal(mesh_draw(f, &mesh), 0);
	mesh.index = NULL;
	mesh.vertices = 0;
	mesh.topology = ACCEL_TOPOLOGY_TRIANGLE_FAN;
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(stats_of(f).triangles_in, 1);
}

static void flat_takes_the_colour_of_the_last_vertex(void **state)
{
	struct fixture *f = *state;
	const float colour[4][4] = {
		{ 1, 1, 1, 1 }, { 1, 1, 1, 1 }, { 1, 0, 0, 1 }, { 1, 0, 0, 1 }
	};
	struct accel_mesh mesh = square_mesh();

	mesh.colour.data = colour;
	accel_state_set_shading(f->state, ACCEL_SHADING_FLAT);
	picture(f, &mesh, pixels);
	assert_all(RED);
	assert_int_equal(stats_of(f).flat, 2);
}

static void back_faces_have_their_own_material_if_they_are_two_sided(void **state)
{
	struct fixture *f = *state;
	const float normal[4][3] = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 } };
	const uint32_t turned[6] = { 2, 1, 0, 3, 2, 0 };
	const struct accel_material front = ACCEL_MATERIAL(.emission = { 1, 0, 0, 1 },
							   .diffuse[3] = 1);
	const struct accel_material back = ACCEL_MATERIAL(.emission = { 0, 1, 0, 1 },
							  .diffuse[3] = 1);
	struct accel_mesh mesh = square_mesh();

	mesh.normal.data = normal;
	assert_int_equal(accel_state_set_material(f->state, &front, &back), 0);
	accel_state_set_lighting(f->state, true);
	accel_state_set_two_sided(f->state, true);
	picture(f, &mesh, pixels);
	assert_all(RED);
	mesh.index = turned;
	picture(f, &mesh, pixels);
	assert_all(GREEN);
	accel_state_set_two_sided(f->state, false);
	picture(f, &mesh, pixels);
	assert_all(RED);
}

/* A pyramid's side without normals is as bright as its own plane says. */
static void a_mesh_without_normals_is_lit_by_its_planes(void **state)
{
	struct fixture *f = *state;
	const float slope[4][3] = { { -1, -1, 1 }, { 1, -1, 1 }, { 1, 1, -1 }, { -1, 1, -1 } };
	const float normal[4][3] = { { 0, 1, 1 }, { 0, 1, 1 }, { 0, 1, 1 }, { 0, 1, 1 } };
	struct accel_mesh mesh = square_mesh();
	struct accel_light light = f->state->light[0];

	light.enabled = true;
	assert_int_equal(accel_state_set_light(f->state, 0, &light), 0);
	accel_state_set_lighting(f->state, true);
	accel_state_set_local_viewer(f->state, false);
	mesh.position.data = slope;
	picture(f, &mesh, pixels);
	mesh.normal.data = normal;
	picture(f, &mesh, others);
	assert_memory_equal(pixels, others, sizeof(pixels));
	assert_true((pixels[0] & 0xff) > 100 && (pixels[0] & 0xff) < 200);
}

static void viewport_and_scissor_bound_what_is_drawn(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();

	accel_state_set_viewport(f->state, -20, 10, 60, 70);
	accel_state_set_scissor(f->state, 8, 0, 60, 50);
	picture(f, &mesh, pixels);
	for (int i = 0; i < SIDE * SIDE; i++) {
		int x = i % SIDE, y = i / SIDE;
		bool inside = x >= 8 && x < 40 && y >= 10 && y < 50;

		assert_int_equal(pixels[i], inside ? WHITE : 0);
	}
	accel_state_set_viewport(f->state, 0, 0, 0, 0);
	picture(f, &mesh, pixels);
	assert_all(0);
}

/* The mesh is twice the viewport; the pixels beside it are not the mesh's. */
static void nothing_is_drawn_beside_the_viewport(void **state)
{
	struct fixture *f = *state;
	float wide[4][3];
	struct accel_mesh mesh = square_mesh();

	for (int i = 0; i < 12; i++)
		wide[i / 3][i % 3] = 2 * square[i / 3][i % 3];
	mesh.position.data = wide;
	accel_state_set_viewport(f->state, 30, 40, 20, 10);
	picture(f, &mesh, pixels);
	for (int i = 0; i < SIDE * SIDE; i++) {
		int x = i % SIDE, y = i / SIDE;

		assert_int_equal(pixels[i], x >= 30 && x < 50 && y >= 40 && y < 50 ? WHITE : 0);
	}
}

/* The mesh reaches far beside the target: what is visible is all that keeps it inside. */
static void a_rectangle_at_the_ends_of_int_draws_what_of_it_is_on_the_target(void **state)
{
	static const int end[] = {
		INT_MIN, INT_MIN + 1, -SIDE, -1, 0, 1, SIDE, INT_MAX - 1, INT_MAX
	};
	struct fixture *f = *state;
	float wide[4][3];
	struct accel_mesh mesh = square_mesh();

	for (int i = 0; i < 12; i++)
		wide[i / 3][i % 3] = 9 * square[i / 3][i % 3];
	mesh.position.data = wide;
	for (int n = 0; n < 9 * 9 * 9; n++) {
		int from = end[n % 9], size = end[n / 9 % 9], across = end[n / 81];
		int64_t last = (int64_t)from + size;
		bool all = from <= 0 && size > 0 && last >= SIDE && across >= SIDE;

		accel_state_set_scissor(f->state, 0, from, across < 0 ? 0 : across, size);
		picture(f, &mesh, pixels);
		assert_int_equal(pixels[0] == WHITE,
				 from <= 0 && size > 0 && last > 0 && across > 0);
		if (all)
			assert_all(WHITE);
		if (size <= 0 || last <= 0 || from >= SIDE || across <= 0) {
			assert_all(0);
			assert_int_equal(stats_of(f).records, 0);
		}
	}
	for (int n = 0; n < 9 * 9 * 9; n++) {
		accel_state_set_scissor(f->state, 0, 0, -1, -1);
		accel_state_set_viewport(f->state, end[n % 9], end[n / 9 % 9], SIDE, end[n / 81]);
		assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
		assert_int_equal(mesh_draw(f, &mesh), 0);
		assert_int_equal(accel_draw_finish(f->draw), 0);
		if (end[n / 81] <= 0)
			assert_int_equal(stats_of(f).culled, 2);
	}
}

static void depth_functions_and_masks_are_kept(void **state)
{
	struct fixture *f = *state;
	float near[4][3];
	const float red[4][4] = { { 1, 0, 0, 1 }, { 1, 0, 0, 1 }, { 1, 0, 0, 1 }, { 1, 0, 0, 1 } };
	struct accel_mesh mesh = square_mesh(), front = square_mesh();

	memcpy(near, square, sizeof(near));
	for (int i = 0; i < 4; i++)
		near[i][2] = -0.5f;
	front.position.data = near;
	front.colour.data = red;
	accel_state_set_depth(f->state, ACCEL_COMPARE_LESS, true);
	assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
	assert_int_equal(mesh_draw(f, &front), 0);
	picture(f, &mesh, others);
	/* picture cleared both; behind red, white is not seen. */
	assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
	assert_int_equal(mesh_draw(f, &front), 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	assert_all(RED);
	/* In the next frame what was drawn is still there. */
	accel_state_set_depth(f->state, ACCEL_COMPARE_GREATER, false);
	accel_state_set_colour_mask(f->state, false, false, true, false);
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	assert_all(RED | 0xff0000);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_DEPTH, NULL, pixels, SIDE * 4),
			 0);
	assert_all(0x3fffff + 1);
}

static void clear_values_are_rounded(void **state)
{
	struct fixture *f = *state;
	const float rgba[4] = { 0.5f, -3, 7, 1 / 255.0f };
	struct accel_mesh nothing = square_mesh();

	nothing.indices = 0;
	assert_int_equal(draw_begin(f->draw, f->target, rgba, 0.5f), 0);
	assert_int_equal(mesh_draw(f, &nothing), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	assert_all(0x01ff0080);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_DEPTH, NULL, pixels, SIDE * 4),
			 0);
	assert_all(0x800000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		square_test(without_colours_a_mesh_is_white),
		square_test(the_topologies_draw_the_same),
		square_test(a_long_strip_turns_no_triangle_over),
		square_test(what_is_left_over_of_three_is_not_drawn),
		square_test(flat_takes_the_colour_of_the_last_vertex),
		square_test(back_faces_have_their_own_material_if_they_are_two_sided),
		square_test(a_mesh_without_normals_is_lit_by_its_planes),
		square_test(viewport_and_scissor_bound_what_is_drawn),
		square_test(nothing_is_drawn_beside_the_viewport),
		square_test(a_rectangle_at_the_ends_of_int_draws_what_of_it_is_on_the_target),
		square_test(depth_functions_and_masks_are_kept),
		square_test(clear_values_are_rounded),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
