// SPDX-License-Identifier: MIT
/* The model of the PCI port, around an engine that does what a test tells it. */
#include "port_pci_test.h"

/* ---- registers ---- */

static void registers_are_zero_after_power_on(void **state)
{
	struct port_host *host = *state;

	assert_power_on(host);
	assert_false(port_pci_work(&host->board->port));
	assert_int_equal(host->accesses, 0);
}

static void registers_keep_the_bits_that_can_be_written(void **state)
{
	static const struct {
		uint32_t offset, bits;
	} kept[] = {
		{ R(INTERRUPT_MASK), 7 },    { R(RING_LOW), ~0u },
		{ R(RING_HIGH), ~0u },       { R(RING_LOG2), 15 },
		{ R(TAIL), 0xffff },         { R(COMPLETION_LOW), ~0u },
		{ R(COMPLETION_HIGH), ~0u }, { R(CONTROL), R(CONTROL_ENABLE) },
	};
	struct port_host *host = *state;

	for (size_t n = 0; n < sizeof(kept) / sizeof(kept[0]); n++) {
		uint32_t value = kept[n].offset == R(CONTROL) ? ~R(CONTROL_RESET) : ~0u;

		port_host_write(host, kept[n].offset, value);
		assert_int_equal(port_host_read(host, kept[n].offset), kept[n].bits);
		port_host_write(host, kept[n].offset, 0);
		assert_int_equal(port_host_read(host, kept[n].offset), 0);
	}
	assert_power_on(host);
}

static void registers_that_are_read_only_ignore_writes(void **state)
{
	static const uint32_t writable[] = {
		R(CONTROL),   R(INTERRUPT_MASK), R(RING_LOW),       R(RING_HIGH),
		R(RING_LOG2), R(TAIL),           R(COMPLETION_LOW), R(COMPLETION_HIGH),
	};
	struct port_host *host = *state;

	for (uint32_t offset = 0; offset < 0x10000; offset += 4) {
		bool skip = false;

		for (size_t n = 0; n < sizeof(writable) / sizeof(writable[0]); n++)
			skip |= offset == writable[n];
		if (!skip)
			port_host_write(host, offset, ~0u);
	}
	assert_power_on(host);
}

/* ---- jobs ---- */

static void job_passes_its_slots_with_low_bits_dropped(void **state)
{
	struct port_host *host = *state;
	struct accel_job job = { .stream = fake_engine_words(), .stream_words = 3 };
	struct gloss_job_descriptor d;

	for (uint32_t n = 0; n < GLOSS_SLOTS; n++)
		job.slot[n] = (struct gloss_slot){ n << 12 | 0xabc, 100 + n,
						   (enum gloss_rights)(n % 4) };
	d = port_host_describe(host, &job, 9);
	port_host_set(host, ((uint64_t)d.slot_table_high << 32 | d.slot_table_low) + 8, 0xfffffffe);
	d.slot_table_low |= 63;
	port_host_start(host, 3, 0);
	submit(host, &d);
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++) {
		struct gloss_slot slot = host->board->engine.job.slot[n];

		assert_int_equal(slot.base, n << 12);
		assert_int_equal(slot.size, 100 + n);
		assert_int_equal(slot.rights, n ? n % 4 : 2);
	}
}

static void job_sees_its_stream_in_order_from_scattered_pages(void **state)
{
	static const uint32_t bites[] = { 1, 7, 1024, PORT_WINDOW_WORDS, ~0u };
	struct port_host *host = *state;
	struct fake_engine *engine = &host->board->engine;
	struct gloss_job_descriptor d = describe(host, FAKE_STREAM_MAX - 5, 0, 1);

	port_host_start(host, 3, 0);
	for (size_t n = 0; n < sizeof(bites) / sizeof(bites[0]); n++) {
		engine->bite = bites[n];
		memset(engine->stream, 0, sizeof(engine->stream));
		submit(host, &d);
		assert_int_equal(engine->ended, n + 1);
		assert_memory_equal(engine->stream, fake_engine_words(), 4 * (FAKE_STREAM_MAX - 5));
		assert_false(engine->window_short);
	}
}

