// SPDX-License-Identifier: MIT
/* Depth test and masks. Pixels arrive clipped by the scissor: all of them are covered. */
#include "fragment.h"

#define SIGN (1u << 31)
#define RANGE (MODEL_DEPTH_BITS + 1) /* more than any difference of two depths */

/* new - stored is -RANGE < d < RANGE. */
static const struct {
	uint32_t bias, limit;
} interval[] = {
	[GLOSS_COMPARE_NEVER] = { 0, 0 },         [GLOSS_COMPARE_LESS] = { RANGE, RANGE },
	[GLOSS_COMPARE_EQUAL] = { 0, 1 },         [GLOSS_COMPARE_LEQUAL] = { RANGE, RANGE + 1 },
	[GLOSS_COMPARE_GREATER] = { ~0u, RANGE }, [GLOSS_COMPARE_NOTEQUAL] = { ~0u, ~0u },
	[GLOSS_COMPARE_GEQUAL] = { 0, RANGE },    [GLOSS_COMPARE_ALWAYS] = { RANGE, 2 * RANGE },
};

struct model_test model_fragment_test(const struct model_state *state)
{
	return (struct model_test){
		.bias = interval[state->depth_func].bias ^ SIGN,
		.limit = (int32_t)(interval[state->depth_func].limit ^ SIGN),
		.depth_mask = state->depth_write ? MODEL_DEPTH_BITS : 0,
		.colour_mask = state->colour_mask,
	};
}

void model_fragment_span(struct model *model, const struct model_span *span, const uint32_t *colour,
			 const uint32_t *depth)
{
	const struct model_test test = model_fragment_test(&model->state);
	int first = span->y * model->tile_size + span->x0, count = span->x1 - span->x0;

	for (int n = 0; n < count; n++)
		model->counters.passed -= model_fragment_pixel(&test, ~0u, colour[n], depth[n],
							       &model->tile.colour[first + n],
							       &model->tile.depth[first + n]);
	model->counters.covered += (uint32_t)count;
}
