/* SPDX-License-Identifier: MIT */
/* A triangle's surfaces prepared for its rows, and the pixels worked out from that. */
#ifndef ACCEL_MODEL_SHADE_H
#define ACCEL_MODEL_SHADE_H

#include "lanes.h"

/*
 * Pixel n of row k of a channel is i[k] + n*dx[k] + bend[n], where bend is
 * n(n-1)/2*dxx. Depth has 40 bits, which are kept in two: bits 39:8 in z, which
 * wrap as the register does, and bits 7:0 in z_low.
 */
struct model_shading {
	struct model_channel {
		uint32_t i[MODEL_TILE_MAX], dx[MODEL_TILE_MAX];
		uint32_t bend[MODEL_TILE_MAX];
	} red, green, blue, alpha;
	bool alpha_constant; /* then it is this, in its place in the word */
	uint32_t alpha_word;
	uint32_t z[MODEL_TILE_MAX], z_low[MODEL_TILE_MAX];       /* of row k */
	uint32_t rise[MODEL_TILE_MAX], rise_low[MODEL_TILE_MAX]; /* n*dx */
};

/* Prepares @shading for the rows in @spans. */
void model_shade_begin(struct model_shading *shading, const struct model_triangle *triangle,
		       int anchor_x, const struct model_spans *spans);

/* A row's own numbers, out of the arrays, so that a loop over its pixels keeps them. */
struct model_row {
	uint32_t red, red_dx;
	uint32_t green, green_dx;
	uint32_t blue, blue_dx;
	uint32_t alpha, alpha_dx;
	uint32_t z, z_low;
};

MODEL_INLINE struct model_row model_shade_row(const struct model_shading *s, int k)
{
	return (struct model_row){
		.red = s->red.i[k],
		.red_dx = s->red.dx[k],
		.green = s->green.i[k],
		.green_dx = s->green.dx[k],
		.blue = s->blue.i[k],
		.blue_dx = s->blue.dx[k],
		.alpha = s->alpha.i[k],
		.alpha_dx = s->alpha.dx[k],
		.z = s->z[k],
		.z_low = s->z_low[k],
	};
}

/* n(n-1)/2: one of the factors is even, so nothing is lost. */
MODEL_INLINE uint32_t model_shade_pairs(int32_t n)
{
	return (uint32_t)((n * (n - 1)) >> 1);
}

MODEL_INLINE uint32_t model_shade_level(uint32_t value)
{
	return model_clamp((int32_t)value >> GLOSS_COLOUR_FRACTION, 255);
}

/* Colour of pixel @n; @alpha_constant is s->alpha_constant, known to the loop. */
MODEL_INLINE uint32_t model_shade_colour(const struct model_shading *s, const struct model_row *row,
					 int n, bool alpha_constant)
{
	uint32_t u = (uint32_t)n;
	uint32_t red = model_shade_level(row->red + u * row->red_dx + s->red.bend[n]);
	uint32_t green = model_shade_level(row->green + u * row->green_dx + s->green.bend[n]);
	uint32_t blue = model_shade_level(row->blue + u * row->blue_dx + s->blue.bend[n]);
	uint32_t colour = red | green << 8 | blue << 16;

	if (alpha_constant)
		return colour | s->alpha_word;
	return colour | model_shade_level(row->alpha + u * row->alpha_dx + s->alpha.bend[n]) << 24;
}

/* The depth that is sent on, of bits 39:8. */
MODEL_INLINE uint32_t model_shade_depth_of(uint32_t z)
{
	return model_clamp((int32_t)z, 0xfffffff) >> (GLOSS_DEPTH_FRACTION - 8);
}

/* Depth of pixel @n: the 32 bits of z have depth_fraction - 8 bits of fraction. */
MODEL_INLINE uint32_t model_shade_depth(const struct model_shading *s, const struct model_row *row,
					int n)
{
	uint32_t carry = (row->z_low + s->rise_low[n]) >> 8;

	return model_shade_depth_of(row->z + s->rise[n] + carry);
}

#endif
