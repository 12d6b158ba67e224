// SPDX-License-Identifier: MIT
/*
 * The triangles that primitives are split into, one after the other (OpenGL 1.5, section 2.6.1). The
 * last vertex of each is that of its primitive which gives a flat one its colour (section 2.14.7):
 * the last one, of a polygon the first.
 */
#include <string.h>

#include "draw/group.h"

enum accel_figure accel_primitives_figure(enum accel_topology topology)
{
	if (topology == ACCEL_TOPOLOGY_POINTS)
		return ACCEL_FIGURE_POINTS;
	return topology < ACCEL_TOPOLOGY_TRIANGLES ? ACCEL_FIGURE_LINES : ACCEL_FIGURE_FILLED;
}

uint32_t accel_primitives_elements(const struct accel_pass *pass,
				   const struct accel_primitive *primitive)
{
	const uint32_t vertices = pass->arrays->vertices;
	const uint32_t least = primitive->first < vertices ? vertices - primitive->first : 0;

	if (pass->elements->index || primitive->count <= least)
		return primitive->count;
	return primitive->topology == ACCEL_TOPOLOGY_POLYGON ? 0 : least;
}

uint32_t accel_primitives_triangles(const struct accel_pass *pass,
				    const struct accel_primitive *primitive)
{
	const uint32_t count = accel_primitives_elements(pass, primitive);

	switch (primitive->topology) {
	case ACCEL_TOPOLOGY_POINTS:
		return count;
	case ACCEL_TOPOLOGY_LINES:
		return count / 2;
	case ACCEL_TOPOLOGY_LINE_STRIP:
		return count < 2 ? 0 : count - 1;
	case ACCEL_TOPOLOGY_LINE_LOOP:
		return count < 2 ? 0 : count;
	case ACCEL_TOPOLOGY_TRIANGLES:
		return count / 3;
	case ACCEL_TOPOLOGY_QUADS:
		return count / 4 * 2;
	case ACCEL_TOPOLOGY_QUAD_STRIP:
		return count < 4 ? 0 : count / 2 * 2 - 2;
	default:
		return count < 3 ? 0 : count - 2;
	}
}

uint32_t accel_primitives_polygons(const struct accel_pass *pass,
				   const struct accel_primitive *primitive, uint32_t *corners)
{
	const uint32_t triangles = accel_primitives_triangles(pass, primitive);

	*corners = 3;
	switch (primitive->topology) {
	case ACCEL_TOPOLOGY_QUADS:
	case ACCEL_TOPOLOGY_QUAD_STRIP:
		*corners = 4;
		return triangles / 2;
	case ACCEL_TOPOLOGY_POLYGON:
		*corners = accel_primitives_elements(pass, primitive);
		return triangles != 0;
	default:
		return triangles;
	}
}

uint32_t accel_primitives_corner(enum accel_topology topology, uint32_t polygon, uint32_t i)
{
	switch (topology) {
	case ACCEL_TOPOLOGY_TRIANGLES:
		return 3 * polygon + i;
	case ACCEL_TOPOLOGY_TRIANGLE_STRIP:
		return polygon + (i < 2 ? i ^ (polygon & 1) : i);
	case ACCEL_TOPOLOGY_TRIANGLE_FAN:
		return i ? polygon + i : 0;
	case ACCEL_TOPOLOGY_QUADS:
		return 4 * polygon + i;
	case ACCEL_TOPOLOGY_QUAD_STRIP:
		return 2 * polygon + (i < 2 ? i : 5 - i);
	default:
		return i;
	}
}

uint32_t accel_primitives_provoking(enum accel_topology topology)
{
	if (topology == ACCEL_TOPOLOGY_POLYGON)
		return 0;
	return topology == ACCEL_TOPOLOGY_QUADS ? 3 : 2;
}

bool accel_primitives_has_edges(enum accel_topology topology)
{
	return topology == ACCEL_TOPOLOGY_TRIANGLES || topology == ACCEL_TOPOLOGY_QUADS ||
	       topology == ACCEL_TOPOLOGY_POLYGON;
}

/* Vertex of the pass that element @i of the primitive is; ACCEL_NONE: it is none. */
static uint32_t primitives_element(const struct accel_walk *walk, uint32_t i)
{
	const struct accel_pass *pass = walk->pass;
	uint32_t number;

	if (pass->gather)
		return (uint32_t)(walk->before + i);
	number = accel_arrays_element(pass->elements, (uint64_t)walk->primitive->first + i);
	return number < pass->arrays->vertices ? number - pass->base : ACCEL_NONE;
}

static bool primitives_drawable(const struct accel_walk *walk, uint32_t vertex)
{
	return vertex != ACCEL_NONE &&
	       !(walk->pass->screen[vertex].outside & ACCEL_OUTSIDE_INFINITE);
}

bool accel_primitives_vertex(const struct accel_walk *walk, uint32_t i, uint32_t *vertex)
{
	*vertex = primitives_element(walk, i);
	return primitives_drawable(walk, *vertex);
}

