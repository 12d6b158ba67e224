// SPDX-License-Identifier: MIT
#include "reference.h"

/* The lowest @bits of @value, as a signed number. */
static int64_t wrap(int64_t value, int bits)
{
	uint64_t rest = (uint64_t)value & ((1ull << bits) - 1);

	return rest >> (bits - 1) ? (int64_t)rest - (1ll << bits) : (int64_t)rest;
}

static void step(struct model_edge *edge)
{
	uint16_t r = (uint16_t)(edge->r + edge->m);
	int x = edge->x + edge->step;

	if (r >= edge->dy) {
		r = (uint16_t)(r - edge->dy);
		x++;
	}
	edge->r = r;
	edge->x = (int32_t)wrap(x, 13);
}

/* Differences of a surface at one pixel, and how they change from pixel to pixel. */
struct accumulator {
	int64_t i, dx, dy, dxx, dxy, dyy;
	int bits;
};

static void move_x(struct accumulator *a, int pixels)
{
	for (; pixels > 0; pixels--) {
		a->i = wrap(a->i + a->dx, a->bits);
		a->dx = wrap(a->dx + a->dxx, a->bits);
		a->dy = wrap(a->dy + a->dxy, a->bits);
	}
	for (; pixels < 0; pixels++) {
		a->dx = wrap(a->dx - a->dxx, a->bits);
		a->dy = wrap(a->dy - a->dxy, a->bits);
		a->i = wrap(a->i - a->dx, a->bits);
	}
}

static void move_y(struct accumulator *a, int rows)
{
	for (; rows > 0; rows--) {
		a->i = wrap(a->i + a->dy, a->bits);
		a->dy = wrap(a->dy + a->dyy, a->bits);
		a->dx = wrap(a->dx + a->dxy, a->bits);
	}
}

/* What is left of @fraction bits at (u, v) from the anchor, between 0 and @most. */
static uint32_t value(struct accumulator a, int u, int v, int fraction, int64_t most)
{
	int64_t level;

	move_y(&a, v);
	move_x(&a, u);
	for (level = wrap(a.i, a.bits); fraction > 0; fraction--)
		level = (level - (level & 1)) / 2;
	return (uint32_t)(level < 0 ? 0 : level > most ? most : level);
}

static uint32_t channel(const struct model_surface *s, int u, int v)
{
	struct accumulator a = { s->i, s->dx, s->dy, s->dxx, s->dxy, s->dyy, 32 };

	return value(a, u, v, 22, 255);
}

static uint32_t depth_at(const struct model_plane *p, int u, int v)
{
	struct accumulator a = { .i = wrap((int64_t)p->z, 40),
				 .dx = wrap((int64_t)p->dx, 40),
				 .dy = wrap((int64_t)p->dy, 40),
				 .bits = 40 };

	return value(a, u, v, 12, (1 << 24) - 1);
}

static bool passes(enum gloss_compare func, uint32_t new, uint32_t old)
{
	switch (func) {
	case GLOSS_COMPARE_NEVER:
		return false;
	case GLOSS_COMPARE_LESS:
		return new < old;
	case GLOSS_COMPARE_EQUAL:
		return new == old;
	case GLOSS_COMPARE_LEQUAL:
		return new <= old;
	case GLOSS_COMPARE_GREATER:
		return new > old;
	case GLOSS_COMPARE_NOTEQUAL:
		return new != old;
	case GLOSS_COMPARE_GEQUAL:
		return new >= old;
	default:
		return true;
	}
}

static void pixel(const struct model_triangle *t, const struct model_state *state, int u, int v,
		  uint32_t *colour, uint32_t *depth, struct model_counters *counters)
{
	uint32_t new_depth = depth_at(&t->depth, u, v);
	uint32_t new_colour = channel(&t->red, u, v) | channel(&t->green, u, v) << 8 |
			      channel(&t->blue, u, v) << 16 | channel(&t->alpha, u, v) << 24;

	counters->covered++;
	if (!passes(state->depth_func, new_depth, *depth & 0xffffff))
		return;
	counters->passed++;
	if (state->depth_write)
		*depth = (*depth & 0xff000000) | new_depth;
	*colour = (*colour & ~state->colour_mask) | (new_colour & state->colour_mask);
}

void reference_draw(const struct model_triangle *t, int tile_size, const struct model_state *state,
		    struct model_tile *tile, struct model_counters *counters)
{
	struct model_edge left = t->left, right = t->right;
	int anchor = left.x < 0 ? 0 : left.x >= tile_size ? tile_size - 1 : left.x;

	anchor = anchor / 8 * 8;
	counters->triangles++;
	for (int v = 0; v <= t->last_row; v++) {
		int y = t->first_row + v;

		if (v > 0) {
			step(&left);
			step(&right);
		}
		if (v > 0 && v == t->switch_row)
			*(t->side ? &right : &left) = t->middle;
		for (int x = state->scissor.x0; x < state->scissor.x1; x++)
			if (left.x <= x && x < right.x && state->scissor.y0 <= y &&
			    y < state->scissor.y1)
				pixel(t, state, x - anchor, v, &tile->colour[y * tile_size + x],
				      &tile->depth[y * tile_size + x], counters);
	}
}
