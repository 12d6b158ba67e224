// SPDX-License-Identifier: MIT
#include "state/command.h"

static GLenum *hint_find(struct gloss_hints *hints, GLenum target)
{
	switch (target) {
	case GL_PERSPECTIVE_CORRECTION_HINT:
		return &hints->perspective;
	case GL_POINT_SMOOTH_HINT:
		return &hints->point;
	case GL_LINE_SMOOTH_HINT:
		return &hints->line;
	case GL_POLYGON_SMOOTH_HINT:
		return &hints->polygon;
	case GL_FOG_HINT:
		return &hints->fog;
	case GL_GENERATE_MIPMAP_HINT:
		return &hints->mipmap;
	case GL_TEXTURE_COMPRESSION_HINT:
		return &hints->compression;
	default:
		return NULL;
	}
}

GLOSS_LISTED2(Hint, GLenum, target, GLenum, mode)
{
	GLenum *hint = hint_find(&context->attributes.hints, target);

	if (hint && (mode == GL_FASTEST || mode == GL_NICEST || mode == GL_DONT_CARE))
		*hint = mode;
	else
		gloss_error(context, GL_INVALID_ENUM);
}
