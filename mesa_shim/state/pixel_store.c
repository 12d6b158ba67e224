// SPDX-License-Identifier: MIT
#include "state/pixel_store.h"

/* Rows begin at multiples of the alignment, unless elements are at least as large. */
static size_t pixel_store_align(const struct gloss_pixel_store *store, size_t row, size_t element)
{
	size_t alignment = (size_t)store->alignment;

	return element >= alignment ? row : (row + alignment - 1) / alignment * alignment;
}

size_t gloss_pixel_store_offset(const struct gloss_pixel_store *store, GLsizei width, size_t size,
				size_t element, size_t x, size_t y)
{
	size_t length = (size_t)(store->row_length ? store->row_length : width);
	size_t row = pixel_store_align(store, length * size, element);

	return ((size_t)store->skip_rows + y) * row + ((size_t)store->skip_pixels + x) * size;
}

static size_t pixel_store_bit(const struct gloss_pixel_store *store, GLsizei width, GLint x,
			      GLint y, unsigned int *shift)
{
	size_t length = (size_t)(store->row_length ? store->row_length : width);
	size_t row = pixel_store_align(store, (length + 7) / 8, 1);
	size_t bit = (size_t)store->skip_pixels + (size_t)x;

	*shift = store->lsb_first ? bit % 8 : 7 - bit % 8;
	return ((size_t)store->skip_rows + (size_t)y) * row + bit / 8;
}

bool gloss_pixel_store_bit(const struct gloss_pixel_store *store, const GLubyte *bitmap,
			   GLsizei width, GLint x, GLint y)
{
	unsigned int shift;
	size_t at = pixel_store_bit(store, width, x, y, &shift);

	return bitmap[at] >> shift & 1;
}

void gloss_pixel_store_put_bit(const struct gloss_pixel_store *store, GLubyte *bitmap,
			       GLsizei width, GLint x, GLint y, bool bit)
{
	unsigned int shift;
	size_t at = pixel_store_bit(store, width, x, y, &shift);

	bitmap[at] = (GLubyte)((bitmap[at] & ~(1u << shift)) | (unsigned int)bit << shift);
}
