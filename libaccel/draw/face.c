// SPDX-License-Identifier: MIT
/* The faces of a group from vertices of the mesh to triangles in the bin, stage by stage. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/group.h"
#include "draw/kernel.h"

/* Whole triangles, where each has vertices of its own. */
#define OWN_BATCH (ACCEL_BATCH / 3 * 3)

/* Parts that faces are split into before these are drawn, about; and those of one, at most. */
#define PARTS 32768u
#define PARTS_MAX 5461u

/* ---- vertices ---- */

/* Vertices of a group that are transformed and lit together: those of one side. */
struct vertices {
	int count;
	uint32_t index[ACCEL_BATCH]; /* of the mesh */
	struct accel_vertex *vertex[ACCEL_BATCH];
	struct accel_vertex_batch batch;
};

/* The direction in which the front of a triangle looks, by its vertices in eye space. */
static void face_normal(const float a[3], const float b[3], const float c[3], float out[3])
{
	double n[3], length;

	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;

		/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): three of them are there */
		n[i] = ((double)b[j] - (double)a[j]) * ((double)c[k] - (double)a[k]) -
		       ((double)b[k] - (double)a[k]) * ((double)c[j] - (double)a[j]);
	}
	length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
	for (int i = 0; i < 3; i++)
		out[i] = length > 0 ? (float)(n[i] / length) : 0;
}

void accel_face_flatten(struct accel_vertex *const vertex[3], bool clockwise)
{
	const struct accel_vertex *second = vertex[clockwise ? 2 : 1];
	const struct accel_vertex *third = vertex[clockwise ? 1 : 2];

	face_normal(vertex[0]->eye, second->eye, third->eye, vertex[0]->normal);
	memcpy(vertex[1]->normal, vertex[0]->normal, sizeof(vertex[0]->normal));
	memcpy(vertex[2]->normal, vertex[0]->normal, sizeof(vertex[0]->normal));
}

static void face_vertices_flush(const struct accel_pass *pass, struct vertices *list, int side)
{
	bool own = !accel_pass_shares(pass);

	accel_mesh_fetch(pass, list->index, list->count, &list->batch);
	for (int i = 0; i < list->count; i++)
		accel_geometry_vertex_of(&list->batch, i, list->vertex[i]);
	for (int i = 0; i + 2 < list->count && own; i += 3)
		accel_face_flatten(&list->vertex[i], pass->state->clockwise);
	accel_shading_vertices(pass, list->vertex, list->count, side);
	list->count = 0;
}

static void face_vertices(const struct accel_pass *pass, int side)
{
	const struct accel_group *group = pass->group;
	const int batch = accel_pass_shares(pass) ? ACCEL_BATCH : OWN_BATCH;
	struct vertices list;

	list.count = 0;
	for (uint32_t i = 0; i < group->vertices; i++) {
		if (group->link[i].index == ACCEL_NONE || group->link[i].side != side)
			continue;
		list.index[list.count] = group->link[i].index;
		list.vertex[list.count++] = &group->vertex[i];
		if (list.count == batch)
			face_vertices_flush(pass, &list, side);
	}
	if (list.count)
		face_vertices_flush(pass, &list, side);
}

/* ---- edges ---- */

static void face_corners(const struct accel_group *group, const struct accel_face *face,
			 const struct accel_vertex *corner[3])
{
	for (int i = 0; i < 3; i++)
		corner[i] = &group->vertex[face->vertex[i]];
}

static void face_link_edges(const struct accel_pass *pass)
{
	struct accel_group *group = pass->group;
	const enum accel_shading shading = pass->state->shading;

	for (uint32_t i = 0; i < group->faces; i++) {
		struct accel_face *face = &group->face[i];
		const struct accel_vertex *corner[3];

		face_corners(group, face, corner);
		accel_few_find(&face->few, pass, &face->setup);
		if (face->few.count || shading == ACCEL_SHADING_FLAT ||
		    (shading == ACCEL_SHADING_GOURAUD && accel_interpolate_straight(corner)))
			face->edge[0] = ACCEL_NONE;
		else
			accel_group_link_edges(group, face);
	}
}

/* ---- triangles ---- */

