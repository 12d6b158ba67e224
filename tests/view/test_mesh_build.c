// SPDX-License-Identifier: MIT
#include <errno.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mesh_fit.h"

static const struct mesh_options creased = { .crease = MESH_CREASE };
static const struct mesh_options smooth = { .normals = MESH_NORMALS_SMOOTH };

static void build(const struct mesh *raw, const struct mesh_options *options, struct mesh *mesh)
{
	assert_int_equal(mesh_build(raw, options->normals, options->crease, mesh), 0);
	assert_int_equal(mesh->triangles, raw->triangles);
}

/* A cube without normals; its first face is cut along its other diagonal. */
static struct mesh raw_cube(void)
{
	struct mesh mesh;

	assert_int_equal(mesh_cube(&mesh), 0);
	memcpy(mesh.triangle, (uint32_t[2][3]){ { 0, 1, 2 }, { 1, 3, 2 } }, sizeof(uint32_t[2][3]));
	memset(mesh.normal, 0, mesh.vertices * sizeof(*mesh.normal));
	return mesh;
}

/* Faces are cut this way and that: it must not show at the corners. */
static void smooth_normals_do_not_depend_on_the_cut(void **state)
{
	struct mesh raw = raw_cube(), mesh;

	(void)state;
	build(&raw, &smooth, &mesh);
	assert_int_equal(mesh.vertices, 8);
	for (uint32_t i = 0; i < mesh.vertices; i++)
		for (int axis = 0; axis < 3; axis++)
			assert_true(fabsf(mesh.normal[i][axis] -
					  copysignf(0.57735f, mesh.position[i][axis])) < 1e-4f);
	mesh_free(&raw);
	mesh_free(&mesh);
}

static void edges_sharper_than_the_crease_stay_sharp(void **state)
{
	static const struct mesh_options wide = { .crease = 91 };
	struct mesh raw = raw_cube(), mesh;

	(void)state;
	build(&raw, &creased, &mesh);
	assert_int_equal(mesh.vertices, 24);
	assert_normals_fit(&mesh, 0.9999);
	mesh_free(&mesh);
	build(&raw, &wide, &mesh);
	assert_int_equal(mesh.vertices, 8);
	mesh_free(&raw);
	mesh_free(&mesh);
}

/* The mantle is smooth, all around; the lid's rim is not. */
static void a_cylinder_is_round_and_its_rim_is_sharp(void **state)
{
	enum { SIDES = 24 };
	struct mesh raw, mesh;

	(void)state;
	assert_int_equal(mesh_new(SIDES * 2 + 1, SIDES * 3, &raw), 0);
	raw.position[SIDES * 2][2] = 1;
	for (uint32_t i = 0; i < SIDES * 2; i++) {
		raw.position[i][0] = (float)cos(M_PI * (i / 2) / (SIDES / 2));
		raw.position[i][1] = (float)sin(M_PI * (i / 2) / (SIDES / 2));
		raw.position[i][2] = (float)(i % 2);
	}
	for (uint32_t i = 0; i < SIDES; i++) {
		uint32_t low = i * 2, next = (i + 1) % SIDES * 2;
		uint32_t three[3][3] = { { low, next, next + 1 },
					 { low, next + 1, low + 1 },
					 { low + 1, next + 1, SIDES * 2 } };

		memcpy(raw.triangle[i * 3], three, sizeof(three));
	}
	build(&raw, &creased, &mesh);
	assert_int_equal(mesh.vertices, SIDES * 3 + 1);
	for (uint32_t i = 0; i < mesh.vertices; i++) {
		const float *p = mesh.position[i], *n = mesh.normal[i];
		bool lid = n[2] > 0.5f;

		assert_true(fabsf(n[0] - (lid ? 0 : p[0])) < 1e-5f);
		assert_true(fabsf(n[1] - (lid ? 0 : p[1])) < 1e-5f);
	}
	mesh_free(&raw);
	mesh_free(&mesh);
}

