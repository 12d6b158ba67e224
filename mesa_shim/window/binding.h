/* SPDX-License-Identifier: MIT */
/*
 * Which context and surfaces are current in a thread, for GLX and EGL alike. A thread has one context,
 * and a context has one thread. All functions may be called by any thread.
 */
#ifndef GLOSS_BINDING_H
#define GLOSS_BINDING_H

#include <stdbool.h>

struct gloss_config;
struct gloss_context;
struct gloss_surface;
struct gloss_x11;

/* A context as GLX and EGL hand it out. Its address is the handle. */
struct gloss_binding {
	struct gloss_context *context;
	const struct gloss_config *config; /* NULL: any */
	void *display;                     /* GLX's or EGL's, whoever made it */
	int screen;
	bool current, destroyed;
};

/* -ENODEV: there is no device; -ENOMEM. @share may be NULL. */
int gloss_binding_new(const struct gloss_config *config, void *display, int screen,
		      struct gloss_binding *share, struct gloss_binding **binding);
/* The context goes at once, or when no thread has it any more. */
void gloss_binding_destroy(struct gloss_binding *binding);
/*
 * Makes @binding and the surfaces current in this thread, in place of what was; NULL: none is. What
 * was drawn before is sent. -EACCES: another thread has the context, and nothing changes.
 */
int gloss_binding_make_current(struct gloss_binding *binding, struct gloss_surface *draw,
			       struct gloss_surface *read);
/* Those of this thread; NULL: none. */
struct gloss_binding *gloss_binding_current(void);
struct gloss_surface *gloss_binding_draw(void);
struct gloss_surface *gloss_binding_read(void);
/* Sends what this thread's context has drawn, if @surface is current; shows @surface at its pace. */
int gloss_binding_swap(struct gloss_surface *surface);
/* The same, but that it goes to @x11 and at once. */
int gloss_binding_copy(struct gloss_surface *surface, struct gloss_x11 *x11);

#endif
