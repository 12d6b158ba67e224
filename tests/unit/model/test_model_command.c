// SPDX-License-Identifier: MIT
/* What each packet does when nothing is wrong with it. */
#include "model_test.h"

#define TILE 64
#define PIXELS (TILE * TILE)
#define DEPTH_FIRST PIXELS /* where depth starts if both are answered */

#define ANSWER_BOTH                                        \
	(struct gloss_tile_end)                            \
	{                                                  \
		.colour_output = GLOSS_TILE_OUTPUT_ANSWER, \
		.depth_output = GLOSS_TILE_OUTPUT_ANSWER   \
	}

static void empty_stream_does_nothing(void **state)
{
	struct model_test *t = *state;

	run_whole(t);
	assert_int_equal(t->status.response_words, 0);
}

static void nop_skips_its_payload_unread(void **state)
{
	struct model_test *t = *state;

	gloss_nop_pack(t->words, GLOSS_LENGTH_MAX);
	memset(t->words + 1, 0xff, 4 * GLOSS_LENGTH_MAX);
	t->job.stream_words = 1 + GLOSS_LENGTH_MAX;
	gloss_nop_pack(t->words + t->job.stream_words++, 0);
	put_counters(t);
	run_whole(t);
	assert_int_equal(t->status.response_words, 4);
}

static void write_memory_writes_little_endian_words(void **state)
{
	struct model_test *t = *state;

	memset(t->memory, 0xee, sizeof(t->memory));
	set_slot(t, 5, 8192, 4096, GLOSS_RIGHTS_WRITE);
	put_write_memory(t, 5, 12, 3);
	put(t, 0x04030201);
	put(t, 0x08070605);
	put(t, 0x0c0b0a09);
	run_whole(t);
	for (int n = 0; n < 12; n++)
		assert_int_equal(t->memory[8192 + 12 + n], n + 1);
	assert_int_equal(t->memory[8192 + 11], 0xee);
	assert_int_equal(t->memory[8192 + 24], 0xee);
}

static void write_memory_reaches_the_last_word_of_a_slot(void **state)
{
	struct model_test *t = *state;

	set_slot(t, 0, 4096, 4096, GLOSS_RIGHTS_WRITE);
	put_write_memory(t, 0, 4092, 1);
	put(t, 0x12345678);
	run_whole(t);
	assert_int_equal(memory_word(t, 8188), 0x12345678);
}

static void read_memory_appends_to_the_response(void **state)
{
	struct model_test *t = *state;

	for (int n = 0; n < 64; n++)
		t->memory[4096 + n] = (uint8_t)n;
	set_slot(t, 1, 4096, 64, GLOSS_RIGHTS_READ);
	put_read_memory(t, (struct gloss_read_memory){ .slot = 1, .count = 2, .offset = 4 });
	put_read_memory(t, (struct gloss_read_memory){ .slot = 1, .count = 1, .offset = 60 });
	t->job.response_words = 3;
	run_whole(t);
	assert_int_equal(t->status.response_words, 3);
	assert_int_equal(t->response[0], 0x07060504);
	assert_int_equal(t->response[1], 0x0b0a0908);
	assert_int_equal(t->response[2], 0x3f3e3d3c);
	assert_int_equal(t->response[3], 0);
}

static void read_memory_sees_what_was_written_before(void **state)
{
	struct model_test *t = *state;

	set_slot(t, 0, 4096, 64, GLOSS_RIGHTS_READ_WRITE);
	put_write_memory(t, 0, 0, 1);
	put(t, 77);
	put_read_memory(t, (struct gloss_read_memory){ .slot = 0, .count = 1 });
	put_write_memory(t, 0, 0, 1);
	put(t, 78);
	run_whole(t);
	assert_int_equal(t->response[0], 77);
	assert_int_equal(memory_word(t, 4096), 78);
}

static void tile_is_cleared_and_answered_colour_first(void **state)
{
	struct model_test *t = *state;

	put_tile_begin(t, (struct gloss_tile_begin){ .colour = 0x11223344, .depth = 0xaabbccdd });
	put_tile_end(t, ANSWER_BOTH);
	run_whole(t);
	assert_int_equal(t->status.response_words, 2 * PIXELS);
	for (int n = 0; n < PIXELS; n++) {
		assert_int_equal(t->response[n], 0x11223344);
		assert_int_equal(t->response[DEPTH_FIRST + n], 0xaabbccdd);
	}
}

