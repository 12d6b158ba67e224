/* SPDX-License-Identifier: MIT */
/* Jobs on a board on USB that works, on the libusb of tests/usb/fake_usb.h. */
#include <poll.h>
#include <sched.h>

#include "share_test.h"
#include "usb_test.h"

#define QUEUED_MAX (4u << 20)

/* ---- what a job is ---- */

static void a_fault_resets_no_board(void **state)
{
	a_fault_is_no_error_of_wait(state);
	assert_int_equal(fake_usb.resets, 1);
}

static void what_is_no_job_is_refused(void **state)
{
	const struct accel_transport_slot unknown = { 4096, GLOSS_RIGHTS_READ };
	const struct accel_transport_job jobs[] = {
		{ .slots = GLOSS_SLOTS + 1 },
		{ .slot = &unknown, .slots = 1 },
	};
	uint64_t sequence;

	for (size_t i = 0; i < sizeof(jobs) / sizeof(jobs[0]); i++)
		assert_int_equal(ops->submit(*state, &jobs[i], &sequence), -EINVAL);
	run_empty(*state);
}

/* ---- transfers ---- */

static void a_large_job_has_transfers_in_flight_each_way(void **state)
{
	const uint32_t words = 2u << 20;
	uint32_t *stream = calloc(words, 4);
	const struct accel_transport_job job = { .stream = stream, .stream_words = words };
	struct gloss_status status;
	unsigned int submits = fake_usb_bulk_submits();

	run(*state, &job, &status);
	assert_int_equal(status.offset, words);
	assert_true(fake_usb.depth_out >= 4);
	assert_true(fake_usb.depth_in >= 4);
	/* Of 64 KiB and no less: what is IN comes to little here. */
	assert_true(fake_usb_bulk_submits() - submits < words * 4 / 65536 + 16);
	free(stream);
}

static void the_stream_and_the_slots_are_the_callers_again(void **state)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_READ_WRITE };
	uint32_t stream[4], response = 0;
	struct accel_transport_job job = {
		.stream = stream,
		.stream_words = (uint32_t)packet_write(stream, 0, 0, 1234),
		.slot = &slot,
		.slots = 1,
	};
	struct gloss_status status;
	uint64_t sequence;

	assert_int_equal(ops->memory_new(*state, 4, &slot.object), 0);
	fake_usb_hold();
	sequence = submit(*state, &job);
	memset(stream, 0xff, sizeof(stream));
	slot.rights = GLOSS_RIGHTS_NONE;
	fake_usb_release();
	assert_int_equal(wait_for(*state, sequence, &status), 0);
	assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	assert_int_equal(read_words(*state, slot.object, &response, 1), 0);
	assert_int_equal(response, 1234);
	ops->memory_free(*state, slot.object);
}

struct submitter {
	pthread_t thread;
	void *state;
	struct accel_transport_job job;
	uint64_t sequence[2];
	_Atomic int submitted;
};

static void *submit_in_thread(void *data)
{
	struct submitter *submitter = data;

	for (int i = 0; i < 2; i++, submitter->submitted++)
		submitter->sequence[i] = submit(submitter->state, &submitter->job);
	return NULL;
}

/* A job of its own goes at once, however large; the one after it waits until that is sent. */
static void what_is_queued_is_bounded(void **state)
{
	const uint32_t words = QUEUED_MAX / 4 + 1000;
	struct submitter submitter = { .state = *state };
	uint32_t *stream = calloc(words, 4);
	struct gloss_status status;

	submitter.job = (struct accel_transport_job){ .stream = stream, .stream_words = words };
	fake_usb_hold();
	assert_int_equal(pthread_create(&submitter.thread, NULL, submit_in_thread, &submitter), 0);
	while (!submitter.submitted)
		sched_yield();
	poll(NULL, 0, 200);
	assert_int_equal(submitter.submitted, 1);
	fake_usb_release();
	pthread_join(submitter.thread, NULL);
	for (int i = 0; i < 2; i++) {
		assert_int_equal(wait_for(*state, submitter.sequence[i], &status), 0);
		assert_int_equal(status.offset, words);
	}
	free(stream);
}

/* ---- board memory ---- */

