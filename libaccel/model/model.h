/* SPDX-License-Identifier: MIT */
/*
 * The bit-exact model of the core: plain integer C, one file per stage, the
 * names of the stages those of rtl/. rtl/gloss.xml says what each packet does;
 * here is who calls whom.
 *
 *   command.c   walks the stream, checks it, calls the others
 *   raster.c    edges to spans of pixels
 *   shade.c     surfaces to colour and depth of a span
 *   fragment.c  scissor, depth test, masks, into the tile
 *   tile.c      the tile's pixels: clear, load, store, return
 *   memory.c    slots: rights, bounds, words
 *
 * Nothing here allocates, prints or keeps state outside its arguments; any
 * number of threads may each run their own struct model.
 */
#ifndef ACCEL_MODEL_H
#define ACCEL_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../job.h"

#define MODEL_TILE_MAX 64

/* One edge; the units are those of group edges_wide. */
struct model_edge {
	int32_t x, step;		/* s13 */
	uint32_t r, m, dy;		/* u16 */
};

/* A second-order surface at the anchor, s10.22; a plane has zero dxx, dxy, dyy. */
struct model_surface {
	uint32_t i, dx, dy, dxx, dxy, dyy;
};

/* The depth plane at the anchor, s28.12 in the low 40 bits. */
struct model_plane {
	uint64_t z, dx, dy;
};

/* A triangle as raster and shade take it, whatever form it was sent in. */
struct model_triangle {
	struct model_edge left, right, middle;
	int first_row, last_row, switch_row, side;
	struct model_surface red, green, blue, alpha;
	struct model_plane depth;
};

struct model_scissor {
	int x0, y0, x1, y1;
};

/* State that packets set and triangles use; reset for every job. */
struct model_state {
	enum gloss_compare depth_func;
	bool depth_write;
	uint32_t colour_mask;		/* 0xff in each byte that is written */
	struct model_scissor scissor;
	struct {
		unsigned int slot;
		uint32_t pitch;		/* 0: not set */
	} colour_surface, depth_surface;
};

struct model_counters {
	uint32_t triangles, covered, passed, tiles;
};

struct model_tile {
	uint32_t colour[MODEL_TILE_MAX * MODEL_TILE_MAX];	/* row by row, T to a row */
	uint32_t depth[MODEL_TILE_MAX * MODEL_TILE_MAX];
};

struct model {
	int tile_size;			/* T: 32 or 64 */
	uint8_t *memory;		/* board memory, owned by the caller */
	size_t memory_size;		/* bytes */

	/* The job under way. */
	const struct gloss_job *job;
	struct model_state state;
	struct model_counters counters;
	uint32_t response_used;		/* words */
	bool in_tile;
	struct model_tile tile;
};

/* A row of pixels of the tile: columns x0 <= x < x1 of row y. */
struct model_span {
	int y, x0, x1;
};

/* Walks the rows of a triangle. */
struct model_walk {
	const struct model_triangle *triangle;
	struct model_edge left, right;
	int row;
};

/* command.c */
int model_init(struct model *model, int tile_size, void *memory, size_t memory_size);
int model_run(struct model *model, const struct gloss_job *job, struct gloss_status *status);

/* raster.c */
void model_raster_begin(struct model_walk *walk, const struct model_triangle *triangle);
bool model_raster_next(struct model_walk *walk, const struct model_scissor *scissor,
		       struct model_span *span);
int model_raster_anchor(const struct model_triangle *triangle, int tile_size);

/* shade.c: colour as in a colour surface's word, depth 24 bits, for each pixel of the span */
void model_shade_span(const struct model_triangle *triangle, int anchor_x,
		      const struct model_span *span, uint32_t *colour, uint32_t *depth);

/* fragment.c */
void model_fragment_span(struct model *model, const struct model_span *span,
			 const uint32_t *colour, const uint32_t *depth);

/* tile.c, memory.c: see there */

#endif
