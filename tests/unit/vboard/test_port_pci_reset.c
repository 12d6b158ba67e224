// SPDX-License-Identifier: MIT
/*
 * What the PCI port does with addresses that are refused and descriptors that no driver writes, and
 * what a reset leaves of them.
 */
#include "port_pci_test.h"

/* ---- DMA errors ---- */

static void assert_stopped(struct port_host *host, const struct port_access *access,
			   uint32_t sequence)
{
	uint64_t address = (uint64_t)port_host_read(host, R(DMA_ERROR_HIGH)) << 32 |
			   port_host_read(host, R(DMA_ERROR_LOW));

	assert_int_equal(port_host_read(host, R(STATUS)), R(STATUS_DMA_ERROR));
	assert_int_equal(address, access->address);
	assert_int_equal(port_host_read(host, R(FAULT_CAUSE)), GLOSS_FAULT_DMA);
	assert_int_equal(port_host_read(host, R(FAULT_OFFSET)), 0);
	assert_int_equal(port_host_read(host, R(FAULT_SEQUENCE)), sequence);
	assert_int_equal(port_host_read(host, R(INTERRUPT_STATUS)), R(INTERRUPT_STATUS_DMA));
	assert_int_equal(port_host_read(host, R(HEAD)), 0);
	assert_int_equal(port_host_read(host, R(JOBS)), 0);
}

/* Refuses each access of a job in turn: a descriptor, slots, entries, pages, the completion. */
static void dma_refused_anywhere_stops_the_board_until_a_reset(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 5000, 3000, 77);
	uint64_t refuse = 1;

	host->board->engine.bite = 500;
	host->board->engine.answers = 300;
	for (;; refuse++) {
		uint64_t accesses;

		host->arena_used = 32 << 10;
		host->accesses = 0;
		host->events = 0;
		port_host_start(host, 1, MASK_ALL);
		port_host_set(host, host->completion, 0);
		host->refuse = refuse;
		submit(host, &d);
		if (host->accesses < refuse)
			break;
		assert_stopped(host, &host->access[refuse - 1], refuse == 1 ? 0 : 77);
		assert_int_equal(host->accesses, refuse);
		assert_int_equal(host->events, 1);
		assert_true(host->level);
		assert_int_equal(port_host_completion(host, 0).sequence, 0);
		accesses = host->accesses;
		port_host_push(host, &d);
		port_host_ring(host);
		assert_false(port_pci_work(&host->board->port));
		assert_int_equal(host->accesses, accesses);
		port_host_write(host, R(CONTROL), R(CONTROL_RESET) | R(CONTROL_ENABLE));
		assert_power_on(host);
		assert_false(host->level);
	}
	/* A descriptor, slots, 5 + 5 of the stream, 3 + 12 of the response, a completion. */
	assert_int_equal(refuse, 2 + 10 + 15 + 1 + 1);
	assert_int_equal(port_host_completion(host, 0).sequence, 77);
}

static void dma_error_leaves_the_jobs_before_it_done(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor good = describe(host, 10, 0, 1), bad = describe(host, 10, 0, 2);

	bad.stream_list_high ^= 0x80000000;
	port_host_start(host, 2, R(INTERRUPT_MASK_DMA));
	port_host_push(host, &good);
	port_host_push(host, &bad);
	port_host_push(host, &good);
	port_host_ring(host);
	port_host_work(host);
	assert_int_equal(port_host_read(host, R(HEAD)), 1);
	assert_int_equal(port_host_completion(host, 0).sequence, 1);
	assert_int_equal(port_host_read(host, R(FAULT_SEQUENCE)), 2);
	assert_int_equal(port_host_read(host, R(DMA_ERROR_HIGH)), bad.stream_list_high);
	assert_int_equal(port_host_read(host, R(DMA_ERROR_LOW)), bad.stream_list_low);
	assert_int_equal(host->events, 1);
}

/* ---- reset ---- */

static void assert_serves(struct port_host *host)
{
	struct gloss_job_descriptor d = describe(host, 3000, 10, 4711);

	host->arena_used = 48 << 10;
	port_host_start(host, 1, R(INTERRUPT_MASK_DONE));
	submit(host, &d);
	assert_int_equal(port_host_completion(host, 0).sequence, 4711);
	assert_memory_equal(host->board->engine.stream, fake_engine_words(), 12000);
	assert_true(host->level);
}

static void reset_while_running_drops_the_job(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 8000, 8000, 1);

	host->board->engine.answers = 1;
	port_host_start(host, 2, MASK_ALL);
	port_host_push(host, &d);
	port_host_ring(host);
	assert_true(port_pci_work(&host->board->port));
	assert_in_range(port_host_read(host, R(PROGRESS)), 1, 15999);
	port_host_write(host, R(CONTROL), R(CONTROL_RESET));
	assert_power_on(host);
	host->accesses = 0;
	assert_false(port_pci_work(&host->board->port));
	assert_int_equal(host->accesses, 0);
	assert_serves(host);
}

