/* SPDX-License-Identifier: MIT */
/* An image in a program's memory, or in a list's, by rows of four floats a pixel. */
#ifndef GLOSS_PIXELS_H
#define GLOSS_PIXELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "draw/list.h"
#include "draw/pixel_format.h"
#include "state/client.h"

struct gloss_pixels {
	GLsizei width, height, depth;
	struct gloss_pixel_format format;
	struct gloss_pixel_store store;
	const void *from; /* where the image is read, */
	void *to;         /* or written */
	size_t packed;    /* the image is so many bytes behind this struct; 0: it is at @from */
};

/* Pixels of row @y of slice @z: RGBA, depth or index first. */
void gloss_pixels_get(const struct gloss_pixels *pixels, GLsizei y, GLsizei z, float (*row)[4]);
/* Whether a row of colours can be had as bytes, and where it is. */
bool gloss_pixels_are_bytes(const struct gloss_pixels *pixels);
const uint8_t *gloss_pixels_bytes(const struct gloss_pixels *pixels, GLsizei y, GLsizei z);
void gloss_pixels_put(const struct gloss_pixels *pixels, GLsizei y, GLsizei z,
		      const float (*row)[4]);

/*
 * Does @play now, or puts it into the list that is being compiled. @call, of @size bytes, begins with
 * the pixels; if @valid, a list keeps a copy of the image behind it.
 */
void gloss_pixels_issue(gloss_play_fn play, const struct gloss_pixels *call, size_t size,
			bool valid);
/* The pixels of such a call, with @from. */
struct gloss_pixels gloss_pixels_of(const struct gloss_pixels *call);

#endif
