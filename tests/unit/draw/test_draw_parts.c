/* SPDX-License-Identifier: MIT */
/*
 * Triangles split at random: whichever edges are split, and however deep, the parts draw the
 * pixels of the triangle once each, and no other, with its depth and the light there is.
 */
#include "draw_test.h"

#include "draw/group.h"

/* Chance decides what edges need, instead of light. */
static void chance_edges(const struct accel_pass *pass, const struct accel_group *group,
			 uint32_t first);

#define accel_shading_edges chance_edges
#include "draw/split.c"
#include "draw/face.c"

#define WIDTH 128
#define HEIGHT 2048

static uint8_t counts[2][WIDTH * HEIGHT];
static uint32_t colours[2][WIDTH * HEIGHT], depths[2][WIDTH * HEIGHT];
static uint64_t seed;
static uint32_t split_odds; /* in 16 */

/* A surface of second order all over the target, 0 to 1. */
static void surface_colour(int32_t x, int32_t y, float colour[3])
{
	float u = (float)x / (WIDTH * ACCEL_WINDOW_ONE), v = (float)y / (HEIGHT * ACCEL_WINDOW_ONE);

	colour[0] = 4 * u * (1 - u);
	colour[1] = (u - v) * (u - v);
	colour[2] = 0.2f + 0.5f * u - 0.3f * v * v + 0.4f * u * v;
}

static void chance_edges(const struct accel_pass *pass, const struct accel_group *group,
			 uint32_t first)
{
	(void)pass;
	for (uint32_t i = first; i < group->edges; i++) {
		const struct accel_vertex *a = &group->vertex[group->ends[i].a];
		const struct accel_vertex *b = &group->vertex[group->ends[i].b];
		struct accel_edge *edge = &group->edge[i];

		*edge = (struct accel_edge){
			.split = accel_patch_divisible(a, b) && test_below(&seed, 16) < split_odds,
			.sampled = true,
			.curved = true,
		};
		surface_colour((a->x + b->x) / 2, (a->y + b->y) / 2, edge->colour);
		memcpy(edge->middle.colour, edge->colour, sizeof(edge->colour));
		edge->middle.colour[3] = 1;
	}
}

struct fixture {
	struct accel_state *state;
	struct accel_bin bin;
	struct accel_draw_stats stats;
	struct accel_group group;
	struct accel_pass pass;
};

static int setup(void **state)
{
	static struct fixture f;

	memset(&f, 0, sizeof(f));
	seed = test_seed();
	assert_int_equal(accel_state_new(&f.state), 0);
	accel_bin_init(&f.bin, 64);
	f.pass = (struct accel_pass){
		.state = f.state, .group = &f.group, .bin = &f.bin, .stats = &f.stats
	};
	assert_int_equal(accel_group_reserve(&f.group, 0, 1), 0);
	f.pass.transform.window.visible = (struct accel_bounds){ 0, 0, WIDTH, HEIGHT };
	*state = &f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	accel_bin_free(&f->bin);
	accel_group_free(&f->group);
	accel_state_free(f->state);
	return 0;
}

/* As a face of a group, whose vertices are complete. */
static int draw_triangle(struct fixture *f, struct accel_vertex *const vertex[3])
{
	const struct accel_vertex *const corner[3] = { vertex[0], vertex[1], vertex[2] };
	struct accel_face *face = accel_group_face(&f->group);
	int err = 0;

	*face = (struct accel_face){ .clipped = true };
	for (int i = 0; i < 3; i++) {
		face->vertex[i] = accel_group_vertex(&f->group, 0);
		f->group.vertex[face->vertex[i]] = *vertex[i];
	}
	if (accel_setup_init(&face->setup, corner))
		err = accel_face_draw_all(&f->pass);
	accel_group_reset(&f->group);
	return err;
}

