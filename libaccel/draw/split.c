// SPDX-License-Identifier: MIT
/*
 * A triangle and its parts. A triangle is split at the screen midpoints of the edges that ask for
 * it, and its parts again. Midpoints are exact, so the parts cover the same pixels as the triangle
 * did, whatever its neighbours do; and they keep the triangle's depth plane, so depth is the same
 * too, to the bit. Their colour is taken from the triangle's own normals, linear in space.
 */
#include "draw/bin.h"

/* What all parts of a triangle share. */
struct whole {
	struct accel_pass *pass;
	struct accel_depth_plane plane;
	int side;
};

/* The middle of an edge, and the edges on both sides of it. */
struct cut {
	struct accel_vertex middle;
	struct accel_edge half[2];
};

static int split_draw_part(const struct whole *whole, const struct accel_patch *patch);

static void split_cut_init(const struct whole *whole, const struct accel_patch *patch, int i,
			   struct cut *cut)
{
	const struct accel_vertex *a = patch->vertex[i], *b = patch->vertex[(i + 1) % 3];

	accel_patch_middle(a, b, &cut->middle);
	if (patch->edge[i]->sampled) {
		cut->middle.sample = patch->edge[i]->middle;
		cut->middle.sampled = 1u + (unsigned int)whole->side;
	} else if (!whole->pass->interpolated) {
		accel_shading_vertex(whole->pass, &cut->middle, whole->side);
	}
	accel_shading_edge(whole->pass, a, &cut->middle, whole->side, &cut->half[0]);
	accel_shading_edge(whole->pass, &cut->middle, b, whole->side, &cut->half[1]);
}

static void split_inner_edge(const struct whole *whole, const struct accel_vertex *a,
			     const struct accel_vertex *b, struct accel_edge *edge)
{
	accel_shading_edge(whole->pass, a, b, whole->side, edge);
}

/* Edge 0 into two: from its middle to the vertex opposite. */
static int split_one(const struct whole *whole, const struct accel_patch *p)
{
	const struct accel_vertex *const *v = p->vertex;
	struct accel_edge inner;
	struct cut cut;
	int err;

	split_cut_init(whole, p, 0, &cut);
	split_inner_edge(whole, &cut.middle, v[2], &inner);
	err = split_draw_part(whole, &(struct accel_patch){ { v[0], &cut.middle, v[2] },
							    { &cut.half[0], &inner, p->edge[2] } });
	if (err)
		return err;
	return split_draw_part(whole,
			       &(struct accel_patch){ { &cut.middle, v[1], v[2] },
						      { &cut.half[1], p->edge[1], &inner } });
}

/* Edges 0 and 1: the corner between them, and two from what is left. */
static int split_two(const struct whole *whole, const struct accel_patch *p)
{
	const struct accel_vertex *const *v = p->vertex;
	struct accel_edge across, inner;
	struct cut cut[2];
	int err;

	split_cut_init(whole, p, 0, &cut[0]);
	split_cut_init(whole, p, 1, &cut[1]);
	split_inner_edge(whole, &cut[0].middle, &cut[1].middle, &across);
	split_inner_edge(whole, &cut[0].middle, v[2], &inner);
	err = split_draw_part(whole, &(struct accel_patch){
					     { &cut[0].middle, v[1], &cut[1].middle },
					     { &cut[0].half[1], &cut[1].half[0], &across } });
	if (err)
		return err;
	err = split_draw_part(whole,
			      &(struct accel_patch){ { &cut[0].middle, &cut[1].middle, v[2] },
						     { &across, &cut[1].half[1], &inner } });
	if (err)
		return err;
	return split_draw_part(whole,
			       &(struct accel_patch){ { v[0], &cut[0].middle, v[2] },
						      { &cut[0].half[0], &inner, p->edge[2] } });
}

/* All edges: three corners and the middle. */
static int split_three(const struct whole *whole, const struct accel_patch *p)
{
	struct accel_edge inner[3]; /* inner[i] cuts off vertex i */
	struct cut cut[3];
	int err = 0;

	for (int i = 0; i < 3; i++)
		split_cut_init(whole, p, i, &cut[i]);
	for (int i = 0; i < 3; i++)
		split_inner_edge(whole, &cut[i].middle, &cut[(i + 2) % 3].middle, &inner[i]);
	for (int i = 0; i < 3 && !err; i++) {
		const struct cut *before = &cut[(i + 2) % 3];

		err = split_draw_part(whole,
				      &(struct accel_patch){
					      { p->vertex[i], &cut[i].middle, &before->middle },
					      { &cut[i].half[0], &inner[i], &before->half[1] } });
	}
	if (err)
		return err;
	return split_draw_part(whole, &(struct accel_patch){
					      { &cut[0].middle, &cut[1].middle, &cut[2].middle },
					      { &inner[1], &inner[2], &inner[0] } });
}

static struct accel_patch split_rotate(const struct accel_patch *patch, int by)
{
	struct accel_patch turned;

	for (int i = 0; i < 3; i++) {
		turned.vertex[i] = patch->vertex[(i + by) % 3];
		turned.edge[i] = patch->edge[(i + by) % 3];
	}
	return turned;
}

/* The patch turned so that the edges to split, 1 or 2 of them, come first. */
static struct accel_patch split_first(const struct accel_patch *patch, int count)
{
	int by = 0;

	if (count == 1)
		/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): one of three is split */
		while (!patch->edge[by]->split)
			by++;
	else
		while (patch->edge[(by + 2) % 3]->split)
			by++;
	return split_rotate(patch, by);
}

