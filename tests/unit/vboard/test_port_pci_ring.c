// SPDX-License-Identifier: MIT
/* The ring of the PCI port, and the events and interrupts that tell of its jobs. */
#include "port_pci_test.h"

/* ---- ring ---- */

static void ring_wraps_at_its_size_and_at_most_at_256(void **state)
{
	struct port_host *host = *state;

	port_host_start(host, 13, 0);
	assert_int_equal(port_host_read(host, R(RING_LOG2)), 13);
	for (uint32_t n = 0; n < 300; n++) {
		submit_empty(host, n);
		assert_int_equal(port_host_completion(host, n).sequence, n);
	}
	port_host_write(host, R(CONTROL), R(CONTROL_RESET));
	host->arena_used = 0;
	port_host_start(host, 1, 0);
	for (uint32_t n = 0; n < 9; n++) {
		submit_empty(host, n);
		assert_int_equal(port_host_completion(host, n).sequence, n);
	}
}

static void ring_counts_wrap_at_65536(void **state)
{
	struct port_host *host = *state;

	port_host_start(host, 4, 0);
	for (uint32_t n = 0; n < 0x10005; n++)
		submit_empty(host, n);
	assert_int_equal(port_host_read(host, R(HEAD)), 5);
	assert_int_equal(port_host_read(host, R(TAIL)), 5);
	assert_int_equal(port_host_read(host, R(JOBS)), 0x10005);
	assert_int_equal(port_host_completion(host, 4).sequence, 0x10004);
	assert_int_equal(port_host_read(host, R(STATUS)), R(STATUS_IDLE));
}

static void ring_runs_queued_jobs_in_order(void **state)
{
	struct port_host *host = *state;

	port_host_start(host, 3, R(INTERRUPT_MASK_DONE));
	for (uint32_t n = 0; n < 8; n++) {
		struct gloss_job_descriptor d = describe(host, n + 1, 0, n);

		port_host_push(host, &d);
	}
	port_host_ring(host);
	port_host_work(host);
	assert_int_equal(host->events, 8);
	for (uint32_t n = 0; n < 8; n++) {
		assert_int_equal(port_host_completion(host, n).sequence, n);
		assert_int_equal(port_host_completion(host, n).offset, n + 1);
	}
}

static void ring_overrun_by_the_driver_runs_jobs_again(void **state)
{
	struct port_host *host = *state;

	port_host_start(host, 0, 0);
	submit_empty(host, 5);
	port_host_write(host, R(TAIL), 40);
	port_host_work(host);
	assert_int_equal(port_host_read(host, R(HEAD)), 40);
	assert_int_equal(host->board->engine.ended, 40);
}

static void disabled_board_remembers_tail_and_ends_the_running_job(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 8000, 0, 1);

	port_host_start(host, 2, 0);
	port_host_push(host, &d);
	port_host_push(host, &d);
	port_host_ring(host);
	assert_true(port_pci_work(&host->board->port));
	assert_int_equal(port_host_read(host, R(STATUS)), R(STATUS_RUNNING));
	port_host_write(host, R(CONTROL), 0);
	assert_int_equal(port_host_read(host, R(STATUS)), R(STATUS_RUNNING));
	port_host_work(host);
	assert_int_equal(port_host_read(host, R(HEAD)), 1);
	assert_int_equal(port_host_read(host, R(STATUS)), R(STATUS_IDLE));
	port_host_push(host, &d);
	port_host_ring(host);
	port_host_work(host);
	assert_int_equal(port_host_read(host, R(HEAD)), 1);
	port_host_write(host, R(CONTROL), R(CONTROL_ENABLE));
	assert_int_equal(port_host_read(host, R(STATUS)), 0);
	port_host_work(host);
	assert_int_equal(port_host_read(host, R(HEAD)), 3);
}

/* ---- events ---- */

static void events_set_status_and_interrupt_by_the_mask(void **state)
{
	struct port_host *host = *state;

	for (uint32_t mask = 0; mask < 8; mask++) {
		for (uint32_t fault = 0; fault < 2; fault++) {
			uint32_t events = R(INTERRUPT_STATUS_DONE) |
					  (fault ? R(INTERRUPT_STATUS_FAULT) : 0);
			uint32_t before = host->events;

			port_host_write(host, R(CONTROL), R(CONTROL_RESET));
			host->arena_used = 0;
			port_host_start(host, 0, mask);
			host->board->engine.cause = fault ? GLOSS_FAULT_VALUE : GLOSS_FAULT_NONE;
			submit_empty(host, 1);
			assert_int_equal(port_host_read(host, R(INTERRUPT_STATUS)), events);
			assert_int_equal(host->events - before, (events & mask) != 0);
			assert_int_equal(host->level, (events & mask) != 0);
			/* Whether or not its bit was set before. */
			submit_empty(host, 2);
			assert_int_equal(host->events - before, 2 * ((events & mask) != 0));
		}
	}
}

static void event_that_was_masked_sends_no_message_later(void **state)
{
	struct port_host *host = *state;

	port_host_start(host, 0, 0);
	submit_empty(host, 1);
	port_host_write(host, R(INTERRUPT_MASK), MASK_ALL);
	port_host_work(host);
	assert_true(host->level);
	assert_int_equal(host->events, 0);
}

static void level_follows_status_and_mask(void **state)
{
	struct port_host *host = *state;

	host->board->engine.cause = GLOSS_FAULT_ORDER;
	port_host_start(host, 0, R(INTERRUPT_MASK_DONE) | R(INTERRUPT_MASK_FAULT));
	submit_empty(host, 1);
	assert_int_equal(host->levels, 1);
	port_host_write(host, R(INTERRUPT_STATUS), R(INTERRUPT_STATUS_DONE));
	assert_int_equal(port_host_read(host, R(INTERRUPT_STATUS)), R(INTERRUPT_STATUS_FAULT));
	assert_true(host->level);
	port_host_write(host, R(INTERRUPT_MASK), R(INTERRUPT_MASK_DONE));
	assert_false(host->level);
	port_host_write(host, R(INTERRUPT_MASK), R(INTERRUPT_MASK_FAULT));
	assert_true(host->level);
	port_host_write(host, R(INTERRUPT_STATUS), 0);
	assert_true(host->level);
	port_host_write(host, R(INTERRUPT_STATUS), ~0u);
	assert_false(host->level);
	assert_int_equal(port_host_read(host, R(INTERRUPT_STATUS)), 0);
	assert_int_equal(host->levels, 4);
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(ring_wraps_at_its_size_and_at_most_at_256),
		TEST(ring_counts_wrap_at_65536),
		TEST(ring_runs_queued_jobs_in_order),
		TEST(ring_overrun_by_the_driver_runs_jobs_again),
		TEST(disabled_board_remembers_tail_and_ends_the_running_job),
		TEST(events_set_status_and_interrupt_by_the_mask),
		TEST(event_that_was_masked_sends_no_message_later),
		TEST(level_follows_status_and_mask),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
