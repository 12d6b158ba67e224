/* SPDX-License-Identifier: MIT */
/* From OpenGL's state to libaccel's: the one place where frames begin and things are drawn. */
#ifndef GLOSS_EMIT_H
#define GLOSS_EMIT_H

#include <stdbool.h>

#include "accel.h"

struct gloss_context;

/* Begins a frame on the surface, if none is. False: there is nothing to draw on. */
bool gloss_emit_begin(struct gloss_context *context);
/* Something is about to be drawn: what was read before is out of date. */
void gloss_emit_touch(struct gloss_context *context);
/* Are there polygons that are not filled, so that edge flags count? */
bool gloss_emit_has_outlines(const struct gloss_context *context);
/* Gives what would be drawn with the state of now to @call, as accel_draw_capture does. */
void gloss_emit_capture(struct gloss_context *context, const struct accel_arrays *arrays,
			const struct accel_elements *elements, accel_capture_fn call, void *data);
/* Draws with the state of now. What draws does nothing in selection and feedback, or tells what it is. */
void gloss_emit_draw(struct gloss_context *context, const struct accel_arrays *arrays,
		     const struct accel_elements *elements);
/*
 * Draws @count rectangles of one colour in window coordinates, x0, y0, x1, y1 each, at depth @z,
 * under scissor and masks. @tested: under the depth test as well; else the depth is written if
 * @write says so.
 */
void gloss_emit_rectangles(struct gloss_context *context, const float (*box)[4], uint32_t count,
			   float z, const float rgba[4], bool tested, bool colour, bool depth);
/* Whether pixels are written as they are: no test is on, and of the colour all is written. */
bool gloss_emit_is_plain(const struct gloss_context *context);
/*
 * Writes a plane of the pixels in @part, from the top left of the target and within it, after what was
 * drawn so far and past all state.
 */
void gloss_emit_write(struct gloss_context *context, enum accel_plane plane,
		      const struct accel_rectangle *part, const uint32_t *pixels);
/* Clears under scissor and colour mask; @clear has a mask that is to be cleared. */
void gloss_emit_clear(struct gloss_context *context, const struct accel_clear *clear);

#endif
