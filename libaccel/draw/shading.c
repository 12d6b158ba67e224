// SPDX-License-Identifier: MIT
/*
 * The choice of shading (SH-ADAPT: Romaniuk 2009, ch. 2 and 6), edge by edge. Between the ends of
 * an edge the light is taken as a straight line, as the second-order curve through the exact light
 * at the midpoint, or the edge is split there. Only the edge's own two vertices decide.
 */
#include <math.h>

#include "draw/group.h"
#include "draw/kernel.h"

/* A step of a channel. */
#define STEP (1 / 255.0f)
/* A midpoint nearer to the straight line than this is taken to be on it. */
#define STRAIGHT STEP
/* Errors of the second-order curve beyond this are worth a split. */
#define CURVE (2.5f * STEP)
/* Midpoints farther from the straight line than this have their curve examined. */
#define EXAMINE (8 * STEP)
/*
 * spread * n, the square of psi * sqrt(n): below the first a highlight is wide enough for one
 * curve; above the second samples could miss it, so a split needs no further look.
 */
#define HIGHLIGHT_WIDE (1.2f * 1.2f)
#define HIGHLIGHT_NARROW (3.5f * 3.5f)
/* The same for the angle at which an edge is seen from a lamp. */
#define LAMP_NARROW (0.7f * 0.7f)
/* Pixels: shorter edges are not split, those on the rim of a cone and others, and still shorter
 * ones are straight. */
#define RIM_LENGTH 3.0f
#define SPLIT_LENGTH 6.0f
#define CURVE_LENGTH 2.5f

void accel_shading_vertices(const struct accel_pass *pass, struct accel_vertex *const *vertex,
			    int count, int side)
{
	for (int i = 0; i < count; i++)
		vertex[i]->sampled = 1u + (unsigned int)side;
	if (!pass->lit)
		return;
	accel_lighting_vertices(&pass->lighting, side, vertex, count);
	if (!pass->interpolated)
		return;
	/* OpenGL clamps before it interpolates. */
	for (int i = 0; i < count; i++)
		for (int j = 0; j < 3; j++)
			if (vertex[i]->sample.colour[j] > 1)
				vertex[i]->sample.colour[j] = 1;
}

void accel_shading_vertex(const struct accel_pass *pass, struct accel_vertex *vertex, int side)
{
	if (vertex->sampled != 1u + (unsigned int)side)
		accel_shading_vertices(pass, &vertex, 1, side);
}

/* The square of the angle between the normals (of its chord, exactly). */
static float shading_normal_spread(const struct accel_vertex *a, const struct accel_vertex *b)
{
	float length = number_dot(a->normal, a->normal) * number_dot(b->normal, b->normal);

	return length > 0 ?
		       number_larger(2 - 2 * number_dot(a->normal, b->normal) / sqrtf(length), 0) :
		       0;
}

static float shading_distance_squared(const struct accel_vertex *a, const struct accel_vertex *b)
{
	float sum = 0;

	for (int i = 0; i < 3; i++) {
		float d = a->eye[i] - b->eye[i];

		sum += d * d;
	}
	return sum;
}

/* The square of an edge's length on the screen in pixels. */
static float shading_screen_length(const struct accel_vertex *a, const struct accel_vertex *b)
{
	const float scale = 1.0f / ACCEL_WINDOW_ONE;
	float x = (float)(b->x - a->x) * scale, y = (float)(b->y - a->y) * scale;

	return x * x + y * y;
}

/*
 * SH-HILITE: can a highlight be seen within an angle of @radius, sine given, of points where the
 * half vector is @shine or more from the normal? With the half vector moving along the surface
 * (a near viewer, a near lamp) there is no closed form for its nearest approach; but it can not
 * come nearer than the angle that is left.
 */
static bool shading_highlight_near(const struct accel_finish *finish, float shine,
				   float sine_squared)
{
	float sine, cosine;

	if (finish->visible_cosine > 1)
		return false;
	if (!(sine_squared < 1))
		return true;
	sine = sqrtf(sine_squared);
	cosine = sqrtf(1 - sine_squared);
	return shine > finish->visible_cosine * cosine - finish->visible_sine * sine;
}

