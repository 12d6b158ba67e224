// SPDX-License-Identifier: MIT
/* A board of the port's and the core's model does what the core's model does alone. */
#include "board_model_test.h"
#include "port_host.h"

static const struct gloss_board_ops *const boards[] = { &gloss_board_model_t32,
							&gloss_board_model_t64 };

static void run_on_board(struct port_host *host, const struct gloss_job_descriptor *d)
{
	port_host_start(host, 0, GLOSS_REG_INTERRUPT_MASK_DONE);
	port_host_push(host, d);
	port_host_ring(host);
	port_host_work(host);
	assert_int_equal(host->events, 1);
}

static void assert_same(struct port_host *host, const struct gloss_job_descriptor *d,
			const struct gloss_status *status)
{
	struct gloss_completion completion = port_host_completion(host, 0);
	uint64_t list = (uint64_t)d->response_list_high << 32 | d->response_list_low;

	assert_int_equal(completion.sequence, d->sequence);
	assert_int_equal(completion.cause, status->cause);
	assert_int_equal(completion.offset, status->offset);
	assert_int_equal(completion.response_words, status->response_words);
	for (uint32_t n = 0; n < status->response_words; n++)
		assert_int_equal(port_host_get(host, port_host_word(host, list, n)), response[n]);
	assert_memory_equal(board_memory, memory, sizeof(memory));
	assert_int_equal(port_host_read(host, GLOSS_REG_PROGRESS),
			 d->stream_words + status->response_words);
}

static void random_jobs_end_as_without_a_port(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	for (uint64_t n = 0; n < 400; n++) {
		const struct gloss_board_ops *ops = boards[n % 2];
		struct gloss_job_descriptor d;
		struct gloss_status status;
		struct port_host host;

		stream_random_valid(&job, seed + n, (int)ops->tile_size);
		if (n % 4 > 1)
			stream_random_damage(&job);
		stream_random_memory(memory, sizeof(memory), seed + n);
		memcpy(board_memory, memory, sizeof(memory));
		status = run_alone((int)ops->tile_size);
		assert_true(
			port_host_init(&host, ops, board_memory, sizeof(board_memory), seed + n));
		d = port_host_describe(&host, &job.job, (uint32_t)n);
		run_on_board(&host, &d);
		assert_same(&host, &d, &status);
		port_host_fini(&host);
	}
}

static void board_says_what_it_is(void **state)
{
	(void)state;
	for (int n = 0; n < 2; n++) {
		struct port_host host;

		assert_int_equal(boards[n]->abi, GLOSS_BOARD_ABI);
		assert_int_equal(boards[n]->version, GLOSS_VERSION);
		assert_true(port_host_init(&host, boards[n], memory, sizeof(memory), 1));
		assert_int_equal(port_host_read(&host, GLOSS_REG_CAPABILITIES),
				 boards[n]->tile_size | boards[n]->pixels_per_clock << 8 |
					 GLOSS_RING_MAX_LOG2 << 16);
		assert_int_equal(port_host_read(&host, GLOSS_REG_MEMORY_PAGES),
				 sizeof(memory) / GLOSS_PAGE_BYTES);
		port_host_fini(&host);
	}
}

static void slots_that_leave_memory_are_the_memorys_fault(void **state)
{
	struct port_host host;

	(void)state;
	for (size_t n = 0; n < sizeof(bad_slots) / sizeof(bad_slots[0]); n++) {
		static const uint32_t nop;
		struct accel_job slots = { .stream = &nop, .stream_words = 1 };
		struct gloss_job_descriptor d;

		slots.slot[n] = bad_slots[n];
		assert_true(port_host_init(&host, boards[n % 2], memory, sizeof(memory), 1));
		d = port_host_describe(&host, &slots, 1);
		run_on_board(&host, &d);
		assert_int_equal(port_host_completion(&host, 0).cause, GLOSS_FAULT_MEMORY);
		assert_int_equal(port_host_completion(&host, 0).response_words, 0);
		port_host_fini(&host);
	}
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(random_jobs_end_as_without_a_port),
		cmocka_unit_test(board_says_what_it_is),
		cmocka_unit_test(slots_that_leave_memory_are_the_memorys_fault),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
