// SPDX-License-Identifier: MIT
/* Which pixels are covered, the same in the library, and how far pictures are apart. */
#include <time.h>

#include "phong_square.h"
#include "scene/quality.h"

#define SNAP 16

static unsigned int seed;

/* ---- coverage ---- */

static float random_place(void)
{
	/* On the grid of 1/16 pixel, also outside of the picture. */
	return (float)(rand_r(&seed) % (SIZE * SNAP * 2) - SIZE * SNAP) / (SIZE * SNAP / 2);
}

static double cross(const float a[3], const float b[3], const float c[3])
{
	return ((double)b[0] - a[0]) * ((double)c[1] - a[1]) -
	       ((double)b[1] - a[1]) * ((double)c[0] - a[0]);
}

static void random_convex(float quad[4][3])
{
	bool convex;

	do {
		for (int i = 0; i < 4; i++) {
			quad[i][0] = random_place();
			quad[i][1] = random_place();
			quad[i][2] = 0;
		}
		convex = true;
		for (int i = 0; i < 4; i++)
			convex &= cross(quad[i], quad[(i + 1) % 4], quad[(i + 2) % 4]) > 0;
	} while (!convex);
}

static void add_cover(struct fixture *f, const float quad[4][3], const uint32_t index[3],
		      uint8_t *count)
{
	f->scene.mesh.position.data = quad;
	f->scene.mesh.index = index;
	f->scene.mesh.indices = 3;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	for (size_t i = 0; i < (size_t)SIZE * SIZE; i++)
		count[i] += phong_covered(&f->frame, i);
}

/* A quad cut along one diagonal or the other: no pixel twice, none lost. */
static void triangles_that_share_an_edge_share_no_pixel(void **state)
{
	static const uint32_t cut[4][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 1, 3 }, { 1, 2, 3 } };
	struct fixture *f = *state;

	for (int round = 0; round < 300; round++) {
		uint8_t one[SIZE * SIZE] = { 0 }, other[SIZE * SIZE] = { 0 };
		float quad[4][3];

		random_convex(quad);
		add_cover(f, (const float(*)[3])quad, cut[0], one);
		add_cover(f, (const float(*)[3])quad, cut[1], one);
		add_cover(f, (const float(*)[3])quad, cut[2], other);
		add_cover(f, (const float(*)[3])quad, cut[3], other);
		assert_memory_equal(one, other, sizeof(one));
		for (size_t i = 0; i < sizeof(one); i++)
			assert_true(one[i] <= 1);
	}
}

static void the_nearest_triangle_is_seen_whatever_the_order(void **state)
{
	static const float position[6][3] = {
		{ -1, -1, 0.5f },  { 3, -1, 0.5f },  { -1, 3, 0.5f },
		{ -1, -1, -0.5f }, { 3, -1, -0.5f }, { -1, 3, -0.5f },
	};
	static const uint32_t order[2][6] = { { 0, 1, 2, 3, 4, 5 }, { 3, 4, 5, 0, 1, 2 } };
	struct fixture *f = *state;

	f->scene.mesh.position.data = position;
	f->scene.mesh.vertices = 6;
	f->scene.mesh.normal.data = NULL;
	/* Without a projection that turns z, greater z is farther. */
	for (int i = 0; i < 2; i++) {
		f->scene.mesh.index = order[i];
		assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
		assert_close(f->frame.depth[SIZE * 8 + 8], 0.25, 1e-6);
	}
}

struct board {
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
};

static void compare_with_library(struct board *board, struct fixture *f, struct quality *quality)
{
	static uint32_t colour[SIZE * SIZE], depth[SIZE * SIZE];

	f->scene.keeps_depth = true;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(scene_draw(&f->scene, ACCEL_SHADING_GOURAUD, board->draw, board->target,
				    NULL),
			 0);
	assert_int_equal(accel_target_read(board->target, ACCEL_PLANE_COLOUR, NULL, colour,
					   SIZE * 4),
			 0);
	assert_int_equal(accel_target_read(board->target, ACCEL_PLANE_DEPTH, NULL, depth, SIZE * 4),
			 0);
	quality_add(quality, &f->frame, colour, depth);
}

static void open_board(struct board *board)
{
	assert_int_equal(accel_device_new("model:", NULL, NULL, &board->device), 0);
	assert_int_equal(accel_target_new(board->device, SIZE, SIZE, &board->target), 0);
	assert_int_equal(accel_draw_new(board->device, &board->draw), 0);
}

static void close_board(struct board *board)
{
	accel_draw_free(board->draw);
	accel_target_free(board->target);
	accel_device_free(board->device);
}

