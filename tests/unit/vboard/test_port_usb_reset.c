// SPDX-License-Identifier: MIT
/* What the USB port does with jobs that are torn or garbled, and what a reset leaves of them. */
#include "port_usb_test.h"

/* ---- torn jobs and resets ---- */

static void torn_job_leaves_nothing_to_the_next_one(void **state)
{
	struct usb_host *host = *state;
	struct accel_job job = { .stream = fake_engine_words(),
				 .stream_words = 600,
				 .response_words = 900 };
	uint32_t words;

	start(host);
	usb_host_job(host, &job, 3, 1);
	words = host->out.count - host->sent;
	for (uint32_t n = 0; n < words; n++) {
		start(host);
		host->board->engine.answers = 7;
		usb_host_job(host, &job, 3, 1);
		host->out.count -= words - n;
		run(host);
		/* Half of it is read, by somebody who is gone. */
		start(host);
		assert_reset(host, NONCE);
		usb_host_job(host, &job, 1, 2);
		run(host);
		assert_answer(host, 900, 2);
		assert_true(usb_host_empty(host));
		assert_int_equal(host->board->engine.job.slot[1].size, 0);
		assert_int_equal(usb_host_read(host, R(JOBS)), 1);
	}
}

static void reset_at_any_time_drops_all_there_is(void **state)
{
	struct usb_host *host = *state;
	uint64_t random = test_seed();

	for (uint32_t n = 0; n < 1000; n++) {
		start(host);
		host->offer = 1 + test_below(&random, 3000);
		host->take = test_below(&random, 3000);
		host->board->engine.answers = test_below(&random, 2000);
		host->board->engine.cause = test_below(&random, 2) ? GLOSS_FAULT_NONE :
								     GLOSS_FAULT_LENGTH;
		for (uint32_t job = 0; job < 3; job++)
			add_job(host, test_below(&random, 8000), test_below(&random, 100000), job);
		for (uint32_t steps = test_below(&random, 30); steps; steps--)
			usb_host_step(host);
		assert_true(usb_host_reset(host, 0));
		assert_false(usb_host_step(host));
		assert_int_equal(host->in.count + host->event.count, 0);
		assert_reset(host, 0);
		host->offer = ~0u;
		host->take = 65536;
	}
}

/* Words that wait at each place there is, ends of bursts among them, and an event. */
static void reset_drops_what_nobody_took(void **state)
{
	struct usb_host *host = *state;
	struct fake_engine *engine = &host->board->engine;

	start(host);
	engine->cause = GLOSS_FAULT_OPCODE;
	for (uint32_t n = 0; n < 1000; n++)
		add_job(host, 0, 0, n);
	add_job(host, 8000, 800000, 1);
	engine->answers = 30000;
	host->sent += port_usb_out(&host->board->port, host->out.word + host->sent,
				   host->out.count - host->sent);
	while (port_usb_work(&host->board->port))
		;
	assert_true(engine->answered > 0);
	engine->cause = GLOSS_FAULT_NONE;
	engine->answers = 7;
	start(host);
	add_job(host, 1000, 9000, 3);
	run(host);
	assert_answer(host, 7000, 3);
	assert_true(usb_host_empty(host));
	assert_int_equal(host->event.count, 0);
}

static void power_on_is_a_reset(void **state)
{
	struct usb_host *host = *state;

	start(host);
	host->board->engine.cause = GLOSS_FAULT_VALUE;
	add_job(host, 10, 0, 1);
	run(host);
	host->ops->reset(host->board);
	assert_reset(host, 0);
}

static void a_reset_keeps_boot_and_power_on_does_not(void **state)
{
	struct usb_host *host = *state;

	assert_int_equal(usb_host_read(host, R(BOOT)), 0);
	usb_host_write(host, R(BOOT), 0xfeedface);
	for (int n = 0; n < 3; n++) {
		start(host);
		add_job(host, 10, 0, 1);
		run(host);
		assert_int_equal(usb_host_read(host, R(BOOT)), 0xfeedface);
	}
	host->ops->reset(host->board);
	assert_reset(host, 0);
}

/* ---- loss of the channel ---- */

static void assert_lost(struct usb_host *host, uint32_t word)
{
	start(host);
	add_job(host, 10, 3, 1);
	usb_words_add(&host->out, &word, 1);
	run(host);
	assert_status(host, R(STATUS_IDLE) | R(STATUS_LOST));
	add_job(host, 10, 3, 2);
	usb_host_sync(host, NONCE);
	for (uint32_t n = 0; n < 100; n++)
		add_job(host, 1000, 0, 3);
	run(host);
	assert_answer(host, 3, 1);
	assert_true(usb_host_empty(host));
	assert_int_equal(host->event.count, GLOSS_USB_EVENT_WORDS);
	assert_int_equal(host->event.word[0], GLOSS_USB_EVENT_MAGIC << 16 | GLOSS_USB_EVENT_LOST);
	assert_int_equal(host->event.word[1], 0);
	assert_int_equal(usb_host_read(host, R(JOBS)), 1);
	start(host);
	assert_status(host, R(STATUS_IDLE));
	add_job(host, 10, 3, 4);
	run(host);
	assert_answer(host, 3, 4);
}

