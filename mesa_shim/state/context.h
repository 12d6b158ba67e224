/* SPDX-License-Identifier: MIT */
/*
 * A context of OpenGL. It belongs to the thread it is current in; commands act on that thread's.
 */
#ifndef GLOSS_CONTEXT_H
#define GLOSS_CONTEXT_H

struct accel_device;
struct gloss_context;
struct gloss_surface;

/* NULL: out of memory. @share may be NULL. */
struct gloss_context *gloss_context_new(struct accel_device *device, struct gloss_context *share);
/* It must not be current in another thread. What it drew and did not send is forgotten. */
void gloss_context_free(struct gloss_context *context);
/*
 * Makes @context current in this thread, or none if it is NULL, and sends what the one before had
 * drawn. The surfaces may be NULL: then nothing is drawn. -errno of that sending.
 */
int gloss_context_bind(struct gloss_context *context, struct gloss_surface *draw,
		       struct gloss_surface *read);
/* Sends what was drawn so far, without waiting. */
int gloss_context_flush(struct gloss_context *context);
/* The same, and waits until it is drawn. */
int gloss_context_finish(struct gloss_context *context);

#endif
