// SPDX-License-Identifier: MIT
#include <errno.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "matrix.h"
#include "mesh.h"
#include "phong.h"
#include "quality.h"

#define SIZE 64
#define SNAP 16

static unsigned int seed;

static void assert_close(double a, double b, double tolerance)
{
	if (fabs(a - b) > tolerance)
		fail_msg("%g is not %g", a, b);
}

/* A square of side 2 in the plane z = 0, in two triangles, with one normal. */
static const float square[4][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
static const uint32_t square_index[6] = { 0, 1, 2, 0, 2, 3 };

struct fixture {
	struct scene scene;
	struct phong_frame frame;
	float normal[4][3];
};

/* The square fills the picture, without perspective. */
static int setup(void **state)
{
	struct fixture *f = calloc(1, sizeof(*f));

	scene_init(&f->scene, SIZE, SIZE);
	for (int i = 0; i < 4; i++)
		f->normal[i][2] = 1;
	f->scene.mesh = (struct accel_mesh){
		.vertices = 4, .position = square, .normal = (const float(*)[3])f->normal,
		.indices = 6, .index = square_index,
	};
	f->scene.local_viewer = false;
	*state = f;
	return phong_frame_new(&f->scene, true, &f->frame);
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	phong_frame_free(&f->frame);
	free(f);
	return 0;
}

static const float *light_at(const struct fixture *f, int x, int y)
{
	return f->frame.light[y * SIZE + x];
}

static unsigned int covered(const struct phong_frame *frame)
{
	unsigned int pixels = 0;

	for (size_t i = 0; i < (size_t)frame->width * frame->height; i++)
		pixels += phong_covered(frame, i);
	return pixels;
}

/* ---- light ---- */

static void a_directional_light_gives_what_the_equation_says(void **state)
{
	struct fixture *f = *state;
	const double cosine = 1 / sqrt(2), half = sqrt((1 + cosine) / 2);

	f->scene.light[0] = scene_light_direction(1, 0, 1);
	f->scene.light[0].ambient[0] = 0.5f;
	f->scene.material[0] = scene_material_grey(0.1f, 0.6f, 0.3f, 20);
	f->scene.material[0].emission[0] = 0.05f;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(covered(&f->frame), SIZE * SIZE);
	for (int i = 0; i < SIZE * SIZE; i++) {
		double lit = 0.1 + 0.6 * cosine + 0.3 * pow(half, 20);

		assert_close(f->frame.light[i][0], lit + 0.05 + 0.5 * 0.1, 1e-5);
		assert_close(f->frame.light[i][1], lit, 1e-5);
		assert_int_equal(f->frame.pixel[i] >> 8 & 0xff, lround(lit * 255));
		assert_int_equal(f->frame.pixel[i] >> 24, 255);
	}
}

static void a_light_from_behind_gives_neither_diffuse_nor_specular(void **state)
{
	struct fixture *f = *state;

	f->scene.light[0] = scene_light_direction(1, 0, -0.001f);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, 5, 5)[0], 0.1, 1e-6);
}

static void light_is_not_clamped_but_pixels_are(void **state)
{
	struct fixture *f = *state;

	f->scene.material[0] = scene_material_grey(0.9f, 0.9f, 0, 0);
	f->scene.material[0].diffuse[3] = 0.5f;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, 9, 9)[2], 1.8, 1e-6);
	assert_int_equal(f->frame.pixel[9 * SIZE + 9], 0x80ffffff);
}

