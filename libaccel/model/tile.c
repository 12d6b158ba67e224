// SPDX-License-Identifier: MIT
/* The pixels of the open tile, and their way from and to surfaces. */
#include <string.h>

#include "lanes.h"

MODEL_CLONES
static void clear(const struct model *model, uint32_t *pixels, uint32_t value)
{
	const int count = model->tile_size * model->tile_size; /* which @pixels might be part of */

	for (int n = 0; n < count; n++)
		pixels[n] = value;
}

static void load(const struct model *model, const struct model_target *target, uint32_t offset,
		 uint32_t *pixels)
{
	for (int y = 0; y < model->tile_size; y++)
		model_memory_read(model, target->slot, offset + (uint32_t)y * target->pitch,
				  pixels + y * model->tile_size, (uint32_t)model->tile_size);
}

static void store(struct model *model, const struct model_target *target, uint32_t offset,
		  const uint32_t *pixels)
{
	for (int y = 0; y < model->tile_size; y++)
		model_memory_write(model, target->slot, offset + (uint32_t)y * target->pitch,
				   pixels + y * model->tile_size, (uint32_t)model->tile_size);
}

void model_tile_begin(struct model *model, const struct gloss_tile_begin *begin)
{
	if (begin->colour_load)
		load(model, &model->state.colour_surface, begin->colour, model->tile.colour);
	else
		clear(model, model->tile.colour, begin->colour);
	if (begin->depth_load)
		load(model, &model->state.depth_surface, begin->depth, model->tile.depth);
	else
		clear(model, model->tile.depth, begin->depth);
}

static void output(struct model *model, enum gloss_tile_output output,
		   const struct model_target *target, uint32_t offset, const uint32_t *pixels)
{
	uint32_t words = (uint32_t)(model->tile_size * model->tile_size);

	if (output == GLOSS_TILE_OUTPUT_STORE)
		store(model, target, offset, pixels);
	else if (output == GLOSS_TILE_OUTPUT_ANSWER)
		memcpy(model_memory_answer(model, words), pixels, sizeof(*pixels) * words);
}

/* Colour first: it is answered before depth, and where the two overlap in memory depth stays. */
void model_tile_end(struct model *model, const struct gloss_tile_end *end)
{
	output(model, end->colour_output, &model->state.colour_surface, end->colour,
	       model->tile.colour);
	output(model, end->depth_output, &model->state.depth_surface, end->depth,
	       model->tile.depth);
}
