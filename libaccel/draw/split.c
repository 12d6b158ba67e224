// SPDX-License-Identifier: MIT
/*
 * Triangles and their parts. A triangle is split at the screen midpoints of the edges that ask for
 * it, and its parts again. Midpoints are exact, so the parts cover the same pixels as the triangle
 * did, whatever its neighbours do; and they keep the triangle's depth plane, so depth is the same
 * too, to the bit. Their colour is taken from the triangle's own normals, linear in space.
 *
 * Many triangles are split at once, level by level, so that the vertices and edges of a level are
 * lit together. What an edge's halves need is found once for both its triangles.
 */
#include "draw/group.h"
#include "draw/kernel.h"

/* What splitting a part adds at most. */
#define NEW_VERTICES 3
#define NEW_EDGES 9
#define NEW_PARTS 4

/* ---- what is to be split ---- */

/* The edge that comes first, so that those to split, 1 or 2 of them, come before others. */
static int split_first(const struct accel_edge *const edge[3], int count)
{
	int first = 0;

	if (count == 1)
		/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): one of three is split */
		while (!edge[first]->split)
			first++;
	if (count == 2)
		while (edge[(first + 2) % 3]->split)
			first++;
	return first;
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
	int first = split_first(patch->edge, count);
	struct accel_vertex middle;

	accel_patch_middle(patch->vertex[first], patch->vertex[(first + 1) % 3], &middle);
	return accel_setup_edge_fits(&middle, patch->vertex[(first + 2) % 3]);
}

#define INSIDE (-1)

/* How many edges of a triangle are to be split, 0 to 3; INSIDE: its edges do not say. */
static int split_edges(const struct accel_pass *pass, const struct accel_patch *patch)
{
	int count = 0;

	if (pass->state->shading == ACCEL_SHADING_QUADRATIC)
		return 0;
	for (int i = 0; i < 3; i++)
		count += patch->edge[i]->split;
	if (count == 3 || (count && split_inner_fits(patch, count)))
		return count;
	if (!split_is_divisible(patch))
		return 0;
	return count ? 3 : INSIDE;
}

/* Those that no edge splits may be split because of their middles, which are lit together. */
static void split_look_inside(const struct accel_pass *pass, const struct accel_patch *patch,
			      int count, int side, int *splits)
{
	const struct accel_patch *looked[ACCEL_BATCH] = { NULL };
	int number[ACCEL_BATCH], many = 0;
	bool inside[ACCEL_BATCH];

	for (int i = 0; i < count; i++) {
		if (splits[i] != INSIDE || patch[i].side != side)
			continue;
		looked[many] = &patch[i];
		number[many++] = i;
	}
	accel_shading_inside(pass, looked, many, side, inside);
	for (int i = 0; i < many; i++)
		splits[number[i]] = inside[i] ? 3 : 0;
}

void accel_split_decide(const struct accel_pass *pass, const struct accel_patch *patch, int count,
			int *splits)
{
	for (int i = 0; i < count; i++)
		splits[i] = split_edges(pass, &patch[i]);
	for (int side = 0; side <= accel_pass_sides(pass); side++)
		split_look_inside(pass, patch, count, side, splits);
}

/* ---- one part ---- */

/* The middle of a part's edge, and the edges on both sides of it, in the part's direction. */
struct cut {
	uint32_t middle, half[2];
};

/* The halves of an edge, made for the first part that asks. */
static void split_halve(const struct accel_pass *pass, uint32_t number, int side)
{
	struct accel_group *group = pass->group;
	const struct accel_edge *edge = &group->edge[number];
	struct accel_ends *ends = &group->ends[number];
	struct accel_vertex *middle = &group->vertex[group->vertices];

	accel_patch_middle(&group->vertex[ends->a], &group->vertex[ends->b], middle);
	if (edge->sampled)
		middle->sample = edge->middle;
	if (edge->sampled || pass->interpolated)
		middle->sampled = 1u + (unsigned int)side;
	ends->middle = accel_group_vertex(group, side);
	ends->half = accel_group_edge(group, ends->a, ends->middle);
	accel_group_edge(group, ends->middle, ends->b);
}

static struct cut split_cut(const struct accel_pass *pass, const struct accel_part *part, int i)
{
	const struct accel_ends *ends = &pass->group->ends[part->edge[i]];
	uint32_t along = ends->a == part->vertex[i];

	if (ends->middle == ACCEL_NONE)
		split_halve(pass, part->edge[i], part->side);
	return (struct cut){ ends->middle, { ends->half + !along, ends->half + along } };
}

struct three {
	uint32_t of[3];
};

