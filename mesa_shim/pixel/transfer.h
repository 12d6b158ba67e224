/* SPDX-License-Identifier: MIT */
/* What glPixelTransfer and glPixelMap do to pixels on their way: OpenGL 1.5, section 3.6.5. */
#ifndef GLOSS_TRANSFER_H
#define GLOSS_TRANSFER_H

#include <stdbool.h>
#include <stddef.h>

#include <GL/gl.h>

#define GLOSS_PIXEL_MAPS 10
#define GLOSS_PIXEL_MAP_MAX 256

/* From an index or a colour to another: those of glPixelMap in the order of their enums. */
struct gloss_pixel_maps {
	GLint size[GLOSS_PIXEL_MAPS];
	GLfloat value[GLOSS_PIXEL_MAPS][GLOSS_PIXEL_MAP_MAX];
};

struct gloss_context;

void gloss_pixel_maps_init(struct gloss_pixel_maps *maps);
/* Colours, limited to 0 to 1. */
void gloss_transfer_colour(const struct gloss_context *context, float (*pixel)[4], size_t count);
/* Whether colours stay as they are. */
bool gloss_transfer_is_plain(const struct gloss_context *context);
/* Indices, which become colours. */
void gloss_transfer_index(const struct gloss_context *context, float (*pixel)[4], size_t count);
/* Depths, limited to 0 to 1, and stencil indices: the first of each pixel. */
void gloss_transfer_depth(const struct gloss_context *context, float (*pixel)[4], size_t count);
void gloss_transfer_stencil(const struct gloss_context *context, float (*pixel)[4], size_t count);
/* By the external format. */
void gloss_transfer_pixels(const struct gloss_context *context, GLenum format, float (*pixel)[4],
			   size_t count);

#endif
