// SPDX-License-Identifier: MIT
/* Meshes by name: shapes, and files, which a process of its own reads. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "scene/mesh_child.h"
#include "scene/mesh_import.h"

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

static int load_file(const char *path, const struct mesh_options *options, struct mesh *mesh,
		     char message[MESH_MESSAGE])
{
	const struct child_limits limits = child_limits_default();
	int ret = check_file(path, message);

	return ret ? ret : child_run(mesh_import, path, options, &limits, mesh, message);
}

/* A shape has the best of smooth normals already. */
static int load_shape(const char *name, const struct mesh_options *options, struct mesh *mesh)
{
	struct mesh shape;
	int ret;

	if (options->normals != MESH_NORMALS_FACETS)
		return mesh_shape(name, mesh);
	ret = mesh_shape(name, &shape);
	if (ret)
		return ret;
	ret = mesh_build(&shape, options->normals, options->crease, mesh);
	mesh_free(&shape);
	return ret;
}

int mesh_load(const char *name, const struct mesh_options *options, struct mesh *mesh,
	      char message[MESH_MESSAGE])
{
	int ret = load_shape(name, options, mesh);

	if (ret == -ENOENT)
		return load_file(name, options, mesh, message);
	if (ret == -EINVAL)
		return refuse(message, ret, "no such shape", name, "there are " MESH_SHAPES);
	if (ret)
		return refuse(message, ret, "out of memory", name, "give a smaller shape");
	return 0;
}
