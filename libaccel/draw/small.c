// SPDX-License-Identifier: MIT
/*
 * Coefficients of small triangles, rounded to what TRIANGLE_SMALL holds: once a triangle, at its own
 * anchor, so that no picture depends on where tiles begin. What a tile that cuts the triangle asks
 * for is moved from there, and sent small or large as it fits; the bits are the same.
 *
 * Differences are rounded from the highest order on, each to where it holds in the triangle's
 * middle with those above it as they have become. So an error counts from the middle, although the
 * anchor may be seven pixels from the triangle.
 */
#include <string.h>

#include "draw/triangle.h"
#include "draw/small.h"

#define CHANNELS 3

/* What rounding may change in a colour, a quarter of a level. */
#define ERROR_MAX (1 << (GLOSS_COLOUR_FRACTION - 2))

static void small_box_row(struct accel_small *small, const struct accel_row *row, int y)
{
	if (row->left >= row->right)
		return;
	if (small->x0 >= small->x1) {
		small->x0 = row->left;
		small->x1 = row->right;
		small->y0 = y;
		small->anchor_x = row->left & ~((int)GLOSS_ANCHOR_ALIGN - 1);
	}
	small->x0 = number_min(small->x0, row->left);
	small->x1 = number_max(small->x1, row->right);
	small->y1 = y + 1;
}

void accel_small_init(struct accel_small *small, const struct accel_setup *setup)
{
	struct accel_row room[ACCEL_SMALL_SIZE];
	const struct accel_row *row;

	*small = (struct accel_small){ .fits = false };
	if (setup->end - setup->first > ACCEL_SMALL_SIZE)
		return;
	row = accel_setup_rows(setup, setup->first, setup->end, room);
	for (int y = setup->first; y < setup->end; y++)
		small_box_row(small, &row[y - setup->first], y);
	small->fits = small->x0 < small->x1 && small->x1 - small->x0 <= ACCEL_SMALL_SIZE;
}

static int64_t small_round_depth(int64_t value, unsigned int shift)
{
	return (value + (INT64_C(1) << (shift - 1))) & -(INT64_C(1) << shift);
}

/* Wraps, as all that is done with it does. */
static uint32_t small_round(uint32_t value, unsigned int shift)
{
	return (value + (1u << (shift - 1))) >> shift << shift;
}

static bool small_depth_fits(int64_t value, unsigned int shift)
{
	int64_t limit = INT64_C(1) << (SMALL_DEPTH_BITS - 1);

	return value >> shift >= -limit && value >> shift < limit;
}

void accel_small_plane(struct accel_depth_plane *plane)
{
	for (unsigned int scale = 0; scale < SMALL_SCALES; scale++) {
		unsigned int shift = small_depth_shift(scale);
		int64_t dx = small_round_depth(plane->dx, shift);
		int64_t dy = small_round_depth(plane->dy, shift);

		if (!small_depth_fits(dx, shift) || !small_depth_fits(dy, shift))
			continue;
		plane->z = small_round_depth(plane->z, GLOSS_SMALL_DEPTH_SHIFT);
		plane->dx = dx;
		plane->dy = dy;
		return;
	}
}

/* The least scale that fits; false: the plane is not one that TRIANGLE_SMALL has. */
static bool small_plane_scale(const struct accel_depth_plane *plane, unsigned int *scale)
{
	for (*scale = 0; *scale < SMALL_SCALES; ++*scale) {
		unsigned int shift = small_depth_shift(*scale);
		int64_t rest = (INT64_C(1) << shift) - 1;

		if (small_depth_fits(plane->dx, shift) && small_depth_fits(plane->dy, shift))
			return !((plane->dx | plane->dy) & rest) &&
			       !(plane->z & ((1 << GLOSS_SMALL_DEPTH_SHIFT) - 1));
	}
	return false;
}

static uint32_t small_bends_magnitude(const struct accel_surface *s)
{
	return small_magnitude(s->dxx) | small_magnitude(s->dxy) | small_magnitude(s->dyy);
}

/* To the least scale that fits; false: they are too large. */
static bool small_round_bends(struct accel_surface *s, unsigned int *scale)
{
	for (*scale = 0; *scale < SMALL_SCALES; ++*scale) {
		unsigned int shift = small_bend_shift(*scale);
		struct accel_surface rounded = *s;

		rounded.dxx = small_round(s->dxx, shift);
		rounded.dxy = small_round(s->dxy, shift);
		rounded.dyy = small_round(s->dyy, shift);
		if (small_bends_magnitude(&rounded) >> (shift + SMALL_BEND_BITS - 1))
			continue;
		*s = rounded;
		return true;
	}
	return false;
}

/* @s at (u, v) from where it is, except for its value. */
static void small_move_slopes(struct accel_surface *s, uint32_t u, uint32_t v)
{
	s->dx += u * s->dxx + v * s->dxy;
	s->dy += v * s->dyy + u * s->dxy;
}

