// SPDX-License-Identifier: MIT
/*
 * Polygons in the window: their place (2.10.1), which side is seen and whether it is culled
 * (2.14.1, 3.5.1), the pixels whose centres are inside, colours and depths there (equations 3.6 and
 * 3.7).
 */
#include "oracle.h"

#include <math.h>
#include <string.h>

/* Of a sixteenth: what is nearer to half of one may be rounded to either side. */
#define UNSURE 0.002
/* Pixels from the window's corner that a polygon may reach before products limit it. */
#define FAR_AWAY 900

/* Twice the area of a triangle, positive if it turns counter-clockwise. */
static double area(const struct oracle_place *a, const struct oracle_place *b,
		   const struct oracle_place *c)
{
	return (b->x - a->x) * (c->y - a->y) - (c->x - a->x) * (b->y - a->y);
}

static double rounded(double value, bool *doubt)
{
	*doubt |= fabs(value - floor(value) - 0.5) < UNSURE ||
		  !(fabs(value) < FAR_AWAY * ORACLE_ROUND);
	return floor(value + 0.5);
}

static struct oracle_place round_place(const struct oracle_place *place, bool *doubt)
{
	return (struct oracle_place){ rounded(place->x, doubt), rounded(place->y, doubt), place->z,
				      place->w };
}

static struct oracle_place place_of(const struct oracle_state *state, const double clip[4])
{
	const double *v = state->viewport;
	double ndc[3];

	for (int i = 0; i < 3; i++)
		ndc[i] = clip[i] / clip[3];
	return (struct oracle_place){
		.x = (v[0] + (ndc[0] + 1) * v[2] / 2) * ORACLE_ROUND,
		.y = (v[1] + (ndc[1] + 1) * v[3] / 2) * ORACLE_ROUND,
		.z = state->near + (ndc[2] + 1) / 2 * (state->far - state->near),
		.w = clip[3],
	};
}

struct oracle_place oracle_place(const struct oracle_state *state, const double clip[4],
				 bool *doubt)
{
	const struct oracle_place place = place_of(state, clip);

	return round_place(&place, doubt);
}

/* Twice the area; a polygon that rounding dents, or makes a line, is in doubt. */
static double polygon_area(const struct oracle_place *place, int corners, bool *doubt)
{
	double sum = 0, least = 0, most = 0;

	for (int i = 0; i < corners; i++) {
		double turn = area(&place[i], &place[(i + 1) % corners], &place[(i + 2) % corners]);

		sum += place[i].x * place[(i + 1) % corners].y -
		       place[(i + 1) % corners].x * place[i].y;
		least = fmin(least, turn);
		most = fmax(most, turn);
	}
	*doubt |= (least < 0 && most > 0) || fabs(sum) < 1;
	return sum;
}

static bool culled(const struct oracle_state *state, enum oracle_side side)
{
	return state->cull == (side == ORACLE_FRONT ? ORACLE_CULL_FRONT : ORACLE_CULL_BACK);
}

/* Pixels inside of the nearest edge of a counter-clockwise polygon; below 0: outside. */
static double depth_inside(const struct oracle_place *place, int corners,
			   const struct oracle_place *centre)
{
	double nearest = INFINITY;

	for (int i = 0; i < corners; i++) {
		const struct oracle_place *a = &place[i], *b = &place[(i + 1) % corners];
		double dx = b->x - a->x, dy = b->y - a->y, side = area(a, b, centre);

		if (dx == 0 && dy == 0)
			continue;
		/* Down a left edge and leftwards along a top one, centres on it are inside. */
		if (side < 0 || (side == 0 && !(dy < 0 || (dy == 0 && dx < 0))))
			return -1;
		nearest = fmin(nearest, side / hypot(dx, dy) / ORACLE_ROUND);
	}
	return nearest;
}

/* A polygon as it is filled: counter-clockwise. */
struct drawn {
	const struct oracle_corner *corner;
	struct oracle_place rounded[ORACLE_CORNERS]; /* what it covers */
	struct oracle_place
		place[ORACLE_CORNERS]; /* what colours and depths are interpolated between */
	int corners;
	bool cut; /* or of more than three corners */
	enum oracle_side side;
	int largest[3]; /* corners of the largest triangle of a fan: all others are in its plane */
};

static void find_largest(struct drawn *drawn)
{
	double most = 0;

	for (int i = 1; i + 1 < drawn->corners; i++) {
		double size = area(&drawn->place[0], &drawn->place[i], &drawn->place[i + 1]);

		if (size <= most)
			continue;
		most = size;
		drawn->largest[0] = 0;
		drawn->largest[1] = i;
		drawn->largest[2] = i + 1;
	}
}

/* The parts that corners have in a point on screen, and those in perspective (3.6). */
static void shares_at(const struct drawn *drawn, const struct oracle_place *at, double share[3],
		      double weight[3])
{
	const struct oracle_place *p[3];
	double whole, sum = 0;

	for (int i = 0; i < 3; i++)
		p[i] = &drawn->place[drawn->largest[i]];
	whole = area(p[0], p[1], p[2]);
	for (int i = 0; i < 3; i++) {
		share[i] = area(p[(i + 1) % 3], p[(i + 2) % 3], at) / whole;
		weight[i] = share[i] / p[i]->w;
		sum += weight[i];
	}
	for (int i = 0; i < 3; i++)
		weight[i] /= sum;
}

static void add(double *sum, double weight, const double *value, int count)
{
	for (int i = 0; i < count; i++)
		sum[i] += weight * value[i];
}

