/* SPDX-License-Identifier: MIT */
/* The edges and first rows of triangles; a part of kernel_loops.h. What they are is in setup.c. */
#include "draw/kernel.h"
#include "draw/loop.h"

/* As group edges_compact says; and its fields r, m, dy have ten bits. */
#define NARROW_PIXELS 63
#define NARROW_HEIGHT 1023

/* First row whose centre is not above @y. */
LOOP_INLINE int32_t loop_row_of(int32_t y)
{
	return (y + ACCEL_WINDOW_HALF - 1) >> ACCEL_WINDOW_BITS;
}

LOOP_INLINE int32_t loop_choose_int(bool which, int32_t a, int32_t b)
{
	const int32_t mask = -(int32_t)which;

	return (a & mask) | (b & ~mask);
}

LOOP_INLINE int32_t loop_min(int32_t a, int32_t b)
{
	return a < b ? a : b;
}

LOOP_INLINE int32_t loop_max(int32_t a, int32_t b)
{
	return a > b ? a : b;
}

/* Puts @a above @b. */
LOOP_INLINE void loop_order(struct accel_point *a, struct accel_point *b)
{
	const struct accel_point first = *a, second = *b;
	bool turned = first.y > second.y;

	a->x = loop_choose_int(turned, second.x, first.x);
	a->y = loop_choose_int(turned, second.y, first.y);
	b->x = loop_choose_int(turned, first.x, second.x);
	b->y = loop_choose_int(turned, first.y, second.y);
}

/* floor(a / b), for b > 0; the numbers are integers, and so exact in doubles. */
LOOP_INLINE int32_t loop_divide(double a, double b, uint32_t *remainder)
{
	int32_t quotient = (int32_t)(a / b);
	double rest = a - (double)quotient * b;
	bool below = rest < 0;

	*remainder = (uint32_t)((int32_t)rest + loop_choose_int(below, (int32_t)b, 0));
	return quotient - below;
}

/* The line from @top to @bottom, which is below it by @rows rows; of 0 rows something. */
LOOP_INLINE struct accel_line loop_line(struct accel_point top, struct accel_point bottom,
					int32_t rows)
{
	int32_t whole = top.x >> ACCEL_WINDOW_BITS, row = loop_row_of(top.y);
	int32_t left = top.x - whole * ACCEL_WINDOW_ONE - ACCEL_WINDOW_HALF;
	int32_t below = row * ACCEL_WINDOW_ONE + ACCEL_WINDOW_HALF - top.y;
	int32_t across = bottom.x - top.x, down = loop_choose_int(rows > 0, bottom.y - top.y, 1);
	int32_t common = (across | down) & -(across | down);
	double scale = 1 / (double)common, dx = (double)across * scale, dy = (double)down * scale;
	double place = (double)left * dy + (double)below * dx + (ACCEL_WINDOW_ONE - 1);
	struct accel_line line = { .row = row, .dx = (int32_t)dx, .dy = (int32_t)dy };
	uint32_t unused;

	place = (double)loop_divide(place, ACCEL_WINDOW_ONE, &unused) + dy - 1;
	line.x = whole + loop_divide(place, dy, &line.r);
	line.step = loop_divide(dx, dy, &line.m) & -(int32_t)(rows > 1);
	line.m &= loop_mask(rows > 1);
	return line;
}

LOOP_INLINE void loop_put_line(struct accel_line_batch *batch, int i, bool which,
			       const struct accel_line *a, const struct accel_line *b)
{
	batch->row[i] = loop_choose_int(which, a->row, b->row);
	batch->x[i] = loop_choose_int(which, a->x, b->x);
	batch->r[i] = (uint32_t)loop_choose_int(which, (int32_t)a->r, (int32_t)b->r);
	batch->dx[i] = loop_choose_int(which, a->dx, b->dx);
	batch->dy[i] = loop_choose_int(which, a->dy, b->dy);
	batch->step[i] = loop_choose_int(which, a->step, b->step);
	batch->m[i] = (uint32_t)loop_choose_int(which, (int32_t)a->m, (int32_t)b->m);
}

LOOP_INLINE bool loop_right_turns(struct accel_point top, struct accel_point turn,
				  struct accel_point bottom)
{
	return (double)(turn.x - top.x) * (double)(bottom.y - top.y) >
	       (double)(bottom.x - top.x) * (double)(turn.y - top.y);
}

LOOP_INLINE uint32_t loop_is_narrow(const struct accel_setup_batch *batch, int i,
				    struct accel_point top, struct accel_point turn,
				    struct accel_point bottom)
{
	int32_t across = loop_max(loop_max(top.x, turn.x), bottom.x) -
			 loop_min(loop_min(top.x, turn.x), bottom.x);
	int32_t height = loop_max(loop_max(batch->left.dy[i], batch->right.dy[i]),
				  batch->middle.dy[i]);

	return (across <= NARROW_PIXELS * ACCEL_WINDOW_ONE) &
	       (bottom.y - top.y <= NARROW_PIXELS * ACCEL_WINDOW_ONE) & (height <= NARROW_HEIGHT);
}

