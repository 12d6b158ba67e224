// SPDX-License-Identifier: MIT
/* The matrices of a mesh, the window and what of it is visible; single points of clip space. */
#include <errno.h>
#include <math.h>
#include <string.h>

#include "draw/geometry_window.h"
#include "draw/kernel.h"

/*
 * Pixels that a coordinate may lie beside the target. Across, 13 bits count from any tile of it.
 * Down, edges of more than ACCEL_EDGE_HEIGHT_MAX would not fit.
 */
#define GUARD_ACROSS 2000.0
#define GUARD_HEIGHT (ACCEL_EDGE_HEIGHT_MAX >> ACCEL_SNAP_BITS)

/* out = a b, column by column. */
static void geometry_multiply(double out[16], const float a[16], const float b[16])
{
	for (int column = 0; column < 4; column++) {
		for (int row = 0; row < 4; row++) {
			double sum = 0;

			for (int i = 0; i < 4; i++)
				sum += (double)a[4 * i + row] * (double)b[4 * column + i];
			out[4 * column + row] = sum;
		}
	}
}

static double geometry_length(const double v[3])
{
	return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/*
 * Normals go by the inverse transpose, which is the matrix of cofactors over the determinant. Their
 * directions are made unit length later, so there of the determinant only the sign is needed.
 */
static void geometry_normal_matrix(struct accel_transform *transform, const float m[16],
				   enum accel_normals normals)
{
	double *out = transform->normal, determinant = 0, scale = 0;

	for (int column = 0; column < 3; column++) {
		int c1 = 4 * ((column + 1) % 3), c2 = 4 * ((column + 2) % 3);

		for (int row = 0; row < 3; row++) {
			int r1 = (row + 1) % 3, r2 = (row + 2) % 3;

			out[3 * column + row] = (double)m[c1 + r1] * (double)m[c2 + r2] -
						(double)m[c1 + r2] * (double)m[c2 + r1];
		}
	}
	for (int row = 0; row < 3; row++)
		determinant += out[row] * (double)m[row];
	for (int i = 0; i < 9 && determinant < 0; i++)
		out[i] = -out[i];
	/* OpenGL rescales by the length of the inverse's third row. */
	if (normals == ACCEL_NORMALS_RESCALE)
		scale = 1 / geometry_length(&out[6]);
	if (normals == ACCEL_NORMALS_AS_GIVEN)
		scale = 1 / fabs(determinant);
	transform->normal_scale = scale;
}

static int geometry_clamp(int64_t value, int low, int high)
{
	return value < low ? low : value > high ? high : (int)value;
}

/* What of @low to @high is from @start on for @size; a negative size has nothing. */
static void geometry_intersect_range(int *low, int *high, int start, int size)
{
	int first = geometry_clamp(start, *low, *high);

	*high = geometry_clamp((int64_t)start + (size > 0 ? size : 0), first, *high);
	*low = first;
}

void accel_geometry_intersect(struct accel_bounds *rectangle, int x, int y, int width, int height)
{
	geometry_intersect_range(&rectangle->x0, &rectangle->x1, x, width);
	geometry_intersect_range(&rectangle->y0, &rectangle->y1, y, height);
}

void accel_geometry_scissor(const struct accel_state *state, struct accel_bounds *visible)
{
	if (state->scissor.width >= 0)
		accel_geometry_intersect(visible, state->scissor.x, state->scissor.y,
					 state->scissor.width, state->scissor.height);
}

static void geometry_window_init(struct accel_window *window, const struct accel_state *state,
				 int width, int height)
{
	double x = 0, y = 0, w = width, h = height;
	int guard_top = (height - GUARD_HEIGHT) / 2;

	window->visible = (struct accel_bounds){ 0, 0, width, height };
	if (state->viewport.width >= 0) {
		x = state->viewport.x;
		y = state->viewport.y;
		w = state->viewport.width;
		h = state->viewport.height > 0 ? state->viewport.height : 0;
		accel_geometry_intersect(&window->visible, state->viewport.x, state->viewport.y,
					 state->viewport.width, state->viewport.height);
	}
	accel_geometry_scissor(state, &window->visible);
	window->scale[0] = w / 2;
	window->scale[1] = state->bottom ? h / 2 : -h / 2;
	window->scale[2] = ((double)state->depth_far - (double)state->depth_near) / 2;
	window->offset[0] = x + w / 2;
	window->offset[1] = y + h / 2;
	window->offset[2] = ((double)state->depth_far + (double)state->depth_near) / 2;
	window->guard[0] = -GUARD_ACROSS;
	window->guard[1] = width + GUARD_ACROSS;
	window->guard[2] = guard_top;
	window->guard[3] = guard_top + GUARD_HEIGHT;
}

/* What of the guard band from @guard[0] to @guard[1] is from @start on for @size. */
static void geometry_view_range(double guard[2], double start, double size)
{
	const double low = fmin(fmax(start, guard[0]), guard[1]);

	guard[1] = fmax(fmin(start + size, guard[1]), low);
	guard[0] = low;
}

void accel_geometry_view(struct accel_window *window, const struct accel_state *state)
{
	double x = 0, y = 0, width = 2 * window->offset[0], height = 2 * window->offset[1];

	if (state->viewport.width >= 0) {
		x = state->viewport.x;
		y = state->viewport.y;
		width = state->viewport.width;
		height = number_max(state->viewport.height, 0);
	}
	geometry_view_range(&window->guard[0], x, width);
	geometry_view_range(&window->guard[2], y, height);
}

/* Planes go by the transpose of what takes positions to the eye. */
static void geometry_planes(struct accel_transform *transform, const struct accel_state *state)
{
	transform->planes = state->clip_planes;
	for (int n = 0; n < ACCEL_USER_CLIP_PLANES; n++)
		for (int column = 0; column < 4 && state->clip_planes >> n & 1; column++) {
			double sum = 0;

			for (int row = 0; row < 4; row++)
				sum += (double)state->clip_plane[n][row] *
				       (double)state->modelview[4 * column + row];
			transform->plane[n][column] = sum;
		}
}

void accel_geometry_init(struct accel_transform *transform, const struct accel_state *state,
			 int width, int height)
{
	geometry_multiply(transform->clip, state->projection, state->modelview);
	for (int i = 0; i < 16; i++)
		transform->eye[i] = (double)state->modelview[i];
	geometry_normal_matrix(transform, state->modelview, state->normals);
	transform->paint_limited = !state->lighting;
	geometry_planes(transform, state);
	geometry_window_init(&transform->window, state, width, height);
}

void accel_geometry_clip_space(const struct accel_transform *transform, const float position[4],
			       double clip[4])
{
	const double at[4] = { (double)position[0], (double)position[1], (double)position[2],
			       (double)position[3] };

	for (int row = 0; row < 4; row++)
		clip[row] = geometry_row(transform->clip, row, at);
}

double accel_geometry_distance(const struct accel_window *window, int plane, const double clip[4])
{
	return geometry_distance(window, plane, clip);
}

void accel_geometry_project(const struct accel_window *window, const double clip[4],
			    struct accel_vertex *vertex)
{
	const struct geometry_place place = geometry_project(window, clip);

	vertex->x = place.x;
	vertex->y = place.y;
	vertex->w = place.w;
	vertex->z = place.z;
}

void accel_geometry_vertex_of(const struct accel_vertex_batch *batch, int i,
			      struct accel_vertex *vertex)
{
	vertex->x = batch->x[i];
	vertex->y = batch->y[i];
	vertex->w = batch->w[i];
	vertex->z = batch->z[i];
	vertex->outside = batch->outside[i];
	vertex->length = batch->length[i];
	vertex->level = 0;
	vertex->sampled = 0;
	for (int j = 0; j < 3; j++) {
		vertex->eye[j] = batch->eye[j][i];
		vertex->normal[j] = batch->normal[j][i];
	}
	/* Without lighting the paint is all there is to see. */
	vertex->sample = (struct accel_sample){ 0 };
	for (int j = 0; j < 4; j++)
		vertex->paint[j] = vertex->sample.colour[j] = batch->paint[j][i];
}

int accel_geometry_vertex(const struct accel_transform *transform, const float position[3],
			  const float *normal, struct accel_vertex *vertex)
{
	struct accel_vertex_batch batch;

	for (int i = 0; i < 4; i++)
		batch.paint[i][0] = 1;
	batch.position[3][0] = 1;
	for (int i = 0; i < 3; i++) {
		batch.position[i][0] = position[i];
		batch.across[i][0] = normal ? normal[i] : 0;
		batch.normal[i][0] = 0;
	}
	accel_kernel()->transform(transform, &batch, 1, normal != NULL);
	accel_geometry_vertex_of(&batch, 0, vertex);
	return batch.finite[0] ? 0 : -EINVAL;
}
