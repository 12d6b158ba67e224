// SPDX-License-Identifier: MIT
/* glTexImage* and glCopyTexImage*: images that are new. */
#include <string.h>

#include "draw/batch.h"
#include "state/command.h"
#include "texture/tex_call.h"

/* A power of two between two border texels, if there is a border; or any size of a rectangle. */
static bool tex_is_size(int kind, GLsizei size, GLint border, GLsizei most)
{
	const GLsizei inside = size - 2 * border;

	if (inside < 0 || inside > most)
		return false;
	return kind == GLOSS_TEXTURE_RECTANGLE ? !border : !(inside & (inside - 1));
}

static GLsizei tex_greatest(int kind)
{
	switch (kind) {
	case GLOSS_TEXTURE_3D:
		return GLOSS_TEXTURE_3D_SIZE;
	case GLOSS_TEXTURE_CUBE:
		return GLOSS_TEXTURE_CUBE_SIZE;
	default:
		return GLOSS_TEXTURE_SIZE;
	}
}

/* Whether the library has images of this size. */
static bool tex_fits(int kind, GLint dimensions, GLint level, GLint border, const GLsizei size[3])
{
	for (int i = 0; i < 3 && i < dimensions; i++)
		if (!tex_is_size(kind, size[i], border, tex_greatest(kind) >> level))
			return false;
	return kind != GLOSS_TEXTURE_CUBE || size[0] == size[1];
}

/* What is an error whatever the library has. */
static GLenum tex_error(const struct gloss_texture *texture, GLint level, GLint border,
			const GLsizei size[3])
{
	if (level < 0 || level >= gloss_texture_levels(texture->kind))
		return GL_INVALID_VALUE;
	if (border < 0 || border > 1 || size[0] < 0 || size[1] < 0 || size[2] < 0)
		return GL_INVALID_VALUE;
	return GL_NO_ERROR;
}

/* Depths are in images of one and two dimensions alone. */
static bool tex_kind_has(int kind, const struct gloss_texture_format *format)
{
	return format->base != GL_DEPTH_COMPONENT ||
	       (kind != GLOSS_TEXTURE_3D && kind != GLOSS_TEXTURE_CUBE);
}

static void tex_set_proxy(struct gloss_texture_image *image, const struct gloss_texture_image *like,
			  bool fits)
{
	*image = fits ? *like : (struct gloss_texture_image){ 0 };
}

static GLenum tex_call_errors(const struct gloss_texture *texture,
			      const struct gloss_tex_call *call,
			      const struct gloss_texture_format *format)
{
	GLenum error = tex_error(texture, call->level, call->border, call->size);

	if (error)
		return error;
	if (!format)
		return GL_INVALID_VALUE;
	error = gloss_tex_call_error(call, format->base);
	if (error)
		return error;
	return tex_kind_has(texture->kind, format) ? GL_NO_ERROR : GL_INVALID_OPERATION;
}

static void play_image(struct gloss_context *context, const void *data)
{
	const struct gloss_tex_call *call = data;
	struct gloss_texture_image like = { call->size[0],
					    call->size[1],
					    call->size[2],
					    call->border,
					    gloss_texture_format_find(call->internal),
					    NULL };
	const GLint first[3] = { 0 };
	struct gloss_texture_place place;
	struct gloss_texture_image *image;
	GLenum error;
	bool fits;

	if (!gloss_texture_find(context, call->target, call->dimensions, &place)) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	error = tex_call_errors(place.texture, call, like.format);
	if (error) {
		gloss_error(context, error);
		return;
	}
	fits = tex_fits(place.texture->kind, call->dimensions, call->level, call->border,
			call->size);
	image = &place.texture->image[place.face][call->level];
	if (place.proxy) {
		tex_set_proxy(image, &like, fits);
		return;
	}
	if (!fits) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	gloss_batch_draw(context);
	gloss_texture_lock(context);
	if (!gloss_texture_image_set(image, &like))
		gloss_error(context, GL_OUT_OF_MEMORY);
	else if (gloss_pixels_of(&call->pixels).from)
		gloss_tex_call_store(context, call, image, first);
	gloss_texture_generate(place.texture, place.face, call->level);
	gloss_texture_unlock(context);
}

/* Proxies are no command of lists. */
static bool tex_is_proxy(GLenum target)
{
	return target == GL_PROXY_TEXTURE_RECTANGLE || target == GL_PROXY_TEXTURE_1D ||
	       target == GL_PROXY_TEXTURE_2D || target == GL_PROXY_TEXTURE_3D ||
	       target == GL_PROXY_TEXTURE_CUBE_MAP;
}