LOOP_INLINE void loop_triangle(struct accel_setup_batch *batch, int i)
{
	const struct accel_line none = { .dy = 1 };
	struct accel_point top = { batch->x[0][i], batch->y[0][i] };
	struct accel_point turn = { batch->x[1][i], batch->y[1][i] };
	struct accel_point bottom = { batch->x[2][i], batch->y[2][i] };
	struct accel_line whole, upper, lower;
	int32_t first, middle, end;
	bool right, bends;

	loop_order(&top, &turn);
	loop_order(&turn, &bottom);
	loop_order(&top, &turn);
	first = loop_row_of(top.y);
	middle = loop_row_of(turn.y);
	end = loop_row_of(bottom.y);
	right = loop_right_turns(top, turn, bottom);
	whole = loop_line(top, bottom, end - first);
	upper = loop_line(top, turn, middle - first);
	lower = loop_line(turn, bottom, end - middle);
	bends = middle > first;
	loop_put_line(&batch->middle, i, bends & (middle < end), &lower, &none);
	upper.row = loop_choose_int(bends, upper.row, lower.row);
	upper.x = loop_choose_int(bends, upper.x, lower.x);
	upper.r = (uint32_t)loop_choose_int(bends, (int32_t)upper.r, (int32_t)lower.r);
	upper.dx = loop_choose_int(bends, upper.dx, lower.dx);
	upper.dy = loop_choose_int(bends, upper.dy, lower.dy);
	upper.step = loop_choose_int(bends, upper.step, lower.step);
	upper.m = (uint32_t)loop_choose_int(bends, (int32_t)upper.m, (int32_t)lower.m);
	loop_put_line(&batch->left, i, right, &whole, &upper);
	loop_put_line(&batch->right, i, right, &upper, &whole);
	batch->first[i] = first;
	batch->turn[i] = middle;
	batch->end[i] = end;
	batch->right_turns[i] = right;
	batch->narrow[i] = loop_is_narrow(batch, i, top, turn, bottom);
}

/* Adds the pixels from @left to before @right of row @y. */
LOOP_INLINE void loop_box_row(struct accel_setup_batch *batch, int i, int32_t y, int32_t left,
			      int32_t right)
{
	bool filled = (y < batch->end[i]) & (left < right);
	bool starts = filled & (batch->pixels[i] == 0);

	batch->start[i] = loop_choose_int(starts, left, batch->start[i]);
	batch->y0[i] = loop_choose_int(starts, y, batch->y0[i]);
	batch->y1[i] = loop_choose_int(filled, y + 1, batch->y1[i]);
	batch->x0[i] = loop_choose_int(filled & (left < batch->x0[i]), left, batch->x0[i]);
	batch->x1[i] = loop_choose_int(filled & (right > batch->x1[i]), right, batch->x1[i]);
	batch->pixels[i] += loop_choose_int(filled, right - left, 0);
}

/* Row @row of a triangle to @out, and on to the next. */
LOOP_INLINE void loop_step_row(struct accel_setup_batch *batch, int row, int i,
			       const struct accel_bounds *visible, struct accel_row_batch *out)
{
	const struct accel_line_batch *l = &batch->left, *r = &batch->right, *m = &batch->middle;
	int32_t y = batch->first[i] + row, turn = batch->turn[i];
	bool below = (y >= turn) & (turn > batch->first[i]), right = batch->right_turns[i];
	bool on_right = below & right, on_left = below & !right, here = y == turn;
	int32_t x[2] = { loop_choose_int(here & on_left, m->x[i], batch->at[0][i]),
			 loop_choose_int(here & on_right, m->x[i], batch->at[1][i]) };
	int32_t rest[2] = { loop_choose_int(here & on_left, (int32_t)m->r[i], batch->at_r[0][i]),
			    loop_choose_int(here & on_right, (int32_t)m->r[i], batch->at_r[1][i]) };
	bool seen = (y < batch->end[i]) & (y >= visible->y0) & (y < visible->y1) &
		    (loop_max(x[0], visible->x0) < loop_min(x[1], visible->x1));
	int32_t by, over;

	out->left[i] = x[0];
	out->right[i] = x[1];
	batch->covers[i] |= seen;
	loop_box_row(batch, i, y, x[0], x[1]);
	by = loop_choose_int(on_left, m->dy[i], l->dy[i]);
	rest[0] += loop_choose_int(on_left, (int32_t)m->m[i], (int32_t)l->m[i]);
	over = -(int32_t)(rest[0] >= by);
	batch->at[0][i] = x[0] + loop_choose_int(on_left, m->step[i], l->step[i]) - over;
	batch->at_r[0][i] = rest[0] - (by & over);
	by = loop_choose_int(on_right, m->dy[i], r->dy[i]);
	rest[1] += loop_choose_int(on_right, (int32_t)m->m[i], (int32_t)r->m[i]);
	over = -(int32_t)(rest[1] >= by);
	batch->at[1][i] = x[1] + loop_choose_int(on_right, m->step[i], r->step[i]) - over;
	batch->at_r[1][i] = rest[1] - (by & over);
}

static void loop_setup(struct accel_setup_batch *batch, int count,
		       const struct accel_bounds *bounds)
{
	const struct accel_bounds visible = *bounds; /* which nothing in @batch can change */
	struct accel_row_batch out;
	int32_t rows = 0;

	for (int i = 0; i < count; i++)
		loop_triangle(batch, i);
	for (int i = 0; i < count; i++) {
		rows = loop_max(rows, batch->end[i] - batch->first[i]);
		batch->at[0][i] = batch->left.x[i];
		batch->at[1][i] = batch->right.x[i];
		batch->at_r[0][i] = (int32_t)batch->left.r[i];
		batch->at_r[1][i] = (int32_t)batch->right.r[i];
		batch->covers[i] = 0;
		batch->x0[i] = INT32_MAX;
		batch->x1[i] = INT32_MIN;
		batch->y0[i] = batch->y1[i] = batch->start[i] = batch->pixels[i] = 0;
	}
	for (int row = 0; row < loop_min(rows, ACCEL_LOOP_ROWS); row++) {
		for (int i = 0; i < count; i++)
			loop_step_row(batch, row, i, &visible, &out);
		batch->row[row] = out;
	}
}
