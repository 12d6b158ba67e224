/* SPDX-License-Identifier: MIT */
/* Jobs through the kernel module, on the kernel of fake_gloss.h. */
#include <time.h>
#include <unistd.h>

#include "drm_test.h"

#define UNUSED_BYTES (32u << 20)
#define UNUSED_BUFFERS 256

/* ---- what a job is ---- */

static void a_job_takes_two_ioctls(void **state)
{
	uint32_t stream[3000] = { 0 }, response[500];
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = 3000,
		.response = response,
		.response_words = 500,
	};
	struct gloss_status status;
	unsigned int ioctls;

	run(*state, &job, &status);
	ioctls = fake_gloss.ioctls;
	for (int i = 0; i < 10; i++)
		run(*state, &job, &status);
	assert_int_equal(fake_gloss.ioctls - ioctls, 20);
	assert_int_equal(fake_gloss.submits, 11);
	assert_int_equal(fake_gloss.waits, 11);
	assert_int_equal(fake_gloss.creates, 1);
}

static void what_is_no_job_is_refused(void **state)
{
	const struct accel_transport_slot unknown = { 1234ull | 4096ull << 32, GLOSS_RIGHTS_READ };
	const struct accel_transport_job jobs[] = {
		{ .stream_words = FAKE_WORDS_MAX + 1 },
		{ .response_words = FAKE_WORDS_MAX + 1 },
		{ .slots = GLOSS_SLOTS + 1 },
		{ .slot = &unknown, .slots = 1 },
	};
	uint64_t sequence;

	for (size_t i = 0; i < sizeof(jobs) / sizeof(jobs[0]); i++)
		assert_int_equal(ops->submit(*state, &jobs[i], &sequence), -EINVAL);
	assert_int_equal(fake_gloss.submits, 0);
	assert_int_equal(fake_gloss.creates, 1);
	run_empty(*state);
}

/* ---- waiting ---- */

static int64_t now_ns(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return now.tv_sec * 1000000000ll + now.tv_nsec;
}

static void *release_later(void *data)
{
	usleep(20000);
	fake_gloss_release();
	return data;
}

static void a_wait_for_a_running_job_times_out(void **state)
{
	struct gloss_status status;
	pthread_t thread;
	int64_t before;
	uint64_t sequence;

	fake_gloss_hold();
	sequence = submit_empty(*state);
	assert_int_equal(ops->wait(*state, sequence, 0, &status), -ETIMEDOUT);
	before = now_ns();
	assert_int_equal(ops->wait(*state, sequence, 20000000, &status), -ETIMEDOUT);
	assert_true(now_ns() - before >= 20000000);
	assert_int_equal(pthread_create(&thread, NULL, release_later, NULL), 0);
	assert_int_equal(ops->wait(*state, sequence, INT64_MAX, &status), 0);
	pthread_join(thread, NULL);
}

/* ---- failures of the board ---- */

static void a_lost_job_fails_alone(void **state)
{
	static const struct {
		int error, answer;
	} lost[] = {
		{ -EIO, -EIO },    { -ENODEV, -ENODEV }, { -ECANCELED, -ENODEV },
		{ -EPROTO, -EIO }, { -ETIME, -ETIME },   { FAKE_NO_STATUS, -EIO },
	};
	struct gloss_status status;
	uint64_t sequence[3];

	for (size_t i = 0; i < sizeof(lost) / sizeof(lost[0]); i++) {
		fake_gloss_lose(1, lost[i].error);
		for (int j = 0; j < 3; j++)
			sequence[j] = submit_empty(*state);
		assert_int_equal(wait_for(*state, sequence[0], &status), 0);
		assert_int_equal(wait_for(*state, sequence[1], &status), lost[i].answer);
		assert_int_equal(status.cause, GLOSS_FAULT_NONE);
		assert_int_equal(wait_for(*state, sequence[2], &status), 0);
	}
}

static void an_unplugged_board_ends_every_wait_and_call(void **state)
{
	struct gloss_status status;
	struct waiter waiter[8];
	uint64_t object, later;
	const struct accel_transport_job job = { .stream_words = 0 };

	assert_int_equal(ops->memory_new(*state, 4096, &object), 0);
	fake_gloss_hold();
	start_waiters(*state, waiter, 8);
	later = submit_empty(*state);
	usleep(10000);
	fake_gloss_unplug();
	join_waiters(waiter, 8, -ENODEV);
	assert_int_equal(wait_for(*state, later, &status), -ENODEV);
	assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	assert_int_equal(ops->submit(*state, &job, &later), -ENODEV);
	assert_int_equal(ops->memory_new(*state, 4096, &object), -ENODEV);
	ops->memory_free(*state, object);
	ops->close(*state);
	assert_int_equal(fake_gloss.files, 0);
	assert_int_equal(fake_gloss_mappings(), 0);
	fake_gloss_stop();
	assert_int_equal(drm_setup(state), 0);
}

