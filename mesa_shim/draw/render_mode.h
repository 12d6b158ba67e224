/* SPDX-License-Identifier: MIT */
/* Selection and feedback: primitives that are told instead of drawn. OpenGL 1.5, sections 5.2, 5.3. */
#ifndef GLOSS_RENDER_MODE_H
#define GLOSS_RENDER_MODE_H

#include <stdbool.h>

#include <GL/gl.h>

#include "accel.h"

#define GLOSS_NAME_STACK_DEPTH 64

/* Hits with the names of then, in the program's buffer. */
struct gloss_selection {
	GLuint *buffer;
	GLint size, used;
	GLint names;
	GLuint name[GLOSS_NAME_STACK_DEPTH];
	GLint hits;
	bool hit, overflow; /* hit: since the names were others */
	float nearest, farthest;
};

/* Primitives as numbers, in the program's buffer. */
struct gloss_feedback {
	GLfloat *buffer;
	GLint size, used;
	GLenum type;
	bool overflow;
};

struct gloss_context;

/* What became of a primitive; for accel_draw_capture, with the context. */
void gloss_render_mode_capture(void *data, enum accel_captured what,
			       const struct accel_captured_vertex *vertex, uint32_t vertices);
/* In selection: something is at this depth. */
void gloss_select_hit(struct gloss_context *context, float depth);
/* In feedback: the token of a rectangle of pixels, at the raster position. */
void gloss_feedback_pixels(struct gloss_context *context, GLenum token);

/* Begins and ends the modes. The end tells how much is in the buffer, or -1: it was too small. */
void gloss_select_begin(struct gloss_context *context);
GLint gloss_select_end(struct gloss_context *context);
void gloss_feedback_begin(struct gloss_context *context);
GLint gloss_feedback_end(struct gloss_context *context);
void gloss_feedback_primitive(struct gloss_context *context, enum accel_captured what,
			      const struct accel_captured_vertex *vertex, uint32_t vertices);

#endif
