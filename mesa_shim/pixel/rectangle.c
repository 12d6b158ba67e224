// SPDX-License-Identifier: MIT
#include "pixel/rectangle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/emit.h"
#include "state/command.h"
#include "window/surface.h"

/* ---- where pixels are ---- */

/* The edge below or left of pixel @n: those pixels are beyond it whose centres are. */
static GLint rectangle_edge(GLfloat at, GLfloat zoom, GLsizei n)
{
	const float most = 1 << 20;

	return (GLint)ceilf(fminf(fmaxf(at + zoom * (GLfloat)n, -most), most) - 0.5f);
}

/* Pixels of the window from @first to before @end. */
struct span {
	GLint first, end;
};

static struct span rectangle_span(GLfloat at, GLfloat zoom, GLsizei from, GLsizei to)
{
	const GLint a = rectangle_edge(at, zoom, from), b = rectangle_edge(at, zoom, to);

	return a < b ? (struct span){ a, b } : (struct span){ b, a };
}

static struct span rectangle_cut(struct span span, GLint first, GLint end)
{
	span.first = span.first > first ? span.first : first;
	span.end = span.end < end ? span.end : end;
	return span;
}

/* What of @span, along @axis, is in the surface and in the scissor. */
static struct span rectangle_visible(const struct gloss_context *context, struct span span,
				     int axis)
{
	const struct gloss_scissor *scissor = &context->attributes.scissor;
	const GLint first = scissor->box[axis], size = scissor->box[2 + axis];

	span = rectangle_cut(span, 0,
			     axis ? gloss_surface_height(context->draw_surface) :
				    gloss_surface_width(context->draw_surface));
	if (!scissor->test)
		return span;
	return rectangle_cut(span, first, size > INT32_MAX - first ? INT32_MAX : first + size);
}

/* ---- one row ---- */

static void rectangle_row(const struct gloss_context *context,
			  const struct gloss_rectangle *rectangle, GLsizei y, float (*row)[4])
{
	const size_t width = (size_t)rectangle->width;

	if (rectangle->pixels)
		gloss_pixels_get(rectangle->pixels, y, 0, row);
	else
		memcpy(row, rectangle->copy + (size_t)y * width, width * sizeof(*row));
	gloss_transfer_pixels(context, rectangle->format, row, width);
}

/* ---- pixels that are written ---- */

/* The part of the target that is written, and its pixels from the top. */
struct canvas {
	struct span x, y;
	uint32_t *pixel;
};

static uint32_t canvas_word(const struct gloss_context *context, GLenum format,
			    const float pixel[4])
{
	uint32_t word = 0;

	if (format == GL_DEPTH_COMPONENT)
		return (uint32_t)((double)pixel[0] * 0xffffff + 0.5);
	for (int i = 0; i < 4; i++)
		word |= (uint32_t)(pixel[i] * 255 + 0.5f) << 8 * i;
	return context->visual.alpha ? word : word | 0xff000000;
}

static void canvas_put(const struct gloss_context *context, const struct canvas *canvas,
		       const struct gloss_rectangle *rectangle, GLsizei y, const float (*row)[4])
{
	const GLfloat *zoom = context->attributes.transfer.zoom;
	const size_t width = (size_t)(canvas->x.end - canvas->x.first);
	struct span lines = rectangle_span(rectangle->y, zoom[1], y, y + 1);
	uint32_t *first;

	lines = rectangle_cut(lines, canvas->y.first, canvas->y.end);
	if (lines.first >= lines.end)
		return;
	first = canvas->pixel + (size_t)(canvas->y.end - 1 - lines.first) * width;
	for (GLsizei x = 0; x < rectangle->width; x++) {
		const uint32_t word = canvas_word(context, rectangle->format, row[x]);
		struct span at = rectangle_span(rectangle->x, zoom[0], x, x + 1);

		at = rectangle_cut(at, canvas->x.first, canvas->x.end);
		for (GLint i = at.first; i < at.end; i++)
			first[i - canvas->x.first] = word;
	}
	for (GLint line = lines.first + 1; line < lines.end; line++)
		memcpy(first - (size_t)(line - lines.first) * width, first, width * sizeof(*first));
}

