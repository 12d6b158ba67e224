/* SPDX-License-Identifier: MIT */
#ifndef TOOLS_MESH_IMPORT_H
#define TOOLS_MESH_IMPORT_H

#include "scene/mesh.h"

/*
 * Reads @path with assimp, in this process: a damaged file may crash it (mesh_child.h). As
 * mesh_load.
 */
int mesh_import(const char *path, const struct mesh_options *options, struct mesh *mesh,
		char message[MESH_MESSAGE]);

#endif