static void split_add(struct accel_group *group, int side, struct three vertex, struct three edge)
{
	struct accel_part *part = &group->part[group->parts++];

	for (int i = 0; i < 3; i++) {
		part->vertex[i] = vertex.of[i];
		part->edge[i] = edge.of[i];
	}
	part->side = side;
	part->children = 0;
	part->splits = 0;
}

#define THREE(a, b, c) ((struct three){ { a, b, c } })

/* Edge 0 into two: from its middle to the vertex opposite. */
static void split_one(const struct accel_pass *pass, const struct accel_part *p)
{
	struct accel_group *group = pass->group;
	const uint32_t *v = p->vertex;
	struct cut cut = split_cut(pass, p, 0);
	uint32_t inner = accel_group_edge(group, cut.middle, v[2]);

	split_add(group, p->side, THREE(v[0], cut.middle, v[2]),
		  THREE(cut.half[0], inner, p->edge[2]));
	split_add(group, p->side, THREE(cut.middle, v[1], v[2]),
		  THREE(cut.half[1], p->edge[1], inner));
}

/* Edges 0 and 1: the corner between them, and two from what is left. */
static void split_two(const struct accel_pass *pass, const struct accel_part *p)
{
	struct accel_group *group = pass->group;
	const uint32_t *v = p->vertex;
	struct cut a = split_cut(pass, p, 0), b = split_cut(pass, p, 1);
	uint32_t across = accel_group_edge(group, a.middle, b.middle);
	uint32_t inner = accel_group_edge(group, a.middle, v[2]);

	split_add(group, p->side, THREE(a.middle, v[1], b.middle),
		  THREE(a.half[1], b.half[0], across));
	split_add(group, p->side, THREE(a.middle, b.middle, v[2]), THREE(across, b.half[1], inner));
	split_add(group, p->side, THREE(v[0], a.middle, v[2]), THREE(a.half[0], inner, p->edge[2]));
}

/* All edges: three corners and the middle. */
static void split_three(const struct accel_pass *pass, const struct accel_part *p)
{
	struct accel_group *group = pass->group;
	uint32_t inner[3]; /* inner[i] cuts off vertex i */
	struct cut cut[3];

	for (int i = 0; i < 3; i++)
		cut[i] = split_cut(pass, p, i);
	for (int i = 0; i < 3; i++)
		inner[i] = accel_group_edge(group, cut[i].middle, cut[(i + 2) % 3].middle);
	for (int i = 0; i < 3; i++) {
		const struct cut *before = &cut[(i + 2) % 3];

		split_add(group, p->side, THREE(p->vertex[i], cut[i].middle, before->middle),
			  THREE(cut[i].half[0], inner[i], before->half[1]));
	}
	split_add(group, p->side, THREE(cut[0].middle, cut[1].middle, cut[2].middle),
		  THREE(inner[1], inner[2], inner[0]));
}

static void split(const struct accel_pass *pass, struct accel_part *part)
{
	struct accel_group *group = pass->group;
	const struct accel_edge *const edge[3] = { &group->edge[part->edge[0]],
						   &group->edge[part->edge[1]],
						   &group->edge[part->edge[2]] };
	int first = split_first(edge, part->splits);
	struct accel_part turned = { .side = part->side };

	for (int i = 0; i < 3; i++) {
		turned.vertex[i] = part->vertex[(i + first) % 3];
		turned.edge[i] = part->edge[(i + first) % 3];
	}
	part->child = group->parts;
	if (part->splits == 1)
		split_one(pass, &turned);
	else if (part->splits == 2)
		split_two(pass, &turned);
	else
		split_three(pass, &turned);
	part->children = (int)(group->parts - part->child);
}

/* ---- level by level ---- */

uint32_t accel_split_root(struct accel_group *group, const struct accel_face *face, int splits)
{
	const uint32_t *v = face->vertex, *e = face->edge;

	split_add(group, face->side, THREE(v[0], v[1], v[2]), THREE(e[0], e[1], e[2]));
	group->part[group->parts - 1].splits = splits;
	return group->parts - 1;
}

void accel_split_forget(struct accel_group *group, uint32_t vertices, uint32_t edges)
{
	for (uint32_t i = 0; i < group->parts; i++)
		for (int j = 0; j < 3; j++)
			group->ends[group->part[i].edge[j]].middle = ACCEL_NONE;
	group->vertices = vertices;
	group->edges = edges;
	group->parts = 0;
}