static void face_patch(const struct accel_group *group, const uint32_t vertex[3],
		       const uint32_t edge[3], int side, struct accel_patch *patch)
{
	for (int i = 0; i < 3; i++) {
		patch->vertex[i] = &group->vertex[vertex[i]];
		patch->edge[i] = &group->edge[edge[i]];
	}
	patch->side = side;
}

/* Faces that are drawn together. */
struct faces {
	const struct accel_face *face;
	int count;
	struct accel_depth_plane plane[ACCEL_BATCH];
	struct accel_small small[ACCEL_BATCH];
	int splits[ACCEL_BATCH];
	uint32_t root[ACCEL_BATCH]; /* of those that are split */
	struct accel_leaves leaves; /* of them and their parts, in order */
};

/* A place for the next leaf. */
static int face_leaf(struct accel_pass *pass, struct accel_leaves *leaves, struct accel_leaf **leaf)
{
	int err = leaves->count == ACCEL_BATCH ? accel_leaf_flush(pass, leaves) : 0;

	*leaf = &leaves->leaf[leaves->count++];
	return err;
}

static int face_draw_part(struct accel_pass *pass, const struct accel_depth_plane *plane,
			  const struct accel_part *part, struct accel_leaves *leaves)
{
	struct accel_leaf *leaf;
	int err = 0;

	for (int i = 0; i < part->children && !err; i++)
		err = face_draw_part(pass, plane, &pass->group->part[part->child + (uint32_t)i],
				     leaves);
	if (err || part->children || !part->draws)
		return err;
	err = face_leaf(pass, leaves, &leaf);
	*leaf = (struct accel_leaf){
		.setup = &part->setup,
		.plane = plane,
		.few = &part->few,
		.edged = true,
	};
	face_patch(pass->group, part->vertex, part->edge, part->side, &leaf->patch);
	return err;
}

static int face_draw(struct accel_pass *pass, struct faces *list, int i)
{
	const struct accel_face *face = &list->face[i];
	struct accel_leaf *leaf;
	int err;

	if (list->splits[i]) {
		pass->stats->split++;
		return face_draw_part(pass, &list->plane[i], &pass->group->part[list->root[i]],
				      &list->leaves);
	}
	err = face_leaf(pass, &list->leaves, &leaf);
	*leaf = (struct accel_leaf){
		.setup = &face->setup,
		.plane = &list->plane[i],
		.small = &list->small[i],
		.few = &face->few,
		.flat = &pass->group->vertex[face->flat],
		.edged = face->edge[0] != ACCEL_NONE,
	};
	if (leaf->edged)
		face_patch(pass->group, face->vertex, face->edge, face->side, &leaf->patch);
	else
		face_corners(pass->group, face, leaf->patch.vertex);
	return err;
}

static void face_gather_plane(const struct accel_pass *pass, struct faces *list,
			      struct accel_fit_batch *batch, int i)
{
	const struct accel_setup *setup = &list->face[i].setup;
	const struct accel_vertex *corner[3];
	double offset;

	face_corners(pass->group, &list->face[i], corner);
	offset = pass->offset ? accel_offset(pass->state, corner) : 0;
	for (int j = 0; j < 3; j++) {
		batch->x[j][i] = corner[j]->x;
		batch->y[j][i] = corner[j]->y;
		batch->z[j][i] = corner[j]->z + offset;
	}
	accel_small_init(&list->small[i], setup);
	batch->small[i] = list->small[i].fits;
	batch->narrow[i] = setup->narrow;
}

/* A plane that the batch has not. */
static void face_plane(struct faces *list, const struct accel_fit_batch *batch, int i)
{
	const double depth[3] = { batch->z[0][i], batch->z[1][i], batch->z[2][i] };
	struct accel_basis basis;

	accel_surface_basis_of(batch, i, &basis);
	accel_surface_plane(&list->plane[i], &basis, depth, list->face[i].setup.narrow);
	if (list->small[i].fits)
		accel_small_plane(&list->plane[i]);
}

/* The depth planes of all faces, which their parts keep. */
static void face_planes(const struct accel_pass *pass, struct faces *list)
{
	struct accel_fit_batch batch;

	for (int i = 0; i < list->count; i++)
		face_gather_plane(pass, list, &batch, i);
	accel_kernel()->plane(&batch, list->count);
	for (int i = 0; i < list->count; i++)
		if (batch.narrow[i])
			accel_surface_plane_of(&list->plane[i], &batch, i);
		else
			face_plane(list, &batch, i);
}

