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

#include "../../tools/gloss-view-camera.c"

/* A mesh of radius 5 around (1, 2, 3). */
static void set_up(struct view *view, struct view_options *options, int width, int height,
		   float fov)
{
	memset(view, 0, sizeof(*view));
	memset(options, 0, sizeof(*options));
	options->width = width;
	options->height = height;
	options->zoom = 1;
	options->fov = fov;
	view->options = options;
	view->radius = 5;
	view->centre[0] = 1;
	view->centre[1] = 2;
	view->centre[2] = 3;
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

static void all_of_the_mesh_is_seen_in_any_shape_of_picture(void **state)
{
	static const int sizes[][2] = { { 640, 480 }, { 300, 300 }, { 100, 400 }, { 900, 20 } };
	static const float fovs[] = { 0, 1, 30, 120 };
	struct view_options options;
	struct view view;

	(void)state;
	for (int i = 0; i < 16; i++) {
		float reach[3] = { 0 };

		set_up(&view, &options, sizes[i / 4][0], sizes[i / 4][1], fovs[i % 4]);
		view_camera_set(&view, 0);
		for (int step = 0; step < 64 * 64; step++) {
			float a = (float)(step % 64) / 32 * 3.14159f;
			float b = (float)step / 4096 * 3.14159f, ring = 5 * sinf(b);
			const float point[3] = {
				1 + ring * cosf(a), 2 + ring * sinf(a), 3 + 5 * cosf(b),
			};
			float at[3];

			look(&view, point, at);
			for (int axis = 0; axis < 3; axis++)
				reach[axis] = fmaxf(reach[axis], fabsf(at[axis]));
		}
		for (int axis = 0; axis < 3; axis++)
			assert_true(reach[axis] < 1);
		assert_true(fmaxf(reach[0], reach[1]) > 0.9f);
	}
}

static void the_camera_goes_right_and_up_around_the_mesh(void **state)
{
	const float right[3] = { 6, 2, 3 }, top[3] = { 1, 7, 3 };
	struct view_options options;
	struct view view;
	float at[3];

	(void)state;
	/* From the right, its right side is in the middle, and in front. */
	set_up(&view, &options, 100, 100, 0);
	options.camera[0] = 90;
	view_camera_set(&view, 0);
	look(&view, right, at);
	assert_true(fabsf(at[0]) < 1e-5f && at[2] < -0.9f);
	/* From above, its top. */
	options.camera[0] = 0;
	options.camera[1] = 90;
	view_camera_set(&view, 0);
	look(&view, top, at);
	assert_true(fabsf(at[1]) < 1e-5f && at[2] < -0.9f);
}

static void a_turn_shows_the_left_side(void **state)
{
	const float left[3] = { -4, 2, 3 };
	struct view_options options;
	struct view view;
	float at[3];

	(void)state;
	set_up(&view, &options, 100, 100, 0);
	view_camera_set(&view, 90);
	look(&view, left, at);
	assert_true(fabsf(at[0]) < 1e-5f && at[2] < -0.9f);
}

static void zoom_enlarges_and_keeps_the_middle(void **state)
{
	const float middle[3] = { 1, 2, 3 }, top[3] = { 1, 7, 3 };
	struct view_options options;
	struct view view;
	float at[3], near[3];

	(void)state;
	set_up(&view, &options, 100, 100, 30);
	view_camera_set(&view, 0);
	look(&view, top, at);
	options.zoom = 3;
	view_camera_set(&view, 0);
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
	view_camera_set(&view, 0);
	matrix_transform(at, view.scene.modelview, middle);
	assert_true(fabsf(view.scene.light[0].position[0] - at[0] - 0.5f) < 1e-5f);
	assert_true(fabsf(view.scene.light[0].position[2] - at[2] - 2) < 1e-5f);
	assert_true(view.scene.light[1].position[2] == 2);
	assert_false(view.scene.light[2].enabled);
}

static void highlights_follow_the_eye_only_in_perspective(void **state)
{
	struct view_options options;
	struct view view;

	(void)state;
	set_up(&view, &options, 100, 100, 30);
	view_camera_set(&view, 0);
	assert_true(view.scene.local_viewer);
	options.fov = 0;
	view_camera_set(&view, 0);
	assert_false(view.scene.local_viewer);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(all_of_the_mesh_is_seen_in_any_shape_of_picture),
		cmocka_unit_test(the_camera_goes_right_and_up_around_the_mesh),
		cmocka_unit_test(a_turn_shows_the_left_side),
		cmocka_unit_test(zoom_enlarges_and_keeps_the_middle),
		cmocka_unit_test(lights_stand_around_the_mesh),
		cmocka_unit_test(highlights_follow_the_eye_only_in_perspective),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