/* What is known of an edge before its midpoint is lit. */
struct span {
	float spread; /* angle of the normals and of what moves, squared */
	float lamp;   /* angle at which a lamp sees it, squared */
	float length; /* on the screen, squared, pixels */
	float shine;
	bool even; /* both ends have the same lights */
};

static void shading_span_init(const struct accel_pass *pass, const struct accel_vertex *a,
			      const struct accel_vertex *b, struct span *span)
{
	const struct accel_sample *sa = &a->sample, *sb = &b->sample;
	float near = number_larger(sa->near, sb->near), normals, place;

	*span = (struct span){ .length = shading_screen_length(a, b), .even = true };
	if (!pass->lit)
		return;
	normals = shading_normal_spread(a, b);
	place = near > 0 ? near * shading_distance_squared(a, b) : 0;
	span->spread = normals + place + 2 * sqrtf(normals * place);
	span->lamp = sa->near_lamp > 0 || sb->near_lamp > 0 ?
			     number_larger(sa->near_lamp, sb->near_lamp) *
				     shading_distance_squared(a, b) :
			     0;
	span->shine = number_larger(sa->shine, sb->shine);
	span->even = sa->facing == sb->facing && sa->in_cone == sb->in_cone;
}

/* Bound of the midpoint's distance from the straight line, from second derivatives. */
static float shading_bend(const struct accel_pass *pass, const struct accel_vertex *a,
			  const struct accel_vertex *b, const struct accel_finish *finish,
			  const struct span *span)
{
	float change = 0, strength = finish->diffuse, w = fabsf(a->w - b->w) / (2 * (a->w + b->w));

	for (int i = 0; i < 3; i++)
		change = number_larger(change, fabsf(a->sample.colour[i] - b->sample.colour[i]));
	/* Within half the edge of one of its ends. */
	if (shading_highlight_near(finish, span->shine, span->spread / 4))
		strength += finish->specular * number_larger(finish->shininess, 1);
	/* Attenuation falls with the square of the distance at most. */
	return change * w +
	       (strength * span->spread + (finish->diffuse + finish->specular) *
						  (pass->lighting.cone_exponent + 6) * span->lamp) /
		       8;
}

static float shading_deviation(const float a[3], const float b[3])
{
	float most = 0;

	for (int i = 0; i < 3; i++)
		most = number_larger(most, fabsf(a[i] - b[i]));
	return most;
}

/* The curve's error a quarter of the way from @a, where the exact light is taken again. */
static float shading_curve_error(const struct accel_pass *pass, const struct accel_vertex *a,
				 const struct accel_vertex *middle, const struct accel_vertex *b,
				 int side)
{
	struct accel_vertex quarter;
	float curve[3];

	accel_patch_middle(a, middle, &quarter);
	accel_shading_vertex(pass, &quarter, side);
	for (int i = 0; i < 3; i++)
		curve[i] = 0.375f * a->sample.colour[i] + 0.75f * middle->sample.colour[i] -
			   0.125f * b->sample.colour[i];
	return shading_deviation(curve, quarter.sample.colour);
}

static bool shading_wants_split(const struct accel_pass *pass, const struct accel_vertex *a,
				const struct accel_vertex *middle, const struct accel_vertex *b,
				int side, const struct span *span, float off_line)
{
	const struct accel_finish *finish = &pass->lighting.finish[side];
	float narrow = span->spread * finish->shininess;
	bool shines = narrow > HIGHLIGHT_WIDE &&
		      shading_highlight_near(finish,
					     number_larger(span->shine, middle->sample.shine),
					     span->spread / 16);
	bool lit = a->sample.facing || b->sample.facing || middle->sample.facing;

	if (span->length < RIM_LENGTH * RIM_LENGTH ||
	    (span->length < SPLIT_LENGTH * SPLIT_LENGTH && a->sample.in_cone == b->sample.in_cone))
		return false;
	if ((shines && narrow > HIGHLIGHT_NARROW) || (span->lamp > LAMP_NARROW && lit))
		return true;
	if (!shines && span->even && off_line < EXAMINE)
		return false;
	return shading_curve_error(pass, a, middle, b, side) > CURVE ||
	       shading_curve_error(pass, b, middle, a, side) > CURVE;
}

