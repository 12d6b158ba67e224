/* SPDX-License-Identifier: MIT */
/*
 * Coefficients of small triangles, rounded to what TRIANGLE_SMALL holds, and packed; a part of
 * kernel_loops.h. Why they are rounded so is in small.c.
 */
#include "draw/kernel.h"
#include "draw/loop.h"
#include "draw/small.h"

/* What rounding may change in a colour, a quarter of a level. */
#define SMALL_ERROR_MAX ((float)(1 << (GLOSS_COLOUR_FRACTION - 2)))
/* Pixels farther away than this, at the least of scales, are changed by more. */
#define SMALL_REACH_MAX 128

/* All of it wraps, as what the core does with it. */
LOOP_INLINE uint32_t loop_round(uint32_t value, unsigned int shift)
{
	return (value + (1u << (shift - 1))) & -(1u << shift);
}

LOOP_INLINE uint32_t loop_magnitude(uint32_t value)
{
	return value ^ -(value >> 31);
}

LOOP_INLINE uint32_t loop_choose_word(uint32_t mask, uint32_t a, uint32_t b)
{
	return (a & mask) | (b & ~mask);
}

/* n (n - 1) / 2, of numbers in whose neighbourhood a triangle is small. */
LOOP_INLINE uint32_t loop_pairs(uint32_t n)
{
	return n * (n - 1) >> 1;
}

/*
 * The second differences of a channel, to the least scale that fits. Returns half of its unit; 0:
 * they are too large.
 */
LOOP_INLINE uint32_t loop_round_bends(struct accel_surface *s)
{
	const struct accel_surface given = *s;
	uint32_t half = 0;

#pragma GCC unroll 4
	for (int i = 0; i < SMALL_SCALES; i++) {
		const unsigned int shift = small_bend_shift(SMALL_SCALES - 1 - (unsigned int)i);
		uint32_t xx = loop_round(given.dxx, shift), xy = loop_round(given.dxy, shift);
		uint32_t yy = loop_round(given.dyy, shift), fits;

		fits = loop_mask(!((loop_magnitude(xx) | loop_magnitude(xy) | loop_magnitude(yy)) >>
				   (shift + SMALL_BEND_BITS - 1)));
		s->dxx = loop_choose_word(fits, xx, s->dxx);
		s->dxy = loop_choose_word(fits, xy, s->dxy);
		s->dyy = loop_choose_word(fits, yy, s->dyy);
		half = loop_choose_word(fits, 1u << (shift - 1), half);
	}
	return half;
}

/* The first differences of all channels, to the least scale that fits, which the last does. */
LOOP_INLINE uint32_t loop_round_slopes(struct accel_surface s[3])
{
	const struct accel_surface given[3] = { s[0], s[1], s[2] };
	uint32_t half = 0;

#pragma GCC unroll 4
	for (int i = 0; i < SMALL_SCALES; i++) {
		const unsigned int shift = small_slope_shift(SMALL_SCALES - 1 - (unsigned int)i);
		uint32_t dx[3], dy[3], together = 0, fits;

#pragma GCC unroll 4
		for (int j = 0; j < 3; j++) {
			dx[j] = loop_round(given[j].dx, shift);
			dy[j] = loop_round(given[j].dy, shift);
			together |= loop_magnitude(dx[j]) | loop_magnitude(dy[j]);
		}
		fits = loop_mask(!(together >> (shift + SMALL_SLOPE_BITS - 1)));
#pragma GCC unroll 4
		for (int j = 0; j < 3; j++) {
			s[j].dx = loop_choose_word(fits, dx[j], s[j].dx);
			s[j].dy = loop_choose_word(fits, dy[j], s[j].dy);
		}
		half = loop_choose_word(fits, 1u << (shift - 1), half);
	}
	return half;
}

/*
 * A channel with slopes that are rounded at (u, v) from where its value holds, and the value taken
 * from there with them.
 */
