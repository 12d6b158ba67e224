/* SPDX-License-Identifier: MIT */
/* The draw calls: what they take, refuse, and put on the target. */
#include <limits.h>

#include "decode/decode.h"
#include "draw_fixture.h"
#include "draw_mesh.h"

#define SIDE 96
#define WHITE 0xffffffffu
#define RED 0xff0000ffu
#define GREEN 0xff00ff00u

static uint32_t pixels[SIDE * SIDE], others[SIDE * SIDE];

static const float black[4] = { 0, 0, 0, 0 };

int __real_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence);
int __wrap_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence);

/* Every stream that these tests make, frames and transfers, is one that gloss-decode reads. */
int __wrap_accel_engine_submit(void *state, const struct accel_transport_job *job,
			       uint64_t *sequence)
{
	uint32_t *words = calloc(job->stream_words + 1, sizeof(*words));
	struct decode_packet last;

	assert_non_null(words);
	accel_transport_copy(job, words);
	assert_int_equal(decode_stream(words, job->stream_words, 0, &last), GLOSS_FAULT_NONE);
	free(words);
	return __real_accel_engine_submit(state, job, sequence);
}

/* Two triangles over the whole view, counter-clockwise. */
static const float square[4][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
static const uint32_t square_index[6] = { 0, 1, 2, 0, 2, 3 };

static int setup(void **state)
{
	struct accel_state *drawn;
	struct fixture *f;

	/* Identity: positions are NDC. */
	assert_int_equal(accel_state_new(&drawn), 0);
	f = fixture_new(SIDE, drawn);
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	*state = f;
	return 0;
}

static struct accel_mesh square_mesh(void)
{
	return (struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES, .vertices = 4,
					     .position = { .data = square }, .indices = 6,
					     .index = square_index);
}

static int mesh_draw(struct fixture *f, const struct accel_mesh *mesh)
{
	return accel_draw_mesh(f->draw, f->state, mesh);
}

/* Clears, draws and reads the colours. */
static void picture(struct fixture *f, const struct accel_mesh *mesh, uint32_t *colour)
{
	assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
	assert_int_equal(mesh_draw(f, mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, colour, SIDE * 4),
			 0);
}

static void assert_all(uint32_t wanted)
{
	for (int i = 0; i < SIDE * SIDE; i++)
		if (pixels[i] != wanted)
			fail_msg("pixel %d,%d is %08x, not %08x", i % SIDE, i / SIDE, pixels[i],
				 wanted);
}

static struct accel_draw_stats stats_of(const struct fixture *f)
{
	struct accel_draw_stats stats;

	accel_draw_stats(f->draw, &stats, sizeof(stats));
	return stats;
}

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

static void nothing_is_drawn_before_a_frame_was_begun(void **state)
{
	static const struct accel_clear depth = ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH);
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();
	struct accel_fence *fence = NULL;

	/* One was begun by setup. */
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
	assert_message(&f->messages, "a mesh without a frame: call accel_draw_begin first");
	assert_int_equal(accel_draw_clear(f->draw, &depth), -EINVAL);
	assert_message(&f->messages, "a clear without a frame");
	assert_int_equal(accel_draw_submit(f->draw, &fence), -EINVAL);
	assert_message(&f->messages, "a submit without a frame");
	assert_int_equal(accel_draw_finish(f->draw), -EINVAL);
	assert_null(fence);
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
	mesh.topology = (enum accel_topology)3;
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

static void a_frame_that_is_begun_forgets_the_one_before(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();
	struct accel_target *other;

	assert_int_equal(accel_target_new(f->device, 20, SIDE, &other), 0);
	assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(accel_draw_begin(f->draw, other, NULL), 0);
	assert_int_equal(stats_of(f).triangles_in, 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	/* The only reference to the target is that of the frame before. */
	accel_target_free(other);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	assert_all(0);
}

static void a_target_of_another_device_is_refused(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();
	struct messages messages;
	struct accel_device *device = device_open("model:", &messages);
	struct accel_target *other;

	assert_int_equal(accel_target_new(device, SIDE, SIDE, &other), 0);
	assert_int_equal(accel_draw_begin(f->draw, other, NULL), -EINVAL);
	assert_message(&f->messages, "another device");
	/* The frame that was begun before is still there. */
	assert_int_equal(mesh_draw(f, &mesh), 0);
	accel_target_free(other);
	accel_device_free(device);
}

/* ---- what is drawn ---- */

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

/* ---- frames ---- */

static void a_frame_without_anything_is_sent_and_does_nothing(void **state)
{
	struct fixture *f = *state;
	struct accel_fence *fence = NULL;
	struct accel_fence_status status;

	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(accel_draw_submit(f->draw, &fence), 0);
	assert_non_null(fence);
	assert_int_equal(accel_fence_wait(fence, -1, &status, sizeof(status)), 0);
	assert_int_equal(status.fault, 0);
	accel_fence_free(fence);
	assert_int_equal(stats_of(f).tiles, 0);
}

static void a_clear_happens_without_a_mesh(void **state)
{
	const float red[4] = { 1, 0, 0, 1 };
	struct fixture *f = *state;

	assert_int_equal(draw_begin(f->draw, f->target, red, 1), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	assert_all(RED);
}

static void counts_are_those_of_the_frame(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();

	picture(f, &mesh, pixels);
	assert_int_equal(stats_of(f).triangles_in, 2);
	assert_int_equal(stats_of(f).tiles, 4);
	assert_true(stats_of(f).records >= 4);
	assert_true(stats_of(f).stream_words > stats_of(f).records);
	/* Until the next frame begins. */
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(stats_of(f).triangles_in, 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(stats_of(f).triangles_in, 2);
	assert_int_equal(stats_of(f).tiles, 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(stats_of(f).triangles_in, 4);
}

/* The near plane cuts it, and what is left is between four pixels. */
static void a_triangle_that_clipping_leaves_nothing_of_counts_as_culled_once(void **state)
{
	static const float sliver[3][3] = { { 0.001f, 0.001f, -2 },
					    { 0.009f, 0.001f, 0 },
					    { 0.001f, 0.009f, 0 } };
	struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES, .vertices = 3,
					    .position = { .data = sliver });
	struct fixture *f = *state;

	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(stats_of(f).triangles_in, 1);
	assert_int_equal(stats_of(f).culled, 1);
	assert_int_equal(stats_of(f).clipped, 0);
}

static void a_target_may_go_before_its_frame_is_sent(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();
	struct accel_target *other;
	struct accel_fence *fence;

	assert_int_equal(accel_target_new(f->device, 300, 20, &other), 0);
	assert_int_equal(accel_draw_begin(f->draw, other, NULL), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), 0);
	accel_target_free(other);
	assert_int_equal(accel_draw_submit(f->draw, &fence), 0);
	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
	accel_fence_free(fence);
	/* And a draw may go with a frame in it. */
	assert_int_equal(accel_target_new(f->device, 300, 20, &other), 0);
	assert_int_equal(accel_draw_begin(f->draw, other, NULL), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), 0);
	accel_target_free(other);
}

static void free_takes_null(void **state)
{
	(void)state;
	accel_draw_free(NULL);
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
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, fixture_free)
		TEST(a_clear_with_a_wrong_argument_is_refused),
		TEST(a_mesh_that_is_none_is_refused),
		TEST(a_matrix_that_is_not_finite_draws_no_mesh),
		TEST(a_mesh_that_is_not_finite_is_refused_and_nothing_of_it_drawn),
		TEST(nothing_is_drawn_before_a_frame_was_begun),
		TEST(a_frame_that_is_begun_forgets_the_one_before),
		TEST(a_target_of_another_device_is_refused),
		TEST(without_colours_a_mesh_is_white),
		TEST(the_topologies_draw_the_same),
		TEST(a_long_strip_turns_no_triangle_over),
		TEST(what_is_left_over_of_three_is_not_drawn),
		TEST(flat_takes_the_colour_of_the_last_vertex),
		TEST(back_faces_have_their_own_material_if_they_are_two_sided),
		TEST(a_mesh_without_normals_is_lit_by_its_planes),
		TEST(viewport_and_scissor_bound_what_is_drawn),
		TEST(nothing_is_drawn_beside_the_viewport),
		TEST(a_rectangle_at_the_ends_of_int_draws_what_of_it_is_on_the_target),
		TEST(depth_functions_and_masks_are_kept),
		TEST(clear_values_are_rounded),
		TEST(a_frame_without_anything_is_sent_and_does_nothing),
		TEST(a_clear_happens_without_a_mesh),
		TEST(counts_are_those_of_the_frame),
		TEST(a_triangle_that_clipping_leaves_nothing_of_counts_as_culled_once),
		TEST(a_target_may_go_before_its_frame_is_sent),
		TEST(free_takes_null),
		TEST(whatever_is_drawn_the_board_takes_it),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
