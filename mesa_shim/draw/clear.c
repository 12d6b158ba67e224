// SPDX-License-Identifier: MIT
#include "draw/batch.h"
#include "draw/emit.h"
#include "state/command.h"

static void clear_planes(struct gloss_context *context, unsigned int planes)
{
	const GLfloat *rgba = context->attributes.colour_buffer.clear;
	const struct accel_clear clear = ACCEL_CLEAR(.mask = planes,
						     .rgba = { rgba[0], rgba[1], rgba[2], rgba[3] },
						     .depth = context->attributes.depth.clear);

	gloss_emit_clear(context, &clear);
}

GLOSS_LISTED1(Clear, GLbitfield, mask)
{
	bool colour = mask & GL_COLOR_BUFFER_BIT;
	bool depth = mask & GL_DEPTH_BUFFER_BIT;
	unsigned int planes;

	if (mask & ~(GLbitfield)(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_ACCUM_BUFFER_BIT |
				 GL_STENCIL_BUFFER_BIT)) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	gloss_batch_draw(context);
	colour = colour && context->attributes.colour_buffer.draw_buffer != GL_NONE;
	depth = depth && context->attributes.depth.mask && context->visual.depth;
	planes = (colour ? ACCEL_CLEAR_COLOUR : 0) | (depth ? ACCEL_CLEAR_DEPTH : 0);
	if (planes)
		clear_planes(context, planes);
}

GLOSS_LISTED4(Rectf, GLfloat, x1, GLfloat, y1, GLfloat, x2, GLfloat, y2)
{
	const GLfloat corner[4][2] = { { x1, y1 }, { x2, y1 }, { x2, y2 }, { x1, y2 } };
	struct gloss_vertices *vertices = &context->immediate;
	struct gloss_vertex *vertex;

	gloss_vertices_begin(vertices, GL_POLYGON);
	if (!vertices->inside)
		return;
	for (int i = 0; i < 4 && gloss_vertices_reserve(vertices, 1); i++) {
		vertex = &vertices->vertex[vertices->vertices++];
		*vertex = context->attributes.current.vertex;
		vertex->position[0] = corner[i][0];
		vertex->position[1] = corner[i][1];
		vertex->position[2] = 0;
		vertex->position[3] = 1;
	}
	gloss_vertices_end(vertices);
}

static bool clear_is_buffer(const struct gloss_context *context, GLenum mode)
{
	return mode == GL_FRONT || mode == GL_FRONT_LEFT || mode == GL_FRONT_AND_BACK ||
	       mode == GL_LEFT ||
	       ((mode == GL_BACK || mode == GL_BACK_LEFT) && context->visual.double_buffered);
}

/* Of enums that there are, buffers that a surface has not are another error than others. */
static GLenum clear_buffer_error(GLenum mode)
{
	bool known = (mode >= GL_FRONT_LEFT && mode <= GL_FRONT_AND_BACK) ||
		     (mode >= GL_AUX0 && mode <= GL_AUX3);

	return known ? GL_INVALID_OPERATION : GL_INVALID_ENUM;
}

GLOSS_LISTED1(DrawBuffer, GLenum, mode)
{
	if (mode != GL_NONE && !clear_is_buffer(context, mode)) {
		gloss_error(context, clear_buffer_error(mode));
		return;
	}
	gloss_change(context, GLOSS_DIRTY_FRAGMENT);
	context->attributes.colour_buffer.draw_buffer = mode;
}

GLOSS_LISTED1(ReadBuffer, GLenum, mode)
{
	if (mode == GL_FRONT_AND_BACK || !clear_is_buffer(context, mode)) {
		gloss_error(context, mode == GL_FRONT_AND_BACK ? GL_INVALID_OPERATION :
								 clear_buffer_error(mode));
		return;
	}
	context->attributes.transfer.read_buffer = mode;
}

void gl_Flush(void)
{
	struct gloss_context *context = gloss_outside_ordered();

	/* Of a window with two buffers nobody sees anything before they are swapped. */
	if (context && !context->visual.double_buffered)
		gloss_context_flush(context);
}

void gl_Finish(void)
{
	struct gloss_context *context = gloss_outside_ordered();

	if (context)
		gloss_context_finish(context);
}
