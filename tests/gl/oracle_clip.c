// SPDX-License-Identifier: MIT
/*
 * Clipping (2.11) of polygons, and of the colours with them (2.14.8). To the sides of the view a
 * polygon is not cut: that the viewport's pixels alone are drawn is the same, but for how cut
 * corners would be rounded. A line beyond a side is not drawn however wide it is; one that ends there
 * is not cut, which is the same but for some pixels at its side.
 */
#include "oracle.h"

#include <math.h>
#include <string.h>

#define CLIP_PLANES (2 + ORACLE_PLANES)
/* Of w: a point so near to the sides may be in or out. */
#define UNSURE 1e-5

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

/* Whether both ends of a line are beyond the same side of the view. */
static bool beside(const struct oracle_corner end[2])
{
	for (int i = 0; i < 2; i++) {
		bool low = true, high = true;

		for (int j = 0; j < 2; j++) {
			low = low && end[j].clip[i] < -end[j].clip[3];
			high = high && end[j].clip[i] > end[j].clip[3];
		}
		if (low || high)
			return true;
	}
	return false;
}

bool oracle_clip_line(const struct oracle_state *state, struct oracle_corner end[2])
{
	if (beside(end))
		return false;
	for (int plane = 0; plane < CLIP_PLANES; plane++) {
		struct oracle_corner cut;
		double d[2];

		if (plane >= 2 && !(state->planes >> (plane - 2) & 1))
			continue;
		for (int i = 0; i < 2; i++)
			d[i] = distance(state, plane, &end[i]);
		if (d[0] < 0 && d[1] < 0)
			return false;
		for (int i = 0; i < 2; i++) {
			if (d[i] >= 0)
				continue;
			between(&end[!i], &end[i], d[!i], d[i], &cut);
			end[i] = cut;
		}
	}
	return true;
}

bool oracle_in_view(const struct oracle_state *state, const struct oracle_corner *corner,
		    bool *doubt)
{
	const double w = corner->clip[3];
	bool in = true;

	for (int i = 0; i < 3; i++) {
		in = in && fabs(corner->clip[i]) <= w;
		*doubt |= fabs(fabs(corner->clip[i]) - w) < UNSURE * fabs(w);
	}
	for (int plane = 2; plane < CLIP_PLANES; plane++)
		if (state->planes >> (plane - 2) & 1)
			in = in && distance(state, plane, corner) >= 0;
	return in;
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
