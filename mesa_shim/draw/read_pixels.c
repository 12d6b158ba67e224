// SPDX-License-Identifier: MIT
/* glReadPixels. Pixels outside of the surface are left alone. */
#include <stdlib.h>

#include "draw/read.h"
#include "pixel/pixels.h"
#include "state/command.h"
#include "state/pixel_store.h"

/* What is read; where its lower left corner is, and what of each row is in the surface. */
struct read {
	GLint x, y;
	GLsizei first, end;
	GLenum format;
	enum accel_plane plane;
	struct gloss_pixels pixels;
};

static void read_row(struct gloss_context *context, const struct read *read, GLsizei y,
		     float (*row)[4])
{
	const struct gloss_pixel_format *format = &read->pixels.format;
	const struct gloss_pixel_store *store = &read->pixels.store;
	const GLsizei count = read->end - read->first;
	char *to = (char *)read->pixels.to +
		   gloss_pixel_store_offset(store, read->pixels.width, format->size,
					    format->element, (size_t)read->first, (size_t)y);

	gloss_read_row(context, read->plane, (int64_t)read->x + read->first, (int64_t)read->y + y,
		       count, row);
	gloss_transfer_pixels(context, read->format, row, (size_t)count);
	for (GLsizei i = 0; i < count; i++)
		gloss_pixel_format_put(format, store->swap_bytes, to + (size_t)i * format->size,
				       row[i]);
}

static void read_rows(struct gloss_context *context, struct read *read)
{
	const int64_t right = (int64_t)context->cache.width - read->x;
	float(*row)[4];

	read->first = read->x < 0 ? (GLsizei) - (int64_t)read->x : 0;
	read->end = read->pixels.width < right ? read->pixels.width : (GLsizei)right;
	if (read->first >= read->end)
		return;
	row = malloc((size_t)(read->end - read->first) * sizeof(*row));
	if (!row)
		gloss_error(context, GL_OUT_OF_MEMORY);
	for (GLsizei y = 0; row && y < read->pixels.height; y++)
		if ((int64_t)read->y + y >= 0 && (int64_t)read->y + y < context->cache.height)
			read_row(context, read, y, row);
	free(row);
}

static GLenum read_error(const struct gloss_context *context, GLenum format, GLenum error,
			 GLsizei width, GLsizei height)
{
	if (error)
		return error;
	if (width < 0 || height < 0)
		return GL_INVALID_VALUE;
	if (format == GL_COLOR_INDEX || format == GL_STENCIL_INDEX)
		return GL_INVALID_OPERATION;
	return format == GL_DEPTH_COMPONENT && !context->visual.depth ? GL_INVALID_OPERATION :
									GL_NO_ERROR;
}

void gl_ReadPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
		   void *pixels)
{
	struct gloss_context *context = gloss_outside_ordered();
	struct read read = { .x = x,
			     .y = y,
			     .format = format,
			     .plane = format == GL_DEPTH_COMPONENT ? ACCEL_PLANE_DEPTH :
								     ACCEL_PLANE_COLOUR,
			     .pixels = { width, height, 1, .to = pixels } };
	GLenum error;

	if (!context)
		return;
	error = gloss_pixel_format_find(format, type, &read.pixels.format);
	error = read_error(context, format, error, width, height);
	if (error) {
		gloss_error(context, error);
		return;
	}
	read.pixels.store = context->client.pack;
	if (gloss_read_plane(context, read.plane))
		read_rows(context, &read);
}
