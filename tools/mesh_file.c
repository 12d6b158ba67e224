// SPDX-License-Identifier: MIT
/* Meshes from files, through assimp's C interface. */
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "mesh.h"

static int refuse(char message[MESH_MESSAGE], int error, const char *what, const char *where,
		  const char *hint)
{
	snprintf(message, MESH_MESSAGE, "%s: %s: %s", what, where, hint);
	return error;
}

/* assimp's words for why a file can not be read do not say that it is missing. */
static int check_file(const char *path, char message[MESH_MESSAGE])
{
	struct stat status;
	FILE *file = fopen(path, "rb");
	bool folder;

	if (!file) {
		int error = -errno;

		return refuse(message, error, "can not open mesh", path, strerror(-error));
	}
	folder = !fstat(fileno(file), &status) && S_ISDIR(status.st_mode);
	fclose(file);
	if (folder)
		return refuse(message, -EISDIR, "not a mesh", path, "it is a folder, give a file");
	return 0;
}

static bool finite_vectors(const struct aiVector3D *vector, unsigned int count)
{
	for (unsigned int i = 0; vector && i < count; i++)
		if (!isfinite(vector[i].x) || !isfinite(vector[i].y) || !isfinite(vector[i].z))
			return false;
	return true;
}

static int check_scene(const struct aiScene *scene, const char *path,
		       char message[MESH_MESSAGE])
{
	for (unsigned int i = 0; i < scene->mNumMeshes; i++) {
		const struct aiMesh *part = scene->mMeshes[i];

		if (!finite_vectors(part->mVertices, part->mNumVertices) ||
		    !finite_vectors(part->mNormals, part->mNumVertices))
			return refuse(message, -EINVAL, "coordinates that are not numbers", path,
				      "repair the file, it has NaN or infinity");
	}
	return 0;
}

/*
 * Steps that leave triangles with positions and normals in one coordinate system. Not with
 * aiProcess_GenSmoothNormals, wrong in 5.2.5 where faces share vertices, as in PLY and glTF.
 */
static const unsigned int steps = aiProcess_RemoveComponent | aiProcess_Triangulate |
				  aiProcess_SortByPType | aiProcess_PreTransformVertices |
				  aiProcess_JoinIdenticalVertices;

static const struct aiScene *import(const char *path, bool smooth, unsigned int flags)
{
	struct aiPropertyStore *store = aiCreatePropertyStore();
	unsigned int drop = aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
			    aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
			    aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
			    aiComponent_CAMERAS;
	const struct aiScene *scene;

	if (!store)
		return NULL;
	aiSetImportPropertyInteger(store, AI_CONFIG_PP_RVC_FLAGS,
				   (int)(smooth ? drop | aiComponent_NORMALS : drop));
	aiSetImportPropertyInteger(store, AI_CONFIG_PP_SBP_REMOVE,
				   aiPrimitiveType_POINT | aiPrimitiveType_LINE);
	scene = aiImportFileExWithProperties(path, flags, NULL, store);
	aiReleasePropertyStore(store);
	return scene;
}

static void count(const struct aiScene *scene, uint64_t *vertices, uint64_t *triangles)
{
	*vertices = *triangles = 0;
	for (unsigned int i = 0; i < scene->mNumMeshes; i++) {
		*vertices += scene->mMeshes[i]->mNumVertices;
		*triangles += scene->mMeshes[i]->mNumFaces;
	}
}

static void set(float out[3], const struct aiVector3D *vector)
{
	out[0] = vector->x;
	out[1] = vector->y;
	out[2] = vector->z;
}

static int append(struct mesh *mesh, const struct aiMesh *part)
{
	uint32_t vertex = mesh->vertices, triangle = mesh->triangles;

	for (unsigned int i = 0; i < part->mNumFaces; i++) {
		for (int corner = 0; corner < 3; corner++)
			mesh->triangle[mesh->triangles][corner] =
				mesh->vertices + part->mFaces[i].mIndices[corner];
		mesh->triangles++;
	}
	for (unsigned int i = 0; i < part->mNumVertices; i++, mesh->vertices++) {
		set(mesh->position[mesh->vertices], &part->mVertices[i]);
		if (part->mNormals)
			set(mesh->normal[mesh->vertices], &part->mNormals[i]);
	}
	/* STL files may have normals that are all zero. */
	return mesh_smooth(mesh, vertex, triangle);
}

static int convert(const struct aiScene *scene, const char *path, struct mesh *mesh,
		   char message[MESH_MESSAGE])
{
	uint64_t vertices, triangles;

	count(scene, &vertices, &triangles);
	if (!triangles)
		return refuse(message, -EINVAL, "no triangles", path, "give a mesh with faces");
	if (vertices > UINT32_MAX || triangles > UINT32_MAX / 3)
		return refuse(message, -E2BIG, "mesh too large", path, "give fewer triangles");
	if (mesh_new((uint32_t)vertices, (uint32_t)triangles, mesh))
		return refuse(message, -ENOMEM, "out of memory", path, "give a smaller mesh");
	mesh->vertices = mesh->triangles = 0;
	for (unsigned int i = 0; i < scene->mNumMeshes; i++) {
		if (append(mesh, scene->mMeshes[i])) {
			mesh_free(mesh);
			return refuse(message, -ENOMEM, "out of memory", path,
				      "give a smaller mesh");
		}
	}
	return 0;
}

/*
 * The file is read twice: first as it is, for what assimp's steps do with NaN is not its to
 * promise, and to take the steps later, aiApplyPostProcessing, is not safe: where a step fails it
 * frees the scene twice (5.2.5).
 */
static int load_file(const char *path, bool smooth, struct mesh *mesh, char message[MESH_MESSAGE])
{
	const struct aiScene *scene;
	int ret;

	ret = check_file(path, message);
	if (ret)
		return ret;
	scene = import(path, smooth, 0);
	if (!scene)
		return refuse(message, -EINVAL, "not a mesh", path,
			      "give an OBJ, PLY, 3DS, glTF or STL file");
	ret = check_scene(scene, path, message);
	aiReleaseImport(scene);
	if (ret)
		return ret;
	scene = import(path, smooth, steps);
	if (!scene)
		return refuse(message, -EINVAL, "no triangles", path, "give a mesh with faces");
	ret = convert(scene, path, mesh, message);
	aiReleaseImport(scene);
	return ret;
}

int mesh_load(const char *name, bool smooth, struct mesh *mesh, char message[MESH_MESSAGE])
{
	int ret = mesh_shape(name, mesh);

	if (ret == -ENOENT)
		return load_file(name, smooth, mesh, message);
	if (ret == -EINVAL)
		return refuse(message, ret, "no such shape", name, "there are " MESH_SHAPES);
	if (ret)
		return refuse(message, ret, "out of memory", name, "give a smaller shape");
	return 0;
}