static void reset_before_the_completion_drops_it(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 8, 0, 1);

	port_host_start(host, 2, MASK_ALL);
	host->later = 3;
	port_host_set(host, host->completion, 99);
	port_host_push(host, &d);
	port_host_ring(host);
	assert_true(port_pci_work(&host->board->port));
	assert_int_equal(host->later, 2);
	port_host_write(host, R(CONTROL), R(CONTROL_RESET));
	assert_power_on(host);
	assert_false(port_pci_work(&host->board->port));
	assert_int_equal(host->later, 2);
	assert_int_equal(port_host_completion(host, 0).sequence, 99);
	host->later = 0;
	assert_serves(host);
}

static void reset_between_jobs_and_by_the_host(void **state)
{
	struct port_host *host = *state;

	assert_serves(host);
	port_host_write(host, R(CONTROL), R(CONTROL_RESET));
	assert_power_on(host);
	assert_false(host->level);
	assert_serves(host);
	host->ops->reset(host->board);
	assert_power_on(host);
	assert_false(host->level);
	assert_serves(host);
}

/* ---- descriptors no driver writes ---- */

static void job_of_four_billion_words_takes_no_memory_and_can_be_reset(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 2048, 2048, 1);
	uint32_t before = 0;

	/* All entries the arena has behind the lists name no page: what runs into them stops. */
	d.stream_words = ~0u;
	d.response_words = ~0u;
	host->board->engine.bite = ~0u;
	port_host_start(host, 0, MASK_ALL);
	port_host_push(host, &d);
	port_host_ring(host);
	port_host_work(host);
	assert_int_equal(port_host_read(host, R(STATUS)), R(STATUS_DMA_ERROR));
	assert_true(port_host_read(host, R(PROGRESS)) >= 2048);
	port_host_write(host, R(CONTROL), R(CONTROL_RESET));

	/* Half a million entries, all the same page. */
	for (uint32_t n = 0; n < PORT_HOST_BYTES - PORT_HOST_ARENA; n += 8) {
		port_host_set(host, PORT_HOST_BASE + PORT_HOST_ARENA + n, (uint32_t)PORT_HOST_BASE);
		port_host_set(host, PORT_HOST_BASE + PORT_HOST_ARENA + n + 4,
			      (uint32_t)(PORT_HOST_BASE >> 32));
	}
	d.stream_list_low = (uint32_t)(PORT_HOST_BASE + PORT_HOST_ARENA);
	d.stream_list_high = (PORT_HOST_BASE + PORT_HOST_ARENA) >> 32;
	host->arena_used = 32 << 10;
	port_host_start(host, 0, MASK_ALL);
	port_host_push(host, &d);
	port_host_ring(host);
	for (uint32_t n = 0; n < 1000; n++) {
		assert_true(port_pci_work(&host->board->port));
		assert_true(port_host_read(host, R(PROGRESS)) > before);
		before = port_host_read(host, R(PROGRESS));
	}
	port_host_write(host, R(CONTROL), R(CONTROL_RESET));
	assert_power_on(host);
}

static void job_with_slots_outside_memory_is_the_memorys_fault(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 8, 0, 3);

	host->board->engine.refuses = true;
	port_host_start(host, 0, MASK_ALL);
	submit(host, &d);
	assert_int_equal(port_host_completion(host, 0).cause, GLOSS_FAULT_MEMORY);
	assert_int_equal(port_host_completion(host, 0).response_words, 0);
	assert_int_equal(host->board->engine.taken, 0);
	assert_int_equal(port_host_read(host, R(INTERRUPT_STATUS)),
			 R(INTERRUPT_STATUS_DONE) | R(INTERRUPT_STATUS_FAULT));
	host->board->engine.refuses = false;
	submit_empty(host, 4);
	assert_int_equal(port_host_completion(host, 0).sequence, 4);
}

static void addresses_at_the_end_of_the_bus_wrap_or_are_refused(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 2000, 0, 3);

	d.stream_list_low = 0xfffffff8;
	d.stream_list_high = 0xffffffff;
	port_host_start(host, 0, MASK_ALL);
	submit(host, &d);
	assert_int_equal(port_host_read(host, R(STATUS)), R(STATUS_DMA_ERROR));
	assert_int_equal(port_host_read(host, R(DMA_ERROR_LOW)), 0xfffffff8);
	assert_int_equal(port_host_read(host, R(DMA_ERROR_HIGH)), 0xffffffff);
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(dma_refused_anywhere_stops_the_board_until_a_reset),
		TEST(dma_error_leaves_the_jobs_before_it_done),
		TEST(reset_while_running_drops_the_job),
		TEST(reset_before_the_completion_drops_it),
		TEST(reset_between_jobs_and_by_the_host),
		TEST(job_of_four_billion_words_takes_no_memory_and_can_be_reset),
		TEST(job_with_slots_outside_memory_is_the_memorys_fault),
		TEST(addresses_at_the_end_of_the_bus_wrap_or_are_refused),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
