// SPDX-License-Identifier: MIT
/* What is asked about images: glGetTexImage and glGetTexLevelParameter. */
#include <stdlib.h>

#include "pixel/pixels.h"
#include "state/command.h"
#include "texture/texture.h"

/* The image of a level; NULL: there is an error. */
static const struct gloss_texture_image *get_image(struct gloss_context *context, GLenum target,
						   GLint level, bool proxy)
{
	struct gloss_texture_place place;

	if (!gloss_texture_find(context, target, 0, &place) || (place.proxy && !proxy)) {
		gloss_error(context, GL_INVALID_ENUM);
		return NULL;
	}
	if (level < 0 || level >= gloss_texture_levels(place.texture->kind)) {
		gloss_error(context, GL_INVALID_VALUE);
		return NULL;
	}
	return &place.texture->image[place.face][level];
}

/* Also of an image that is not there, which has its initial state. False: it is no such name. */
static bool get_level(const struct gloss_texture_image *image, GLenum pname, GLint *value)
{
	switch (pname) {
	case GL_TEXTURE_WIDTH:
		*value = image->width;
		return true;
	case GL_TEXTURE_HEIGHT:
		*value = image->height;
		return true;
	case GL_TEXTURE_DEPTH:
		*value = image->depth;
		return true;
	case GL_TEXTURE_BORDER:
		*value = image->border;
		return true;
	case GL_TEXTURE_INTERNAL_FORMAT:
		*value = image->format ? (GLint)image->format->internal : 1;
		return true;
	case GL_TEXTURE_COMPRESSED:
		*value = GL_FALSE;
		return true;
	case GL_TEXTURE_RED_SIZE:
	case GL_TEXTURE_GREEN_SIZE:
	case GL_TEXTURE_BLUE_SIZE:
	case GL_TEXTURE_ALPHA_SIZE:
	case GL_TEXTURE_LUMINANCE_SIZE:
	case GL_TEXTURE_INTENSITY_SIZE:
	case GL_TEXTURE_DEPTH_SIZE:
		*value = image->format ? gloss_texture_format_bits(image->format, pname) : 0;
		return true;
	default:
		return false;
	}
}

static bool get_level_parameter(GLenum target, GLint level, GLenum pname, GLint *value)
{
	struct gloss_context *context = gloss_outside();
	const struct gloss_texture_image *image;
	bool known;

	if (!context)
		return false;
	image = get_image(context, target, level, true);
	if (!image)
		return false;
	gloss_texture_lock(context);
	known = get_level(image, pname, value);
	gloss_texture_unlock(context);
	if (known)
		return true;
	/* The size of compressed images is a name, but these are none. */
	gloss_error(context, pname == GL_TEXTURE_COMPRESSED_IMAGE_SIZE ? GL_INVALID_OPERATION :
									 GL_INVALID_ENUM);
	return false;
}

void gl_GetTexLevelParameteriv(GLenum target, GLint level, GLenum pname, GLint *params)
{
	GLint value;

	if (get_level_parameter(target, level, pname, &value))
		*params = value;
}

void gl_GetTexLevelParameterfv(GLenum target, GLint level, GLenum pname, GLfloat *params)
{
	GLint value;

	if (get_level_parameter(target, level, pname, &value))
		*params = (GLfloat)value;
}

static GLenum get_image_error(const struct gloss_texture_image *image, GLenum format, GLenum error)
{
	const bool depth = format == GL_DEPTH_COMPONENT;

	if (format == GL_STENCIL_INDEX || format == GL_COLOR_INDEX)
		return GL_INVALID_ENUM;
	if (error || !image->format)
		return error;
	return depth == (image->format->base == GL_DEPTH_COMPONENT) ? GL_NO_ERROR :
								      GL_INVALID_OPERATION;
}

/* A luminance that is asked for is red alone, and no sum as of glReadPixels. */
static void get_red(const struct gloss_pixel_format *format, float (*row)[4], GLsizei count)
{
	for (GLsizei x = 0; format->luminance && x < count; x++)
		row[x][1] = row[x][2] = 0;
}

static void get_rows(struct gloss_context *context, const struct gloss_texture_image *image,
		     const struct gloss_pixels *pixels, GLenum format)
{
	const GLsizei width = image->width;
	float(*row)[4] = malloc(((size_t)width + 1) * sizeof(*row));

	if (!row)
		gloss_error(context, GL_OUT_OF_MEMORY);
	for (GLsizei z = 0; row && z < image->depth; z++)
		for (GLsizei y = 0; y < image->height; y++) {
			const uint32_t *texel = gloss_texture_image_at(image, 0, y, z);

			for (GLsizei x = 0; x < width; x++)
				gloss_texture_format_unpack(image->format, texel[x], row[x]);
			gloss_transfer_pixels(context, format, row, (size_t)width);
			get_red(&pixels->format, row, width);
			gloss_pixels_put(pixels, y, z, (const float(*)[4])row);
		}
	free(row);
}

static void get_texels(struct gloss_context *context, GLenum target,
		       const struct gloss_texture_image *image, GLenum format,
		       struct gloss_pixels *to)
{
	if (!image->format)
		return;
	to->width = image->width;
	to->height = image->height;
	to->depth = image->depth;
	to->store = context->client.pack;
	if (target != GL_TEXTURE_3D)
		to->store.image_height = to->store.skip_images = 0;
	get_rows(context, image, to, format);
}

void gl_GetTexImage(GLenum target, GLint level, GLenum format, GLenum type, void *pixels)
{
	struct gloss_context *context = gloss_outside();
	const struct gloss_texture_image *image;
	struct gloss_pixels to = { .to = pixels };
	GLenum error;

	if (!context)
		return;
	error = gloss_pixel_format_find(format, type, &to.format);
	image = get_image(context, target, level, false);
	if (!image)
		return;
	gloss_texture_lock(context);
	error = get_image_error(image, format, error);
	if (error)
		gloss_error(context, error);
	else
		get_texels(context, target, image, format, &to);
	gloss_texture_unlock(context);
}
