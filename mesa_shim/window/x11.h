/* SPDX-License-Identifier: MIT */
/*
 * A window or pixmap of an X server, and how pictures get there. It speaks through XCB, where an error
 * belongs to its request: a window that another client has destroyed is a result, and no call of the
 * program's error handler, which would end it.
 */
#ifndef GLOSS_X11_H
#define GLOSS_X11_H

#include <xcb/xcb.h>

struct accel_target;
struct gloss_x11;

/*
 * @connection is the caller's and lasts longer. @visual says what a pixel is; 0 takes that of the
 * window, or for a pixmap the first TrueColor visual of its depth. NULL: there is no such window, its
 * pixels are not of a kind that has red, green and blue, or there is no memory.
 */
struct gloss_x11 *gloss_x11_open(xcb_connection_t *connection, xcb_drawable_t drawable,
				 xcb_visualid_t visual);
/* Takes NULL. */
void gloss_x11_close(struct gloss_x11 *x11);
/* The size now, each side at least 1. -ENODEV: the window is gone. */
int gloss_x11_size(struct gloss_x11 *x11, int *width, int *height);
/* Puts @target, of @width and @height, to the lower left corner of the window. The server has done it
 * when it answers the next gloss_x11_size. -errno: as accel_target_read, -ENOMEM. */
int gloss_x11_put(struct gloss_x11 *x11, struct accel_target *target, int width, int height);

#endif