/* Lights the pixels of faces that have but a few. */
static void face_light_few(const struct accel_pass *pass, struct accel_face *face, int count)
{
	struct accel_patch patch[ACCEL_BATCH];
	struct accel_few *few[ACCEL_BATCH];
	int many = 0;

	memset(patch, 0, (size_t)count * sizeof(*patch));
	for (int i = 0; i < count; i++) {
		if (!face[i].few.count)
			continue;
		face_corners(pass->group, &face[i], patch[many].vertex);
		patch[many].side = face[i].side;
		few[many++] = &face[i].few;
	}
	accel_few_light(pass, patch, few, many);
}

static void face_decide(const struct accel_pass *pass, struct faces *list)
{
	struct accel_patch patch[ACCEL_BATCH];
	int splits[ACCEL_BATCH], number[ACCEL_BATCH], edged = 0;

	for (int i = 0; i < list->count; i++) {
		const struct accel_face *face = &list->face[i];

		list->splits[i] = 0;
		if (face->edge[0] == ACCEL_NONE || !accel_split_may(pass->group, face->edge))
			continue;
		face_patch(pass->group, face->vertex, face->edge, face->side, &patch[edged]);
		number[edged++] = i;
	}
	accel_split_decide(pass, patch, edged, splits);
	for (int i = 0; i < edged; i++)
		list->splits[number[i]] = splits[i];
}

/* How many parts a face may become, about: what covers no pixel is not split again. */
static uint32_t face_parts(const struct accel_group *group, const struct accel_face *face)
{
	const struct accel_vertex *corner[3];
	int32_t across = 0, down = 0;

	face_corners(group, face, corner);
	for (int i = 0; i < 3; i++) {
		const struct accel_vertex *next = corner[(i + 1) % 3];

		across = number_max(across, abs(next->x - corner[i]->x) / ACCEL_WINDOW_ONE + 1);
		down = number_max(down, abs(next->y - corner[i]->y) / ACCEL_WINDOW_ONE + 1);
	}
	return across < 16 && down < 16 ? (uint32_t)(across * down) * 24 : PARTS_MAX;
}

/* Splits faces from @first on; returns up to which, so that their parts are a bounded number. */
static int face_split(const struct accel_pass *pass, struct faces *list, int first, int *end)
{
	struct accel_group *group = pass->group;
	uint32_t parts = 0;
	int err;

	err = accel_group_reserve_parts(group, 0, 0, ACCEL_BATCH);
	for (*end = first; !err && *end < list->count && parts < PARTS; ++*end) {
		if (!list->splits[*end])
			continue;
		list->root[*end] = accel_split_root(group, &list->face[*end], list->splits[*end]);
		parts += face_parts(group, &list->face[*end]);
	}
	return err || !parts ? err : accel_split_all(pass);
}

static int face_draw_batch(struct accel_pass *pass, uint32_t number, int count)
{
	struct accel_group *group = pass->group;
	const uint32_t vertices = group->vertices, edges = group->edges;
	struct faces list;
	int err = 0, end;

	list.face = &group->face[number];
	list.count = count;
	list.leaves.count = 0;
	face_planes(pass, &list);
	face_decide(pass, &list);
	face_light_few(pass, &group->face[number], count);
	for (int first = 0; first < count && !err; first = end) {
		err = face_split(pass, &list, first, &end);
		for (int i = first; i < end && !err; i++)
			err = face_draw(pass, &list, i);
		if (!err)
			err = accel_leaf_flush(pass, &list.leaves);
		accel_split_forget(group, vertices, edges);
	}
	return err;
}

int accel_face_draw_all(struct accel_pass *pass)
{
	struct accel_group *group = pass->group;
	int err = 0;

	if (!group->faces) {
		accel_group_reset(group);
		return 0;
	}
	accel_group_link(group, accel_pass_shares(pass));
	for (int side = 0; side <= accel_pass_sides(pass); side++)
		face_vertices(pass, side);
	face_link_edges(pass);
	accel_shading_edges(pass, group, 0);
	for (uint32_t i = 0; i < group->faces && !err; i += ACCEL_BATCH)
		err = face_draw_batch(pass, i, number_min((int)(group->faces - i), ACCEL_BATCH));
	accel_group_reset(group);
	return err;
}