LOOP_INLINE void loop_move_value(struct accel_surface *s, uint32_t u, uint32_t v)
{
	uint32_t dx = s->dx - u * s->dxx - v * s->dxy, dy = s->dy - v * s->dyy - u * s->dxy;

	s->i += u * dx + v * dy + loop_pairs(u) * s->dxx + loop_pairs(v) * s->dyy + u * v * s->dxy;
	s->i = loop_round(s->i, GLOSS_SMALL_SLOPE_SHIFT);
}

LOOP_INLINE float loop_reach_of(int32_t middle, int32_t first, int32_t end)
{
	int32_t before = middle - first, after = end - 1 - middle;
	int32_t reach = before > after ? before : after;

	return (float)(reach < SMALL_REACH_MAX ? reach : SMALL_REACH_MAX);
}

/* Do halves of the units of value, slopes and bends come to little enough at the farthest pixel? */
LOOP_INLINE bool loop_is_close(const struct accel_leaf_batch *batch, int i, uint32_t slope,
			       uint32_t bend)
{
	float x = loop_reach_of(batch->fit.at_x[i], batch->x0[i], batch->x1[i]);
	float y = loop_reach_of(batch->fit.at_y[i], batch->y0[i], batch->y1[i]);
	float pairs = (x * (x + 1) + y * (y + 1)) / 2 + x * y;
	float error = (float)(1 << (GLOSS_SMALL_SLOPE_SHIFT - 1)) + (x + y) * (float)(int32_t)slope;

	/* Sums beyond a float's digits are beyond the bound as well. */
	return error + pairs * (float)(int32_t)bend <= SMALL_ERROR_MAX;
}

/* The surfaces at the anchor, of a triangle that has any. */
LOOP_INLINE void loop_round_colour(struct accel_leaf_batch *batch, int i)
{
	const uint32_t flat = loop_mask(batch->fit.form[i] == GLOSS_SHADING_FLAT);
	const uint32_t bent = loop_mask(batch->fit.form[i] == GLOSS_SHADING_SECOND_ORDER);
	const uint32_t u = (uint32_t)batch->anchor_x[i] - (uint32_t)batch->fit.at_x[i];
	const uint32_t v = (uint32_t)batch->y0[i] - (uint32_t)batch->fit.at_y[i];
	uint32_t bend = 0, slope, fits = ~0u;
	struct accel_surface s[3];

#pragma GCC unroll 4
	for (int j = 0; j < 3; j++) {
		const struct accel_surface_batch *from = &batch->fit.surface[j];
		uint32_t half;

		s[j].i = (uint32_t)from->i[i];
		s[j].dx = (uint32_t)from->dx[i];
		s[j].dy = (uint32_t)from->dy[i];
		s[j].dxx = (uint32_t)from->dxx[i] & bent;
		s[j].dxy = (uint32_t)from->dxy[i] & bent;
		s[j].dyy = (uint32_t)from->dyy[i] & bent;
		half = loop_round_bends(&s[j]);
		fits &= loop_mask(half != 0);
		bend = half > bend ? half : bend;
		s[j].dx += u * s[j].dxx + v * s[j].dxy;
		s[j].dy += v * s[j].dyy + u * s[j].dxy;
	}
	slope = loop_round_slopes(s);
	fits &= loop_mask(loop_is_close(batch, i, slope, bend & bent)) | flat;
	fits |= flat;
	fits &= batch->fits[i];
#pragma GCC unroll 4
	for (int j = 0; j < 3; j++) {
		struct accel_surface_batch *to = &batch->fit.surface[j];

		loop_move_value(&s[j], u, v);
		to->i[i] = (int32_t)loop_choose_word(fits, s[j].i, (uint32_t)to->i[i]);
		to->dx[i] = (int32_t)loop_choose_word(fits, s[j].dx, (uint32_t)to->dx[i]);
		to->dy[i] = (int32_t)loop_choose_word(fits, s[j].dy, (uint32_t)to->dy[i]);
		to->dxx[i] = (int32_t)loop_choose_word(fits, s[j].dxx, (uint32_t)to->dxx[i]);
		to->dxy[i] = (int32_t)loop_choose_word(fits, s[j].dxy, (uint32_t)to->dxy[i]);
		to->dyy[i] = (int32_t)loop_choose_word(fits, s[j].dyy, (uint32_t)to->dyy[i]);
	}
	batch->fits[i] = fits;
}

