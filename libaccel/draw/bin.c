// SPDX-License-Identifier: MIT
/*
 * Records by tile. A tile has its words in a chain of chunks, in the order of drawing, and no packet
 * in two of them, so that it is packed where it is sent from. Chunks come from blocks that are kept
 * from frame to frame.
 */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "draw/bin.h"

#define BLOCK_CHUNKS 64

struct accel_block {
	struct accel_block *next;
	struct accel_chunk chunk[BLOCK_CHUNKS];
};

void accel_bin_init(struct accel_bin *bin, int tile_size)
{
	*bin = (struct accel_bin){ .tile_size = tile_size, .states = 1 };
}

void accel_bin_free(struct accel_bin *bin)
{
	while (bin->block) {
		struct accel_block *next = bin->block->next;

		free(bin->block);
		bin->block = next;
	}
	free(bin->tile);
}

void accel_bin_forget(struct accel_bin *bin)
{
	for (int i = 0; i < bin->columns * bin->rows; i++)
		bin->tile[i] = (struct accel_tile){ .drawn = false };
	bin->drawn = NULL;
	bin->block_now = bin->block;
	bin->block_used = 0;
	bin->records = 0;
}

void accel_bin_reset(struct accel_bin *bin)
{
	accel_bin_forget(bin);
	bin->clear.mask = 0;
	bin->width = bin->height = 0;
	bin->columns = bin->rows = 0;
}

int accel_bin_begin(struct accel_bin *bin, int width, int height)
{
	int columns = (width + bin->tile_size - 1) / bin->tile_size;
	int rows = (height + bin->tile_size - 1) / bin->tile_size;
	struct accel_tile *tile;

	if (columns * rows > bin->tiles_room) {
		tile = realloc(bin->tile, (size_t)(columns * rows) * sizeof(*tile));
		if (!tile)
			return -ENOMEM;
		bin->tile = tile;
		bin->tiles_room = columns * rows;
	}
	bin->width = width;
	bin->height = height;
	bin->columns = columns;
	bin->rows = rows;
	bin->discard = 0;
	bin->frame++;
	accel_bin_forget(bin);
	return 0;
}

static struct accel_chunk *bin_chunk_new(struct accel_bin *bin)
{
	struct accel_block **next = &bin->block;

	if (bin->block_now) {
		if (bin->block_used < BLOCK_CHUNKS)
			return &bin->block_now->chunk[bin->block_used++];
		next = &bin->block_now->next;
	}
	if (!*next) {
		*next = malloc(sizeof(**next));
		if (!*next)
			return NULL;
		(*next)->next = NULL;
	}
	bin->block_now = *next;
	bin->block_used = 1;
	return &bin->block_now->chunk[0];
}

static int bin_tile_grow(struct accel_bin *bin, struct accel_tile *tile)
{
	struct accel_chunk *chunk = bin_chunk_new(bin);

	if (!chunk)
		return -ENOMEM;
	chunk->next = NULL;
	chunk->used = 0;
	if (tile->last)
		tile->last->next = chunk;
	else
		tile->chunk = chunk;
	tile->last = chunk;
	return 0;
}

/* Room for @count words, at most ACCEL_CHUNK_WORDS, after those of the tile; NULL: out of memory. */
static uint32_t *bin_tile_room(struct accel_bin *bin, struct accel_tile *tile, uint32_t count)
{
	if ((!tile->last || count > ACCEL_CHUNK_WORDS - tile->last->used) &&
	    bin_tile_grow(bin, tile))
		return NULL;
	return tile->last->words + tile->last->used;
}

/* They are filled. */
static void bin_tile_take(struct accel_tile *tile, uint32_t count)
{
	tile->last->used += count;
	tile->words += count;
}

uint32_t accel_bin_packets(uint32_t words[ACCEL_STATE_WORDS], const struct accel_tile_state *now,
			   const struct accel_tile_state *state)
{
	uint32_t count = 0;

	if (state->depth_state != now->depth_state)
		words[count++] = state->depth_state;
	if (state->colour_mask != now->colour_mask)
		words[count++] = state->colour_mask;
	if (state->scissor != now->scissor) {
		words[count++] = (uint32_t)GLOSS_OP_SCISSOR << 24 | GLOSS_SCISSOR_WORDS;
		words[count++] = state->scissor;
	}
	return count;
}

/* Puts the packets that make @state of what the tile has now; there is room for them. */
static void bin_tile_state(struct accel_bin *bin, struct accel_tile *tile, uint32_t *words,
			   const struct accel_tile_state *state)
{
	if (tile->drawn) {
		bin_tile_take(tile, accel_bin_packets(words, &tile->now, state));
	} else {
		tile->drawn = true;
		tile->clear = bin->clear;
		tile->first = *state;
		tile->next = bin->drawn;
		bin->drawn = tile;
	}
	tile->now = *state;
	tile->settled = 0;
}

