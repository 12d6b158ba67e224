// SPDX-License-Identifier: MIT
/* Edges: exact where they come from a division, defined where they do not, and switched in time. */
#include "accel_test.h"
#include "model/model.h"

static const struct model_scissor whole = { 0, 0, 64, 64 };

/* Divides rounding up; @b is positive. */
static int64_t ceil_div(int64_t a, int64_t b)
{
	return a / b + (a % b > 0);
}

/* An edge through (x, y) that goes dx while it goes down dy, in 1/16 pixel. */
struct line {
	int64_t x, y, dx, dy;
};

/* First column whose centre is not left of the line at the centre of @row. */
static int64_t column(const struct line *l, int row)
{
	return ceil_div((l->x - 8) * l->dy + (16 * row + 8 - l->y) * l->dx, 16 * l->dy);
}

/* The line in remainder form at row 0; the remainder of the ceiling counts in units of 16. */
static struct model_edge edge(const struct line *l)
{
	int64_t n = (l->x - 8) * l->dy + (8 - l->y) * l->dx + 16 * l->dy - 1;
	int64_t x = ceil_div(n - 16 * l->dy + 1, 16 * l->dy), step = -ceil_div(-l->dx, l->dy);

	return (struct model_edge){ .x = (int32_t)x,
				    .step = (int32_t)step,
				    .r = (uint32_t)((n - 16 * l->dy * x) / 16),
				    .m = (uint32_t)(l->dx - step * l->dy),
				    .dy = (uint32_t)l->dy };
}

/* Small and large, up to the greatest dy that is exact. */
static struct line random_line(uint64_t *seed)
{
	uint32_t high = 16u << test_below(seed, 12), wide = 16u << test_below(seed, 8);
	struct line l;

	l.dy = 1 + test_below(seed, high);
	l.y = -(int64_t)test_below(seed, high);
	l.x = (int64_t)test_below(seed, 2048) - 512;
	l.dx = (int64_t)test_below(seed, 2 * wide) - wide;
	if (l.dx > 16 * l.dy || l.dx < -16 * l.dy)
		l.dx %= 16 * l.dy;
	return l;
}

static struct model_triangle between(struct model_edge left, struct model_edge right)
{
	return (struct model_triangle){ .left = left, .right = right, .last_row = 63 };
}

static void edges_are_exact(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	for (int n = 0; n < 100000; n++) {
		struct line l = random_line(&seed);
		struct model_triangle t = between(edge(&l), edge(&l));
		struct model_walk walk;
		struct model_span span;

		assert_true(t.left.r < t.left.dy && t.left.m < t.left.dy);
		t.right = (struct model_edge){ .x = 4095, .dy = 1 };
		model_raster_begin(&walk, &t);
		for (int row = 0; row < 64; row++) {
			struct model_scissor line = { -4096, row, 4095, row + 1 };

			if (column(&l, row) > 4094 || column(&l, row) < -4096)
				break;
			assert_true(model_raster_next(&walk, &line, &span));
			if (span.x0 != column(&l, row))
				fail_msg("line %d: column %d in row %d, not %d", n, span.x0, row,
					 (int)column(&l, row));
		}
	}
}

/* Two triangles that share an edge: what is right of one is left of the other. */
static void shared_edge_is_drawn_once(void **state)
{
	uint64_t seed = test_seed();
	const struct model_edge first = { .x = 0, .dy = 1 }, last = { .x = 64, .dy = 1 };

	(void)state;
	for (int n = 0; n < 2000; n++) {
		struct line l = random_line(&seed);
		struct model_triangle t = between(first, edge(&l)), u = between(edge(&l), last);
		struct model_spans spans;
		int pixels;

		model_raster_spans(&t, &whole, &spans);
		pixels = spans.pixels;
		model_raster_spans(&u, &whole, &spans);
		assert_int_equal(pixels + spans.pixels, 64 * 64);
	}
}

/* What a row is, of a triangle with left edges at 10 and 20 and right ones at 30 and 40. */
static void assert_row(int switch_row, int side, int row, int x0, int x1)
{
	struct model_triangle t = between((struct model_edge){ .x = 10, .dy = 1 },
					  (struct model_edge){ .x = 30, .dy = 1 });
	struct model_spans spans;

	t.middle = (struct model_edge){ .x = 20, .step = 1, .dy = 1 };
	t.switch_row = switch_row;
	t.side = side;
	t.first_row = 2;
	t.last_row = 9;
	model_raster_spans(&t, &whole, &spans);
	assert_int_equal(spans.rows, 10);
	assert_int_equal(spans.y[row], 2 + row);
	assert_int_equal(spans.x0[row], x0);
	assert_int_equal(spans.x0[row] + spans.count[row], x1);
}

