// SPDX-License-Identifier: MIT
/* A TRIANGLE_SMALL to the triangle that the stages take. */
#include "model.h"

static uint64_t depth_difference(int32_t value, uint32_t scale)
{
	return (uint64_t)value << (GLOSS_SMALL_DEPTH_SHIFT + scale * GLOSS_SMALL_DEPTH_SCALE_SHIFT);
}

static uint32_t slope(int32_t value, uint32_t scale)
{
	return (uint32_t)value << (GLOSS_SMALL_SLOPE_SHIFT + scale * GLOSS_SMALL_SLOPE_SCALE_SHIFT);
}

static uint32_t bend(int32_t value, uint32_t scale)
{
	return (uint32_t)value << (GLOSS_SMALL_BEND_SHIFT + scale * GLOSS_SMALL_BEND_SCALE_SHIFT);
}

/* A colour of 8 bits is one with no fraction. */
static uint32_t value(int32_t whole, uint32_t fraction)
{
	return ((uint32_t)whole << 8 | fraction) << GLOSS_SMALL_SLOPE_SHIFT;
}

static const uint32_t *unpack_pixels(const uint32_t *words, struct model_triangle *triangle)
{
	struct gloss_pixels_small pixels;

	gloss_pixels_small_unpack(words, &pixels);
	triangle->listed = true;
	triangle->x = (int)pixels.x;
	triangle->first_row = (int)pixels.first_row;
	triangle->last_row = (int)pixels.last_row;
	triangle->left.x = (int32_t)(pixels.x + pixels.first_0);
	triangle->row[0] = (uint8_t)(pixels.last_0 << 4 | pixels.first_0);
	triangle->row[1] = (uint8_t)(pixels.last_1 << 4 | pixels.first_1);
	return words + GLOSS_PIXELS_SMALL_WORDS;
}

static const uint32_t *unpack_depth(const uint32_t *words, struct model_plane *plane)
{
	struct gloss_depth_small depth;

	gloss_depth_small_unpack(words, &depth);
	plane->z = (uint64_t)depth.z << GLOSS_SMALL_DEPTH_SHIFT;
	plane->dx = depth_difference(depth.dx, depth.scale);
	plane->dy = depth_difference(depth.dy, depth.scale);
	return words + GLOSS_DEPTH_SMALL_WORDS;
}

static const uint32_t *unpack_flat(const uint32_t *words, struct model_triangle *triangle)
{
	struct gloss_colour_flat flat;

	gloss_colour_flat_unpack(words, &flat);
	triangle->red = (struct model_surface){ .i = value((int32_t)flat.red, 0) };
	triangle->green = (struct model_surface){ .i = value((int32_t)flat.green, 0) };
	triangle->blue = (struct model_surface){ .i = value((int32_t)flat.blue, 0) };
	return words + GLOSS_COLOUR_FLAT_WORDS;
}

/* The words of a linear form are the first of a second-order one. */
static const uint32_t *unpack_linear(const uint32_t *words, struct model_triangle *triangle)
{
	struct gloss_colour_linear_small p;

	gloss_colour_linear_small_unpack(words, &p);
	triangle->red = (struct model_surface){
		.i = value(p.red, p.red_fraction),
		.dx = slope(p.red_dx, p.slope_scale),
		.dy = slope(p.red_dy, p.slope_scale),
	};
	triangle->green = (struct model_surface){
		.i = value(p.green, p.green_fraction),
		.dx = slope(p.green_dx, p.slope_scale),
		.dy = slope(p.green_dy, p.slope_scale),
	};
	triangle->blue = (struct model_surface){
		.i = value(p.blue, p.blue_fraction),
		.dx = slope(p.blue_dx, p.slope_scale),
		.dy = slope(p.blue_dy, p.slope_scale),
	};
	return words + GLOSS_COLOUR_LINEAR_SMALL_WORDS;
}

static const uint32_t *unpack_second_order(const uint32_t *words, struct model_triangle *triangle)
{
	struct gloss_colour_second_order_small p;

	unpack_linear(words, triangle);
	gloss_colour_second_order_small_unpack(words, &p);
	triangle->red.dxx = bend(p.red_dxx, p.red_scale);
	triangle->red.dxy = bend(p.red_dxy, p.red_scale);
	triangle->red.dyy = bend(p.red_dyy, p.red_scale);
	triangle->green.dxx = bend(p.green_dxx, p.green_scale);
	triangle->green.dxy = bend(p.green_dxy, p.green_scale);
	triangle->green.dyy = bend(p.green_dyy, p.green_scale);
	triangle->blue.dxx = bend(p.blue_dxx, p.blue_scale);
	triangle->blue.dxy = bend(p.blue_dxy, p.blue_scale);
	triangle->blue.dyy = bend(p.blue_dyy, p.blue_scale);
	return words + GLOSS_COLOUR_SECOND_ORDER_SMALL_WORDS;
}

static const uint32_t *unpack_colour(const uint32_t *words, enum gloss_shading shading,
				     struct model_triangle *triangle)
{
	switch (shading) {
	case GLOSS_SHADING_SECOND_ORDER:
		return unpack_second_order(words, triangle);
	case GLOSS_SHADING_LINEAR:
		return unpack_linear(words, triangle);
	default:
		return unpack_flat(words, triangle);
	}
}

void model_triangle_small_unpack(const uint32_t *packet, struct model_triangle *triangle)
{
	struct gloss_triangle_small header;
	const uint32_t *words = packet + 1;

	gloss_triangle_small_unpack(packet, &header);
	words = unpack_pixels(words, triangle);
	words = unpack_depth(words, &triangle->depth);
	words = unpack_colour(words, header.shading, triangle);
	triangle->alpha = (struct model_surface){ .i = value((int32_t)header.alpha, 0) };
	for (int row = GLOSS_SMALL_HEAD_ROWS; row <= triangle->last_row; row++) {
		int at = row - GLOSS_SMALL_HEAD_ROWS, byte = at % GLOSS_SMALL_WORD_ROWS;

		triangle->row[row] = (uint8_t)(words[at / GLOSS_SMALL_WORD_ROWS] >> 8 * byte);
	}
}