/* The square, tilted in perspective: each pixel's own ray says where it is and how far the lamp. */
static void positions_are_interpolated_with_perspective(void **state)
{
	struct fixture *f = *state;
	const double tilt = 60 * M_PI / 180, half = tan(20 * M_PI / 180);
	struct accel_light *lamp = &f->scene.light[0];

	*lamp = scene_light_point(0.3f, 0.2f, -2);
	lamp->attenuation[0] = 0.2f;
	lamp->attenuation[1] = 0.3f;
	lamp->attenuation[2] = 0.5f;
	lamp->ambient[0] = 1;
	f->scene.material[0] = scene_material_grey(0.5f, 0, 0, 1);
	memset(f->scene.ambient, 0, sizeof(f->scene.ambient));
	matrix_perspective(f->scene.projection, 40, 1, 1, 8);
	matrix_translate(f->scene.modelview, 0, 0, -4);
	matrix_rotate_y(f->scene.modelview, 60);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_true(covered(&f->frame) > 600);
	for (int i = 0; i < SIZE * SIZE; i++) {
		double x = ((i % SIZE + 0.5) / SIZE * 2 - 1) * half;
		double y = (1 - (i / SIZE + 0.5) / SIZE * 2) * half;
		/* The plane is x sin(tilt) + (z + 4) cos(tilt) = 0; the ray t (x, y, -1). */
		double t = 4 * cos(tilt) / (cos(tilt) - x * sin(tilt));
		double d = sqrt(pow(t * x - 0.3, 2) + pow(t * y - 0.2, 2) + pow(2 - t, 2));

		/* Vertices are moved to 1/16 pixel, which shifts it a little. */
		if (phong_covered(&f->frame, i))
			assert_close(f->frame.light[i][0], 0.5 / (0.2 + 0.3 * d + 0.5 * d * d),
				     3e-3);
	}
}

static void a_spot_shines_inside_its_cone_only(void **state)
{
	struct fixture *f = *state;
	struct accel_light *spot = &f->scene.light[0];

	*spot = scene_light_point(0, 0, 1);
	spot->spot_cutoff = 20;
	spot->spot_exponent = 8;
	f->scene.material[0] = scene_material_grey(0, 1, 0, 1);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	for (int x = 0; x < SIZE; x++) {
		double away = hypot((x + 0.5) / SIZE * 2 - 1, 0.5 / SIZE * 2);
		double cosine = 1 / hypot(1, away);
		double wanted = cosine > cos(20 * M_PI / 180) ? cosine * pow(cosine, 8) : 0;

		assert_close(light_at(f, x, SIZE / 2)[0], wanted, 1e-5);
	}
}

static void a_local_viewer_sees_the_highlight_from_the_eye(void **state)
{
	struct fixture *f = *state;
	double viewer[3], half[3], x = 10.5 / SIZE * 2 - 1, y = 1 - 50.5 / SIZE * 2, length;

	matrix_translate(f->scene.modelview, 0, 0, -0.5f);
	f->scene.material[0] = scene_material_grey(0, 0, 1, 15);
	f->scene.local_viewer = true;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	length = sqrt(x * x + y * y + 0.25);
	viewer[0] = -x / length;
	viewer[1] = -y / length;
	viewer[2] = 0.5 / length;
	memcpy(half, viewer, sizeof(half));
	half[2] += 1;
	length = sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
	assert_close(light_at(f, 10, 50)[0], pow(half[2] / length, 15), 1e-4);
}

static void normals_are_made_unit_length_at_each_pixel(void **state)
{
	struct fixture *f = *state;

	/* From the left to the right edge they turn by 90 degrees; their lengths do not count. */
	for (int i = 0; i < 4; i++) {
		f->normal[i][0] = square[i][0] * 5;
		f->normal[i][2] = 5;
	}
	f->scene.material[0] = scene_material_grey(0, 1, 0, 1);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	for (int x = 0; x < SIZE; x++) {
		double at = (x + 0.5) / SIZE * 2 - 1;

		assert_close(light_at(f, x, 3)[0], 1 / hypot(1, at), 1e-5);
	}
}

/* ---- faces ---- */

static void turn_round(struct fixture *f)
{
	matrix_rotate_y(f->scene.modelview, 180);
	f->scene.material[1] = scene_material_grey(0, 0.25f, 0, 1);
}

static void back_faces_have_their_own_material_and_turned_normals(void **state)
{
	struct fixture *f = *state;

	turn_round(f);
	f->scene.two_sided = true;
	f->scene.cull = ACCEL_CULL_NONE;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, 5, 5)[0], 0.25, 1e-6);
	f->scene.two_sided = false;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, 5, 5)[0], 0.1, 1e-6);
}

