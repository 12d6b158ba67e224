// SPDX-License-Identifier: MIT
/*
 * What the fast ways of making a mesh give, against plain ones that look at each pair: the same
 * to the bit, for meshes full of what is rare.
 */
#include "../unit/accel_test.h"

#include <math.h>

#include "scene/mesh.h"
#include "scene/mesh_face.h"
#include "scene/mesh_weld.h"

#define MESHES 400
#define CORNERS 600
/* As in mesh_build.c: what a corner is compared with, and a triangle over an edge. */
#define COMPARED 32
#define SHARING 8

/* ---- the plain way ---- */

struct plain {
	const struct mesh *raw;
	enum mesh_normals normals;
	float crease;
	uint32_t corner[CORNERS], group[CORNERS], corners; /* of a place */
	struct mesh mesh;
};

static const float *position_of(const struct plain *plain, uint32_t corner, uint32_t step)
{
	return plain->raw->position[plain->raw->triangle[corner / 3][(corner % 3 + step) % 3]];
}

static bool is_equal(const float *a, const float *b, int count)
{
	for (int i = 0; i < count; i++)
		if (a[i] != b[i])
			return false;
	return true;
}

static void make_unit(float out[3], const double v[3])
{
	double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

	for (int i = 0; i < 3; i++)
		out[i] = length > 0 && isfinite(length) ? (float)(v[i] / length) : 0;
}

/* The triangle's normal, not of unit length, and the angle, as seen from a corner. */
static float look(const struct plain *plain, uint32_t corner, double normal[3])
{
	const float *at = position_of(plain, corner, 0);
	double u[3], v[3], cosine = 0;

	for (int i = 0; i < 3; i++) {
		u[i] = (double)position_of(plain, corner, 1)[i] - (double)at[i];
		v[i] = (double)position_of(plain, corner, 2)[i] - (double)at[i];
		cosine += u[i] * v[i];
	}
	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;

		normal[i] = u[j] * v[k] - u[k] * v[j];
	}
	return (float)atan2(sqrt(normal[0] * normal[0] + normal[1] * normal[1] +
				 normal[2] * normal[2]),
			    cosine);
}

static void face_of(const struct plain *plain, uint32_t corner, float normal[3])
{
	double n[3];

	look(plain, corner - corner % 3, n);
	make_unit(normal, n);
}

static bool is_zero(const float v[3])
{
	return !v[0] && !v[1] && !v[2];
}

static bool share_an_edge(const struct plain *plain, uint32_t a, uint32_t b, uint32_t step)
{
	const float *end = position_of(plain, a, step);

	return is_equal(end, position_of(plain, b, 1), 3) ||
	       is_equal(end, position_of(plain, b, 2), 3);
}

static void join_groups(struct plain *plain, uint32_t from, uint32_t to)
{
	for (uint32_t i = 0; i < plain->corners; i++)
		if (plain->group[i] == from)
			plain->group[i] = to;
}

static void join_neighbours(struct plain *plain, uint32_t i, uint32_t step)
{
	float own[3], other[3];
	int seen = 0;

	face_of(plain, plain->corner[i], own);
	for (uint32_t j = i; j-- && seen < SHARING && !is_zero(own);) {
		face_of(plain, plain->corner[j], other);
		if (is_zero(other) ||
		    !share_an_edge(plain, plain->corner[i], plain->corner[j], step))
			continue;
		seen++;
		if (own[0] * other[0] + own[1] * other[1] + own[2] * other[2] >= plain->crease)
			join_groups(plain, plain->group[i], plain->group[j]);
	}
}

static void find_groups(struct plain *plain)
{
	for (uint32_t i = 0; i < plain->corners; i++) {
		plain->group[i] = plain->normals == MESH_NORMALS_SMOOTH ? 0 : i;
		for (uint32_t step = 1; step < 3 && plain->normals == MESH_NORMALS_CREASED; step++)
			join_neighbours(plain, i, step);
	}
}