/* Also off the grid, in perspective, with edges and corners outside. */
static void the_library_covers_the_same_pixels(void **state)
{
	struct fixture *f = *state;
	struct quality quality = { 0 };
	float position[60][3];
	struct board board;

	open_board(&board);
	f->scene.cull = ACCEL_CULL_NONE;
	f->scene.mesh = (struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						      .vertices = 60,
						      .position = { .data = position });
	matrix_perspective(f->scene.projection, 40, 1, 1, 8);
	matrix_translate(f->scene.modelview, 0, 0, -4);
	for (int round = 0; round < 100; round++) {
		for (int i = 0; i < 180; i++)
			position[i / 3][i % 3] = (float)rand_r(&seed) / (float)RAND_MAX * 4 - 2;
		compare_with_library(&board, f, &quality);
	}
	close_board(&board);
	assert_true(quality.pixels > 100000);
	assert_int_equal(quality.stray, 0);
}

/* Flat faces under a light from afar: there is nothing to interpolate, so the colours agree. */
static void the_library_lights_flat_faces_alike(void **state)
{
	struct fixture *f = *state;
	struct quality quality = { 0 };
	struct board board;
	struct mesh mesh;

	open_board(&board);
	assert_int_equal(mesh_cube(&mesh), 0);
	f->scene.mesh = mesh_lend(&mesh);
	matrix_orthographic(f->scene.projection, 1, 1, 2, 6);
	matrix_translate(f->scene.modelview, 0, 0, -4);
	matrix_rotate_x(f->scene.modelview, 30);
	matrix_rotate_y(f->scene.modelview, 20);
	f->scene.light[3] = scene_light_direction(-3, 1, 1);
	compare_with_library(&board, f, &quality);
	mesh_free(&mesh);
	close_board(&board);
	assert_true(quality.pixels > 1000);
	assert_true(quality.worst < 0.52);
}

/* Under an even light a mesh's colours are all there is, and the library's are the same. */
static void colours_of_the_mesh_are_the_material(void **state)
{
	static const float colour[4][4] = {
		{ 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 }, { 2, 1, -1, 1 }
	};
	struct fixture *f = *state;
	struct quality quality = { 0 };
	struct board board;

	open_board(&board);
	f->scene.mesh.colour.data = colour;
	f->scene.material[0] = scene_material_grey(0.3f, 0, 0, 1);
	f->scene.light[0].enabled = false;
	f->scene.painted = true;
	compare_with_library(&board, f, &quality);
	close_board(&board);
	assert_int_equal(quality.pixels, SIZE * SIZE);
	assert_true(quality.worst < 1.1);
	/* Bottom left, where the first vertex is. */
	assert_close(light_at(f, 0, SIZE - 1)[0], 1 - 0.5 / SIZE, 1e-2);
	assert_close(light_at(f, 0, SIZE - 1)[2], 0, 1e-2);
	f->scene.painted = false;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, 5, 5)[2], 0.3, 1e-6);
}

/* ---- quality ---- */

static void nmse_is_error_over_reference(void **state)
{
	struct fixture *f = *state;
	struct quality quality = { 0 };
	static uint32_t colour[SIZE * SIZE], depth[SIZE * SIZE];

	f->scene.material[0] = scene_material_grey(0.8f, 0, 0, 1);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	/* 0.8 is 204; the left half is drawn as 102, one pixel not at all. */
	for (int i = 0; i < SIZE * SIZE; i++)
		colour[i] = i % SIZE < SIZE / 2 ? 0x666666 : 0xcccccc;
	depth[SIZE + 1] = 0xffffff;
	quality_add(&quality, &f->frame, colour, depth);
	assert_close(quality_nmse(&quality), 0.125, 1e-4);
	assert_close(quality.worst, 102, 1e-3);
	assert_int_equal(quality.stray, 1);
	assert_int_equal(quality.pixels, SIZE * SIZE - 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		CASE(triangles_that_share_an_edge_share_no_pixel),
		CASE(the_nearest_triangle_is_seen_whatever_the_order),
		CASE(the_library_covers_the_same_pixels),
		CASE(the_library_lights_flat_faces_alike),
		CASE(colours_of_the_mesh_are_the_material),
		CASE(nmse_is_error_over_reference),
	};
	const char *given = getenv("GLOSS_SEED");

	seed = given ? (unsigned int)strtoul(given, NULL, 0) : (unsigned int)time(NULL);
	printf("test_phong_cover: GLOSS_SEED=%u\n", seed);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
