// SPDX-License-Identifier: MIT
#include <errno.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "mesh.h"

static double dot(const float a[3], const float b[3])
{
	return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

/* Of a triangle, with the length of twice its area. */
static void face_normal(const struct mesh *mesh, uint32_t number, float normal[3])
{
	const float *p = mesh->position[mesh->triangle[number][0]];
	const float *q = mesh->position[mesh->triangle[number][1]];
	const float *r = mesh->position[mesh->triangle[number][2]];

	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;

		normal[i] = (q[j] - p[j]) * (r[k] - p[k]) - (q[k] - p[k]) * (r[j] - p[j]);
	}
}

static void assert_normals_fit(const struct mesh *mesh, double least)
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
static void assert_closed(const struct mesh *mesh)
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
		{ "sphere:8", -EINVAL }, { "sphere:", -EINVAL }, { "sphere:1x", -EINVAL },
		{ "sphere:-1", -EINVAL }, { "torus:2", -EINVAL }, { "torus:513", -EINVAL },
		{ "plane:0", -EINVAL }, { "cube:1", -EINVAL }, { "spher", -ENOENT },
		{ "spheres", -ENOENT }, { "", -ENOENT }, { "./sphere", -ENOENT },
		{ "torus:99999999999999999999", -EINVAL },
	};
	struct mesh mesh;

	(void)state;
	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++)
		assert_int_equal(mesh_shape(names[i].name, &mesh), names[i].error);
}

/* A cube whose faces are cut this way and that: it must not show at its corners. */
static void smooth_normals_do_not_depend_on_the_cut(void **state)
{
	struct mesh mesh;

	(void)state;
	assert_int_equal(mesh_cube(&mesh), 0);
	/* The first face along its other diagonal. */
	memcpy(mesh.triangle, (uint32_t[2][3]){ { 0, 1, 2 }, { 1, 3, 2 } }, sizeof(uint32_t[2][3]));
	memset(mesh.normal, 0, mesh.vertices * sizeof(*mesh.normal));
	assert_int_equal(mesh_smooth(&mesh, 0, 0), 0);
	for (uint32_t i = 0; i < mesh.vertices; i++)
		for (int axis = 0; axis < 3; axis++)
			assert_true(fabsf(mesh.normal[i][axis] -
					  copysignf(0.57735f, mesh.position[i][axis])) < 1e-4f);
	mesh_free(&mesh);
}

static void smooth_normals_leave_others_alone(void **state)
{
	struct mesh mesh, before;

	(void)state;
	assert_int_equal(mesh_torus(5, &mesh), 0);
	assert_int_equal(mesh_torus(5, &before), 0);
	memset(mesh.normal[7], 0, sizeof(*mesh.normal));
	assert_int_equal(mesh_smooth(&mesh, 0, 0), 0);
	assert_true(dot(mesh.normal[7], before.normal[7]) > 0.95);
	memcpy(mesh.normal[7], before.normal[7], sizeof(*mesh.normal));
	assert_memory_equal(mesh.normal, before.normal, mesh.vertices * sizeof(*mesh.normal));
	mesh_free(&mesh);
	mesh_free(&before);
}

static void smooth_normals_are_numbers_whatever_the_triangles(void **state)
{
	struct mesh mesh;

	(void)state;
	/* One degenerate triangle, two that face each other, and a vertex without any. */
	assert_int_equal(mesh_new(5, 3, &mesh), 0);
	mesh.position[1][0] = mesh.position[2][1] = 1;
	memcpy(mesh.triangle, (uint32_t[3][3]){ { 0, 0, 1 }, { 0, 1, 2 }, { 0, 2, 1 } },
	       sizeof(uint32_t[3][3]));
	assert_int_equal(mesh_smooth(&mesh, 0, 0), 0);
	for (uint32_t i = 0; i < mesh.vertices; i++)
		assert_true(fabs(dot(mesh.normal[i], mesh.normal[i]) - 1) < 1e-6);
	mesh_free(&mesh);
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

static void write_file(const char *path, const char *text)
{
	FILE *file = fopen(path, "w");

	assert_non_null(file);
	fputs(text, file);
	fclose(file);
}

/* Meshes and quads become triangles of one mesh, indices and all; lines and points go. */
static void parts_of_a_file_become_one_mesh(void **state)
{
	char path[] = "/tmp/test-mesh-XXXXXX.obj", message[MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
	assert_true(mkstemps(path, 4) >= 0);
	write_file(path, "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n"
			 "o b\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 4 5 6 7\n");
	assert_int_equal(mesh_load(path, false, &mesh, message), 0);
	unlink(path);
	assert_int_equal(mesh.triangles, 3);
	assert_int_equal(mesh.vertices, 7);
	assert_normals_fit(&mesh, 0.9999);
	mesh_free(&mesh);
}

static void normals_of_a_file_are_kept_unless_smooth_is_asked_for(void **state)
{
	char path[] = "/tmp/test-mesh-XXXXXX.obj", message[MESH_MESSAGE];
	static const float tilted[3] = { 0.6f, 0, 0.8f }, upright[3] = { 0, 0, 1 };
	struct mesh mesh;

	(void)state;
	assert_true(mkstemps(path, 4) >= 0);
	write_file(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.6 0 0.8\nf 1//1 2//1 3//1\n");
	assert_int_equal(mesh_load(path, false, &mesh, message), 0);
	assert_memory_equal(mesh.normal[0], tilted, sizeof(tilted));
	mesh_free(&mesh);
	assert_int_equal(mesh_load(path, true, &mesh, message), 0);
	assert_memory_equal(mesh.normal[0], upright, sizeof(upright));
	mesh_free(&mesh);
	unlink(path);
}

static void a_message_is_one_line_of_three_parts(void **state)
{
	char message[MESH_MESSAGE], name[2 * MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
	assert_int_equal(mesh_load("/nowhere/m.obj", false, &mesh, message), -ENOENT);
	assert_string_equal(message,
			    "can not open mesh: /nowhere/m.obj: No such file or directory");
	memset(name, 'n', sizeof(name));
	name[sizeof(name) - 1] = '\0';
	assert_int_equal(mesh_load(name, false, &mesh, message), -ENAMETOOLONG);
	assert_true(strlen(message) < MESH_MESSAGE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sphere_is_closed_and_faces_outwards),
		cmocka_unit_test(torus_is_closed_and_faces_outwards),
		cmocka_unit_test(flat_shapes_have_the_normals_of_their_faces),
		cmocka_unit_test(shapes_fill_the_unit_sphere),
		cmocka_unit_test(shape_names_are_taken_exactly),
		cmocka_unit_test(smooth_normals_do_not_depend_on_the_cut),
		cmocka_unit_test(smooth_normals_leave_others_alone),
		cmocka_unit_test(smooth_normals_are_numbers_whatever_the_triangles),
		cmocka_unit_test(bounds_of_large_numbers_are_numbers),
		cmocka_unit_test(parts_of_a_file_become_one_mesh),
		cmocka_unit_test(normals_of_a_file_are_kept_unless_smooth_is_asked_for),
		cmocka_unit_test(a_message_is_one_line_of_three_parts),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