static void rectangle_write(struct gloss_context *context, const struct gloss_rectangle *rectangle,
			    float (*row)[4])
{
	const GLfloat *zoom = context->attributes.transfer.zoom;
	const enum accel_plane plane = rectangle->format == GL_DEPTH_COMPONENT ? ACCEL_PLANE_DEPTH :
										 ACCEL_PLANE_COLOUR;
	struct canvas canvas = {
		.x = rectangle_span(rectangle->x, zoom[0], 0, rectangle->width),
		.y = rectangle_span(rectangle->y, zoom[1], 0, rectangle->height),
	};
	struct accel_rectangle part;

	canvas.x = rectangle_visible(context, canvas.x, 0);
	canvas.y = rectangle_visible(context, canvas.y, 1);
	part = (struct accel_rectangle){ canvas.x.first,
					 gloss_surface_height(context->draw_surface) - canvas.y.end,
					 canvas.x.end - canvas.x.first,
					 canvas.y.end - canvas.y.first };
	if (part.width <= 0 || part.height <= 0)
		return;
	canvas.pixel = malloc((size_t)part.width * (size_t)part.height * sizeof(*canvas.pixel));
	if (!canvas.pixel) {
		gloss_error(context, GL_OUT_OF_MEMORY);
		return;
	}
	for (GLsizei y = 0; y < rectangle->height; y++) {
		rectangle_row(context, rectangle, y, row);
		canvas_put(context, &canvas, rectangle, y, (const float(*)[4])row);
	}
	gloss_emit_write(context, plane, &part, canvas.pixel);
	free(canvas.pixel);
}

/* ---- pixels that are drawn, under tests and masks ---- */

static void rectangle_draw_run(struct gloss_context *context,
			       const struct gloss_rectangle *rectangle, GLsizei from, GLsizei to,
			       GLsizei y, const float pixel[4])
{
	const GLfloat *zoom = context->attributes.transfer.zoom;
	const struct gloss_raster_position *raster = &context->attributes.raster;
	const struct span x = rectangle_span(rectangle->x, zoom[0], from, to);
	const struct span lines = rectangle_span(rectangle->y, zoom[1], y, y + 1);
	const float box[1][4] = { { (float)x.first, (float)lines.first, (float)x.end,
				    (float)lines.end } };

	if (rectangle->format == GL_DEPTH_COMPONENT)
		gloss_emit_rectangles(context, box, 1, pixel[0], raster->colour, true, true, false);
	else
		gloss_emit_rectangles(context, box, 1, raster->position[2], pixel, true, true,
				      false);
}

/* Pixels beside each other that are the same are one. */
static void rectangle_draw_row(struct gloss_context *context,
			       const struct gloss_rectangle *rectangle, GLsizei y,
			       const float (*row)[4])
{
	const size_t size = rectangle->format == GL_DEPTH_COMPONENT ? sizeof(float) : sizeof(*row);
	GLsizei from = 0;

	for (GLsizei x = 1; x <= rectangle->width; x++) {
		if (x < rectangle->width && !memcmp(row[x], row[from], size))
			continue;
		rectangle_draw_run(context, rectangle, from, x, y, row[from]);
		from = x;
	}
}

/* Depths that replace what is there, and draw no colour. */
static bool rectangle_is_plain_depth(const struct gloss_context *context)
{
	const struct gloss_attributes *attributes = &context->attributes;
	const GLboolean *mask = attributes->colour_buffer.mask;
	const bool drawn = attributes->colour_buffer.draw_buffer != GL_NONE &&
			   (mask[0] || mask[1] || mask[2] || (mask[3] && context->visual.alpha));

	return attributes->depth.test && attributes->depth.mask &&
	       attributes->depth.func == GL_ALWAYS && !drawn;
}

void gloss_rectangle_draw(struct gloss_context *context, const struct gloss_rectangle *rectangle)
{
	const bool depth = rectangle->format == GL_DEPTH_COMPONENT;
	float(*row)[4];

	if (!context->draw_surface || !rectangle->width || !rectangle->height)
		return;
	if (rectangle->format == GL_STENCIL_INDEX) {
		gloss_missing(context, GLOSS_MISSING_STENCIL);
		return;
	}
	row = malloc((size_t)rectangle->width * sizeof(*row));
	if (!row)
		gloss_error(context, GL_OUT_OF_MEMORY);
	else if (depth ? rectangle_is_plain_depth(context) : gloss_emit_is_plain(context))
		rectangle_write(context, rectangle, row);
	else
		for (GLsizei y = 0; y < rectangle->height; y++) {
			rectangle_row(context, rectangle, y, row);
			rectangle_draw_row(context, rectangle, y, (const float(*)[4])row);
		}
	free(row);
}
