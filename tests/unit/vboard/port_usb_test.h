/* SPDX-License-Identifier: MIT */
/* What the tests of the USB port share: its model around an engine of the test, and a host. */
#ifndef PORT_USB_TEST_H
#define PORT_USB_TEST_H

#include "accel_test.h"
#include "fake_engine.h"
#include "vboard/port/usb.h"
#include "usb_host.h"

#define R(name) GLOSS_REG_##name
#define MEMORY_SIZE (7 * 4096)
#define NONCE 0x1234abcd
#define JOB_HEADER (GLOSS_USB_JOB_MAGIC << 8)
#define EMPTY_JOB_WORDS (GLOSS_USB_JOB_WORDS + GLOSS_USB_JOB_END_WORDS)

struct gloss_usb_board {
	struct port_usb port;
	struct fake_engine engine;
};

static inline struct gloss_usb_board *fake_create(void *memory, uint64_t size)
{
	struct gloss_usb_board *board = calloc(1, sizeof(*board));
	struct port_build build = { 64, 4, (uint32_t)(size / GLOSS_PAGE_BYTES) };
	struct port_engine engine;

	(void)memory;
	assert_non_null(board);
	engine = fake_engine_init(&board->engine);
	port_usb_init(&board->port, &engine, &build);
	return board;
}

static inline void fake_destroy(struct gloss_usb_board *board)
{
	free(board);
}

static inline uint32_t fake_read(struct gloss_usb_board *board, uint32_t offset)
{
	return port_usb_read(&board->port, offset);
}

static inline void fake_write(struct gloss_usb_board *board, uint32_t offset, uint32_t value)
{
	port_usb_write(&board->port, offset, value);
}

static inline uint32_t fake_out(struct gloss_usb_board *board, const uint32_t *words,
				uint32_t count)
{
	return port_usb_out(&board->port, words, count);
}

static inline uint32_t fake_in(struct gloss_usb_board *board, uint32_t *words, uint32_t room,
			       bool *flush)
{
	return port_usb_in(&board->port, words, room, flush);
}

static inline bool fake_event(struct gloss_usb_board *board, uint32_t words[2])
{
	return port_usb_event(&board->port, words);
}

static inline bool fake_work(struct gloss_usb_board *board)
{
	return port_usb_work(&board->port);
}

static inline void fake_reset(struct gloss_usb_board *board)
{
	port_usb_reset(&board->port);
}

static const struct gloss_usb_board_ops fake_ops = {
	.abi = GLOSS_USB_BOARD_ABI,
	.create = fake_create,
	.destroy = fake_destroy,
	.read = fake_read,
	.write = fake_write,
	.out = fake_out,
	.in = fake_in,
	.event = fake_event,
	.work = fake_work,
	.reset = fake_reset,
};

static inline int setup(void **state)
{
	struct usb_host *host = malloc(sizeof(*host));

	*state = host;
	return host && usb_host_init(host, &fake_ops, NULL, MEMORY_SIZE) ? 0 : -1;
}

static inline int teardown(void **state)
{
	usb_host_fini(*state);
	free(*state);
	return 0;
}

static inline void run(struct usb_host *host)
{
	assert_true(usb_host_run(host));
	assert_int_equal(host->sent, host->out.count);
}

/* As a driver does: reset, nonce, sync, echo. */
static inline void start(struct usb_host *host)
{
	assert_true(usb_host_reset(host, NONCE));
	usb_host_sync(host, NONCE);
	run(host);
	assert_true(usb_host_echo(host, NONCE));
}

static inline void add_job(struct usb_host *host, uint32_t stream_words, uint32_t response_words,
			   uint32_t sequence)
{
	struct accel_job job = { .stream = fake_engine_words(),
				 .stream_words = stream_words,
				 .response_words = response_words };

	usb_host_job(host, &job, 0, sequence);
}

/* The next answer on IN is that of the fake engine, this long, and the job's. */
static inline void assert_answer(struct usb_host *host, uint32_t words, uint32_t sequence)
{
	assert_true(usb_host_answer(host));
	assert_int_equal(host->completion.sequence, sequence);
	assert_int_equal(host->response.count, words);
	for (uint32_t n = 0; n < words; n++)
		assert_int_equal(host->response.word[n], fake_engine_answer(n));
}

static inline void assert_status(struct usb_host *host, uint32_t status)
{
	assert_int_equal(usb_host_read(host, R(STATUS)), status);
}

/* Every register there is, in its state after power on or a reset; NONCE as it was written. */
static inline void assert_reset(struct usb_host *host, uint32_t nonce)
{
	for (uint32_t offset = 0; offset < 0x10000; offset += 4) {
		uint32_t expected = offset == R(IDENTITY)     ? 0x534f4c47 :
				    offset == R(VERSION)      ? GLOSS_VERSION :
				    offset == R(CAPABILITIES) ? 64 | 4 << 8 :
				    offset == R(MEMORY_PAGES) ? 7 :
				    offset == R(NONCE)        ? nonce :
				    offset == R(STATUS)       ? R(STATUS_IDLE) :
								0;
		uint32_t value = usb_host_read(host, offset);

		if (value != expected)
			fail_msg("register 0x%03x is 0x%08x, not 0x%08x", offset, value, expected);
	}
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

#endif
