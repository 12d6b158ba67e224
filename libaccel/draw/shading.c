// SPDX-License-Identifier: MIT
/*
 * The choice of shading (SH-ADAPT: Romaniuk 2009, ch. 2 and 6), edge by edge. Between the ends of
 * an edge the light is taken as a straight line, as the second-order curve through the exact light
 * at the midpoint, or the edge is split there. Only the edge's own two vertices decide.
 */
#include <math.h>

#include "draw/group.h"
#include "draw/highlight.h"
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
	if (!pass->lit || !count)
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

/* What is known of an edge before its midpoint is lit. */
struct span {
	float spread; /* angle of the normals and of what moves, squared */
	float lamp;   /* angle at which a lamp sees it, squared */
	float length; /* on the screen, squared, pixels */
	float shine;
	bool even; /* both ends have the same lights */
};

static float shading_deviation(const float a[3], const float b[3])
{
	float most = 0;

	for (int i = 0; i < 3; i++)
		most = number_larger(most, fabsf(a[i] - b[i]));
	return most;
}

/* An edge, and as much as is known of it; its middle is lit. */
struct bent {
	const struct accel_vertex *a, *b;
	struct accel_edge *edge;
	struct span span;
	struct accel_vertex middle;
};

enum verdict { KEEP, SPLIT, LOOK_CLOSER };

/* Is an edge to be split, as far as its ends and its middle tell? */
static enum verdict shading_judge(const struct accel_pass *pass, const struct bent *bent, int side)
{
	const struct accel_finish *finish = &pass->lighting.finish[side];
	const struct accel_sample *a = &bent->a->sample, *b = &bent->b->sample;
	const struct accel_sample *middle = &bent->middle.sample;
	const struct span *span = &bent->span;
	float narrow = span->spread * finish->shininess;
	bool shines = narrow > HIGHLIGHT_WIDE &&
		      highlight_near(finish, number_larger(span->shine, middle->shine),
				     span->spread / 16);

	if (!accel_patch_divisible(bent->a, bent->b) || span->length < RIM_LENGTH * RIM_LENGTH ||
	    (span->length < SPLIT_LENGTH * SPLIT_LENGTH && a->in_cone == b->in_cone))
		return KEEP;
	if ((shines && narrow > HIGHLIGHT_NARROW) ||
	    (span->lamp > LAMP_NARROW && (a->facing || b->facing || middle->facing)))
		return SPLIT;
	if (!shines && span->even &&
	    shading_deviation(bent->edge->colour, middle->colour) < EXAMINE)
		return KEEP;
	return LOOK_CLOSER;
}

/* Points a quarter of the way along edges, where the exact light is taken again. */
struct quarters {
	int count;
	struct {
		const struct accel_vertex *near, *middle, *far;
		bool *split; /* is to be set if the curve is too far off */
	} of[ACCEL_BATCH];
	struct accel_vertex vertex[ACCEL_BATCH];
};

static void shading_quarters_flush(const struct accel_pass *pass, struct quarters *list, int side)
{
	struct accel_vertex *vertex[ACCEL_BATCH];

	for (int i = 0; i < list->count; i++)
		vertex[i] = &list->vertex[i];
	accel_shading_vertices(pass, vertex, list->count, side);
	for (int i = 0; i < list->count; i++) {
		const struct accel_vertex *middle = list->of[i].middle;
		float curve[3];

		for (int j = 0; j < 3; j++)
			curve[j] = 0.375f * list->of[i].near->sample.colour[j] +
				   0.75f * middle->sample.colour[j] -
				   0.125f * list->of[i].far->sample.colour[j];
		*list->of[i].split |= shading_deviation(curve, list->vertex[i].sample.colour) >
				      CURVE;
	}
	list->count = 0;
}

static void shading_quarter(const struct accel_pass *pass, struct quarters *list, int side,
			    const struct accel_vertex *near, const struct bent *bent,
			    const struct accel_vertex *far)
{
	const int i = list->count++;

	list->of[i].near = near;
	list->of[i].middle = &bent->middle;
	list->of[i].far = far;
	list->of[i].split = &bent->edge->split;
	accel_patch_middle(near, &bent->middle, &list->vertex[i]);
	if (list->count == ACCEL_BATCH)
		shading_quarters_flush(pass, list, side);
}

