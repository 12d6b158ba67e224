/* SPDX-License-Identifier: MIT */
/* A board on USB that fails: what its jobs are told, that the next one is right, and when it is
 * gone. */
#include "usb_odd.h"
#include "usb_words.h"

/* ---- failures that pass ---- */

static void check_fault(void *state, uint64_t object, enum fake_usb_fault fault, uint32_t value)
{
	unsigned int resets = fake_usb.resets;
	uint32_t words[WORDS];
	int err;

	fake_usb_arm(0, fault, 1, value);
	err = read_words(state, object, words, WORDS);
	if (err != -EIO)
		fail_msg("%s: %s", fake_usb_fault_name(fault), strerror(-err));
	run_empty(state);
	fake_usb_disarm();
	assert_words(state, object);
	assert_int_equal(fake_usb.resets, resets + 1);
}

static void a_job_that_fails_is_told_and_the_next_is_right(void **state)
{
	static const struct {
		enum fake_usb_fault fault;
		uint32_t value;
	} faults[] = {
		{ FAKE_USB_STALL_OUT, 0 },   { FAKE_USB_STALL_IN, 0 },    { FAKE_USB_ERROR_OUT, 0 },
		{ FAKE_USB_ERROR_IN, 0 },    { FAKE_USB_OVERFLOW_IN, 0 }, { FAKE_USB_LOSE_OUT, 0 },
		{ FAKE_USB_LOSE_IN, 0 },     { FAKE_USB_REPEAT_IN, 0 },   { FAKE_USB_ODD_IN, 0 },
		{ FAKE_USB_GARBAGE_IN, 15 }, { FAKE_USB_GARBAGE_OUT, 0 }, { FAKE_USB_HANG_IN, 0 },
		{ FAKE_USB_HANG_OUT, 0 },
	};
	uint64_t object = object_with_words(*state);

	for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++)
		check_fault(*state, object, faults[i].fault, faults[i].value);
	ops->memory_free(*state, object);
}

static void check_garbage(void *state, uint64_t object, enum fake_usb_fault fault, uint64_t at)
{
	uint32_t words[WORDS];
	int err;

	fake_usb_arm(0, fault, at, 0);
	err = read_words(state, object, words, WORDS);
	if (err != -EIO)
		fail_msg("%s at %llu: %s", fake_usb_fault_name(fault), (unsigned long long)at,
			 strerror(-err));
	fake_usb_disarm();
	assert_words(state, object);
}

/* Also where the words are the caller's. */
static void a_wrong_word_anywhere_is_found(void **state)
{
	const uint64_t out_words = GLOSS_USB_JOB_WORDS + GLOSS_SLOT_ENTRY_WORDS + 3 +
				   GLOSS_USB_JOB_END_WORDS;
	const uint64_t in_words = WORDS +
				  (WORDS + GLOSS_USB_CHUNK_WORDS - 1) / GLOSS_USB_CHUNK_WORDS +
				  GLOSS_USB_COMPLETION_WORDS;
	uint64_t object = object_with_words(*state), seed = test_seed();

	for (uint64_t at = 1; at <= out_words; at++)
		check_garbage(*state, object, FAKE_USB_GARBAGE_OUT, at);
	for (uint64_t at = 1; at <= in_words; at += 1 + test_below(&seed, 100))
		check_garbage(*state, object, FAKE_USB_GARBAGE_IN, at);
	for (uint64_t n = 0; n < GLOSS_USB_COMPLETION_WORDS; n++)
		check_garbage(*state, object, FAKE_USB_GARBAGE_IN, in_words - n);
	ops->memory_free(*state, object);
}

static void a_wrong_word_to_be_written_is_found(void **state)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_WRITE };
	uint32_t stream[3 + WORDS / 3] = { 0 };
	const struct accel_transport_job job = {
		.stream = stream, .stream_words = 3 + WORDS / 3, .slot = &slot, .slots = 1
	};
	const uint64_t before = GLOSS_USB_JOB_WORDS + GLOSS_SLOT_ENTRY_WORDS + 3;
	uint64_t seed = test_seed();
	struct gloss_status status;

	gloss_write_memory_pack(stream, &(struct gloss_write_memory){ .slot = 0 }, 2 + WORDS / 3);
	slot.object = object_with_words(*state);
	for (int n = 0; n < 50; n++) {
		fake_usb_arm(0, FAKE_USB_GARBAGE_OUT, before + 1 + test_below(&seed, WORDS / 3), 0);
		assert_int_equal(wait_for(*state, submit(*state, &job), &status), -EIO);
		run(*state, &job, &status);
		assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	}
	ops->memory_free(*state, slot.object);
}

