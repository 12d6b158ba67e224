// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdio.h>

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

void gloss_missing(struct gloss_context *context, enum gloss_missing what)
{
	static const char *const name[GLOSS_MISSING_COUNT] = {
		[GLOSS_MISSING_TEXTURE] = "textures",
		[GLOSS_MISSING_BLEND] = "blending",
		[GLOSS_MISSING_ALPHA_TEST] = "the alpha test",
		[GLOSS_MISSING_STENCIL] = "the stencil test",
		[GLOSS_MISSING_FOG] = "fog",
		[GLOSS_MISSING_LOGIC_OP] = "the logic operation",
		[GLOSS_MISSING_POLYGON_STIPPLE] = "polygon stipple",
		[GLOSS_MISSING_DRAW] = "primitives that libaccel refused",
	};

	if (!context->tell || context->told & 1u << what)
		return;
	context->told |= 1u << what;
	fprintf(stderr, "gloss: perf: drawn without %s\n", name[what]);
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
