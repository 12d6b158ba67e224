// SPDX-License-Identifier: MIT
#include "pixel/pixels.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "state/command.h"
#include "state/pixel_store.h"

/* Rows of all slices, one below the other. */
static size_t pixels_row(const struct gloss_pixels *pixels, GLsizei y, GLsizei z)
{
	const struct gloss_pixel_store *store = &pixels->store;
	size_t height = (size_t)(store->image_height ? store->image_height : pixels->height);

	return ((size_t)store->skip_images + (size_t)z) * height + (size_t)y;
}

/* Bytes from the beginning of the image. */
static size_t pixels_at(const struct gloss_pixels *pixels, GLsizei y, GLsizei z)
{
	const struct gloss_pixel_format *format = &pixels->format;

	return gloss_pixel_store_offset(&pixels->store, pixels->width, format->size,
					format->element, 0, pixels_row(pixels, y, z));
}

bool gloss_pixels_are_bytes(const struct gloss_pixels *pixels)
{
	return pixels->format.type == GL_UNSIGNED_BYTE && !pixels->format.index;
}

const uint8_t *gloss_pixels_bytes(const struct gloss_pixels *pixels, GLsizei y, GLsizei z)
{
	return (const uint8_t *)pixels->from + pixels_at(pixels, y, z);
}

void gloss_pixels_get(const struct gloss_pixels *pixels, GLsizei y, GLsizei z, float (*row)[4])
{
	const struct gloss_pixel_format *format = &pixels->format;
	const char *at;

	if (format->type == GL_BITMAP) {
		for (GLsizei x = 0; x < pixels->width; x++)
			row[x][0] = gloss_pixel_store_bit(&pixels->store, pixels->from,
							  pixels->width, x, y);
		return;
	}
	at = (const char *)pixels->from + pixels_at(pixels, y, z);
	for (GLsizei x = 0; x < pixels->width; x++)
		gloss_pixel_format_get(format, pixels->store.swap_bytes,
				       at + (size_t)x * format->size, row[x]);
}

void gloss_pixels_put(const struct gloss_pixels *pixels, GLsizei y, GLsizei z,
		      const float (*row)[4])
{
	const struct gloss_pixel_format *format = &pixels->format;
	char *at;

	if (format->type == GL_BITMAP) {
		for (GLsizei x = 0; x < pixels->width; x++)
			gloss_pixel_store_put_bit(&pixels->store, pixels->to, pixels->width, x, y,
						  (int)row[x][0] & 1);
		return;
	}
	at = (char *)pixels->to + pixels_at(pixels, y, z);
	for (GLsizei x = 0; x < pixels->width; x++)
		gloss_pixel_format_put(format, pixels->store.swap_bytes,
				       at + (size_t)x * format->size, row[x]);
}

/* ---- in lists ---- */

static size_t pixels_packed_row(const struct gloss_pixels *pixels)
{
	if (pixels->format.type == GL_BITMAP)
		return ((size_t)pixels->width + 7) / 8;
	return (size_t)pixels->width * pixels->format.size;
}

/* Bytes of a copy without gaps behind a call of @size; SIZE_MAX: too many. */
static size_t pixels_packed_size(const struct gloss_pixels *pixels, size_t size)
{
	size_t image;

	if (__builtin_mul_overflow(pixels_packed_row(pixels), (size_t)pixels->height, &image) ||
	    __builtin_mul_overflow(image, (size_t)pixels->depth, &image) ||
	    __builtin_add_overflow(image, size, &size))
		return SIZE_MAX;
	return size;
}

static void pixels_pack_bits(const struct gloss_pixels *pixels,
			     const struct gloss_pixel_store *store, GLubyte *to, GLsizei y)
{
	for (GLsizei x = 0; x < pixels->width; x++)
		gloss_pixel_store_put_bit(store, to, pixels->width, x, y,
					  gloss_pixel_store_bit(&pixels->store, pixels->from,
								pixels->width, x, y));
}

/* Bytes stay in their order. */
static void pixels_pack(struct gloss_pixels *copy, const struct gloss_pixels *pixels, void *to)
{
	const size_t size = pixels_packed_row(pixels);
	char *row = to;

	copy->store = (struct gloss_pixel_store){ .alignment = 1,
						  .swap_bytes = pixels->store.swap_bytes };
	for (GLsizei z = 0; z < pixels->depth; z++)
		for (GLsizei y = 0; y < pixels->height; y++, row += size)
			if (pixels->format.type == GL_BITMAP)
				pixels_pack_bits(pixels, &copy->store, to, y);
			else
				memcpy(row, (const char *)pixels->from + pixels_at(pixels, y, z),
				       size);
}

static void pixels_record(struct gloss_context *context, gloss_play_fn play,
			  const struct gloss_pixels *call, size_t size)
{
	const size_t whole = pixels_packed_size(call, size);
	struct gloss_pixels *copy = whole == SIZE_MAX ? NULL : calloc(1, whole);

	if (!copy) {
		gloss_error(context, GL_OUT_OF_MEMORY);
		return;
	}
	memcpy(copy, call, size);
	copy->packed = size;
	pixels_pack(copy, call, (char *)copy + size);
	if (gloss_listed(play, copy, whole))
		play(context, copy);
	free(copy);
}

void gloss_pixels_issue(gloss_play_fn play, const struct gloss_pixels *call, size_t size,
			bool valid)
{
	struct gloss_context *context = gloss_current();

	if (context && context->compiling.list && valid) {
		pixels_record(context, play, call, size);
		return;
	}
	context = gloss_listed(play, call, size);
	if (context)
		play(context, call);
}

struct gloss_pixels gloss_pixels_of(const struct gloss_pixels *call)
{
	struct gloss_pixels pixels = *call;

	if (call->packed)
		pixels.from = (const char *)call + call->packed;
	return pixels;
}
