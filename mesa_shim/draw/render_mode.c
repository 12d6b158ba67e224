// SPDX-License-Identifier: MIT
#include "draw/render_mode.h"

#include "draw/batch.h"
#include "state/command.h"

void gloss_render_mode_capture(void *data, enum accel_captured what,
			       const struct accel_captured_vertex *vertex, uint32_t vertices)
{
	struct gloss_context *context = data;

	if (context->render_mode == GL_FEEDBACK) {
		gloss_feedback_primitive(context, what, vertex, vertices);
		return;
	}
	for (uint32_t i = 0; i < vertices; i++)
		gloss_select_hit(context, vertex[i].window[2]);
}

static GLint render_mode_end(struct gloss_context *context)
{
	switch (context->render_mode) {
	case GL_SELECT:
		return gloss_select_end(context);
	case GL_FEEDBACK:
		return gloss_feedback_end(context);
	default:
		return 0;
	}
}

/* The error of the mode, or GL_NO_ERROR. */
static GLenum render_mode_error(const struct gloss_context *context, GLenum mode)
{
	switch (mode) {
	case GL_RENDER:
		return GL_NO_ERROR;
	case GL_SELECT:
		return context->selection.buffer ? GL_NO_ERROR : GL_INVALID_OPERATION;
	case GL_FEEDBACK:
		return context->feedback.buffer ? GL_NO_ERROR : GL_INVALID_OPERATION;
	default:
		return GL_INVALID_ENUM;
	}
}

GLint gl_RenderMode(GLenum mode)
{
	struct gloss_context *context = gloss_outside_ordered();
	GLenum error;
	GLint result;

	if (!context)
		return 0;
	error = render_mode_error(context, mode);
	if (error) {
		gloss_error(context, error);
		return 0;
	}
	result = render_mode_end(context);
	context->render_mode = mode;
	if (mode == GL_SELECT)
		gloss_select_begin(context);
	if (mode == GL_FEEDBACK)
		gloss_feedback_begin(context);
	return result;
}
