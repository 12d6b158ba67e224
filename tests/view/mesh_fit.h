/* SPDX-License-Identifier: MIT */
/* What a mesh should be like. */
#ifndef TESTS_VIEW_MESH_FIT_H
#define TESTS_VIEW_MESH_FIT_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "scene/mesh.h"

static inline double dot(const float a[3], const float b[3])
{
	return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

/* Of a triangle, with the length of twice its area. */
static inline void face_normal(const struct mesh *mesh, uint32_t number, float normal[3])
{
	const float *p = mesh->position[mesh->triangle[number][0]];
	const float *q = mesh->position[mesh->triangle[number][1]];
	const float *r = mesh->position[mesh->triangle[number][2]];

	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;

		normal[i] = (q[j] - p[j]) * (r[k] - p[k]) - (q[k] - p[k]) * (r[j] - p[j]);
	}
}

static inline void assert_normals_fit(const struct mesh *mesh, double least)
{
	for (uint32_t i = 0; i < mesh->triangles; i++) {
		float normal[3];

		face_normal(mesh, i, normal);
		for (int corner = 0; corner < 3; corner++) {
			const float *at = mesh->normal[mesh->triangle[i][corner]];

			assert_true(fabs(dot(at, at) - 1) < 1e-5);
			assert_true(dot(at, normal) > least * sqrt(dot(normal, normal)));
		}
	}
}

/* Each edge has a neighbour that runs it the other way: no holes, one side is out. */
static inline void assert_closed(const struct mesh *mesh)
{
	size_t pairs = (size_t)mesh->vertices * mesh->vertices;
	uint8_t *runs = calloc(pairs, 1);

	assert_non_null(runs);
	for (uint32_t i = 0; i < mesh->triangles; i++)
		for (int corner = 0; corner < 3; corner++) {
			uint32_t from = mesh->triangle[i][corner];
			uint32_t to = mesh->triangle[i][(corner + 1) % 3];

			runs[(size_t)from * mesh->vertices + to]++;
		}
	for (uint32_t from = 0; from < mesh->vertices; from++)
		for (uint32_t to = 0; to < mesh->vertices; to++) {
			uint8_t there = runs[(size_t)from * mesh->vertices + to];

			assert_true(there <= 1);
			assert_int_equal(there, runs[(size_t)to * mesh->vertices + from]);
		}
	free(runs);
}

#endif
