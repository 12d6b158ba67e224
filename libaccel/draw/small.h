/* SPDX-License-Identifier: MIT */
/* The numbers of TRIANGLE_SMALL: bits of their fields, and what a scale shifts them by. */
#ifndef ACCEL_DRAW_SMALL_H
#define ACCEL_DRAW_SMALL_H

#include <stdint.h>

#include "gloss_packets.h"

/* Of each kind of scale. */
#define SMALL_SCALES 4

#define SMALL_DEPTH_BITS 15
#define SMALL_SLOPE_BITS 12
#define SMALL_BEND_BITS 10

static inline unsigned int small_depth_shift(unsigned int scale)
{
	return GLOSS_SMALL_DEPTH_SHIFT + scale * GLOSS_SMALL_DEPTH_SCALE_SHIFT;
}

static inline unsigned int small_slope_shift(unsigned int scale)
{
	return GLOSS_SMALL_SLOPE_SHIFT + scale * GLOSS_SMALL_SLOPE_SCALE_SHIFT;
}

static inline unsigned int small_bend_shift(unsigned int scale)
{
	return GLOSS_SMALL_BEND_SHIFT + scale * GLOSS_SMALL_BEND_SCALE_SHIFT;
}

/* Bits that a signed number needs beside its sign; or-ed, those that several need. */
static inline uint32_t small_magnitude(uint32_t value)
{
	return value >> 31 ? ~value : value;
}

#endif
