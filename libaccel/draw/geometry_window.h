/* SPDX-License-Identifier: MIT */
/* Clip space to the window: for geometry.c and clip.c one point, for geometry_loop.h many. */
#ifndef ACCEL_DRAW_GEOMETRY_WINDOW_H
#define ACCEL_DRAW_GEOMETRY_WINDOW_H

#include "draw/draw_priv.h"

/* w below this is no place in front of the eye that could be divided by. */
#define ACCEL_EYE_W_MIN 1e-30

/* A row of a matrix, which is column by column, times a point. */
static inline double geometry_row(const double m[16], int row, const double at[4])
{
	return m[row] * at[0] + m[4 + row] * at[1] + m[8 + row] * at[2] + m[12 + row] * at[3];
}

/* Of a point from one of the state's own planes. */
static inline double geometry_user_distance(const double plane[4], const double at[4])
{
	return plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2] + plane[3] * at[3];
}

/* accel_geometry_distance, for a @plane that the compiler knows. */
static inline double geometry_distance(const struct accel_window *window, int plane,
				       const double clip[4])
{
	const double *scale = window->scale, *offset = window->offset, *guard = window->guard;
	double w = clip[3];

	switch (1 << plane) {
	case ACCEL_OUTSIDE_EYE:
		return w - ACCEL_EYE_W_MIN;
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

static inline uint32_t geometry_outside(const struct accel_window *window, const double clip[4])
{
	uint32_t bits = 0;

#pragma GCC unroll 8
	for (int plane = 0; plane < ACCEL_CLIP_PLANES; plane++)
		bits |= geometry_distance(window, plane, clip) < 0 ? 1u << plane : 0;
	bits |= clip[0] < -clip[3] ? ACCEL_OUTSIDE_LEFT : 0;
	bits |= clip[0] > clip[3] ? ACCEL_OUTSIDE_RIGHT : 0;
	bits |= clip[1] > clip[3] ? ACCEL_OUTSIDE_TOP : 0;
	bits |= clip[1] < -clip[3] ? ACCEL_OUTSIDE_BOTTOM : 0;
	return bits;
}

/* floor() of what an int holds. */
static inline int32_t geometry_floor(double value)
{
	int32_t whole = (int32_t)value;

	return whole - ((double)whole > value);
}

/* Rounds a coordinate to 1/16 pixel; the guard band's borders are whole pixels. NaN is low. */
static inline int32_t geometry_snap(double pixel, double low, double high)
{
	const double one = 1 << ACCEL_SNAP_BITS;

	pixel = pixel > low ? pixel : low;
	pixel = pixel < high ? pixel : high;
	return geometry_floor(pixel * one + 0.5) * (1 << (ACCEL_WINDOW_BITS - ACCEL_SNAP_BITS));
}

/* Of a vertex: x, y, w and z. */
struct geometry_place {
	int32_t x, y;
	float w;
	double z;
};

static inline struct geometry_place geometry_project(const struct accel_window *window,
						     const double clip[4])
{
	/* Clipping may miss by the rounding of its largest number. */
	double w = clip[3] > ACCEL_EYE_W_MIN ? clip[3] : ACCEL_EYE_W_MIN, inverse = 1 / w;
	double z = clip[2] * inverse * window->scale[2] + window->offset[2];

	z = z > 0 ? z : 0;
	return (struct geometry_place){
		.x = geometry_snap(clip[0] * inverse * window->scale[0] + window->offset[0],
				   window->guard[0], window->guard[1]),
		.y = geometry_snap(clip[1] * inverse * window->scale[1] + window->offset[1],
				   window->guard[2], window->guard[3]),
		.w = (float)w,
		.z = z < 1 ? z : 1,
	};
}

#endif
