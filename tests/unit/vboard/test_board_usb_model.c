// SPDX-License-Identifier: MIT
/* A USB board of the port's and the core's model does what the core's model does alone. */
#include "board_model_test.h"
#include "usb_host.h"

static const struct gloss_usb_board_ops *const boards[] = { &gloss_usb_board_model_t32,
							    &gloss_usb_board_model_t64 };

static void start(struct usb_host *host, const struct gloss_usb_board_ops *ops, uint32_t nonce)
{
	assert_true(usb_host_init(host, ops, board_memory, sizeof(board_memory)));
	usb_host_write(host, GLOSS_REG_NONCE, nonce);
	usb_host_sync(host, nonce);
}

static void finish(struct usb_host *host, uint32_t nonce)
{
	assert_true(usb_host_run(host));
	assert_int_equal(host->sent, host->out.count);
	assert_true(usb_host_echo(host, nonce));
}

static void assert_same(struct usb_host *host, uint32_t sequence, const struct gloss_status *status)
{
	assert_true(usb_host_answer(host));
	assert_int_equal(host->completion.sequence, sequence);
	assert_int_equal(host->completion.cause, status->cause);
	assert_int_equal(host->completion.offset, status->offset);
	assert_int_equal(host->response.count, status->response_words);
	if (status->response_words)
		assert_memory_equal(host->response.word, response, 4 * status->response_words);
}

/* Several jobs behind one another, in pieces of any size. */
static void random_jobs_end_as_without_a_port(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	for (uint64_t n = 0; n < 400; n++) {
		const struct gloss_usb_board_ops *ops = boards[n % 2];
		uint64_t random = seed + n;
		struct gloss_status status;
		struct usb_host host;
		uint32_t progress;

		stream_random_valid(&job, seed + n, (int)ops->tile_size);
		if (n % 4 > 1)
			stream_random_damage(&job);
		if (n % 8 > 5)
			job.job.response_words = test_below(&random, job.job.response_words + 1);
		stream_random_memory(memory, sizeof(memory), seed + n);
		memcpy(board_memory, memory, sizeof(memory));
		start(&host, ops, (uint32_t)n + 1);
		host.offer = 1 + test_below(&random, n % 3 ? 10000 : 10);
		host.take = 1 + test_below(&random, n % 3 ? 1000 : 10);
		usb_host_job(&host, &job.job, GLOSS_SLOTS, 1);
		usb_host_job(&host, &job.job, GLOSS_SLOTS, 2);
		finish(&host, (uint32_t)n + 1);
		status = run_alone((int)ops->tile_size);
		progress = job.job.stream_words + status.response_words;
		assert_same(&host, 1, &status);
		status = run_alone((int)ops->tile_size);
		progress += job.job.stream_words + status.response_words;
		assert_same(&host, 2, &status);
		assert_true(usb_host_empty(&host));
		assert_memory_equal(board_memory, memory, sizeof(memory));
		assert_int_equal(usb_host_read(&host, GLOSS_REG_PROGRESS), progress);
		usb_host_fini(&host);
	}
}

static void board_says_what_it_is(void **state)
{
	(void)state;
	for (int n = 0; n < 2; n++) {
		struct usb_host host;

		assert_int_equal(boards[n]->abi, GLOSS_USB_BOARD_ABI);
		assert_int_equal(boards[n]->version, GLOSS_VERSION);
		start(&host, boards[n], 1);
		assert_int_equal(usb_host_read(&host, GLOSS_REG_IDENTITY), GLOSS_IDENTITY);
		assert_int_equal(usb_host_read(&host, GLOSS_REG_CAPABILITIES),
				 boards[n]->tile_size | boards[n]->pixels_per_clock << 8);
		assert_int_equal(usb_host_read(&host, GLOSS_REG_MEMORY_PAGES),
				 sizeof(memory) / GLOSS_PAGE_BYTES);
		usb_host_fini(&host);
	}
}

static void slots_that_leave_memory_are_the_memorys_fault(void **state)
{
	struct usb_host host;

	(void)state;
	for (size_t n = 0; n < sizeof(bad_slots) / sizeof(bad_slots[0]); n++) {
		static const uint32_t nop;
		struct accel_job slots = { .stream = &nop, .stream_words = 1 };

		slots.slot[n] = bad_slots[n];
		start(&host, boards[n % 2], 1);
		usb_host_job(&host, &slots, GLOSS_SLOTS, 1);
		finish(&host, 1);
		assert_true(usb_host_answer(&host));
		assert_int_equal(host.completion.cause, GLOSS_FAULT_MEMORY);
		assert_int_equal(host.response.count, 0);
		usb_host_fini(&host);
	}
}

static void reset_leaves_memory_as_it_is(void **state)
{
	uint32_t words[4];
	struct accel_job write = { .stream = words };
	struct usb_host host;

	(void)state;
	stream_random_memory(board_memory, sizeof(board_memory), 1);
	start(&host, boards[0], 1);
	write.slot[0] = (struct gloss_slot){ 4096, 4096, GLOSS_RIGHTS_READ_WRITE };
	write.stream_words = (uint32_t)packet_write(words, 0, 8, 0x12345678);
	memcpy(memory, board_memory, sizeof(memory));
	memcpy(memory + 4096 + 8, &words[3], 4);
	usb_host_job(&host, &write, 1, 1);
	finish(&host, 1);
	assert_true(usb_host_answer(&host));
	assert_true(usb_host_reset(&host, 2));
	assert_memory_equal(board_memory, memory, sizeof(memory));
	host.ops->reset(host.board);
	assert_memory_equal(board_memory, memory, sizeof(memory));
	usb_host_fini(&host);
}

/* Heads, slots and streams with bits wrong at random, then a right job after a reset. */
static void any_words_do_no_harm_after_a_reset(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	for (uint64_t n = 0; n < 400; n++) {
		const struct gloss_usb_board_ops *ops = boards[n % 2];
		uint64_t random = seed + n;
		struct gloss_status status;
		struct usb_host host;

		stream_random_valid(&job, seed + n, (int)ops->tile_size);
		stream_random_memory(board_memory, sizeof(board_memory), seed + n);
		start(&host, ops, 1);
		usb_host_job(&host, &job.job, GLOSS_SLOTS, 1);
		usb_host_job(&host, &job.job, GLOSS_SLOTS, 2);
		for (uint32_t flips = 1 + test_below(&random, 3); flips; flips--) {
			uint32_t behind = host.out.count - GLOSS_USB_SYNC_WORDS;
			uint32_t most = test_below(&random, 2) ? 68 : behind;

			host.out.word[GLOSS_USB_SYNC_WORDS + test_below(&random, most)] ^=
				1u << test_below(&random, 32);
		}
		finish(&host, 1);
		assert_true(usb_host_reset(&host, 2));
		memcpy(memory, board_memory, sizeof(memory));
		status = run_alone((int)ops->tile_size);
		usb_host_sync(&host, 2);
		usb_host_job(&host, &job.job, GLOSS_SLOTS, 3);
		finish(&host, 2);
		assert_same(&host, 3, &status);
		assert_true(usb_host_empty(&host));
		assert_memory_equal(board_memory, memory, sizeof(memory));
		usb_host_fini(&host);
	}
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(random_jobs_end_as_without_a_port),
		cmocka_unit_test(board_says_what_it_is),
		cmocka_unit_test(slots_that_leave_memory_are_the_memorys_fault),
		cmocka_unit_test(any_words_do_no_harm_after_a_reset),
		cmocka_unit_test(reset_leaves_memory_as_it_is),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
