// SPDX-License-Identifier: MIT
/* A group's memory, and which of its faces share vertices and edges. */
#include <errno.h>
#include <stdlib.h>

#include "draw/group.h"
#include "draw/kernel.h"

/* Faces that may come at a time: a batch, or what one triangle is clipped to. */
#define MORE_FACES (ACCEL_BATCH + ACCEL_POLYGON_MAX)

/* @list with room for @count elements; what is there is kept. NULL: -ENOMEM, and @list is as it was. */
static void *group_grown(void *list, size_t size, size_t count)
{
	size_t bytes;

	return __builtin_mul_overflow(count, size, &bytes) ? NULL : realloc(list, bytes);
}

/* Between uses it has ACCEL_NONE everywhere. */
static int group_reserve_of(struct accel_group *group, uint32_t vertices)
{
	uint32_t *of;

	if (vertices <= group->of_room)
		return 0;
	of = group_grown(group->of, sizeof(*of), vertices);
	if (!of)
		return -ENOMEM;
	group->of = of;
	for (uint32_t i = group->of_room; i < vertices; i++)
		of[i] = ACCEL_NONE;
	group->of_room = vertices;
	return 0;
}

static int group_reserve_vertices(struct accel_group *group, size_t count)
{
	struct accel_vertex *vertex;
	struct accel_link *link;

	if (count <= group->vertices_room)
		return 0;
	link = group_grown(group->link, sizeof(*link), count);
	if (!link)
		return -ENOMEM;
	group->link = link;
	vertex = group_grown(group->vertex, sizeof(*vertex), count);
	if (!vertex)
		return -ENOMEM;
	group->vertex = vertex;
	group->vertices_room = (uint32_t)count;
	return 0;
}

static int group_reserve_edges(struct accel_group *group, size_t count)
{
	struct accel_edge *edge;
	struct accel_ends *ends;

	if (count <= group->edges_room)
		return 0;
	ends = group_grown(group->ends, sizeof(*ends), count);
	if (!ends)
		return -ENOMEM;
	group->ends = ends;
	edge = group_grown(group->edge, sizeof(*edge), count);
	if (!edge)
		return -ENOMEM;
	group->edge = edge;
	group->edges_room = (uint32_t)count;
	return 0;
}

static int group_reserve_faces(struct accel_group *group, size_t count)
{
	struct accel_face *face;

	if (count <= group->faces_room)
		return 0;
	face = group_grown(group->face, sizeof(*face), count);
	if (!face)
		return -ENOMEM;
	group->face = face;
	group->faces_room = (uint32_t)count;
	return 0;
}

/* @count is not less than there is room for. */
static int group_reserve_parts(struct accel_group *group, size_t count)
{
	struct accel_part *part = group_grown(group->part, sizeof(*part), count);

	if (!part)
		return -ENOMEM;
	group->part = part;
	group->parts_room = (uint32_t)count;
	return 0;
}

/* In steps, so that it seldom happens. */
static size_t group_more(uint32_t count, uint32_t more)
{
	return ((size_t)count + more + 4095) / 4096 * 4096;
}

int accel_group_reserve_parts(struct accel_group *group, uint32_t vertices, uint32_t edges,
			      uint32_t parts)
{
	int err = group_reserve_vertices(group, group_more(group->vertices, vertices));

	if (!err)
		err = group_reserve_edges(group, group_more(group->edges, edges));
	if (!err && group->parts + parts > group->parts_room)
		err = group_reserve_parts(group, group_more(group->parts, parts));
	return err;
}

int accel_group_reserve(struct accel_group *group, uint32_t vertices, uint32_t triangles)
{
	size_t faces = (triangles < ACCEL_GROUP_FACES ? triangles : ACCEL_GROUP_FACES) + MORE_FACES;
	int err = group_reserve_of(group, vertices);

	if (!err)
		err = group_reserve_faces(group, faces);
	if (!err)
		err = group_reserve_vertices(group, 4 * faces);
	if (!err)
		err = group_reserve_edges(group, 3 * faces);
	group->faces = group->vertices = group->edges = group->parts = 0;
	return err;
}

void accel_group_free(struct accel_group *group)
{
	free(group->of);
	free(group->face);
	free(group->vertex);
	free(group->link);
	free(group->edge);
	free(group->ends);
	free(group->part);
}

void accel_group_reset(struct accel_group *group)
{
	for (uint32_t i = 0; i < group->vertices; i++)
		if (group->link[i].index != ACCEL_NONE)
			group->of[group->link[i].index] = ACCEL_NONE;
	group->faces = group->vertices = group->edges = 0;
}

bool accel_group_full(const struct accel_group *group)
{
	/* Faces that are not clipped get their vertices later. */
	const uint32_t vertices = group->vertices + 3 * (group->faces + MORE_FACES);

	return group->faces + MORE_FACES > group->faces_room ||
	       vertices + ACCEL_BATCH > group->vertices_room;
}

struct accel_face *accel_group_face(struct accel_group *group)
{
	return &group->face[group->faces++];
}

static uint32_t group_vertex(struct accel_group *group, uint32_t index, int side)
{
	group->link[group->vertices] = (struct accel_link){
		.index = index,
		.other = ACCEL_NONE,
		.edge = ACCEL_NONE,
		.side = side,
	};
	return group->vertices++;
}

uint32_t accel_group_vertex(struct accel_group *group, int side)
{
	return group_vertex(group, ACCEL_NONE, side);
}

uint32_t accel_group_edge(struct accel_group *group, uint32_t a, uint32_t b)
{
	group->ends[group->edges] = (struct accel_ends){
		.a = a,
		.b = b,
		.next = ACCEL_NONE,
		.middle = ACCEL_NONE,
	};
	return group->edges++;
}

/* The vertex of the group that is vertex @index of the mesh, seen from @side. */
static uint32_t group_find_vertex(struct accel_group *group, uint32_t index, int side)
{
	uint32_t *at = &group->of[index];

	while (*at != ACCEL_NONE && group->link[*at].side != side)
		at = &group->link[*at].other;
	if (*at == ACCEL_NONE)
		*at = group_vertex(group, index, side);
	return *at;
}

void accel_group_link(struct accel_group *group, bool shared)
{
	for (uint32_t n = 0; n < group->faces; n++) {
		struct accel_face *face = &group->face[n];

		if (face->clipped)
			continue;
		for (int i = 0; i < 3; i++)
			face->vertex[i] = shared ? group_find_vertex(group, face->vertex[i],
								     face->side) :
						   group_vertex(group, face->vertex[i], face->side);
		face->flat = face->vertex[2];
	}
}

static uint32_t group_find_edge(struct accel_group *group, uint32_t a, uint32_t b)
{
	uint32_t low = a < b ? a : b, high = a < b ? b : a, edge = group->link[low].edge;

	while (edge != ACCEL_NONE && group->ends[edge].b != high)
		edge = group->ends[edge].next;
	if (edge != ACCEL_NONE)
		return edge;
	edge = accel_group_edge(group, low, high);
	group->ends[edge].next = group->link[low].edge;
	group->link[low].edge = edge;
	return edge;
}

void accel_group_link_edges(struct accel_group *group, struct accel_face *face)
{
	for (int i = 0; i < 3; i++)
		face->edge[i] = group_find_edge(group, face->vertex[i], face->vertex[(i + 1) % 3]);
}
