/* SPDX-License-Identifier: MIT */
/*
 * A context: all state of OpenGL, and the frame that is being collected. It belongs to the thread
 * it is current in. Commands take it from gloss_current(), which is NULL if there is none.
 */
#ifndef GLOSS_CONTEXT_H
#define GLOSS_CONTEXT_H

#include <stdbool.h>
#include <stdint.h>

#include "accel.h"
#include "draw/evaluator.h"
#include "draw/names.h"
#include "draw/read.h"
#include "draw/render_mode.h"
#include "draw/vertices.h"
#include "pixel/transfer.h"
#include "state/attributes.h"
#include "state/client.h"
#include "state/matrix.h"
#include "texture/texture.h"

#define GLOSS_STACK_DEPTH 16  /* of glPushAttrib and glPushClientAttrib */
#define GLOSS_LIST_NESTING 64 /* of glCallList */

struct gloss_surface;
struct gloss_list;
struct gloss_shared;

/* What of the attributes libaccel has not been told. */
enum gloss_dirty {
	GLOSS_DIRTY_MODELVIEW = 1 << 0,
	GLOSS_DIRTY_PROJECTION = 1 << 1,
	GLOSS_DIRTY_VIEWPORT = 1 << 2,
	GLOSS_DIRTY_LIGHTING = 1 << 3,
	GLOSS_DIRTY_RASTER = 1 << 4,
	GLOSS_DIRTY_FRAGMENT = 1 << 5,
	GLOSS_DIRTY_ALL = (1 << 6) - 1
};

/* What the surface that is drawn on has. */
struct gloss_visual {
	GLint red, green, blue, alpha, depth, stencil;
	GLboolean double_buffered;
};

struct gloss_saved {
	GLbitfield mask;
	struct gloss_attributes attributes;
	struct gloss_sampler sampler[GLOSS_UNITS][GLOSS_TEXTURE_KINDS]; /* of what was bound */
};

struct gloss_saved_client {
	GLbitfield mask;
	struct gloss_client client;
};

/* The list that glNewList opened. */
struct gloss_compiling {
	struct gloss_list *list; /* NULL: none is open */
	GLint name;
	GLenum mode;
	struct gloss_vertices vertices; /* of the list's next node */
	struct gloss_current current;
};

struct gloss_context {
	struct gloss_attributes attributes;
	struct gloss_client client;
	struct gloss_matrices matrices;
	struct gloss_textures textures;
	struct gloss_pixel_maps maps;
	struct gloss_maps evaluators;
	GLenum render_mode;
	struct gloss_selection selection;
	struct gloss_feedback feedback;
	struct gloss_names queries;
	GLuint query; /* that was begun and not ended; 0: none is */
	struct gloss_visual visual;
	GLenum error;

	/* Where glVertex puts what it is given: @immediate, or that of the list being compiled. */
	struct gloss_vertices *vertices;
	struct gloss_vertices immediate;
	struct gloss_compiling compiling;
	GLint nesting; /* of lists being played */
	struct gloss_shared *shared;

	struct gloss_saved *saved; /* GLOSS_STACK_DEPTH of each */
	struct gloss_saved_client *saved_client;
	GLint saved_count, saved_client_count;

	struct accel_device *device;
	struct accel_state *state; /* as the attributes say, but for what @dirty names */
	struct accel_state *plain; /* of rectangles in window coordinates */
	struct accel_draw *draw;
	enum accel_shading shading;
	unsigned int dirty;
	struct gloss_surface *draw_surface, *read_surface;
	struct accel_target *target; /* of the frame that was begun; NULL: none was */
	int width, height;           /* of the surface that is drawn on */
	bool bound_before;
	uint32_t told; /* bits of what GLOSS_DEBUG=perf has named */
	bool tell;
	struct gloss_read_cache cache;
	char renderer[128], version[16];
};

/* The context that is current in this thread. */
extern _Thread_local struct gloss_context *gloss_this;

static inline struct gloss_context *gloss_current(void)
{
	return gloss_this;
}

/* NULL: out of memory. Lists and buffers are those of @share, which may be NULL. */
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