static void middle_edge_starts_as_sent_at_its_row(void **state)
{
	(void)state;
	assert_row(5, 0, 4, 10, 30);
	assert_row(5, 0, 5, 20, 30);
	assert_row(5, 0, 6, 21, 30);
	assert_row(5, 1, 4, 10, 30);
	assert_row(5, 1, 5, 10, 20);
	assert_row(5, 1, 6, 10, 21);
}

static void switch_row_0_and_rows_past_the_last_are_never(void **state)
{
	(void)state;
	assert_row(0, 0, 0, 10, 30);
	assert_row(0, 0, 9, 10, 30);
	assert_row(10, 1, 9, 10, 30);
}

static int32_t x_after(struct model_edge edge, int rows)
{
	struct model_triangle t = between(edge, (struct model_edge){ .x = 4095, .dy = 1 });
	const struct model_scissor scissor = { -4096, rows, 4095, rows + 1 };
	struct model_walk walk;
	struct model_span span;

	model_raster_begin(&walk, &t);
	return model_raster_next(&walk, &scissor, &span) ? span.x0 : 4095;
}

static void registers_wrap_before_they_are_compared(void **state)
{
	(void)state;
	/* r + m = 0x10001 loses its carry: 1 < dy */
	assert_int_equal(x_after((struct model_edge){ 0, 0, 0xffff, 2, 2 }, 1), 0);
	/* ... and 2 >= dy */
	assert_int_equal(x_after((struct model_edge){ 0, 0, 0xffff, 3, 2 }, 1), 1);
	/* r may stay above dy: it is reduced once a row */
	assert_int_equal(x_after((struct model_edge){ 0, 0, 100, 0, 10 }, 20), 10);
	/* dy 0 is always reached */
	assert_int_equal(x_after((struct model_edge){ 0, 0, 0, 0, 0 }, 5), 5);
	/* x comes round at 13 bits */
	assert_int_equal(x_after((struct model_edge){ 4090, 6, 0, 0, 1 }, 1), -4096);
	assert_int_equal(x_after((struct model_edge){ -4096, -1, 0, 0, 1 }, 1), 4095);
	assert_int_equal(x_after((struct model_edge){ 4000, 95, 5, 1, 6 }, 1), -4096);
}

static int anchor_at(int x)
{
	struct model_triangle t = between((struct model_edge){ .x = x }, (struct model_edge){ 0 });

	return model_raster_anchor(&t, 64);
}

static void anchor_is_in_the_tile_at_a_multiple_of_8(void **state)
{
	(void)state;
	assert_int_equal(anchor_at(-4096), 0);
	assert_int_equal(anchor_at(-1), 0);
	assert_int_equal(anchor_at(7), 0);
	assert_int_equal(anchor_at(8), 8);
	assert_int_equal(anchor_at(63), 56);
	assert_int_equal(anchor_at(64), 56);
	assert_int_equal(anchor_at(4095), 56);
}

static void scissor_cuts_rows_and_columns(void **state)
{
	struct model_triangle t = between((struct model_edge){ .x = -100, .dy = 1 },
					  (struct model_edge){ .x = 200, .dy = 1 });
	const struct model_scissor scissor = { 5, 7, 20, 9 }, empty = { 9, 0, 9, 64 };
	struct model_spans spans;

	(void)state;
	model_raster_spans(&t, &scissor, &spans);
	assert_int_equal(spans.rows, 2);
	assert_int_equal(spans.y[0], 7);
	assert_int_equal(spans.x0[0], 5);
	assert_int_equal(spans.pixels, 30);
	assert_int_equal(spans.blocks, 4);
	assert_int_equal(spans.longest, 15);
	model_raster_spans(&t, &empty, &spans);
	assert_int_equal(spans.rows, 0);
	assert_int_equal(spans.pixels, 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(edges_are_exact),
		cmocka_unit_test(shared_edge_is_drawn_once),
		cmocka_unit_test(middle_edge_starts_as_sent_at_its_row),
		cmocka_unit_test(switch_row_0_and_rows_past_the_last_are_never),
		cmocka_unit_test(registers_wrap_before_they_are_compared),
		cmocka_unit_test(anchor_is_in_the_tile_at_a_multiple_of_8),
		cmocka_unit_test(scissor_cuts_rows_and_columns),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
