// SPDX-License-Identifier: MIT
/*
 * Images that a program has compressed. The library knows no such format, which it says as
 * GL_NUM_COMPRESSED_TEXTURE_FORMATS, and so each of these is an error: a format that is given is no
 * enum, and an image that is there is not compressed.
 */
#include "state/command.h"
#include "texture/texture.h"

GLOSS_LISTED0(CompressedImage)
{
	gloss_error(context, GL_INVALID_ENUM);
}

void gl_CompressedTexImage1D(GLenum target, GLint level, GLenum internalformat, GLsizei width,
			     GLint border, GLsizei imageSize, const void *data)
{
	(void)target;
	(void)level;
	(void)internalformat;
	(void)width;
	(void)border;
	(void)imageSize;
	(void)data;
	gl_CompressedImage();
}

void gl_CompressedTexImage2D(GLenum target, GLint level, GLenum internalformat, GLsizei width,
			     GLsizei height, GLint border, GLsizei imageSize, const void *data)
{
	(void)target;
	(void)level;
	(void)internalformat;
	(void)width;
	(void)height;
	(void)border;
	(void)imageSize;
	(void)data;
	gl_CompressedImage();
}

void gl_CompressedTexImage3D(GLenum target, GLint level, GLenum internalformat, GLsizei width,
			     GLsizei height, GLsizei depth, GLint border, GLsizei imageSize,
			     const void *data)
{
	(void)target;
	(void)level;
	(void)internalformat;
	(void)width;
	(void)height;
	(void)depth;
	(void)border;
	(void)imageSize;
	(void)data;
	gl_CompressedImage();
}

void gl_CompressedTexSubImage1D(GLenum target, GLint level, GLint xoffset, GLsizei width,
				GLenum format, GLsizei imageSize, const void *data)
{
	(void)target;
	(void)level;
	(void)xoffset;
	(void)width;
	(void)format;
	(void)imageSize;
	(void)data;
	gl_CompressedImage();
}

void gl_CompressedTexSubImage2D(GLenum target, GLint level, GLint xoffset, GLint yoffset,
				GLsizei width, GLsizei height, GLenum format, GLsizei imageSize,
				const void *data)
{
	(void)target;
	(void)level;
	(void)xoffset;
	(void)yoffset;
	(void)width;
	(void)height;
	(void)format;
	(void)imageSize;
	(void)data;
	gl_CompressedImage();
}

void gl_CompressedTexSubImage3D(GLenum target, GLint level, GLint xoffset, GLint yoffset,
				GLint zoffset, GLsizei width, GLsizei height, GLsizei depth,
				GLenum format, GLsizei imageSize, const void *data)
{
	(void)target;
	(void)level;
	(void)xoffset;
	(void)yoffset;
	(void)zoffset;
	(void)width;
	(void)height;
	(void)depth;
	(void)format;
	(void)imageSize;
	(void)data;
	gl_CompressedImage();
}

void gl_GetCompressedTexImage(GLenum target, GLint level, void *img)
{
	struct gloss_context *context = gloss_outside();
	struct gloss_texture_place place;

	(void)img;
	if (!context)
		return;
	if (!gloss_texture_find(context, target, 0, &place) || place.proxy)
		gloss_error(context, GL_INVALID_ENUM);
	else if (level < 0 || level >= gloss_texture_levels(place.texture->kind))
		gloss_error(context, GL_INVALID_VALUE);
	else
		gloss_error(context, GL_INVALID_OPERATION);
}