/* ---- the pool ---- */

static void run_many(void *state, int jobs, uint32_t words)
{
	uint32_t *response = calloc(words + 1, 4);
	const struct accel_transport_job job = { .response = response, .response_words = words };
	struct gloss_status status;
	uint64_t *sequence = calloc((size_t)jobs, sizeof(*sequence));

	fake_gloss_hold();
	for (int i = 0; i < jobs; i++)
		sequence[i] = submit(state, &job);
	fake_gloss_release();
	for (int i = 0; i < jobs; i++)
		assert_int_equal(wait_for(state, sequence[i], &status), 0);
	free(sequence);
	free(response);
}

static void unused_memory_is_bounded(void **state)
{
	unsigned int creates;

	run_many(*state, 300, 0);
	assert_int_equal(fake_gloss.creates, 300);
	assert_int_equal(fake_gloss.handles, UNUSED_BUFFERS);
	run_many(*state, 12, (4u << 20) / 4);
	assert_true(fake_gloss.host_bytes <= UNUSED_BYTES);
	assert_true(fake_gloss.host_bytes >= UNUSED_BYTES / 2);
	creates = fake_gloss.creates;
	run_many(*state, 4, (4u << 20) / 4);
	assert_int_equal(fake_gloss.creates, creates);
}

static void jobs_of_about_the_same_size_share(void **state)
{
	run_many(*state, 1, 7 * PAGE_WORDS);
	run_many(*state, 1, 7 * PAGE_WORDS - 1);
	run_many(*state, 1, 3 * PAGE_WORDS + 1);
	assert_int_equal(fake_gloss.creates, 1);
	run_many(*state, 1, 7 * PAGE_WORDS + 1);
	assert_int_equal(fake_gloss.creates, 2);
	run_many(*state, 1, 3 * PAGE_WORDS);
	assert_int_equal(fake_gloss.creates, 3);
}

static void a_job_larger_than_the_pool_takes_no_more_than_it_needs(void **state)
{
	uint32_t *stream = calloc(FAKE_WORDS_MAX, 4), *response = calloc(FAKE_WORDS_MAX, 4);
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = FAKE_WORDS_MAX,
		.response = response,
		.response_words = FAKE_WORDS_MAX,
	};
	struct gloss_status status;
	uint64_t sequence;

	run_empty(*state);
	sequence = submit(*state, &job);
	assert_int_equal(fake_gloss.host_bytes, 4096 + 4096 + 8ull * FAKE_WORDS_MAX);
	assert_int_equal(wait_for(*state, sequence, &status), 0);
	assert_int_equal(status.offset, FAKE_WORDS_MAX);
	assert_int_equal(fake_gloss.host_bytes, 4096);
	free(stream);
	free(response);
}

static void the_pool_gives_way_when_memory_is_short(void **state)
{
	run_many(*state, 8, 0);
	assert_int_equal(fake_gloss.handles, 8);
	fake_gloss.fail_request = GLOSS(GEM_CREATE);
	fake_gloss.fail_errno = ENOMEM;
	fake_gloss.fail_at = 1;
	run_many(*state, 1, PAGE_WORDS);
	assert_int_equal(fake_gloss.handles, 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		drm_test(a_job_takes_two_ioctls),
		drm_test(words_of_any_count_arrive),
		drm_test(a_slot_is_as_large_as_was_asked_for_and_has_its_rights),
		drm_test(a_fault_is_no_error_of_wait),
		drm_test(what_is_no_job_is_refused),
		drm_test(jobs_run_in_the_order_of_their_submission),
		drm_test(board_memory_runs_out_and_comes_back),
		drm_test(a_wait_for_a_running_job_times_out),
		drm_test(a_job_is_waited_for_once),
		drm_test(many_threads_wait_while_another_submits),
		drm_test(a_lost_job_fails_alone),
		drm_test(an_unplugged_board_ends_every_wait_and_call),
		drm_test(unused_memory_is_bounded),
		drm_test(jobs_of_about_the_same_size_share),
		drm_test(a_job_larger_than_the_pool_takes_no_more_than_it_needs),
		drm_test(the_pool_gives_way_when_memory_is_short),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