static int split(const struct whole *whole, const struct accel_patch *patch, int count)
{
	struct accel_patch turned;

	if (count == 3)
		return split_three(whole, patch);
	turned = split_first(patch, count);
	return count == 1 ? split_one(whole, &turned) : split_two(whole, &turned);
}

/* Can all edges be split? */
static bool split_is_divisible(const struct accel_patch *patch)
{
	for (int i = 0; i < 3; i++)
		if (patch->vertex[i]->level == ACCEL_SPLIT_LEVELS)
			return false;
	return true;
}

/*
 * Can the edge that a split in two or three makes be sent? It ends at a midpoint, which is in finer
 * units than vertices are, so in a tall triangle its numbers may be too long for a record. A split
 * in four makes edges half as tall.
 */
static bool split_inner_fits(const struct accel_patch *patch, int count)
{
	struct accel_patch turned = split_first(patch, count);
	struct accel_vertex middle;

	accel_patch_middle(turned.vertex[0], turned.vertex[1], &middle);
	return accel_setup_edge_fits(&middle, turned.vertex[2]);
}

/* Into how many edges' halves: 0 to draw it as it is. */
static int splits(const struct whole *whole, const struct accel_patch *patch)
{
	int count = 0;

	if (whole->pass->state->shading == ACCEL_SHADING_QUADRATIC)
		return 0;
	for (int i = 0; i < 3; i++)
		count += patch->edge[i]->split;
	if (count == 3 || (count && split_inner_fits(patch, count)))
		return count;
	if (!split_is_divisible(patch))
		return 0;
	return count || accel_shading_inside(whole->pass, patch, whole->side) ? 3 : 0;
}

static int split_draw(struct accel_pass *pass, struct accel_triangle *triangle)
{
	accel_small_round(triangle);
	switch (triangle->shading) {
	case GLOSS_SHADING_FLAT:
		pass->stats->flat++;
		break;
	case GLOSS_SHADING_LINEAR:
		pass->stats->linear++;
		break;
	default:
		pass->stats->second_order++;
	}
	return accel_bin_triangle(pass->bin, triangle);
}

static int split_draw_part(const struct whole *whole, const struct accel_patch *patch)
{
	struct accel_pass *pass = whole->pass;
	struct accel_triangle triangle = { .plane = &whole->plane };
	struct accel_basis basis;
	int count;

	if (!accel_setup_init(&triangle.setup, patch->vertex) ||
	    !accel_setup_draws(&triangle.setup, &pass->transform.window.visible))
		return 0;
	count = splits(whole, patch);
	if (count)
		return split(whole, patch, count);
	accel_small_init(&triangle.small, &triangle.setup);
	accel_surface_basis(&basis, patch->vertex);
	accel_surface_patch(&triangle, &basis, patch);
	return split_draw(pass, &triangle);
}

static int split_draw_patch(const struct whole *whole, struct accel_triangle *triangle,
			    const struct accel_basis *basis,
			    const struct accel_vertex *const vertex[3], const uint32_t *index)
{
	struct accel_edge edge[3];
	struct accel_patch patch;
	int count;

	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3;

		if (index)
			accel_shading_mesh_edge(whole->pass, index[i], index[j], whole->side,
						&edge[i]);
		else
			accel_shading_edge(whole->pass, vertex[i], vertex[j], whole->side,
					   &edge[i]);
		patch.vertex[i] = vertex[i];
		patch.edge[i] = &edge[i];
	}
	count = splits(whole, &patch);
	if (count) {
		whole->pass->stats->split++;
		return split(whole, &patch, count);
	}
	if (whole->pass->state->shading == ACCEL_SHADING_GOURAUD && !edge[0].curved &&
	    !edge[1].curved && !edge[2].curved)
		accel_surface_gouraud(triangle, basis, vertex);
	else
		accel_surface_patch(triangle, basis, &patch);
	return split_draw(whole->pass, triangle);
}

int accel_split_draw(struct accel_pass *pass, struct accel_vertex *const vertex[3],
		     const uint32_t *index, struct accel_vertex *flat, int side)
{
	const struct accel_vertex *const corner[3] = { vertex[0], vertex[1], vertex[2] };
	struct accel_triangle triangle;
	struct accel_basis basis;
	struct whole whole = { .pass = pass, .side = side };

	if (!accel_setup_init(&triangle.setup, corner) ||
	    !accel_setup_draws(&triangle.setup, &pass->transform.window.visible)) {
		pass->stats->culled++;
		return 0;
	}
	accel_surface_basis(&basis, corner);
	accel_surface_plane(&whole.plane, &basis, corner, triangle.setup.narrow);
	accel_small_init(&triangle.small, &triangle.setup);
	if (triangle.small.fits)
		accel_small_plane(&whole.plane);
	triangle.plane = &whole.plane;
	if (pass->state->shading == ACCEL_SHADING_FLAT) {
		accel_shading_vertex(pass, flat, side);
		accel_surface_flat(&triangle, flat->sample.colour);
		return split_draw(pass, &triangle);
	}
	for (int i = 0; i < 3; i++)
		accel_shading_vertex(pass, vertex[i], side);
	if (pass->state->shading != ACCEL_SHADING_GOURAUD || !accel_interpolate_straight(corner))
		return split_draw_patch(&whole, &triangle, &basis, corner, index);
	accel_surface_gouraud(&triangle, &basis, corner);
	return split_draw(pass, &triangle);
}
