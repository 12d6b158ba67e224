// SPDX-License-Identifier: MIT
/* glDrawPixels and glCopyPixels. */
#include <stdlib.h>

#include "draw/batch.h"
#include "draw/read.h"
#include "pixel/rectangle.h"
#include "state/command.h"

/* ---- of a program's memory ---- */

struct draw_pixels {
	struct gloss_pixels pixels;
	GLenum format, error;
};

/* The buffer that is asked for has to be there. */
static GLenum draw_pixels_missing(const struct gloss_context *context, GLenum format)
{
	if ((format == GL_DEPTH_COMPONENT && !context->visual.depth) ||
	    (format == GL_STENCIL_INDEX && !context->visual.stencil))
		return GL_INVALID_OPERATION;
	return GL_NO_ERROR;
}

static GLenum draw_pixels_error(const struct gloss_context *context, const struct draw_pixels *call)
{
	if (call->error)
		return call->error;
	if (call->pixels.width < 0 || call->pixels.height < 0)
		return GL_INVALID_VALUE;
	return draw_pixels_missing(context, call->format);
}

static void play_draw_pixels(struct gloss_context *context, const void *data)
{
	const struct draw_pixels *call = data;
	const struct gloss_raster_position *raster = &context->attributes.raster;
	const struct gloss_pixels pixels = gloss_pixels_of(&call->pixels);
	const struct gloss_rectangle rectangle = { .format = call->format,
						   .width = pixels.width,
						   .height = pixels.height,
						   .pixels = &pixels,
						   .x = raster->position[0],
						   .y = raster->position[1] };
	const GLenum error = draw_pixels_error(context, call);

	gloss_error(context, error);
	if (error || !raster->valid || !pixels.from)
		return;
	gloss_batch_draw(context);
	gloss_feedback_pixels(context, GL_DRAW_PIXEL_TOKEN);
	gloss_rectangle_draw(context, &rectangle);
}

void gl_DrawPixels(GLsizei width, GLsizei height, GLenum format, GLenum type, const void *pixels)
{
	const struct gloss_context *context = gloss_current();
	struct draw_pixels call = { .pixels = { width, height, 1, .from = pixels },
				    .format = format };

	if (!context)
		return;
	call.pixels.store = context->client.unpack;
	call.pixels.store.image_height = call.pixels.store.skip_images = 0;
	call.error = gloss_pixel_format_find(format, type, &call.pixels.format);
	gloss_pixels_issue(play_draw_pixels, &call.pixels, sizeof(call),
			   !call.error && width > 0 && height > 0 && pixels);
}

/* ---- of the surface that is read ---- */

/* The format of pixels of a kind; 0: it is none. */
static GLenum copy_format(GLenum type)
{
	switch (type) {
	case GL_COLOR:
		return GL_RGBA;
	case GL_DEPTH:
		return GL_DEPTH_COMPONENT;
	case GL_STENCIL:
		return GL_STENCIL_INDEX;
	default:
		return GL_NONE;
	}
}

/* What of a row or column is in the surface: what is not, is not drawn. */
static bool copy_clip(GLint *at, GLsizei *size, GLfloat *to, GLfloat zoom, int whole)
{
	const int64_t end = (int64_t)*at + *size;
	const int64_t first = *at < 0 ? 0 : *at, last = end < whole ? end : whole;

	if (first >= last)
		return false;
	*to += zoom * (GLfloat)(first - *at);
	*at = (GLint)first;
	*size = (GLsizei)(last - first);
	return true;
}

/* All is read before any of it is drawn. */
static void copy_pixels(struct gloss_context *context, GLint x, GLint y,
			struct gloss_rectangle *rectangle)
{
	const GLfloat *zoom = context->attributes.transfer.zoom;
	const enum accel_plane plane = rectangle->format == GL_DEPTH_COMPONENT ? ACCEL_PLANE_DEPTH :
										 ACCEL_PLANE_COLOUR;
	float(*copy)[4];

	if (!gloss_read_plane(context, plane) ||
	    !copy_clip(&x, &rectangle->width, &rectangle->x, zoom[0], context->cache.width) ||
	    !copy_clip(&y, &rectangle->height, &rectangle->y, zoom[1], context->cache.height))
		return;
	copy = malloc((size_t)rectangle->width * (size_t)rectangle->height * sizeof(*copy));
	if (!copy) {
		gloss_error(context, GL_OUT_OF_MEMORY);
		return;
	}
	for (GLsizei i = 0; i < rectangle->height; i++)
		gloss_read_row(context, plane, x, (int64_t)y + i, rectangle->width,
			       copy + (size_t)i * (size_t)rectangle->width);
	rectangle->copy = (const float(*)[4])copy;
	gloss_rectangle_draw(context, rectangle);
	free(copy);
}

GLOSS_LISTED5(CopyPixels, GLint, x, GLint, y, GLsizei, width, GLsizei, height, GLenum, type)
{
	const struct gloss_raster_position *raster = &context->attributes.raster;
	struct gloss_rectangle rectangle = { .format = copy_format(type),
					     .width = width,
					     .height = height,
					     .x = raster->position[0],
					     .y = raster->position[1] };
	GLenum error = draw_pixels_missing(context, rectangle.format);

	if (width < 0 || height < 0)
		error = GL_INVALID_VALUE;
	if (!rectangle.format)
		error = GL_INVALID_ENUM;
	gloss_error(context, error);
	if (error || !raster->valid)
		return;
	gloss_batch_draw(context);
	gloss_feedback_pixels(context, GL_COPY_PIXEL_TOKEN);
	if (rectangle.format == GL_STENCIL_INDEX)
		gloss_missing(context, GLOSS_MISSING_STENCIL);
	else
		copy_pixels(context, x, y, &rectangle);
}
