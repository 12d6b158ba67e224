// SPDX-License-Identifier: MIT
/*
 * Edges in remainder form. A pixel belongs to a triangle if its centre is inside; a centre on the
 * border belongs to the triangle that lies to its right or, on a horizontal edge, below it. So two
 * triangles that share an edge draw each pixel on it once.
 *
 * In row y an edge is at place = x0 + (yc - y0) * dx / dy, where yc is the row's centre, and the
 * first pixel not left of it is ceil(place - 1/2). All of this is done in integers.
 */
#include "draw/draw_priv.h"

/* As group edges_compact says; and its fields r, m, dy have ten bits. */
#define NARROW_PIXELS 63
#define NARROW_HEIGHT 1023

/* Rows that accel_setup_draws looks at. */
#define LOOK_ROWS 16

/* First row whose centre is not above @y. */
static int row_of(int32_t y)
{
	return (y + ACCEL_WINDOW_HALF - 1) >> ACCEL_WINDOW_BITS;
}

static int32_t floor_divide(int64_t a, int32_t b, uint32_t *remainder)
{
	int64_t quotient = a / b, rest = a % b;

	if (rest < 0) {
		rest += b;
		quotient--;
	}
	*remainder = (uint32_t)rest;
	return (int32_t)quotient;
}

/* Takes out the powers of two that both numbers have; not both are 0. */
static void reduce(int32_t *dx, int32_t *dy)
{
	int shift = __builtin_ctz((uint32_t)(*dx | *dy));

	*dx >>= shift;
	*dy >>= shift;
}

static int32_t magnitude(int32_t value)
{
	return value < 0 ? -value : value;
}

bool accel_setup_edge_fits(const struct accel_vertex *a, const struct accel_vertex *b)
{
	int32_t dx = b->x - a->x, dy = b->y - a->y;

	if (dy == 0)
		return true;
	reduce(&dx, &dy);
	return magnitude(dy) <= ACCEL_EDGE_HEIGHT_MAX;
}

/* @top is above @bottom. */
static void line_init(struct accel_line *line, const struct accel_vertex *top,
		      const struct accel_vertex *bottom)
{
	int64_t place;

	line->dx = bottom->x - top->x;
	line->dy = bottom->y - top->y;
	reduce(&line->dx, &line->dy);
	place = (int64_t)(top->x - ACCEL_WINDOW_HALF) * line->dy +
		(int64_t)(ACCEL_WINDOW_HALF - top->y) * line->dx;
	line->start = ((place + ACCEL_WINDOW_ONE - 1) >> ACCEL_WINDOW_BITS) + line->dy - 1;
	line->step = 0;
	line->m = 0;
	if (row_of(bottom->y) - row_of(top->y) > 1)
		line->step = floor_divide(line->dx, line->dy, &line->m);
}

static void order(const struct accel_vertex **a, const struct accel_vertex **b)
{
	const struct accel_vertex *swap = *a;

	if ((*a)->y <= (*b)->y)
		return;
	*a = *b;
	*b = swap;
}

static int32_t extent(int32_t a, int32_t b, int32_t c)
{
	int32_t low = a < b ? a : b, high = a < b ? b : a;

	low = c < low ? c : low;
	high = c > high ? c : high;
	return high - low;
}

static bool is_narrow(const struct accel_setup *setup, const struct accel_vertex *const vertex[3])
{
	return extent(vertex[0]->x, vertex[1]->x, vertex[2]->x) <=
		       NARROW_PIXELS * ACCEL_WINDOW_ONE &&
	       extent(vertex[0]->y, vertex[1]->y, vertex[2]->y) <=
		       NARROW_PIXELS * ACCEL_WINDOW_ONE &&
	       setup->left.dy <= NARROW_HEIGHT && setup->right.dy <= NARROW_HEIGHT &&
	       setup->middle.dy <= NARROW_HEIGHT;
}

bool accel_setup_init(struct accel_setup *setup, const struct accel_vertex *const vertex[3])
{
	const struct accel_vertex *top = vertex[0], *turn = vertex[1], *bottom = vertex[2];
	struct accel_line *bent;

	order(&top, &turn);
	order(&turn, &bottom);
	order(&top, &turn);
	setup->first = row_of(top->y);
	setup->turn = row_of(turn->y);
	setup->end = row_of(bottom->y);
	if (setup->first == setup->end)
		return false;
	setup->right_turns = accel_surface_area(top, turn, bottom) > 0;
	bent = setup->right_turns ? &setup->right : &setup->left;
	line_init(setup->right_turns ? &setup->left : &setup->right, top, bottom);
	setup->middle = (struct accel_line){ .dy = 1 };
	if (setup->turn == setup->first) {
		line_init(bent, turn, bottom);
	} else {
		line_init(bent, top, turn);
		if (setup->turn < setup->end)
			line_init(&setup->middle, turn, bottom);
	}
	setup->narrow = is_narrow(setup, vertex);
	return true;
}

int32_t accel_setup_at(const struct accel_line *line, int row, uint32_t *r)
{
	return floor_divide(line->start + (int64_t)row * line->dx, line->dy, r);
}

/* As the core steps from row to row. */
static void line_step(const struct accel_line *line, int32_t *x, uint32_t *r)
{
	*r += line->m;
	*x += line->step;
	if (*r >= (uint32_t)line->dy) {
		*r -= (uint32_t)line->dy;
		*x += 1;
	}
}

const struct accel_line *accel_setup_line(const struct accel_setup *setup, int row, bool right)
{
	if (row >= setup->turn && setup->turn > setup->first && right == setup->right_turns)
		return &setup->middle;
	return right ? &setup->right : &setup->left;
}

void accel_setup_rows(const struct accel_setup *setup, int first, int end, struct accel_row *row)
{
	const struct accel_line *left = &setup->left, *right = &setup->right;
	struct accel_row at = { 0 };

	for (int y = first; y < end; y++) {
		if (y == first || y == setup->turn) {
			left = accel_setup_line(setup, y, false);
			right = accel_setup_line(setup, y, true);
			at.left = accel_setup_at(left, y, &at.left_r);
			at.right = accel_setup_at(right, y, &at.right_r);
		} else {
			line_step(left, &at.left, &at.left_r);
			line_step(right, &at.right, &at.right_r);
		}
		row[y - first] = at;
	}
}

bool accel_setup_draws(const struct accel_setup *setup, const struct accel_rectangle *visible)
{
	int first = setup->first > visible->y0 ? setup->first : visible->y0;
	int end = setup->end < visible->y1 ? setup->end : visible->y1;
	struct accel_row row[LOOK_ROWS];

	if (end <= first)
		return false;
	if (end - first > LOOK_ROWS)
		return true;
	accel_setup_rows(setup, first, end, row);
	for (int i = 0; i < end - first; i++) {
		int32_t left = row[i].left > visible->x0 ? row[i].left : visible->x0;
		int32_t right = row[i].right < visible->x1 ? row[i].right : visible->x1;

		if (left < right)
			return true;
	}
	return false;
}
