// SPDX-License-Identifier: MIT
/* Where the eye and the lights are. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "view/camera.c"

/* A box around (1, 2, 3), 8 wide, 6 high, 2 deep. */
static float corners[8][3];

static void set_up(struct view *view, struct view_options *options, int width, int height,
		   float fov)
{
	static const float half[3] = { 4, 3, 1 }, middle[3] = { 1, 2, 3 };

	memset(view, 0, sizeof(*view));
	memset(options, 0, sizeof(*options));
	options->width = width;
	options->height = height;
	options->zoom = 1;
	options->fov = fov;
	view->options = options;
	view->mesh.vertices = 8;
	view->mesh.position = corners;
	for (int i = 0; i < 8; i++)
		for (int axis = 0; axis < 3; axis++)
			corners[i][axis] = middle[axis] + (i >> axis & 1 ?
								   half :
								   (float[3]){ -half[0], -half[1],
									       -half[2] })[axis];
	mesh_bounds(&view->mesh, view->centre, &view->radius);
}

static void look_from(struct view *view, float turn)
{
	view_camera_frame(view);
	view_camera_set(view, turn);
}

/* Where the eye sees a point: NDC. */
static void look(const struct view *view, const float point[3], float out[3])
{
	float eye[4], clip[4];

	matrix_transform(eye, view->scene.modelview, point);
	matrix_transform(clip, view->scene.projection, eye);
	for (int i = 0; i < 3; i++)
		out[i] = clip[i] / clip[3];
}

/* The least and the greatest of what is seen of the corners. */
static void extent(const struct view *view, float low[3], float high[3])
{
	for (int axis = 0; axis < 3; axis++) {
		low[axis] = INFINITY;
		high[axis] = -INFINITY;
	}
	for (int i = 0; i < 8; i++) {
		float at[3];

		look(view, corners[i], at);
		for (int axis = 0; axis < 3; axis++) {
			low[axis] = fminf(low[axis], at[axis]);
			high[axis] = fmaxf(high[axis], at[axis]);
		}
	}
}

/* It is in the middle, and one of its sides is near the border. */
static void the_mesh_fits_any_shape_of_picture_from_any_side(void **state)
{
	static const int sizes[][2] = { { 640, 480 }, { 300, 300 }, { 100, 400 }, { 900, 20 } };
	static const float fovs[] = { 0, 1, 30, 120 };
	static const float cameras[][2] = { { 0, 0 }, { 30, 20 }, { 90, 0 }, { 200, -70 } };
	struct view_options options;
	struct view view;

	(void)state;
	for (int i = 0; i < 64; i++) {
		float low[3], high[3];

		set_up(&view, &options, sizes[i / 16][0], sizes[i / 16][1], fovs[i / 4 % 4]);
		memcpy(options.camera, cameras[i % 4], sizeof(options.camera));
		look_from(&view, 0);
		extent(&view, low, high);
		for (int axis = 0; axis < 3; axis++)
			assert_true(low[axis] >= -1 && high[axis] <= 1);
		assert_true(fmaxf(high[0], high[1]) > 0.9f);
		for (int axis = 0; axis < 2; axis++)
			if (high[axis] > 0.9f)
				assert_true(fabsf(low[axis] + high[axis]) < 1e-3f);
	}
}

static void a_turntable_fits_in_all_its_frames(void **state)
{
	struct view_options options;
	struct view view;
	float most = 0;

	(void)state;
	set_up(&view, &options, 640, 480, 30);
	options.camera[1] = 20;
	options.turntable = 12;
	for (int i = 0; i < 12; i++) {
		float low[3], high[3];

		look_from(&view, (float)i * 30);
		extent(&view, low, high);
		for (int axis = 0; axis < 2; axis++) {
			assert_true(low[axis] >= -1 && high[axis] <= 1);
			most = fmaxf(most, high[axis]);
		}
	}
	assert_true(most > 0.9f);
}

/* A needle that points at the eye would let it come too near. */
static void the_eye_keeps_its_distance(void **state)
{
	struct view_options options;
	struct view view;
	float low[3], high[3];

	(void)state;
	set_up(&view, &options, 100, 100, 30);
	for (int i = 0; i < 8; i++)
		corners[i][0] = corners[i][1] = 0;
	mesh_bounds(&view.mesh, view.centre, &view.radius);
	look_from(&view, 0);
	extent(&view, low, high);
	assert_true(low[2] > -1 && high[2] < 1);
}

static void the_camera_goes_right_and_up_around_the_mesh(void **state)
{
	const float right[3] = { 5, 2, 3 }, top[3] = { 1, 5, 3 };
	struct view_options options;
	struct view view;
	float at[3];

	(void)state;
	/* From the right, its right side is in the middle, and in front. */
	set_up(&view, &options, 100, 100, 0);
	options.camera[0] = 90;
	look_from(&view, 0);
	look(&view, right, at);
	assert_true(fabsf(at[0]) < 1e-5f && at[2] < -0.7f);
	/* From above, its top. */
	options.camera[0] = 0;
	options.camera[1] = 90;
	look_from(&view, 0);
	look(&view, top, at);
	assert_true(fabsf(at[1]) < 1e-5f && at[2] < -0.5f);
}

