/* SPDX-License-Identifier: MIT */
/*
 * The reference for quality and the baseline for speed: per-pixel Phong shading
 * in plain C. Vertex normals and eye positions are interpolated over the
 * triangle with perspective, and the lighting of accel_draw.h (OpenGL's, with
 * Blinn's half vector) is evaluated at each pixel that passes the depth test.
 *
 * It covers the pixels the library covers: vertices are snapped to 1/16 pixel,
 * and a pixel is inside by the top-left rule. It does not clip to the sides of
 * the view, only to the near and far plane.
 */
#ifndef TOOLS_PHONG_H
#define TOOLS_PHONG_H

#include "scene/scene.h"

struct phong_frame {
	int width, height;
	uint32_t *pixel;   /* red, green, blue, alpha bytes, as in a target */
	float *depth;      /* window z; 1 where nothing was drawn */
	float (*light)[3]; /* before clamping; NULL: not wanted */
};

/* A frame of the size of @scene; with @light if it is wanted. -ENOMEM */
int phong_frame_new(const struct scene *scene, bool light, struct phong_frame *frame);
void phong_frame_free(struct phong_frame *frame);

/* Clears @frame and draws @scene into it. -ENOMEM; -EINVAL: an index out of range. */
int phong_draw(const struct scene *scene, struct phong_frame *frame);

/* Whether the scene covered pixel @i of @frame (row by row). */
static inline bool phong_covered(const struct phong_frame *frame, size_t i)
{
	return frame->depth[i] < 1;
}

#endif
