// SPDX-License-Identifier: MIT
/*
 * Clipping (Sutherland and Hodgman 1974). A new corner is always worked out from the corner inside
 * towards the one outside, so neighbours get the same corner on the edge they share.
 *
 * An edge may come from where a double's last digit is larger than all that is seen, and yet pass
 * through the window: along it numbers are wide.
 */
#include "draw/geometry_window.h"
#include "draw/triangle.h"

static struct accel_wide clip_place(const struct accel_corner *corner, int i)
{
	return (struct accel_wide){ corner->clip[i], corner->rest[i] };
}

void accel_clip_corner(const struct accel_transform *transform, const float position[4],
		       struct accel_corner *corner)
{
	const double at[4] = { (double)position[0], (double)position[1], (double)position[2],
			       (double)position[3] };
	const double *m = transform->clip;

	for (int i = 0; i < ACCEL_USER_CLIP_PLANES; i++)
		corner->distance[i] = geometry_user_distance(transform->plane[i], at);
	accel_geometry_clip_space(transform, position, corner->clip);
	for (int row = 0; row < 4; row++) {
		struct accel_wide sum = accel_wide_of_product(m[12 + row], (double)position[3]);

		for (int i = 0; i < 3; i++)
			sum = accel_wide_add(sum, accel_wide_of_product(m[4 * i + row],
									(double)position[i]));
		corner->rest[row] = (sum.high - corner->clip[row]) + sum.low;
	}
}

/* A plane's distance as a sum: of clip space's coordinates times factors, and a constant. */
struct clip_plane {
	double factor[4], constant;
};

static void clip_find_plane(const struct accel_window *window, int number, struct clip_plane *plane)
{
	static const double zero[4];

	plane->constant = accel_geometry_distance(window, number, zero);
	for (int i = 0; i < 4; i++) {
		const double one[4] = { i == 0, i == 1, i == 2, i == 3 };

		plane->factor[i] = accel_geometry_distance(window, number, one) - plane->constant;
	}
}

static struct accel_wide clip_distance(const struct clip_plane *plane,
				       const struct accel_corner *corner)
{
	struct accel_wide sum = { plane->constant, 0 };

	for (int i = 0; i < 4; i++)
		if (plane->factor[i] != 0)
			sum = accel_wide_add(sum, accel_wide_scale(clip_place(corner, i),
								   plane->factor[i]));
	return sum;
}

/* @da, @db: their distances from the plane. */
static void clip_between(const struct accel_corner *inside, const struct accel_corner *outside,
			 struct accel_wide da, struct accel_wide db, struct accel_corner *corner)
{
	const struct accel_vertex *a = &inside->vertex, *b = &outside->vertex;
	struct accel_wide t = accel_wide_divide(da, accel_wide_add(da, accel_wide_negative(db)));
	float s = (float)t.high;

	for (int i = 0; i < 4; i++) {
		struct accel_wide from = clip_place(inside, i), way;

		way = accel_wide_add(clip_place(outside, i), accel_wide_negative(from));
		way = accel_wide_add(from, accel_wide_multiply(t, way));
		corner->clip[i] = way.high;
		corner->rest[i] = way.low;
		corner->vertex.sample.colour[i] = a->sample.colour[i] +
						  s * (b->sample.colour[i] - a->sample.colour[i]);
	}
	for (int i = 0; i < ACCEL_USER_CLIP_PLANES; i++)
		corner->distance[i] = inside->distance[i] +
				      t.high * (outside->distance[i] - inside->distance[i]);
	for (int i = 0; i < 3; i++) {
		corner->vertex.eye[i] = a->eye[i] + s * (b->eye[i] - a->eye[i]);
		corner->vertex.normal[i] = a->normal[i] + s * (b->normal[i] - a->normal[i]);
	}
	corner->vertex.length = a->length + s * (b->length - a->length);
	for (int i = 0; i < 4; i++)
		corner->vertex.paint[i] = a->paint[i] + s * (b->paint[i] - a->paint[i]);
	corner->vertex.level = 0;
	corner->vertex.sampled = 0;
}

/* A corner on the edge from @from to the next, where the plane cuts it. */
static void clip_edge(const struct accel_corner *from, const struct accel_corner *next, bool leaves,
		      struct accel_corner *corner)
{
	if (leaves)
		clip_between(from, next, from->cut, next->cut, corner);
	else
		clip_between(next, from, next->cut, from->cut, corner);
	/* Along the plane a new edge begins; else it is the rest of this one. */
	corner->boundary = leaves || from->boundary;
}

/*
 * Cuts by the plane that corners are at distances @cut from. Rounding may let a sliver cross it more
 * than twice; what does not fit is left out.
 */
static int clip_cut(const struct accel_clipped *polygon, int corners)
{
	struct accel_corner *in = polygon->spare, *out = polygon->corner;
	int kept = 0;

	for (int i = 0; i < corners; i++)
		in[i] = out[i];
	for (int i = 0; i < corners && kept + 2 <= polygon->most; i++) {
		const struct accel_corner *next = &in[(i + 1) % corners];
		const bool inside = in[i].cut.high >= 0;

		if (inside)
			out[kept++] = in[i];
		if (inside != (next->cut.high >= 0))
			clip_edge(&in[i], next, inside, &out[kept++]);
	}
	return kept;
}

int accel_clip_polygon(const struct accel_window *window, uint32_t planes,
		       const struct accel_clipped *polygon, int corners)
{
	struct accel_corner *corner = polygon->corner;
	struct clip_plane plane;

	for (int number = 0; number < ACCEL_CLIP_PLANES && corners; number++) {
		if (!(planes >> number & 1))
			continue;
		clip_find_plane(window, number, &plane);
		for (int i = 0; i < corners; i++)
			corner[i].cut = clip_distance(&plane, &corner[i]);
		corners = clip_cut(polygon, corners);
	}
	for (int number = 0; number < ACCEL_USER_CLIP_PLANES && corners; number++) {
		if (!(planes >> ACCEL_OUTSIDE_USER_BIT >> number & 1))
			continue;
		for (int i = 0; i < corners; i++)
			corner[i].cut = (struct accel_wide){ corner[i].distance[number], 0 };
		corners = clip_cut(polygon, corners);
	}
	for (int i = 0; i < corners; i++)
		accel_geometry_project(window, corner[i].clip, &corner[i].vertex);
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