/* Which of a state's results a tile must keep, and what it must have from before. */
static void bin_tile_uses(struct accel_tile *tile, const struct accel_tile_state *state)
{
	struct gloss_depth_state depth;
	struct gloss_colour_mask mask;

	gloss_depth_state_unpack(&state->depth_state, &depth);
	gloss_colour_mask_unpack(&state->colour_mask, &mask);
	tile->uses_depth |= depth.func != GLOSS_COMPARE_ALWAYS || depth.write;
	tile->writes_depth |= depth.write;
	tile->uses_colour |= mask.red || mask.green || mask.blue || mask.alpha;
}

uint32_t accel_bin_scissor(int x0, int y0, int x1, int y1)
{
	uint32_t words[1 + GLOSS_SCISSOR_WORDS];

	gloss_scissor_pack(words, &(struct gloss_scissor){ (uint32_t)x0, (uint32_t)y0, (uint32_t)x1,
							   (uint32_t)y1 });
	return words[1];
}

uint32_t accel_bin_tile_scissor(const struct accel_bin *bin, const struct accel_bounds *visible,
				int x, int y)
{
	int size = bin->tile_size;

	return accel_bin_scissor(
		number_clamp(visible->x0 - x, 0, size), number_clamp(visible->y0 - y, 0, size),
		visible->x1 == bin->width ? size : number_clamp(visible->x1 - x, 0, size),
		visible->y1 == bin->height ? size : number_clamp(visible->y1 - y, 0, size));
}

void accel_bin_tests(struct accel_tile_state *state, enum accel_compare func, bool write,
		     const bool mask[4])
{
	gloss_depth_state_pack(&state->depth_state, &(struct gloss_depth_state){
							    .func = (enum gloss_compare)func,
							    .write = write,
						    });
	gloss_colour_mask_pack(&state->colour_mask, &(struct gloss_colour_mask){
							    .red = mask[0],
							    .green = mask[1],
							    .blue = mask[2],
							    .alpha = mask[3],
						    });
}

void accel_bin_state(struct accel_bin *bin, const struct accel_state *state,
		     const struct accel_bounds *visible)
{
	const struct accel_bounds before = bin->visible;
	const struct accel_tile_state now = bin->state;

	accel_bin_tests(&bin->state, state->depth_func, state->depth_write, state->colour_mask);
	bin->visible = *visible;
	/* Tiles that had this state before have it still. */
	if (bin->state.depth_state == now.depth_state &&
	    bin->state.colour_mask == now.colour_mask &&
	    !memcmp(&bin->visible, &before, sizeof(before)))
		return;
	bin->states++;
}

/* Where a record is to be packed, after the state it needs; NULL: out of memory. */
static uint32_t *bin_record_begin(struct accel_bin *bin, struct accel_tile *tile,
				  const struct accel_tile_state *state)
{
	uint32_t *words = bin_tile_room(bin, tile, ACCEL_STATE_WORDS + ACCEL_RECORD_WORDS);

	if (!words)
		return NULL;
	bin_tile_state(bin, tile, words, state);
	bin_tile_uses(tile, state);
	bin->records++;
	return tile->last->words + tile->last->used;
}

/* The same, with the state of what is drawn; the tile's pixel is at @x, @y. */
static uint32_t *bin_record_here(struct accel_bin *bin, struct accel_tile *tile, int x, int y)
{
	struct accel_tile_state state = bin->state;
	uint32_t *words;

	if (tile->settled == bin->states) {
		words = bin_tile_room(bin, tile, ACCEL_RECORD_WORDS);
		bin->records += words != NULL;
		return words;
	}
	state.scissor = accel_bin_tile_scissor(bin, &bin->visible, x, y);
	words = bin_record_begin(bin, tile, &state);
	tile->settled = words ? bin->states : 0;
	return words;
}

int accel_bin_begin_record(struct accel_bin *bin, struct accel_tile *tile,
			   const struct accel_tile_state *state, struct accel_bin_room *room)
{
	room->tile = tile;
	room->words = bin_record_begin(bin, tile, state);
	return room->words ? 0 : -ENOMEM;
}

int accel_bin_begin_whole(struct accel_bin *bin, const struct accel_bounds *box,
			  struct accel_bin_room *room)
{
	const int shift = __builtin_ctz((unsigned int)bin->tile_size);
	const int column = box->x0 >> shift, row = box->y0 >> shift;

	room->tile = &bin->tile[row * bin->columns + column];
	room->words = bin_record_here(bin, room->tile, column * bin->tile_size,
				      row * bin->tile_size);
	return room->words ? 0 : -ENOMEM;
}

void accel_bin_end_record(struct accel_bin_room *room, uint32_t words)
{
	bin_tile_take(room->tile, words);
}

/* The rows of a triangle that lie in one row of tiles. */
struct band {
	int first, end;
	const struct accel_row *row;
};

