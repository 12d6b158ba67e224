/* SPDX-License-Identifier: MIT */
/* Surfaces through the light of triangles; a part of kernel_loops.h. What they are is in surface.c. */
#include <math.h>

#include "draw/kernel.h"
#include "draw/loop.h"
#include "draw/small.h"

/* A channel's value and differences below this are integers of 32 bits, as s10.22. */
#define FIT_MAX 511.0

LOOP_INLINE int32_t loop_middle_of(int32_t a, int32_t b, int32_t c)
{
	return (loop_min(loop_min(a, b), c) + loop_max(loop_max(a, b), c)) >>
	       (ACCEL_WINDOW_BITS + 1);
}

/* accel_surface_basis. */
LOOP_INLINE void loop_basis(struct accel_fit_batch *batch, int i)
{
	const double one = ACCEL_WINDOW_ONE, half = one / 2;
	int32_t ax = batch->x[0][i], ay = batch->y[0][i];
	double bx = batch->x[1][i] - ax, by = batch->y[1][i] - ay;
	double cx = batch->x[2][i] - ax, cy = batch->y[2][i] - ay;
	double inverse = 1 / (bx * cy - cx * by), x, y;

	batch->at_x[i] = loop_middle_of(ax, batch->x[1][i], batch->x[2][i]);
	batch->at_y[i] = loop_middle_of(ay, batch->y[1][i], batch->y[2][i]);
	x = batch->at_x[i] * one + half - ax;
	y = batch->at_y[i] * one + half - ay;
	batch->u[i] = (x * cy - y * cx) * inverse;
	batch->v[i] = (y * bx - x * by) * inverse;
	batch->ux[i] = cy * one * inverse;
	batch->uy[i] = -cx * one * inverse;
	batch->vx[i] = -by * one * inverse;
	batch->vy[i] = bx * one * inverse;
}

/* To units of GLOSS_DEPTH_COMPACT_SHIFT, if it @fits. */
LOOP_INLINE int32_t loop_fixed_depth(double value, bool fits)
{
	double scaled = value * (double)(1 << (GLOSS_DEPTH_FRACTION - GLOSS_DEPTH_COMPACT_SHIFT));
	double away = scaled < 0 ? -0.5 : 0.5;

	scaled = fits ? scaled + away : 0;
	return (int32_t)scaled;
}

/* accel_small_plane. */
LOOP_INLINE void loop_small_plane(struct accel_fit_batch *batch, int i)
{
	const int32_t z = batch->depth[0][i], dx = batch->depth[1][i], dy = batch->depth[2][i];
	const int32_t small = -(int32_t)batch->small[i];
	const int32_t unit = 1 << (GLOSS_SMALL_DEPTH_SHIFT - GLOSS_DEPTH_COMPACT_SHIFT);
	int32_t rounded_dx = dx, rounded_dy = dy;

#pragma GCC unroll 4
	for (unsigned int j = 0; j < SMALL_SCALES; j++) {
		const unsigned int shift = small_depth_shift(SMALL_SCALES - 1 - j) -
					   GLOSS_DEPTH_COMPACT_SHIFT;
		int32_t x = (dx + (1 << (shift - 1))) & -(1 << shift);
		int32_t y = (dy + (1 << (shift - 1))) & -(1 << shift);
		int32_t large = ((x ^ -(x < 0)) | (y ^ -(y < 0))) >> (shift + SMALL_DEPTH_BITS - 1);
		int32_t fits = -(int32_t)(large == 0);

		rounded_dx = (x & fits) | (rounded_dx & ~fits);
		rounded_dy = (y & fits) | (rounded_dy & ~fits);
	}
	batch->depth[0][i] = (((z + unit / 2) & -unit) & small) | (z & ~small);
	batch->depth[1][i] = (rounded_dx & small) | (dx & ~small);
	batch->depth[2][i] = (rounded_dy & small) | (dy & ~small);
}

/* accel_surface_plane, where that is narrow, and not so by a hair. */
LOOP_INLINE void loop_plane(struct accel_fit_batch *batch, int i)
{
	double z = batch->z[0][i] * ACCEL_DEPTH_MAX, du = batch->z[1][i] * ACCEL_DEPTH_MAX - z;
	double dv = batch->z[2][i] * ACCEL_DEPTH_MAX - z;
	double dx = du * batch->ux[i] + dv * batch->vx[i];
	double dy = du * batch->uy[i] + dv * batch->vy[i];
	bool fits;

	z += du * batch->u[i] + dv * batch->v[i];
	z += 0.5;
	fits = fabs(z) + ACCEL_NARROW_REACH * (fabs(dx) + fabs(dy)) < ACCEL_NARROW_DEPTH - 1;
	batch->depth[0][i] = loop_fixed_depth(z, fits);
	batch->depth[1][i] = loop_fixed_depth(dx, fits);
	batch->depth[2][i] = loop_fixed_depth(dy, fits);
	batch->narrow[i] &= fits;
}

LOOP_INLINE uint32_t loop_fixed(double value, int32_t *fixed)
{
	double scaled = value * (double)(1u << GLOSS_COLOUR_FRACTION);
	double away = scaled < 0 ? -0.5 : 0.5;
	bool fits = fabs(value) < FIT_MAX;

	scaled = fits ? scaled + away : 0;
	*fixed = (int32_t)scaled;
	return fits;
}

