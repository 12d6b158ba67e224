// SPDX-License-Identifier: MIT
/* glReadPixels. Pixels outside of the surface are left alone. */
#include "draw/pixel_format.h"
#include "draw/read.h"
#include "state/command.h"
#include "state/pixel_store.h"

static void read_unpack(const struct gloss_context *context, enum accel_plane plane, uint32_t word,
			float rgba[4])
{
	if (plane == ACCEL_PLANE_DEPTH) {
		rgba[0] = (float)((double)(word & 0xffffff) / 0xffffff);
		return;
	}
	for (int i = 0; i < 4; i++)
		rgba[i] = (float)((const uint8_t *)&word)[i] / 255;
	if (!context->visual.alpha)
		rgba[3] = 1;
}

/* Pixel @column of row @row of the rectangle, whose lower left corner is at @x, @y. */
struct read_place {
	GLint x, y;
	GLsizei width, height;
	const struct gloss_pixel_format *format;
	enum accel_plane plane;
	char *pixels;
};

static void read_row(struct gloss_context *context, const struct read_place *place,
		     const uint32_t *from, GLint row)
{
	const struct gloss_pixel_store *store = &context->client.pack;
	const struct gloss_pixel_format *format = place->format;
	const int64_t y = context->cache.height - 1 - ((int64_t)place->y + row);
	float rgba[4];

	if (y < 0 || y >= context->cache.height)
		return;
	for (GLint column = 0; column < place->width; column++) {
		const int64_t x = (int64_t)place->x + column;

		if (x < 0 || x >= context->cache.width)
			continue;
		read_unpack(context, place->plane, from[y * context->cache.width + x], rgba);
		gloss_pixel_format_put(format, store->swap_bytes,
				       place->pixels + gloss_pixel_store_offset(store, place->width,
										format->size,
										format->element,
										column, row),
				       rgba);
	}
}

void gl_ReadPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
		   void *pixels)
{
	struct gloss_context *context = gloss_outside_ordered();
	struct gloss_pixel_format found;
	struct read_place place = { x, y, width, height, &found, ACCEL_PLANE_COLOUR, pixels };
	const uint32_t *from;
	GLenum error;

	if (!context)
		return;
	error = gloss_pixel_format_find(format, type, &found);
	if (format == GL_STENCIL_INDEX || format == GL_COLOR_INDEX)
		error = GL_INVALID_OPERATION;
	if (format == GL_DEPTH_COMPONENT) {
		place.plane = ACCEL_PLANE_DEPTH;
		if (!context->visual.depth)
			error = GL_INVALID_OPERATION;
	}
	if (!error && (width < 0 || height < 0))
		error = GL_INVALID_VALUE;
	if (error) {
		gloss_error(context, error);
		return;
	}
	from = gloss_read_plane(context, place.plane);
	for (GLint row = 0; from && row < height; row++)
		read_row(context, &place, from, row);
}
