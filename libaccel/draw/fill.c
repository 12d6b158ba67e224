// SPDX-License-Identifier: MIT
/* Tiles and parts of tiles that get one colour and depth. */
#include <errno.h>

#include "draw/bin.h"

static int fill_tile(struct accel_bin *bin, struct accel_tile *tile,
		     const struct accel_tile_state *state, uint32_t colour, uint32_t depth)
{
	struct accel_bin_room room;
	int err = accel_bin_begin_record(bin, tile, state, &room);

	if (!err)
		accel_bin_end_record(&room, accel_record_fill(room.words, colour, depth));
	return err;
}

int accel_bin_clear(struct accel_bin *bin, const struct accel_tile_clear *clear)
{
	const bool colour = clear->mask & ACCEL_CLEAR_COLOUR,
		   depth = clear->mask & ACCEL_CLEAR_DEPTH;
	struct accel_tile_state state;
	int err = 0;

	if (colour && depth) {
		accel_bin_forget(bin);
		bin->clear = *clear;
		return 0;
	}
	accel_bin_tests(&state, ACCEL_COMPARE_ALWAYS, depth,
			(const bool[4]){ colour, colour, colour, colour });
	state.scissor = accel_bin_scissor(0, 0, bin->tile_size, bin->tile_size);
	/* A tile that was drawn on already is cleared by drawing. */
	for (int i = 0; i < bin->columns * bin->rows && !err; i++)
		if (bin->tile[i].drawn)
			err = fill_tile(bin, &bin->tile[i], &state, clear->colour, clear->depth);
	if (err)
		return err;
	bin->clear.mask |= clear->mask;
	if (colour)
		bin->clear.colour = clear->colour;
	if (depth)
		bin->clear.depth = clear->depth;
	return 0;
}

int accel_bin_fill(struct accel_bin *bin, const struct accel_bounds *box,
		   const struct accel_tile_state *given, uint32_t colour, uint32_t depth)
{
	const int size = bin->tile_size;
	struct accel_tile_state state = *given;
	int err = 0;

	for (int y = box->y0 / size; y * size < box->y1; y++)
		for (int x = box->x0 / size; x * size < box->x1 && !err; x++) {
			state.scissor = accel_bin_tile_scissor(bin, box, x * size, y * size);
			err = fill_tile(bin, &bin->tile[y * bin->columns + x], &state, colour,
					depth);
		}
	return err;
}
