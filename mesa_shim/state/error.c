// SPDX-License-Identifier: MIT
#include <errno.h>

#include "state/command.h"

void gloss_error(struct gloss_context *context, GLenum error)
{
	if (context->error == GL_NO_ERROR)
		context->error = error;
}

void gloss_error_accel(struct gloss_context *context, int err)
{
	/* OpenGL has no error for a board that is gone: then nothing is drawn. */
	if (err == -ENOMEM)
		gloss_error(context, GL_OUT_OF_MEMORY);
}

GLenum gl_GetError(void)
{
	struct gloss_context *context = gloss_outside();
	GLenum error;

	if (!context)
		return GL_NO_ERROR;
	error = context->error;
	context->error = GL_NO_ERROR;
	return error;
}
