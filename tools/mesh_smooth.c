// SPDX-License-Identifier: MIT
/*
 * Smooth normals: at each place the sum of its triangles' normals, each weighted with the angle it
 * has there, so that it does not matter how a face is cut into triangles.
 */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh.h"

static int compare(const float a[3], const float b[3])
{
	for (int i = 0; i < 3; i++)
		if (a[i] != b[i])
			return a[i] < b[i] ? -1 : 1;
	return 0;
}

static int compare_vertices(const void *a, const void *b, void *position)
{
	const float(*p)[3] = position;

	return compare(p[*(const uint32_t *)a], p[*(const uint32_t *)b]);
}

static void subtract(double out[3], const float a[3], const float b[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = (double)a[i] - (double)b[i];
}

static double length(const double v[3])
{
	return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Adds to @sum what the corner at @a of the triangle @a, @b, @c gives. */
static void add_corner(double sum[3], const float a[3], const float b[3], const float c[3])
{
	double u[3], v[3], normal[3], size, cosine = 0;

	subtract(u, b, a);
	subtract(v, c, a);
	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;

		normal[i] = u[j] * v[k] - u[k] * v[j];
		cosine += u[i] * v[i];
	}
	size = length(normal);
	for (int i = 0; i < 3 && size > 0; i++)
		sum[i] += normal[i] / size * atan2(size, cosine);
}

static void add_triangle(const struct mesh *mesh, const uint32_t triangle[3], const uint32_t *place,
			 double (*sum)[3])
{
	for (int i = 0; i < 3; i++) {
		uint32_t a = triangle[i], b = triangle[(i + 1) % 3], c = triangle[(i + 2) % 3];

		add_corner(sum[place[a]], mesh->position[a], mesh->position[b], mesh->position[c]);
	}
}

/* Gives each vertex from @first on the number of the first one that is where it is. */
static void find_places(const struct mesh *mesh, uint32_t first, uint32_t *order, uint32_t *place)
{
	uint32_t count = mesh->vertices - first;

	for (uint32_t i = 0; i < count; i++)
		order[i] = first + i;
	qsort_r(order, count, sizeof(*order), compare_vertices, mesh->position);
	for (uint32_t i = 0; i < count; i++) {
		bool same = i && !compare(mesh->position[order[i]], mesh->position[order[i - 1]]);

		place[order[i]] = same ? place[order[i - 1]] : order[i];
	}
}

static void set_normal(float out[3], const double sum[3])
{
	double size = length(sum);

	if (out[0] || out[1] || out[2])
		return;
	/* If there is nothing but degenerate triangles, or opposite ones, any will do. */
	out[2] = 1;
	for (int i = 0; i < 3 && size > 0; i++)
		out[i] = (float)(sum[i] / size);
}

int mesh_smooth(struct mesh *mesh, uint32_t vertex, uint32_t triangle)
{
	uint32_t *order = calloc(mesh->vertices, sizeof(*order));
	uint32_t *place = calloc(mesh->vertices, sizeof(*place));
	double(*sum)[3] = calloc(mesh->vertices, sizeof(*sum));
	bool good = order && place && sum;

	if (good) {
		find_places(mesh, vertex, order, place);
		for (uint32_t i = triangle; i < mesh->triangles; i++)
			add_triangle(mesh, mesh->triangle[i], place, sum);
		for (uint32_t i = vertex; i < mesh->vertices; i++)
			set_normal(mesh->normal[i], sum[place[i]]);
	}
	free(order);
	free(place);
	free(sum);
	return good ? 0 : -ENOMEM;
}