/* The least scale at which numbers fit in @bits, by their magnitudes, or-ed; SMALL_SCALES: none. */
LOOP_INLINE uint32_t loop_scale(uint32_t together, unsigned int unit, unsigned int step,
				unsigned int bits)
{
	uint32_t scale = 0;

#pragma GCC unroll 4
	for (unsigned int i = 0; i < SMALL_SCALES; i++)
		scale += together >> (unit + i * step + bits - 1) != 0;
	return scale;
}

/* The depth, in units of what a small one is rounded to. */
LOOP_INLINE void loop_pack_depth(struct accel_leaf_batch *batch, int i)
{
	const uint32_t dx = (uint32_t)batch->depth_dx[i], dy = (uint32_t)batch->depth_dy[i];
	const uint32_t u = (uint32_t)batch->anchor_x[i] - (uint32_t)batch->depth_x[i];
	const uint32_t v = (uint32_t)batch->y0[i] - (uint32_t)batch->depth_y[i];
	const uint32_t mask = (1u << SMALL_DEPTH_BITS) - 1;
	uint32_t scale = loop_scale(loop_magnitude(dx) | loop_magnitude(dy), 0,
				    GLOSS_SMALL_DEPTH_SCALE_SHIFT, SMALL_DEPTH_BITS);
	uint32_t shift = scale * GLOSS_SMALL_DEPTH_SCALE_SHIFT & 31;

	batch->depth_scale[i] = scale;
	batch->fits[i] &= loop_mask(scale < SMALL_SCALES) &
			  loop_mask(((dx | dy) & ((1u << shift) - 1)) == 0);
	batch->word[2][i] = (uint32_t)batch->depth_z[i] + u * dx + v * dy;
	batch->word[3][i] = (uint32_t)((int32_t)dx >> shift & (int32_t)mask) |
			    (uint32_t)((int32_t)dy >> shift & (int32_t)mask) << SMALL_DEPTH_BITS |
			    scale << 30;
}

LOOP_INLINE void loop_pack_bends(struct accel_leaf_batch *batch, int channel, int i)
{
	const struct accel_surface_batch *s = &batch->fit.surface[channel];
	const uint32_t mask = (1u << SMALL_BEND_BITS) - 1;
	uint32_t scale = loop_scale(loop_magnitude((uint32_t)s->dxx[i]) |
					    loop_magnitude((uint32_t)s->dxy[i]) |
					    loop_magnitude((uint32_t)s->dyy[i]),
				    GLOSS_SMALL_BEND_SHIFT, GLOSS_SMALL_BEND_SCALE_SHIFT,
				    SMALL_BEND_BITS);
	uint32_t shift = (GLOSS_SMALL_BEND_SHIFT + scale * GLOSS_SMALL_BEND_SCALE_SHIFT) & 31;

	batch->word[8 + channel][i] = ((uint32_t)s->dxx[i] >> shift & mask) |
				      ((uint32_t)s->dxy[i] >> shift & mask) << SMALL_BEND_BITS |
				      ((uint32_t)s->dyy[i] >> shift & mask) << 2 * SMALL_BEND_BITS |
				      scale << 3 * SMALL_BEND_BITS;
}

