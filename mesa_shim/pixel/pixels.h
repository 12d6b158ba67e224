/* SPDX-License-Identifier: MIT */
/* An image in a program's memory, or in a list's, by rows of four floats a pixel. */
#ifndef GLOSS_PIXELS_H
#define GLOSS_PIXELS_H

#include <stdbool.h>
#include <stddef.h>

#include "draw/pixel_format.h"
#include "state/client.h"

struct gloss_pixels {
	GLsizei width, height, depth;
	struct gloss_pixel_format format;
	struct gloss_pixel_store store;
	const void *from; /* where the image is read, */
	void *to;         /* or written */
};

/* Pixels of row @y of slice @z: RGBA, depth or index first. */
void gloss_pixels_get(const struct gloss_pixels *pixels, GLsizei y, GLsizei z, float (*row)[4]);
void gloss_pixels_put(const struct gloss_pixels *pixels, GLsizei y, GLsizei z,
		      const float (*row)[4]);
/* Bytes of a copy without gaps, and that copy, which is described in @copy as well. */
size_t gloss_pixels_packed_size(const struct gloss_pixels *pixels);
void gloss_pixels_pack(const struct gloss_pixels *pixels, void *to, struct gloss_pixels *copy);

#endif
