// SPDX-License-Identifier: MIT
/*
 * Surfaces to pixels, in closed form: the core steps from pixel to pixel with
 * additions, and in wrapping arithmetic both give the same bits. Multiplying
 * lets rows, and the pixels of a row, be worked out side by side.
 */
#include "shade.h"

MODEL_INLINE void begin_channel(struct model_channel *restrict channel,
				const struct model_surface *surface,
				const struct model_spans *spans, int anchor_x, int first_row)
{
	const struct model_surface s = *surface;
	int rows = model_lanes(spans->rows), pixels = model_lanes(spans->longest);

	for (int k = 0; k < rows; k++) {
		int32_t u = spans->x0[k] - anchor_x, v = spans->y[k] - first_row;
		uint32_t dx = s.dx + (uint32_t)v * s.dxy;

		channel->i[k] = s.i + (uint32_t)v * s.dy + model_shade_pairs(v) * s.dyy +
				(uint32_t)u * dx + model_shade_pairs(u) * s.dxx;
		channel->dx[k] = dx + (uint32_t)u * s.dxx;
	}
	for (int n = 0; n < pixels; n++)
		channel->bend[n] = model_shade_pairs(n) * s.dxx;
}

/* The low bits of a negative u times dx go below zero: they borrow from z. */
MODEL_INLINE void begin_depth(struct model_shading *restrict shading,
			      const struct model_plane *plane, const struct model_spans *spans,
			      int anchor_x, int first_row)
{
	uint32_t z = (uint32_t)(plane->z >> 8), z_low = plane->z & 0xff;
	uint32_t dx = (uint32_t)(plane->dx >> 8), dx_low = plane->dx & 0xff;
	uint32_t dy = (uint32_t)(plane->dy >> 8), dy_low = plane->dy & 0xff;
	int rows = model_lanes(spans->rows), pixels = model_lanes(spans->longest);

	for (int k = 0; k < rows; k++) {
		uint32_t u = (uint32_t)(spans->x0[k] - anchor_x);
		uint32_t v = (uint32_t)(spans->y[k] - first_row);
		uint32_t low = z_low + u * dx_low + v * dy_low;

		shading->z[k] = z + u * dx + v * dy + (uint32_t)((int32_t)low >> 8);
		shading->z_low[k] = low & 0xff;
	}
	for (int n = 0; n < pixels; n++) {
		shading->rise[n] = (uint32_t)n * dx;
		shading->rise_low[n] = (uint32_t)n * dx_low;
	}
}

MODEL_CLONES
void model_shade_begin(struct model_shading *shading, const struct model_triangle *t, int anchor_x,
		       const struct model_spans *spans)
{
	begin_channel(&shading->red, &t->red, spans, anchor_x, t->first_row);
	begin_channel(&shading->green, &t->green, spans, anchor_x, t->first_row);
	begin_channel(&shading->blue, &t->blue, spans, anchor_x, t->first_row);
	begin_depth(shading, &t->depth, spans, anchor_x, t->first_row);
	shading->alpha_constant = !(t->alpha.dx | t->alpha.dy | t->alpha.dxx | t->alpha.dxy |
				    t->alpha.dyy);
	shading->alpha_word = model_shade_level(t->alpha.i) << 24;
	if (!shading->alpha_constant)
		begin_channel(&shading->alpha, &t->alpha, spans, anchor_x, t->first_row);
}

MODEL_CLONES
void model_shade_span(const struct model_triangle *triangle, int anchor_x,
		      const struct model_span *span, uint32_t *restrict colour,
		      uint32_t *restrict depth)
{
	int count = span->x1 - span->x0;
	struct model_spans spans = { .rows = 1,
				     .longest = count,
				     .y = { span->y },
				     .x0 = { span->x0 },
				     .count = { count } };
	struct model_shading shading;
	struct model_row row;

	model_shade_begin(&shading, triangle, anchor_x, &spans);
	row = model_shade_row(&shading, 0);
	for (int n = 0; n < count; n++) {
		colour[n] = model_shade_colour(&shading, &row, n, shading.alpha_constant);
		depth[n] = model_shade_depth(&shading, &row, n);
	}
}
