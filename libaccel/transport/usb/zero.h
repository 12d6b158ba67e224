/* SPDX-License-Identifier: MIT */
/*
 * A stream that makes board memory zero: it sees slot 0 as a surface as wide as one tile, begins
 * each tile of it cleared, and stores it. For boards whose memory the library hands out itself.
 */
#ifndef ACCEL_USB_ZERO_H
#define ACCEL_USB_ZERO_H

#include <stdint.h>

#define USB_ZERO_START_WORDS 2
#define USB_ZERO_TILE_WORDS 6

/* Bytes that a tile is in memory; a slot to be cleared is a multiple of it. */
static inline uint32_t accel_usb_zero_tile_bytes(uint32_t tile_size)
{
	return tile_size * tile_size * 4;
}

/* Words of a stream that clears @tiles. */
static inline uint32_t accel_usb_zero_words(uint32_t tiles)
{
	return USB_ZERO_START_WORDS + tiles * USB_ZERO_TILE_WORDS;
}

/* Packs it into @words. */
void accel_usb_zero_pack(uint32_t *words, uint32_t tile_size, uint32_t tiles);

#endif
