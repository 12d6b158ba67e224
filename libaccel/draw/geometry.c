// SPDX-License-Identifier: MIT
/* Vertices to the window: transform, what of the view volume they are outside of, snapping. */
#include <errno.h>
#include <math.h>

#include "draw/draw_priv.h"

/* w below this is no place in front of the eye that could be divided by. */
#define EYE_W_MIN 1e-30

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

/*
 * Normals go by the inverse transpose, which is the matrix of cofactors over the determinant. They
 * are made unit length later, so of the determinant only the sign is needed.
 */
static void geometry_normal_matrix(double out[9], const float m[16])
{
	double determinant = 0;

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

/* Whatever the numbers, the corners stay where the rectangle was, and in order. */
static void geometry_intersect(struct accel_bounds *rectangle, int x, int y, int width, int height)
{
	geometry_intersect_range(&rectangle->x0, &rectangle->x1, x, width);
	geometry_intersect_range(&rectangle->y0, &rectangle->y1, y, height);
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
		geometry_intersect(&window->visible, state->viewport.x, state->viewport.y,
				   state->viewport.width, state->viewport.height);
	}
	if (state->scissor.width >= 0)
		geometry_intersect(&window->visible, state->scissor.x, state->scissor.y,
				   state->scissor.width, state->scissor.height);
	window->scale[0] = w / 2;
	window->scale[1] = -h / 2;
	window->scale[2] = ((double)state->depth_far - (double)state->depth_near) / 2;
	window->offset[0] = x + w / 2;
	window->offset[1] = y + h / 2;
	window->offset[2] = ((double)state->depth_far + (double)state->depth_near) / 2;
	window->guard[0] = -GUARD_ACROSS;
	window->guard[1] = width + GUARD_ACROSS;
	window->guard[2] = guard_top;
	window->guard[3] = guard_top + GUARD_HEIGHT;
}

void accel_geometry_init(struct accel_transform *transform, const struct accel_state *state,
			 int width, int height)
{
	geometry_multiply(transform->clip, state->projection, state->modelview);
	for (int i = 0; i < 16; i++)
		transform->eye[i] = (double)state->modelview[i];
	geometry_normal_matrix(transform->normal, state->modelview);
	geometry_window_init(&transform->window, state, width, height);
}

static void geometry_transform_point(const double m[16], const float p[3], double out[4])
{
	for (int row = 0; row < 4; row++)
		out[row] = m[row] * (double)p[0] + m[4 + row] * (double)p[1] +
			   m[8 + row] * (double)p[2] + m[12 + row];
}

void accel_geometry_clip_space(const struct accel_transform *transform, const float position[3],
			       double clip[4])
{
	geometry_transform_point(transform->clip, position, clip);
}

double accel_geometry_distance(const struct accel_window *window, int plane, const double clip[4])
{
	const double *scale = window->scale, *offset = window->offset, *guard = window->guard;
	double w = clip[3];

	switch (1 << plane) {
	case ACCEL_OUTSIDE_EYE:
		return w - EYE_W_MIN;
	case ACCEL_OUTSIDE_NEAR:
		return w + clip[2];
	case ACCEL_OUTSIDE_FAR:
		return w - clip[2];
	case ACCEL_OUTSIDE_GUARD_LEFT:
		return scale[0] * clip[0] + (offset[0] - guard[0]) * w;
	case ACCEL_OUTSIDE_GUARD_RIGHT:
		return (guard[1] - offset[0]) * w - scale[0] * clip[0];
	case ACCEL_OUTSIDE_GUARD_TOP:
		return scale[1] * clip[1] + (offset[1] - guard[2]) * w;
	default:
		return (guard[3] - offset[1]) * w - scale[1] * clip[1];
	}
}

static uint32_t geometry_outside(const struct accel_window *window, const double clip[4])
{
	uint32_t bits = 0;

	for (int plane = 0; plane < ACCEL_CLIP_PLANES; plane++)
		if (accel_geometry_distance(window, plane, clip) < 0)
			bits |= 1u << plane;
	if (clip[0] < -clip[3])
		bits |= ACCEL_OUTSIDE_LEFT;
	if (clip[0] > clip[3])
		bits |= ACCEL_OUTSIDE_RIGHT;
	if (clip[1] > clip[3])
		bits |= ACCEL_OUTSIDE_TOP;
	if (clip[1] < -clip[3])
		bits |= ACCEL_OUTSIDE_BOTTOM;
	return bits;
}

/* Rounds a coordinate to 1/16 pixel; the guard band's borders are whole pixels. NaN is low. */
static int32_t geometry_snap(double pixel, double low, double high)
{
	const double one = 1 << ACCEL_SNAP_BITS;

	pixel = pixel > low ? pixel : low;
	pixel = pixel < high ? pixel : high;
	return (int32_t)floor(pixel * one + 0.5) * (1 << (ACCEL_WINDOW_BITS - ACCEL_SNAP_BITS));
}

void accel_geometry_project(const struct accel_window *window, const double clip[4],
			    struct accel_vertex *vertex)
{
	/* Clipping may miss by the rounding of its largest number. */
	double w = clip[3] > EYE_W_MIN ? clip[3] : EYE_W_MIN, inverse = 1 / w;
	double z = clip[2] * inverse * window->scale[2] + window->offset[2];

	vertex->x = geometry_snap(clip[0] * inverse * window->scale[0] + window->offset[0],
				  window->guard[0], window->guard[1]);
	vertex->y = geometry_snap(clip[1] * inverse * window->scale[1] + window->offset[1],
				  window->guard[2], window->guard[3]);
	vertex->w = (float)w;
	vertex->z = z > 0 ? (z < 1 ? z : 1) : 0;
}

/* false: something is too large for a float. */
static bool geometry_narrow(const double *in, float *out, int count)
{
	bool finite = true;

	for (int i = 0; i < count; i++) {
		out[i] = (float)in[i];
		finite &= isfinite(out[i]) != 0;
	}
	return finite;
}

static bool geometry_eye_normal(const double m[9], const float normal[3], float out[3])
{
	double n[3], length;

	for (int row = 0; row < 3; row++)
		n[row] = m[row] * (double)normal[0] + m[3 + row] * (double)normal[1] +
			 m[6 + row] * (double)normal[2];
	length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
	for (int i = 0; i < 3 && length > 0; i++)
		n[i] /= length;
	return geometry_narrow(n, out, 3);
}

int accel_geometry_vertex(const struct accel_transform *transform, const float position[3],
			  const float *normal, struct accel_vertex *vertex)
{
	double clip[4], eye[4];
	float narrowed[4];

	accel_geometry_clip_space(transform, position, clip);
	geometry_transform_point(transform->eye, position, eye);
	if (eye[3] != 1 && eye[3] != 0)
		for (int i = 0; i < 3; i++)
			eye[i] /= eye[3];
	if (!geometry_narrow(clip, narrowed, 4) || !geometry_narrow(eye, vertex->eye, 3))
		return -EINVAL;
	if (normal && !geometry_eye_normal(transform->normal, normal, vertex->normal))
		return -EINVAL;
	vertex->outside = geometry_outside(&transform->window, clip);
	if (!(vertex->outside & ACCEL_OUTSIDE_CLIP))
		accel_geometry_project(&transform->window, clip, vertex);
	vertex->level = 0;
	vertex->sampled = 0;
	return 0;
}
