// SPDX-License-Identifier: MIT
/* Viewport, depth range, clip planes, and the texture unit that commands are about. */
#include <math.h>
#include <string.h>

#include "state/command.h"

GLOSS_LISTED4(Viewport, GLint, x, GLint, y, GLsizei, width, GLsizei, height)
{
	const GLint box[4] = { x, y, width > ACCEL_TARGET_SIZE_MAX ? ACCEL_TARGET_SIZE_MAX : width,
			       height > ACCEL_TARGET_SIZE_MAX ? ACCEL_TARGET_SIZE_MAX : height };

	if (width < 0 || height < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	gloss_assign(context, GLOSS_DIRTY_VIEWPORT, context->attributes.viewport.box, box,
		     sizeof(box));
}

GLOSS_LISTED2(DepthRange, GLdouble, near, GLdouble, far)
{
	gloss_change(context, GLOSS_DIRTY_VIEWPORT);
	context->attributes.viewport.range[0] = (GLfloat)fmin(fmax(near, 0), 1);
	context->attributes.viewport.range[1] = (GLfloat)fmin(fmax(far, 0), 1);
}

static GLfloat *transform_plane(struct gloss_context *context, GLenum plane)
{
	if (plane >= GL_CLIP_PLANE0 && plane < GL_CLIP_PLANE0 + GLOSS_CLIP_PLANES)
		return context->attributes.transform.plane[plane - GL_CLIP_PLANE0];
	gloss_error(context, GL_INVALID_ENUM);
	return NULL;
}

GLOSS_LISTED2(ClipPlaneVector, GLenum, plane, struct gloss_vector, equation)
{
	GLfloat *at = transform_plane(context, plane);

	if (!at)
		return;
	gloss_change(context, GLOSS_DIRTY_VIEWPORT);
	gloss_matrix_apply_inverse(gloss_matrix_modelview(context), equation.v, at);
}

void gl_ClipPlane(GLenum plane, const GLdouble *equation)
{
	struct gloss_vector vector;

	for (int i = 0; i < 4; i++)
		vector.v[i] = (GLfloat)equation[i];
	gl_ClipPlaneVector(plane, vector);
}

void gl_GetClipPlane(GLenum plane, GLdouble *equation)
{
	struct gloss_context *context = gloss_outside();
	const GLfloat *at = context ? transform_plane(context, plane) : NULL;

	for (int i = 0; at && i < 4; i++)
		equation[i] = (GLdouble)at[i];
}

GLOSS_LISTED1(ActiveTexture, GLenum, texture)
{
	if (texture - GL_TEXTURE0 < GLOSS_UNITS)
		context->attributes.texturing.active = (GLint)(texture - GL_TEXTURE0);
	else
		gloss_error(context, GL_INVALID_ENUM);
}
