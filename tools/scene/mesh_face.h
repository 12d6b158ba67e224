/* SPDX-License-Identifier: MIT */
/* Normals of triangles, and the angles of their corners. */
#ifndef TOOLS_MESH_FACE_H
#define TOOLS_MESH_FACE_H

#include "scene/mesh.h"

struct face {
	float normal[3]; /* of unit length; zero without area */
	float angle[3];  /* of corners, radians */
};

/* Fills @face, one for each triangle. */
void faces_make(const struct mesh *mesh, struct face *face);

#endif