static void write_all(void *state, uint64_t object, uint32_t bytes)
{
	const struct accel_transport_slot slot = { object, GLOSS_RIGHTS_WRITE };
	uint32_t stream[4];
	struct accel_transport_job job = { .stream = stream, .slot = &slot, .slots = 1 };
	struct gloss_status status;

	for (uint32_t at = 0; at < bytes; at += 2048) {
		job.stream_words = (uint32_t)packet_write(stream, 0, at, at + 1);
		run(state, &job, &status);
		assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	}
}

static void assert_zero(void *state, uint64_t object, uint32_t words)
{
	static uint32_t back[65535];

	memset(back, 0x5a, sizeof(back));
	assert_int_equal(read_words(state, object, back, words), 0);
	for (uint32_t i = 0; i < words; i++)
		if (back[i])
			fail_msg("word %u of new memory is %08x", i, back[i]);
}

/* The board's memory is dirt when it is plugged in, and then what another object had. */
static void new_memory_is_zero(void **state)
{
	static const uint32_t sizes[] = { 4, 4096, 16384, 16388, 100000, 262140 };
	uint64_t object;

	for (int round = 0; round < 3; round++)
		for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
			assert_int_equal(ops->memory_new(*state, sizes[i], &object), 0);
			assert_zero(*state, object, sizes[i] / 4);
			write_all(*state, object, sizes[i]);
			ops->memory_free(*state, object);
		}
}

static void memory_is_cleared_once(void **state)
{
	uint32_t words[2] = { 0 };
	uint64_t object[2];

	assert_int_equal(ops->memory_new(*state, 8192, &object[0]), 0);
	write_all(*state, object[0], 8192);
	assert_int_equal(ops->memory_new(*state, 8192, &object[1]), 0);
	assert_zero(*state, object[1], 2048);
	assert_int_equal(read_words(*state, object[0], words, 1), 0);
	assert_int_equal(words[0], 1);
	ops->memory_free(*state, object[0]);
	ops->memory_free(*state, object[1]);
}

static void memory_that_no_job_uses_is_not_cleared(void **state)
{
	uint64_t object, words = fake_usb.out_words;

	assert_int_equal(ops->memory_new(*state, 1 << 20, &object), 0);
	run_empty(*state);
	assert_int_equal(fake_usb.out_words - words, GLOSS_USB_JOB_WORDS + GLOSS_USB_JOB_END_WORDS);
	ops->memory_free(*state, object);
}

/* ---- waiting ---- */

static void a_wait_for_a_running_job_times_out(void **state)
{
	struct gloss_status status;
	int64_t before;
	uint64_t sequence;

	fake_usb_hold();
	sequence = submit_empty(*state);
	assert_int_equal(ops->wait(*state, sequence, 0, &status), -ETIMEDOUT);
	before = fake_usb_now_ns();
	assert_int_equal(ops->wait(*state, sequence, 20000000, &status), -ETIMEDOUT);
	assert_true(fake_usb_now_ns() - before >= 20000000);
	fake_usb_release();
	assert_int_equal(ops->wait(*state, sequence, INT64_MAX, &status), 0);
}

/* After a while the thread is asleep, and has to be woken. */
static void a_board_that_was_idle_for_long_works(void **state)
{
	for (int i = 0; i < 5; i++) {
		fake_usb_rest(3000);
		run_empty(*state);
	}
	assert_int_equal(fake_usb.resets, 1);
}

/* ---- the library on it ---- */

static void threads_share_a_device(void **state)
{
	ops->close(*state);
	share_check("usb:");
	assert_int_equal(ops->open("", state, NULL), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		usb_test(words_of_any_count_arrive),
		usb_test(a_slot_is_as_large_as_was_asked_for_and_has_its_rights),
		usb_test(a_fault_resets_no_board),
		usb_test(what_is_no_job_is_refused),
		usb_test(jobs_run_in_the_order_of_their_submission),
		usb_test(a_large_job_has_transfers_in_flight_each_way),
		usb_test(the_stream_and_the_slots_are_the_callers_again),
		usb_test(what_is_queued_is_bounded),
		usb_test(board_memory_runs_out_and_comes_back),
		usb_test(new_memory_is_zero),
		usb_test(memory_is_cleared_once),
		usb_test(memory_that_no_job_uses_is_not_cleared),
		usb_test(a_wait_for_a_running_job_times_out),
		usb_test(a_job_is_waited_for_once),
		usb_test(many_threads_wait_while_another_submits),
		usb_test(a_board_that_was_idle_for_long_works),
		usb_test(threads_share_a_device),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
