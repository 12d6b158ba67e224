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
static int setup_row_of(int32_t y)
{
	return (y + ACCEL_WINDOW_HALF - 1) >> ACCEL_WINDOW_BITS;
}

static int32_t setup_floor_divide(int64_t a, int32_t b, uint32_t *remainder)
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
static void setup_reduce(int32_t *dx, int32_t *dy)
{
	int shift = __builtin_ctz((uint32_t)(*dx | *dy));

	*dx >>= shift;
	*dy >>= shift;
}

static int32_t setup_magnitude(int32_t value)
{
	return value < 0 ? -value : value;
}

bool accel_setup_edge_fits(const struct accel_vertex *a, const struct accel_vertex *b)
{
	int32_t dx = b->x - a->x, dy = b->y - a->y;

	if (dy == 0)
		return true;
	setup_reduce(&dx, &dy);
	return setup_magnitude(dy) <= ACCEL_EDGE_HEIGHT_MAX;
}

/* @top is above @bottom. */
static void setup_line_init(struct accel_line *line, const struct accel_point *top,
			    const struct accel_point *bottom)
{
	int64_t place;

	line->dx = bottom->x - top->x;
	line->dy = bottom->y - top->y;
	setup_reduce(&line->dx, &line->dy);
	place = (int64_t)(top->x - ACCEL_WINDOW_HALF) * line->dy +
		(int64_t)(ACCEL_WINDOW_HALF - top->y) * line->dx;
	line->start = ((place + ACCEL_WINDOW_ONE - 1) >> ACCEL_WINDOW_BITS) + line->dy - 1;
	line->step = 0;
	line->m = 0;
	if (setup_row_of(bottom->y) - setup_row_of(top->y) > 1)
		line->step = setup_floor_divide(line->dx, line->dy, &line->m);
}

static void setup_order(const struct accel_point **a, const struct accel_point **b)
{
	const struct accel_point *swap = *a;

	if ((*a)->y <= (*b)->y)
		return;
	*a = *b;
	*b = swap;
}

static int32_t setup_extent(int32_t a, int32_t b, int32_t c)
{
	int32_t low = number_min(a, b), high = number_max(a, b);

	low = number_min(low, c);
	high = number_max(high, c);
	return high - low;
}

static bool setup_is_narrow(const struct accel_setup *setup, const struct accel_point point[3])
{
	return setup_extent(point[0].x, point[1].x, point[2].x) <=
		       NARROW_PIXELS * ACCEL_WINDOW_ONE &&
	       setup_extent(point[0].y, point[1].y, point[2].y) <=
		       NARROW_PIXELS * ACCEL_WINDOW_ONE &&
	       setup->left.dy <= NARROW_HEIGHT && setup->right.dy <= NARROW_HEIGHT &&
	       setup->middle.dy <= NARROW_HEIGHT;
}

bool accel_setup_points(struct accel_setup *setup, const struct accel_point point[3])
{
	const struct accel_point *top = &point[0], *turn = &point[1], *bottom = &point[2];
	struct accel_line *bent;

	setup_order(&top, &turn);
	setup_order(&turn, &bottom);
	setup_order(&top, &turn);
	setup->first = setup_row_of(top->y);
	setup->turn = setup_row_of(turn->y);
	setup->end = setup_row_of(bottom->y);
	if (setup->first == setup->end)
		return false;
	setup->right_turns = accel_setup_area(top, turn, bottom) > 0;
	bent = setup->right_turns ? &setup->right : &setup->left;
	setup_line_init(setup->right_turns ? &setup->left : &setup->right, top, bottom);
	setup->middle = (struct accel_line){ .dy = 1 };
	if (setup->turn == setup->first) {
		setup_line_init(bent, turn, bottom);
	} else {
		setup_line_init(bent, top, turn);
		if (setup->turn < setup->end)
			setup_line_init(&setup->middle, turn, bottom);
	}
	setup->narrow = setup_is_narrow(setup, point);
	return true;
}

bool accel_setup_init(struct accel_setup *setup, const struct accel_vertex *const vertex[3])
{
	struct accel_point point[3];

	for (int i = 0; i < 3; i++)
		point[i] = (struct accel_point){ vertex[i]->x, vertex[i]->y };
	return accel_setup_points(setup, point);
}

int32_t accel_setup_at(const struct accel_line *line, int row, uint32_t *r)
{
	return setup_floor_divide(line->start + (int64_t)row * line->dx, line->dy, r);
}

/* As the core steps from row to row. */
static void setup_line_step(const struct accel_line *line, int32_t *x, uint32_t *r)
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
			setup_line_step(left, &at.left, &at.left_r);
			setup_line_step(right, &at.right, &at.right_r);
		}
		row[y - first] = at;
	}
}

bool accel_setup_draws(const struct accel_setup *setup, const struct accel_bounds *visible)
{
	int first = number_max(setup->first, visible->y0);
	int end = number_min(setup->end, visible->y1);
	struct accel_row row[LOOK_ROWS];

	if (end <= first)
		return false;
	if (end - first > LOOK_ROWS)
		return true;
	accel_setup_rows(setup, first, end, row);
	for (int i = 0; i < end - first; i++) {
		int32_t left = number_max(row[i].left, visible->x0);
		int32_t right = number_min(row[i].right, visible->x1);

		if (left < right)
			return true;
	}
	return false;
}
