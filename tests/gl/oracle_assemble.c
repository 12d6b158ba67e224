// SPDX-License-Identifier: MIT
/* Which vertices make a primitive (2.6.1), and which of them colours it if flat (table 2.11). */
#include "oracle.h"

#include <string.h>

/* The vertices from @first on that each primitive takes, and how far the next one's are. */
static const struct shape {
	int corners, step, provoking;
} shapes[ORACLE_TOPOLOGIES] = {
	[ORACLE_POINTS] = { 1, 1, 0 },       [ORACLE_LINES] = { 2, 2, 1 },
	[ORACLE_LINE_LOOP] = { 2, 1, 1 },    [ORACLE_LINE_STRIP] = { 2, 1, 1 },
	[ORACLE_TRIANGLES] = { 3, 3, 2 },    [ORACLE_TRIANGLE_STRIP] = { 3, 1, 2 },
	[ORACLE_TRIANGLE_FAN] = { 3, 1, 2 }, [ORACLE_QUADS] = { 4, 4, 3 },
	[ORACLE_QUAD_STRIP] = { 4, 2, 3 },
};

static void swap(int *a, int *b)
{
	int kept = *a;

	*a = *b;
	*b = kept;
}

static bool assemble_polygon(int vertices, int n, struct oracle_primitive *primitive)
{
	if (n || vertices < 3 || vertices > ORACLE_POLYGON)
		return false;
	primitive->corners = vertices;
	primitive->provoking = 0;
	for (int i = 0; i < vertices; i++)
		primitive->vertex[i] = i;
	return true;
}

bool oracle_assemble(enum oracle_topology topology, int vertices, int n,
		     struct oracle_primitive *primitive)
{
	const struct shape *shape = &shapes[topology];
	int first = n * shape->step;
	bool closes = topology == ORACLE_LINE_LOOP && vertices > 1 && n == vertices - 1;

	memset(primitive, 0, sizeof(*primitive));
	if (topology == ORACLE_ONE_POLYGON)
		return assemble_polygon(vertices, n, primitive);
	if (!closes && first + shape->corners > vertices)
		return false;
	primitive->corners = shape->corners;
	for (int i = 0; i < shape->corners; i++)
		primitive->vertex[i] = (first + i) % vertices;
	primitive->provoking = primitive->vertex[shape->provoking];
	if (topology == ORACLE_TRIANGLE_FAN)
		primitive->vertex[0] = 0;
	/* Every second triangle of a strip goes the other way around. */
	if (topology == ORACLE_TRIANGLE_STRIP && n % 2)
		swap(&primitive->vertex[0], &primitive->vertex[1]);
	/* The quadrilateral of a strip is 1, 2, 4, 3. */
	if (topology == ORACLE_QUAD_STRIP)
		swap(&primitive->vertex[2], &primitive->vertex[3]);
	return true;
}
