/* SPDX-License-Identifier: MIT */
/*
 * The bit-exact model of the core: plain integer C, one file per stage, the
 * names of the stages those of rtl/. rtl/gloss.xml says what each packet does;
 * here is who calls whom.
 *
 *   command.c   walks the stream and executes it, packet by packet
 *     command_check.c   is the packet right, and if not, at which word
 *     triangle.c        a TRIANGLE's payload in its many forms to one struct
 *     triangle_small.c  a TRIANGLE_SMALL to the same
 *     parallel.c        the same with tiles drawn by others
 *   draw.c      takes a triangle through the three stages below
 *   draw_small.c  takes a TRIANGLE_SMALL through them at once
 *   raster.c    edges to spans of pixels
 *   shade.c     surfaces to colour and depth
 *   fragment.c  depth test, masks, into the tile
 *   tile.c      the tile's pixels: clear, load, store, answer
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

#include "job.h"

#define MODEL_TILE_MAX 64

/* Rows or pixels that are worked out side by side; arrays may be touched up to so many elements
 * past what is asked for. */
#define MODEL_LANES 8

/* Rows of the largest triangle that lists them. */
#define MODEL_LISTED_ROWS 16

/* One edge; the units are those of group edges_wide. */
struct model_edge {
	int32_t x, step;   /* s13 */
	uint32_t r, m, dy; /* u16 */
};

/* A second-order surface at the anchor, s10.22; a plane has zero dxx, dxy, dyy. */
struct model_surface {
	uint32_t i, dx, dy, dxx, dxy, dyy;
};

/* The depth plane at the anchor, s28.12 in the low 40 bits; the bits above are ignored. */
struct model_plane {
	uint64_t z, dx, dy;
};

/* A triangle as raster and shade take it, whatever form it was sent in. */
struct model_triangle {
	struct model_edge left, right, middle;
	int first_row, last_row; /* last_row: rows less one, as it is sent */
	int switch_row, side;
	/* Rows are listed, as in group rows_one, and of the edges only left.x means anything. */
	bool listed;
	int x;
	uint8_t row[MODEL_LISTED_ROWS];
	struct model_surface red, green, blue, alpha;
	struct model_plane depth;
};

/* Pixels x0 <= x < x1, y0 <= y < y1, inside the tile. */
struct model_scissor {
	int x0, y0, x1, y1;
};

struct model_target {
	unsigned int slot;
	uint32_t pitch; /* bytes; 0: not set */
};

/* State that packets set and triangles use; reset for every job. */
struct model_state {
	enum gloss_compare depth_func;
	bool depth_write;
	uint32_t colour_mask; /* 0xff in each byte that is written */
	struct model_scissor scissor;
	struct model_target colour_surface, depth_surface;
};

struct model_counters {
	uint32_t triangles, covered, passed, tiles;
};

/* Pixels row by row, T to a row. */
struct model_tile {
	uint32_t colour[MODEL_TILE_MAX * MODEL_TILE_MAX + MODEL_LANES];
	uint32_t depth[MODEL_TILE_MAX * MODEL_TILE_MAX + MODEL_LANES];
};

struct model {
	int tile_size;      /* T: 32 or 64 */
	uint8_t *memory;    /* board memory, owned by the caller */
	size_t memory_size; /* bytes */

	/* The job under way. */
	const struct accel_job *job;
	uint32_t at;            /* word of the stream the next packet begins at */
	uint32_t stream_from;   /* word of the stream that job->stream[0] is */
	uint32_t response_from; /* word of the response that job->response[0] is */
	enum gloss_fault fault;
	uint32_t fault_word; /* counted from at */
	struct model_state state;
	struct model_counters counters;
	uint32_t response_used; /* words */
	bool in_tile;
	struct model_tile tile;
};

/* A tile of a checked stream, to be drawn when and where somebody likes. */
struct model_piece {
	const struct accel_job *job;
	struct model_state state; /* before it */
	uint32_t at, end;         /* words of the stream, from TILE_BEGIN on and after TILE_END */
	uint32_t response_used;   /* before it */
};

/* Who draws pieces, called from the thread that runs the job. */
struct model_drawer {
	/* Calls model_draw_piece() with a model of its own, in any thread before wait returns. */
	void (*draw)(void *data, const struct model_piece *piece);
	/* Until all are drawn; adds what they counted to @counters. */
	void (*wait)(void *data, struct model_counters *counters);
};

/* A row of pixels of the tile: columns x0 <= x < x1 of row y. */
struct model_span {
	int y, x0, x1;
};

/* Walks the rows of a triangle. */
struct model_walk {
	const struct model_triangle *triangle;
	struct model_edge left, right;
	int row; /* the next one, counted from the triangle's first */
};

/* All rows of a triangle that have pixels. */
struct model_spans {
	int rows;
	int longest;        /* pixels of the longest row */
	int pixels, blocks; /* of all rows; MODEL_LANES pixels, or the rest of a row */
	int32_t y[MODEL_TILE_MAX + MODEL_LANES];
	int32_t x0[MODEL_TILE_MAX + MODEL_LANES];
	int32_t count[MODEL_TILE_MAX + MODEL_LANES];
};

/* ---- command.c ---- */

/*
 * @memory of @memory_size bytes is the board's and must outlive @model; it is
 * neither read nor written outside the slots of a job.
 * -EINVAL: @tile_size is neither 32 nor 64.
 */
int model_init(struct model *model, int tile_size, void *memory, size_t memory_size);

