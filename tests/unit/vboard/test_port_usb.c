// SPDX-License-Identifier: MIT
/* The model of the USB port, around an engine that does what a test tells it. */
#include "port_usb_test.h"

/* ---- registers ---- */

static void registers_are_zero_after_power_on(void **state)
{
	struct usb_host *host = *state;

	assert_reset(host, 0);
	assert_false(port_usb_work(&host->board->port));
	assert_false(usb_host_step(host));
}

static void registers_but_nonce_and_boot_ignore_writes(void **state)
{
	struct usb_host *host = *state;

	for (uint32_t offset = 0; offset < 0x10000; offset += 4)
		usb_host_write(host, offset, offset == R(CONTROL) ? ~R(CONTROL_RESET) : ~0u);
	assert_int_equal(usb_host_read(host, R(BOOT)), ~0u);
	usb_host_write(host, R(BOOT), 0);
	assert_reset(host, ~0u);
}

static void control_without_reset_does_nothing(void **state)
{
	struct usb_host *host = *state;

	start(host);
	add_job(host, 100, 0, 1);
	host->out.count -= 50;
	run(host);
	usb_host_write(host, R(CONTROL), ~R(CONTROL_RESET));
	assert_int_equal(usb_host_read(host, R(CONTROL)), 0);
	assert_int_equal(usb_host_read(host, R(NONCE)), NONCE);
	host->out.count += 50;
	run(host);
	assert_answer(host, 0, 1);
}

/* ---- jobs ---- */

static void job_passes_the_slots_it_has(void **state)
{
	static const uint32_t counts[] = { 0, 1, 15, 16 };
	struct usb_host *host = *state;
	struct accel_job job = { .stream = fake_engine_words(), .stream_words = 3 };

	for (uint32_t n = 0; n < GLOSS_SLOTS; n++)
		job.slot[n] = (struct gloss_slot){ n << 12 | 0xabc, 100 + n,
						   (enum gloss_rights)(n % 4) };
	start(host);
	for (size_t c = 0; c < sizeof(counts) / sizeof(counts[0]); c++) {
		usb_host_job(host, &job, counts[c], 1);
		run(host);
		for (uint32_t n = 0; n < GLOSS_SLOTS; n++) {
			struct gloss_slot slot = host->board->engine.job.slot[n];
			bool sent = n < counts[c];

			assert_int_equal(slot.base, sent ? n << 12 : 0);
			assert_int_equal(slot.size, sent ? 100 + n : 0);
			assert_int_equal(slot.rights, sent ? n % 4 : 0);
		}
		assert_answer(host, 0, 1);
	}
}

static void job_sees_its_stream_in_order_and_packets_as_a_whole(void **state)
{
	static const uint32_t bites[] = { 1, 7, 1024, PORT_WINDOW_WORDS, ~0u };
	static const uint32_t offers[] = { 1, 100, 4097, ~0u };
	struct usb_host *host = *state;
	struct fake_engine *engine = &host->board->engine;

	start(host);
	for (uint32_t n = 0; n < 20; n++) {
		engine->bite = bites[n % 5];
		host->offer = offers[n / 5];
		memset(engine->stream, 0, sizeof(engine->stream));
		add_job(host, FAKE_STREAM_MAX - 5, 0, n);
		run(host);
		assert_int_equal(engine->ended, n + 1);
		assert_memory_equal(engine->stream, fake_engine_words(), 4 * (FAKE_STREAM_MAX - 5));
		assert_false(engine->window_short);
		assert_answer(host, 0, n);
	}
	assert_true(usb_host_empty(host));
}

static void job_of_no_words_ends(void **state)
{
	struct usb_host *host = *state;

	start(host);
	for (uint32_t n = 0; n < 3; n++)
		add_job(host, 0, 100 * n, 70 + n);
	run(host);
	for (uint32_t n = 0; n < 3; n++)
		assert_answer(host, 0, 70 + n);
	assert_true(usb_host_empty(host));
	assert_int_equal(host->board->engine.ended, 3);
}

