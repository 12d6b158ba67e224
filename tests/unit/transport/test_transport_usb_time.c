/* SPDX-License-Identifier: MIT */
/* How long a board on USB is waited for: what it does meanwhile, and how much of it is progress. */
#include "usb_odd.h"

#define NS_PER_MS 1000000ll

struct instant {
	int64_t now, leapt;
};

static struct instant instant(void)
{
	return (struct instant){ fake_usb_now_ns(), fake_usb_leapt_ns() };
}

/* At most so much of the time that leapt, while all waited: what else passes is the machine's. */
static void assert_took_ms(struct instant since, int64_t least, int64_t most)
{
	assert_true(fake_usb_now_ns() - since.now >= least * NS_PER_MS);
	assert_in_range(fake_usb_leapt_ns() - since.leapt, 0, most * NS_PER_MS);
}

static void a_board_that_stands_still_is_given_two_seconds(void **state)
{
	struct gloss_status status;
	struct instant before;

	fake_usb_arm(0, FAKE_USB_HANG_IN, 1, 0);
	before = instant();
	assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
	assert_took_ms(before, 1900, 3500);
}

/* Nothing comes of its transfers, so the thread, which sleeps, is to be woken. */
static void a_board_that_stands_still_after_a_long_rest_is_given_no_more(void **state)
{
	struct gloss_status status;
	struct instant before = instant();

	fake_usb_rest(5000);
	fake_usb_arm(0, FAKE_USB_HANG_OUT, 1, 0);
	before = instant();
	assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
	assert_took_ms(before, 1900, 3500);
}

/* They do not end with a reset either. */
static void transfers_without_a_word_are_no_progress(void **state)
{
	struct gloss_status status;
	struct instant before = instant();

	fake_usb_arm(0, FAKE_USB_EMPTY_IN, 1, UINT32_MAX);
	assert_int_equal(wait_for(*state, submit_empty(*state), &status), -ENODEV);
	assert_took_ms(before, 1900, 15000);
	fake_usb_disarm();
}

/* It says so itself, so it needs not be waited for; whatever events there were before. */
static void a_board_that_is_lost_is_given_no_time(void **state)
{
	static const uint32_t stream[] = { 0xff000000 };
	const struct accel_transport_job job = { .stream = stream, .stream_words = 1 };
	static const uint64_t at[] = { 1, GLOSS_USB_JOB_WORDS + GLOSS_USB_JOB_END_WORDS };
	struct gloss_status status;

	for (size_t n = 0; n < sizeof(at) / sizeof(at[0]); n++) {
		struct instant before = instant();

		for (int i = 0; i < 10; i++)
			run(*state, &job, &status);
		fake_usb_arm(0, FAKE_USB_GARBAGE_OUT, at[n], 0);
		assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
		assert_took_ms(before, 0, 1000);
		run_empty(*state);
	}
}

static void a_board_that_makes_progress_is_waited_for(void **state)
{
	static const uint32_t stream[1000];
	const struct accel_transport_job job = { .stream = stream, .stream_words = 1000 };
	struct gloss_status status;
	int64_t before = fake_usb_now_ns();

	odd.step = 1;
	odd.reads_to_work = 100;
	run(*state, &job, &status);
	assert_int_equal(status.offset, 1000);
	assert_true(fake_usb_now_ns() - before > 20000 * NS_PER_MS);
	assert_int_equal(fake_usb.resets, 1);
}

/* A register that runs wild is no work: a job has only so many words. */
static void a_board_that_makes_too_much_progress_is_not(void **state)
{
	static const uint32_t stream[1000];
	const struct accel_transport_job job = { .stream = stream, .stream_words = 1000 };
	struct gloss_status status;

	for (uint32_t step = 300; step; step = step == 300 ? 0x12345678 : 0) {
		odd.reads = 0;
		odd.step = step;
		odd.reads_to_work = 1000;
		assert_int_equal(wait_for(*state, submit(*state, &job), &status), -EIO);
		assert_in_range(odd.reads, 8, 20);
		run_empty(*state);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		usb_test(a_board_that_stands_still_is_given_two_seconds),
		usb_test(a_board_that_stands_still_after_a_long_rest_is_given_no_more),
		usb_test(transfers_without_a_word_are_no_progress),
		usb_test(a_board_that_is_lost_is_given_no_time),
		odd_test(a_board_that_makes_progress_is_waited_for),
		odd_test(a_board_that_makes_too_much_progress_is_not),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
