// SPDX-License-Identifier: MIT
/* The model of the PCI port, around an engine that does what a test tells it. */
#include "accel_test.h"
#include "fake_engine.h"
#include "port_host.h"
#include "vboard/port/pci.h"

#define R(name) GLOSS_REG_##name
#define MASK_ALL (R(INTERRUPT_MASK_DONE) | R(INTERRUPT_MASK_FAULT) | R(INTERRUPT_MASK_DMA))
#define MEMORY_SIZE (7 * 4096)

struct gloss_board {
	struct port_pci port;
	struct fake_engine engine;
};

static struct gloss_board *fake_create(const struct gloss_board_host *host, void *memory,
				       uint64_t size)
{
	struct gloss_board *board = calloc(1, sizeof(*board));
	struct port_engine engine;
	struct port_build build = { 64, 4, (uint32_t)(size / GLOSS_PAGE_BYTES) };

	(void)memory;
	assert_non_null(board);
	engine = fake_engine_init(&board->engine);
	port_pci_init(&board->port, host, &engine, &build);
	return board;
}

static void fake_destroy(struct gloss_board *board)
{
	free(board);
}

static uint32_t fake_read(struct gloss_board *board, uint32_t offset)
{
	return port_pci_read(&board->port, offset);
}

static void fake_write(struct gloss_board *board, uint32_t offset, uint32_t value)
{
	port_pci_write(&board->port, offset, value);
}

static bool fake_work(struct gloss_board *board)
{
	return port_pci_work(&board->port);
}

static void fake_reset(struct gloss_board *board)
{
	port_pci_reset(&board->port);
}

static const struct gloss_board_ops fake_ops = {
	.abi = GLOSS_BOARD_ABI,
	.create = fake_create,
	.destroy = fake_destroy,
	.read = fake_read,
	.write = fake_write,
	.work = fake_work,
	.reset = fake_reset,
};

static int setup(void **state)
{
	struct port_host *host = malloc(sizeof(*host));

	*state = host;
	return host && port_host_init(host, &fake_ops, NULL, MEMORY_SIZE, 1) ? 0 : -1;
}

static int teardown(void **state)
{
	port_host_fini(*state);
	free(*state);
	return 0;
}

/* A job of so many words, which the engine is to answer with that many a step. */
static struct gloss_job_descriptor describe(struct port_host *host, uint32_t stream_words,
					    uint32_t response_words, uint32_t sequence)
{
	struct accel_job job = { .stream = fake_engine_words(),
				 .stream_words = stream_words,
				 .response_words = response_words };

	return port_host_describe(host, &job, sequence);
}

static void submit(struct port_host *host, const struct gloss_job_descriptor *descriptor)
{
	port_host_push(host, descriptor);
	port_host_ring(host);
	assert_true(port_host_work(host));
}

static void submit_empty(struct port_host *host, uint32_t sequence)
{
	struct gloss_job_descriptor d = { .sequence = sequence };
	uint64_t slots = PORT_HOST_BASE + PORT_HOST_ARENA;

	d.slot_table_low = (uint32_t)slots;
	d.slot_table_high = (uint32_t)(slots >> 32);
	submit(host, &d);
}

/* Every register there is, in its state after power on. */
static void assert_power_on(struct port_host *host)
{
	for (uint32_t offset = 0; offset < 0x10000; offset += 4) {
		uint32_t expected = offset == R(IDENTITY)     ? 0x534f4c47 :
				    offset == R(VERSION)      ? GLOSS_VERSION :
				    offset == R(CAPABILITIES) ? 64 | 4 << 8 | 8 << 16 :
				    offset == R(MEMORY_PAGES) ? 7 :
				    offset == R(STATUS)       ? R(STATUS_IDLE) :
								0;
		uint32_t value = port_host_read(host, offset);

		if (value != expected)
			fail_msg("register 0x%03x is 0x%08x, not 0x%08x", offset, value, expected);
	}
}

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

#define test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	static const struct CMUnitTest tests[] = {
		test(registers_are_zero_after_power_on),
		test(registers_keep_the_bits_that_can_be_written),
		test(registers_that_are_read_only_ignore_writes),
		test(job_passes_its_slots_with_low_bits_dropped),
		test(job_sees_its_stream_in_order_from_scattered_pages),
		test(job_answers_over_the_borders_of_pages_and_nowhere_else),
		test(job_reads_only_the_entries_its_words_need),
		test(job_ignores_low_bits_of_addresses),
		test(completion_has_what_the_engine_says),
		test(completion_is_written_after_the_response_and_before_the_event),
		test(ring_wraps_at_its_size_and_at_most_at_256),
		test(ring_counts_wrap_at_65536),
		test(ring_runs_queued_jobs_in_order),
		test(ring_overrun_by_the_driver_runs_jobs_again),
		test(disabled_board_remembers_tail_and_ends_the_running_job),
		test(events_set_status_and_interrupt_by_the_mask),
		test(event_that_was_masked_sends_no_message_later),
		test(level_follows_status_and_mask),
		test(dma_refused_anywhere_stops_the_board_until_a_reset),
		test(dma_error_leaves_the_jobs_before_it_done),
		test(reset_while_running_drops_the_job),
		test(reset_before_the_completion_drops_it),
		test(completion_that_is_late_keeps_the_job_running),
		test(reset_between_jobs_and_by_the_host),
		test(job_of_four_billion_words_takes_no_memory_and_can_be_reset),
		test(job_with_slots_outside_memory_is_the_memorys_fault),
		test(addresses_at_the_end_of_the_bus_wrap_or_are_refused),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