/* colour_flat's word in the first place, or those of colour_linear_small. */
LOOP_INLINE void loop_pack_linear(struct accel_leaf_batch *batch, int i)
{
	const uint32_t flat = loop_mask(batch->fit.form[i] == GLOSS_SHADING_FLAT);
	const uint32_t mask = (1u << SMALL_SLOPE_BITS) - 1;
	uint32_t together = 0, scale, shift, whole = 0, levels = 0;

#pragma GCC unroll 4
	for (int j = 0; j < 3; j++) {
		const struct accel_surface_batch *s = &batch->fit.surface[j];

		together |= loop_magnitude((uint32_t)s->dx[i]) | loop_magnitude((uint32_t)s->dy[i]);
		whole |= ((uint32_t)s->i[i] >> GLOSS_COLOUR_FRACTION) << 10 * j;
		levels |= batch->fit.level[j][i] << 8 * j;
	}
	scale = loop_scale(together, GLOSS_SMALL_SLOPE_SHIFT, GLOSS_SMALL_SLOPE_SCALE_SHIFT,
			   SMALL_SLOPE_BITS);
	shift = (GLOSS_SMALL_SLOPE_SHIFT + scale * GLOSS_SMALL_SLOPE_SCALE_SHIFT) & 31;
	batch->word[4][i] = loop_choose_word(flat, levels, whole | scale << 30);
#pragma GCC unroll 4
	for (int j = 0; j < 3; j++) {
		const struct accel_surface_batch *s = &batch->fit.surface[j];

		batch->word[5 + j][i] = ((uint32_t)s->i[i] >> GLOSS_SMALL_SLOPE_SHIFT & 0xff) |
					((uint32_t)s->dx[i] >> shift & mask) << 8 |
					((uint32_t)s->dy[i] >> shift & mask)
						<< (8 + SMALL_SLOPE_BITS);
	}
}

/* The header, and the pixels in a tile of @size. */
LOOP_INLINE void loop_pack_head(struct accel_leaf_batch *batch, int i, uint32_t size)
{
	const uint32_t form = batch->fit.form[i];
	const uint32_t rows = (uint32_t)batch->y1[i] - (uint32_t)batch->y0[i];
	uint32_t length = loop_choose_word(loop_mask(form == GLOSS_SHADING_FLAT),
					   GLOSS_COLOUR_FLAT_WORDS,
					   GLOSS_COLOUR_LINEAR_SMALL_WORDS);
	uint32_t more = (rows + 3 - GLOSS_SMALL_HEAD_ROWS) / GLOSS_SMALL_WORD_ROWS;

	more &= loop_mask(rows > GLOSS_SMALL_HEAD_ROWS);
	length = loop_choose_word(loop_mask(form == GLOSS_SHADING_SECOND_ORDER),
				  GLOSS_COLOUR_SECOND_ORDER_SMALL_WORDS, length);
	length += GLOSS_PIXELS_SMALL_WORDS + GLOSS_DEPTH_SMALL_WORDS;
	batch->words[i] = 1 + length;
	batch->word[0][i] = (uint32_t)GLOSS_OP_TRIANGLE_SMALL << 24 | (length + more) | form << 11 |
			    more << 13 | batch->fit.level[3][i] << 16;
	batch->word[1][i] = ((uint32_t)batch->x0[i] & (size - 1)) |
			    ((uint32_t)batch->y0[i] & (size - 1)) << 6 | (rows - 1) << 12 |
			    batch->head[i];
}

static void loop_small(struct accel_leaf_batch *batch, int count, int tile_size)
{
	for (int i = 0; i < count; i++)
		loop_pack_depth(batch, i);
	for (int i = 0; i < count; i++)
		loop_round_colour(batch, i);
	for (int i = 0; i < count; i++)
		loop_pack_linear(batch, i);
	for (int j = 0; j < 3; j++)
		for (int i = 0; i < count; i++)
			loop_pack_bends(batch, j, i);
	for (int i = 0; i < count; i++)
		loop_pack_head(batch, i, (uint32_t)tile_size);
}
