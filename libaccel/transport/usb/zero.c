// SPDX-License-Identifier: MIT
#include "transport/usb/zero.h"

#include "gloss_packets.h"

_Static_assert(USB_ZERO_START_WORDS == 1 + GLOSS_COLOUR_SURFACE_WORDS, "start of the stream");
_Static_assert(USB_ZERO_TILE_WORDS == 2 + GLOSS_TILE_BEGIN_WORDS + GLOSS_TILE_END_WORDS,
	       "a tile of the stream");

void accel_usb_zero_pack(uint32_t *words, uint32_t tile_size, uint32_t tiles)
{
	const struct gloss_colour_surface surface = { .slot = 0, .pitch = tile_size * 4 };
	const struct gloss_tile_begin begin = { .colour = 0 };
	struct gloss_tile_end end = { .colour_output = GLOSS_TILE_OUTPUT_STORE };

	gloss_colour_surface_pack(words, &surface);
	words += 1 + GLOSS_COLOUR_SURFACE_WORDS;
	while (tiles--) {
		gloss_tile_begin_pack(words, &begin);
		words += 1 + GLOSS_TILE_BEGIN_WORDS;
		gloss_tile_end_pack(words, &end);
		words += 1 + GLOSS_TILE_END_WORDS;
		end.colour += accel_usb_zero_tile_bytes(tile_size);
	}
}
