/* SPDX-License-Identifier: MIT */
/* Meshes and states that the tests of drawing share. */
#ifndef DRAW_MESH_H
#define DRAW_MESH_H

#include <math.h>

#include "accel_priv.h"
#include "accel_test.h"

#define SHAPE_VERTICES 4096
#define SHAPE_INDICES 24576

/* A mesh and its arrays. */
struct shape {
	float position[SHAPE_VERTICES][3], normal[SHAPE_VERTICES][3];
	uint32_t index[SHAPE_INDICES];
	struct accel_mesh mesh;
};

static inline void shape_begin(struct shape *shape)
{
	shape->mesh = (struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						    .position = { .data = shape->position },
						    .normal = { .data = shape->normal },
						    .index = shape->index);
}

static inline uint32_t shape_vertex(struct shape *shape, const double position[3],
				    const double normal[3])
{
	uint32_t i = shape->mesh.vertices++;

	assert_true(i < SHAPE_VERTICES);
	for (int j = 0; j < 3; j++) {
		shape->position[i][j] = (float)position[j];
		shape->normal[i][j] = (float)normal[j];
	}
	return i;
}

static inline void shape_triangle(struct shape *shape, uint32_t a, uint32_t b, uint32_t c)
{
	uint32_t *index = &shape->index[shape->mesh.indices];

	shape->mesh.indices += 3;
	assert_true(shape->mesh.indices <= SHAPE_INDICES);
	index[0] = a;
	index[1] = b;
	index[2] = c;
}

/* A sphere of radius 1: the faces of an octahedron, each in @n times @n triangles. */
static inline void shape_sphere(struct shape *shape, int n)
{
	shape_begin(shape);
	for (int face = 0; face < 8; face++) {
		uint32_t first = shape->mesh.vertices, row = first;
		bool turned = (face ^ face >> 1 ^ face >> 2) & 1;

		for (int j = 0; j <= n; j++)
			for (int i = 0; i <= n - j; i++) {
				double p[3] = { i, j, n - i - j };
				double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);

				for (int k = 0; k < 3; k++)
					p[k] *= (face >> k & 1 ? -1 : 1) / length;
				shape_vertex(shape, p, p);
			}
		for (int j = 0; j < n; j++, row += (uint32_t)(n - j + 2))
			for (int i = 0; i < n - j; i++) {
				uint32_t a = row + (uint32_t)i, up = a + (uint32_t)(n - j + 1);

				shape_triangle(shape, turned ? a + 1 : a, turned ? a : a + 1, up);
				if (i + 1 < n - j)
					shape_triangle(shape, turned ? up : a + 1, up + 1,
						       turned ? a + 1 : up);
			}
	}
}

/* A torus of 2 @n times @n quads around z. */
static inline void shape_torus(struct shape *shape, int n)
{
	const double turn = 2 * 3.14159265358979;

	shape_begin(shape);
	for (int i = 0; i < 2 * n; i++)
		for (int j = 0; j < n; j++) {
			double u = turn * i / (2 * n), v = turn * j / n, r = 0.65 + 0.33 * cos(v);

			shape_vertex(shape,
				     (const double[3]){ r * cos(u), r * sin(u), 0.33 * sin(v) },
				     (const double[3]){ cos(v) * cos(u), cos(v) * sin(u), sin(v) });
		}
	for (int i = 0; i < 2 * n; i++)
		for (int j = 0; j < n; j++) {
			uint32_t next = (uint32_t)((i + 1) % (2 * n) * n), here = (uint32_t)(i * n);
			uint32_t j0 = (uint32_t)j, j1 = (uint32_t)((j + 1) % n);

			shape_triangle(shape, here + j0, next + j0, next + j1);
			shape_triangle(shape, here + j0, next + j1, here + j1);
		}
}

/* A closed drum of @n sides, whose rims are creases: cap and wall have normals of their own. */
static inline void shape_drum(struct shape *shape, int n)
{
	const double turn = 2 * 3.14159265358979;
	uint32_t wall, cap[2];

	shape_begin(shape);
	for (int end = 0; end < 2; end++) {
		double z = end ? 0.7 : -0.7;
		const double along[3] = { 0, 0, end ? 1 : -1 };

		cap[end] = shape_vertex(shape, (const double[3]){ 0, 0, z }, along);
		for (int i = 0; i < n; i++)
			shape_vertex(shape,
				     (const double[3]){ 0.7 * cos(turn * i / n),
							0.7 * sin(turn * i / n), z },
				     along);
	}
	wall = shape->mesh.vertices;
	for (int i = 0; i < 2 * n; i++)
		shape_vertex(shape,
			     (const double[3]){ 0.7 * cos(turn * (i / 2) / n),
						0.7 * sin(turn * (i / 2) / n), i % 2 ? 0.7 : -0.7 },
			     (const double[3]){ cos(turn * (i / 2) / n), sin(turn * (i / 2) / n),
						0 });
	for (uint32_t i = 0; i < (uint32_t)n; i++) {
		uint32_t next = (i + 1) % (uint32_t)n, a = wall + 2 * i, b = wall + 2 * next;

		shape_triangle(shape, cap[0], cap[0] + 1 + next, cap[0] + 1 + i);
		shape_triangle(shape, cap[1], cap[1] + 1 + i, cap[1] + 1 + next);
		shape_triangle(shape, a, b, b + 1);
		shape_triangle(shape, a, b + 1, a + 1);
	}
}

/* Perspective of 40 degrees across, from @distance away, turned a little. */
static inline void state_look(struct accel_state *state, float distance)
{
	const float near = 0.1f, far = 20, f = 2.7474774f;
	const float projection[16] = { f,
				       0,
				       0,
				       0,
				       0,
				       f,
				       0,
				       0,
				       0,
				       0,
				       (far + near) / (near - far),
				       -1,
				       0,
				       0,
				       2 * far * near / (near - far),
				       0 };
	const float c1 = cosf(0.9f), s1 = sinf(0.9f), c2 = cosf(0.5f), s2 = sinf(0.5f);
	const float modelview[16] = { c2, s2 * s1,  -s2 * c1, 0, 0, c1, s1,        0,
				      s2, -c2 * s1, c2 * c1,  0, 0, 0,  -distance, 1 };

	accel_state_set_projection(state, projection);
	accel_state_set_modelview(state, modelview);
}

/* One light from the viewer's right, a white highlight of exponent @n, depth test. */
static inline struct accel_state *state_shiny(float n)
{
	struct accel_material material = ACCEL_MATERIAL(.ambient = { 0.1f, 0.1f, 0.2f, 1 },
							.diffuse = { 0.6f, 0.5f, 0.2f, 1 },
							.specular = { 0.5f, 0.5f, 0.5f, 1 },
							.shininess = n);
	struct accel_light light = ACCEL_LIGHT(.enabled = true,
					       .position = { 0.3f, 0.4f, 0.866f, 0 },
					       .diffuse = { 1, 1, 1, 1 },
					       .specular = { 1, 1, 1, 1 },
					       .attenuation = { 1, 0, 0 },
					       .spot_direction = { 0, 0, -1 }, .spot_cutoff = 180);
	struct accel_state *state;

	assert_int_equal(accel_state_new(&state), 0);
	accel_state_set_lighting(state, true);
	assert_int_equal(accel_state_set_material(state, &material, &material), 0);
	assert_int_equal(accel_state_set_light(state, 0, &light), 0);
	accel_state_set_depth(state, ACCEL_COMPARE_LESS, true);
	state_look(state, 3.2f);
	return state;
}

#endif