/* Are there pixels of @row between @x0 and @x1? */
static bool bin_row_meets(const struct accel_row *row, int x0, int x1)
{
	return number_max(row->left, x0) < number_min(row->right, x1);
}

static bool bin_band_covers(const struct band *band, int x0, int x1, int size)
{
	if (band->end - band->first != size)
		return false;
	for (int i = 0; i < size; i++)
		if (band->row[i].left > x0 || band->row[i].right < x1)
			return false;
	return true;
}

/* Draws the part of the band that lies in the tile; rows of it that have no pixel are left off. */
static int bin_band_tile(struct accel_bin *bin, const struct accel_triangle *triangle,
			 const struct band *band, int x, int y)
{
	struct accel_tile
		*tile = &bin->tile[y / bin->tile_size * bin->columns + x / bin->tile_size];
	int x0 = number_max(bin->visible.x0, x);
	int x1 = number_min(bin->visible.x1, x + bin->tile_size);
	struct accel_place place = { x, y, bin->tile_size, band->first, band->end, false, NULL };
	uint32_t *words;

	while (place.first < place.end &&
	       !bin_row_meets(&band->row[place.first - band->first], x0, x1))
		place.first++;
	while (place.first < place.end &&
	       !bin_row_meets(&band->row[place.end - 1 - band->first], x0, x1))
		place.end--;
	if (place.first == place.end)
		return 0;
	place.row = &band->row[place.first - band->first];
	place.covering = bin_band_covers(band, x, x + bin->tile_size, bin->tile_size);
	words = bin_record_here(bin, tile, x, y);
	if (!words)
		return -ENOMEM;
	bin_tile_take(tile, accel_record_pack(words, triangle, &place));
	return 0;
}

static int bin_band_draw(struct accel_bin *bin, const struct accel_triangle *triangle,
			 const struct band *band)
{
	int left = bin->visible.x1, right = bin->visible.x0, size = bin->tile_size;
	int err = 0;

	for (int i = 0; i < band->end - band->first; i++) {
		const struct accel_row *row = &band->row[i];

		if (row->left >= row->right)
			continue;
		left = number_min(row->left, left);
		right = number_max(row->right, right);
	}
	left = number_max(left, bin->visible.x0);
	right = number_min(right, bin->visible.x1);
	for (int x = left / size * size; x < right && !err; x += size)
		err = bin_band_tile(bin, triangle, band, x, band->first / size * size);
	return err;
}

int accel_bin_triangle(struct accel_bin *bin, const struct accel_triangle *triangle)
{
	const struct accel_setup *setup = &triangle->setup;
	int end = number_min(setup->end, bin->visible.y1);
	struct accel_row room[ACCEL_BAND_ROWS];
	struct band band;
	int err = 0;

	band.first = number_max(setup->first, bin->visible.y0);
	for (; band.first < end && !err; band.first = band.end) {
		band.end = (band.first / bin->tile_size + 1) * bin->tile_size;
		band.end = number_min(band.end, end);
		band.row = accel_setup_rows(setup, band.first, band.end, room);
		err = bin_band_draw(bin, triangle, &band);
	}
	return err;
}

/* ---- parts ---- */

int accel_bin_part_begin(struct accel_bin *part, const struct accel_bin *bin)
{
	int err = 0;

	if (part->frame != bin->frame)
		err = accel_bin_begin(part, bin->width, bin->height);
	if (err)
		return err;
	part->frame = bin->frame;
	part->state = bin->state;
	part->visible = bin->visible;
	part->states++;
	return 0;
}

/* Moves the records of a part's tile, which all have one state, behind those of the bin's. */
static int bin_tile_append(struct accel_bin *bin, struct accel_tile *tile,
			   const struct accel_tile *part)
{
	uint32_t packets[ACCEL_STATE_WORDS], *words = packets;

	if (tile->drawn && accel_bin_packets(packets, &tile->now, &part->first)) {
		words = bin_tile_room(bin, tile, ACCEL_STATE_WORDS);
		if (!words)
			return -ENOMEM;
	}
	bin_tile_state(bin, tile, words, &part->first);
	tile->uses_colour |= part->uses_colour;
	tile->uses_depth |= part->uses_depth;
	tile->writes_depth |= part->writes_depth;
	if (tile->last)
		tile->last->next = part->chunk;
	else
		tile->chunk = part->chunk;
	tile->last = part->last;
	tile->words += part->words;
	return 0;
}

int accel_bin_append(struct accel_bin *bin, struct accel_bin *part)
{
	struct accel_tile *from, *next;
	int err = 0;

	for (from = part->drawn; from; from = next) {
		next = from->next;
		if (!err)
			err = bin_tile_append(bin, &bin->tile[from - part->tile], from);
		*from = (struct accel_tile){ .drawn = false };
	}
	part->drawn = NULL;
	bin->records += part->records;
	part->records = 0;
	return err;
}
