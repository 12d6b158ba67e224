/* SPDX-License-Identifier: MIT */
/* What a frame has for each tile, and its command stream. */
#ifndef ACCEL_BIN_H
#define ACCEL_BIN_H

#include "draw/triangle.h"

/* ---- bin.c ---- */

/* Packets of a tile that follow each other; with the rest of a chunk it is 1 KiB. */
#define ACCEL_CHUNK_WORDS 253

struct accel_chunk {
	struct accel_chunk *next;
	uint32_t used;
	uint32_t words[ACCEL_CHUNK_WORDS];
};

/* What state packets say, as they stand in the stream. */
#define ACCEL_STATE_WORDS 4

struct accel_tile_state {
	uint32_t depth_state, colour_mask, scissor;
};

/* What is cleared before anything is drawn: of ACCEL_CLEAR_*, and the values. */
struct accel_tile_clear {
	unsigned int mask;
	uint32_t colour, depth;
};

struct accel_tile {
	struct accel_chunk *chunk, *last;
	uint32_t words; /* of all chunks */
	bool drawn;     /* has records; of another tile nothing below is set */
	bool uses_colour, uses_depth, writes_depth;
	struct accel_tile_clear clear;
	struct accel_tile_state first, now; /* that its records begin, end with */
	uint64_t settled;        /* the bin's number of the state that now is; 0: not known */
	struct accel_tile *next; /* of those drawn on */
};

struct accel_bin {
	int tile_size;
	int width, height;       /* of the target, pixels; 0: no target yet */
	int columns, rows;       /* of tiles */
	struct accel_tile *tile; /* row by row */
	int tiles_room;
	struct accel_tile *drawn; /* the last that was drawn on first; ->next leads to all others */
	struct accel_tile_clear clear;
	unsigned int discard;          /* planes that need not be stored, of ACCEL_CLEAR_* */
	struct accel_tile_state state; /* of what is drawn next; its scissor is per tile */
	uint64_t states;               /* number of that state */
	uint64_t frame;                /* number of the frame; a part has that of its bin */
	struct accel_bounds visible;
	struct accel_block *block, *block_now;
	int block_used; /* chunks of block_now */
	uint64_t records;
};

void accel_bin_init(struct accel_bin *bin, int tile_size);
void accel_bin_free(struct accel_bin *bin);
/* Forgets the frame, and keeps the memory. */
void accel_bin_reset(struct accel_bin *bin);
/* Sets the size of the target. */
int accel_bin_begin(struct accel_bin *bin, int width, int height);
/* Forgets what was drawn. */
void accel_bin_forget(struct accel_bin *bin);
int accel_bin_triangle(struct accel_bin *bin, const struct accel_triangle *triangle);

/* Where the record of a triangle is written that lies in one tile. */
struct accel_bin_room {
	struct accel_tile *tile;
	uint32_t *words; /* ACCEL_RECORD_WORDS of them */
};

/* Is a triangle of pixels @box, of which there is one, visible as a whole and in one tile? */
static inline bool accel_bin_is_whole(const struct accel_bin *bin, const struct accel_bounds *box)
{
	const struct accel_bounds *visible = &bin->visible;
	const int across = box->x0 ^ (box->x1 - 1), down = box->y0 ^ (box->y1 - 1);

	return (across | down) < bin->tile_size && box->x0 >= visible->x0 &&
	       box->x1 <= visible->x1 && box->y0 >= visible->y0 && box->y1 <= visible->y1;
}

/* Then: room for its record. -ENOMEM. */
int accel_bin_begin_whole(struct accel_bin *bin, const struct accel_bounds *box,
			  struct accel_bin_room *room);
/* Room for a record of a tile that is drawn with a state of its own. -ENOMEM. */
int accel_bin_begin_record(struct accel_bin *bin, struct accel_tile *tile,
			   const struct accel_tile_state *state, struct accel_bin_room *room);
/* So many words of the record were written. */
void accel_bin_end_record(struct accel_bin_room *room, uint32_t words);

/*
 * @part takes triangles that @bin is to have after its own, perhaps in another thread. Append moves
 * them; their memory stays the part's, until the same call for the next frame. Within a frame a
 * part is used again and again, each time after begin. -ENOMEM.
 */
int accel_bin_part_begin(struct accel_bin *part, const struct accel_bin *bin);
int accel_bin_append(struct accel_bin *bin, struct accel_bin *part);
/* The word of a scissor packet. */
uint32_t accel_bin_scissor(int x0, int y0, int x1, int y1);
/*
 * The same, for what of @visible is in the tile at pixel @x, @y. Where the target ends inside of a
 * tile there is memory too, so that needs no scissor.
 */
uint32_t accel_bin_tile_scissor(const struct accel_bin *bin, const struct accel_bounds *visible,
				int x, int y);
/* The words of @state but its scissor. */
void accel_bin_tests(struct accel_tile_state *state, enum accel_compare func, bool write,
		     const bool mask[4]);
/* Packets that turn one state into another; returns their words. */
uint32_t accel_bin_packets(uint32_t words[ACCEL_STATE_WORDS], const struct accel_tile_state *now,
			   const struct accel_tile_state *state);
/* What the triangles that follow are drawn with, and where. */
void accel_bin_state(struct accel_bin *bin, const struct accel_state *state,
		     const struct accel_bounds *visible);

/* ---- fill.c ---- */

/* Clears the whole target. After -ENOMEM the records of some tiles may be missing. */
int accel_bin_clear(struct accel_bin *bin, const struct accel_tile_clear *clear);
/*
 * Draws pixels @box of the target, of which there are some, with a colour (as a colour surface's
 * word) and a depth. The scissor of @state is not looked at. -ENOMEM.
 */
int accel_bin_fill(struct accel_bin *bin, const struct accel_bounds *box,
		   const struct accel_tile_state *state, uint32_t colour, uint32_t depth);

/* ---- frame.c ---- */

/* A job ends at the first tile after this. */
#define ACCEL_JOB_WORDS (1u << 24)

/*
 * Sends the frame in @bin, in jobs of about @job_words. *@fence is the last one's. On failure
 * *@sent says whether a part of it is on the board.
 */
int accel_frame_submit(const struct accel_bin *bin, struct accel_stream *stream,
		       const struct accel_target *target, size_t job_words,
		       struct accel_draw_stats *stats, struct accel_fence **fence, bool *sent);

#endif
