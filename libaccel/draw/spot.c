// SPDX-License-Identifier: MIT
/* Spots have a step of light at the rim of their cone, which no second-order curve follows. */
#include "draw/draw_priv.h"

/*
 * How far a spot's part of an edge has to be moved at the middle, where its light is @m, to bring
 * the control point to where it may be: between the ends if the light rises or falls from one to
 * the other, else above 0 and, with a rim on the edge, below the samples.
 */
static float spot_correction(float a, float m, float b, bool rim)
{
	float control = 2 * m - (a + b) / 2, low = a < b ? a : b, high = a < b ? b : a, bounded;

	if (m < low || m > high) {
		low = 0;
		high = rim ? m : control;
	}
	bounded = control < low ? low : control > high ? high : control;
	return (bounded - control) / 2;
}

/* What a spot adds at a vertex, of the colour that is there. */
static void spot_light(const struct accel_pass *pass, const struct accel_lamp *lamp,
		       const struct accel_vertex *vertex, int side, float colour[3])
{
	accel_lighting_lamp(&pass->lighting, side, lamp, vertex, colour);
	for (int i = 0; i < 3; i++)
		if (colour[i] > vertex->sample.colour[i])
			colour[i] = vertex->sample.colour[i];
}

/*
 * Light only adds, and so must its curve; but through the step that a rim is it would swing to both
 * sides, and leave pixels darker than without the spot.
 */
void accel_spot_bound(const struct accel_pass *pass, const struct accel_vertex *a,
		      const struct accel_vertex *middle, const struct accel_vertex *b, int side,
		      float colour[3])
{
	uint8_t any = a->sample.in_cone | b->sample.in_cone | middle->sample.in_cone;
	uint8_t all = a->sample.in_cone & b->sample.in_cone & middle->sample.in_cone;

	for (int i = 0; i < pass->lighting.lamps && any; i++) {
		const struct accel_lamp *lamp = &pass->lighting.lamp[i];
		float of_a[3], of_middle[3], of_b[3];

		if (!(any & lamp->bit))
			continue;
		spot_light(pass, lamp, a, side, of_a);
		spot_light(pass, lamp, middle, side, of_middle);
		spot_light(pass, lamp, b, side, of_b);
		for (int j = 0; j < 3; j++)
			colour[j] += spot_correction(of_a[j], of_middle[j], of_b[j],
						     !(all & lamp->bit));
	}
}
