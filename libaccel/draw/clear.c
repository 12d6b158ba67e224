// SPDX-License-Identifier: MIT
/* Clears and rectangles: what is drawn in whole pixels, past transform and light. */
#include <errno.h>
#include <math.h>
#include <string.h>

#include "draw/draw.h"

static uint32_t clear_colour_word(const float rgba[4])
{
	uint32_t word = 0;

	for (int i = 0; i < 4; i++) {
		float value = rgba[i] < 0 ? 0 : rgba[i] > 1 ? 1 : rgba[i];

		word |= (uint32_t)(value * 255 + 0.5f) << 8 * i;
	}
	return word;
}

static uint32_t clear_depth_word(float depth)
{
	return (uint32_t)((double)depth * ACCEL_DEPTH_MAX + 0.5);
}

static bool clear_valid(const struct accel_clear *clear)
{
	const float *rgba = clear->rgba;
	bool valid = clear->mask && !(clear->mask & ~(ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH));

	if (clear->mask & ACCEL_CLEAR_COLOUR)
		valid = valid && isfinite(rgba[0]) && isfinite(rgba[1]) && isfinite(rgba[2]) &&
			isfinite(rgba[3]);
	if (clear->mask & ACCEL_CLEAR_DEPTH)
		valid = valid && clear->depth >= 0 && clear->depth <= 1;
	return valid;
}

int accel_draw_clear_take(struct accel_draw *draw, const struct accel_clear *given,
			  struct accel_tile_clear *clear)
{
	struct accel_clear known;
	int err = given ? accel_sized_in(&known, sizeof(known), given) : 0;

	*clear = (struct accel_tile_clear){ .mask = 0 };
	if (err) {
		accel_sized_message(draw->device, "clear", "ACCEL_CLEAR", err);
		return err;
	}
	if (!given)
		return 0;
	if (!clear_valid(&known)) {
		accel_device_message(draw->device,
				     "a clear of mask %u: a colour has four finite "
				     "numbers, a depth is 0 to 1",
				     known.mask);
		return -EINVAL;
	}
	clear->mask = known.mask;
	if (known.mask & ACCEL_CLEAR_COLOUR)
		clear->colour = clear_colour_word(known.rgba);
	if (known.mask & ACCEL_CLEAR_DEPTH)
		clear->depth = clear_depth_word(known.depth);
	return 0;
}

int accel_draw_clear_all(struct accel_draw *draw, const struct accel_tile_clear *clear)
{
	int err = clear->mask ? accel_bin_clear(&draw->bin, clear) : 0;

	if (err)
		accel_draw_lose(draw);
	return err;
}

int accel_draw_clear(struct accel_draw *draw, const struct accel_clear *given)
{
	struct accel_tile_clear clear;
	int err = accel_draw_check_begun(draw, "a clear");

	if (!err)
		err = accel_draw_clear_take(draw, given, &clear);
	return err ? err : accel_draw_clear_all(draw, &clear);
}

/* What of the target is within the state's scissor. */
static struct accel_bounds clear_visible(const struct accel_draw *draw,
					 const struct accel_state *state)
{
	struct accel_bounds visible = { 0, 0, draw->target.width, draw->target.height };

	accel_geometry_scissor(state, &visible);
	return visible;
}

static int clear_fill(struct accel_draw *draw, const struct accel_bounds *box,
		      const struct accel_tile_state *state, uint32_t colour, uint32_t depth)
{
	int err = 0;

	if (box->x0 < box->x1 && box->y0 < box->y1)
		err = accel_bin_fill(&draw->bin, box, state, colour, depth);
	if (err)
		accel_draw_lose(draw);
	return err;
}

static bool clear_is_whole(const struct accel_draw *draw, const struct accel_bounds *box,
			   const struct accel_tile_clear *clear, const bool mask[4])
{
	return box->x1 - box->x0 == draw->target.width &&
	       box->y1 - box->y0 == draw->target.height &&
	       (!(clear->mask & ACCEL_CLEAR_COLOUR) || (mask[0] && mask[1] && mask[2] && mask[3]));
}

int accel_draw_clear_masked(struct accel_draw *draw, const struct accel_state *state,
			    const struct accel_clear *given)
{
	static const bool none[4];
	struct accel_tile_clear clear = { .mask = 0 };
	struct accel_tile_state tests;
	struct accel_bounds box;
	int err = accel_draw_check_begun(draw, "a clear");

	if (!err)
		err = accel_draw_clear_take(draw, given, &clear);
	if (err || !clear.mask)
		return err;
	box = clear_visible(draw, state);
	if (clear_is_whole(draw, &box, &clear, state->colour_mask))
		return accel_draw_clear_all(draw, &clear);
	accel_bin_tests(&tests, ACCEL_COMPARE_ALWAYS, clear.mask & ACCEL_CLEAR_DEPTH,
			clear.mask & ACCEL_CLEAR_COLOUR ? state->colour_mask : none);
	return clear_fill(draw, &box, &tests, clear.colour, clear.depth);
}

static int clear_check_fills(const struct accel_draw *draw, const struct accel_fill *fill,
			     uint32_t fills)
{
	for (uint32_t i = 0; i < fills; i++) {
		struct accel_clear clear = { .mask = ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH,
					     .depth = fill[i].depth };

		memcpy(clear.rgba, fill[i].rgba, sizeof(clear.rgba));
		if (clear_valid(&clear))
			continue;
		accel_device_message(draw->device,
				     "rectangle %u: a colour has four finite numbers, a "
				     "depth is 0 to 1",
				     i);
		return -EINVAL;
	}
	return 0;
}

int accel_draw_rectangles(struct accel_draw *draw, const struct accel_state *state,
			  const struct accel_fill *fill, uint32_t fills)
{
	struct accel_tile_state tests;
	struct accel_bounds visible;
	int err = accel_draw_check_begun(draw, "rectangles");

	if (!err)
		err = clear_check_fills(draw, fill, fills);
	if (err)
		return err;
	visible = clear_visible(draw, state);
	accel_bin_tests(&tests, state->depth_func, state->depth_write, state->colour_mask);
	for (uint32_t i = 0; i < fills && !err; i++) {
		const struct accel_rectangle *pixels = &fill[i].pixels;
		struct accel_bounds box = visible;

		accel_geometry_intersect(&box, pixels->x, pixels->y, pixels->width, pixels->height);
		err = clear_fill(draw, &box, &tests, clear_colour_word(fill[i].rgba),
				 clear_depth_word(fill[i].depth));
	}
	return err;
}
