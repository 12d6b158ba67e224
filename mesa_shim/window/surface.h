/* SPDX-License-Identifier: MIT */
/*
 * What contexts draw on: a window, a pixmap or a pbuffer. A surface has one target of libaccel, the
 * back buffer or the only one, of the size that its window had when the frame began.
 *
 * Functions that name no thread are called by the thread that the surface is current in, or by any
 * while it is current in none.
 */
#ifndef GLOSS_SURFACE_H
#define GLOSS_SURFACE_H

#include <stdbool.h>

struct accel_target;
struct gloss_surface;
struct gloss_x11;

/* A pixel format. The id is EGL's and GLX's number of it, from 1 on. */
struct gloss_config {
	int id;
	int red, green, blue, alpha, depth, stencil; /* bits */
	bool double_buffered;
};

/* ---- for what draws ---- */

/*
 * The target to draw on now. Ask at the beginning of each frame: after the window has another size
 * it is another one, whose content is black. It is the surface's, valid until the next call.
 * NULL: there is none, for lack of memory or because the window is gone.
 */
struct accel_target *gloss_surface_target(struct gloss_surface *surface);
/* True once for each new target: nothing was drawn on it, and its depth is 0. */
bool gloss_surface_fresh(struct gloss_surface *surface);
/* Of the target, which is at most ACCEL_TARGET_SIZE_MAX: of a larger window its lower left part. */
int gloss_surface_width(const struct gloss_surface *surface);
int gloss_surface_height(const struct gloss_surface *surface);
const struct gloss_config *gloss_surface_config(const struct gloss_surface *surface);
/* Something was drawn: a surface with a single buffer is shown at the next flush. */
void gloss_surface_touched(struct gloss_surface *surface);
/* To be called after what was drawn has been submitted: shows a single buffer that was touched. */
void gloss_surface_flushed(struct gloss_surface *surface);

/* ---- for GLX and EGL ---- */

/*
 * A surface with one reference. @x11, which becomes the surface's, is the window or pixmap; NULL
 * makes a pbuffer of @width and @height. NULL: no memory.
 */
struct gloss_surface *gloss_surface_new(const struct gloss_config *config, struct gloss_x11 *x11,
					int width, int height);
struct gloss_surface *gloss_surface_ref(struct gloss_surface *surface);
void gloss_surface_unref(struct gloss_surface *surface);
/* Shows what was drawn and submitted. Its content stays. -errno: what libaccel said, or the window
 * is gone. */
int gloss_surface_present(struct gloss_surface *surface);
/* The same on another window or pixmap, which stays the caller's. */
int gloss_surface_copy(struct gloss_surface *surface, struct gloss_x11 *x11);
/*
 * How many refreshes of a screen there are at least from one gloss_surface_pace to the next; 1 at first,
 * or 0 with vblank_mode=0 in the environment, as Mesa has it. X tells no program when that is, so a
 * refresh is a sixtieth of a second.
 */
#define GLOSS_INTERVAL_MAX 60
void gloss_surface_set_interval(struct gloss_surface *surface, int interval);
int gloss_surface_interval(const struct gloss_surface *surface);
/* Waits for that time. A pbuffer has no screen. */
void gloss_surface_pace(struct gloss_surface *surface);
/* The connection to the window ends; from now on the surface is as a pbuffer. */
void gloss_surface_leave(struct gloss_surface *surface);
/* Whether the window is still there. Any thread may call it. */
bool gloss_surface_alive(struct gloss_surface *surface);

#endif
