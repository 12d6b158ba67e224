// SPDX-License-Identifier: MIT
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/mesh.h"

#define SPHERE_LEVELS 7
#define TORUS_RING 0.65
#define TORUS_TUBE 0.33
#define GRID_MAX 512
#define TURN (2 * 3.14159265358979323846)

static void set(float out[3], double x, double y, double z)
{
	out[0] = (float)x;
	out[1] = (float)y;
	out[2] = (float)z;
}

static void set_triangle(struct mesh *mesh, uint32_t number, uint32_t a, uint32_t b, uint32_t c)
{
	mesh->triangle[number][0] = a;
	mesh->triangle[number][1] = b;
	mesh->triangle[number][2] = c;
}

/* ---- sphere ---- */

/* Middles of edges found so far, in a list for each edge's lower vertex. */
struct middle {
	uint32_t high, vertex, next; /* next: index + 1, 0 ends the list */
};

struct middles {
	uint32_t *first;
	struct middle *middle;
	uint32_t count;
};

static void icosahedron(struct mesh *mesh)
{
	static const uint8_t face[20][3] = {
		{ 0, 1, 8 },  { 0, 10, 1 }, { 0, 4, 5 },   { 0, 8, 4 }, { 0, 5, 10 },
		{ 1, 7, 6 },  { 1, 6, 8 },  { 1, 10, 7 },  { 2, 9, 3 }, { 2, 3, 11 },
		{ 2, 5, 4 },  { 2, 4, 9 },  { 2, 11, 5 },  { 3, 6, 7 }, { 3, 9, 6 },
		{ 3, 7, 11 }, { 4, 8, 9 },  { 5, 11, 10 }, { 6, 9, 8 }, { 7, 10, 11 },
	};
	double golden = (1 + sqrt(5)) / 2, scale = 1 / sqrt(1 + golden * golden);

	/* The corners of three golden rectangles. */
	for (int i = 0; i < 4; i++) {
		double near = i & 1 ? -scale : scale;
		double far = (i & 2 ? -scale : scale) * golden;

		set(mesh->position[i], 0, near, far);
		set(mesh->position[4 + i], near, far, 0);
		set(mesh->position[8 + i], far, 0, near);
	}
	mesh->vertices = 12;
	mesh->triangles = 20;
	for (int i = 0; i < 20; i++)
		set_triangle(mesh, i, face[i][0], face[i][1], face[i][2]);
}

static uint32_t middle_of(struct mesh *mesh, struct middles *middles, uint32_t a, uint32_t b)
{
	uint32_t low = a < b ? a : b, high = a < b ? b : a;
	const float *p = mesh->position[a], *q = mesh->position[b];
	double x = (double)p[0] + q[0], y = (double)p[1] + q[1], z = (double)p[2] + q[2];
	double length = sqrt(x * x + y * y + z * z);
	struct middle *middle;

	for (uint32_t i = middles->first[low]; i; i = middles->middle[i - 1].next)
		if (middles->middle[i - 1].high == high)
			return middles->middle[i - 1].vertex;
	middle = &middles->middle[middles->count++];
	middle->high = high;
	middle->vertex = mesh->vertices++;
	middle->next = middles->first[low];
	middles->first[low] = middles->count;
	set(mesh->position[middle->vertex], x / length, y / length, z / length);
	return middle->vertex;
}

static void quarter(struct mesh *mesh, struct middles *middles)
{
	uint32_t triangles = mesh->triangles;

	memset(middles->first, 0, mesh->vertices * sizeof(*middles->first));
	middles->count = 0;
	for (uint32_t i = 0; i < triangles; i++) {
		const uint32_t *corner = mesh->triangle[i];
		uint32_t a = corner[0], b = corner[1], c = corner[2];
		uint32_t ab = middle_of(mesh, middles, a, b);
		uint32_t bc = middle_of(mesh, middles, b, c);
		uint32_t ca = middle_of(mesh, middles, c, a);

		set_triangle(mesh, i, ab, bc, ca);
		set_triangle(mesh, mesh->triangles++, a, ab, ca);
		set_triangle(mesh, mesh->triangles++, ab, b, bc);
		set_triangle(mesh, mesh->triangles++, ca, bc, c);
	}
}

int mesh_sphere(int level, struct mesh *mesh)
{
	uint32_t triangles, vertices;
	struct middles middles;
	int ret;

	if (level < 0 || level > SPHERE_LEVELS)
		return -EINVAL;
	triangles = 20u << 2 * level;
	vertices = triangles / 2 + 2;
	ret = mesh_new(vertices, triangles, mesh);
	if (ret)
		return ret;
	middles.first = calloc(vertices, sizeof(*middles.first));
	middles.middle = calloc(vertices, sizeof(*middles.middle));
	if (middles.first && middles.middle) {
		icosahedron(mesh);
		for (int i = 0; i < level; i++)
			quarter(mesh, &middles);
		memcpy(mesh->normal, mesh->position, vertices * sizeof(*mesh->normal));
	} else {
		mesh_free(mesh);
		ret = -ENOMEM;
	}
	free(middles.first);
	free(middles.middle);
	return ret;
}