/* The tile at (64, 64) of a surface of 192 by 128 pixels. */
static void tile_is_stored_by_the_pitch(void **state)
{
	struct model_test *t = *state;
	uint32_t pitch = 4 * 192, at = 64 * pitch + 4 * 64;

	set_slot(t, 2, 4096, 128 * pitch, GLOSS_RIGHTS_WRITE);
	put_colour_surface(t, (struct gloss_colour_surface){ .slot = 2, .pitch = pitch });
	put_tile_begin(t, (struct gloss_tile_begin){ .colour = 0x55667788 });
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_STORE,
						 .colour = at });
	run_whole(t);
	for (uint32_t y = 0; y < 128; y++)
		for (uint32_t x = 0; x < 192; x++)
			assert_int_equal(memory_word(t, 4096 + y * pitch + 4 * x),
					 y >= 64 && x >= 64 && x < 128 ? 0x55667788 : 0);
}

static void tile_is_loaded_as_it_was_stored(void **state)
{
	struct model_test *t = *state;

	set_slot(t, 0, 4096, 4 * PIXELS, GLOSS_RIGHTS_READ_WRITE);
	set_slot(t, 1, 4096 + 4 * PIXELS, 4 * PIXELS, GLOSS_RIGHTS_READ_WRITE);
	for (uint32_t n = 0; n < 8 * PIXELS; n++)
		t->memory[4096 + n] = (uint8_t)(n * 37 >> 3);
	put_colour_surface(t, (struct gloss_colour_surface){ .slot = 0, .pitch = 4 * TILE });
	put_depth_surface(t, (struct gloss_depth_surface){ .slot = 1, .pitch = 4 * TILE });
	put_tile_begin(t, (struct gloss_tile_begin){ .colour_load = true, .depth_load = true });
	put_tile_end(t, ANSWER_BOTH);
	run_whole(t);
	for (uint32_t n = 0; n < 2 * PIXELS; n++)
		assert_int_equal(t->response[n], memory_word(t, 4096 + 4 * n));
}

static void colour_is_stored_before_depth(void **state)
{
	struct model_test *t = *state;

	set_slot(t, 0, 4096, 4 * PIXELS + 4 * TILE, GLOSS_RIGHTS_READ_WRITE);
	put_colour_surface(t, (struct gloss_colour_surface){ .slot = 0, .pitch = 4 * TILE });
	put_depth_surface(t, (struct gloss_depth_surface){ .slot = 0, .pitch = 4 * TILE });
	put_tile_begin(t, (struct gloss_tile_begin){ .colour = 1, .depth = 2 });
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_STORE,
						 .depth_output = GLOSS_TILE_OUTPUT_STORE,
						 .colour = 4 * TILE });
	run_whole(t);
	assert_int_equal(memory_word(t, 4096 + 4 * (PIXELS - 1)), 2);
	assert_int_equal(memory_word(t, 4096 + 4 * PIXELS), 1);
}

static void surface_may_change_inside_a_tile(void **state)
{
	struct model_test *t = *state;

	set_slot(t, 0, 4096, 4 * PIXELS, GLOSS_RIGHTS_READ_WRITE);
	set_slot(t, 1, 65536, 4 * PIXELS, GLOSS_RIGHTS_READ_WRITE);
	put_colour_surface(t, (struct gloss_colour_surface){ .slot = 0, .pitch = 4 * TILE });
	put_tile_begin(t, (struct gloss_tile_begin){ .colour = 9 });
	put_colour_surface(t, (struct gloss_colour_surface){ .slot = 1, .pitch = 4 * TILE });
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_STORE });
	run_whole(t);
	assert_int_equal(memory_word(t, 4096), 0);
	assert_int_equal(memory_word(t, 65536), 9);
}

