/* SPDX-License-Identifier: MIT */
/* What a pixel of a window or pixmap is. */
#ifndef GLOSS_X11_VISUAL_H
#define GLOSS_X11_VISUAL_H

#include <stdbool.h>
#include <xcb/xcb.h>

struct gloss_format;

/*
 * Fills @format, and @pad, the bytes that rows of an image are a multiple of. @visual as for
 * gloss_x11_open. False: not of a kind that has red, green and blue.
 */
bool gloss_x11_visual_format(xcb_connection_t *connection, xcb_drawable_t drawable, uint8_t depth,
			     xcb_visualid_t visual, struct gloss_format *format, unsigned int *pad);

#endif
