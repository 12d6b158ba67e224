/* SPDX-License-Identifier: MIT */
/* A rectangle of pixels, each of which becomes fragments: OpenGL 1.5, section 3.6.4. */
#ifndef GLOSS_RECTANGLE_H
#define GLOSS_RECTANGLE_H

#include "pixel/pixels.h"

struct gloss_context;

struct gloss_rectangle {
	GLenum format; /* an external one: colour, GL_DEPTH_COMPONENT or GL_STENCIL_INDEX */
	GLsizei width, height;
	const struct gloss_pixels *pixels; /* NULL: they are in @copy, row by row */
	const float (*copy)[4];
	GLfloat x, y; /* of its lower left corner in the window, if it is not zoomed below 0 */
};

/* Transfers the pixels and draws them, with the zoom and the raster position of now. */
void gloss_rectangle_draw(struct gloss_context *context, const struct gloss_rectangle *rectangle);

#endif
