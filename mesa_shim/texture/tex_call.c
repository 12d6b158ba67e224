// SPDX-License-Identifier: MIT
#include "texture/tex_call.h"

#include <stdlib.h>
#include <string.h>

#include "draw/read.h"
#include "state/command.h"

void gloss_tex_call_init(struct gloss_tex_call *call, GLenum format, GLenum type,
			 const void *pixels)
{
	const struct gloss_context *context = gloss_current();

	call->format = format;
	call->error = gloss_pixel_format_find(format, type, &call->pixels.format);
	if (format == GL_STENCIL_INDEX)
		call->error = GL_INVALID_ENUM;
	call->pixels.width = call->size[0];
	call->pixels.height = call->size[1];
	call->pixels.depth = call->size[2];
	call->pixels.from = pixels;
	if (context)
		call->pixels.store = context->client.unpack;
	/* Those are for images of three dimensions alone. */
	if (call->dimensions < 3)
		call->pixels.store.image_height = call->pixels.store.skip_images = 0;
}

/* Whether the pixels are to be copied: they are there, and the call is no error. */
static bool tex_call_packs(const struct gloss_tex_call *call)
{
	for (int i = 0; i < 3; i++)
		if (call->size[i] < 1 || call->size[i] > GLOSS_TEXTURE_SIZE + 2)
			return false;
	return call->pixels.from && call->error == GL_NO_ERROR;
}

void gloss_tex_call_issue(gloss_play_fn play, const struct gloss_tex_call *call)
{
	gloss_pixels_issue(play, &call->pixels, sizeof(*call), tex_call_packs(call));
}

GLenum gloss_tex_call_error(const struct gloss_tex_call *call, GLenum base)
{
	if (call->error)
		return call->error;
	return (call->format == GL_DEPTH_COMPONENT) == (base == GL_DEPTH_COMPONENT) ?
		       GL_NO_ERROR :
		       GL_INVALID_OPERATION;
}

/* Room for a row of pixels; NULL: there is an error. */
static float (*tex_row(struct gloss_context *context, GLsizei width))[4]
{
	float(*row)[4] = malloc(((size_t)width + 1) * sizeof(*row));

	if (!row)
		gloss_error(context, GL_OUT_OF_MEMORY);
	return row;
}

/* A row of bytes that nothing changes on its way. */
static void tex_put_bytes(const struct gloss_pixel_format *format, const uint8_t *from,
			  const struct gloss_texture_format *to, uint32_t *texel, GLsizei count)
{
	for (GLsizei x = 0; x < count; x++, from += format->size) {
		uint8_t rgba[4] = { 0, 0, 0, 255 };

		for (unsigned int i = 0; i < format->components; i++)
			rgba[format->from[i]] = from[i];
		if (format->luminance)
			rgba[1] = rgba[2] = rgba[0];
		texel[x] = gloss_texture_format_pack_bytes(to, rgba);
	}
}

static void tex_store_bytes(const struct gloss_pixels *pixels,
			    const struct gloss_texture_image *image, const GLint at[3], bool same)
{
	for (GLsizei z = 0; z < pixels->depth; z++)
		for (GLsizei y = 0; y < pixels->height; y++) {
			const uint8_t *from = gloss_pixels_bytes(pixels, y, z);
			uint32_t *to = gloss_texture_image_at(image, at[0], at[1] + y, at[2] + z);

			if (same)
				memcpy(to, from, (size_t)pixels->width * sizeof(*to));
			else
				tex_put_bytes(&pixels->format, from, image->format, to,
					      pixels->width);
		}
}

static void tex_store_floats(struct gloss_context *context, const struct gloss_tex_call *call,
			     const struct gloss_pixels *pixels,
			     const struct gloss_texture_image *image, const GLint at[3])
{
	const GLsizei width = pixels->width;
	float(*row)[4] = tex_row(context, width);

	for (GLsizei z = 0; row && z < pixels->depth; z++)
		for (GLsizei y = 0; y < pixels->height; y++) {
			gloss_pixels_get(pixels, y, z, row);
			gloss_transfer_pixels(context, call->format, row, (size_t)width);
			gloss_texture_image_put(image, at[0], at[1] + y, at[2] + z,
						(const float(*)[4])row, width);
		}
	free(row);
}

void gloss_tex_call_store(struct gloss_context *context, const struct gloss_tex_call *call,
			  const struct gloss_texture_image *image, const GLint at[3])
{
	const struct gloss_pixels pixels = gloss_pixels_of(&call->pixels);
	const bool same = call->format == GL_RGBA && image->format->base == GL_RGBA;

	if (call->format != GL_DEPTH_COMPONENT && gloss_pixels_are_bytes(&pixels) &&
	    gloss_transfer_is_plain(context))
		tex_store_bytes(&pixels, image, at, same);
	else
		tex_store_floats(context, call, &pixels, image, at);
}

void gloss_tex_copy_store(struct gloss_context *context, const struct gloss_tex_copy *copy,
			  const struct gloss_texture_image *image)
{
	const bool depth = image->format->base == GL_DEPTH_COMPONENT;
	float(*row)[4] = tex_row(context, copy->width);

	for (GLsizei y = 0; row && y < copy->height; y++) {
		gloss_read_row(context, depth ? ACCEL_PLANE_DEPTH : ACCEL_PLANE_COLOUR, copy->x,
			       (int64_t)copy->y + y, copy->width, row);
		gloss_transfer_pixels(context, depth ? GL_DEPTH_COMPONENT : GL_RGBA, row,
				      (size_t)copy->width);
		gloss_texture_image_put(image, copy->at[0], copy->at[1] + y, copy->at[2],
					(const float(*)[4])row, copy->width);
	}
	free(row);
}