static void job_answers_over_the_borders_of_pages_and_nowhere_else(void **state)
{
	static uint8_t before[PORT_HOST_BYTES];
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 100, 3333, 1);
	uint64_t list = (uint64_t)d.response_list_high << 32 | d.response_list_low;

	host->board->engine.answers = 41;
	port_host_start(host, 0, 0);
	port_host_push(host, &d);
	memcpy(before, host->memory, sizeof(before));
	port_host_ring(host);
	port_host_work(host);
	for (uint32_t n = 0; n < 3333; n++) {
		uint64_t address = port_host_word(host, list, n);

		assert_int_equal(port_host_get(host, address), 0xa0000000 + n);
		address -= PORT_HOST_BASE;
		memcpy(before + address, host->memory + address, 4);
	}
	memcpy(before + (host->completion - PORT_HOST_BASE),
	       host->memory + (host->completion - PORT_HOST_BASE), 4 * GLOSS_COMPLETION_WORDS);
	assert_memory_equal(host->memory, before, sizeof(before));
}

static void job_reads_only_the_entries_its_words_need(void **state)
{
	static const struct {
		uint32_t words, entries;
	} cases[] = { { 0, 0 }, { 1, 1 }, { 1024, 1 }, { 1025, 2 }, { 2048, 2 }, { 2049, 3 } };
	struct port_host *host = *state;

	port_host_start(host, 0, 0);
	for (size_t c = 0; c < sizeof(cases) / sizeof(cases[0]); c++) {
		struct gloss_job_descriptor d = describe(host, cases[c].words, cases[c].words, 1);
		uint64_t list = (uint64_t)d.stream_list_high << 32 | d.stream_list_low;
		uint32_t entries = 0;

		host->accesses = 0;
		host->board->engine.answers = ~0u;
		submit(host, &d);
		for (uint32_t n = 0; n < host->accesses && n < PORT_HOST_ACCESSES; n++) {
			if (host->access[n].bytes != 8)
				continue;
			/* The response's list lies behind the stream's. */
			assert_in_range(host->access[n].address, list,
					list + 16 * cases[c].entries - 8);
			entries++;
		}
		assert_int_equal(entries, 2 * cases[c].entries);
	}
}

static void job_ignores_low_bits_of_addresses(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 2000, 2000, 7);
	uint64_t stream = (uint64_t)d.stream_list_high << 32 | d.stream_list_low;
	uint64_t response = (uint64_t)d.response_list_high << 32 | d.response_list_low;

	for (uint32_t n = 0; n < 2; n++) {
		port_host_set(host, stream + 8 * n, port_host_get(host, stream + 8 * n) | 0xfff);
		port_host_set(host, response + 8 * n,
			      port_host_get(host, response + 8 * n) | 0x123);
	}
	d.stream_list_low |= 7;
	d.response_list_low |= 5;
	port_host_start(host, 2, 0);
	port_host_write(host, R(CONTROL), 0);
	port_host_write(host, R(RING_LOW), (uint32_t)host->ring | 63);
	port_host_write(host, R(COMPLETION_LOW), (uint32_t)host->completion | 15);
	port_host_write(host, R(CONTROL), R(CONTROL_ENABLE));
	host->board->engine.answers = 1;
	submit(host, &d);
	assert_memory_equal(host->board->engine.stream, fake_engine_words(), 8000);
	assert_int_equal(port_host_get(host, port_host_word(host, response, 1999)),
			 0xa0000000 + 1999);
	assert_int_equal(port_host_completion(host, 0).sequence, 7);
	assert_int_equal(port_host_read(host, R(RING_LOW)), (uint32_t)host->ring | 63);
}