static void normal_of(const struct plain *plain, uint32_t i, float normal[3])
{
	uint32_t vertex = plain->raw->triangle[plain->corner[i] / 3][plain->corner[i] % 3];
	float sum[3] = { 0, 0, 0 }, face[3];
	double n[3];

	normal[0] = normal[1] = normal[2] = 0;
	if (plain->raw->normal && plain->normals == MESH_NORMALS_CREASED)
		make_unit(normal, (const double[3]){ plain->raw->normal[vertex][0],
						     plain->raw->normal[vertex][1],
						     plain->raw->normal[vertex][2] });
	if (!is_zero(normal))
		return;
	for (uint32_t j = 0; j < plain->corners; j++) {
		if (plain->group[j] != plain->group[i])
			continue;
		face_of(plain, plain->corner[j], face);
		for (int axis = 0; axis < 3; axis++)
			sum[axis] += look(plain, plain->corner[j], n) * face[axis];
	}
	if (plain->normals == MESH_NORMALS_FACETS)
		face_of(plain, plain->corner[i], normal);
	else
		make_unit(normal, (const double[3]){ sum[0], sum[1], sum[2] });
	if (is_zero(normal))
		normal[2] = 1;
}

static uint32_t vertex_like(struct plain *plain, uint32_t raw, const float normal[3],
			    uint32_t first)
{
	struct mesh *mesh = &plain->mesh;

	for (uint32_t i = mesh->vertices; i > first && mesh->vertices - i < COMPARED; i--)
		if (is_equal(mesh->normal[i - 1], normal, 3) &&
		    (!mesh->colour || is_equal(mesh->colour[i - 1], plain->raw->colour[raw], 4)))
			return i - 1;
	memcpy(mesh->position[mesh->vertices], plain->raw->position[raw], sizeof(float[3]));
	memcpy(mesh->normal[mesh->vertices], normal, sizeof(float[3]));
	if (mesh->colour)
		memcpy(mesh->colour[mesh->vertices], plain->raw->colour[raw], sizeof(float[4]));
	return mesh->vertices++;
}

static void build_place(struct plain *plain, uint32_t place)
{
	const struct mesh *raw = plain->raw;
	uint32_t first = plain->mesh.vertices;

	plain->corners = 0;
	for (uint32_t i = 0; i < raw->triangles * 3; i++)
		if (is_equal(position_of(plain, i, 0), raw->position[place], 3))
			plain->corner[plain->corners++] = i;
	find_groups(plain);
	for (uint32_t i = 0; i < plain->corners; i++) {
		uint32_t corner = plain->corner[i];
		float normal[3];

		normal_of(plain, i, normal);
		plain->mesh.triangle[corner / 3][corner % 3] = vertex_like(
			plain, raw->triangle[corner / 3][corner % 3], normal, first);
	}
}

static void build_plainly(struct plain *plain)
{
	const struct mesh *raw = plain->raw;

	assert_int_equal(mesh_new(raw->triangles * 3, raw->triangles, &plain->mesh), 0);
	plain->mesh.vertices = 0;
	if (raw->colour)
		plain->mesh.colour = calloc(raw->triangles * 3, sizeof(*raw->colour));
	for (uint32_t i = 0; i < raw->vertices; i++) {
		uint32_t j = 0;

		while (!is_equal(raw->position[j], raw->position[i], 3))
			j++;
		if (i == j)
			build_place(plain, i);
	}
}

/* ---- meshes full of what is rare ---- */

/* On few places, with zeros of both signs, and some far away; or anywhere. */
static float random_coordinate(uint64_t *seed, uint32_t places)
{
	int half = (int)places / 2;
	float value = (float)((int)test_below(seed, places) - half);

	if (places > 6)
		return (float)(test_random(seed) >> 40) * 0x1p-20f;
	if (!test_below(seed, 9))
		value *= 1e10f;
	return test_below(seed, 2) ? value : -value;
}

static void random_mesh(uint64_t *seed, struct mesh *raw)
{
	uint32_t vertices = 3 + test_below(seed, test_below(seed, 2) ? 60 : 8);
	uint32_t places = 1 + test_below(seed, 7);
	bool fan = test_below(seed, 2); /* all triangles meet at one place */

	assert_int_equal(mesh_new(vertices, 1 + test_below(seed, CORNERS / 3), raw), 0);
	if (test_below(seed, 2)) {
		free(raw->normal);
		raw->normal = NULL;
	}
	if (!test_below(seed, 3))
		raw->colour = calloc(vertices, sizeof(*raw->colour));
	for (uint32_t i = 0; i < vertices; i++) {
		bool given = test_below(seed, 4) > 0;

		for (int j = 0; j < 3; j++) {
			raw->position[i][j] = random_coordinate(seed, places);
			if (raw->normal && given)
				raw->normal[i][j] = (float)test_below(seed, 3) - 1;
			if (raw->colour)
				raw->colour[i][j] = (float)test_below(seed, 2);
		}
	}
	for (uint32_t i = 0; i < raw->triangles * 3; i++)
		raw->triangle[i / 3][i % 3] = i % 3 || !fan ? test_below(seed, vertices) : 0;
}

