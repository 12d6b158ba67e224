// SPDX-License-Identifier: MIT
/* Meshes from files, through assimp's C interface. */
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "scene/mesh_import.h"
#include "scene/mesh_part.h"

#define FORMATS "give an OBJ, PLY, 3DS, glTF or STL file"
#define REASON 200 /* as much of assimp's as fits a message */

/* A scene on its way into arrays. */
struct import {
	const struct aiScene *scene;
	bool normals, linear; /* of struct part */
	struct part_total total;
	struct mesh *raw;
	struct weld weld;
	uint32_t *number; /* in raw, of the vertices of a part */
};

/* Once to count and once to append. */
typedef int (*visit_fn)(struct import *import, const struct part *part);

/* NULL for the one that assimp makes up where a file has none. */
static const struct aiMaterial *material_of(const struct aiScene *scene, const struct aiMesh *mesh)
{
	const struct aiMaterial *material;
	struct aiString name;

	if (mesh->mMaterialIndex >= scene->mNumMaterials)
		return NULL;
	material = scene->mMaterials[mesh->mMaterialIndex];
	if (aiGetMaterialString(material, AI_MATKEY_NAME, &name) == aiReturn_SUCCESS &&
	    !strcmp(name.data, AI_DEFAULT_MATERIAL_NAME))
		return NULL;
	return material;
}

static int visit_nodes(struct import *import, const struct aiNode *node,
		       const struct aiMatrix4x4 *parent, visit_fn visit)
{
	const struct aiScene *scene = import->scene;
	struct aiMatrix4x4 place = *parent;
	int ret = 0;

	aiMultiplyMatrix4(&place, &node->mTransformation);
	for (unsigned int i = 0; i < node->mNumMeshes && !ret; i++) {
		struct part part = {
			.place = place,
			.normals = import->normals,
			.linear = import->linear,
		};

		if (node->mMeshes[i] >= scene->mNumMeshes)
			return -EINVAL;
		part.mesh = scene->mMeshes[node->mMeshes[i]];
		part.material = material_of(scene, part.mesh);
		ret = visit(import, &part);
	}
	for (unsigned int i = 0; i < node->mNumChildren && !ret; i++)
		ret = visit_nodes(import, node->mChildren[i], &place, visit);
	return ret;
}

static int visit_all(struct import *import, visit_fn visit)
{
	struct aiMatrix4x4 identity;

	aiIdentityMatrix4(&identity);
	return visit_nodes(import, import->scene->mRootNode, &identity, visit);
}

static int count(struct import *import, const struct part *part)
{
	part_count(part, &import->total);
	return import->total.finite ? 0 : -EDOM;
}

static int append(struct import *import, const struct part *part)
{
	return part_append(part, &import->weld, import->number);
}

static int allocate(const struct part_total *total, struct mesh *raw)
{
	raw->triangle = malloc(total->triangles * sizeof(*raw->triangle));
	raw->position = malloc(total->vertices * sizeof(*raw->position));
	if (total->normals)
		raw->normal = malloc(total->vertices * sizeof(*raw->normal));
	if (total->colours)
		raw->colour = malloc(total->vertices * sizeof(*raw->colour));
	if (raw->position && raw->triangle && (raw->normal || !total->normals) &&
	    (raw->colour || !total->colours))
		return 0;
	return -ENOMEM;
}

/* What is used whole comes first: it takes what the file's text has left. */
static int append_all(struct import *import)
{
	int ret = weld_begin(&import->weld, import->raw, import->total.vertices);

	import->number = malloc(import->total.most * sizeof(*import->number));
	if (!import->number)
		ret = -ENOMEM;
	if (!ret)
		ret = allocate(&import->total, import->raw);
	if (!ret)
		ret = visit_all(import, append);
	weld_end(&import->weld);
	free(import->number);
	return ret;
}

/* A scene in arrays, with what vertices the file has, each once. */
static int convert(struct import *import)
{
	const struct part_total *total = &import->total;
	int ret = import->scene->mRootNode ? visit_all(import, count) : -ENODATA;

	if (ret)
		return ret;
	if (!total->triangles)
		return -ENODATA;
	if (total->vertices >= UINT32_MAX || total->triangles > UINT32_MAX / 3)
		return -E2BIG;
	return append_all(import);
}