static void what_the_protocol_allows_is_no_failure(void **state)
{
	static const struct {
		enum fake_usb_fault fault;
		uint32_t value;
	} faults[] = {
		{ FAKE_USB_SHORT_IN, 0 },      { FAKE_USB_EMPTY_IN, 1 },
		{ FAKE_USB_EMPTY_IN, 100 },    { FAKE_USB_STALL_EVENT, 0 },
		{ FAKE_USB_GARBAGE_EVENT, 0 }, { FAKE_USB_DELAY, 300000 },
	};
	uint64_t object = object_with_words(*state);

	for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++) {
		fake_usb_arm(0, faults[i].fault, 1, faults[i].value);
		assert_words(*state, object);
		fake_usb_disarm();
	}
	assert_int_equal(fake_usb.resets, 1);
	ops->memory_free(*state, object);
}

static void every_job_that_is_outstanding_fails_and_is_forgotten(void **state)
{
	struct gloss_status status;
	uint64_t sequence[20];

	fake_usb_hold();
	for (int i = 0; i < 20; i++)
		sequence[i] = submit_empty(*state);
	fake_usb_arm(0, FAKE_USB_HANG_IN, 1, 0);
	fake_usb_release();
	for (int i = 19; i >= 0; i--) {
		assert_int_equal(wait_for(*state, sequence[i], &status), -EIO);
		assert_int_equal(status.cause, GLOSS_FAULT_NONE);
		assert_int_equal(status.response_words, 0);
		assert_int_equal(ops->wait(*state, sequence[i], -1, &status), -EINVAL);
	}
	run_empty(*state);
}

static void every_thread_that_waits_is_told(void **state)
{
	struct waiter waiter[8];

	fake_usb_hold();
	start_waiters(*state, waiter, 8);
	fake_usb_arm(0, FAKE_USB_STALL_IN, 1, 0);
	fake_usb_release();
	join_waiters(waiter, 8, -EIO);
	run_empty(*state);
}

/* ---- a board that answers what it was not asked ---- */

static void a_job_can_not_end_before_it_is_sent(void **state)
{
	const uint32_t words = 2u << 20;
	uint32_t *stream = calloc(words, 4), forged[GLOSS_USB_COMPLETION_WORDS];
	const struct accel_transport_job job = { .stream = stream, .stream_words = words };
	struct gloss_status status;
	uint64_t sequence;

	fake_usb_hold();
	sequence = submit(*state, &job);
	gloss_usb_completion_pack(forged, &(struct gloss_usb_completion){
						  .mark = GLOSS_USB_COMPLETION_MAGIC,
						  .sequence = (uint32_t)sequence,
						  .offset = words });
	forged[GLOSS_USB_COMPLETION_CHECKSUM_WORD] = accel_usb_checksum(
		0, forged, GLOSS_USB_COMPLETION_CHECKSUM_WORD);
	for (int i = GLOSS_USB_COMPLETION_WORDS - 1; i >= 0; i--)
		odd.forged[i] = forged[i];
	fake_usb_release();
	assert_int_equal(wait_for(*state, sequence, &status), -EIO);
	run(*state, &job, &status);
	assert_int_equal(status.offset, words);
	free(stream);
}

/* ---- failures that do not pass ---- */

static void check_gone(void **state, struct waiter *waiter, int waiters)
{
	const struct accel_transport_job job = { .stream_words = 0 };
	struct accel_transport_error error = { "" };
	uint64_t sequence;

	join_waiters(waiter, waiters, -ENODEV);
	assert_int_equal(ops->submit(*state, &job, &sequence), -ENODEV);
	ops->close(*state);
	fake_usb_disarm();
	fake_usb_plug(0, true);
	assert_int_equal(ops->open("", state, &error), 0);
	run_empty(*state);
}