static void facets_have_their_own_normals(void **state)
{
	static const struct mesh_options facets = { .normals = MESH_NORMALS_FACETS };
	char message[MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
	assert_int_equal(mesh_load("sphere:1", &facets, &mesh, message), 0);
	assert_int_equal(mesh.vertices, 80 * 3);
	assert_normals_fit(&mesh, 0.99999);
	mesh_free(&mesh);
}

static void only_normals_without_length_are_made(void **state)
{
	struct mesh raw, mesh;
	uint32_t made = 0;

	(void)state;
	assert_int_equal(mesh_torus(5, &raw), 0);
	memset(raw.normal[7], 0, sizeof(*raw.normal));
	build(&raw, &(struct mesh_options){ .crease = 180 }, &mesh);
	assert_int_equal(mesh.vertices, raw.vertices);
	for (uint32_t i = 0; i < mesh.triangles * 3; i++) {
		const float *n = mesh.normal[mesh.triangle[i / 3][i % 3]];

		if (raw.triangle[i / 3][i % 3] != 7) {
			assert_true(dot(n, raw.normal[raw.triangle[i / 3][i % 3]]) > 0.999999);
			continue;
		}
		made++;
		assert_true(fabs(dot(n, n) - 1) < 1e-6);
	}
	assert_int_equal(made, 6);
	mesh_free(&raw);
	mesh_free(&mesh);
}

static void made_normals_are_numbers_whatever_the_triangles(void **state)
{
	static const struct mesh_options *const ways[] = { &creased, &smooth };
	struct mesh raw, mesh;

	(void)state;
	/* One degenerate triangle, two that face each other, and a vertex without any. */
	assert_int_equal(mesh_new(5, 3, &raw), 0);
	raw.position[1][0] = raw.position[2][1] = 1;
	memcpy(raw.triangle, (uint32_t[3][3]){ { 0, 0, 1 }, { 0, 1, 2 }, { 0, 2, 1 } },
	       sizeof(uint32_t[3][3]));
	for (int way = 0; way < 2; way++) {
		build(&raw, ways[way], &mesh);
		for (uint32_t i = 0; i < mesh.vertices; i++)
			assert_true(fabs(dot(mesh.normal[i], mesh.normal[i]) - 1) < 1e-6);
		mesh_free(&mesh);
	}
	mesh_free(&raw);
}

/* Each triangle with corners of its own, as in an STL file, at any size. */
static void equal_vertices_are_joined_and_near_ones_are_not(void **state)
{
	(void)state;
	for (int exponent = -100; exponent <= 100; exponent += 25) {
		struct mesh sphere, raw, mesh;

		assert_int_equal(mesh_sphere(2, &sphere), 0);
		assert_int_equal(mesh_new(sphere.triangles * 3, sphere.triangles, &raw), 0);
		for (uint32_t i = 0; i < raw.vertices; i++) {
			raw.triangle[i / 3][i % 3] = i;
			for (int axis = 0; axis < 3; axis++)
				raw.position[i][axis] = ldexpf(
					sphere.position[sphere.triangle[i / 3][i % 3]][axis],
					exponent);
		}
		build(&raw, &smooth, &mesh);
		assert_int_equal(mesh.vertices, sphere.vertices);
		assert_closed(&mesh);
		for (uint32_t i = 0; i < mesh.vertices * 3; i++)
			assert_true(fabsf(mesh.normal[i / 3][i % 3] -
					  ldexpf(mesh.position[i / 3][i % 3], -exponent)) < 0.01f);
		mesh_free(&sphere);
		mesh_free(&raw);
		mesh_free(&mesh);
	}
}

static void a_fan_of_very_many_triangles_is_built(void **state)
{
	enum { BLADES = 100000 };
	struct mesh raw, mesh;

	(void)state;
	assert_int_equal(mesh_new(BLADES + 2, BLADES, &raw), 0);
	for (uint32_t i = 0; i < BLADES; i++) {
		memcpy(raw.triangle[i], (uint32_t[3]){ 0, i + 1, i + 2 }, sizeof(uint32_t[3]));
		raw.position[i + 1][0] = (float)cos(i * 0.1);
		raw.position[i + 1][1] = (float)sin(i * 0.1);
		raw.position[i + 1][2] = (float)(i % 7);
	}
	build(&raw, &(struct mesh_options){ .normals = MESH_NORMALS_FACETS }, &mesh);
	mesh_free(&mesh);
	build(&raw, &creased, &mesh);
	mesh_free(&mesh);
	mesh_free(&raw);
}

static void rescaling_is_exact(void **state)
{
	float centre[3], radius;
	struct mesh mesh, before;

	(void)state;
	assert_int_equal(mesh_sphere(1, &mesh), 0);
	assert_int_equal(mesh_sphere(1, &before), 0);
	for (uint32_t i = 0; i < mesh.vertices * 3; i++)
		mesh.position[i / 3][i % 3] *= 0x1p-90f;
	mesh_bounds(&mesh, centre, &radius);
	mesh_rescale(&mesh, centre, &radius);
	assert_true(radius >= 0.5f && radius < 1);
	for (uint32_t i = 0; i < mesh.vertices * 3; i++)
		assert_true(mesh.position[i / 3][i % 3] == before.position[i / 3][i % 3] / 2 ||
			    mesh.position[i / 3][i % 3] == before.position[i / 3][i % 3]);
	mesh_free(&mesh);
	mesh_free(&before);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(smooth_normals_do_not_depend_on_the_cut),
		cmocka_unit_test(edges_sharper_than_the_crease_stay_sharp),
		cmocka_unit_test(a_cylinder_is_round_and_its_rim_is_sharp),
		cmocka_unit_test(facets_have_their_own_normals),
		cmocka_unit_test(only_normals_without_length_are_made),
		cmocka_unit_test(made_normals_are_numbers_whatever_the_triangles),
		cmocka_unit_test(equal_vertices_are_joined_and_near_ones_are_not),
		cmocka_unit_test(a_fan_of_very_many_triangles_is_built),
		cmocka_unit_test(rescaling_is_exact),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
