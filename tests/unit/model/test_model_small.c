// SPDX-License-Identifier: MIT
/* A TRIANGLE_SMALL: what its short numbers stand for, and which pixels its rows are. */
#include "accel_test.h"
#include "model/model.h"

#define WORDS_MAX 16
#define ROUNDS 2000

static void pack_head(uint32_t *words, enum gloss_shading shading, enum gloss_row_words row_words,
		      const struct gloss_pixels_small *pixels)
{
	gloss_triangle_small_pack(words, &(struct gloss_triangle_small){ shading, row_words, 200 });
	gloss_pixels_small_pack(words + 1, pixels);
}

static void assert_surface(const struct model_surface *s, const uint32_t words[6])
{
	assert_memory_equal(s, words, sizeof(*s));
}

static void depth_has_a_scale(void **state)
{
	struct gloss_depth_small depth = { .z = -1, .dx = -16384, .dy = 16383, .scale = 3 };
	uint32_t words[WORDS_MAX] = { 0 };
	struct model_triangle t;

	(void)state;
	pack_head(words, GLOSS_SHADING_FLAT, GLOSS_ROW_WORDS_NONE,
		  &(struct gloss_pixels_small){ 0 });
	gloss_depth_small_pack(words + 2, &depth);
	words[4] = 0xff7f01;
	model_triangle_small_unpack(words, &t);
	assert_true((t.depth.z & 0xffffffffff) == 0xffffffff00);
	assert_true((t.depth.dx & 0xffffffffff) == 0xfc00000000);
	assert_true((t.depth.dy & 0xffffffffff) == 0x03fff00000);
	assert_surface(&t.red, (uint32_t[6]){ 0x01u << 22 });
	assert_surface(&t.green, (uint32_t[6]){ 0x7fu << 22 });
	assert_surface(&t.blue, (uint32_t[6]){ 0xffu << 22 });
	assert_surface(&t.alpha, (uint32_t[6]){ 200u << 22 });
}

static void slopes_have_a_scale_and_bends_one_each(void **state)
{
	struct gloss_colour_second_order_small colour = {
		.red = -512,
		.green = 511,
		.blue = 7,
		.slope_scale = 3,
		.red_fraction = 255,
		.red_dx = -2048,
		.red_dy = 2047,
		.green_dx = 1,
		.blue_fraction = 1,
		.blue_dy = -1,
		.red_dxx = -512,
		.red_dxy = 511,
		.red_dyy = -1,
		.red_scale = 3,
		.green_dyy = 1,
		.blue_dxx = 2,
		.blue_scale = 1,
	};
	uint32_t words[WORDS_MAX] = { 0 };
	struct model_triangle t;

	(void)state;
	pack_head(words, GLOSS_SHADING_SECOND_ORDER, GLOSS_ROW_WORDS_NONE,
		  &(struct gloss_pixels_small){ 0 });
	gloss_colour_second_order_small_pack(words + 4, &colour);
	model_triangle_small_unpack(words, &t);
	assert_surface(&t.red, (uint32_t[6]){ 0x803fc000, 0x80000000, 0x7ff00000, 0xf0000000,
					      0x0ff80000, 0xfff80000 });
	assert_surface(&t.green, (uint32_t[6]){ 0x7fc00000, 1u << 20, 0, 0, 0, 1u << 10 });
	assert_surface(&t.blue, (uint32_t[6]){ 0x01c04000, 0, 0xfff00000, 1u << 14, 0, 0 });
}

static void a_linear_form_is_the_start_of_a_second_order_one(void **state)
{
	uint32_t words[WORDS_MAX] = { 0 };
	struct model_triangle linear, second;

	(void)state;
	for (uint32_t n = 2; n < 8; n++)
		words[n] = n * 0x12345679;
	pack_head(words, GLOSS_SHADING_LINEAR, GLOSS_ROW_WORDS_NONE,
		  &(struct gloss_pixels_small){ 0 });
	model_triangle_small_unpack(words, &linear);
	pack_head(words, GLOSS_SHADING_SECOND_ORDER, GLOSS_ROW_WORDS_NONE,
		  &(struct gloss_pixels_small){ 0 });
	model_triangle_small_unpack(words, &second);
	assert_memory_equal(&linear.red, &second.red, sizeof(linear.red));
	assert_memory_equal(&linear.green, &second.green, sizeof(linear.green));
	assert_memory_equal(&linear.blue, &second.blue, sizeof(linear.blue));
}

