// SPDX-License-Identifier: MIT
/* Depth test and masks. Pixels arrive clipped by the scissor: all of them are covered. */
#include "model.h"

#define DEPTH_BITS 0xffffffu

static bool compare(enum gloss_compare func, uint32_t depth, uint32_t stored)
{
	switch (func) {
	case GLOSS_COMPARE_NEVER:
		return false;
	case GLOSS_COMPARE_LESS:
		return depth < stored;
	case GLOSS_COMPARE_EQUAL:
		return depth == stored;
	case GLOSS_COMPARE_LEQUAL:
		return depth <= stored;
	case GLOSS_COMPARE_GREATER:
		return depth > stored;
	case GLOSS_COMPARE_NOTEQUAL:
		return depth != stored;
	case GLOSS_COMPARE_GEQUAL:
		return depth >= stored;
	default:
		return true;
	}
}

static uint32_t merge(uint32_t old, uint32_t new, uint32_t mask)
{
	return (old & ~mask) | (new & mask);
}

void model_fragment_span(struct model *model, const struct model_span *span,
			 const uint32_t *colour, const uint32_t *depth)
{
	const struct model_state *state = &model->state;
	uint32_t depth_mask = state->depth_write ? DEPTH_BITS : 0;
	int first = span->y * model->tile_size + span->x0;
	uint32_t *stored_colour = model->tile.colour + first;
	uint32_t *stored_depth = model->tile.depth + first;
	int count = span->x1 - span->x0;

	model->counters.covered += (uint32_t)count;
	for (int n = 0; n < count; n++) {
		if (!compare(state->depth_func, depth[n], stored_depth[n] & DEPTH_BITS))
			continue;
		model->counters.passed++;
		stored_depth[n] = merge(stored_depth[n], depth[n], depth_mask);
		stored_colour[n] = merge(stored_colour[n], colour[n], state->colour_mask);
	}
}