static void counters_count_from_the_start_of_the_job(void **state)
{
	struct model_test *t = *state;
	static const uint32_t expected[] = { 3, 2 * PIXELS + 10 * 20, PIXELS, 2 };

	for (int job = 0; job < 2; job++) {
		put_tile_begin(t, (struct gloss_tile_begin){ .depth = 0xffffff });
		put_depth_state(t, (struct gloss_depth_state){ GLOSS_COMPARE_LESS, true });
		put_cover(t, 0, 0, 5);
		put_cover(t, 0, 0, 5);
		put_tile_end(t, (struct gloss_tile_end){ 0 });
		put_tile_begin(t, (struct gloss_tile_begin){ .depth = 0 });
		put_scissor(t, (struct gloss_scissor){ 10, 20, 20, 40 });
		put_cover(t, 0, 0, 5);
		put_tile_end(t, (struct gloss_tile_end){ 0 });
		put_counters(t);
		run_whole(t);
		assert_int_equal(t->status.response_words, 4);
		assert_memory_equal(t->response, expected, sizeof(expected));
	}
}

static void scissor_is_half_open(void **state)
{
	struct model_test *t = *state;

	put_tile_begin(t, (struct gloss_tile_begin){ 0 });
	put_scissor(t, (struct gloss_scissor){ .x0 = 3, .y0 = 5, .x1 = 60, .y1 = 64 });
	put_cover(t, 0xffffff, 0xff, 0);
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_ANSWER });
	run_whole(t);
	for (int y = 0; y < TILE; y++)
		for (int x = 0; x < TILE; x++)
			assert_int_equal(t->response[y * TILE + x],
					 x >= 3 && x < 60 && y >= 5 ? 0xffffffff : 0);
}

static void colour_mask_keeps_channels(void **state)
{
	static const uint32_t bytes[] = { 0xff, 0xff00, 0xff0000, 0xff000000 };

	for (unsigned int mask = 0; mask < 16; mask++) {
		struct model_test *t = *state;
		uint32_t written = 0;

		for (int n = 0; n < 4; n++)
			written |= mask >> n & 1 ? bytes[n] : 0;
		put_tile_begin(t, (struct gloss_tile_begin){ .colour = 0x11223344 });
		put_colour_mask(t, (struct gloss_colour_mask){ mask & 1, mask & 2, mask & 4,
							       mask & 8 });
		put_cover(t, 0xccddee, 0xbb, 0);
		put_tile_end(t,
			     (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_ANSWER });
		run_whole(t);
		assert_int_equal(t->response[0], (0x11223344 & ~written) | (0xbbccddee & written));
	}
}

/* Depth 100 drawn over 99, 100 and 101; stencil stays whatever happens. */
static void depth_functions_compare_new_with_stored(void **state)
{
	static const bool passes[8][3] = {
		[GLOSS_COMPARE_NEVER] = { false, false, false },
		[GLOSS_COMPARE_LESS] = { false, false, true },
		[GLOSS_COMPARE_EQUAL] = { false, true, false },
		[GLOSS_COMPARE_LEQUAL] = { false, true, true },
		[GLOSS_COMPARE_GREATER] = { true, false, false },
		[GLOSS_COMPARE_NOTEQUAL] = { true, false, true },
		[GLOSS_COMPARE_GEQUAL] = { true, true, false },
		[GLOSS_COMPARE_ALWAYS] = { true, true, true },
	};
	struct model_test *t = *state;

	for (unsigned int func = 0; func < 8; func++) {
		for (unsigned int n = 0; n < 6; n++) {
			bool write = n & 1, pass = passes[func][n / 2];
			uint32_t old = 0x5a000000 + 99 + n / 2;

			put_tile_begin(t, (struct gloss_tile_begin){ .depth = old });
			put_depth_state(t, (struct gloss_depth_state){ (enum gloss_compare)func,
								       write });
			put_cover(t, 1, 0, 100);
			put_tile_end(t, ANSWER_BOTH);
			run_whole(t);
			assert_int_equal(t->response[0], pass);
			assert_int_equal(t->response[DEPTH_FIRST],
					 pass && write ? 0x5a000000 + 100 : old);
		}
	}
}

