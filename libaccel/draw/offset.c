// SPDX-License-Identifier: MIT
/* What is added to the depth of polygons (OpenGL 1.5, section 3.5.5). */
#include <math.h>

#include "draw/group.h"

/* As much moves any depth out of 0 to 1, where the core keeps it. */
#define OFFSET_MOST 2.0

/* How much depth changes from a pixel to the next, across or down; 0 without an area. */
static double offset_slope(const struct accel_vertex *const vertex[3])
{
	const struct accel_vertex *a = vertex[0], *b = vertex[1], *c = vertex[2];
	const double area = (double)accel_surface_area(a, b, c) / ACCEL_WINDOW_ONE;
	const double bz = b->z - a->z, cz = c->z - a->z;
	const double across = bz * (c->y - a->y) - cz * (b->y - a->y);
	const double down = cz * (b->x - a->x) - bz * (c->x - a->x);

	return area != 0 ? fmax(fabs(across), fabs(down)) / fabs(area) : 0;
}

double accel_offset(const struct accel_state *state, const struct accel_vertex *const vertex[3])
{
	const double slope = state->offset_factor != 0 ? offset_slope(vertex) : 0;
	const double offset = (double)state->offset_factor * slope +
			      (double)state->offset_units / ACCEL_DEPTH_MAX;

	return fmin(fmax(offset, -OFFSET_MOST), OFFSET_MOST);
}
