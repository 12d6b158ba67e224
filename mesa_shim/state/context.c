// SPDX-License-Identifier: MIT
#include "state/context.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accel.h"
#include "api/commands.h"
#include "window/surface.h"

struct gloss_context {
	struct accel_device *device;
	struct accel_draw *draw;
	struct gloss_surface *draw_surface, *read_surface;
	struct accel_target *target; /* of the frame that was begun; NULL: none was */
	float clear[4];
	double clear_depth;
	GLenum error;
	char renderer[96];
};

static _Thread_local struct gloss_context *current;

struct gloss_context *gloss_context_new(struct accel_device *device, struct gloss_context *share)
{
	struct gloss_context *context = calloc(1, sizeof(*context));
	struct accel_device_info info;

	(void)share;
	if (!context)
		return NULL;
	if (accel_draw_new(device, &context->draw)) {
		free(context);
		return NULL;
	}
	accel_device_info(device, &info, sizeof(info));
	snprintf(context->renderer, sizeof(context->renderer), "Gloss %s", info.name);
	context->device = device;
	context->clear_depth = 1;
	return context;
}

void gloss_context_free(struct gloss_context *context)
{
	accel_draw_free(context->draw);
	free(context);
}

int gloss_context_bind(struct gloss_context *context, struct gloss_surface *draw,
		       struct gloss_surface *read)
{
	int err = current ? gloss_context_flush(current) : 0;

	current = context;
	if (context) {
		context->draw_surface = draw;
		context->read_surface = read;
	}
	return err;
}

int gloss_context_flush(struct gloss_context *context)
{
	int err;

	if (!context->target)
		return 0;
	context->target = NULL;
	err = accel_draw_submit(context->draw, NULL);
	gloss_surface_flushed(context->draw_surface);
	return err;
}

int gloss_context_finish(struct gloss_context *context)
{
	int err = gloss_context_flush(context), ended = accel_device_finish(context->device);

	return err ? err : ended;
}

/* Begins a frame unless one was. False: there is nothing to draw on. */
static bool context_begin(struct gloss_context *context)
{
	static const struct accel_clear fresh = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR |
								    ACCEL_CLEAR_DEPTH,
							    .depth = 1);
	struct gloss_surface *surface = context->draw_surface;

	if (context->target)
		return true;
	context->target = surface ? gloss_surface_target(surface) : NULL;
	if (!context->target)
		return false;
	if (accel_draw_begin(context->draw, context->target,
			     gloss_surface_fresh(surface) ? &fresh : NULL)) {
		context->target = NULL;
		return false;
	}
	gloss_surface_touched(surface);
	return true;
}

void gl_ClearColor(GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha)
{
	if (current)
		memcpy(current->clear, (float[]){ red, green, blue, alpha },
		       sizeof(current->clear));
}

void gl_ClearDepth(GLdouble depth)
{
	if (current)
		current->clear_depth = depth < 0 ? 0 : depth > 1 ? 1 : depth;
}

void gl_Clear(GLbitfield mask)
{
	struct accel_clear clear = ACCEL_CLEAR(.mask = 0);

	if (!current || !context_begin(current))
		return;
	clear.mask = (mask & GL_COLOR_BUFFER_BIT ? ACCEL_CLEAR_COLOUR : 0) |
		     (mask & GL_DEPTH_BUFFER_BIT ? ACCEL_CLEAR_DEPTH : 0);
	memcpy(clear.rgba, current->clear, sizeof(clear.rgba));
	clear.depth = (float)current->clear_depth;
	if (clear.mask)
		accel_draw_clear(current->draw, &clear);
}

void gl_Flush(void)
{
	if (current)
		gloss_context_flush(current);
}

void gl_Finish(void)
{
	if (current)
		gloss_context_finish(current);
}

GLenum gl_GetError(void)
{
	GLenum error = current ? current->error : GL_NO_ERROR;

	if (current)
		current->error = GL_NO_ERROR;
	return error;
}

const GLubyte *gl_GetString(GLenum name)
{
	if (!current)
		return NULL;
	switch (name) {
	case GL_VENDOR:
		return (const GLubyte *)"Gloss";
	case GL_RENDERER:
		return (const GLubyte *)current->renderer;
	case GL_VERSION:
		return (const GLubyte *)"1.1";
	case GL_EXTENSIONS:
		return (const GLubyte *)"";
	}
	current->error = GL_INVALID_ENUM;
	return NULL;
}

/* Of RGBA in bytes; a target's rows come from the top. */
void gl_ReadPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
		   void *pixels)
{
	struct accel_rectangle row = { x, 0, width, 1 };
	struct gloss_surface *surface = current ? current->read_surface : NULL;
	struct accel_target *target;

	if (!surface)
		return;
	if (format != GL_RGBA || type != GL_UNSIGNED_BYTE) {
		current->error = GL_INVALID_OPERATION;
		return;
	}
	gloss_context_flush(current);
	target = gloss_surface_target(surface);
	for (int i = 0; target && i < height; i++) {
		row.y = gloss_surface_height(surface) - 1 - y - i;
		accel_target_read(target, ACCEL_PLANE_COLOUR, &row,
				  (char *)pixels + (size_t)i * (size_t)width * 4,
				  (size_t)width * 4);
	}
}
