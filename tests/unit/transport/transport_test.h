/* SPDX-License-Identifier: MIT */
/*
 * Jobs on a board of any transport, and what holds for all of them; ops is that of the test which
 * includes this, as are board_hold and board_release.
 */
#ifndef TRANSPORT_TEST_H
#define TRANSPORT_TEST_H

#include <pthread.h>

#include "accel_test.h"
#include "transport/transport.h"

#define PAGE_WORDS 1024u

static const struct accel_transport_ops *const ops;

/* The board runs no job until it is let go. */
static inline void board_hold(void);
static inline void board_release(void);

/* As the library does, but for its lock. */
static inline int try_submit(void *state, const struct accel_transport_job *job, uint64_t *sequence)
{
	if (ops->wait_for_room)
		ops->wait_for_room(state);
	return ops->submit(state, job, sequence);
}

static inline uint64_t submit(void *state, const struct accel_transport_job *job)
{
	uint64_t sequence;

	assert_int_equal(try_submit(state, job, &sequence), 0);
	return sequence;
}

static inline uint64_t submit_empty(void *state)
{
	const struct accel_transport_job job = { .stream_words = 0 };

	return submit(state, &job);
}

static inline int wait_for(void *state, uint64_t sequence, struct gloss_status *status)
{
	*status = (struct gloss_status){ GLOSS_FAULT_SLOT, 99, 99 };
	return ops->wait(state, sequence, -1, status);
}

static inline void run(void *state, const struct accel_transport_job *job,
		       struct gloss_status *status)
{
	assert_int_equal(wait_for(state, submit(state, job), status), 0);
}

static inline void run_empty(void *state)
{
	struct gloss_status status;

	assert_int_equal(wait_for(state, submit_empty(state), &status), 0);
	assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	assert_int_equal(status.offset, 0);
	assert_int_equal(status.response_words, 0);
}

/* ---- threads that wait ---- */

struct waiter {
	pthread_t thread;
	void *state;
	uint64_t sequence;
	int err;
};

static inline void *wait_in_thread(void *data)
{
	struct waiter *waiter = data;
	struct gloss_status status;

	waiter->err = ops->wait(waiter->state, waiter->sequence, -1, &status);
	return NULL;
}

static inline void start_waiters(void *state, struct waiter *waiter, int count)
{
	for (int i = 0; i < count; i++) {
		waiter[i] = (struct waiter){ .state = state, .sequence = submit_empty(state) };
		assert_int_equal(pthread_create(&waiter[i].thread, NULL, wait_in_thread,
						&waiter[i]),
				 0);
	}
}

static inline void join_waiters(struct waiter *waiter, int count, int err)
{
	for (int i = 0; i < count; i++) {
		pthread_join(waiter[i].thread, NULL);
		assert_int_equal(waiter[i].err, err);
	}
}

/* ---- tests ---- */

/* Writes @count words in one job and reads them in another; NOPs make the streams odd. */
static inline void copy_words(void *state, uint64_t object, uint64_t *seed, uint32_t count)
{
	const struct accel_transport_slot slot = { object, GLOSS_RIGHTS_READ_WRITE };
	struct gloss_write_memory write = { .slot = 0 };
	uint32_t nops = test_below(seed, 2000), stream[2000 + 3 + PAGE_WORDS] = { 0 };
	uint32_t response[PAGE_WORDS + 8], *data = stream + nops + 3;
	struct accel_transport_job job = { .stream = stream, .slot = &slot, .slots = 1 };
	struct gloss_status status;

	gloss_write_memory_pack(stream + nops, &write, 2 + count);
	for (uint32_t i = 0; i < count; i++)
		data[i] = (uint32_t)test_random(seed);
	job.stream_words = nops + 3 + count;
	run(state, &job, &status);
	assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	assert_int_equal(status.offset, job.stream_words);

	memset(response, 0x5a, sizeof(response));
	packet_read(stream, 0, 0, count);
	job.stream_words = 3;
	job.response = response;
	job.response_words = count + test_below(seed, 5);
	run(state, &job, &status);
	assert_int_equal(status.response_words, count);
	assert_memory_equal(response, data, 4 * count);
	for (uint32_t i = count; i < PAGE_WORDS + 8; i++)
		assert_int_equal(response[i], 0x5a5a5a5a);
}

static inline void words_of_any_count_arrive(void **state)
{
	static const uint32_t counts[] = { 1,   2,   3,   255,  256,  257, 509,
					   511, 512, 513, 1000, 1019, 1020 };
	uint64_t object, seed = test_seed();

	assert_int_equal(ops->memory_new(*state, 4 * PAGE_WORDS, &object), 0);
	for (size_t i = 0; i < sizeof(counts) / sizeof(counts[0]); i++)
		copy_words(*state, object, &seed, counts[i]);
	for (int i = 0; i < 40; i++)
		copy_words(*state, object, &seed, 1 + test_below(&seed, 1020));
	ops->memory_free(*state, object);
}

