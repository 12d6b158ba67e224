// SPDX-License-Identifier: MIT
#include "draw/vertices.h"

#include <stdlib.h>

#define VERTICES_FIRST 256u

/* At least @least elements of @size bytes; @room is what @array has. */
static void *vertices_grow(void *array, uint32_t *room, uint64_t least, size_t size)
{
	uint64_t more = *room ? 2 * (uint64_t)*room : VERTICES_FIRST;
	void *grown;

	if (more < least)
		more = least;
	if (more > UINT32_MAX / 2)
		return NULL;
	grown = realloc(array, (size_t)more * size);
	if (grown)
		*room = (uint32_t)more;
	return grown;
}

bool gloss_vertices_reserve(struct gloss_vertices *vertices, uint32_t count)
{
	uint64_t least = (uint64_t)vertices->vertices + count;
	void *grown;

	if (least <= vertices->vertex_room)
		return true;
	grown = vertices_grow(vertices->vertex, &vertices->vertex_room, least,
			      sizeof(*vertices->vertex));
	if (grown)
		vertices->vertex = grown;
	else
		vertices->failed = true;
	return grown;
}

bool gloss_vertices_reserve_primitive(struct gloss_vertices *vertices)
{
	void *grown;

	if (vertices->primitives < vertices->primitive_room)
		return true;
	grown = vertices_grow(vertices->primitive, &vertices->primitive_room,
			      (uint64_t)vertices->primitives + 1, sizeof(*vertices->primitive));
	if (grown)
		vertices->primitive = grown;
	else
		vertices->failed = true;
	return grown;
}

void gloss_vertices_begin(struct gloss_vertices *vertices, GLenum mode)
{
	if (!gloss_vertices_reserve_primitive(vertices))
		return;
	vertices->primitive[vertices->primitives++] = (struct accel_primitive){
		.topology = (enum accel_topology)mode,
		.first = vertices->vertices,
	};
	vertices->inside = true;
}

/* Of @count vertices of a primitive those that are drawn. */
static uint32_t vertices_whole(enum accel_topology topology, uint32_t count)
{
	switch (topology) {
	case ACCEL_TOPOLOGY_POINTS:
		return count;
	case ACCEL_TOPOLOGY_LINES:
		return count - count % 2;
	case ACCEL_TOPOLOGY_LINE_LOOP:
	case ACCEL_TOPOLOGY_LINE_STRIP:
		return count < 2 ? 0 : count;
	case ACCEL_TOPOLOGY_TRIANGLES:
		return count - count % 3;
	case ACCEL_TOPOLOGY_QUADS:
		return count - count % 4;
	case ACCEL_TOPOLOGY_QUAD_STRIP:
		return count < 4 ? 0 : count - count % 2;
	default:
		return count < 3 ? 0 : count;
	}
}

/* Two of these one after the other are the same as one of all their vertices. */
static bool vertices_may_join(enum accel_topology topology)
{
	return topology == ACCEL_TOPOLOGY_POINTS || topology == ACCEL_TOPOLOGY_LINES ||
	       topology == ACCEL_TOPOLOGY_TRIANGLES || topology == ACCEL_TOPOLOGY_QUADS;
}

void gloss_vertices_end(struct gloss_vertices *vertices)
{
	struct accel_primitive *last = &vertices->primitive[vertices->primitives - 1];
	struct accel_primitive *before = last - 1;

	vertices->inside = false;
	last->count = vertices_whole(last->topology, vertices->vertices - last->first);
	vertices->vertices = last->first + last->count;
	/* What was set in a list while the forgotten ones came, was before the next. */
	for (size_t i = 0; i < sizeof(vertices->unset) / sizeof(vertices->unset[0]); i++)
		if (vertices->unset[i] > vertices->vertices)
			vertices->unset[i] = vertices->vertices;
	if (!last->count) {
		vertices->primitives--;
	} else if (vertices->primitives > 1 && before->topology == last->topology &&
		   vertices_may_join(last->topology) &&
		   before->first + before->count == last->first) {
		before->count += last->count;
		vertices->primitives--;
	}
}

void gloss_vertices_clear(struct gloss_vertices *vertices)
{
	vertices->vertices = 0;
	vertices->primitives = 0;
	vertices->failed = false;
}

void gloss_vertices_free(struct gloss_vertices *vertices)
{
	free(vertices->vertex);
	free(vertices->primitive);
}
