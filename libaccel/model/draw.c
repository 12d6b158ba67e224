// SPDX-License-Identifier: MIT
/*
 * A triangle's way through raster, shade and fragment. Its pixels are taken in
 * blocks of MODEL_LANES in one loop over all rows: a loop in a loop would be
 * left once a row at a place the processor can not foresee, which for small
 * triangles costs as much as their pixels.
 */
#include "fragment.h"
#include "shade.h"

/* From index MODEL_TILE_MAX - n on: as many lanes that are in as there are pixels left. */
static const uint32_t inside_lanes[MODEL_TILE_MAX + MODEL_LANES] = { [0 ... MODEL_TILE_MAX -
								      1] = ~0u };

/* Returns the number of pixels that passed. */
MODEL_INLINE uint32_t draw_blocks(struct model *model, const struct model_spans *spans,
				  const struct model_shading *shading, bool alpha_constant)
{
	const struct model_test test = model_fragment_test(&model->state);
	uint32_t passed[MODEL_LANES] = { 0 }, sum = 0;
	int k = 0, first = 0;

	for (int block = 0; block < spans->blocks; block++) {
		const struct model_row row = model_shade_row(shading, k);
		const uint32_t *inside = inside_lanes + MODEL_TILE_MAX - (spans->count[k] - first);
		int at = spans->y[k] * model->tile_size + spans->x0[k] + first;
		uint32_t *restrict colour = model->tile.colour + at;
		uint32_t *restrict depth = model->tile.depth + at;
		int last;

		for (int l = 0; l < MODEL_LANES; l++)
			passed[l] -= model_fragment_pixel(
				&test, inside[l],
				model_shade_colour(shading, &row, first + l, alpha_constant),
				model_shade_depth(shading, &row, first + l), &colour[l], &depth[l]);
		first += MODEL_LANES;
		last = first >= spans->count[k];
		first = last ? 0 : first;
		k += last;
	}
	for (int l = 0; l < MODEL_LANES; l++)
		sum += passed[l];
	return sum;
}

MODEL_CLONES
void model_draw_triangle(struct model *model, const struct model_triangle *triangle)
{
	struct model_spans spans;
	struct model_shading shading;
	int anchor = model_raster_anchor(triangle, model->tile_size);

	model_raster_spans(triangle, &model->state.scissor, &spans);
	model_shade_begin(&shading, triangle, anchor, &spans);
	if (shading.alpha_constant)
		model->counters.passed += draw_blocks(model, &spans, &shading, true);
	else
		model->counters.passed += draw_blocks(model, &spans, &shading, false);
	model->counters.covered += (uint32_t)spans.pixels;
	model->counters.triangles++;
}