/*
 * Runs a job to its end or its fault and fills @status. The job and what it
 * points to are lent for the call; response words past status->response_words
 * are not touched.
 * -EINVAL: not a job, and nothing was done: a slot that is not empty starts off
 * a 4096-byte boundary or leaves board memory, or words without a buffer.
 */
int model_run(struct model *model, const struct accel_job *job, struct gloss_status *status);

/* No packet is longer, and none answers more. */
#define MODEL_PACKET_WORDS (1 + GLOSS_LENGTH_MAX)
#define MODEL_ANSWER_WORDS 65535u

/*
 * The same in steps, for whom the stream and the response do not lie in memory as a whole: begin,
 * step until it is false, end. A step executes a packet. Before it job->stream holds the words of
 * the stream from @model->at on, as many as the packet's header says or all that are left, and
 * job->response has room for MODEL_ANSWER_WORDS from @model->response_used on, or all there is;
 * stream_from and response_from, which begin sets to zero, say which words come first in them.
 * A job that is begun may also be forgotten.
 * -EINVAL: a slot, as in model_run.
 */
int model_begin(struct model *model, const struct accel_job *job);
bool model_step(struct model *model);
void model_end(struct model *model, struct gloss_status *status);

/* Begins a job that lies in memory as a whole. -EINVAL, as in model_run. */
int model_begin_whole(struct model *model, const struct accel_job *job);
/* Checks the packet at model->at; false: it has a fault, or the stream ends there. */
bool model_check_next(struct model *model);
/* Executes a packet that was checked; model->at stays. */
void model_execute(struct model *model, const uint32_t *packet);

/* ---- parallel.c ---- */

/*
 * As model_run, with the tiles drawn by @drawer: at any moment it has pieces that do not depend on
 * each other. Memory, response, counters and status are those of model_run.
 */
int model_run_parallel(struct model *model, const struct accel_job *job,
		       const struct model_drawer *drawer, void *data, struct gloss_status *status);
/* Draws @piece, and adds to model->counters. @model was made by model_init() as that of the job. */
void model_draw_piece(struct model *model, const struct model_piece *piece);

/* ---- command_check.c ---- */

/*
 * Checks the packet at @at of the stream against everything gloss.xml asks.
 * For a fault *@word is the offset it is reported at, from the packet's header.
 */
enum gloss_fault model_command_check(const struct model *model, uint32_t at, uint32_t *word);

/* ---- triangle.c ---- */

/* @packet is a checked TRIANGLE from its header on. */
void model_triangle_unpack(const uint32_t *packet, int tile_size, struct model_triangle *triangle);

/* ---- triangle_small.c ---- */

/* The same of a TRIANGLE_SMALL. */
void model_triangle_small_unpack(const uint32_t *packet, struct model_triangle *triangle);

/* ---- draw.c ---- */

/* Draws @triangle in the open tile and counts it and its pixels. */
void model_draw_triangle(struct model *model, const struct model_triangle *triangle);

/* ---- draw_small.c ---- */

/* The same of a triangle whose rows are listed, and whose alpha is constant. */
void model_draw_small(struct model *model, const struct model_triangle *triangle);

/* ---- raster.c ---- */

/* @triangle must live as long as the walk. */
void model_raster_begin(struct model_walk *walk, const struct model_triangle *triangle);
/* The next row with pixels inside @scissor; false: there is none. */
bool model_raster_next(struct model_walk *walk, const struct model_scissor *scissor,
		       struct model_span *span);
/* All rows there are, and past them MODEL_LANES without pixels, so that lanes need not look. */
void model_raster_spans(const struct model_triangle *triangle, const struct model_scissor *scissor,
			struct model_spans *spans);
/* Column at which the triangle's coefficients hold; the row is first_row. */
int model_raster_anchor(const struct model_triangle *triangle, int tile_size);

/* ---- shade.c and fragment.c, a span at a time: for the benches; draw.c takes triangles ---- */

/*
 * Colour as in a colour surface's word and depth in 24 bits of each pixel of
 * the span, the first at index 0. Both arrays have MODEL_TILE_MAX words; what
 * is past the span is overwritten with no meaning.
 */
void model_shade_span(const struct model_triangle *triangle, int anchor_x,
		      const struct model_span *span, uint32_t *colour, uint32_t *depth);

/*
 * Tests and merges a span into the open tile and counts its pixels. @colour and
 * @depth are those of model_shade_span, also in size.
 */
void model_fragment_span(struct model *model, const struct model_span *span, const uint32_t *colour,
			 const uint32_t *depth);

/* ---- tile.c: the accesses were checked ---- */

void model_tile_begin(struct model *model, const struct gloss_tile_begin *begin);
void model_tile_end(struct model *model, const struct gloss_tile_end *end);

/* ---- memory.c ---- */

/* May the job @right @bytes bytes from @offset on in slot number @slot? */
bool model_memory_allows(const struct model *model, unsigned int slot, enum gloss_rights right,
			 uint32_t offset, uint32_t bytes);
/* Words between the host and a slot; the access was checked, @offset is a multiple of 4. */
void model_memory_read(const struct model *model, unsigned int slot, uint32_t offset,
		       uint32_t *words, uint32_t count);
void model_memory_write(struct model *model, unsigned int slot, uint32_t offset,
			const uint32_t *words, uint32_t count);
/* The next @count words of the response buffer, to be filled; there is room. */
uint32_t *model_memory_answer(struct model *model, uint32_t count);

#endif