static void completion_has_what_the_engine_says(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 20, 12, 0x89abcdef);
	struct gloss_completion completion;

	host->board->engine.answers = 1;
	host->board->engine.cause = GLOSS_FAULT_SLOT;
	port_host_start(host, 1, 0);
	submit(host, &d);
	completion = port_host_completion(host, 0);
	assert_int_equal(completion.sequence, 0x89abcdef);
	assert_int_equal(completion.cause, GLOSS_FAULT_SLOT);
	assert_int_equal(completion.offset, 20);
	assert_int_equal(completion.response_words, 12);
	assert_int_equal(port_host_read(host, R(FAULT_CAUSE)), GLOSS_FAULT_SLOT);
	assert_int_equal(port_host_read(host, R(FAULT_OFFSET)), 20);
	assert_int_equal(port_host_read(host, R(FAULT_SEQUENCE)), 0x89abcdef);
	assert_int_equal(port_host_read(host, R(PROGRESS)), 32);
	assert_int_equal(port_host_read(host, R(JOBS)), 1);
	/* A good job leaves the last fault where it is. */
	host->board->engine.cause = GLOSS_FAULT_NONE;
	submit_empty(host, 2);
	assert_int_equal(port_host_completion(host, 1).cause, GLOSS_FAULT_NONE);
	assert_int_equal(port_host_read(host, R(FAULT_SEQUENCE)), 0x89abcdef);
	assert_int_equal(port_host_read(host, R(JOBS)), 2);
}

static void check_completed(struct port_host *host)
{
	uint32_t job = port_host_read(host, R(HEAD)) - 1;

	assert_int_equal(port_host_completion(host, job).sequence, 100 + job);
	assert_true(port_host_read(host, R(INTERRUPT_STATUS)) & R(INTERRUPT_STATUS_DONE));
	assert_true(host->level);
	assert_int_equal(port_host_read(host, R(JOBS)), job + 1);
	assert_int_equal(port_host_read(host, R(STATUS)), R(STATUS_IDLE));
}

static void completion_is_written_after_the_response_and_before_the_event(void **state)
{
	struct port_host *host = *state;

	host->board->engine.answers = 3;
	host->on_event = check_completed;
	port_host_start(host, 2, R(INTERRUPT_MASK_DONE));
	for (uint32_t n = 0; n < 3; n++) {
		struct gloss_job_descriptor d = describe(host, 10, 30, 100 + n);

		const struct port_access *last;

		host->accesses = 0;
		submit(host, &d);
		last = &host->access[host->accesses - 1];
		assert_int_equal(host->events, n + 1);
		assert_true(last->write);
		assert_int_equal(last->address, host->completion + 16 * n);
		assert_int_equal(last->bytes, 16);
	}
}

static void completion_that_is_late_keeps_the_job_running(void **state)
{
	struct port_host *host = *state;
	struct gloss_job_descriptor d = describe(host, 8, 0, 1);

	port_host_start(host, 2, MASK_ALL);
	host->later = 3;
	port_host_push(host, &d);
	port_host_ring(host);
	for (uint32_t n = 0; n < 3; n++) {
		assert_true(port_pci_work(&host->board->port));
		assert_int_equal(port_host_read(host, R(STATUS)), R(STATUS_RUNNING));
		assert_int_equal(port_host_read(host, R(HEAD)), 0);
		assert_int_equal(port_host_read(host, R(INTERRUPT_STATUS)), 0);
		assert_int_equal(host->events, 0);
	}
	assert_false(port_pci_work(&host->board->port));
	assert_int_equal(port_host_read(host, R(HEAD)), 1);
	assert_int_equal(host->events, 1);
	assert_int_equal(host->board->engine.ended, 1);
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(registers_are_zero_after_power_on),
		TEST(registers_keep_the_bits_that_can_be_written),
		TEST(registers_that_are_read_only_ignore_writes),
		TEST(job_passes_its_slots_with_low_bits_dropped),
		TEST(job_sees_its_stream_in_order_from_scattered_pages),
		TEST(job_answers_over_the_borders_of_pages_and_nowhere_else),
		TEST(job_reads_only_the_entries_its_words_need),
		TEST(job_ignores_low_bits_of_addresses),
		TEST(completion_has_what_the_engine_says),
		TEST(completion_is_written_after_the_response_and_before_the_event),
		TEST(completion_that_is_late_keeps_the_job_running),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
