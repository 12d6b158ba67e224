/* SPDX-License-Identifier: MIT */
/* Pixels of a target as an X server has them. */
#ifndef GLOSS_FORMAT_H
#define GLOSS_FORMAT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gloss_format {
	uint32_t red, green, blue; /* bits of a pixel, each one run of 1 to 8 of them */
	uint32_t alpha;            /* the pixel's other bits that the window has */
	unsigned int bytes;        /* of a pixel: 1 to 4 */
	bool big_endian;
};

/* Whether red, green and blue are as told above. */
bool gloss_format_valid(const struct gloss_format *format);
/* Writes @count pixels of four bytes R, G, B, A as @format says. @to may be @from. */
void gloss_format_row(const struct gloss_format *format, const uint8_t *from, uint8_t *to,
		      size_t count);

#endif
