/* SPDX-License-Identifier: MIT */
/*
 * A stream that makes board memory zero: it sees slot 0 as a surface as wide as one tile, begins
 * each tile of it cleared, and stores it. For boards whose memory the library hands out itself.
 */
#ifndef ACCEL_CLEAR_H
#define ACCEL_CLEAR_H

#include <stdint.h>

#define ACCEL_CLEAR_START_WORDS 2
#define ACCEL_CLEAR_TILE_WORDS 6

/* Bytes that a tile is in memory; a slot to be cleared is a multiple of it. */
static inline uint32_t accel_clear_tile_bytes(uint32_t tile_size)
{
	return tile_size * tile_size * 4;
}

/* Words of a stream that clears @tiles. */
static inline uint32_t accel_clear_words(uint32_t tiles)
{
	return ACCEL_CLEAR_START_WORDS + tiles * ACCEL_CLEAR_TILE_WORDS;
}

/* Packs it into @words. */
void accel_clear_pack(uint32_t *words, uint32_t tile_size, uint32_t tiles);

#endif
