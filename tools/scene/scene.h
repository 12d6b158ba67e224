/* SPDX-License-Identifier: MIT */
/* A lit mesh as both the library and the per-pixel reference (phong.h) draw it. */
#ifndef TOOLS_SCENE_H
#define TOOLS_SCENE_H

#include "accel.h"

struct scene {
	int width, height;      /* of the picture, pixels */
	int left, top;          /* the picture's pixel that is the target's first */
	struct accel_mesh mesh; /* lent, of packed floats */
	float modelview[16], projection[16];
	enum accel_cull cull;
	bool two_sided, local_viewer;
	bool painted;     /* the mesh's colours are the material's, if it has them */
	bool keeps_depth; /* which is read then; else only its colours are */
	float background[4];
	float ambient[4];
	struct accel_material material[2]; /* front, back */
	struct accel_light light[ACCEL_LIGHTS];
};

/* No mesh, identity matrices, one light from the viewer, grey plastic, back faces culled. */
void scene_init(struct scene *scene, int width, int height);

/* Lights and materials in short: a colour without alpha, factors of white. */
struct accel_light scene_light_direction(float x, float y, float z);
struct accel_light scene_light_point(float x, float y, float z);
struct accel_material scene_material_grey(float ambient, float diffuse, float specular,
					  float shininess);

/* Sets everything of @state but the shading and the viewport, with depth test. -EINVAL: a value out of range. */
int scene_apply(const struct scene *scene, struct accel_state *state);

/*
 * Draws the whole frame with @shading: clears, draws, submits and waits. @stats may be NULL.
 * Errors as accel_draw_mesh and accel_draw_finish.
 */
int scene_draw(const struct scene *scene, enum accel_shading shading, struct accel_draw *draw,
	       struct accel_target *target, struct accel_draw_stats *stats);

#endif