static void what_is_up_in_the_mesh_is_up_in_the_picture(void **state)
{
	static const struct {
		float upright[2], up[3];
	} axes[] = {
		{ { 0, 90 }, { 5, 2, 3 } },
		{ { -90, 0 }, { 1, 2, 4 } },
		{ { 0, 180 }, { 1, -1, 3 } },
	};
	struct view_options options;
	struct view view;
	float at[3];

	(void)state;
	for (int i = 0; i < 3; i++) {
		set_up(&view, &options, 100, 100, 0);
		memcpy(options.upright, axes[i].upright, sizeof(options.upright));
		look_from(&view, 0);
		look(&view, axes[i].up, at);
		assert_true(fabsf(at[0]) < 1e-5f && at[1] > 0.15f);
	}
}

static void a_turn_shows_the_left_side(void **state)
{
	const float left[3] = { -3, 2, 3 };
	struct view_options options;
	struct view view;
	float at[3];

	(void)state;
	set_up(&view, &options, 100, 100, 0);
	look_from(&view, 90);
	look(&view, left, at);
	assert_true(fabsf(at[0]) < 1e-5f && at[2] < -0.7f);
}

/* Forwards through the front face: what is behind the eye is clipped, what is inside is seen. */
static void the_eye_flies_into_the_mesh_and_looks_around(void **state)
{
	const float middle[3] = { 1, 2, 3 }, right[3] = { 5, 2, 3 };
	struct view_options options;
	struct view view;
	float at[3];

	(void)state;
	set_up(&view, &options, 100, 100, 30);
	view_camera_frame(&view);
	view.hand.move[2] = -view.eye[2] + 0.1f;
	view_camera_set(&view, 0);
	look(&view, middle, at);
	assert_true(fabsf(at[0]) < 1e-4f && at[2] > -1 && at[2] < 1);
	/* A quarter to the right, the right wall is ahead. */
	view.hand.move[2] = -view.eye[2];
	view.hand.look = 90;
	view_camera_set(&view, 0);
	look(&view, right, at);
	assert_true(fabsf(at[0]) < 1e-4f && fabsf(at[1]) < 1e-4f && at[2] > -1 && at[2] < 1);
}

static void zoom_enlarges_and_keeps_the_middle(void **state)
{
	const float middle[3] = { 1, 2, 3 }, top[3] = { 1, 5, 3 };
	struct view_options options;
	struct view view;
	float at[3], near[3];

	(void)state;
	set_up(&view, &options, 100, 100, 30);
	look_from(&view, 0);
	look(&view, top, at);
	options.zoom = 3;
	look_from(&view, 0);
	look(&view, top, near);
	assert_true(fabsf(near[1] - 3 * at[1]) < 1e-5f);
	look(&view, middle, near);
	assert_true(fabsf(near[0]) < 1e-5f && fabsf(near[1]) < 1e-5f);
}

/* Lights are given from the middle of the mesh, in radii; the scene has them from the eye. */
static void lights_stand_around_the_mesh(void **state)
{
	const float middle[3] = { 1, 2, 3 };
	struct view_options options;
	struct view view;
	float at[4];

	(void)state;
	set_up(&view, &options, 100, 100, 30);
	options.lights = 2;
	options.light[0] = scene_light_point(0.5f, 0, 2);
	options.light[1] = scene_light_direction(0, 0, 2);
	look_from(&view, 0);
	matrix_transform(at, view.scene.modelview, middle);
	assert_true(fabsf(view.scene.light[0].position[0] - at[0] - 0.5f) < 1e-5f);
	assert_true(fabsf(view.scene.light[0].position[2] - at[2] - 2) < 1e-5f);
	assert_true(fabsf(view.scene.light[0].position[1] - at[1]) < 1e-5f);
	assert_true(view.scene.light[1].position[2] == 2);
	assert_false(view.scene.light[2].enabled);
}

static void highlights_follow_the_eye_only_in_perspective(void **state)
{
	struct view_options options;
	struct view view;

	(void)state;
	set_up(&view, &options, 100, 100, 30);
	look_from(&view, 0);
	assert_true(view.scene.local_viewer);
	options.fov = 0;
	look_from(&view, 0);
	assert_false(view.scene.local_viewer);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_mesh_fits_any_shape_of_picture_from_any_side),
		cmocka_unit_test(a_turntable_fits_in_all_its_frames),
		cmocka_unit_test(the_eye_keeps_its_distance),
		cmocka_unit_test(the_camera_goes_right_and_up_around_the_mesh),
		cmocka_unit_test(what_is_up_in_the_mesh_is_up_in_the_picture),
		cmocka_unit_test(a_turn_shows_the_left_side),
		cmocka_unit_test(the_eye_flies_into_the_mesh_and_looks_around),
		cmocka_unit_test(zoom_enlarges_and_keeps_the_middle),
		cmocka_unit_test(lights_stand_around_the_mesh),
		cmocka_unit_test(highlights_follow_the_eye_only_in_perspective),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