static void culled_faces_are_not_drawn(void **state)
{
	struct fixture *f = *state;

	f->scene.cull = ACCEL_CULL_FRONT;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(covered(&f->frame), 0);
	turn_round(f);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(covered(&f->frame), SIZE * SIZE);
	f->scene.cull = ACCEL_CULL_BACK;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(covered(&f->frame), 0);
}

static void strips_fans_and_lists_are_the_same_square(void **state)
{
	static const uint32_t strip[4] = { 0, 1, 3, 2 };
	static const enum accel_topology topology[] = { ACCEL_TRIANGLE_STRIP, ACCEL_TRIANGLE_FAN };
	struct fixture *f = *state;

	f->scene.mesh.indices = 4;
	f->scene.mesh.index = strip;
	for (int i = 0; i < 2; i++) {
		f->scene.mesh.topology = topology[i];
		assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
		assert_int_equal(covered(&f->frame), SIZE * SIZE);
		f->scene.mesh.index = NULL;
	}
}

static void an_index_out_of_range_is_refused(void **state)
{
	static const uint32_t bad[3] = { 0, 1, 4 };
	struct fixture *f = *state;

	f->scene.mesh.indices = 3;
	f->scene.mesh.index = bad;
	assert_int_equal(phong_draw(&f->scene, &f->frame), -EINVAL);
}

static void without_normals_a_face_has_its_own(void **state)
{
	struct fixture *f = *state;

	f->scene.mesh.normal = NULL;
	matrix_rotate_x(f->scene.modelview, 60);
	f->scene.material[0] = scene_material_grey(0, 1, 0, 1);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, SIZE / 2, SIZE / 2)[0], 0.5, 1e-5);
}

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
	f->scene.mesh.position = quad;
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
		{ -1, -1, 0.5f }, { 3, -1, 0.5f }, { -1, 3, 0.5f },
		{ -1, -1, -0.5f }, { 3, -1, -0.5f }, { -1, 3, -0.5f },
	};
	static const uint32_t order[2][6] = { { 0, 1, 2, 3, 4, 5 }, { 3, 4, 5, 0, 1, 2 } };
	struct fixture *f = *state;

	f->scene.mesh.position = position;
	f->scene.mesh.vertices = 6;
	f->scene.mesh.normal = NULL;
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

	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(scene_draw(&f->scene, ACCEL_SHADING_GOURAUD, board->draw, board->target,
				    NULL), 0);
	assert_int_equal(accel_target_read_colour(board->target, colour, SIZE * 4), 0);
	assert_int_equal(accel_target_read_depth(board->target, depth, SIZE * 4), 0);
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
	f->scene.mesh = (struct accel_mesh){
		.vertices = 60, .position = (const float(*)[3])position,
	};
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

#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		CASE(a_directional_light_gives_what_the_equation_says),
		CASE(a_light_from_behind_gives_neither_diffuse_nor_specular),
		CASE(light_is_not_clamped_but_pixels_are),
		CASE(positions_are_interpolated_with_perspective),
		CASE(a_spot_shines_inside_its_cone_only),
		CASE(a_local_viewer_sees_the_highlight_from_the_eye),
		CASE(normals_are_made_unit_length_at_each_pixel),
		CASE(back_faces_have_their_own_material_and_turned_normals),
		CASE(culled_faces_are_not_drawn),
		CASE(strips_fans_and_lists_are_the_same_square),
		CASE(an_index_out_of_range_is_refused),
		CASE(without_normals_a_face_has_its_own),
		CASE(triangles_that_share_an_edge_share_no_pixel),
		CASE(the_nearest_triangle_is_seen_whatever_the_order),
		CASE(the_library_covers_the_same_pixels),
		CASE(the_library_lights_flat_faces_alike),
		CASE(nmse_is_error_over_reference),
	};
	const char *given = getenv("GLOSS_SEED");

	seed = given ? (unsigned int)strtoul(given, NULL, 0) : (unsigned int)time(NULL);
	printf("test_phong: GLOSS_SEED=%u\n", seed);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