static void tex_image(struct gloss_tex_call *call, GLenum format, GLenum type, const void *pixels)
{
	struct gloss_context *context;

	gloss_tex_call_init(call, format, type, pixels);
	if (!tex_is_proxy(call->target)) {
		gloss_tex_call_issue(play_image, call);
		return;
	}
	context = gloss_outside();
	if (context)
		play_image(context, call);
}

void gl_TexImage1D(GLenum target, GLint level, GLint internalformat, GLsizei width, GLint border,
		   GLenum format, GLenum type, const void *pixels)
{
	struct gloss_tex_call call = { .target = target,
				       .dimensions = 1,
				       .level = level,
				       .internal = internalformat,
				       .border = border,
				       .size = { width, 1, 1 } };

	tex_image(&call, format, type, pixels);
}

void gl_TexImage2D(GLenum target, GLint level, GLint internalformat, GLsizei width, GLsizei height,
		   GLint border, GLenum format, GLenum type, const void *pixels)
{
	struct gloss_tex_call call = { .target = target,
				       .dimensions = 2,
				       .level = level,
				       .internal = internalformat,
				       .border = border,
				       .size = { width, height, 1 } };

	tex_image(&call, format, type, pixels);
}

void gl_TexImage3D(GLenum target, GLint level, GLint internalformat, GLsizei width, GLsizei height,
		   GLsizei depth, GLint border, GLenum format, GLenum type, const void *pixels)
{
	struct gloss_tex_call call = { .target = target,
				       .dimensions = 3,
				       .level = level,
				       .internal = internalformat,
				       .border = border,
				       .size = { width, height, depth } };

	tex_image(&call, format, type, pixels);
}

/* ---- copies of what was drawn ---- */

struct gloss_copy_image {
	GLint dimensions, level, border;
	GLenum internal;
	struct gloss_tex_copy copy;
};

static GLenum tex_copy_error(const struct gloss_context *context,
			     const struct gloss_texture *texture,
			     const struct gloss_copy_image *call,
			     const struct gloss_texture_format *format)
{
	const GLsizei size[3] = { call->copy.width, call->copy.height, 1 };
	GLenum error;

	/* The numbers 1 to 4 are formats of glTexImage* alone. */
	if (!format || format->internal <= 4)
		return GL_INVALID_ENUM;
	error = tex_error(texture, call->level, call->border, size);
	if (error)
		return error;
	if (!tex_fits(texture->kind, call->dimensions, call->level, call->border, size))
		return GL_INVALID_VALUE;
	if (format->base != GL_DEPTH_COMPONENT)
		return GL_NO_ERROR;
	return context->visual.depth && tex_kind_has(texture->kind, format) ? GL_NO_ERROR :
									      GL_INVALID_OPERATION;
}

GLOSS_LISTED2(CopyTexImage, GLenum, target, struct gloss_copy_image, given)
{
	struct gloss_texture_image like = { given.copy.width,
					    given.copy.height,
					    1,
					    given.border,
					    gloss_texture_format_find((GLint)given.internal),
					    NULL };
	struct gloss_texture_place place;
	struct gloss_texture_image *image;
	GLenum error;

	if (!gloss_texture_find(context, target, given.dimensions, &place) || place.proxy) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	error = tex_copy_error(context, place.texture, &given, like.format);
	if (error) {
		gloss_error(context, error);
		return;
	}
	gloss_batch_draw(context);
	gloss_texture_lock(context);
	image = &place.texture->image[place.face][given.level];
	if (gloss_texture_image_set(image, &like))
		gloss_tex_copy_store(context, &given.copy, image);
	else
		gloss_error(context, GL_OUT_OF_MEMORY);
	gloss_texture_generate(place.texture, place.face, given.level);
	gloss_texture_unlock(context);
}

void gl_CopyTexImage1D(GLenum target, GLint level, GLenum internalformat, GLint x, GLint y,
		       GLsizei width, GLint border)
{
	const struct gloss_copy_image call = {
		1, level, border, internalformat, { x, y, width, 1, { 0 } }
	};

	gl_CopyTexImage(target, call);
}

void gl_CopyTexImage2D(GLenum target, GLint level, GLenum internalformat, GLint x, GLint y,
		       GLsizei width, GLsizei height, GLint border)
{
	const struct gloss_copy_image call = {
		2, level, border, internalformat, { x, y, width, height, { 0 } }
	};

	gl_CopyTexImage(target, call);
}