/* Draws the triangle whole (0) or in parts (1), and counts; returns how many parts there were. */
static uint64_t draw_counted(struct fixture *f, struct accel_vertex *const vertex[3], uint32_t odds,
			     int which)
{
	struct coverage coverage = { WIDTH, HEIGHT, counts[which], 0, 0 };
	struct picture picture = { WIDTH, colours[which], depths[which] };

	split_odds = odds;
	f->stats = (struct accel_draw_stats){ 0 };
	memset(counts[which], 0, WIDTH * HEIGHT);
	assert_int_equal(accel_bin_begin(&f->bin, WIDTH, HEIGHT), 0);
	accel_bin_state(&f->bin, f->state, &f->pass.transform.window.visible);
	assert_int_equal(draw_triangle(f, vertex), 0);
	records_of_bin(&f->bin, coverage_record, &coverage);
	records_of_bin(&f->bin, picture_record, &picture);
	assert_int_equal(coverage.empty, 0);
	return f->stats.flat + f->stats.linear + f->stats.second_order;
}

static bool near(uint32_t a, uint32_t b)
{
	for (int i = 0; i < 32; i += 8)
		if (abs((int)(a >> i & 0xff) - (int)(b >> i & 0xff)) > 1)
			return false;
	return true;
}

static uint64_t check(struct fixture *f, struct accel_vertex node[3], uint32_t odds)
{
	struct accel_vertex *const vertex[3] = { &node[0], &node[1], &node[2] };
	uint64_t parts;

	for (int i = 0; i < 3; i++) {
		surface_colour(node[i].x, node[i].y, node[i].sample.colour);
		node[i].sample.colour[3] = 1;
		node[i].z = (double)test_unit(&seed);
	}
	draw_counted(f, vertex, 0, 0);
	parts = draw_counted(f, vertex, odds, 1);
	if (memcmp(counts[0], counts[1], sizeof(counts[0])) != 0)
		fail_msg("(%d,%d) (%d,%d) (%d,%d): %llu parts draw other pixels", node[0].x,
			 node[0].y, node[1].x, node[1].y, node[2].x, node[2].y,
			 (unsigned long long)parts);
	for (int i = 0; i < WIDTH * HEIGHT; i++)
		if (counts[0][i]) {
			assert_int_equal(depths[0][i], depths[1][i]);
			if (!near(colours[0][i], colours[1][i]))
				fail_msg("pixel %d,%d is %08x whole, %08x in parts", i % WIDTH,
					 i / WIDTH, colours[0][i], colours[1][i]);
		}
	return parts;
}

static void parts_of_random_triangles_cover_the_triangle(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex node[3];
	uint64_t parts = 0;

	for (int n = 0; n < 1500; n++) {
		int size = 1 << test_between(&seed, 4, 12);

		for (int i = 0; i < 3; i++)
			node[i] = vertex_at(test_between(&seed, 0, size),
					    test_between(&seed, 0, size));
		if (accel_surface_area(&node[0], &node[1], &node[2]))
			parts += check(f, node, (uint32_t)test_between(&seed, 2, 12));
	}
	assert_true(parts > 5000);
}

/* As tall as edges can be: the height of an edge from a midpoint has digits too many. */
static void parts_of_tall_triangles_cover_the_triangle(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex node[3];
	uint64_t parts = 0;

	for (int n = 0; n < 300; n++) {
		node[0] = vertex_at(test_between(&seed, 0, WIDTH * 16), 0);
		node[1] = vertex_at(test_between(&seed, 0, WIDTH * 16), HEIGHT * 16);
		node[2] = vertex_at(test_between(&seed, 0, WIDTH * 16), test_between(&seed, 0, 3));
		if (accel_surface_area(&node[0], &node[1], &node[2]))
			parts += check(f, node, 4);
	}
	assert_true(parts > 1000);
}

static void splitting_ends_at_the_last_level(void **state)
{
	struct fixture *f = *state;
	struct accel_vertex node[3] = { vertex_at(0, 0), vertex_at(0, 8192),
					vertex_at(2048, 8192) };

	/* Every edge, at every level. */
	assert_int_equal(check(f, node, 16), 4096);
	assert_int_equal(f->stats.split, 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(parts_of_random_triangles_cover_the_triangle, setup,
						teardown),
		cmocka_unit_test_setup_teardown(parts_of_tall_triangles_cover_the_triangle, setup,
						teardown),
		cmocka_unit_test_setup_teardown(splitting_ends_at_the_last_level, setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
