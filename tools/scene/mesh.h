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
	float (*colour)[4];      /* NULL: has none */
	uint32_t (*triangle)[3]; /* indices of vertices */
	void *map;               /* memory that all arrays lie in; NULL: each is its own */
	size_t map_size;
};

enum mesh_normals {
	MESH_NORMALS_CREASED, /* the file's; where it has none, smooth up to a crease */
	MESH_NORMALS_SMOOTH,  /* smooth everywhere */
	MESH_NORMALS_FACETS   /* of each triangle its own */
};

struct mesh_options {
	enum mesh_normals normals;
	float crease; /* degrees; an edge where faces meet at more is sharp */
	/* Called about ten times a second while a file is read; may be NULL. */
	void (*waiting)(void *data);
	void *data;
};

#define MESH_CREASE 30 /* degrees, if there is no better reason */

/*
 * Loads @name: a built-in shape (MESH_SHAPES) or a file that assimp reads. Meshes of a file
 * become one. Its normals are made anew where they contradict the winding of its triangles, and
 * for STL always. On failure @message says "what: where: what to do" in one line. -errno
 */
int mesh_load(const char *name, const struct mesh_options *options, struct mesh *mesh,
	      char message[MESH_MESSAGE]);
void mesh_free(struct mesh *mesh);

/* Arrays of zeros, without colours. -ENOMEM */
int mesh_new(uint32_t vertices, uint32_t triangles, struct mesh *mesh);

/*
 * Makes @mesh of @raw, whose vertices may be joined or not: normals where @raw has none (NULL, or
 * some without length) or @normals asks for others, vertices joined where all of them is equal,
 * to the bit, and left out where no triangle has them. Triangles stay as they are. -ENOMEM
 */
int mesh_build(const struct mesh *raw, enum mesh_normals normals, float crease, struct mesh *mesh);

/* Whether some triangle has an area. */
bool mesh_has_area(const struct mesh *mesh);

/* Multiplies the positions by the power of two that makes @radius, of mesh_bounds, 1/2 to 1. */
void mesh_rescale(struct mesh *mesh, float centre[3], float *radius);

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
