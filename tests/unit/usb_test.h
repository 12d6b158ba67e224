/* SPDX-License-Identifier: MIT */
/* What the tests of "usb:" share: a board on the cable of fake_usb.h, and jobs on it. */
#ifndef USB_TEST_H
#define USB_TEST_H

#include <pthread.h>

#include "accel_test.h"
#include "fake_usb.h"
#include "transport.h"

static const struct accel_transport_ops *const ops = &accel_transport_usb;

static inline int usb_setup(void **state)
{
	struct accel_transport_error error = { "" };

	fake_usb_start(test_seed());
	return ops->open("", state, &error);
}

/* What the library leaves behind ends the process there. */
static inline int usb_teardown(void **state)
{
	fake_usb_release();
	ops->close(*state);
	fake_usb_stop();
	return 0;
}

#define usb_test(name) cmocka_unit_test_setup_teardown(name, usb_setup, usb_teardown)

static inline uint64_t submit(void *state, const struct accel_transport_job *job)
{
	uint64_t sequence;

	assert_int_equal(ops->submit(state, job, &sequence), 0);
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

/* The error of a job that reads @count words of an object, in slot 0. */
static inline int read_words(void *state, uint64_t object, uint32_t *words, uint32_t count)
{
	const struct accel_transport_slot slot = { object, GLOSS_RIGHTS_READ };
	uint32_t stream[3];
	const struct accel_transport_job job = {
		.stream = stream, .stream_words = (uint32_t)packet_read(stream, 0, 0, count),
		.response = words, .response_words = count, .slot = &slot, .slots = 1,
	};
	struct gloss_status status;
	int err = wait_for(state, submit(state, &job), &status);

	assert_int_equal(status.response_words, err ? 0 : count);
	return err;
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
						&waiter[i]), 0);
	}
}

static inline void join_waiters(struct waiter *waiter, int count, int err)
{
	for (int i = 0; i < count; i++) {
		pthread_join(waiter[i].thread, NULL);
		assert_int_equal(waiter[i].err, err);
	}
}

#endif
