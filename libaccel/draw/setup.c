// SPDX-License-Identifier: MIT
/*
 * Edges in remainder form. A pixel belongs to a triangle if its centre is inside; a centre on the
 * border belongs to the triangle that lies to its right or, on a horizontal edge, below it. So two
 * triangles that share an edge draw each pixel on it once.
 *
 * In row y an edge is at place = x0 + (yc - y0) * dx / dy, where yc is the row's centre, and the
 * first pixel not left of it is ceil(place - 1/2). All of this is done in integers.
 */
#include "draw/kernel.h"

/* Rows that accel_setup_draws looks at. */
#define LOOK_ROWS 16

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

int32_t accel_setup_at(const struct accel_line *line, int row, uint32_t *r)
{
	*r = line->r;
	if (row == line->row)
		return line->x;
	return line->x +
	       setup_floor_divide(line->r + (int64_t)(row - line->row) * line->dx, line->dy, r);
}

/* As the core steps from row to row. */
static void setup_line_step(const struct accel_line *line, int32_t *x, uint32_t *r)
{
	const uint32_t rest = *r + line->m, over = rest >= (uint32_t)line->dy;

	*r = rest - ((uint32_t)line->dy & -over);
	*x += line->step + (int32_t)over;
}

const struct accel_line *accel_setup_line(const struct accel_setup *setup, int row, bool right)
{
	if (row >= setup->turn && setup->turn > setup->first && right == setup->right_turns)
		return &setup->middle;
	return right ? &setup->right : &setup->left;
}

/* Where the edges are in a row. */
struct place {
	int32_t left, right;
	uint32_t left_r, right_r;
};

/* Rows @first to @end - 1, all of them on one side of the turn; @at is the first, and then the next. */
static void setup_walk(const struct accel_setup *setup, int first, int end, struct place *at,
		       struct accel_row *row)
{
	const struct accel_line left = *accel_setup_line(setup, first, false);
	const struct accel_line right = *accel_setup_line(setup, first, true);
	struct place now = *at; /* which nothing in @row can change */

	for (int i = 0; i < end - first; i++) {
		row[i] = (struct accel_row){ now.left, now.right };
		setup_line_step(&left, &now.left, &now.left_r);
		setup_line_step(&right, &now.right, &now.right_r);
	}
	*at = now;
}

static void setup_find_rows(const struct accel_setup *setup, int first, int end,
			    struct accel_row *row)
{
	int turn = number_clamp(setup->turn, first, end);
	struct place at;

	at.left = accel_setup_at(accel_setup_line(setup, first, false), first, &at.left_r);
	at.right = accel_setup_at(accel_setup_line(setup, first, true), first, &at.right_r);
	setup_walk(setup, first, turn, &at, row);
	if (turn == end)
		return;
	if (turn > first && setup->right_turns) {
		at.right = setup->middle.x;
		at.right_r = setup->middle.r;
	} else if (turn > first) {
		at.left = setup->middle.x;
		at.left_r = setup->middle.r;
	}
	setup_walk(setup, turn, end, &at, row + turn - first);
}

const struct accel_row *accel_setup_rows(const struct accel_setup *setup, int first, int end,
					 struct accel_row *room)
{
	if (setup->end - setup->first <= ACCEL_SETUP_ROWS)
		return &setup->row[first - setup->first];
	setup_find_rows(setup, first, end, room);
	return room;
}

/* Has one of at most LOOK_ROWS rows a pixel of @visible? */
static bool setup_rows_cover(const struct accel_setup *setup, int first, int end,
			     const struct accel_bounds *visible)
{
	struct accel_row room[LOOK_ROWS] = { 0 };
	const struct accel_row *row = accel_setup_rows(setup, first, end, room);

	for (int i = 0; i < end - first; i++) {
		int32_t left = number_max(row[i].left, visible->x0);
		int32_t right = number_min(row[i].right, visible->x1);

		if (left < right)
			return true;
	}
	return false;
}

/* false: no pixel of @visible is in the triangle. A large triangle is not looked at. */
static bool setup_covers(const struct accel_setup *setup, const struct accel_bounds *visible)
{
	int first = number_max(setup->first, visible->y0);
	int end = number_min(setup->end, visible->y1);

	if (end <= first)
		return false;
	return end - first > LOOK_ROWS || setup_rows_cover(setup, first, end, visible);
}

static void setup_take_line(const struct accel_line_batch *batch, int i, struct accel_line *line)
{
	*line = (struct accel_line){
		.row = batch->row[i],
		.x = batch->x[i],
		.r = batch->r[i],
		.dx = batch->dx[i],
		.dy = batch->dy[i],
		.step = batch->step[i],
		.m = batch->m[i],
	};
}

/* Triangle @i of the batch. */
static void setup_take(const struct accel_setup_batch *batch, int i, struct accel_setup *setup)
{
	const int rows = batch->end[i] - batch->first[i];

	setup->first = batch->first[i];
	setup->turn = batch->turn[i];
	setup->end = batch->end[i];
	setup->right_turns = batch->right_turns[i];
	setup->narrow = batch->narrow[i];
	setup_take_line(&batch->left, i, &setup->left);
	setup_take_line(&batch->right, i, &setup->right);
	setup_take_line(&batch->middle, i, &setup->middle);
	for (int row = 0; row < rows && rows <= ACCEL_LOOP_ROWS; row++)
		setup->row[row] = (struct accel_row){ batch->row[row].left[i],
						      batch->row[row].right[i] };
	if (rows > ACCEL_LOOP_ROWS && rows <= ACCEL_SETUP_ROWS)
		setup_find_rows(setup, setup->first, setup->end, setup->row);
	setup->pixels = batch->pixels[i];
	setup->start = batch->start[i];
	setup->box = (struct accel_bounds){ batch->x0[i], batch->y0[i], batch->x1[i],
					    batch->y1[i] };
}

bool accel_setup_draws(const struct accel_setup_batch *batch, int i,
		       const struct accel_bounds *visible, struct accel_setup *setup)
{
	bool looked = batch->end[i] - batch->first[i] <= ACCEL_LOOP_ROWS;

	if (looked && !batch->covers[i])
		return false;
	setup_take(batch, i, setup);
	return looked || setup_covers(setup, visible);
}

bool accel_setup_init(struct accel_setup *setup, const struct accel_vertex *const vertex[3])
{
	const struct accel_bounds nothing = { 0, 0, 0, 0 };
	struct accel_setup_batch batch;

	for (int i = 0; i < 3; i++) {
		batch.x[i][0] = vertex[i]->x;
		batch.y[i][0] = vertex[i]->y;
	}
	accel_kernel()->setup(&batch, 1, &nothing);
	setup_take(&batch, 0, setup);
	return setup->first < setup->end;
}
