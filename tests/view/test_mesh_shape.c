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

static void sphere_is_closed_and_faces_outwards(void **state)
{
	(void)state;
	for (int level = 0; level <= 4; level++) {
		struct mesh mesh;

		assert_int_equal(mesh_sphere(level, &mesh), 0);
		assert_int_equal(mesh.triangles, 20 << 2 * level);
		assert_int_equal(mesh.vertices, mesh.triangles / 2 + 2);
		assert_closed(&mesh);
		assert_normals_fit(&mesh, 0.75);
		for (uint32_t i = 0; i < mesh.vertices; i++) {
			assert_true(fabs(dot(mesh.position[i], mesh.position[i]) - 1) < 1e-6);
			assert_memory_equal(mesh.position[i], mesh.normal[i], sizeof(float[3]));
		}
		mesh_free(&mesh);
	}
}

static void torus_is_closed_and_faces_outwards(void **state)
{
	struct mesh mesh;

	(void)state;
	assert_int_equal(mesh_torus(12, &mesh), 0);
	assert_int_equal(mesh.triangles, 24 * 12 * 2);
	assert_closed(&mesh);
	assert_normals_fit(&mesh, 0.9);
	mesh_free(&mesh);
}

static void flat_shapes_have_the_normals_of_their_faces(void **state)
{
	struct mesh mesh;

	(void)state;
	assert_int_equal(mesh_cube(&mesh), 0);
	assert_int_equal(mesh.triangles, 12);
	assert_normals_fit(&mesh, 0.9999);
	mesh_free(&mesh);
	assert_int_equal(mesh_plane(5, &mesh), 0);
	assert_int_equal(mesh.triangles, 50);
	assert_normals_fit(&mesh, 0.9999);
	mesh_free(&mesh);
}

static void shapes_fill_the_unit_sphere(void **state)
{
	static const char *const names[] = {
		"sphere", "sphere:0", "torus:8", "cube", "plane", "plane:7",
	};

	(void)state;
	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++) {
		float centre[3], radius;
		struct mesh mesh;

		assert_int_equal(mesh_shape(names[i], &mesh), 0);
		mesh_bounds(&mesh, centre, &radius);
		assert_true(dot(centre, centre) < 1e-9);
		assert_true(radius > 0.9f && radius < 1.0001f);
		mesh_free(&mesh);
	}
}

static void shape_names_are_taken_exactly(void **state)
{
	static const struct {
		const char *name;
		int error;
	} names[] = {
		{ "sphere:8", -EINVAL },
		{ "sphere:", -EINVAL },
		{ "sphere:1x", -EINVAL },
		{ "sphere:-1", -EINVAL },
		{ "torus:2", -EINVAL },
		{ "torus:513", -EINVAL },
		{ "plane:0", -EINVAL },
		{ "cube:1", -EINVAL },
		{ "spher", -ENOENT },
		{ "spheres", -ENOENT },
		{ "", -ENOENT },
		{ "./sphere", -ENOENT },
		{ "torus:99999999999999999999", -EINVAL },
	};
	struct mesh mesh;

	(void)state;
	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++)
		assert_int_equal(mesh_shape(names[i].name, &mesh), names[i].error);
}

static void bounds_of_large_numbers_are_numbers(void **state)
{
	float centre[3], radius;
	struct mesh mesh;

	(void)state;
	assert_int_equal(mesh_new(2, 0, &mesh), 0);
	mesh.position[0][0] = 3e38f;
	mesh.position[1][0] = -3e38f;
	mesh_bounds(&mesh, centre, &radius);
	assert_true(centre[0] == 0 && radius == 3e38f);
	mesh_free(&mesh);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sphere_is_closed_and_faces_outwards),
		cmocka_unit_test(torus_is_closed_and_faces_outwards),
		cmocka_unit_test(flat_shapes_have_the_normals_of_their_faces),
		cmocka_unit_test(shapes_fill_the_unit_sphere),
		cmocka_unit_test(shape_names_are_taken_exactly),
		cmocka_unit_test(bounds_of_large_numbers_are_numbers),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