/* The extension's letters are @kind. */
static bool is_kind(const char *path, const char *kind)
{
	const char *dot = strrchr(path, '.');

	return dot && !strcasecmp(dot + 1, kind);
}

/* assimp's reason as part of a line. */
static void tidy(char out[REASON], const char *reason)
{
	size_t length = 0;

	for (; *reason && length < REASON - 1; reason++)
		if (!isspace((unsigned char)*reason) || (length && out[length - 1] != ' '))
			out[length++] = isprint((unsigned char)*reason) ? *reason : ' ';
	while (length && strchr(" .", out[length - 1]))
		length--;
	out[length] = '\0';
}

static int refuse(char message[MESH_MESSAGE], int error, const char *what, const char *where,
		  const char *hint)
{
	snprintf(message, MESH_MESSAGE, "%s: %s: %s", what, where, hint);
	return error;
}

static int out_of_memory(const char *path, char message[MESH_MESSAGE])
{
	return refuse(message, -ENOMEM, "out of memory", path,
		      "give a smaller mesh; if it is small, the file is damaged");
}

/* The C++ library's names for more memory than there is. */
static bool wants_memory(const char *reason)
{
	static const char *const names[] = {
		"bad_alloc", "bad allocation", "bad_array_new_length", "max_size()",
		"vector::",  "basic_string::", "ut of memory",
	};

	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++)
		if (strstr(reason, names[i]))
			return true;
	return false;
}

static int not_read(const char *path, char message[MESH_MESSAGE])
{
	char reason[REASON], hint[REASON + sizeof("; repair or convert the file")];

	tidy(reason, aiGetErrorString());
	if (wants_memory(reason))
		return out_of_memory(path, message);
	if (!*reason || strstr(reason, "suitable reader"))
		return refuse(message, -EINVAL, "not a mesh", path, FORMATS);
	snprintf(hint, sizeof(hint), "%s; repair or convert the file", reason);
	return refuse(message, -EINVAL, "not a mesh", path, hint);
}

static int not_converted(int error, const char *path, char message[MESH_MESSAGE])
{
	switch (error) {
	case -ENOMEM:
		return out_of_memory(path, message);
	case -ENODATA:
		return refuse(message, error, "no triangles", path, "give a mesh with faces");
	case -E2BIG:
		return refuse(message, error, "mesh too large", path, "give fewer triangles");
	case -EDOM:
		return refuse(message, error, "coordinates that are not numbers", path,
			      "repair the file, it has NaN or infinity");
	default:
		return refuse(message, error, "not a mesh", path,
			      "it has indices out of range; " FORMATS);
	}
}

/*
 * Only faces are cut into triangles. aiProcess_JoinIdenticalVertices joins what is 1e-5 apart,
 * whatever the mesh's size, and takes five times as long as the rest;
 * aiProcess_GenSmoothNormals is wrong in 5.2.5 where faces share vertices, as in PLY and glTF.
 */
static int read_file(const char *path, const struct mesh_options *options, struct mesh *raw,
		     char message[MESH_MESSAGE])
{
	struct import import = {
		.normals = options->normals == MESH_NORMALS_CREASED && !is_kind(path, "stl"),
		.linear = is_kind(path, "gltf") || is_kind(path, "glb"),
		.total.finite = true,
		.raw = raw,
	};
	int ret;

	import.scene = aiImportFile(path, aiProcess_Triangulate);
	if (!import.scene)
		return not_read(path, message);
	ret = convert(&import);
	aiReleaseImport(import.scene);
	return ret ? not_converted(ret, path, message) : 0;
}

int mesh_import(const char *path, const struct mesh_options *options, struct mesh *mesh,
		char message[MESH_MESSAGE])
{
	struct mesh raw = { 0 };
	int ret = read_file(path, options, &raw, message);

	if (!ret && mesh_build(&raw, options->normals, options->crease, mesh))
		ret = out_of_memory(path, message);
	mesh_free(&raw);
	return ret;
}