static bool primitives_polygon_drawable(const struct accel_walk *walk)
{
	for (uint32_t i = 0; i < walk->primitive->count; i++)
		if (!primitives_drawable(walk, primitives_element(walk, i)))
			return false;
	return true;
}

static void primitives_enter(struct accel_walk *walk, uint32_t triangle)
{
	walk->triangle = triangle;
	walk->triangles = accel_primitives_triangles(walk->pass, walk->primitive);
	if (walk->triangle < walk->triangles)
		walk->whole = walk->primitive->topology != ACCEL_TOPOLOGY_POLYGON ||
			      primitives_polygon_drawable(walk);
	walk->number = NULL;
	if (walk->primitive->topology == ACCEL_TOPOLOGY_TRIANGLES && !walk->pass->gather &&
	    walk->pass->elements->index && walk->pass->elements->index_type == ACCEL_TYPE_UINT)
		walk->number = (const uint8_t *)walk->pass->elements->index +
			       ((size_t)walk->primitive->first + 3 * (size_t)triangle) *
				       sizeof(uint32_t);
}

void accel_primitives_begin(struct accel_walk *walk, const struct accel_pass *pass, uint64_t first)
{
	const struct accel_primitive *primitive = pass->elements->primitive;
	uint64_t before = 0;
	uint32_t triangles;

	for (;; primitive++) {
		triangles = accel_primitives_triangles(pass, primitive);
		if (first < triangles)
			break;
		first -= triangles;
		before += accel_primitives_elements(pass, primitive);
	}
	*walk = (struct accel_walk){ .pass = pass, .primitive = primitive, .before = before };
	primitives_enter(walk, (uint32_t)first);
}

/* The elements of triangle @i; [3] is what its primitive has beside these. */
static void primitives_elements(enum accel_topology topology, uint32_t i, uint32_t element[4])
{
	uint32_t quad = i / 2, half = i % 2;

	switch (topology) {
	case ACCEL_TOPOLOGY_TRIANGLES:
		i *= 3;
		break;
	case ACCEL_TOPOLOGY_TRIANGLE_STRIP:
		/* Every second triangle of a strip turns the other way. */
		element[0] = i + half;
		element[1] = i + 1 - half;
		element[2] = element[3] = i + 2;
		return;
	case ACCEL_TOPOLOGY_TRIANGLE_FAN:
		element[0] = 0;
		element[1] = i + 1;
		element[2] = element[3] = i + 2;
		return;
	case ACCEL_TOPOLOGY_POLYGON:
		element[0] = i + 1;
		element[1] = i + 2;
		element[2] = element[3] = 0;
		return;
	case ACCEL_TOPOLOGY_QUADS:
		element[0] = 4 * quad + half;
		element[1] = 4 * quad + 1 + half;
		element[2] = 4 * quad + 3;
		element[3] = 4 * quad + (half ? 0 : 2);
		return;
	default:
		/* A quad of a strip is 0, 1, 3, 2. */
		element[0] = 2 * quad + (half ? 0 : 2);
		element[1] = 2 * quad + (half ? 1 : 0);
		element[2] = 2 * quad + 3;
		element[3] = 2 * quad + (half ? 2 : 1);
		return;
	}
	element[0] = i;
	element[1] = i + 1;
	element[2] = element[3] = i + 2;
}

/* The next of a walk whose primitive has walk->number, and another triangle. */
static bool primitives_next_listed(struct accel_walk *walk, uint32_t index[3])
{
	const struct accel_pass *pass = walk->pass;
	const struct accel_screen *screen = pass->screen;
	const uint32_t vertices = pass->arrays->vertices, base = pass->base;
	uint32_t number[3];

	memcpy(number, walk->number, sizeof(number));
	walk->number += sizeof(number);
	walk->triangle++;
	if (number[0] >= vertices || number[1] >= vertices || number[2] >= vertices)
		return false;
	for (int i = 0; i < 3; i++)
		index[i] = number[i] - base;
	return !((screen[index[0]].outside | screen[index[1]].outside | screen[index[2]].outside) &
		 ACCEL_OUTSIDE_INFINITE);
}

bool accel_primitives_next(struct accel_walk *walk, uint32_t index[3])
{
	uint32_t element[4], vertex;
	bool drawable;

	while (walk->triangle == walk->triangles) {
		walk->before += accel_primitives_elements(walk->pass, walk->primitive);
		walk->primitive++;
		primitives_enter(walk, 0);
	}
	if (walk->number)
		return primitives_next_listed(walk, index);
	drawable = walk->whole;
	primitives_elements(walk->primitive->topology, walk->triangle++, element);
	for (int i = 0; i < 4; i++) {
		vertex = primitives_element(walk, element[i]);
		drawable = drawable && primitives_drawable(walk, vertex);
		if (i < 3)
			index[i] = vertex;
	}
	return drawable;
}
