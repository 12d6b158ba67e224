// SPDX-License-Identifier: MIT
/* glBitmap: each run of bits is a rectangle. */
#include <math.h>
#include <stdlib.h>

#include "draw/batch.h"
#include "draw/emit.h"
#include "state/command.h"
#include "state/pixel_store.h"

#define BITMAP_RUNS 128u

/* A bitmap's place, and the runs that were found and not drawn. */
struct bitmap {
	GLsizei width, height;
	GLfloat left, bottom;
	uint32_t runs;
	float run[BITMAP_RUNS][4];
};

static void bitmap_draw(struct gloss_context *context, struct bitmap *bitmap)
{
	const struct gloss_raster_position *raster = &context->attributes.raster;

	if (bitmap->runs)
		gloss_emit_rectangles(context, (const float(*)[4])bitmap->run, bitmap->runs,
				      raster->position[2], raster->colour, true, true, false);
	bitmap->runs = 0;
}

static void bitmap_add(struct gloss_context *context, struct bitmap *bitmap, GLint from, GLint to,
		       GLint row)
{
	float *run = bitmap->run[bitmap->runs];

	run[0] = bitmap->left + (GLfloat)from;
	run[1] = bitmap->bottom + (GLfloat)row;
	run[2] = bitmap->left + (GLfloat)to;
	run[3] = run[1] + 1;
	if (++bitmap->runs == BITMAP_RUNS)
		bitmap_draw(context, bitmap);
}

static void bitmap_row(struct gloss_context *context, struct bitmap *bitmap,
		       const struct gloss_pixel_store *store, const GLubyte *bits, GLint row)
{
	GLint start = -1;

	for (GLint i = 0; i <= bitmap->width; i++) {
		bool set = i < bitmap->width &&
			   gloss_pixel_store_bit(store, bits, bitmap->width, i, row);

		if (set && start < 0)
			start = i;
		if (!set && start >= 0) {
			bitmap_add(context, bitmap, start, i, row);
			start = -1;
		}
	}
}

/* The arguments; a list keeps a copy of the bits behind them, without gaps. */
struct bitmap_call {
	GLsizei width, height;
	GLfloat origin[2], move[2];
	GLubyte bits[];
};

static const struct gloss_pixel_store bitmap_packed = { .alignment = 1 };

static void play_bitmap(struct gloss_context *context, const void *data)
{
	const struct bitmap_call *call = data;
	struct gloss_raster_position *raster = &context->attributes.raster;
	struct bitmap bitmap = { .width = call->width, .height = call->height };

	if (!raster->valid)
		return;
	gloss_batch_draw(context);
	bitmap.left = floorf(raster->position[0] - call->origin[0]);
	bitmap.bottom = floorf(raster->position[1] - call->origin[1]);
	for (GLint row = 0; row < call->height; row++)
		bitmap_row(context, &bitmap, &bitmap_packed, call->bits, row);
	bitmap_draw(context, &bitmap);
	gloss_feedback_pixels(context, GL_BITMAP_TOKEN);
	raster->position[0] += call->move[0];
	raster->position[1] += call->move[1];
}

void gl_Bitmap(GLsizei width, GLsizei height, GLfloat xorig, GLfloat yorig, GLfloat xmove,
	       GLfloat ymove, const GLubyte *bitmap)
{
	struct gloss_context *context = gloss_current();
	struct bitmap_call *call;
	size_t size;

	if (!context)
		return;
	if (width < 0 || height < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	if (!bitmap)
		width = height = 0;
	size = sizeof(*call) + ((size_t)width + 7) / 8 * (size_t)height;
	call = calloc(1, size);
	if (!call) {
		gloss_error(context, GL_OUT_OF_MEMORY);
		return;
	}
	*call = (struct bitmap_call){ width, height, { xorig, yorig }, { xmove, ymove } };
	for (GLint i = 0; i < height; i++)
		for (GLint j = 0; j < width; j++)
			gloss_pixel_store_put_bit(&bitmap_packed, call->bits, width, j, i,
						  gloss_pixel_store_bit(&context->client.unpack,
									bitmap, width, j, i));
	context = gloss_listed(play_bitmap, call, size);
	if (context)
		play_bitmap(context, call);
	free(call);
}
