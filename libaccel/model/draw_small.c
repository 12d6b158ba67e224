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

/* A channel in a row, from the first of some columns on. */
struct channel {
	uint32_t i, dx;
	uint32_t dy, dyy, dxy; /* to the next row */
	uint32_t bend[MODEL_LANES];
};

/* The low byte of depths, and the bits above it, which carry into each other. */
struct heights {
	uint64_t z, dy; /* of the first column; to the next row */
	uint32_t rise[MODEL_LANES], rise_low[MODEL_LANES];
};

MODEL_INLINE void channel_begin(struct channel *channel, const struct model_surface *s, int u)
{
	channel->i = s->i + (uint32_t)u * s->dx + model_shade_pairs(u) * s->dxx;
	channel->dx = s->dx + (uint32_t)u * s->dxx;
	channel->dy = s->dy + (uint32_t)u * s->dxy;
	channel->dyy = s->dyy;
	channel->dxy = s->dxy;
#pragma GCC unroll 1
	for (int l = 0; l < MODEL_LANES; l++)
		channel->bend[l] = model_shade_pairs(l) * s->dxx;
}

MODEL_INLINE void channel_next_row(struct channel *channel)
{
	channel->i += channel->dy;
	channel->dx += channel->dxy;
	channel->dy += channel->dyy;
}

MODEL_INLINE uint32_t channel_level(const struct channel *channel, int l)
{
	return model_shade_level(channel->i + (uint32_t)l * channel->dx + channel->bend[l]);
}

MODEL_INLINE void heights_begin(struct heights *heights, const struct model_plane *plane, int u)
{
	const uint32_t dx = (uint32_t)(plane->dx >> 8), dx_low = plane->dx & 0xff;

	heights->z = plane->z + (uint64_t)u * plane->dx;
	heights->dy = plane->dy;
#pragma GCC unroll 1
	for (int l = 0; l < MODEL_LANES; l++) {
		heights->rise[l] = (uint32_t)l * dx;
		heights->rise_low[l] = (uint32_t)l * dx_low;
	}
}

MODEL_INLINE uint32_t heights_depth(const struct heights *heights, int l)
{
	const uint32_t z = (uint32_t)(heights->z >> 8), z_low = heights->z & 0xff;

	return model_shade_depth_of(z + heights->rise[l] + ((z_low + heights->rise_low[l]) >> 8));
}

/* The pixels that a row has in columns @x to @x + MODEL_LANES - 1, counted from there. */
MODEL_INLINE struct model_span row_span(const struct model_triangle *triangle,
					const struct model_scissor *scissor, int row, int x)
{
	const int first = triangle->x + (triangle->row[row] & 15);
	const int end = triangle->x + (triangle->row[row] >> 4) + 1;
	const int left = (first > scissor->x0 ? first : scissor->x0) - x;
	const int right = (end < scissor->x1 ? end : scissor->x1) - x;

	return (struct model_span){
		.y = triangle->first_row + row,
		.x0 = left > 0 ? left : 0,
		.x1 = right < MODEL_LANES ? right : MODEL_LANES,
	};
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
	columns->heights.z += columns->heights.dy;
}

/* Draws those of lanes x0 to x1 - 1 of @span. */
MODEL_INLINE void columns_draw(struct columns *columns, struct model *model,
			       const struct model_span *span)
{
	const uint32_t *before = first_lanes + MODEL_LANES - span->x0;
	const uint32_t *inside = first_lanes + MODEL_LANES - span->x1;
	const int at = span->y * model->tile_size + columns->x;
	uint32_t *restrict colour = model->tile.colour + at;
	uint32_t *restrict depth = model->tile.depth + at;

#pragma GCC unroll 1
	for (int l = 0; l < MODEL_LANES; l++)
		columns->passed[l] -= model_fragment_pixel(
			&columns->test, inside[l] & ~before[l],
			channel_level(&columns->red, l) | channel_level(&columns->green, l) << 8 |
				channel_level(&columns->blue, l) << 16 | columns->alpha,
			heights_depth(&columns->heights, l), &colour[l], &depth[l]);
	model->counters.covered += (uint32_t)(span->x1 - span->x0);
}

MODEL_INLINE void draw_columns(struct model *model, const struct model_triangle *triangle, int x)
{
	const struct model_scissor scissor = model->state.scissor;
	struct columns columns;

	columns_begin(&columns, model, triangle, x);
	for (int row = 0; row <= triangle->last_row; row++) {
		const struct model_span span = row_span(triangle, &scissor, row, x);

		if (span.x0 < span.x1 && span.y >= scissor.y0 && span.y < scissor.y1)
			columns_draw(&columns, model, &span);
		columns_next_row(&columns);
	}
	for (int l = 0; l < MODEL_LANES; l++)
		model->counters.passed += columns.passed[l];
}

MODEL_CLONES
void model_draw_small(struct model *model, const struct model_triangle *triangle)
{
	int columns = 0, end;

#pragma GCC unroll 1
	for (int row = 0; row <= triangle->last_row; row++)
		columns = triangle->row[row] >> 4 > columns ? triangle->row[row] >> 4 : columns;
	end = triangle->x + columns + 1;
	end = end < model->state.scissor.x1 ? end : model->state.scissor.x1;
	for (int x = triangle->x; x < end; x += MODEL_LANES)
		draw_columns(model, triangle, x);
	model->counters.triangles++;
}
