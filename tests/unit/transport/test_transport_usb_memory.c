/* SPDX-License-Identifier: MIT */
/* Memory of a board on USB that fails: it is cleared before it is used, and not twice. */
#include <poll.h>
#include <sched.h>

#include "usb_odd.h"
#include "usb_words.h"

static void memory_whose_clearing_was_lost_is_cleared_again(void **state)
{
	uint32_t words[WORDS];
	unsigned int failed = 0;
	uint64_t object;
	int err;

	for (int i = 0; i < 5; i++) {
		assert_int_equal(ops->memory_new(*state, 4 * WORDS, &object), 0);
		for (int n = 0; n <= i; n++) {
			fake_usb_arm(0, n % 2 ? FAKE_USB_LOSE_OUT : FAKE_USB_ERROR_OUT, 1, 0);
			/* It may have failed, and been repeated, before there was a job that uses it. */
			err = read_words(*state, object, words, WORDS);
			assert_true(!err || err == -EIO);
			failed += err != 0;
		}
		assert_int_equal(read_words(*state, object, words, WORDS), 0);
		for (uint32_t n = 0; n < WORDS; n++)
			assert_int_equal(words[n], 0);
		write_words(*state, object);
		ops->memory_free(*state, object);
	}
	assert_true(failed);
}

struct submitter {
	pthread_t thread;
	void *state;
	uint64_t object;
	uint32_t words[WORDS];
	_Atomic bool started;
	int err;
};

static void *read_in_thread(void *data)
{
	struct submitter *submitter = data;
	const struct accel_transport_slot slot = { submitter->object, GLOSS_RIGHTS_READ };
	uint32_t stream[3];
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = (uint32_t)packet_read(stream, 0, 0, WORDS),
		.response = submitter->words,
		.response_words = WORDS,
		.slot = &slot,
		.slots = 1,
	};
	struct gloss_status status;
	uint64_t sequence;

	submitter->started = true;
	submitter->err = try_submit(submitter->state, &job, &sequence);
	if (!submitter->err)
		submitter->err = wait_for(submitter->state, sequence, &status);
	return NULL;
}

/* The clearing is lost while the job that needs it waits for its turn to be queued. */
static void memory_is_cleared_for_a_job_that_was_not_yet_queued(void **state)
{
	const uint32_t words = 2u << 20;
	uint32_t *stream = calloc(words, 4);
	struct submitter submitter = { .state = *state };
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_READ };
	struct accel_transport_job job = { .stream = stream,
					   .stream_words = words / 4,
					   .slot = &slot };
	struct gloss_status status;
	uint64_t sequence[2];

	assert_int_equal(ops->memory_new(*state, 4 * WORDS, &submitter.object), 0);
	slot.object = submitter.object;
	fake_usb_hold();
	sequence[0] = submit(*state, &job); /* keeps the cable busy */
	job.slots = 1;
	job.stream_words = words;
	sequence[1] = submit(*state, &job);
	assert_int_equal(pthread_create(&submitter.thread, NULL, read_in_thread, &submitter), 0);
	while (!submitter.started)
		sched_yield();
	poll(NULL, 0, 100);
	fake_usb_arm(0, FAKE_USB_ERROR_OUT, 1, 0);
	fake_usb_release();
	pthread_join(submitter.thread, NULL);
	for (int i = 0; i < 2; i++)
		assert_int_equal(wait_for(*state, sequence[i], &status), -EIO);
	assert_int_equal(submitter.err, 0);
	for (uint32_t n = 0; n < WORDS; n++)
		assert_int_equal(submitter.words[n], 0);
	ops->memory_free(*state, submitter.object);
	free(stream);
}

/* What was cleared is not cleared again, whatever comes. */
static void memory_keeps_its_words_over_a_failure(void **state)
{
	uint64_t object = object_with_words(*state);
	struct gloss_status status;

	for (int i = 0; i < 3; i++) {
		fake_usb_arm(0, FAKE_USB_ERROR_OUT, 1, 0);
		assert_int_equal(wait_for(*state, submit_empty(*state), &status), -EIO);
		assert_words(*state, object);
	}
	ops->memory_free(*state, object);
}

static void memory_that_can_not_be_cleared_is_not_used(void **state)
{
	uint32_t words[WORDS];
	uint64_t object;
	int err;

	assert_int_equal(ops->memory_new(*state, 4 * WORDS, &object), 0);
	odd.completions = 1;
	/* 0: it was cleared again before there was a job that uses it. */
	err = read_words(*state, object, words, WORDS);
	assert_true(!err || err == -EIO);
	assert_int_equal(fake_usb.resets, 2);
	assert_int_equal(read_words(*state, object, words, WORDS), 0);
	for (uint32_t n = 0; n < WORDS; n++)
		assert_int_equal(words[n], 0);
	ops->memory_free(*state, object);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		usb_test(memory_whose_clearing_was_lost_is_cleared_again),
		usb_test(memory_is_cleared_for_a_job_that_was_not_yet_queued),
		usb_test(memory_keeps_its_words_over_a_failure),
		odd_test(memory_that_can_not_be_cleared_is_not_used),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