static void word_that_begins_no_job_loses_the_channel(void **state)
{
	struct usb_host *host = *state;

	host->board->engine.answers = 1;
	for (uint32_t bit = 5; bit < 32; bit++)
		assert_lost(host, JOB_HEADER ^ 1u << bit);
	for (uint32_t slots = GLOSS_SLOTS + 1; slots < 32; slots++)
		assert_lost(host, JOB_HEADER | slots);
	assert_lost(host, GLOSS_USB_SYNC_MAGIC);
	assert_lost(host, 0);
	assert_lost(host, ~0u);
}

/* No words of an answer but those of full chunks, and no job that is counted. */
static void assert_unanswered(struct usb_host *host, uint32_t answered)
{
	assert_true(usb_host_echo(host, NONCE));
	assert_int_equal(host->in.count - host->read,
			 answered / GLOSS_USB_CHUNK_WORDS * (1 + GLOSS_USB_CHUNK_WORDS));
	assert_int_equal(host->bursts_read, host->burst.count);
	assert_status(host, R(STATUS_IDLE) | R(STATUS_LOST));
	assert_int_equal(usb_host_read(host, R(JOBS)), 0);
	assert_int_equal(usb_host_read(host, R(FAULT_CAUSE)), 0);
	assert_int_equal(host->event.count, GLOSS_USB_EVENT_WORDS);
	assert_int_equal(host->event.word[0], GLOSS_USB_EVENT_MAGIC << 16 | GLOSS_USB_EVENT_LOST);
}

static void job_with_a_wrong_checksum_is_not_answered(void **state)
{
	static const uint32_t answered[] = { 0, 1, 255, 256, 257, 511, 512, 1000 };
	struct usb_host *host = *state;

	host->board->engine.answers = 1;
	for (size_t n = 0; n < 2 * sizeof(answered) / sizeof(answered[0]); n++) {
		uint32_t words = answered[n / 2];

		assert_true(usb_host_reset(host, NONCE));
		usb_host_sync(host, NONCE);
		host->board->engine.cause = n % 2 ? GLOSS_FAULT_VALUE : GLOSS_FAULT_NONE;
		add_job(host, 1100, words, 1);
		host->out.word[host->out.count - 1] += 1 + (uint32_t)n;
		add_job(host, 10, 3, 2);
		run(host);
		assert_unanswered(host, words);
		start(host);
		add_job(host, 1100, words, 3);
		run(host);
		assert_answer(host, words, 3);
	}
}

/* Mark, slots and sequence are looked at in other ways, and with another length it ends at
 * another word. */
static void checksum_is_of_every_bit_of_a_job(void **state)
{
	struct usb_host *host = *state;
	struct accel_job job = { .stream = fake_engine_words(), .stream_words = 40 };
	uint32_t first = GLOSS_USB_SYNC_WORDS + GLOSS_USB_JOB_RESPONSE_WORDS_WORD, last;

	start(host);
	usb_host_job(host, &job, 3, 1);
	last = host->out.count;
	run(host);
	assert_answer(host, 0, 1);
	for (uint32_t n = 32 * first; n < 32 * last; n++) {
		assert_true(usb_host_reset(host, NONCE));
		usb_host_sync(host, NONCE);
		usb_host_job(host, &job, 3, 1);
		host->out.word[n / 32] ^= 1u << n % 32;
		run(host);
		assert_unanswered(host, 0);
	}
}

static void answers_to_jobs_before_the_loss_can_still_be_read(void **state)
{
	static const uint32_t zero;
	struct usb_host *host = *state;

	start(host);
	host->board->engine.answers = 10;
	add_job(host, 100, 500, 1);
	usb_words_add(&host->out, &zero, 1);
	host->take = 0;
	run(host);
	assert_status(host, R(STATUS_IDLE) | R(STATUS_LOST));
	host->take = 3;
	run(host);
	assert_answer(host, 500, 1);
	assert_true(usb_host_empty(host));
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(torn_job_leaves_nothing_to_the_next_one),
		TEST(reset_at_any_time_drops_all_there_is),
		TEST(reset_drops_what_nobody_took),
		TEST(power_on_is_a_reset),
		TEST(a_reset_keeps_boot_and_power_on_does_not),
		TEST(word_that_begins_no_job_loses_the_channel),
		TEST(job_with_a_wrong_checksum_is_not_answered),
		TEST(checksum_is_of_every_bit_of_a_job),
		TEST(answers_to_jobs_before_the_loss_can_still_be_read),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
