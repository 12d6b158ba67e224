// SPDX-License-Identifier: MIT
/* The forms of a TRIANGLE: each field arrives where it belongs, whatever form it is sent in. */
#include "accel_test.h"
#include "model/model.h"

/* clang-format off */
#define HEADER(geometry, shading) \
	{ GLOSS_GEOMETRY_##geometry, GLOSS_SHADING_##shading, .alpha = 0x80 }
/* clang-format on */

static void assert_edge(const struct model_edge *edge, int x, int step, unsigned int r,
			unsigned int m, unsigned int dy)
{
	assert_int_equal(edge->x, x);
	assert_int_equal(edge->step, step);
	assert_int_equal(edge->r, r);
	assert_int_equal(edge->m, m);
	assert_int_equal(edge->dy, dy);
}

static void assert_surface(const struct model_surface *s, const uint32_t words[6])
{
	assert_memory_equal(s, words, sizeof(*s));
}

/* Words 0x100 to 0x111 as payload from @words on. */
static void count_up(uint32_t *words)
{
	for (uint32_t n = 0; n < 18; n++)
		words[n] = 0x100 + n;
}

static void wide_fields_reach_their_extremes(void **state)
{
	struct gloss_edges_wide e = {
		.left_x = -4096,
		.left_step = 4095,
		.left_r = 0xffff,
		.left_m = 1,
		.left_dy = 2,
		.right_x = 4095,
		.right_step = -4096,
		.right_r = 3,
		.right_m = 0xffff,
		.right_dy = 4,
		.middle_x = -1,
		.middle_step = 1,
		.middle_r = 5,
		.middle_m = 6,
		.middle_dy = 0xffff,
		.first_row = 20,
		.last_row = 43,
		.switch_row = 63,
		.side = 1,
	};
	struct gloss_depth_wide d = {
		1, 0xfffffffe, 3, .z_high = 0xff, .dx_high = 0x80, .dy_high = 0x7f
	};
	struct gloss_triangle header = HEADER(WIDE, FLAT);
	uint32_t words[15] = { 0 };
	struct model_triangle t;

	(void)state;
	gloss_triangle_pack(words, &header);
	gloss_edges_wide_pack(words + 1, &e);
	gloss_depth_wide_pack(words + 10, &d);
	words[14] = 0xff7f01;
	model_triangle_unpack(words, 64, &t);
	assert_edge(&t.left, -4096, 4095, 0xffff, 1, 2);
	assert_edge(&t.right, 4095, -4096, 3, 0xffff, 4);
	assert_edge(&t.middle, -1, 1, 5, 6, 0xffff);
	assert_int_equal(t.first_row, 20);
	assert_int_equal(t.last_row, 43);
	assert_int_equal(t.switch_row, 63);
	assert_int_equal(t.side, 1);
	assert_true(t.depth.z == 0xff00000001);
	assert_true(t.depth.dx == 0x80fffffffe);
	assert_true(t.depth.dy == 0x7f00000003);
	assert_surface(&t.red, (uint32_t[6]){ 0x01u << 22 });
	assert_surface(&t.green, (uint32_t[6]){ 0x7fu << 22 });
	assert_surface(&t.blue, (uint32_t[6]){ 0xffu << 22 });
	assert_surface(&t.alpha, (uint32_t[6]){ 0x80u << 22 });
}

static void compact_fields_are_extended(void **state)
{
	struct gloss_edges_compact e = {
		.left_x = -128,
		.left_step = 127,
		.left_r = 1023,
		.left_m = 1,
		.left_dy = 2,
		.right_x = 127,
		.right_step = -128,
		.right_r = 3,
		.right_m = 1023,
		.right_dy = 4,
		.middle_x = -1,
		.middle_step = 1,
		.middle_r = 5,
		.middle_m = 6,
		.middle_dy = 1023,
		.first_row = 63,
		.switch_row = 9,
	};
	struct gloss_depth_compact d = { INT32_MIN, -1, INT32_MAX };
	struct gloss_triangle header = HEADER(COMPACT, LINEAR);
	uint32_t words[1 + 9 + 18] = { 0 };
	struct model_triangle t;

	(void)state;
	gloss_triangle_pack(words, &header);
	gloss_edges_compact_pack(words + 1, &e);
	gloss_depth_compact_pack(words + 7, &d);
	count_up(words + 10);
	model_triangle_unpack(words, 64, &t);
	assert_edge(&t.left, -128, 127, 1023, 1, 2);
	assert_edge(&t.right, 127, -128, 3, 1023, 4);
	assert_edge(&t.middle, -1, 1, 5, 6, 1023);
	assert_int_equal(t.first_row, 63);
	assert_int_equal(t.last_row, 0);
	assert_int_equal(t.switch_row, 9);
	assert_int_equal(t.side, 0);
	assert_true((t.depth.z & 0xffffffffff) == 0xe000000000);
	assert_true((t.depth.dx & 0xffffffffff) == 0xffffffffc0);
	assert_true((t.depth.dy & 0xffffffffff) == 0x1fffffffc0);
	assert_surface(&t.red, (uint32_t[6]){ 0x100, 0x101, 0x102 });
	assert_surface(&t.green, (uint32_t[6]){ 0x103, 0x104, 0x105 });
	assert_surface(&t.blue, (uint32_t[6]){ 0x106, 0x107, 0x108 });
}

static void covering_is_the_whole_tile(void **state)
{
	struct gloss_triangle header = HEADER(COVERING, SECOND_ORDER);
	uint32_t words[1 + 4 + 3 + 18] = { 0 };
	struct model_scissor scissor = { 0, 0, 32, 32 };
	struct model_triangle t;
	struct model_spans spans;

	(void)state;
	header.alpha_linear = true;
	gloss_triangle_pack(words, &header);
	words[5] = 7;
	words[6] = 8;
	words[7] = 9;
	count_up(words + 8);
	model_triangle_unpack(words, 32, &t);
	assert_surface(&t.alpha, (uint32_t[6]){ 7, 8, 9 });
	assert_surface(&t.red, (uint32_t[6]){ 0x100, 0x101, 0x102, 0x103, 0x104, 0x105 });
	assert_surface(&t.green, (uint32_t[6]){ 0x106, 0x107, 0x108, 0x109, 0x10a, 0x10b });
	assert_surface(&t.blue, (uint32_t[6]){ 0x10c, 0x10d, 0x10e, 0x10f, 0x110, 0x111 });
	assert_int_equal(model_raster_anchor(&t, 32), 0);
	model_raster_spans(&t, &scissor, &spans);
	assert_int_equal(spans.rows, 32);
	assert_int_equal(spans.pixels, 32 * 32);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(wide_fields_reach_their_extremes),
		cmocka_unit_test(compact_fields_are_extended),
		cmocka_unit_test(covering_is_the_whole_tile),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
