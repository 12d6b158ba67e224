/* SPDX-License-Identifier: MIT */
/* One of assimp's meshes, where a node has it, as part of a mesh. */
#ifndef TOOLS_MESH_PART_H
#define TOOLS_MESH_PART_H

#include <assimp/scene.h>

#include "scene/mesh.h"
#include "scene/mesh_weld.h"

/* Of all parts together. */
struct part_total {
	uint64_t vertices, triangles;
	uint32_t most;         /* vertices of one part */
	bool normals, colours; /* some part has them */
	bool finite;           /* all coordinates are numbers */
};

struct part {
	const struct aiMesh *mesh;
	const struct aiMaterial *material; /* NULL: none that the file has made */
	struct aiMatrix4x4 place;
	bool normals; /* the mesh's are wanted, if they are good */
	bool linear;  /* colours are light, not what a picture has, as in glTF */
};

void part_count(const struct part *part, struct part_total *total);
/*
 * Appends to the mesh in @weld, which has arrays of the total's size and counts what is in them.
 * @number has room for the part's vertices. -EINVAL: an index out of range; -ENOMEM.
 */
int part_append(const struct part *part, struct weld *weld, uint32_t *number);

#endif
