/* SPDX-License-Identifier: MIT */
/* Which vertices of a mesh are at one point, and which triangles' corners. */
#ifndef TOOLS_MESH_PLACE_H
#define TOOLS_MESH_PLACE_H

#include "scene/mesh.h"

/*
 * A place is known by the number of the first vertex there. Corner 3 * t + i is vertex i of
 * triangle t. Equal is what is equal to the bit, but for the sign of zero: no distance is so
 * small that a mesh could not have its own vertices in it.
 */
struct places {
	uint32_t *place; /* of each vertex */
	uint32_t *first; /* of place p: corner[first[p]] to, without, first[p + 1] */
	uint32_t *corner;
	uint32_t most; /* corners of one place, at least 1 */
};

/* -ENOMEM */
int places_new(const struct mesh *mesh, struct places *places);
void places_free(struct places *places);

#endif