/* n (n - 1) / 2 */
static uint32_t small_pairs(int n)
{
	return (uint32_t)(n * (n - 1) / 2);
}

/*
 * @s has slopes that are rounded at (u, v) from the middle, and the value in the middle: both in the
 * middle, and then the value at (u, v).
 */
static void small_move_value(struct accel_surface *s, int u, int v)
{
	struct accel_surface middle = *s;
	uint32_t x = (uint32_t)u, y = (uint32_t)v;

	small_move_slopes(&middle, -x, -y);
	s->i += x * middle.dx + y * middle.dy + small_pairs(u) * s->dxx + small_pairs(v) * s->dyy +
		x * y * s->dxy;
	s->i = small_round(s->i, GLOSS_SMALL_SLOPE_SHIFT);
}

/* The greatest distance of a pixel from the middle, in x and in y. */
struct reach {
	int x, y;
};

static struct reach small_reach(const struct accel_triangle *triangle)
{
	const struct accel_small *small = &triangle->small;

	return (struct reach){
		number_max(triangle->x - small->x0, small->x1 - 1 - triangle->x),
		number_max(triangle->y - small->y0, small->y1 - 1 - triangle->y),
	};
}

/* What halves of the units come to at that distance: of value, slopes and bends. */
static bool small_is_close(struct reach reach, unsigned int slope_scale, unsigned int bend_scale,
			   bool bent)
{
	int64_t x = reach.x, y = reach.y, pairs = x * (x + 1) / 2 + y * (y + 1) / 2 + x * y;
	int64_t error = 1 << (GLOSS_SMALL_SLOPE_SHIFT - 1);

	error += (x + y) << (small_slope_shift(slope_scale) - 1);
	if (bent)
		error += pairs << (small_bend_shift(bend_scale) - 1);
	return error <= ERROR_MAX;
}

static uint32_t small_slopes_magnitude(const struct accel_surface channel[CHANNELS])
{
	uint32_t magnitude = 0;

	for (int i = 0; i < CHANNELS; i++)
		magnitude |= small_magnitude(channel[i].dx) | small_magnitude(channel[i].dy);
	return magnitude;
}

/* To the least scale that fits all of them; the last one does. */
static unsigned int small_round_slopes(struct accel_surface channel[CHANNELS])
{
	struct accel_surface rounded[CHANNELS];
	unsigned int scale = 0, shift;

	do {
		shift = small_slope_shift(scale++);
		memcpy(rounded, channel, sizeof(rounded));
		for (int i = 0; i < CHANNELS; i++) {
			rounded[i].dx = small_round(channel[i].dx, shift);
			rounded[i].dy = small_round(channel[i].dy, shift);
		}
	} while (small_slopes_magnitude(rounded) >> (shift + SMALL_SLOPE_BITS - 1));
	memcpy(channel, rounded, sizeof(rounded));
	return scale - 1;
}

/* Rounds second differences, and moves first ones to the anchor with them. */
static bool small_round_orders(struct accel_surface channel[CHANNELS], bool bent, int u, int v,
			       unsigned int *bend_scale)
{
	*bend_scale = 0;
	for (int i = 0; i < CHANNELS; i++) {
		unsigned int scale = 0;

		if (bent && !small_round_bends(&channel[i], &scale))
			return false;
		if (!bent)
			channel[i].dxx = channel[i].dxy = channel[i].dyy = 0;
		*bend_scale = scale > *bend_scale ? scale : *bend_scale;
		small_move_slopes(&channel[i], (uint32_t)u, (uint32_t)v);
	}
	return true;
}

static bool small_round_colour(struct accel_triangle *triangle)
{
	int u = triangle->small.anchor_x - triangle->x, v = triangle->small.y0 - triangle->y;
	bool bent = triangle->shading == GLOSS_SHADING_SECOND_ORDER;
	struct accel_surface channel[CHANNELS];
	unsigned int slope_scale, bend_scale;

	memcpy(channel, triangle->channel, sizeof(channel));
	if (!small_round_orders(channel, bent, u, v, &bend_scale))
		return false;
	slope_scale = small_round_slopes(channel);
	if (!small_is_close(small_reach(triangle), slope_scale, bend_scale, bent))
		return false;
	for (int i = 0; i < CHANNELS; i++)
		small_move_value(&channel[i], u, v);
	memcpy(triangle->channel, channel, sizeof(channel));
	triangle->x = triangle->small.anchor_x;
	triangle->y = triangle->small.y0;
	return true;
}

void accel_small_round(struct accel_triangle *triangle)
{
	struct accel_small *small = &triangle->small;

	small->fits = small->fits && !triangle->alpha_linear &&
		      small_plane_scale(triangle->plane, &small->depth_scale) &&
		      (triangle->shading == GLOSS_SHADING_FLAT || small_round_colour(triangle));
}