/* Room for the parts of parts @first to @end - 1. */
static int split_reserve(struct accel_group *group, uint32_t first, uint32_t end)
{
	uint32_t count = 0;

	for (uint32_t i = first; i < end; i++)
		count += group->part[i].splits > 0;
	return accel_group_reserve_parts(group, NEW_VERTICES * count, NEW_EDGES * count,
					 NEW_PARTS * count);
}

/* Lights the vertices from @first on that are not. */
static void split_light(const struct accel_pass *pass, uint32_t first, int side)
{
	const struct accel_group *group = pass->group;
	struct accel_vertex *vertex[ACCEL_BATCH] = { NULL };
	int count = 0;

	for (uint32_t i = first; i < group->vertices; i++) {
		if (group->vertex[i].sampled || group->link[i].side != side)
			continue;
		vertex[count++] = &group->vertex[i];
		if (count == ACCEL_BATCH) {
			accel_shading_vertices(pass, vertex, count, side);
			count = 0;
		}
	}
	accel_shading_vertices(pass, vertex, count, side);
}

/* Finds which of parts @first to @end - 1, at most ACCEL_BATCH, draw anything. */
static void split_set_up(const struct accel_pass *pass, uint32_t first, uint32_t end)
{
	const struct accel_bounds *visible = &pass->transform.window.visible;
	const struct accel_group *group = pass->group;
	struct accel_setup_batch batch;
	int count = (int)(end - first);

	for (int i = 0; i < count; i++)
		for (int j = 0; j < 3; j++) {
			const uint32_t vertex = group->part[first + (uint32_t)i].vertex[j];

			batch.x[j][i] = group->vertex[vertex].x;
			batch.y[j][i] = group->vertex[vertex].y;
		}
	accel_kernel()->setup(&batch, count, visible);
	for (int i = 0; i < count; i++) {
		struct accel_part *part = &group->part[first + (uint32_t)i];

		part->draws = accel_setup_draws(&batch, i, visible, &part->setup);
	}
}

/* Lights the pixels of those that have but a few. */
static void split_light_few(const struct accel_pass *pass, uint32_t first, uint32_t end)
{
	struct accel_patch patch[ACCEL_BATCH] = { 0 };
	const struct accel_group *group = pass->group;
	struct accel_few *few[ACCEL_BATCH];
	int count = 0;

	for (uint32_t n = first; n < end; n++) {
		struct accel_part *part = &group->part[n];

		if (!part->draws)
			continue;
		accel_few_find(&part->few, pass, &part->setup);
		if (!part->few.count)
			continue;
		for (int i = 0; i < 3; i++)
			patch[count].vertex[i] = &group->vertex[part->vertex[i]];
		patch[count].side = part->side;
		few[count++] = &part->few;
	}
	accel_few_light(pass, patch, few, count);
}

/* Finds which of these are to be split. */
static void split_look(const struct accel_pass *pass, uint32_t first, uint32_t end)
{
	const struct accel_group *group = pass->group;
	struct accel_patch patch[ACCEL_BATCH] = { 0 };
	int splits[ACCEL_BATCH], count = 0;
	uint32_t number[ACCEL_BATCH];

	split_set_up(pass, first, end);
	split_light_few(pass, first, end);
	for (uint32_t n = first; n < end; n++) {
		const struct accel_part *part = &group->part[n];

		if (!part->draws || part->few.count || !accel_split_may(group, part->edge))
			continue;
		for (int i = 0; i < 3; i++) {
			patch[count].vertex[i] = &group->vertex[part->vertex[i]];
			patch[count].edge[i] = &group->edge[part->edge[i]];
		}
		patch[count].side = part->side;
		number[count++] = n;
	}
	accel_split_decide(pass, patch, count, splits);
	for (int i = 0; i < count; i++)
		group->part[number[i]].splits = splits[i];
}

int accel_split_all(const struct accel_pass *pass)
{
	struct accel_group *group = pass->group;
	uint32_t end;

	for (uint32_t first = 0; first < group->parts; first = end) {
		const uint32_t vertices = group->vertices, edges = group->edges;
		int err;

		end = group->parts;
		err = split_reserve(group, first, end);
		if (err)
			return err;
		for (uint32_t i = first; i < end; i++)
			if (group->part[i].splits)
				split(pass, &group->part[i]);
		for (int side = 0; side <= accel_pass_sides(pass); side++)
			split_light(pass, vertices, side);
		accel_shading_edges(pass, group, edges);
		for (uint32_t i = end; i < group->parts; i += ACCEL_BATCH)
			split_look(pass, i,
				   group->parts - i < ACCEL_BATCH ? group->parts : i + ACCEL_BATCH);
	}
	return 0;
}
