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

#include "mesh_fit.h"

static const struct mesh_options creased = { .crease = MESH_CREASE };
static const struct mesh_options smooth = { .normals = MESH_NORMALS_SMOOTH };

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
	assert_int_equal(mesh_load(path, &creased, &mesh, message), 0);
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
	assert_int_equal(mesh_load(path, &creased, &mesh, message), 0);
	assert_memory_equal(mesh.normal[0], tilted, sizeof(tilted));
	mesh_free(&mesh);
	assert_int_equal(mesh_load(path, &smooth, &mesh, message), 0);
	assert_memory_equal(mesh.normal[0], upright, sizeof(upright));
	mesh_free(&mesh);
	unlink(path);
}

static void load_text(const char *ending, const char *text, struct mesh *mesh)
{
	char path[64] = "/tmp/test-mesh-XXXXXX", message[MESH_MESSAGE];

	strcat(path, ending);
	assert_true(mkstemps(path, (int)strlen(ending)) >= 0);
	write_file(path, text);
	if (mesh_load(path, &creased, mesh, message))
		fail_msg("%s", message);
	unlink(path);
}

static void normals_against_the_winding_are_made_anew(void **state)
{
	struct mesh mesh;

	(void)state;
	load_text(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0.6 -0.8\nf 1//1 2//1 3//1\n", &mesh);
	assert_normals_fit(&mesh, 0.9999);
	mesh_free(&mesh);
}

/* Each mesh for itself: the other one keeps its normals. */
static void good_normals_are_kept_beside_bad_ones(void **state)
{
	struct mesh mesh;

	(void)state;
	load_text(".obj",
		  "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0.6 -0.8\nf 1//1 2//1 3//1\n"
		  "o b\nv 0 0 1\nv 1 0 1\nv 0 1 1\nvn 0 0.6 0.8\nf 4//2 5//2 6//2\n",
		  &mesh);
	assert_int_equal(mesh.vertices, 6);
	for (uint32_t i = 0; i < 6; i++) {
		float wanted = mesh.position[i][2] > 0 ? 0.6f : 0;

		assert_true(fabsf(mesh.normal[i][1] - wanted) < 1e-6f);
	}
	mesh_free(&mesh);
}

static void normals_of_stl_are_never_believed(void **state)
{
	struct mesh mesh;

	(void)state;
	load_text(".stl",
		  "solid s\nfacet normal 0.6 0 0.8\nouter loop\nvertex 0 0 0\n"
		  "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n",
		  &mesh);
	assert_normals_fit(&mesh, 0.9999);
	mesh_free(&mesh);
}

/* A scene's node that mirrors its mesh: what was outside stays outside. */
static void a_mirrored_node_keeps_its_outside(void **state)
{
	struct mesh mesh;

	(void)state;
	/* Three positions as floats: (0,0,0), (1,0,0), (0,1,0). */
	load_text(".gltf",
		  "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
		  "\"nodes\":[{\"mesh\":0,\"scale\":[-2,1,1]}],"
		  "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
		  "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
		  "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"
		  "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
		  "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
		  "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}]}",
		  &mesh);
	assert_normals_fit(&mesh, 0.9999);
	for (uint32_t i = 0; i < mesh.vertices; i++)
		assert_true(mesh.normal[i][2] > 0.9999f && mesh.position[i][0] <= 0);
	mesh_free(&mesh);
}

/* Linear light in the file, what a picture has in the mesh. */
static void base_colours_of_gltf_are_those_of_the_mesh(void **state)
{
	struct mesh mesh;

	(void)state;
	load_text(".gltf",
		  "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
		  "\"nodes\":[{\"mesh\":0}],\"materials\":[{\"pbrMetallicRoughness\":"
		  "{\"baseColorFactor\":[0.5,0,1,1]}}],"
		  "\"meshes\":[{\"primitives\":["
		  "{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
		  "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
		  "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"
		  "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
		  "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
		  "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}]}",
		  &mesh);
	assert_non_null(mesh.colour);
	for (uint32_t i = 0; i < mesh.vertices; i++) {
		assert_true(fabsf(mesh.colour[i][0] - 0.7354f) < 1e-3f);
		assert_true(mesh.colour[i][1] == 0 && mesh.colour[i][2] > 0.9999f);
	}
	mesh_free(&mesh);
}

static void a_mesh_without_colours_has_none(void **state)
{
	struct mesh mesh;

	(void)state;
	load_text(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &mesh);
	assert_null(mesh.colour);
	mesh_free(&mesh);
}

static void a_message_is_one_line_of_three_parts(void **state)
{
	char message[MESH_MESSAGE], name[2 * MESH_MESSAGE];
	struct mesh mesh;

	(void)state;
	assert_int_equal(mesh_load("/nowhere/m.obj", &creased, &mesh, message), -ENOENT);
	assert_string_equal(message,
			    "can not open mesh: /nowhere/m.obj: No such file or directory");
	memset(name, 'n', sizeof(name));
	name[sizeof(name) - 1] = '\0';
	assert_int_equal(mesh_load(name, &creased, &mesh, message), -ENAMETOOLONG);
	assert_true(strlen(message) < MESH_MESSAGE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(parts_of_a_file_become_one_mesh),
		cmocka_unit_test(normals_of_a_file_are_kept_unless_smooth_is_asked_for),
		cmocka_unit_test(normals_against_the_winding_are_made_anew),
		cmocka_unit_test(good_normals_are_kept_beside_bad_ones),
		cmocka_unit_test(normals_of_stl_are_never_believed),
		cmocka_unit_test(a_mirrored_node_keeps_its_outside),
		cmocka_unit_test(base_colours_of_gltf_are_those_of_the_mesh),
		cmocka_unit_test(a_mesh_without_colours_has_none),
		cmocka_unit_test(a_message_is_one_line_of_three_parts),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
