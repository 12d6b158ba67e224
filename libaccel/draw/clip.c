// SPDX-License-Identifier: MIT
/*
 * Clipping (Sutherland and Hodgman 1974). A new corner is always worked out from the corner inside
 * towards the one outside, so neighbours get the same corner on the edge they share.
 */
#include "draw/draw_priv.h"

static void clip_between(const struct accel_corner *inside, const struct accel_corner *outside, double t,
		    struct accel_corner *corner)
{
	const struct accel_vertex *a = &inside->vertex, *b = &outside->vertex;
	float s = (float)t;

	for (int i = 0; i < 4; i++) {
		corner->clip[i] = inside->clip[i] + t * (outside->clip[i] - inside->clip[i]);
		corner->vertex.sample.colour[i] = a->sample.colour[i] +
			s * (b->sample.colour[i] - a->sample.colour[i]);
	}
	for (int i = 0; i < 3; i++) {
		corner->vertex.eye[i] = a->eye[i] + s * (b->eye[i] - a->eye[i]);
		corner->vertex.normal[i] = a->normal[i] + s * (b->normal[i] - a->normal[i]);
	}
	for (int i = 0; i < 4; i++)
		corner->vertex.paint[i] = a->paint[i] + s * (b->paint[i] - a->paint[i]);
	corner->vertex.level = 0;
	corner->vertex.sampled = 0;
}

/* Rounding may let a sliver cross a plane more than twice; what does not fit is left out. */
static int clip_cut(const struct accel_window *window, int plane, const struct accel_corner *in,
	       int corners, struct accel_corner *out)
{
	int kept = 0;

	for (int i = 0; i < corners && kept + 2 <= ACCEL_POLYGON_MAX; i++) {
		const struct accel_corner *a = &in[i], *b = &in[(i + 1) % corners];
		double da = accel_geometry_distance(window, plane, a->clip);
		double db = accel_geometry_distance(window, plane, b->clip);

		if (da >= 0)
			out[kept++] = *a;
		if (da >= 0 && db < 0)
			clip_between(a, b, da / (da - db), &out[kept++]);
		else if (da < 0 && db >= 0)
			clip_between(b, a, db / (db - da), &out[kept++]);
	}
	return kept;
}

int accel_clip_polygon(const struct accel_window *window, uint32_t planes,
		       struct accel_corner polygon[ACCEL_POLYGON_MAX])
{
	struct accel_corner copy[ACCEL_POLYGON_MAX];
	int corners = 3;

	for (int plane = 0; plane < ACCEL_CLIP_PLANES && corners; plane++) {
		if (!(planes >> plane & 1))
			continue;
		for (int i = 0; i < corners; i++)
			copy[i] = polygon[i];
		corners = clip_cut(window, plane, copy, corners, polygon);
	}
	for (int i = 0; i < corners; i++)
		accel_geometry_project(window, polygon[i].clip, &polygon[i].vertex);
	return corners < 3 ? 0 : corners;
}

/* Are no two triangles of the fan on different sides? */
static bool clip_fan_even(const struct accel_corner *polygon, int corners, int apex)
{
	bool up = false, down = false;

	for (int i = 1; i + 1 < corners; i++) {
		int64_t area = accel_surface_area(&polygon[apex].vertex,
						  &polygon[(apex + i) % corners].vertex,
						  &polygon[(apex + i + 1) % corners].vertex);

		up |= area > 0;
		down |= area < 0;
	}
	return !(up && down);
}

int accel_clip_apex(const struct accel_corner *polygon, int corners)
{
	int apex = 0;

	/* Snapping may dent a polygon that was convex. */
	while (apex < corners && !clip_fan_even(polygon, corners, apex))
		apex++;
	return apex % corners;
}