/* Moves the curve from the straight line's middle, but not so far that its control point, which
 * bounds it, is more than s10.22 holds. */
static void shading_bend_to(float colour[3], const float middle[3])
{
	for (int i = 0; i < 3; i++) {
		float most = (ACCEL_COLOUR_MAX + colour[i]) / 2;

		colour[i] = middle[i] < most ? middle[i] : most;
	}
}

/* Sets the edge as far as its ends tell; false: its middle has to be lit. */
static bool shading_edge_begin(const struct accel_pass *pass, const struct accel_vertex *a,
			       const struct accel_vertex *b, int side, struct span *span,
			       struct accel_edge *edge)
{
	const struct accel_finish *finish = &pass->lighting.finish[side];

	shading_span_init(pass, a, b, span);
	*edge = (struct accel_edge){ .spread = span->spread };
	for (int i = 0; i < 3; i++)
		edge->colour[i] = (a->sample.colour[i] + b->sample.colour[i]) / 2;
	if (pass->state->shading != ACCEL_SHADING_ADAPTIVE)
		return false;
	return span->length < CURVE_LENGTH * CURVE_LENGTH ||
	       (span->even && shading_bend(pass, a, b, finish, span) < STRAIGHT);
}

/* The second-order curve through the light at the middle, which is lit. */
static void shading_edge_end(const struct accel_pass *pass, const struct accel_vertex *a,
			     const struct accel_vertex *b, int side, const struct span *span,
			     struct accel_vertex *middle, struct accel_edge *edge)
{
	bool adaptive = pass->state->shading == ACCEL_SHADING_ADAPTIVE;
	float off_line = shading_deviation(edge->colour, middle->sample.colour);

	edge->middle = middle->sample;
	edge->sampled = true;
	edge->split = adaptive && accel_patch_divisible(a, b) &&
		      shading_wants_split(pass, a, middle, b, side, span, off_line);
	edge->curved = !adaptive || off_line >= STRAIGHT;
	if (!edge->curved)
		return;
	if (pass->lit)
		accel_spot_bound(pass, a, middle, b, side, middle->sample.colour);
	shading_bend_to(edge->colour, middle->sample.colour);
}

static bool shading_interpolates(const struct accel_pass *pass)
{
	return pass->interpolated && pass->state->shading != ACCEL_SHADING_QUADRATIC;
}

void accel_shading_edge(const struct accel_pass *pass, const struct accel_vertex *a,
			const struct accel_vertex *b, int side, struct accel_edge *edge)
{
	struct accel_vertex middle;
	struct span span;

	if (shading_interpolates(pass)) {
		accel_interpolate_edge(a, b, edge);
		return;
	}
	if (shading_edge_begin(pass, a, b, side, &span, edge))
		return;
	accel_patch_middle(a, b, &middle);
	accel_shading_vertex(pass, &middle, side);
	shading_edge_end(pass, a, b, side, &span, &middle, edge);
}

/* Edges whose middles are lit together. */
struct middles {
	int count;
	uint32_t edge[ACCEL_BATCH]; /* of the group */
	struct span span[ACCEL_BATCH];
	struct accel_vertex middle[ACCEL_BATCH];
};

static void shading_middles_flush(const struct accel_pass *pass, const struct accel_group *group,
				  int side, struct middles *list)
{
	struct accel_vertex *vertex[ACCEL_BATCH];

	for (int i = 0; i < list->count; i++)
		vertex[i] = &list->middle[i];
	accel_shading_vertices(pass, vertex, list->count, side);
	for (int i = 0; i < list->count; i++) {
		const struct accel_ends *ends = &group->ends[list->edge[i]];

		shading_edge_end(pass, &group->vertex[ends->a], &group->vertex[ends->b], side,
				 &list->span[i], &list->middle[i], &group->edge[list->edge[i]]);
	}
	list->count = 0;
}