static void assert_same(const struct mesh *a, const struct mesh *b)
{
	assert_int_equal(a->vertices, b->vertices);
	assert_int_equal(a->triangles, b->triangles);
	assert_memory_equal(a->position, b->position, sizeof(float[3]) * a->vertices);
	assert_memory_equal(a->normal, b->normal, sizeof(float[3]) * a->vertices);
	assert_memory_equal(a->triangle, b->triangle, sizeof(uint32_t[3]) * a->triangles);
	assert_int_equal(!a->colour, !b->colour);
	if (a->colour)
		assert_memory_equal(a->colour, b->colour, sizeof(float[4]) * a->vertices);
}

static void meshes_are_built_as_plainly(void **state)
{
	static struct plain plain;
	uint64_t seed = test_seed();

	(void)state;
	for (int n = 0; n < MESHES; n++) {
		float crease = (float)test_below(&seed, 180);
		struct mesh raw, mesh;

		random_mesh(&seed, &raw);
		plain = (struct plain){
			.raw = &raw,
			.normals = (enum mesh_normals)test_below(&seed, 3),
			.crease = cosf(crease * (3.14159265f / 180)),
		};
		build_plainly(&plain);
		assert_int_equal(mesh_build(&raw, plain.normals, crease, &mesh), 0);
		assert_same(&mesh, &plain.mesh);
		mesh_free(&raw);
		mesh_free(&mesh);
		mesh_free(&plain.mesh);
	}
}

/* From slivers to right angles, whose cosine is zero, and to what has no area. */
static void angles_are_those_of_the_c_library(void **state)
{
	struct mesh raw;
	struct plain plain = { .raw = &raw };
	static struct face face[5000];
	uint64_t seed = test_seed();
	double normal[3];

	(void)state;
	assert_int_equal(mesh_new(15000, 5000, &raw), 0);
	for (uint32_t i = 0; i < 15000; i++) {
		raw.triangle[i / 3][i % 3] = i;
		for (int j = 0; j < 3; j++)
			raw.position[i][j] = ldexpf((float)test_below(&seed, i % 2 ? 4 : 1 << 24),
						    (int)test_below(&seed, 20) - 10);
	}
	faces_make(&raw, face);
	for (uint32_t i = 0; i < 15000; i++) {
		float angle = look(&plain, i, normal);

		if (face[i / 3].angle[i % 3] != angle && !is_zero(face[i / 3].normal))
			fail_msg("corner %u: %a, not %a", i, (double)face[i / 3].angle[i % 3],
				 (double)angle);
	}
	mesh_free(&raw);
}

static bool is_same(const void *a, const void *b, size_t size)
{
	return !memcmp(a, b, size);
}

/* Few different ones, so that they come again; then ever new ones, so that the table grows. */
static void vertices_are_welded_to_the_bit(void **state)
{
	enum { MANY = 6000 };
	static struct weld_vertex vertex[MANY];
	static uint32_t number[MANY];
	uint64_t seed = test_seed();
	struct weld weld;
	struct mesh mesh;

	(void)state;
	assert_int_equal(mesh_new(MANY, 0, &mesh), 0);
	mesh.vertices = 0;
	assert_int_equal(weld_begin(&weld, &mesh, 40), 0);
	for (uint32_t i = 0; i < MANY; i++) {
		for (int j = 0; j < 3; j++) {
			vertex[i].position[j] = random_coordinate(&seed, 5);
			vertex[i].normal[j] = (float)test_below(&seed, i < MANY / 2 ? 2 : 1 << 20);
		}
	}
	for (uint32_t i = 0; i < MANY; i += 24)
		assert_int_equal(weld_add(&weld, vertex + i, 24, number + i), 0);
	weld_end(&weld);
	for (uint32_t i = 0, vertices = 0; i < MANY; i++) {
		uint32_t j = 0;

		while (!is_same(&vertex[j], &vertex[i], sizeof(*vertex)))
			j++;
		assert_int_equal(number[i], i == j ? vertices++ : number[j]);
		assert_memory_equal(mesh.position[number[i]], vertex[i].position, sizeof(float[3]));
		assert_memory_equal(mesh.normal[number[i]], vertex[i].normal, sizeof(float[3]));
	}
	mesh_free(&mesh);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(meshes_are_built_as_plainly),
		cmocka_unit_test(angles_are_those_of_the_c_library),
		cmocka_unit_test(vertices_are_welded_to_the_bit),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