/* ---- grids ---- */

/* Two triangles, counter-clockwise seen from where u runs right and v runs up. */
static void set_quad(struct mesh *mesh, uint32_t number, uint32_t a, uint32_t right, uint32_t up,
		     uint32_t across)
{
	set_triangle(mesh, number * 2, a, right, across);
	set_triangle(mesh, number * 2 + 1, a, across, up);
}

static void torus_vertex(struct mesh *mesh, uint32_t number, double ring, double tube)
{
	double x = cos(ring) * cos(tube), y = sin(ring) * cos(tube), z = sin(tube);

	set(mesh->normal[number], x, y, z);
	set(mesh->position[number], TORUS_RING * cos(ring) + TORUS_TUBE * x,
	    TORUS_RING * sin(ring) + TORUS_TUBE * y, TORUS_TUBE * z);
}

int mesh_torus(int width, struct mesh *mesh)
{
	int ring = width * 2;
	int ret;

	if (width < 3 || width > GRID_MAX)
		return -EINVAL;
	ret = mesh_new(ring * width, ring * width * 2, mesh);
	if (ret)
		return ret;
	for (int u = 0; u < ring; u++) {
		for (int v = 0; v < width; v++) {
			int number = u * width + v;
			int right = (u + 1) % ring * width, up = (v + 1) % width;

			torus_vertex(mesh, number, TURN * u / ring, TURN * v / width);
			set_quad(mesh, number, number, right + v, u * width + up, right + up);
		}
	}
	return 0;
}

int mesh_plane(int width, struct mesh *mesh)
{
	int ret;

	if (width < 1 || width > GRID_MAX)
		return -EINVAL;
	ret = mesh_new((width + 1) * (width + 1), width * width * 2, mesh);
	if (ret)
		return ret;
	for (int y = 0; y <= width; y++) {
		for (int x = 0; x <= width; x++) {
			int number = y * (width + 1) + x;

			set(mesh->position[number], (2.0 * x / width - 1) * 0.7,
			    (2.0 * y / width - 1) * 0.7, 0);
			set(mesh->normal[number], 0, 0, 1);
			if (x < width && y < width)
				set_quad(mesh, y * width + x, number, number + 1,
					 number + width + 1, number + width + 2);
		}
	}
	return 0;
}

static void cube_face(struct mesh *mesh, int face)
{
	int axis = face / 2, sign = face % 2 ? -1 : 1;
	int u = (axis + 1) % 3, v = (axis + 2) % 3;
	int first = face * 4;

	for (int i = 0; i < 4; i++) {
		float *position = mesh->position[first + i];

		/* On the far side u runs the other way, so that the face still looks outwards. */
		position[u] = (float)((i & 1 ? 0.57 : -0.57) * sign);
		position[v] = i & 2 ? 0.57f : -0.57f;
		position[axis] = 0.57f * (float)sign;
		mesh->normal[first + i][axis] = (float)sign;
	}
	set_quad(mesh, face, first, first + 1, first + 2, first + 3);
}

int mesh_cube(struct mesh *mesh)
{
	int ret = mesh_new(24, 12, mesh);

	for (int face = 0; face < 6 && !ret; face++)
		cube_face(mesh, face);
	return ret;
}

/* ---- by name ---- */

static int cube(int width, struct mesh *mesh)
{
	(void)width;
	return mesh_cube(mesh);
}

static const struct shape {
	const char *name;
	int number; /* without one in the name; -1: takes none */
	int (*make)(int number, struct mesh *mesh);
} shapes[] = {
	{ "sphere", 3, mesh_sphere },
	{ "torus", 24, mesh_torus },
	{ "plane", 1, mesh_plane },
	{ "cube", -1, cube },
};

int mesh_shape(const char *name, struct mesh *mesh)
{
	size_t length = strcspn(name, ":");

	for (size_t i = 0; i < sizeof(shapes) / sizeof(*shapes); i++) {
		const struct shape *shape = &shapes[i];
		char *end;
		long number;

		if (strlen(shape->name) != length || strncmp(shape->name, name, length) != 0)
			continue;
		if (!name[length])
			return shape->make(shape->number, mesh);
		number = strtol(name + length + 1, &end, 10);
		if (shape->number < 0 || end == name + length + 1 || *end || number < 0 ||
		    number > GRID_MAX)
			return -EINVAL;
		return shape->make((int)number, mesh);
	}
	return -ENOENT;
}
