/* SPDX-License-Identifier: MIT */
/*
 * Vertices of a mesh as they come, each kept once: those that are equal to the bit in all that
 * the mesh has are one. An STL file has each six times.
 */
#ifndef TOOLS_MESH_WELD_H
#define TOOLS_MESH_WELD_H

#include "scene/mesh.h"

/* So many at a time, so that memory can be asked for ahead of its use. */
#define WELD_BLOCK 32

struct weld_vertex {
	float position[3], normal[3], colour[4];
};

struct weld_slot {
	uint32_t hash, number; /* of a vertex; UINT32_MAX: none */
};

struct weld {
	struct mesh *mesh; /* its arrays have room for all that may come */
	struct weld_slot *slot;
	size_t slots; /* a power of two */
};

/* For about @vertices that come. -ENOMEM */
int weld_begin(struct weld *weld, struct mesh *mesh, uint64_t vertices);
/* Appends what is new of @count vertices, and sets the @number of each. -ENOMEM */
int weld_add(struct weld *weld, const struct weld_vertex *vertex, uint32_t count, uint32_t *number);
void weld_end(struct weld *weld);

#endif