/* Words of a stream whose packets are that long, headers included. */
static const uint32_t *packets(uint32_t words)
{
	static uint32_t stream[FAKE_STREAM_MAX];

	for (uint32_t n = 0; n < FAKE_STREAM_MAX; n++)
		stream[n] = n % words ? ~0u : words - 1;
	return stream;
}

static void packet_is_executed_when_it_is_there(void **state)
{
	struct usb_host *host = *state;
	struct fake_engine *engine = &host->board->engine;
	struct accel_job job = { .stream_words = FAKE_STREAM_MAX };
	uint32_t begin;

	start(host);
	for (uint32_t words = 1; words <= GLOSS_LENGTH_MAX + 1; words *= 2) {
		job.stream = packets(words);
		engine->bite = words;
		begin = host->out.count + GLOSS_USB_JOB_WORDS;
		usb_host_job(host, &job, 0, words);
		host->out.count = begin + 2 * words - 1;
		run(host);
		assert_int_equal(engine->taken, words);
		host->out.count++;
		run(host);
		assert_int_equal(engine->taken, 2 * words);
		assert_status(host, R(STATUS_RUNNING));
		host->out.count = begin + FAKE_STREAM_MAX + GLOSS_USB_JOB_END_WORDS;
		run(host);
		assert_answer(host, 0, words);
	}
}

static void job_that_the_engine_refuses_is_read_to_its_end(void **state)
{
	struct usb_host *host = *state;

	host->board->engine.refuses = true;
	start(host);
	add_job(host, 5000, 10, 1);
	run(host);
	assert_answer(host, 0, 1);
	assert_int_equal(host->completion.cause, GLOSS_FAULT_MEMORY);
	assert_int_equal(host->completion.offset, 0);
	assert_int_equal(host->board->engine.taken + host->board->engine.ended, 0);
	host->board->engine.refuses = false;
	add_job(host, 10, 10, 2);
	run(host);
	assert_answer(host, 0, 2);
	assert_int_equal(host->completion.cause, GLOSS_FAULT_NONE);
}

/* ---- answers ---- */

static void response_comes_in_chunks_that_are_full(void **state)
{
	static const uint32_t words[] = { 0, 1, 255, 256, 257, 511, 512, 513, 5000, 65535, 200000 };
	static const uint32_t answers[] = { 1, 41, 256, 65535 };
	struct usb_host *host = *state;

	start(host);
	for (size_t n = 0; n < sizeof(words) / sizeof(words[0]); n++) {
		for (size_t a = 0; a < sizeof(answers) / sizeof(answers[0]); a++) {
			uint32_t steps = words[n] / answers[a] + 1;

			if (steps > FAKE_STREAM_MAX)
				continue;
			host->board->engine.answers = answers[a];
			add_job(host, steps, words[n], (uint32_t)n);
			run(host);
			/* host tells if a chunk but the last is not full */
			assert_answer(host, words[n], (uint32_t)n);
			assert_true(usb_host_empty(host));
		}
	}
}

static void chunk_leaves_when_it_is_full(void **state)
{
	struct usb_host *host = *state;
	struct accel_job job = { .stream = packets(1),
				 .stream_words = 1000,
				 .response_words = 1000 };

	start(host);
	host->board->engine.answers = 1;
	usb_host_job(host, &job, 0, 1);
	for (uint32_t words = 1; words < 1000; words++) {
		host->out.count = 2 * GLOSS_USB_JOB_WORDS + words;
		run(host);
		assert_int_equal(host->in.count, 4 + words / 256 * 257);
	}
	host->out.count += 1 + GLOSS_USB_JOB_END_WORDS;
	run(host);
	assert_answer(host, 1000, 1);
}

