/* SPDX-License-Identifier: MIT */
/* What loops that become vector code are written with. */
#ifndef ACCEL_DRAW_LOOP_H
#define ACCEL_DRAW_LOOP_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* Becomes part of each of its callers, which give its last arguments as constants. */
#define LOOP_INLINE static inline __attribute__((always_inline))

/*
 * @which ? @a : @b, of two numbers that are there already. Written as a condition, compilers make a
 * branch of it where they see that one of them need not be worked out, and no vector code then.
 */
LOOP_INLINE uint32_t loop_mask(bool which)
{
	return 0u - (uint32_t)which;
}

LOOP_INLINE float loop_choose(bool which, float a, float b)
{
	const uint32_t mask = loop_mask(which);
	uint32_t of_a, of_b;
	float chosen;

	memcpy(&of_a, &a, sizeof(of_a));
	memcpy(&of_b, &b, sizeof(of_b));
	of_a = (of_a & mask) | (of_b & ~mask);
	memcpy(&chosen, &of_a, sizeof(chosen));
	return chosen;
}

#endif