/* Which of the edges are to be split. */
static void shading_splits(const struct accel_pass *pass, const struct bent *bent, int count,
			   int side)
{
	struct quarters quarters;

	quarters.count = 0;
	for (int i = 0; i < count; i++) {
		const enum verdict verdict = shading_judge(pass, &bent[i], side);

		bent[i].edge->split = verdict == SPLIT;
		if (verdict != LOOK_CLOSER)
			continue;
		shading_quarter(pass, &quarters, side, bent[i].a, &bent[i], bent[i].b);
		shading_quarter(pass, &quarters, side, bent[i].b, &bent[i], bent[i].a);
	}
	shading_quarters_flush(pass, &quarters, side);
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

/* The second-order curve through the light at the middle. */
static void shading_curve(const struct accel_pass *pass, struct bent *bent, int side)
{
	bool adaptive = pass->state->shading == ACCEL_SHADING_ADAPTIVE;
	struct accel_sample *middle = &bent->middle.sample;
	struct accel_edge *edge = bent->edge;

	edge->middle = *middle;
	edge->sampled = true;
	edge->curved = !adaptive || shading_deviation(edge->colour, middle->colour) >= STRAIGHT;
	if (!edge->curved)
		return;
	if (pass->lit)
		accel_spot_bound(pass, bent->a, &bent->middle, bent->b, side, middle->colour);
	shading_bend_to(edge->colour, middle->colour);
}

/* Edges that are worked together. */
struct edges {
	int count;
	struct {
		const struct accel_vertex *a, *b;
		struct accel_edge *edge;
	} of[ACCEL_BATCH];
	int bents; /* of those whose middles are to be lit */
	struct bent bent[ACCEL_BATCH];
};

static void shading_bents_flush(const struct accel_pass *pass, struct edges *list, int side)
{
	struct accel_vertex *vertex[ACCEL_BATCH];

	for (int i = 0; i < list->bents; i++)
		vertex[i] = &list->bent[i].middle;
	accel_shading_vertices(pass, vertex, list->bents, side);
	if (pass->state->shading == ACCEL_SHADING_ADAPTIVE)
		shading_splits(pass, list->bent, list->bents, side);
	for (int i = 0; i < list->bents; i++)
		shading_curve(pass, &list->bent[i], side);
	list->bents = 0;
}

static void shading_put_end(struct accel_edge_batch *batch, int end, int i,
			    const struct accel_vertex *vertex)
{
	const struct accel_sample *sample = &vertex->sample;

	batch->x[end][i] = vertex->x;
	batch->y[end][i] = vertex->y;
	batch->w[end][i] = vertex->w;
	for (int j = 0; j < 3; j++) {
		batch->eye[end][j][i] = vertex->eye[j];
		batch->normal[end][j][i] = vertex->normal[j];
		batch->colour[end][j][i] = sample->colour[j];
	}
	batch->shine[end][i] = sample->shine;
	batch->near[end][i] = sample->near;
	batch->near_lamp[end][i] = sample->near_lamp;
	batch->lights[end][i] = (uint32_t)sample->facing | (uint32_t)sample->in_cone << 8;
}

/* The middle of edge @i will be lit. */
static void shading_bend(const struct accel_pass *pass, struct edges *list, int i,
			 const struct span *span, int side)
{
	struct bent *bent = &list->bent[list->bents++];

	bent->a = list->of[i].a;
	bent->b = list->of[i].b;
	bent->edge = list->of[i].edge;
	bent->span = *span;
	accel_patch_middle(bent->a, bent->b, &bent->middle);
	if (list->bents == ACCEL_BATCH)
		shading_bents_flush(pass, list, side);
}

/* Finds out by the ends which edges bend. */
static void shading_look(const struct accel_pass *pass, struct edges *list, int side)
{
	const float shininess = number_larger(pass->lighting.finish[side].shininess, 1);
	struct accel_edge_batch batch;

	for (int i = 0; i < list->count; i++) {
		shading_put_end(&batch, 0, i, list->of[i].a);
		shading_put_end(&batch, 1, i, list->of[i].b);
	}
	accel_kernel()->edge(&pass->lighting, side, &batch, list->count);
	for (int i = 0; i < list->count; i++) {
		const struct span span = { batch.spread[i], batch.lamp[i], batch.length[i],
					   batch.most_shine[i], batch.even[i] };

		list->of[i].edge->spread = span.spread;
		list->of[i].edge->examine = span.spread * shininess > HIGHLIGHT_WIDE;
		if (span.length >= CURVE_LENGTH * CURVE_LENGTH &&
		    !(span.even && batch.bend[i] < STRAIGHT))
			shading_bend(pass, list, i, &span, side);
	}
}

static void shading_edges_flush(const struct accel_pass *pass, struct edges *list, int side)
{
	const struct span any = { 0 };

	if (pass->state->shading == ACCEL_SHADING_ADAPTIVE && list->count)
		shading_look(pass, list, side);
	for (int i = 0; i < list->count && pass->state->shading != ACCEL_SHADING_ADAPTIVE; i++)
		shading_bend(pass, list, i, &any, side);
	list->count = 0;
}

static bool shading_interpolates(const struct accel_pass *pass)
{
	return pass->interpolated && pass->state->shading != ACCEL_SHADING_QUADRATIC;
}

static void shading_put_edge(const struct accel_pass *pass, struct edges *list, int side,
			     const struct accel_vertex *a, const struct accel_vertex *b,
			     struct accel_edge *edge)
{
	const int i = list->count;

	if (shading_interpolates(pass)) {
		accel_interpolate_edge(a, b, edge);
		return;
	}
	*edge = (struct accel_edge){ .split = false };
	for (int j = 0; j < 3; j++)
		edge->colour[j] = (a->sample.colour[j] + b->sample.colour[j]) / 2;
	list->of[i].a = a;
	list->of[i].b = b;
	list->of[i].edge = edge;
	if (++list->count == ACCEL_BATCH)
		shading_edges_flush(pass, list, side);
}

static void shading_finish_edges(const struct accel_pass *pass, struct edges *list, int side)
{
	shading_edges_flush(pass, list, side);
	shading_bents_flush(pass, list, side);
}

void accel_shading_edge(const struct accel_pass *pass, const struct accel_vertex *a,
			const struct accel_vertex *b, int side, struct accel_edge *edge)
{
	struct edges list;

	list.count = list.bents = 0;
	shading_put_edge(pass, &list, side, a, b, edge);
	shading_finish_edges(pass, &list, side);
}

static void shading_side_edges(const struct accel_pass *pass, const struct accel_group *group,
			       uint32_t first, int side)
{
	struct edges list;

	list.count = list.bents = 0;
	for (uint32_t i = first; i < group->edges; i++) {
		const struct accel_ends *ends = &group->ends[i];

		if (group->link[ends->a].side == side)
			shading_put_edge(pass, &list, side, &group->vertex[ends->a],
					 &group->vertex[ends->b], &group->edge[i]);
	}
	shading_finish_edges(pass, &list, side);
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
	    highlight_near(finish, middle->sample.shine, spread * 4 / 9))
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
	return !highlight_near(&pass->lighting.finish[side], shine, shading_patch_spread(patch));
}

void accel_shading_inside(const struct accel_pass *pass, const struct accel_patch *const *patch,
			  int count, int side, bool *inside)
{
	struct accel_vertex middle[ACCEL_BATCH], *vertex[ACCEL_BATCH] = { NULL };
	int number[ACCEL_BATCH], looked = 0;

	for (int i = 0; i < count; i++) {
		inside[i] = pass->interpolated && accel_interpolate_inside(patch[i]);
		if (pass->interpolated || shading_is_plain(pass, patch[i], side))
			continue;
		accel_patch_centre(patch[i], &middle[looked]);
		vertex[looked] = &middle[looked];
		number[looked++] = i;
	}
	accel_shading_vertices(pass, vertex, looked, side);
	for (int i = 0; i < looked; i++)
		inside[number[i]] = shading_inside(pass, patch[number[i]], side, &middle[i]);
}
