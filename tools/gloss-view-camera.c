// SPDX-License-Identifier: MIT
#include <math.h>
#include <string.h>

#include "gloss-view.h"
#include "matrix.h"

/* Room around the sphere that holds the mesh. */
#define MARGIN 1.02f
#define PARALLEL_DISTANCE 4

/* How far away the eye sees the whole sphere of radius 1. */
static float distance(const struct view_options *options)
{
	float half = options->fov * (3.14159265f / 360);
	float aspect = (float)options->width / (float)options->height;

	if (!options->fov)
		return PARALLEL_DISTANCE;
	if (aspect < 1)
		half = atanf(tanf(half) * aspect);
	return MARGIN / sinf(half);
}

static void set_projection(struct scene *scene, const struct view_options *options, float away)
{
	float aspect = (float)options->width / (float)options->height;
	float near = away - MARGIN, far = away + MARGIN;

	if (options->fov)
		matrix_perspective(scene->projection, options->fov, aspect, near, far);
	else
		matrix_orthographic(scene->projection, MARGIN / fminf(aspect, 1), aspect, near,
				    far);
	for (int row = 0; row < 2; row++)
		for (int column = 0; column < 4; column++)
			scene->projection[column * 4 + row] *= options->zoom;
	/* Without perspective there is no eye to see the highlights from. */
	scene->local_viewer = options->fov != 0;
}

static void set_modelview(struct view *view, float away, float turn)
{
	const struct view_options *options = view->options;
	float *m = view->scene.modelview;

	matrix_identity(m);
	matrix_translate(m, 0, 0, -away);
	matrix_rotate_x(m, options->camera[1]);
	matrix_rotate_y(m, turn - options->camera[0]);
	matrix_rotate_x(m, options->rotate[0]);
	matrix_rotate_y(m, options->rotate[1]);
	matrix_rotate_z(m, options->rotate[2]);
	matrix_scale(m, 1 / view->radius);
	matrix_translate(m, -view->centre[0], -view->centre[1], -view->centre[2]);
}

void view_camera_set(struct view *view, float turn)
{
	const struct view_options *options = view->options;
	float away = distance(options);

	set_modelview(view, away, turn);
	set_projection(&view->scene, options, away);
	memset(view->scene.light, 0, sizeof(view->scene.light));
	for (int i = 0; i < options->lights; i++) {
		view->scene.light[i] = options->light[i];
		if (options->light[i].position[3] != 0)
			view->scene.light[i].position[2] -= away;
	}
}
