// SPDX-License-Identifier: MIT
/*
 * Surfaces to pixels, in closed form: the core steps from pixel to pixel with
 * additions, and in wrapping arithmetic both give the same bits.
 */
#include "model.h"

/* u(u-1)/2 of any pixel offset, exact before it wraps. */
static uint32_t pairs(int32_t u)
{
	return (uint32_t)(u * (u - 1) / 2);
}

static uint32_t channel(const struct model_surface *s, int32_t u, int32_t v)
{
	uint32_t value = s->i + (uint32_t)u * s->dx + pairs(u) * s->dxx + (uint32_t)v * s->dy +
			 pairs(v) * s->dyy + (uint32_t)(u * v) * s->dxy;
	int32_t level = (int32_t)value >> GLOSS_COLOUR_FRACTION;

	return level < 0 ? 0 : level > 255 ? 255 : (uint32_t)level;
}

static uint32_t plane(const struct model_plane *p, int32_t u, int32_t v)
{
	uint64_t value = p->z + (uint64_t)(int64_t)u * p->dx + (uint64_t)(int64_t)v * p->dy;
	int32_t level = (int32_t)((int64_t)(value << 24) >> (24 + GLOSS_DEPTH_FRACTION));

	return level < 0 ? 0 : level > 0xffffff ? 0xffffff : (uint32_t)level;
}

void model_shade_span(const struct model_triangle *triangle, int anchor_x,
		      const struct model_span *span, uint32_t *colour, uint32_t *depth)
{
	int32_t v = span->y - triangle->first_row;

	for (int x = span->x0; x < span->x1; x++) {
		int32_t u = x - anchor_x;

		colour[x - span->x0] = channel(&triangle->red, u, v) |
				       channel(&triangle->green, u, v) << 8 |
				       channel(&triangle->blue, u, v) << 16 |
				       channel(&triangle->alpha, u, v) << 24;
		depth[x - span->x0] = plane(&triangle->depth, u, v);
	}
}