/* A channel's forward differences at the basis's pixel, linear if the triangle is not curved. */
LOOP_INLINE void loop_fit_channel(struct accel_fit_batch *batch, int channel, int i)
{
	const double u = batch->u[i], v = batch->v[i], ux = batch->ux[i], uy = batch->uy[i];
	const double vx = batch->vx[i], vy = batch->vy[i], bent = batch->curved[i];
	double i1 = 255 * (double)batch->colour[0][channel][i];
	double i2 = 255 * (double)batch->colour[1][channel][i];
	double i3 = 255 * (double)batch->colour[2][channel][i];
	double i12 = 255 * (double)batch->colour[3][channel][i];
	double i23 = 255 * (double)batch->colour[4][channel][i];
	double i31 = 255 * (double)batch->colour[5][channel][i];
	double a = bent * (2 * (i1 + i2 - 2 * i12)), b = bent * (2 * (i1 + i3 - 2 * i31));
	double c = bent * (4 * (i1 + i23 - i12 - i31)), d = i2 - i1 - a, e = i3 - i1 - b;
	double du = d + 2 * a * u + c * v, dv = e + 2 * b * v + c * u;
	double xx = 2 * (a * ux * ux + b * vx * vx + c * ux * vx);
	double yy = 2 * (a * uy * uy + b * vy * vy + c * uy * vy);
	double xy = 2 * (a * ux * uy + b * vx * vy) + c * (ux * vy + uy * vx);
	double dx = du * ux + dv * vx + xx / 2, dy = du * uy + dv * vy + yy / 2;
	double at = i1 + u * (d + a * u + c * v) + v * (e + b * v) + 0.5;
	struct accel_surface_batch *out = &batch->surface[channel];

	batch->fits[i] &= loop_fixed(at, &out->i[i]) & loop_fixed(dx, &out->dx[i]) &
			  loop_fixed(dy, &out->dy[i]) & loop_fixed(xx, &out->dxx[i]) &
			  loop_fixed(xy, &out->dxy[i]) & loop_fixed(yy, &out->dyy[i]);
}

LOOP_INLINE float loop_unit(float value)
{
	value = loop_choose(value < 0, 0, value);
	return loop_choose(value > 1, 1, value);
}

/* Does no channel vary by a step, by its control points? */
LOOP_INLINE void loop_flat_channel(struct accel_fit_batch *batch, int channel, int i)
{
	float low = 1, high = 0;

#pragma GCC unroll 4
	for (int j = 0; j < 3; j++) {
		float a = batch->colour[j][channel][i];
		float b = batch->colour[(j + 1) % 3][channel][i];
		float end = loop_unit(a);
		float control = loop_unit(2 * batch->colour[3 + j][channel][i] - (a + b) / 2);

		low = loop_choose(end < low, end, low);
		low = loop_choose(control < low, control, low);
		high = loop_choose(end > high, end, high);
		high = loop_choose(control > high, control, high);
	}
	batch->flat[i] &= !(high - low >= 1 / 255.0f);
	batch->flat_colour[channel][i] = (low + high) / 2;
}

/* 0 to 255. */
LOOP_INLINE uint32_t loop_level(float colour)
{
	return (uint32_t)(int32_t)(loop_unit(colour) * 255 + 0.5f);
}

/* What is sent of its light. */
LOOP_INLINE void loop_form(struct accel_fit_batch *batch, int i)
{
	float a = batch->alpha[0][i], b = batch->alpha[1][i], c = batch->alpha[2][i];
	const uint32_t form = GLOSS_SHADING_LINEAR + batch->curved[i];

	batch->form[i] = form & ~loop_mask(batch->flat[i]);
#pragma GCC unroll 4
	for (int j = 0; j < 3; j++)
		batch->level[j][i] = loop_level(batch->flat_colour[j][i]);
	batch->level[3][i] = loop_level((a + b + c) / 3);
	batch->even[i] = (a == b) & (a == c);
}

static void loop_basis_batch(struct accel_fit_batch *batch, int count)
{
	for (int i = 0; i < count; i++)
		loop_basis(batch, i);
}

static void loop_plane_batch(struct accel_fit_batch *batch, int count)
{
	loop_basis_batch(batch, count);
	for (int i = 0; i < count; i++)
		loop_plane(batch, i);
	for (int i = 0; i < count; i++)
		loop_small_plane(batch, i);
}

static void loop_fit(struct accel_fit_batch *batch, int count)
{
	loop_basis_batch(batch, count);
	for (int i = 0; i < count; i++) {
		batch->fits[i] = 1;
		batch->flat[i] = 1;
	}
	for (int channel = 0; channel < 3; channel++)
		for (int i = 0; i < count; i++)
			loop_fit_channel(batch, channel, i);
	for (int channel = 0; channel < 3; channel++)
		for (int i = 0; i < count; i++)
			loop_flat_channel(batch, channel, i);
	for (int i = 0; i < count; i++)
		loop_form(batch, i);
}
