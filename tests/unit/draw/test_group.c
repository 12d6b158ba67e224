/* SPDX-License-Identifier: MIT */
/* Triangles that are worked together: what they share is found once, and no picture tells. */
#include "draw/group.h"
#include "draw_mesh.h"
#include "draw_test.h"

#define SIDE 512
#define ACROSS 150 /* squares of a grid, so that its triangles are more than a group's */

static struct accel_face *put(struct accel_group *group, uint32_t a, uint32_t b, uint32_t c,
			      int side)
{
	struct accel_face *face = accel_group_face(group);

	*face = (struct accel_face){ .vertex = { a, b, c }, .side = side };
	return face;
}

static void reserve(struct accel_group *group, uint32_t vertices)
{
	*group = (struct accel_group){ .faces = 0 };
	assert_int_equal(accel_group_reserve(group, vertices, 10), 0);
}

static void a_shared_edge_and_its_vertices_are_found_once(void **unused)
{
	struct accel_group group;
	struct accel_face *a, *b;

	(void)unused;
	reserve(&group, 100);
	a = put(&group, 90, 7, 40, 0);
	b = put(&group, 40, 7, 3, 0);
	accel_group_link(&group, true);
	accel_group_link_edges(&group, a);
	accel_group_link_edges(&group, b);
	assert_int_equal(group.vertices, 4);
	assert_int_equal(group.edges, 5);
	assert_int_equal(a->edge[1], b->edge[0]);
	for (int i = 0; i < 3; i++)
		assert_int_equal(group.link[b->vertex[i]].index, ((int[]){ 40, 7, 3 })[i]);
	assert_int_equal(a->flat, a->vertex[2]);
	/* The next group knows nothing of it. */
	accel_group_reset(&group);
	for (int i = 0; i < 100; i++)
		assert_int_equal(group.of[i], ACCEL_NONE);
	accel_group_free(&group);
}

static void a_vertex_seen_from_both_sides_is_two(void **unused)
{
	struct accel_group group;
	struct accel_face *a, *b, *c;

	(void)unused;
	reserve(&group, 4);
	a = put(&group, 0, 1, 2, 0);
	b = put(&group, 2, 1, 3, 1);
	c = put(&group, 1, 2, 3, 1);
	accel_group_link(&group, true);
	for (int i = 0; i < 2; i++)
		accel_group_link_edges(&group, &group.face[i]);
	assert_int_equal(group.vertices, 6);
	assert_int_equal(group.edges, 6);
	assert_int_not_equal(a->vertex[1], b->vertex[1]);
	assert_int_equal(b->vertex[1], c->vertex[0]);
	assert_int_equal(group.link[b->vertex[1]].side, 1);
	accel_group_free(&group);
}

static void faces_without_normals_share_nothing(void **unused)
{
	struct accel_group group;

	(void)unused;
	reserve(&group, 4);
	put(&group, 0, 1, 2, 0);
	put(&group, 2, 1, 3, 0);
	accel_group_link(&group, false);
	for (int i = 0; i < 2; i++)
		accel_group_link_edges(&group, &group.face[i]);
	assert_int_equal(group.vertices, 6);
	assert_int_equal(group.edges, 6);
	accel_group_free(&group);
}

/* ---- a mesh of more faces than a group has ---- */

static uint64_t checksum;

int __real_accel_stream_lend(struct accel_stream *stream, const uint32_t *words, size_t count);
int __wrap_accel_stream_lend(struct accel_stream *stream, const uint32_t *words, size_t count);

int __wrap_accel_stream_lend(struct accel_stream *stream, const uint32_t *words, size_t count)
{
	for (size_t i = 0; i < count; i++) {
		uint64_t mixed = checksum ^ words[i];

		checksum = test_random(&mixed);
	}
	return __real_accel_stream_lend(stream, words, count);
}

struct grid {
	float position[(ACROSS + 1) * (ACROSS + 1)][3], normal[(ACROSS + 1) * (ACROSS + 1)][3];
	uint32_t index[ACROSS * ACROSS][6];
};

/* A square with bumps, all over the window. */
static void grid_init(struct grid *grid)
{
	const uint32_t row = ACROSS + 1;

	for (uint32_t i = 0; i < row * row; i++) {
		float x = (float)(i % row) / ACROSS, y = (float)(i / row) / ACROSS;

		memcpy(grid->position[i], (const float[3]){ 2 * x - 1, 2 * y - 1, 0 },
		       sizeof(grid->position[i]));
		memcpy(grid->normal[i], (const float[3]){ sinf(30 * x), sinf(20 * y), 1 },
		       sizeof(grid->normal[i]));
	}
	for (uint32_t i = 0; i < ACROSS * ACROSS; i++) {
		uint32_t at = i / ACROSS * row + i % ACROSS;

		memcpy(grid->index[i],
		       (const uint32_t[6]){ at, at + 1, at + row, at + row, at + 1, at + row + 1 },
		       sizeof(grid->index[i]));
	}
}

/* The checksum of its frame, drawn by @calls, each with its part of the mesh. */
static uint64_t grid_draw(const struct grid *grid, struct accel_device *device, uint32_t calls)
{
	struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
					    .vertices = (ACROSS + 1) * (ACROSS + 1),
					    .position = { .data = grid->position },
					    .normal = { .data = grid->normal },
					    .indices = 6 * ACROSS * ACROSS / calls);
	const float identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
	struct accel_state *state = state_shiny(60);
	struct accel_draw_stats stats;
	struct accel_target *target;
	struct accel_draw *draw;

	accel_state_set_modelview(state, identity);
	accel_state_set_projection(state, identity);
	assert_int_equal(accel_target_new(device, SIDE, SIDE, &target), 0);
	assert_int_equal(accel_draw_new(device, &draw), 0);
	assert_int_equal(draw_begin(draw, target, (const float[4]){ 0 }, 1), 0);
	for (uint32_t i = 0; i < calls; i++) {
		mesh.index = grid->index[0] + i * mesh.indices;
		assert_int_equal(accel_draw_mesh(draw, state, &mesh), 0);
	}
	checksum = 0;
	assert_int_equal(accel_draw_finish(draw), 0);
	accel_draw_stats(draw, &stats, sizeof(stats));
	assert_true(stats.flat + stats.linear + stats.second_order > ACCEL_GROUP_FACES);
	accel_draw_free(draw);
	accel_target_free(target);
	accel_state_free(state);
	return checksum;
}

static void a_mesh_of_several_groups_is_drawn_as_its_parts_are(void **unused)
{
	static struct grid grid;
	struct messages messages;
	struct accel_device *device = device_open("model:", &messages);

	(void)unused;
	grid_init(&grid);
	assert_int_equal(grid_draw(&grid, device, 1), grid_draw(&grid, device, 30));
	accel_device_free(device);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_shared_edge_and_its_vertices_are_found_once),
		cmocka_unit_test(a_vertex_seen_from_both_sides_is_two),
		cmocka_unit_test(faces_without_normals_share_nothing),
		cmocka_unit_test(a_mesh_of_several_groups_is_drawn_as_its_parts_are),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
