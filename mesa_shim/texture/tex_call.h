/* SPDX-License-Identifier: MIT */
/* glTexImage* and glTexSubImage*: their arguments, and the pixels, which a list keeps a copy of. */
#ifndef GLOSS_TEX_CALL_H
#define GLOSS_TEX_CALL_H

#include "draw/list.h"
#include "pixel/pixels.h"
#include "texture/texture.h"

struct gloss_tex_call {
	struct gloss_pixels pixels; /* from NULL: there are none */
	GLenum target, format;
	GLint dimensions, level, internal, border, at[3];
	GLsizei size[3];
	GLenum error; /* of format and type */
};

/* What glTex*Image has of its arguments; @size 1 where it has no dimension. */
void gloss_tex_call_init(struct gloss_tex_call *call, GLenum format, GLenum type,
			 const void *pixels);
/* Does @play now, or puts it into the list that is being compiled. */
void gloss_tex_call_issue(gloss_play_fn play, const struct gloss_tex_call *call);
/* Puts them into @image, from @at on, border counted. */
void gloss_tex_call_store(struct gloss_context *context, const struct gloss_tex_call *call,
			  const struct gloss_texture_image *image, const GLint at[3]);
/* The error of pixels of @format for an image of @base; or GL_NO_ERROR. */
GLenum gloss_tex_call_error(const struct gloss_tex_call *call, GLenum base);

/* Puts a rectangle of what is read into slice @z of @image. */
struct gloss_tex_copy {
	GLint x, y; /* lower left, in the surface */
	GLsizei width, height;
	GLint at[3];
};
void gloss_tex_copy_store(struct gloss_context *context, const struct gloss_tex_copy *copy,
			  const struct gloss_texture_image *image);

#endif