static void every_job_starts_from_the_same_state(void **state)
{
	struct model_test *t = *state;

	set_slot(t, 0, 4096, 4 * PIXELS, GLOSS_RIGHTS_READ_WRITE);
	put_colour_surface(t, (struct gloss_colour_surface){ .slot = 0, .pitch = 4 * TILE });
	put_depth_state(t, (struct gloss_depth_state){ GLOSS_COMPARE_NEVER, true });
	put_colour_mask(t, (struct gloss_colour_mask){ 0 });
	put_scissor(t, (struct gloss_scissor){ 0 });
	run_whole(t);
	put_tile_begin(t, (struct gloss_tile_begin){ .depth = 7 });
	put_cover(t, 0x030201, 4, 5);
	put_tile_end(t, ANSWER_BOTH);
	run_whole(t);
	for (int n = 0; n < PIXELS; n++) {
		assert_int_equal(t->response[n], 0x04030201);
		assert_int_equal(t->response[DEPTH_FIRST + n], 7);
	}
	put_tile_begin(t, (struct gloss_tile_begin){ 0 });
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_STORE });
	run(t);
	assert_int_equal(t->status.cause, GLOSS_FAULT_ORDER);
}

/* The smallest tile of the interface has its own bounds: 32 pixels, 128 bytes. */
static void tile_of_32_pixels(void **state)
{
	struct model_test *t = *state;

	set_slot(t, 0, 4096, 31 * 256 + 128, GLOSS_RIGHTS_READ_WRITE);
	put_colour_surface(t, (struct gloss_colour_surface){ .slot = 0, .pitch = 256 });
	put_tile_begin(t, (struct gloss_tile_begin){ .colour = 3 });
	put_scissor(t, (struct gloss_scissor){ 0, 0, 32, 32 });
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_STORE,
						 .depth_output = GLOSS_TILE_OUTPUT_ANSWER });
	run_whole(t);
	assert_int_equal(t->status.response_words, 32 * 32);
	assert_int_equal(memory_word(t, 4096 + 31 * 256 + 124), 3);
	assert_int_equal(memory_word(t, 4096 + 128), 0);
}

static void not_a_job(void **state)
{
	struct model_test *t = *state;
	struct gloss_status status = { GLOSS_FAULT_NONE, 11, 12 };

	set_slot(t, 3, 2048, 4, GLOSS_RIGHTS_READ);
	assert_int_equal(model_run(&t->model, &t->job, &status), -EINVAL);
	set_slot(t, 3, MODEL_TEST_MEMORY - 4096, 4097, GLOSS_RIGHTS_NONE);
	assert_int_equal(model_run(&t->model, &t->job, &status), -EINVAL);
	set_slot(t, 3, 0xfffff000, 0xffffffff, GLOSS_RIGHTS_READ);
	assert_int_equal(model_run(&t->model, &t->job, &status), -EINVAL);
	set_slot(t, 3, 0xffffffff, 0, GLOSS_RIGHTS_READ);
	t->job.response = NULL;
	assert_int_equal(model_run(&t->model, &t->job, &status), -EINVAL);
	t->job.response_words = 0;
	t->job.stream = NULL;
	assert_int_equal(model_run(&t->model, &t->job, &status), 0);
	t->job.stream_words = 1;
	assert_int_equal(model_run(&t->model, &t->job, &status), -EINVAL);
	assert_int_equal(model_init(&t->model, 16, NULL, 0), -EINVAL);
	assert_int_equal(model_init(&t->model, 48, NULL, 0), -EINVAL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		model_test(empty_stream_does_nothing),
		model_test(nop_skips_its_payload_unread),
		model_test(write_memory_writes_little_endian_words),
		model_test(write_memory_reaches_the_last_word_of_a_slot),
		model_test(read_memory_appends_to_the_response),
		model_test(read_memory_sees_what_was_written_before),
		model_test(tile_is_cleared_and_answered_colour_first),
		model_test(tile_is_stored_by_the_pitch),
		model_test(tile_is_loaded_as_it_was_stored),
		model_test(colour_is_stored_before_depth),
		model_test(surface_may_change_inside_a_tile),
		model_test(counters_count_from_the_start_of_the_job),
		model_test(scissor_is_half_open),
		model_test(colour_mask_keeps_channels),
		model_test(depth_functions_compare_new_with_stored),
		model_test(every_job_starts_from_the_same_state),
		model_test_32(tile_of_32_pixels),
		model_test(not_a_job),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