static void completion_has_what_the_engine_says(void **state)
{
	struct usb_host *host = *state;

	start(host);
	host->board->engine.answers = 1;
	host->board->engine.cause = GLOSS_FAULT_SLOT;
	add_job(host, 20, 12, 0x89abcdef);
	run(host);
	assert_answer(host, 12, 0x89abcdef);
	assert_int_equal(host->completion.cause, GLOSS_FAULT_SLOT);
	assert_int_equal(host->completion.offset, 20);
	assert_int_equal(usb_host_read(host, R(FAULT_CAUSE)), GLOSS_FAULT_SLOT);
	assert_int_equal(usb_host_read(host, R(FAULT_OFFSET)), 20);
	assert_int_equal(usb_host_read(host, R(FAULT_SEQUENCE)), 0x89abcdef);
	assert_int_equal(usb_host_read(host, R(PROGRESS)), 32);
	assert_int_equal(usb_host_read(host, R(JOBS)), 1);
	/* A good job leaves the last fault where it is. */
	host->board->engine.cause = GLOSS_FAULT_NONE;
	add_job(host, 0, 0, 2);
	run(host);
	assert_answer(host, 0, 2);
	assert_int_equal(host->completion.cause, GLOSS_FAULT_NONE);
	assert_int_equal(usb_host_read(host, R(FAULT_SEQUENCE)), 0x89abcdef);
	assert_int_equal(usb_host_read(host, R(JOBS)), 2);
}

/* Whoever has a completion finds its job counted. */
static void completion_comes_after_the_registers(void **state)
{
	struct usb_host *host = *state;

	start(host);
	host->take = 1;
	host->board->engine.cause = GLOSS_FAULT_ORDER;
	for (uint32_t n = 0; n < 5; n++)
		add_job(host, 3, 0, 100 + n);
	do {
		if (usb_host_answer(host)) {
			assert_in_range(usb_host_read(host, R(JOBS)),
					host->completion.sequence - 99, 5);
			assert_in_range(usb_host_read(host, R(FAULT_SEQUENCE)),
					host->completion.sequence, 104);
		} else {
			host->read = host->burst.word[host->bursts_read - 1];
		}
	} while (usb_host_step(host));
	assert_true(usb_host_empty(host));
	assert_int_equal(host->completion.sequence, 104);
}

/* ---- status ---- */

static void status_follows_a_job_word_by_word(void **state)
{
	struct usb_host *host = *state;
	struct accel_job job = { .stream = fake_engine_words(), .stream_words = 10 };
	uint32_t begin, slots, end, taken;

	start(host);
	begin = host->out.count;
	usb_host_job(host, &job, 2, 1);
	end = host->out.count;
	slots = begin + GLOSS_USB_JOB_WORDS + 2 * GLOSS_SLOT_ENTRY_WORDS;
	host->offer = 1;
	for (host->out.count = begin; host->out.count <= end; host->out.count++) {
		run(host);
		assert_status(host, host->sent == begin || host->sent == end ? R(STATUS_IDLE) :
				    host->sent < slots                       ? 0 :
									       R(STATUS_RUNNING));
		taken = host->sent < slots ? 0 : host->sent - slots;
		assert_int_equal(usb_host_read(host, R(PROGRESS)),
				 taken < job.stream_words ? taken : job.stream_words);
	}
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(registers_are_zero_after_power_on),
		TEST(registers_but_nonce_and_boot_ignore_writes),
		TEST(control_without_reset_does_nothing),
		TEST(job_passes_the_slots_it_has),
		TEST(job_sees_its_stream_in_order_and_packets_as_a_whole),
		TEST(job_of_no_words_ends),
		TEST(packet_is_executed_when_it_is_there),
		TEST(job_that_the_engine_refuses_is_read_to_its_end),
		TEST(response_comes_in_chunks_that_are_full),
		TEST(chunk_leaves_when_it_is_full),
		TEST(completion_has_what_the_engine_says),
		TEST(completion_comes_after_the_registers),
		TEST(status_follows_a_job_word_by_word),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
