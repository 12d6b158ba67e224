// SPDX-License-Identifier: MIT
#include "pixel/pixels.h"

#include <stdint.h>
#include <string.h>

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

static size_t pixels_packed_row(const struct gloss_pixels *pixels)
{
	if (pixels->format.type == GL_BITMAP)
		return ((size_t)pixels->width + 7) / 8;
	return (size_t)pixels->width * pixels->format.size;
}

size_t gloss_pixels_packed_size(const struct gloss_pixels *pixels)
{
	size_t size;

	if (__builtin_mul_overflow(pixels_packed_row(pixels), (size_t)pixels->height, &size) ||
	    __builtin_mul_overflow(size, (size_t)pixels->depth, &size))
		return SIZE_MAX;
	return size;
}

void gloss_pixels_pack(const struct gloss_pixels *pixels, void *to, struct gloss_pixels *copy)
{
	const size_t size = pixels_packed_row(pixels);

	*copy = *pixels;
	copy->store = (struct gloss_pixel_store){ .alignment = 1,
						  .swap_bytes = pixels->store.swap_bytes };
	copy->from = to;
	for (GLsizei z = 0; z < pixels->depth; z++)
		for (GLsizei y = 0; y < pixels->height; y++) {
			char *row = (char *)to +
				    ((size_t)z * (size_t)pixels->height + (size_t)y) * size;

			for (GLsizei x = 0; x < pixels->width && pixels->format.type == GL_BITMAP;
			     x++)
				gloss_pixel_store_put_bit(&copy->store, to, pixels->width, x, y,
							  gloss_pixel_store_bit(&pixels->store,
										pixels->from,
										pixels->width, x,
										y));
			if (pixels->format.type != GL_BITMAP)
				memcpy(row, (const char *)pixels->from + pixels_at(pixels, y, z),
				       size);
		}
}