static double length(const double v[3])
{
	return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Lit here: the normal turns from corner to corner, and its length changes evenly. */
static void light_at(const struct oracle_state *state, const struct drawn *drawn,
		     const double weight[3], double colour[2][4])
{
	double eye[4] = { 0 }, normal[3] = { 0 }, current[4] = { 0 }, wanted = 0, has;

	for (int i = 0; i < 3; i++) {
		const struct oracle_corner *corner = &drawn->corner[drawn->largest[i]];

		add(eye, weight[i], corner->eye, 4);
		add(normal, weight[i], corner->normal, 3);
		add(current, weight[i], corner->current, 4);
		wanted += weight[i] * corner->length;
	}
	has = length(normal);
	for (int i = 0; i < 3 && has > 0; i++)
		normal[i] *= wanted / has;
	oracle_light(state, drawn->side, eye, normal, current, colour);
}

/* Colours, of which the second is added to the first (3.9), and depth (3.7). */
static void values_at(const struct oracle_state *state, const struct drawn *drawn,
		      const struct oracle_place *at, double value[5])
{
	double share[3], weight[3], colour[2][4] = { { 0 } };

	shares_at(drawn, at, share, weight);
	value[4] = 0;
	for (int i = 0; i < 3; i++) {
		int corner = drawn->largest[i];

		value[4] += share[i] * drawn->place[corner].z;
		for (int j = 0; j < 2; j++)
			add(colour[j], weight[i], drawn->corner[corner].colour[drawn->side][j], 4);
	}
	if (state->lit_pixels && state->lighting && !state->flat)
		light_at(state, drawn, weight, colour);
	for (int j = 0; j < 4; j++)
		value[j] = fmin(fmax(colour[0][j] + colour[1][j], 0), 1);
	value[4] = fmin(fmax(value[4], 0), 1);
}

/* How much depth changes from a pixel to the next, across or up. */
static double depth_slope(const struct drawn *drawn)
{
	const struct oracle_place *a = &drawn->place[drawn->largest[0]];
	const struct oracle_place *b = &drawn->place[drawn->largest[1]];
	const struct oracle_place *c = &drawn->place[drawn->largest[2]];
	double whole = area(a, b, c);
	double across = (b->z - a->z) * (c->y - a->y) - (c->z - a->z) * (b->y - a->y);
	double up = (b->x - a->x) * (c->z - a->z) - (c->x - a->x) * (b->z - a->z);

	return ORACLE_ROUND * fmax(fabs(across / whole), fabs(up / whole));
}

static void paint(const struct oracle_state *state, const struct drawn *drawn,
		  const struct oracle_place *centre, struct oracle_pixel *pixel)
{
	double value[5], moved[5];

	values_at(state, drawn, centre, value);
	memcpy(pixel->colour, value, sizeof(pixel->colour));
	pixel->depth = value[4];
	pixel->slope = depth_slope(drawn);
	memset(pixel->slack, 0, sizeof(pixel->slack));
	for (int i = 0; i < 4 && drawn->cut; i++) {
		/* Half of a sixteenth each way. */
		const struct oracle_place beside = { .x = centre->x + (i & 1 ? 0.5 : -0.5),
						     .y = centre->y + (i & 2 ? 0.5 : -0.5) };

		values_at(state, drawn, &beside, moved);
		for (int j = 0; j < 5; j++)
			pixel->slack[j] = fmax(pixel->slack[j], fabs(moved[j] - value[j]));
	}
}

/* The pixels of the picture that are in the viewport. */
static void fill(const struct oracle_state *state, const struct drawn *drawn,
		 struct oracle_picture *picture)
{
	const double *v = state->viewport;

	for (int i = 0; i < picture->width * picture->height; i++) {
		int x = i % picture->width, y = i / picture->width;
		struct oracle_place centre = { (x + 0.5) * ORACLE_ROUND, (y + 0.5) * ORACLE_ROUND,
					       0, 1 };
		double inside;

		if (x < v[0] || y < v[1] || x >= v[0] + v[2] || y >= v[1] + v[3])
			continue;
		inside = depth_inside(drawn->rounded, drawn->corners, &centre);
		if (inside < 0)
			continue;
		picture->pixel[i].drawn = true;
		picture->pixel[i].inside = inside;
		paint(state, drawn, &centre, &picture->pixel[i]);
	}
}

/* Puts the corners in counter-clockwise order; returns twice the area that the polygon had. */
static double turn(const struct oracle_state *state, const struct oracle_corner *polygon,
		   struct oracle_corner *turned, struct drawn *drawn, bool *doubt)
{
	struct oracle_place place[ORACLE_CORNERS];
	double size;

	for (int i = 0; i < drawn->corners; i++) {
		drawn->place[i] = place_of(state, polygon[i].clip);
		place[i] = round_place(&drawn->place[i], doubt);
	}
	size = polygon_area(place, drawn->corners, doubt);
	for (int i = 0; i < drawn->corners; i++) {
		int from = size < 0 ? drawn->corners - 1 - i : i;

		turned[i] = polygon[from];
		drawn->rounded[i] = place[from];
		drawn->place[i] = drawn->cut ? place_of(state, polygon[from].clip) : place[from];
	}
	return size;
}

void oracle_polygon(const struct oracle_state *state, const struct oracle_corner *polygon,
		    int corners, bool cut, struct oracle_picture *picture)
{
	struct oracle_corner turned[ORACLE_CORNERS];
	struct drawn drawn = { .corner = turned, .corners = corners, .cut = cut || corners > 3 };
	double size;

	if (corners < 3)
		return;
	size = turn(state, polygon, turned, &drawn, &picture->doubtful);
	drawn.side = (size < 0) == state->front_clockwise ? ORACLE_FRONT : ORACLE_BACK;
	if (size == 0 || culled(state, drawn.side))
		return;
	if (!state->two_sided || !state->lighting)
		drawn.side = ORACLE_FRONT;
	find_largest(&drawn);
	fill(state, &drawn, picture);
}
