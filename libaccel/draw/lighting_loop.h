/* SPDX-License-Identifier: MIT */
/* The light at points of a surface; a part of kernel_loops.h. What it says is in lighting.c. */
#include <float.h>
#include <math.h>

#include "draw/kernel.h"
#include "draw/lighting_power.h"

LOOP_INLINE float loop_dot(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Returns the length that @v had; a vector without length stays so. */
LOOP_INLINE float loop_normalise(float v[3])
{
	float length = sqrtf(loop_dot(v, v));
	float scale = loop_choose(length > 0, 1 / length, 0);

	v[0] *= scale;
	v[1] *= scale;
	v[2] *= scale;
	return length;
}

/* The unit vectors of a point, and its sample before there is light. */
LOOP_INLINE void loop_light_begin(const struct accel_lighting *lighting, int side,
				  struct accel_light_batch *batch, int count)
{
	const float sign = side ? -1 : 1;
	const bool local = lighting->local_viewer;

	for (int i = 0; i < count; i++) {
		float normal[3] = { sign * batch->normal[0][i], sign * batch->normal[1][i],
				    sign * batch->normal[2][i] };
		float viewer[3] = { -batch->eye[0][i], -batch->eye[1][i], -batch->eye[2][i] };
		float distance = loop_normalise(viewer);

		loop_normalise(normal);
#pragma GCC unroll 4
		for (int j = 0; j < 3; j++) {
			batch->unit[j][i] = normal[j];
			batch->viewer[j][i] = local ? viewer[j] : j == 2;
		}
		batch->near[i] = local ? 1 / (distance * distance) : 0;
		batch->near_lamp[i] = 0;
		batch->shine[i] = -1;
		batch->facing[i] = 0;
		batch->in_cone[i] = 0;
	}
}

/* What of the material is the paint's. */
LOOP_INLINE void loop_tint(bool painted, struct accel_light_batch *batch,
			   float (*tint)[ACCEL_BATCH], int count)
{
#pragma GCC unroll 4
	for (int j = 0; j < 3; j++)
		for (int i = 0; i < count; i++)
			tint[j][i] = loop_choose(painted, batch->paint[j][i], 1);
}

LOOP_INLINE void loop_tints(const struct accel_finish *finish, struct accel_light_batch *batch,
			    int count)
{
	loop_tint(finish->paints_ambient, batch, batch->ambient, count);
	loop_tint(finish->paints_diffuse, batch, batch->diffuse, count);
	loop_tint(finish->paints_specular, batch, batch->specular, count);
}

/* A highlight is a power of a cosine, times this power of the normal's length. */
LOOP_INLINE void loop_gloss(const struct accel_lighting *lighting, float shininess,
			    struct accel_light_batch *batch, int count)
{
	for (int i = 0; i < count; i++)
		batch->gloss[i] = 1;
	for (int i = 0; i < count && !lighting->unit; i++) {
		float length = batch->length[i];
		float least = loop_choose(length < 1, length, 1 / length);
		float power = loop_power(least, shininess);

		power = loop_choose(power > 0x1p-126f, power, 0x1p-126f);
		batch->gloss[i] = loop_choose(length < 1, power, 1 / power);
	}
}

/* The direction towards a lamp that is a point; returns how much of its light arrives. */
LOOP_INLINE float loop_reach(const struct accel_lamp *lamp, struct accel_light_batch *batch, int i,
			     float to[3], bool spot)
{
	float distance, near, cosine, factor;
	bool dark;

#pragma GCC unroll 4
	for (int j = 0; j < 3; j++)
		to[j] = lamp->position[j] - batch->eye[j][i];
	distance = loop_normalise(to);
	near = 1 / (distance * distance);
	batch->near_lamp[i] = loop_choose(near > batch->near_lamp[i], near, batch->near_lamp[i]);
	/* In the lamp itself there may be no attenuation; what is dark stays so there too. */
	factor = 1 / (lamp->attenuation[0] +
		      distance * (lamp->attenuation[1] + distance * lamp->attenuation[2]));
	factor = loop_choose(factor < FLT_MAX, factor, FLT_MAX);
	if (!spot)
		return factor;
	cosine = -loop_dot(to, lamp->cone_axis);
	dark = cosine < lamp->cone_cosine;
	batch->in_cone[i] |= ~loop_mask(dark) & lamp->bit;
	factor *= loop_power(cosine, lamp->cone_exponent);
	return loop_choose(dark, 0, factor);
}

/* The cosine between the normal and the half vector. */
LOOP_INLINE float loop_half_cosine(const struct accel_lamp *lamp, struct accel_light_batch *batch,
				   int i, const float normal[3], const float to[3], bool moves)
{
	float half[3];

	if (!moves)
		return loop_dot(normal, lamp->half);
#pragma GCC unroll 4
	for (int j = 0; j < 3; j++)
		half[j] = to[j] + batch->viewer[j][i];
	loop_normalise(half);
	return loop_dot(normal, half);
}

/* @moves: the half vector is not the same everywhere. */
LOOP_INLINE void loop_lamp(const struct accel_lighting *lighting, const struct accel_lamp *from,
			   int side, struct accel_light_batch *batch, int count, bool point,
			   bool spot, bool shines, bool moves)
{
	const struct accel_finish finish = lighting->finish[side];
	const struct accel_lamp lamp = *from; /* which nothing in @batch can change */

	for (int i = 0; i < count; i++) {
		const float normal[3] = { batch->unit[0][i], batch->unit[1][i], batch->unit[2][i] };
		float to[3] = { lamp.position[0], lamp.position[1], lamp.position[2] };
		float factor = 1, highlight = 0, cosine, shine;
		bool lit;

		if (point) {
			factor = loop_reach(&lamp, batch, i, to, spot);
#pragma GCC unroll 4
			for (int j = 0; j < 3; j++)
				batch->colour[j][i] += factor * lamp.ambient[side][j] *
						       batch->ambient[j][i];
		}
		cosine = loop_dot(normal, to);
		lit = cosine > 0;
		if (shines) {
			shine = loop_half_cosine(&lamp, batch, i, normal, to, moves);
			batch->shine[i] = loop_choose(shine > batch->shine[i], shine,
						      batch->shine[i]);
			highlight = factor * loop_power(shine, finish.shininess) * batch->gloss[i];
			highlight = loop_choose((shine > finish.faint_cosine) |
							(finish.shininess == 0) |
							(batch->length[i] > 1),
						highlight, 0);
			highlight = loop_choose(highlight < FLT_MAX, highlight, FLT_MAX);
		}
		batch->facing[i] |= loop_mask(lit) & lamp.bit;
		cosine *= factor * batch->length[i];
#pragma GCC unroll 4
		for (int j = 0; j < 3; j++) {
			float more = cosine * lamp.diffuse[side][j] * batch->diffuse[j][i] +
				     highlight * lamp.specular[side][j] * batch->specular[j][i];
			float sum = batch->colour[j][i] + more;

			batch->colour[j][i] = loop_choose(lit, sum, batch->colour[j][i]);
		}
	}
}

static void loop_any_lamp(const struct accel_lighting *lighting, const struct accel_lamp *lamp,
			  int side, struct accel_light_batch *batch, int count)
{
	if (lamp->spot && lamp->shines)
		loop_lamp(lighting, lamp, side, batch, count, true, true, true, true);
	else if (lamp->spot)
		loop_lamp(lighting, lamp, side, batch, count, true, true, false, false);
	else if (lamp->point && lamp->shines)
		loop_lamp(lighting, lamp, side, batch, count, true, false, true, true);
	else if (lamp->point)
		loop_lamp(lighting, lamp, side, batch, count, true, false, false, false);
	else if (lamp->shines && lighting->local_viewer)
		loop_lamp(lighting, lamp, side, batch, count, false, false, true, true);
	else if (lamp->shines)
		loop_lamp(lighting, lamp, side, batch, count, false, false, true, false);
	else
		loop_lamp(lighting, lamp, side, batch, count, false, false, false, false);
}

/* Also turns what is not a number into 0. */
LOOP_INLINE void loop_clamp_colour(struct accel_light_batch *batch, int count)
{
#pragma GCC unroll 4
	for (int j = 0; j < 3; j++)
		for (int i = 0; i < count; i++) {
			float value = batch->colour[j][i] > 0 ? batch->colour[j][i] : 0;

			batch->colour[j][i] = value < ACCEL_COLOUR_MAX ? value : ACCEL_COLOUR_MAX;
		}
}

static void loop_light(const struct accel_lighting *lighting, int side,
		       struct accel_light_batch *batch, int count)
{
	const struct accel_finish *finish = &lighting->finish[side];

	loop_light_begin(lighting, side, batch, count);
#pragma GCC unroll 4
	for (int j = 0; j < 3; j++) {
		const float base = finish->base[j], plain = finish->plain[j];

		for (int i = 0; i < count; i++)
			batch->colour[j][i] = base * batch->paint[j][i] + plain;
	}
	loop_tints(finish, batch, count);
	loop_gloss(lighting, finish->shininess, batch, count);
	for (int i = 0; i < lighting->lamps; i++)
		loop_any_lamp(lighting, &lighting->lamp[i], side, batch, count);
	loop_clamp_colour(batch, count);
	for (int i = 0; i < count; i++) {
		batch->near[i] = batch->near_lamp[i] > batch->near[i] ? batch->near_lamp[i] :
									batch->near[i];
		batch->colour[3][i] = loop_choose(finish->paints_diffuse, batch->paint[3][i],
						  finish->alpha);
		batch->colour[3][i] = loop_choose(batch->colour[3][i] > 0, batch->colour[3][i], 0);
		batch->colour[3][i] = loop_choose(batch->colour[3][i] < 1, batch->colour[3][i], 1);
	}
}

static void loop_light_lamp(const struct accel_lighting *lighting, const struct accel_lamp *lamp,
			    int side, struct accel_light_batch *batch, int count)
{
	loop_light_begin(lighting, side, batch, count);
	loop_tints(&lighting->finish[side], batch, count);
	loop_gloss(lighting, lighting->finish[side].shininess, batch, count);
#pragma GCC unroll 4
	for (int j = 0; j < 3; j++)
		for (int i = 0; i < count; i++)
			batch->colour[j][i] = 0;
	loop_any_lamp(lighting, lamp, side, batch, count);
	loop_clamp_colour(batch, count);
}
