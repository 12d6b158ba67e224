/* SPDX-License-Identifier: MIT */
/* What the ends of edges tell of them; a part of kernel_loops.h. What it is good for is in shading.c. */
#include <math.h>

#include "draw/kernel.h"
#include "draw/highlight.h"
#include "draw/loop.h"

LOOP_INLINE float loop_larger(float a, float b)
{
	return loop_choose(a > b, a, b);
}

/* The square of the angle between the normals (of its chord, exactly). */
LOOP_INLINE float loop_normal_spread(const struct accel_edge_batch *batch, int i)
{
	const float a[3] = { batch->normal[0][0][i], batch->normal[0][1][i],
			     batch->normal[0][2][i] };
	const float b[3] = { batch->normal[1][0][i], batch->normal[1][1][i],
			     batch->normal[1][2][i] };
	float length = loop_dot(a, a) * loop_dot(b, b);
	float spread = loop_larger(2 - 2 * loop_dot(a, b) / sqrtf(length), 0);

	return loop_choose(length > 0, spread, 0);
}

LOOP_INLINE float loop_distance_squared(const struct accel_edge_batch *batch, int i)
{
	float sum = 0;

#pragma GCC unroll 4
	for (int j = 0; j < 3; j++) {
		float d = batch->eye[0][j][i] - batch->eye[1][j][i];

		sum += d * d;
	}
	return sum;
}

/* The square of an edge's length on the screen in pixels. */
LOOP_INLINE float loop_screen_length(const struct accel_edge_batch *batch, int i)
{
	const float scale = 1.0f / ACCEL_WINDOW_ONE;
	float x = (float)(batch->x[1][i] - batch->x[0][i]) * scale;
	float y = (float)(batch->y[1][i] - batch->y[0][i]) * scale;

	return x * x + y * y;
}

LOOP_INLINE void loop_span(struct accel_edge_batch *batch, int i)
{
	float near = loop_larger(batch->near[0][i], batch->near[1][i]);
	float near_lamp = loop_larger(batch->near_lamp[0][i], batch->near_lamp[1][i]);
	float distance = loop_distance_squared(batch, i), normals = loop_normal_spread(batch, i);
	float place = loop_choose(near > 0, near * distance, 0);
	bool lamps = (batch->near_lamp[0][i] > 0) | (batch->near_lamp[1][i] > 0);

	batch->length[i] = loop_screen_length(batch, i);
	batch->spread[i] = normals + place + 2 * sqrtf(normals * place);
	batch->lamp[i] = loop_choose(lamps, near_lamp * distance, 0);
	batch->most_shine[i] = loop_larger(batch->shine[0][i], batch->shine[1][i]);
	batch->even[i] = batch->lights[0][i] == batch->lights[1][i];
}

/* Bound of the midpoint's distance from the straight line, from second derivatives. */
LOOP_INLINE void loop_bend(const struct accel_finish *finish, float cone_exponent,
			   struct accel_edge_batch *batch, int i)
{
	const float wa = batch->w[0][i], wb = batch->w[1][i], spread = batch->spread[i];
	/* Within half the edge of one of its ends. */
	const bool near = highlight_near(finish, batch->most_shine[i], spread / 4);
	float change = 0, strength, lamps = finish->diffuse + finish->specular;

#pragma GCC unroll 4
	for (int j = 0; j < 3; j++)
		change = loop_larger(change,
				     fabsf(batch->colour[0][j][i] - batch->colour[1][j][i]));
	strength = finish->diffuse + finish->specular * loop_larger(finish->shininess, 1);
	strength = loop_choose(near, strength, finish->diffuse);
	/* Attenuation falls with the square of the distance at most. */
	lamps = lamps * (cone_exponent + 6) * batch->lamp[i];
	batch->bend[i] = change * (fabsf(wa - wb) / (2 * (wa + wb))) +
			 (strength * spread + lamps) / 8;
}

static void loop_edge(const struct accel_lighting *lighting, int side,
		      struct accel_edge_batch *batch, int count)
{
	const struct accel_finish finish = lighting->finish[side];
	const float cone_exponent = lighting->cone_exponent;

	for (int i = 0; i < count; i++)
		loop_span(batch, i);
	for (int i = 0; i < count; i++)
		loop_bend(&finish, cone_exponent, batch, i);
}
