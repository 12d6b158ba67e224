/* SPDX-License-Identifier: MIT */
/* Where in a program's memory the pixels of an image lie: OpenGL 1.5, section 3.6.4. */
#ifndef GLOSS_PIXEL_STORE_H
#define GLOSS_PIXEL_STORE_H

#include <stdbool.h>
#include <stddef.h>

#include "state/client.h"

/* Bytes from the first pixel to pixel @x of row @y of an image that is @width pixels wide, of
 * @size bytes each, of which the elements have @element. */
size_t gloss_pixel_store_offset(const struct gloss_pixel_store *store, GLsizei width, size_t size,
				size_t element, size_t x, size_t y);
/* Pixel @x of row @y of a bitmap. */
bool gloss_pixel_store_bit(const struct gloss_pixel_store *store, const GLubyte *bitmap,
			   GLsizei width, GLint x, GLint y);
void gloss_pixel_store_put_bit(const struct gloss_pixel_store *store, GLubyte *bitmap,
			       GLsizei width, GLint x, GLint y, bool bit);

#endif
