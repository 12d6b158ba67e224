/* SPDX-License-Identifier: MIT */
/* What the tests of the PCI port share: its model around an engine of the test, and a host. */
#ifndef PORT_PCI_TEST_H
#define PORT_PCI_TEST_H

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

static inline struct gloss_board *fake_create(const struct gloss_board_host *host, void *memory,
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

static inline void fake_destroy(struct gloss_board *board)
{
	free(board);
}

static inline uint32_t fake_read(struct gloss_board *board, uint32_t offset)
{
	return port_pci_read(&board->port, offset);
}

static inline void fake_write(struct gloss_board *board, uint32_t offset, uint32_t value)
{
	port_pci_write(&board->port, offset, value);
}

static inline bool fake_work(struct gloss_board *board)
{
	return port_pci_work(&board->port);
}

static inline void fake_reset(struct gloss_board *board)
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

static inline int setup(void **state)
{
	struct port_host *host = malloc(sizeof(*host));

	*state = host;
	return host && port_host_init(host, &fake_ops, NULL, MEMORY_SIZE, 1) ? 0 : -1;
}

static inline int teardown(void **state)
{
	port_host_fini(*state);
	free(*state);
	return 0;
}

/* A job of so many words, which the engine is to answer with that many a step. */
static inline struct gloss_job_descriptor describe(struct port_host *host, uint32_t stream_words,
						   uint32_t response_words, uint32_t sequence)
{
	struct accel_job job = { .stream = fake_engine_words(),
				 .stream_words = stream_words,
				 .response_words = response_words };

	return port_host_describe(host, &job, sequence);
}

static inline void submit(struct port_host *host, const struct gloss_job_descriptor *descriptor)
{
	port_host_push(host, descriptor);
	port_host_ring(host);
	assert_true(port_host_work(host));
}

static inline void submit_empty(struct port_host *host, uint32_t sequence)
{
	struct gloss_job_descriptor d = { .sequence = sequence };
	uint64_t slots = PORT_HOST_BASE + PORT_HOST_ARENA;

	d.slot_table_low = (uint32_t)slots;
	d.slot_table_high = (uint32_t)(slots >> 32);
	submit(host, &d);
}

/* Every register there is, in its state after power on. */
static inline void assert_power_on(struct port_host *host)
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

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

#endif