static void an_unplugged_board_ends_every_wait_and_call(void **state)
{
	struct waiter waiter[8];

	for (int i = 0; i < 20; i++) {
		fake_usb_hold();
		start_waiters(*state, waiter, 8);
		fake_usb_unplug(0);
		fake_usb_release();
		check_gone(state, waiter, 8);
	}
}

static void an_unplugged_board_is_noticed_without_a_job(void **state)
{
	struct accel_transport_job job = { .stream_words = 0 };
	struct gloss_status status;
	uint64_t sequence;
	int err = 0;

	fake_usb_unplug(0);
	while (!err) {
		err = ops->submit(*state, &job, &sequence);
		if (!err)
			assert_int_equal(wait_for(*state, sequence, &status), -ENODEV);
	}
	check_gone(state, NULL, 0);
}

/* Whatever of a new start fails, and three times: not more, and not without end. */
static void a_board_that_does_not_start_again_is_gone(void **state)
{
	static const struct {
		enum fake_usb_fault fault;
		uint32_t value;
	} faults[] = {
		{ FAKE_USB_REFUSE_CONTROL, 1000 },
		{ FAKE_USB_HANG_CONTROL, 1000 },
		{ FAKE_USB_RESET_LASTS, UINT32_MAX },
	};
	struct waiter waiter[4];

	for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++) {
		unsigned int resets = fake_usb.resets;

		fake_usb_hold();
		start_waiters(*state, waiter, 4);
		fake_usb_arm(0, faults[i].fault, 1, faults[i].value);
		fake_usb_arm(0, FAKE_USB_ERROR_IN, 1, 0);
		fake_usb_release();
		check_gone(state, waiter, 4);
		assert_in_range(fake_usb.resets - resets, 1, 4);
	}
}

static void a_start_that_fails_twice_is_tried_again(void **state)
{
	struct gloss_status status;

	fake_usb_arm(0, FAKE_USB_ERROR_IN, 1, 0);
	fake_usb_arm(0, FAKE_USB_REFUSE_CONTROL, 1, 1);
	assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
	run_empty(*state);
}

static void a_board_may_be_closed_while_it_starts_again(void **state)
{
	struct accel_transport_error error = { "" };
	struct gloss_status status;
	uint64_t sequence;

	for (int i = 0; i < 20; i++) {
		fake_usb_arm(0, i % 2 ? FAKE_USB_HANG_IN : FAKE_USB_STALL_IN, 1, 0);
		sequence = submit_empty(*state);
		fake_usb_arm(0, FAKE_USB_HANG_IN, 1, 0);
		assert_int_equal(wait_for(*state, sequence, &status), -EIO);
		ops->close(*state);
		fake_usb_disarm();
		assert_int_equal(ops->open("", state, &error), 0);
		run_empty(*state);
	}
}

/* ---- a host before this one ---- */

static void remains_of_another_host_do_no_harm(void **state)
{
	static const uint32_t stream[100000];
	const struct accel_transport_job job = { .stream = stream, .stream_words = 100000 };
	struct accel_transport_error error = { "" };
	struct gloss_status status;
	uint64_t sequence;

	for (int i = 0; i < 10; i++) {
		fake_usb_arm(0, FAKE_USB_KILL, 1 + (uint64_t)i * 37, 1);
		sequence = submit(*state, &job);
		assert_int_equal(wait_for(*state, sequence, &status), -ENODEV);
		ops->close(*state);
		fake_usb_disarm();
		assert_int_equal(ops->open("", state, &error), 0);
		run(*state, &job, &status);
		assert_int_equal(status.offset, 100000);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		usb_test(a_job_that_fails_is_told_and_the_next_is_right),
		usb_test(a_wrong_word_anywhere_is_found),
		usb_test(a_wrong_word_to_be_written_is_found),
		usb_test(what_the_protocol_allows_is_no_failure),
		usb_test(every_job_that_is_outstanding_fails_and_is_forgotten),
		usb_test(every_thread_that_waits_is_told),
		odd_test(a_job_can_not_end_before_it_is_sent),
		usb_test(an_unplugged_board_ends_every_wait_and_call),
		usb_test(an_unplugged_board_is_noticed_without_a_job),
		usb_test(a_board_that_does_not_start_again_is_gone),
		usb_test(a_start_that_fails_twice_is_tried_again),
		usb_test(a_board_may_be_closed_while_it_starts_again),
		usb_test(remains_of_another_host_do_no_harm),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
