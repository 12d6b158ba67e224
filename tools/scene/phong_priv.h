/* SPDX-License-Identifier: MIT */
#ifndef TOOLS_PHONG_PRIV_H
#define TOOLS_PHONG_PRIV_H

#include "scene/phong.h"

struct phong_vertex {
	float eye[3], normal[3];
	float paint[3]; /* reflectance, where the mesh's colours are that */
	double clip[4]; /* as exact as the library's: both snap to one point */
	/* From phong_fill_project: */
	int64_t x, y; /* window, 1/16 pixel */
	float z, inverse_w;
};

/* A light with what does not change from pixel to pixel worked out. */
struct phong_lamp {
	bool positional, spot;
	float position[3]; /* or the unit direction towards it */
	float half[3];     /* of a direction, seen from (0,0,1) */
	float attenuation[3];
	float spot_direction[3], spot_exponent, spot_cosine;
	float ambient[2][3], diffuse[2][3], specular[2][3]; /* times the materials */
};

struct phong_fill {
	const struct scene *scene;
	struct phong_frame *frame;
	float base[2][3]; /* global ambient, front and back */
	float emission[2][3];
	uint32_t alpha[2]; /* in bits 31:24 */
	int lamps;
	struct phong_lamp lamp[ACCEL_LIGHTS];
};

static inline bool phong_painted(const struct scene *scene)
{
	return scene->painted && scene->mesh.colour.data;
}

void phong_fill_init(struct phong_fill *fill, const struct scene *scene, struct phong_frame *frame);
/* To the window; for a vertex inside the near and far plane. */
void phong_fill_project(const struct phong_frame *frame, struct phong_vertex *vertex);
void phong_fill_triangle(const struct phong_fill *fill, const struct phong_vertex *a,
			 const struct phong_vertex *b, const struct phong_vertex *c);

#endif
