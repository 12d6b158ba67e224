// SPDX-License-Identifier: MIT
/*
 * Clipping (2.11) of polygons, and of the colours with them (2.14.8). To the sides of the view a
 * polygon is not cut: that the viewport's pixels alone are drawn is the same, but for how cut
 * corners would be rounded.
 */
#include "oracle.h"

#include <string.h>

#define CLIP_PLANES (2 + ORACLE_PLANES)

/* How far inside: the near plane, the far one, then those of the user. */
static double distance(const struct oracle_state *state, int plane,
		       const struct oracle_corner *corner)
{
	double sum = 0;

	if (plane == 0)
		return corner->clip[3] + corner->clip[2];
	if (plane == 1)
		return corner->clip[3] - corner->clip[2];
	for (int i = 0; i < 4; i++)
		sum += state->plane[plane - 2][i] * corner->eye[i];
	return sum;
}

static void mix(const double *a, const double *b, double t, double *out, int count)
{
	for (int i = 0; i < count; i++)
		out[i] = a[i] + t * (b[i] - a[i]);
}

/* The corner where the way from @a, inside by @da, to @b, outside, meets the plane. */
static void between(const struct oracle_corner *a, const struct oracle_corner *b, double da,
		    double db, struct oracle_corner *out)
{
	double t = da / (da - db);

	mix(a->eye, b->eye, t, out->eye, 4);
	mix(a->clip, b->clip, t, out->clip, 4);
	mix(a->normal, b->normal, t, out->normal, 3);
	mix(&a->length, &b->length, t, &out->length, 1);
	mix(a->current, b->current, t, out->current, 4);
	for (int side = 0; side < ORACLE_SIDES; side++)
		for (int i = 0; i < 2; i++)
			mix(a->colour[side][i], b->colour[side][i], t, out->colour[side][i], 4);
}

static int cut_off(const struct oracle_state *state, int plane, struct oracle_corner *polygon,
		   int corners, bool *cut)
{
	struct oracle_corner out[ORACLE_CORNERS + 1];
	int kept = 0;

	for (int i = 0; i < corners && kept + 2 <= ORACLE_CORNERS; i++) {
		const struct oracle_corner *a = &polygon[i], *b = &polygon[(i + 1) % corners];
		double da = distance(state, plane, a), db = distance(state, plane, b);

		if (da >= 0)
			out[kept++] = *a;
		*cut |= da < 0;
		if (da >= 0 && db < 0)
			between(a, b, da, db, &out[kept++]);
		else if (da < 0 && db >= 0)
			between(b, a, db, da, &out[kept++]);
	}
	memcpy(polygon, out, (size_t)kept * sizeof(*polygon));
	return kept;
}

int oracle_clip(const struct oracle_state *state, struct oracle_corner polygon[ORACLE_CORNERS],
		int corners, bool *cut)
{
	*cut = false;
	for (int plane = 0; plane < CLIP_PLANES && corners; plane++)
		if (plane < 2 || state->planes >> (plane - 2) & 1)
			corners = cut_off(state, plane, polygon, corners, cut);
	return corners < 3 ? 0 : corners;
}