/* Sixteen rows, the first from 15 to 0 and so without a pixel. */
static void rows_are_the_pixels_that_they_list(void **state)
{
	struct gloss_pixels_small pixels = {
		.x = 40,
		.first_row = 30,
		.last_row = 15,
		.first_0 = 15,
		.first_1 = 1,
		.last_1 = 14,
	};
	struct model_scissor scissor = { 0, 0, 64, 64 };
	uint32_t words[WORDS_MAX] = { 0 };
	struct model_triangle t;
	struct model_spans spans;

	(void)state;
	pack_head(words, GLOSS_SHADING_FLAT, GLOSS_ROW_WORDS_FOUR, &pixels);
	for (int row = 2; row < 16; row++)
		words[5 + (row - 2) / 4] |= (uint32_t)(0xf0 | row) << 8 * ((row - 2) % 4);
	model_triangle_small_unpack(words, &t);
	assert_int_equal(model_raster_anchor(&t, 64), 48);
	assert_int_equal(model_raster_anchor(&t, 32), 24);
	model_raster_spans(&t, &scissor, &spans);
	assert_int_equal(spans.rows, 15);
	assert_int_equal(spans.y[0], 31);
	assert_int_equal(spans.x0[0], 41);
	assert_int_equal(spans.count[0], 14);
	for (int n = 1; n < 15; n++) {
		assert_int_equal(spans.y[n], 31 + n);
		assert_int_equal(spans.x0[n], 41 + n);
		assert_int_equal(spans.count[n], 15 - n);
	}
}

static void rows_end_at_the_tile(void **state)
{
	struct gloss_pixels_small pixels = {
		.x = 28, .last_0 = 15, .first_1 = 4, .last_1 = 4, .last_row = 1
	};
	struct model_scissor scissor = { 0, 0, 32, 32 };
	uint32_t words[WORDS_MAX] = { 0 };
	struct model_triangle t;
	struct model_spans spans;

	(void)state;
	pack_head(words, GLOSS_SHADING_FLAT, GLOSS_ROW_WORDS_NONE, &pixels);
	model_triangle_small_unpack(words, &t);
	model_raster_spans(&t, &scissor, &spans);
	assert_int_equal(spans.rows, 1);
	assert_int_equal(spans.count[0], 4);
}

/* A model in whose tile there is something, with any state. */
static void any_tile(uint64_t *seed, struct model *model)
{
	int size = test_below(seed, 2) ? 32 : 64;

	assert_int_equal(model_init(model, size, NULL, 0), 0);
	model->state = (struct model_state){
		.depth_func = (enum gloss_compare)test_below(seed, 8),
		.depth_write = test_below(seed, 2),
		.colour_mask = test_below(seed, 2) ? ~0u : 0x00ff00ff,
		.scissor = { 0, 0, size, size },
	};
	if (test_below(seed, 4) == 0)
		model->state.scissor = (struct model_scissor){ (int)test_below(seed, 33),
							       (int)test_below(seed, 33),
							       (int)test_below(seed, 33),
							       (int)test_below(seed, 33) };
	for (int n = 0; n < size * size; n++) {
		model->tile.colour[n] = (uint32_t)test_random(seed);
		model->tile.depth[n] = (uint32_t)test_random(seed);
	}
}

static void any_words(uint64_t *seed, int tile_size, uint32_t words[WORDS_MAX])
{
	struct gloss_pixels_small pixels;
	uint32_t rows = 1 + test_below(seed, 16);

	for (int n = 0; n < WORDS_MAX; n++)
		words[n] = (uint32_t)test_random(seed);
	gloss_pixels_small_unpack(words + 1, &pixels);
	pixels.first_row = test_below(seed, (uint32_t)tile_size - rows + 1);
	pixels.last_row = rows - 1;
	pack_head(words, (enum gloss_shading)test_below(seed, 3), GLOSS_ROW_WORDS_FOUR, &pixels);
}

static void they_are_drawn_as_other_triangles_are(void **state)
{
	static struct model wanted, got;
	uint64_t seed = test_seed();
	uint32_t words[WORDS_MAX];
	struct model_triangle t;

	(void)state;
	for (int n = 0; n < ROUNDS; n++) {
		any_tile(&seed, &wanted);
		any_words(&seed, wanted.tile_size, words);
		model_triangle_small_unpack(words, &t);
		got = wanted;
		model_draw_triangle(&wanted, &t);
		model_draw_small(&got, &t);
		assert_memory_equal(&got.counters, &wanted.counters, sizeof(got.counters));
		assert_memory_equal(&got.tile, &wanted.tile, sizeof(got.tile));
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(depth_has_a_scale),
		cmocka_unit_test(slopes_have_a_scale_and_bends_one_each),
		cmocka_unit_test(a_linear_form_is_the_start_of_a_second_order_one),
		cmocka_unit_test(rows_are_the_pixels_that_they_list),
		cmocka_unit_test(rows_end_at_the_tile),
		cmocka_unit_test(they_are_drawn_as_other_triangles_are),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