static inline enum gloss_fault access_at(void *state, const struct accel_transport_slot *slot,
					 uint32_t offset, bool write)
{
	uint32_t stream[4], response;
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = (uint32_t)(write ? packet_write(stream, 0, offset, 7) :
						   packet_read(stream, 0, offset, 1)),
		.response = &response,
		.response_words = 1,
		.slot = slot,
		.slots = 1,
	};
	struct gloss_status status;

	run(state, &job, &status);
	return status.cause;
}

static inline void a_slot_is_as_large_as_was_asked_for_and_has_its_rights(void **state)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_READ };
	static const enum gloss_fault none = GLOSS_FAULT_NONE, fault = GLOSS_FAULT_SLOT;

	assert_int_equal(ops->memory_new(*state, 12, &slot.object), 0);
	assert_int_equal(access_at(*state, &slot, 8, false), none);
	assert_int_equal(access_at(*state, &slot, 12, false), fault);
	assert_int_equal(access_at(*state, &slot, 8, true), fault);
	slot.rights = GLOSS_RIGHTS_WRITE;
	assert_int_equal(access_at(*state, &slot, 8, false), fault);
	assert_int_equal(access_at(*state, &slot, 8, true), none);
	slot.rights = GLOSS_RIGHTS_NONE;
	assert_int_equal(access_at(*state, &slot, 8, false), fault);
	assert_int_equal(access_at(*state, &slot, 8, true), fault);
	ops->memory_free(*state, slot.object);
}

static inline void a_fault_is_no_error_of_wait(void **state)
{
	const uint32_t stream[] = { 0, 0, 0xff000000, 0 };
	const struct accel_transport_job job = { .stream = stream, .stream_words = 4 };
	struct gloss_status status;

	run(*state, &job, &status);
	assert_int_equal(status.cause, GLOSS_FAULT_OPCODE);
	assert_int_equal(status.offset, 2);
	run_empty(*state);
}

static inline void jobs_run_in_the_order_of_their_submission(void **state)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_READ_WRITE };
	uint32_t stream[4], response = 0;
	struct accel_transport_job job = { .stream = stream, .slot = &slot, .slots = 1 };
	struct gloss_status status;
	uint64_t sequence[100];

	assert_int_equal(ops->memory_new(*state, 4, &slot.object), 0);
	board_hold();
	for (uint32_t i = 0; i < 100; i++) {
		job.stream_words = (uint32_t)packet_write(stream, 0, 0, i);
		sequence[i] = submit(*state, &job);
	}
	board_release();
	job.stream_words = (uint32_t)packet_read(stream, 0, 0, 1);
	job.response = &response;
	job.response_words = 1;
	run(*state, &job, &status);
	assert_int_equal(response, 99);
	for (uint32_t i = 0; i < 100; i++)
		assert_int_equal(wait_for(*state, sequence[(37 * i) % 100], &status), 0);
	ops->memory_free(*state, slot.object);
}

static inline void board_memory_runs_out_and_comes_back(void **state)
{
	struct accel_transport_info info;
	uint64_t object[3];

	ops->info(*state, &info);
	assert_int_equal(ops->memory_new(*state, info.memory_size / 2, &object[0]), 0);
	assert_int_equal(ops->memory_new(*state, info.memory_size / 2, &object[1]), 0);
	assert_int_equal(ops->memory_new(*state, 4, &object[2]), -ENOMEM);
	assert_int_equal(ops->memory_new(*state, 1ull << 31, &object[2]), -ENOMEM);
	ops->memory_free(*state, object[1]);
	assert_int_equal(ops->memory_new(*state, 4, &object[2]), 0);
	ops->memory_free(*state, object[0]);
	ops->memory_free(*state, object[2]);
}

static inline void a_job_is_waited_for_once(void **state)
{
	struct gloss_status status;
	uint64_t sequence = submit_empty(*state);

	assert_int_equal(wait_for(*state, sequence, &status), 0);
	assert_int_equal(ops->wait(*state, sequence, -1, &status), -EINVAL);
	assert_int_equal(ops->wait(*state, sequence + 1, -1, &status), -EINVAL);
	run_empty(*state);
}

static inline void many_threads_wait_while_another_submits(void **state)
{
	struct waiter waiter[16];

	board_hold();
	start_waiters(*state, waiter, 8);
	board_release();
	start_waiters(*state, waiter + 8, 8);
	for (int i = 0; i < 100; i++)
		run_empty(*state);
	join_waiters(waiter, 16, 0);
}

#endif
