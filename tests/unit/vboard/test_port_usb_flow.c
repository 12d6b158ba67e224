// SPDX-License-Identifier: MIT
/* Words that come and go in pieces, or that nobody takes for a while; and events. */
#include "port_usb_test.h"

/* ---- flow ---- */

static void words_may_come_and_go_in_pieces_of_any_size(void **state)
{
	static const uint32_t pieces[] = { 1, 2, 3, 64, 255, 1000, 65536 };
	struct usb_host *host = *state;
	struct usb_words first = { NULL, 0, 0 }, bursts = { NULL, 0, 0 };

	for (uint32_t n = 0; n < 49; n++) {
		start(host);
		host->offer = pieces[n % 7];
		host->take = pieces[n / 7];
		host->board->engine.answers = 5;
		add_job(host, 600, 900, 1);
		add_job(host, 600, 0, 2);
		add_job(host, 0, 0, 3);
		add_job(host, 700, 6000, 4);
		run(host);
		if (!n) {
			usb_words_add(&first, host->in.word, host->in.count);
			usb_words_add(&bursts, host->burst.word, host->burst.count);
			assert_answer(host, 900, 1);
			assert_answer(host, 0, 2);
			assert_answer(host, 0, 3);
			assert_answer(host, 3500, 4);
			assert_true(usb_host_empty(host));
		}
		assert_int_equal(host->in.count, first.count);
		assert_memory_equal(host->in.word, first.word, 4 * (size_t)first.count);
		assert_int_equal(host->burst.count, bursts.count);
		assert_memory_equal(host->burst.word, bursts.word, 4 * (size_t)bursts.count);
	}
	free(first.word);
	free(bursts.word);
}

static void in_that_is_not_read_stops_everything_and_loses_nothing(void **state)
{
	struct usb_host *host = *state;
	uint32_t sent, progress;

	start(host);
	host->board->engine.answers = 100;
	add_job(host, 8000, 800000, 1);
	add_job(host, 8000, 800000, 2);
	host->take = 0;
	assert_true(usb_host_run(host));
	sent = host->sent;
	progress = usb_host_read(host, R(PROGRESS));
	assert_true(sent < host->out.count);
	assert_status(host, R(STATUS_RUNNING));
	assert_false(usb_host_step(host));
	assert_int_equal(usb_host_read(host, R(PROGRESS)), progress);
	host->take = 1000;
	run(host);
	assert_answer(host, 800000, 1);
	assert_answer(host, 800000, 2);
	assert_true(usb_host_empty(host));
}

static void completions_that_are_not_read_stop_the_jobs(void **state)
{
	struct usb_host *host = *state;

	start(host);
	for (uint32_t n = 0; n < 2 * PORT_USB_FIFO_WORDS; n++)
		add_job(host, 0, 0, n);
	host->take = 0;
	assert_true(usb_host_run(host));
	assert_true(host->sent < host->out.count);
	assert_int_equal(usb_host_read(host, R(JOBS)),
			 PORT_USB_FIFO_WORDS / GLOSS_USB_COMPLETION_WORDS);
	host->take = 1000;
	run(host);
	for (uint32_t n = 0; n < 2 * PORT_USB_FIFO_WORDS; n++)
		assert_answer(host, 0, n);
	assert_true(usb_host_empty(host));
}

static void work_is_false_only_if_nothing_moved(void **state)
{
	struct usb_host *host = *state;
	struct port_usb *port = &host->board->port;
	uint32_t out, in, words[300];
	bool flush;

	for (uint32_t take = 1; take < 300; take++) {
		start(host);
		host->board->engine.answers = 90;
		add_job(host, 700, 30000, 1);
		add_job(host, 600, 31, 2);
		add_job(host, 0, 0, 0);
		host->out.word[host->out.count - EMPTY_JOB_WORDS] = 0;
		host->sent += port_usb_out(port, host->out.word + host->sent,
					   host->out.count - host->sent);
		do {
			do {
				out = port->out.count;
				in = port->in.count;
			} while (port_usb_work(port));
			assert_int_equal(port->out.count, out);
			assert_int_equal(port->in.count, in);
		} while (port_usb_in(port, words, take, &flush));
		assert_status(host, R(STATUS_IDLE) | R(STATUS_LOST));
	}
}

/* ---- events ---- */

static void event_tells_of_each_fault_and_of_no_good_job(void **state)
{
	struct usb_host *host = *state;

	start(host);
	for (uint32_t cause = GLOSS_FAULT_NONE; cause <= GLOSS_FAULT_MEMORY; cause++) {
		host->board->engine.cause = (enum gloss_fault)cause;
		host->event.count = 0;
		add_job(host, 1, 0, 77 * cause);
		run(host);
		assert_int_equal(host->event.count, cause ? GLOSS_USB_EVENT_WORDS : 0);
		if (cause) {
			assert_int_equal(host->event.word[0], GLOSS_USB_EVENT_MAGIC << 16 | cause);
			assert_int_equal(host->event.word[1], 77 * cause);
		}
	}
}

static void events_that_nobody_fetches_are_dropped_but_four(void **state)
{
	struct usb_host *host = *state;
	uint32_t words[GLOSS_USB_EVENT_WORDS];

	start(host);
	host->board->engine.cause = GLOSS_FAULT_VALUE;
	for (uint32_t n = 0; n < 7; n++)
		add_job(host, 0, 0, 10 + n);
	assert_int_equal(port_usb_out(&host->board->port, host->out.word + host->sent,
				      host->out.count - host->sent),
			 7 * EMPTY_JOB_WORDS);
	while (port_usb_work(&host->board->port))
		;
	for (uint32_t n = 0; n < 4; n++) {
		assert_true(port_usb_event(&host->board->port, words));
		assert_int_equal(words[1], 10 + n);
	}
	assert_false(port_usb_event(&host->board->port, words));
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(words_may_come_and_go_in_pieces_of_any_size),
		TEST(in_that_is_not_read_stops_everything_and_loses_nothing),
		TEST(completions_that_are_not_read_stop_the_jobs),
		TEST(work_is_false_only_if_nothing_moved),
		TEST(event_tells_of_each_fault_and_of_no_good_job),
		TEST(events_that_nobody_fetches_are_dropped_but_four),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
