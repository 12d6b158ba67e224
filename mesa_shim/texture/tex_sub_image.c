// SPDX-License-Identifier: MIT
/* glTexSubImage* and glCopyTexSubImage*: parts of images that are there. */
#include "draw/batch.h"
#include "state/command.h"
#include "texture/tex_call.h"

/* The image of a target; NULL: there is an error. */
static struct gloss_texture_image *tex_find_image(struct gloss_context *context, GLenum target,
						  GLint dimensions, GLint level,
						  struct gloss_texture_place *place)
{
	struct gloss_texture_image *image;

	if (!gloss_texture_find(context, target, dimensions, place) || place->proxy) {
		gloss_error(context, GL_INVALID_ENUM);
		return NULL;
	}
	if (level < 0 || level >= gloss_texture_levels(place->texture->kind)) {
		gloss_error(context, GL_INVALID_VALUE);
		return NULL;
	}
	image = &place->texture->image[place->face][level];
	if (image->format)
		return image;
	gloss_error(context, GL_INVALID_OPERATION);
	return NULL;
}

/* Whether the part is one of the image. */
static bool tex_has_part(struct gloss_context *context, const struct gloss_texture_image *image,
			 const GLint at[3], const GLsizei size[3])
{
	if (size[0] >= 0 && size[1] >= 0 && size[2] >= 0 &&
	    gloss_texture_image_has(image, at, size))
		return true;
	gloss_error(context, GL_INVALID_VALUE);
	return false;
}

/* From the image's first texel, which may be of the border. */
static void tex_place_part(const struct gloss_texture_image *image, GLint dimensions, GLint at[3])
{
	for (int i = 0; i < dimensions; i++)
		at[i] += image->border;
}

static void tex_sub_image(struct gloss_context *context, const struct gloss_tex_call *call)
{
	GLint at[3] = { call->at[0], call->at[1], call->at[2] };
	struct gloss_texture_place place;
	const struct gloss_texture_image *image;
	GLenum error;

	image = tex_find_image(context, call->target, call->dimensions, call->level, &place);
	if (!image)
		return;
	error = gloss_tex_call_error(call, image->format->base);
	if (error) {
		gloss_error(context, error);
		return;
	}
	if (!tex_has_part(context, image, at, call->size) || !gloss_pixels_of(&call->pixels).from)
		return;
	gloss_batch_draw(context);
	tex_place_part(image, call->dimensions, at);
	gloss_tex_call_store(context, call, image, at);
	gloss_texture_generate(place.texture, place.face, call->level);
}

static void play_sub_image(struct gloss_context *context, const void *data)
{
	gloss_texture_lock(context);
	tex_sub_image(context, data);
	gloss_texture_unlock(context);
}

void gl_TexSubImage1D(GLenum target, GLint level, GLint xoffset, GLsizei width, GLenum format,
		      GLenum type, const void *pixels)
{
	struct gloss_tex_call call = { .target = target,
				       .dimensions = 1,
				       .level = level,
				       .at = { xoffset },
				       .size = { width, 1, 1 } };

	gloss_tex_call_init(&call, format, type, pixels);
	gloss_tex_call_issue(play_sub_image, &call);
}

void gl_TexSubImage2D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLsizei width,
		      GLsizei height, GLenum format, GLenum type, const void *pixels)
{
	struct gloss_tex_call call = { .target = target,
				       .dimensions = 2,
				       .level = level,
				       .at = { xoffset, yoffset },
				       .size = { width, height, 1 } };

	gloss_tex_call_init(&call, format, type, pixels);
	gloss_tex_call_issue(play_sub_image, &call);
}

void gl_TexSubImage3D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint zoffset,
		      GLsizei width, GLsizei height, GLsizei depth, GLenum format, GLenum type,
		      const void *pixels)
{
	struct gloss_tex_call call = { .target = target,
				       .dimensions = 3,
				       .level = level,
				       .at = { xoffset, yoffset, zoffset },
				       .size = { width, height, depth } };

	gloss_tex_call_init(&call, format, type, pixels);
	gloss_tex_call_issue(play_sub_image, &call);
}

/* ---- copies of what was drawn ---- */

struct gloss_copy_sub_image {
	GLint dimensions, level;
	struct gloss_tex_copy copy;
};

static void tex_copy_sub_image(struct gloss_context *context, GLenum target,
			       struct gloss_copy_sub_image given)
{
	const GLsizei size[3] = { given.copy.width, given.copy.height, 1 };
	struct gloss_texture_place place;
	const struct gloss_texture_image *image;

	image = tex_find_image(context, target, given.dimensions, given.level, &place);
	if (!image || !tex_has_part(context, image, given.copy.at, size))
		return;
	if (image->format->base == GL_DEPTH_COMPONENT && !context->visual.depth) {
		gloss_error(context, GL_INVALID_OPERATION);
		return;
	}
	gloss_batch_draw(context);
	tex_place_part(image, given.dimensions, given.copy.at);
	gloss_tex_copy_store(context, &given.copy, image);
	gloss_texture_generate(place.texture, place.face, given.level);
}

GLOSS_LISTED2(CopyTexSubImage, GLenum, target, struct gloss_copy_sub_image, given)
{
	gloss_texture_lock(context);
	tex_copy_sub_image(context, target, given);
	gloss_texture_unlock(context);
}

void gl_CopyTexSubImage1D(GLenum target, GLint level, GLint xoffset, GLint x, GLint y,
			  GLsizei width)
{
	const struct gloss_copy_sub_image call = { 1,
						   level,
						   { x, y, width, 1, { xoffset, 0, 0 } } };

	gl_CopyTexSubImage(target, call);
}

void gl_CopyTexSubImage2D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint x,
			  GLint y, GLsizei width, GLsizei height)
{
	const struct gloss_copy_sub_image call = {
		2, level, { x, y, width, height, { xoffset, yoffset, 0 } }
	};

	gl_CopyTexSubImage(target, call);
}

void gl_CopyTexSubImage3D(GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint zoffset,
			  GLint x, GLint y, GLsizei width, GLsizei height)
{
	const struct gloss_copy_sub_image call = {
		3, level, { x, y, width, height, { xoffset, yoffset, zoffset } }
	};

	gl_CopyTexSubImage(target, call);
}
