// SPDX-License-Identifier: MIT
#include "window/format.h"

#include <string.h>

#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define HOST_IS_BIG true
#else
#define HOST_IS_BIG false
#endif

/* How the eight bits of a channel get to their place: shifted right, then left. */
struct channel {
	unsigned int lose, place;
};

static struct channel format_channel(uint32_t mask)
{
	unsigned int place = (unsigned int)__builtin_ctz(mask);

	return (struct channel){ .lose = 8 - (unsigned int)__builtin_popcount(mask),
				 .place = place };
}

static bool format_run(uint32_t mask)
{
	uint32_t low = mask ? mask >> __builtin_ctz(mask) : 0;

	return mask && low <= 0xff && !(low & (low + 1));
}

bool gloss_format_valid(const struct gloss_format *format)
{
	return format->bytes >= 1 && format->bytes <= 4 && format_run(format->red) &&
	       format_run(format->green) && format_run(format->blue);
}

/* The bits besides the colours: an alpha of eight bits is the pixel's, others are set. */
static uint32_t format_rest(const struct gloss_format *format, uint8_t alpha)
{
	if (format->alpha >> 24 == 0xff && !(format->alpha & 0xffffff))
		return (uint32_t)alpha << 24;
	return format->alpha;
}

static void format_store(const struct gloss_format *format, uint32_t pixel, uint8_t *to)
{
	for (unsigned int byte = 0; byte < format->bytes; byte++) {
		unsigned int shift = format->big_endian ? 8 * (format->bytes - 1 - byte) : 8 * byte;

		to[byte] = (uint8_t)(pixel >> shift);
	}
}

void gloss_format_row(const struct gloss_format *format, const uint8_t *from, uint8_t *to,
		      size_t count)
{
	struct channel red = format_channel(format->red), green = format_channel(format->green),
		       blue = format_channel(format->blue);
	bool words = format->bytes == 4 && format->big_endian == HOST_IS_BIG;

	for (size_t i = 0; i < count; i++, from += 4, to += format->bytes) {
		uint32_t pixel = (uint32_t)(from[0] >> red.lose) << red.place |
				 (uint32_t)(from[1] >> green.lose) << green.place |
				 (uint32_t)(from[2] >> blue.lose) << blue.place |
				 format_rest(format, from[3]);

		if (words)
			memcpy(to, &pixel, 4);
		else
			format_store(format, pixel, to);
	}
}
