// SPDX-License-Identifier: MIT
/* How the USB port finds the usb_sync of its host, among anything, and drops all else. */
#include "port_usb_test.h"

static void sync_comes_back_and_ends_a_burst(void **state)
{
	struct usb_host *host = *state;

	start(host);
	assert_true(usb_host_empty(host));
	assert_status(host, R(STATUS_IDLE));
	assert_int_equal(host->event.count, 0);
}

static void sync_that_is_not_right_is_dropped(void **state)
{
	struct usb_host *host = *state;

	for (uint32_t n = 0; n < GLOSS_USB_SYNC_WORDS * 32; n++) {
		assert_true(usb_host_reset(host, NONCE));
		usb_host_sync(host, NONCE);
		host->out.word[n / 32] ^= 1u << n % 32;
		run(host);
		assert_int_equal(host->in.count, 0);
	}
	/* Right in itself, with the nonce of somebody else, with another mark. */
	usb_host_sync(host, NONCE + 1);
	usb_host_sync(host, NONCE);
	host->out.word[host->out.count - 4] ^= 2;
	host->out.word[host->out.count - 1] ^= 2;
	run(host);
	assert_int_equal(host->in.count, 0);
	assert_reset(host, NONCE);
}

static void sync_does_not_begin_before_the_reset(void **state)
{
	struct usb_host *host = *state;

	for (uint32_t words = 1; words < GLOSS_USB_SYNC_WORDS; words++) {
		assert_true(usb_host_reset(host, NONCE));
		usb_host_sync(host, NONCE);
		host->out.count = words;
		run(host);
		assert_true(usb_host_reset(host, NONCE));
		host->out.count = GLOSS_USB_SYNC_WORDS;
		host->sent = words;
		run(host);
		assert_int_equal(host->in.count, 0);
	}
}

static void sync_with_a_nonce_of_zero_is_dropped(void **state)
{
	struct usb_host *host = *state;

	assert_true(usb_host_reset(host, 0));
	usb_host_sync(host, 0);
	run(host);
	assert_int_equal(host->in.count, 0);
}

static void sync_is_found_behind_anything(void **state)
{
	struct usb_host *host = *state;

	for (uint32_t words = 1; words < GLOSS_USB_SYNC_WORDS; words++) {
		assert_true(usb_host_reset(host, NONCE));
		/* A part of one, a job of somebody else, another part. */
		usb_host_sync(host, NONCE);
		host->out.count = words;
		add_job(host, words, 0, 1);
		usb_host_sync(host, NONCE);
		host->out.count -= words;
		usb_host_sync(host, NONCE);
		add_job(host, 3, 0, 2);
		run(host);
		assert_true(usb_host_echo(host, NONCE));
		assert_answer(host, 0, 2);
		assert_true(usb_host_empty(host));
	}
}

static void sync_waits_for_its_nonce_to_be_written(void **state)
{
	struct usb_host *host = *state;

	assert_true(usb_host_reset(host, 7));
	usb_host_sync(host, NONCE);
	host->out.count = GLOSS_USB_SYNC_WORDS - 1;
	run(host);
	usb_host_write(host, R(NONCE), NONCE);
	host->out.count = GLOSS_USB_SYNC_WORDS;
	run(host);
	assert_true(usb_host_echo(host, NONCE));
	/* Then it does not matter any more. */
	usb_host_write(host, R(NONCE), 0);
	add_job(host, 1, 0, 1);
	run(host);
	assert_answer(host, 0, 1);
}

static void jobs_without_a_sync_are_dropped(void **state)
{
	struct usb_host *host = *state;

	assert_true(usb_host_reset(host, NONCE));
	add_job(host, 10, 10, 1);
	run(host);
	assert_int_equal(host->in.count, 0);
	assert_int_equal(host->board->engine.begun, 0);
	assert_reset(host, NONCE);
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(sync_comes_back_and_ends_a_burst),
		TEST(sync_that_is_not_right_is_dropped),
		TEST(sync_does_not_begin_before_the_reset),
		TEST(sync_with_a_nonce_of_zero_is_dropped),
		TEST(sync_is_found_behind_anything),
		TEST(sync_waits_for_its_nonce_to_be_written),
		TEST(jobs_without_a_sync_are_dropped),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
