// SPDX-License-Identifier: MIT
/*
 * Colours that vertices have and points between them do not: linear in space, as OpenGL says, and
 * so along an edge of the screen a hyperbola if w differs at its ends. It is taken as a straight
 * line, as the second-order curve through its middle, or split there, as the edge's own two
 * vertices decide.
 */
#include <math.h>

#include "draw/draw_priv.h"

/* A step of a channel. */
#define STEP (1 / 255.0f)
/* A middle nearer to the straight line than this is taken to be on it. Between the edges, and
 * beside their middles, a surface may be off by twice as much. */
#define STRAIGHT (0.7f * STEP)
#define STRAIGHT_ALPHA (0.4f * STEP) /* which has no second-order surface */
/* Errors of the second-order curve beyond this are worth a split. */
#define CURVE (0.5f * STEP)

/* How far the first @channels of @a and @b are from each other. */
static float interpolate_difference(const float *a, const float *b, int channels)
{
	float most = 0;

	for (int i = 0; i < channels; i++)
		most = number_larger(most, fabsf(a[i] - b[i]));
	return most;
}

/* The distance of the hyperbola's middle from the straight line's, for ends that are 1 apart. */
static float interpolate_bend(float wa, float wb)
{
	return fabsf(wa - wb) / (2 * (wa + wb));
}

bool accel_interpolate_straight(const struct accel_vertex *const vertex[3])
{
	for (int i = 0; i < 3; i++)
		if (interpolate_bend(vertex[i]->w, vertex[(i + 1) % 3]->w) >= STRAIGHT_ALPHA)
			return false;
	return true;
}

/* The curve's error a quarter of the way from @a. */
static float interpolate_curve_error(const struct accel_vertex *a,
				     const struct accel_vertex *middle,
				     const struct accel_vertex *b)
{
	struct accel_vertex quarter;
	float curve[3];

	accel_patch_middle(a, middle, &quarter);
	for (int i = 0; i < 3; i++)
		curve[i] = 0.375f * a->sample.colour[i] + 0.75f * middle->sample.colour[i] -
			   0.125f * b->sample.colour[i];
	return interpolate_difference(curve, quarter.sample.colour, 3);
}

void accel_interpolate_edge(const struct accel_vertex *a, const struct accel_vertex *b,
			    struct accel_edge *edge)
{
	float factor = interpolate_bend(a->w, b->w);
	bool bends = interpolate_difference(a->sample.colour, b->sample.colour, 3) * factor >=
		     STRAIGHT;
	bool alpha_bends = interpolate_difference(&a->sample.colour[3], &b->sample.colour[3], 1) *
				   factor >=
			   STRAIGHT_ALPHA;
	struct accel_vertex middle;

	*edge = (struct accel_edge){ .curved = false };
	for (int i = 0; i < 3; i++)
		edge->colour[i] = (a->sample.colour[i] + b->sample.colour[i]) / 2;
	if (!bends && !alpha_bends)
		return;
	accel_patch_middle(a, b, &middle);
	edge->middle = middle.sample;
	edge->sampled = edge->curved = edge->examine = true;
	for (int i = 0; i < 3; i++)
		edge->colour[i] = middle.sample.colour[i];
	if (!accel_patch_divisible(a, b))
		return;
	edge->split = alpha_bends || interpolate_curve_error(a, &middle, b) > CURVE ||
		      interpolate_curve_error(b, &middle, a) > CURVE;
}

bool accel_interpolate_inside(const struct accel_patch *patch)
{
	float curve[3], alpha = 0;
	struct accel_vertex middle;

	accel_patch_centre(patch, &middle);
	for (int i = 0; i < 3; i++)
		alpha += patch->vertex[i]->sample.colour[3] / 3;
	accel_patch_surface_centre(patch, curve);
	return interpolate_difference(curve, middle.sample.colour, 3) > CURVE ||
	       fabsf(alpha - middle.sample.colour[3]) > STRAIGHT;
}
