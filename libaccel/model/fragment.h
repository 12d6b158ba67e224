/* SPDX-License-Identifier: MIT */
/* What happens to one pixel that is covered. */
#ifndef ACCEL_MODEL_FRAGMENT_H
#define ACCEL_MODEL_FRAGMENT_H

#include "lanes.h"

#define MODEL_DEPTH_BITS 0xffffffu

/*
 * The depth function as an interval: a pixel passes if new - stored + bias is
 * below limit, unsigned. Both are kept with bit 31 turned over, because lanes
 * compare signed.
 */
struct model_test {
	uint32_t bias;
	int32_t limit;
	uint32_t depth_mask, colour_mask; /* bits that are written */
};

struct model_test model_fragment_test(const struct model_state *state);

/*
 * Tests and merges a pixel if @inside is all ones, not if it is zero. Returns
 * all ones if it passed, else zero.
 */
MODEL_INLINE uint32_t model_fragment_pixel(const struct model_test *test, uint32_t inside,
					   uint32_t colour, uint32_t depth, uint32_t *stored_colour,
					   uint32_t *stored_depth)
{
	uint32_t difference = depth - (*stored_depth & MODEL_DEPTH_BITS);
	uint32_t pass = (int32_t)(difference + test->bias) < test->limit ? ~0u : 0;

	pass &= inside;
	*stored_depth ^= (*stored_depth ^ depth) & pass & test->depth_mask;
	*stored_colour ^= (*stored_colour ^ colour) & pass & test->colour_mask;
	return pass;
}

#endif
