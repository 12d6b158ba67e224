/* SPDX-License-Identifier: MIT */
/* Vertices to eye space and to the window; a part of kernel_loops.h. */
#include <float.h>
#include <math.h>

#include "draw/geometry_window.h"
#include "draw/kernel.h"

static inline uint32_t loop_finite(float value)
{
	return fabsf(value) <= FLT_MAX;
}

static inline uint32_t loop_place(const struct accel_transform *transform,
				  struct accel_vertex_batch *batch, int i, const double at[4])
{
	struct geometry_place place;
	uint32_t finite = 1;
	double clip[4];

#pragma GCC unroll 4
	for (int row = 0; row < 4; row++) {
		clip[row] = geometry_row(transform->clip, row, at);
		finite &= loop_finite((float)clip[row]);
	}
	place = geometry_project(&transform->window, clip);
	batch->x[i] = place.x;
	batch->y[i] = place.y;
	batch->w[i] = place.w;
	batch->z[i] = place.z;
	batch->outside[i] = geometry_outside(&transform->window, clip);
	return finite;
}

static inline uint32_t loop_eye(const struct accel_transform *transform,
				struct accel_vertex_batch *batch, int i, const double at[4])
{
	double w = geometry_row(transform->eye, 3, at);
	uint32_t finite = 1;

	w = w == 0 ? 1 : w;
#pragma GCC unroll 4
	for (int row = 0; row < 3; row++) {
		batch->eye[row][i] = (float)(geometry_row(transform->eye, row, at) / w);
		finite &= loop_finite(batch->eye[row][i]);
	}
	return finite;
}

static inline void loop_user_plane(const struct accel_transform *transform, int n,
				   struct accel_vertex_batch *batch, int i)
{
	const double at[4] = { (double)batch->position[0][i], (double)batch->position[1][i],
			       (double)batch->position[2][i], (double)batch->position[3][i] };

	batch->outside[i] |= (uint32_t)(geometry_user_distance(transform->plane[n], at) < 0)
			     << (ACCEL_OUTSIDE_USER_BIT + n);
}

static inline uint32_t loop_normal(const double m[9], double scale,
				   struct accel_vertex_batch *batch, int i)
{
	double x = (double)batch->across[0][i], y = (double)batch->across[1][i];
	double z = (double)batch->across[2][i], n[3], length;
	uint32_t finite = 1;

#pragma GCC unroll 4
	for (int row = 0; row < 3; row++)
		n[row] = m[row] * x + m[3 + row] * y + m[6 + row] * z;
	length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
	length = length > 0 ? length : 1;
	scale *= length;
	scale = scale < (double)FLT_MAX ? scale : (double)FLT_MAX;
	batch->length[i] = scale > 0 ? (float)scale : 1;
#pragma GCC unroll 4
	for (int row = 0; row < 3; row++) {
		batch->normal[row][i] = (float)(n[row] / length);
		finite &= loop_finite(batch->normal[row][i]);
	}
	return finite;
}

static inline uint32_t loop_paint(float *paint, float least, float most)
{
	const float value = *paint;

	*paint = value < least ? least : value;
	*paint = *paint > most ? most : *paint;
	return loop_finite(value);
}

static void loop_transform(const struct accel_transform *by, struct accel_vertex_batch *batch,
			   int count, bool normals)
{
	const struct accel_transform transform = *by; /* which nothing in @batch can change */
	const float least = by->paint_limited ? 0 : -FLT_MAX;
	const float most = by->paint_limited ? 1 : FLT_MAX;

	for (int i = 0; i < count; i++) {
		const double at[4] = { (double)batch->position[0][i], (double)batch->position[1][i],
				       (double)batch->position[2][i],
				       (double)batch->position[3][i] };

		batch->finite[i] = loop_place(&transform, batch, i, at) &
				   loop_eye(&transform, batch, i, at);
	}
	for (int n = 0; n < ACCEL_USER_CLIP_PLANES; n++)
		for (int i = 0; i < count && transform.planes >> n & 1; i++)
			loop_user_plane(&transform, n, batch, i);
	for (int i = 0; i < count; i++)
		batch->length[i] = 1;
	for (int i = 0; i < count && normals; i++)
		batch->finite[i] &= loop_normal(transform.normal, transform.normal_scale, batch, i);
	for (int component = 0; component < 4; component++)
		for (int i = 0; i < count; i++)
			batch->finite[i] &= loop_paint(&batch->paint[component][i], least, most);
}