static void shading_side_edges(const struct accel_pass *pass, const struct accel_group *group,
			       uint32_t first, int side)
{
	struct middles list;

	list.count = 0;
	for (uint32_t i = first; i < group->edges; i++) {
		const struct accel_ends *ends = &group->ends[i];
		const struct accel_vertex *a = &group->vertex[ends->a];
		const struct accel_vertex *b = &group->vertex[ends->b];

		if (group->link[ends->a].side != side)
			continue;
		if (shading_interpolates(pass)) {
			accel_interpolate_edge(a, b, &group->edge[i]);
			continue;
		}
		if (shading_edge_begin(pass, a, b, side, &list.span[list.count], &group->edge[i]))
			continue;
		accel_patch_middle(a, b, &list.middle[list.count]);
		list.edge[list.count++] = i;
		if (list.count == ACCEL_BATCH)
			shading_middles_flush(pass, group, side, &list);
	}
	shading_middles_flush(pass, group, side, &list);
}

void accel_shading_edges(const struct accel_pass *pass, const struct accel_group *group,
			 uint32_t first)
{
	for (int side = 0; side <= accel_pass_sides(pass); side++)
		shading_side_edges(pass, group, first, side);
}

/* The largest spread of its edges. */
static float shading_patch_spread(const struct accel_patch *patch)
{
	float spread = 0;

	for (int i = 0; i < 3; i++)
		spread = number_larger(spread, patch->edge[i]->spread);
	return spread;
}

/* Does the light at the middle, which is lit, say that the triangle must be split? */
static bool shading_inside(const struct accel_pass *pass, const struct accel_patch *patch, int side,
			   const struct accel_vertex *middle)
{
	const struct accel_finish *finish = &pass->lighting.finish[side];
	float spread = shading_patch_spread(patch), curve[3];

	/* No point is farther from the middle than two thirds of the longest edge. */
	if (spread * finish->shininess > HIGHLIGHT_NARROW &&
	    shading_highlight_near(finish, middle->sample.shine, spread * 4 / 9))
		return true;
	accel_patch_surface_centre(patch, curve);
	return shading_deviation(curve, middle->sample.colour) > CURVE;
}

/*
 * Is there nothing in a triangle that its edges do not show? Then no highlight can be seen from
 * where its vertices are, and all of it has the same lights.
 */
static bool shading_is_plain(const struct accel_pass *pass, const struct accel_patch *patch,
			     int side)
{
	const struct accel_sample *first = &patch->vertex[0]->sample;
	float shine = first->shine;

	for (int i = 1; i < 3; i++) {
		const struct accel_sample *sample = &patch->vertex[i]->sample;

		if (sample->facing != first->facing || sample->in_cone != first->in_cone)
			return false;
		shine = number_larger(shine, sample->shine);
	}
	return !shading_highlight_near(&pass->lighting.finish[side], shine,
				       shading_patch_spread(patch));
}

void accel_shading_inside(const struct accel_pass *pass, const struct accel_patch *const *patch,
			  int count, int side, bool *inside)
{
	const float shininess = number_larger(pass->lighting.finish[side].shininess, 1);
	struct accel_vertex middle[ACCEL_BATCH], *vertex[ACCEL_BATCH] = { NULL };
	int number[ACCEL_BATCH], looked = 0;

	for (int i = 0; i < count; i++) {
		inside[i] = pass->interpolated && accel_interpolate_inside(patch[i]);
		if (pass->interpolated ||
		    !(shading_patch_spread(patch[i]) * shininess > HIGHLIGHT_WIDE))
			continue;
		if (shading_is_plain(pass, patch[i], side))
			continue;
		accel_patch_centre(patch[i], &middle[looked]);
		vertex[looked] = &middle[looked];
		number[looked++] = i;
	}
	accel_shading_vertices(pass, vertex, looked, side);
	for (int i = 0; i < looked; i++)
		inside[number[i]] = shading_inside(pass, patch[number[i]], side, &middle[i]);
}
