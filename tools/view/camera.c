// SPDX-License-Identifier: MIT
/*
 * Where the eye is. The stage is the space in which the mesh stands, its middle in the origin and
 * its radius 1: x to the right, y up, z towards the eye. What the eye sees fits the picture: not
 * the sphere around the mesh, but its points.
 */
#include <math.h>
#include <string.h>

#include "view/view.h"
#include "scene/matrix.h"

/* The picture's half over the mesh's, so that it does not touch the border. */
#define ROOM 1.06f
#define RADIUS 1.02f /* of a sphere that holds the mesh in spite of rounding */
#define PARALLEL_DISTANCE 4
#define NEAREST 0.1f     /* point of the mesh in front of the eye */
#define NEAR_PLANE 0.01f /* of an eye inside */
#define TURNS 36         /* in which a turntable is looked at */

/* The mesh on the stage. */
static void place_mesh(const struct view *view, float turn, float m[16])
{
	const struct view_options *options = view->options;

	matrix_rotate_x(m, options->camera[1]);
	matrix_rotate_y(m, turn - options->camera[0]);
	matrix_rotate_x(m, options->rotate[0]);
	matrix_rotate_y(m, options->rotate[1]);
	matrix_rotate_z(m, options->rotate[2]);
	matrix_rotate_x(m, options->upright[0]);
	matrix_rotate_z(m, options->upright[1]);
	matrix_scale(m, 1 / view->radius);
	matrix_translate(m, -view->centre[0], -view->centre[1], -view->centre[2]);
}

/*
 * How far points reach on the stage, for each side of the picture: left, right, bottom, top. A
 * point (x, z) is inside the right side of a view that opens by t, from an eye at (c, d), if
 * x - c <= t (d - z), so the greatest x + t z is all that counts; t is 0 without perspective.
 */
struct reach {
	float side[4];
	float nearest; /* greatest z */
};

static void extend(struct reach *reach, const struct view *view, float turn, const float open[2])
{
	float m[16], at[4];

	matrix_identity(m);
	place_mesh(view, turn, m);
	for (uint32_t i = 0; i < view->mesh.vertices; i++) {
		matrix_transform(at, m, view->mesh.position[i]);
		for (int side = 0; side < 4; side++) {
			float out = side % 2 ? at[side / 2] : -at[side / 2];

			reach->side[side] = fmaxf(reach->side[side], out + open[side / 2] * at[2]);
		}
		reach->nearest = fmaxf(reach->nearest, at[2]);
	}
}

void view_camera_frame(struct view *view)
{
	const struct view_options *options = view->options;
	float aspect = (float)options->width / (float)options->height;
	float half = tanf(options->fov * (3.14159265f / 360)) / ROOM;
	const float open[2] = { half * aspect, half };
	struct reach reach = { { -INFINITY, -INFINITY, -INFINITY, -INFINITY }, -INFINITY };
	int turns = options->turntable > 1 ? TURNS : 1;
	float width, height;

	for (int i = 0; i < turns; i++)
		extend(&reach, view, 360.0f * (float)i / (float)turns, open);
	for (int axis = 0; axis < 2; axis++)
		view->eye[axis] = (reach.side[axis * 2 + 1] - reach.side[axis * 2]) / 2;
	width = (reach.side[0] + reach.side[1]) / 2;
	height = (reach.side[2] + reach.side[3]) / 2;
	view->eye[2] = PARALLEL_DISTANCE;
	view->half_height = fmaxf(fmaxf(width / aspect, height) * ROOM, 1e-6f);
	if (options->fov)
		view->eye[2] = fmaxf(fmaxf(width / open[0], height / open[1]),
				     reach.nearest + NEAREST);
}

/* From the stage to the eye, with what hands have moved. */
static void place_eye(const struct view *view, float m[16])
{
	const struct view_hand *hand = &view->hand;

	matrix_identity(m);
	matrix_rotate_y(m, hand->look);
	matrix_translate(m, -view->eye[0] - hand->move[0], -view->eye[1] - hand->move[1],
			 -view->eye[2] - hand->move[2]);
}

/* @depth: of the middle, seen from the eye. */
static void set_projection(struct view *view, float depth)
{
	const struct view_options *options = view->options;
	float aspect = (float)options->width / (float)options->height;
	float near = depth - RADIUS, far = depth + RADIUS;
	float *m = view->scene.projection;

	if (options->fov) {
		near = fmaxf(near, NEAR_PLANE);
		far = fmaxf(far, 2 * NEAR_PLANE);
		matrix_perspective(m, options->fov, aspect, near, far);
	} else {
		matrix_orthographic(m, view->half_height, aspect, near, far);
	}
	for (int row = 0; row < 2; row++)
		for (int column = 0; column < 4; column++)
			m[column * 4 + row] *= options->zoom;
	/* Without perspective there is no eye to see the highlights from. */
	view->scene.local_viewer = options->fov != 0;
}

/* Of a direction, which only turns. */
static void turn_direction(float v[3], const float m[16])
{
	float turned[3];

	for (int row = 0; row < 3; row++)
		turned[row] = m[row] * v[0] + m[4 + row] * v[1] + m[8 + row] * v[2];
	memcpy(v, turned, sizeof(turned));
}

static void place_light(struct accel_light *light, const float m[16])
{
	float position[4];

	turn_direction(light->spot_direction, m);
	if (light->position[3] == 0) {
		turn_direction(light->position, m);
		return;
	}
	matrix_transform(position, m, light->position);
	memcpy(light->position, position, sizeof(position));
}

void view_camera_set(struct view *view, float turn)
{
	const struct view_options *options = view->options;
	float *m = view->scene.modelview;

	memset(view->scene.light, 0, sizeof(view->scene.light));
	place_eye(view, m);
	for (int i = 0; i < options->lights; i++) {
		view->scene.light[i] = options->light[i];
		place_light(&view->scene.light[i], m);
	}
	set_projection(view, -m[14]);
	place_mesh(view, turn, m);
}
