// SPDX-License-Identifier: MIT
/*
 * A small triangle's way through raster, shade and fragment: the same bits as in draw.c, for less.
 * It has so few columns that what does not change from row to row is kept for each of them, and rows
 * that are listed need no walk. (Loops over lanes that compilers unroll do not become vector code.)
 */
#include "fragment.h"
#include "shade.h"

/* From index MODEL_LANES - n on: n lanes, and then those that are out. */
static const uint32_t first_lanes[2 * MODEL_LANES] = { [0 ... MODEL_LANES - 1] = ~0u };

/* A channel in MODEL_LANES columns of a row. */
struct channel {
	uint32_t value[MODEL_LANES], step[MODEL_LANES]; /* in the row, and to the next */
	uint32_t bend;                                  /* of steps */
};

/* The same of depths: bits 39:8, and what is below, which is carried into them last. */
struct heights {
	uint32_t z[MODEL_LANES], low[MODEL_LANES];
	uint32_t step, step_low;
};

MODEL_INLINE void channel_begin(struct channel *channel, const struct model_surface *s, int u)
{
	const uint32_t dx = s->dx + (uint32_t)u * s->dxx, dy = s->dy + (uint32_t)u * s->dxy;
	const uint32_t i = s->i + (uint32_t)u * s->dx + model_shade_pairs(u) * s->dxx;

	channel->bend = s->dyy;
#pragma GCC unroll 1
	for (int l = 0; l < MODEL_LANES; l++) {
		channel->value[l] = i + (uint32_t)l * dx + model_shade_pairs(l) * s->dxx;
		channel->step[l] = dy + (uint32_t)l * s->dxy;
	}
}

MODEL_INLINE void channel_next_row(struct channel *channel)
{
#pragma GCC unroll 1
	for (int l = 0; l < MODEL_LANES; l++) {
		channel->value[l] += channel->step[l];
		channel->step[l] += channel->bend;
	}
}

MODEL_INLINE void heights_begin(struct heights *heights, const struct model_plane *plane, int u)
{
	const uint64_t first = plane->z + (uint64_t)u * plane->dx;
	const uint32_t z = (uint32_t)(first >> 8), low = first & 0xff;
	const uint32_t dx = (uint32_t)(plane->dx >> 8), dx_low = plane->dx & 0xff;

	heights->step = (uint32_t)(plane->dy >> 8);
	heights->step_low = plane->dy & 0xff;
#pragma GCC unroll 1
	for (int l = 0; l < MODEL_LANES; l++) {
		heights->z[l] = z + (uint32_t)l * dx;
		heights->low[l] = low + (uint32_t)l * dx_low;
	}
}

MODEL_INLINE void heights_next_row(struct heights *heights)
{
#pragma GCC unroll 1
	for (int l = 0; l < MODEL_LANES; l++) {
		heights->z[l] += heights->step;
		heights->low[l] += heights->step_low;
	}
}

/* The lanes, of those from column @x on, that a row has pixels in: from x0 to before x1. */
MODEL_INLINE struct model_span row_span(const struct model_triangle *triangle,
					const struct model_scissor *scissor, int row, int x)
{
	const int first = triangle->x + (triangle->row[row] & 15);
	const int end = triangle->x + (triangle->row[row] >> 4) + 1;
	const int y = triangle->first_row + row;
	const int left = (first > scissor->x0 ? first : scissor->x0) - x;
	const int right = (end < scissor->x1 ? end : scissor->x1) - x;
	struct model_span span = {
		.y = y,
		.x0 = left < MODEL_LANES ? left : MODEL_LANES,
		.x1 = right < MODEL_LANES ? right : MODEL_LANES,
	};

	span.x0 = span.x0 > 0 ? span.x0 : 0;
	span.x1 = span.x1 > span.x0 && y >= scissor->y0 && y < scissor->y1 ? span.x1 : span.x0;
	return span;
}

/* MODEL_LANES columns of the tile, in a row. */
struct columns {
	int x; /* the first */
	struct channel red, green, blue;
	uint32_t alpha; /* in its place in the word */
	struct heights heights;
	struct model_test test;
	uint32_t passed[MODEL_LANES];
};

MODEL_INLINE void columns_begin(struct columns *columns, const struct model *model,
				const struct model_triangle *triangle, int x)
{
	const int u = x - model_raster_anchor(triangle, model->tile_size);

	columns->x = x;
	columns->alpha = model_shade_level(triangle->alpha.i) << 24;
	columns->test = model_fragment_test(&model->state);
	channel_begin(&columns->red, &triangle->red, u);
	channel_begin(&columns->green, &triangle->green, u);
	channel_begin(&columns->blue, &triangle->blue, u);
	heights_begin(&columns->heights, &triangle->depth, u);
#pragma GCC unroll 1
	for (int l = 0; l < MODEL_LANES; l++)
		columns->passed[l] = 0;
}

MODEL_INLINE void columns_next_row(struct columns *columns)
{
	channel_next_row(&columns->red);
	channel_next_row(&columns->green);
	channel_next_row(&columns->blue);
	heights_next_row(&columns->heights);
}

/* Draws those lanes of the row that are in @span, which may have none. */
MODEL_INLINE void columns_draw(struct columns *columns, struct model *model,
			       const struct model_span *span)
{
	const uint32_t *before = first_lanes + MODEL_LANES - span->x0;
	const uint32_t *inside = first_lanes + MODEL_LANES - span->x1;
	const int at = span->y * model->tile_size + columns->x;
	uint32_t *restrict colour = model->tile.colour + at;
	uint32_t *restrict depth = model->tile.depth + at;
	const struct heights *heights = &columns->heights;

#pragma GCC unroll 1
	for (int l = 0; l < MODEL_LANES; l++)
		columns->passed[l] -= model_fragment_pixel(
			&columns->test, inside[l] & ~before[l],
			model_shade_level(columns->red.value[l]) |
				model_shade_level(columns->green.value[l]) << 8 |
				model_shade_level(columns->blue.value[l]) << 16 | columns->alpha,
			model_shade_depth_of(heights->z[l] + (heights->low[l] >> 8)), &colour[l],
			&depth[l]);
	model->counters.covered += (uint32_t)(span->x1 - span->x0);
}

MODEL_INLINE void draw_columns(struct model *model, const struct model_triangle *triangle, int x)
{
	const struct model_scissor scissor = model->state.scissor;
	struct columns columns;

	columns_begin(&columns, model, triangle, x);
	for (int row = 0; row <= triangle->last_row; row++) {
		const struct model_span span = row_span(triangle, &scissor, row, x);

		columns_draw(&columns, model, &span);
		columns_next_row(&columns);
	}
	for (int l = 0; l < MODEL_LANES; l++)
		model->counters.passed += columns.passed[l];
}

MODEL_CLONES
void model_draw_small(struct model *model, const struct model_triangle *triangle)
{
	const int x = triangle->x, end = model->state.scissor.x1;
	unsigned int last = 0; /* bits of the last columns of rows */

	for (int row = 0; row <= triangle->last_row; row++)
		last |= triangle->row[row] >> 4;
	if (x < end)
		draw_columns(model, triangle, x);
	if (last >= MODEL_LANES && x + MODEL_LANES < end)
		draw_columns(model, triangle, x + MODEL_LANES);
	model->counters.triangles++;
}
