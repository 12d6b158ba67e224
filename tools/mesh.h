/* SPDX-License-Identifier: MIT */
/* Triangle meshes from files (through assimp) and built-in shapes. */
#ifndef TOOLS_MESH_H
#define TOOLS_MESH_H

#include <stdbool.h>

#include "accel.h"

#define MESH_MESSAGE 512

struct mesh {
	uint32_t vertices, triangles;
	float (*position)[3], (*normal)[3];
	uint32_t (*triangle)[3];	/* indices of vertices */
};

/*
 * Loads @name: a built-in shape (MESH_SHAPES) or a file that assimp reads. Meshes of a file
 * become one; what has no normals, or everything with @smooth, gets smooth ones. On failure
 * @message says "what: where: what to do" in one line. -errno
 */
int mesh_load(const char *name, bool smooth, struct mesh *mesh, char message[MESH_MESSAGE]);
void mesh_free(struct mesh *mesh);

/* Arrays of zeros. -ENOMEM */
int mesh_new(uint32_t vertices, uint32_t triangles, struct mesh *mesh);

/*
 * Gives smooth normals to those of the vertices from number @vertex on that have normals of no
 * length; vertices at the same place get the same. The triangles from number @triangle on are
 * theirs, and have no other corners. -ENOMEM
 */
int mesh_smooth(struct mesh *mesh, uint32_t vertex, uint32_t triangle);

/* A box's middle, and the radius of the sphere around it that holds all vertices. */
void mesh_bounds(const struct mesh *mesh, float centre[3], float *radius);

/* @mesh as the library takes it; lent. */
struct accel_mesh mesh_lend(const struct mesh *mesh);

/* Shapes of radius 1 or less around the origin, with exact normals. */
/* Icosphere: an icosahedron's 20 triangles quartered @level times, 0 to 7. */
int mesh_sphere(int level, struct mesh *mesh);
/* Torus: 2 * @width times @width quads, @width 3 to 512; radii 0.65 and 0.33. */
int mesh_torus(int width, struct mesh *mesh);
int mesh_cube(struct mesh *mesh);
/* Plane: @width times @width quads, 1 to 512, facing z. */
int mesh_plane(int width, struct mesh *mesh);

/*
 * Makes the shape called @name. 0: made; -ENOENT: not the name of a shape; -EINVAL: its number
 * is out of range; -ENOMEM.
 */
int mesh_shape(const char *name, struct mesh *mesh);
/* The names mesh_shape takes, for people. */
#define MESH_SHAPES "sphere:0..7, torus:3..512, cube, plane:1..512"

#endif
