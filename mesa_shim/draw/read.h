/* SPDX-License-Identifier: MIT */
/* Pixels read back: a copy of the target is kept until something is drawn. */
#ifndef GLOSS_READ_H
#define GLOSS_READ_H

#include <stdbool.h>
#include <stdint.h>

#include "accel.h"

struct gloss_context;

struct gloss_read_plane {
	uint32_t *pixel; /* rows from the top */
	size_t room;     /* bytes */
	bool valid;
};

struct gloss_read_cache {
	int width, height;
	struct gloss_read_plane plane[2]; /* by enum accel_plane */
};

/* All of @plane as it is after what was drawn so far; NULL: it could not be read. */
const uint32_t *gloss_read_plane(struct gloss_context *context, enum accel_plane plane);
/*
 * @count pixels from @x, @y on, counted from the lower left: RGBA, or a depth first. What is not in
 * the surface, or could not be read, is 0.
 */
void gloss_read_row(struct gloss_context *context, enum accel_plane plane, int64_t x, int64_t y,
		    int count, float (*row)[4]);
void gloss_read_forget(struct gloss_context *context);
void gloss_read_free(struct gloss_context *context);

#endif
