// SPDX-License-Identifier: MIT
/* Feedback: primitives as they are in the window. Vertices have the current texture coordinates. */
#include "draw/batch.h"
#include "state/command.h"

static void feedback_put(struct gloss_feedback *feedback, GLfloat value)
{
	if (feedback->used == feedback->size)
		feedback->overflow = true;
	else
		feedback->buffer[feedback->used++] = value;
}

static void feedback_put_four(struct gloss_feedback *feedback, const GLfloat value[4])
{
	for (int i = 0; i < 4; i++)
		feedback_put(feedback, value[i]);
}

/* Table 5.2. @window has y from the bottom. */
static void feedback_vertex(struct gloss_feedback *feedback, const GLfloat window[4],
			    const GLfloat colour[4], const GLfloat texcoord[4])
{
	feedback_put(feedback, window[0]);
	feedback_put(feedback, window[1]);
	if (feedback->type != GL_2D)
		feedback_put(feedback, window[2]);
	if (feedback->type == GL_4D_COLOR_TEXTURE)
		feedback_put(feedback, window[3]);
	if (feedback->type == GL_2D || feedback->type == GL_3D)
		return;
	feedback_put_four(feedback, colour);
	if (feedback->type != GL_3D_COLOR)
		feedback_put_four(feedback, texcoord);
}

static GLenum feedback_token(enum accel_captured what)
{
	switch (what) {
	case ACCEL_CAPTURED_POINT:
		return GL_POINT_TOKEN;
	case ACCEL_CAPTURED_LINE_FIRST:
		return GL_LINE_RESET_TOKEN;
	case ACCEL_CAPTURED_LINE:
		return GL_LINE_TOKEN;
	case ACCEL_CAPTURED_POLYGON:
		break;
	}
	return GL_POLYGON_TOKEN;
}

void gloss_feedback_primitive(struct gloss_context *context, enum accel_captured what,
			      const struct accel_captured_vertex *vertex, uint32_t vertices)
{
	struct gloss_feedback *feedback = &context->feedback;

	feedback_put(feedback, (GLfloat)feedback_token(what));
	if (what == ACCEL_CAPTURED_POLYGON)
		feedback_put(feedback, (GLfloat)vertices);
	for (uint32_t i = 0; i < vertices; i++) {
		const float *at = vertex[i].window;
		const GLfloat window[4] = { at[0], (GLfloat)context->height - at[1], at[2], at[3] };

		feedback_vertex(feedback, window, vertex[i].colour,
				context->attributes.current.texcoord[0]);
	}
}

void gloss_feedback_pixels(struct gloss_context *context, GLenum token)
{
	const struct gloss_raster_position *raster = &context->attributes.raster;

	if (context->render_mode != GL_FEEDBACK)
		return;
	feedback_put(&context->feedback, (GLfloat)token);
	feedback_vertex(&context->feedback, raster->position, raster->colour, raster->texcoord[0]);
}

void gloss_feedback_begin(struct gloss_context *context)
{
	context->feedback.used = 0;
	context->feedback.overflow = false;
}

GLint gloss_feedback_end(struct gloss_context *context)
{
	return context->feedback.overflow ? -1 : context->feedback.used;
}

void gl_FeedbackBuffer(GLsizei size, GLenum type, GLfloat *buffer)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (type < GL_2D || type > GL_4D_COLOR_TEXTURE) {
		gloss_error(context, GL_INVALID_ENUM);
	} else if (size < 0) {
		gloss_error(context, GL_INVALID_VALUE);
	} else if (context->render_mode == GL_FEEDBACK) {
		gloss_error(context, GL_INVALID_OPERATION);
	} else {
		context->feedback.buffer = buffer;
		context->feedback.size = size;
		context->feedback.type = type;
	}
}

GLOSS_LISTED1(PassThrough, GLfloat, token)
{
	if (context->render_mode != GL_FEEDBACK)
		return;
	gloss_batch_draw(context);
	feedback_put(&context->feedback, GL_PASS_THROUGH_TOKEN);
	feedback_put(&context->feedback, token);
}
