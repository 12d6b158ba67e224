// SPDX-License-Identifier: MIT
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "scene/mesh.h"

int mesh_new(uint32_t vertices, uint32_t triangles, struct mesh *mesh)
{
	*mesh = (struct mesh){ .vertices = vertices, .triangles = triangles };
	mesh->position = calloc(vertices, sizeof(*mesh->position));
	mesh->normal = calloc(vertices, sizeof(*mesh->normal));
	mesh->triangle = calloc(triangles, sizeof(*mesh->triangle));
	if (mesh->position && mesh->normal && mesh->triangle)
		return 0;
	mesh_free(mesh);
	return -ENOMEM;
}

void mesh_free(struct mesh *mesh)
{
	if (mesh->map) {
		munmap(mesh->map, mesh->map_size);
	} else {
		free(mesh->position);
		free(mesh->normal);
		free(mesh->colour);
		free(mesh->triangle);
	}
	memset(mesh, 0, sizeof(*mesh));
}

void mesh_bounds(const struct mesh *mesh, float centre[3], float *radius)
{
	double square = 0;

	for (int i = 0; i < 3; i++) {
		float low = INFINITY, high = -INFINITY;

		for (uint32_t v = 0; v < mesh->vertices; v++) {
			low = fminf(low, mesh->position[v][i]);
			high = fmaxf(high, mesh->position[v][i]);
		}
		centre[i] = low / 2 + high / 2;
	}
	for (uint32_t v = 0; v < mesh->vertices; v++) {
		double distance = 0;

		for (int i = 0; i < 3; i++) {
			double d = (double)mesh->position[v][i] - centre[i];

			distance += d * d;
		}
		square = fmax(square, distance);
	}
	*radius = (float)sqrt(square);
}

bool mesh_has_area(const struct mesh *mesh)
{
	for (uint32_t t = 0; t < mesh->triangles; t++) {
		const float *a = mesh->position[mesh->triangle[t][0]];
		const float *b = mesh->position[mesh->triangle[t][1]];
		const float *c = mesh->position[mesh->triangle[t][2]];

		for (int i = 0; i < 3; i++) {
			int j = (i + 1) % 3;

			if (((double)b[i] - a[i]) * ((double)c[j] - a[j]) !=
			    ((double)b[j] - a[j]) * ((double)c[i] - a[i]))
				return true;
		}
	}
	return false;
}

void mesh_rescale(struct mesh *mesh, float centre[3], float *radius)
{
	int exponent;

	*radius = frexpf(*radius, &exponent);
	for (int i = 0; i < 3; i++) {
		centre[i] = ldexpf(centre[i], -exponent);
		for (uint32_t v = 0; v < mesh->vertices; v++)
			mesh->position[v][i] = ldexpf(mesh->position[v][i], -exponent);
	}
}

struct accel_mesh mesh_lend(const struct mesh *mesh)
{
	return (struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
					     .vertices = mesh->vertices,
					     .position = { .data = mesh->position },
					     .normal = { .data = mesh->normal },
					     .colour = { .data = mesh->colour },
					     .indices = mesh->triangles * 3,
					     .index = mesh->triangle[0]);
}
