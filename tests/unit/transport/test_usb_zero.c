/* SPDX-License-Identifier: MIT */
/* The stream that makes board memory zero, on the model. */
#include "transport/usb/zero.h"
#include "model/model_test.h"

#define DIRT 0xa5

static void clear_tiles(struct model_test *t, uint32_t tile_size, uint32_t base, uint32_t tiles)
{
	t->job.stream_words = accel_usb_zero_words(tiles);
	assert_true(t->job.stream_words <= MODEL_TEST_WORDS);
	accel_usb_zero_pack(t->words, tile_size, tiles);
	set_slot(t, 0, base, tiles * accel_usb_zero_tile_bytes(tile_size), GLOSS_RIGHTS_WRITE);
	assert_int_equal(model_run(&t->model, &t->job, &t->status), 0);
	assert_int_equal(t->status.cause, GLOSS_FAULT_NONE);
	assert_int_equal(t->status.response_words, 0);
}

static void check_cleared(uint32_t tile_size, uint32_t base, uint32_t tiles)
{
	struct model_test *t = model_test_new((int)tile_size);
	uint32_t end = base + tiles * accel_usb_zero_tile_bytes(tile_size);

	memset(t->memory, DIRT, sizeof(t->memory));
	clear_tiles(t, tile_size, base, tiles);
	for (uint32_t n = 0; n < sizeof(t->memory); n++)
		if (t->memory[n] != (n >= base && n < end ? 0 : DIRT))
			fail_msg("%u tiles of %u from %u: byte %u is %02x", tiles, tile_size, base,
				 n, t->memory[n]);
	free(t);
}

static void the_slot_is_zero_and_nothing_else(void **state)
{
	(void)state;
	for (uint32_t tile_size = 32; tile_size <= 64; tile_size *= 2) {
		uint32_t bytes = accel_usb_zero_tile_bytes(tile_size);

		check_cleared(tile_size, 0, 1);
		check_cleared(tile_size, 4096, 1);
		check_cleared(tile_size, 4096, 5);
		check_cleared(tile_size, 0, MODEL_TEST_MEMORY / bytes);
		check_cleared(tile_size, MODEL_TEST_MEMORY - bytes, 1);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_slot_is_zero_and_nothing_else),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
