/* SPDX-License-Identifier: MIT */
/* Threads that share a device: nothing of one's may show in another's buffer. */
#ifndef SHARE_TEST_H
#define SHARE_TEST_H

#include <pthread.h>
#include <string.h>

#include "accel_test.h"

#define SHARE_THREADS 4

/* NULL, or what was wrong. */
static inline void *share_device(void *data)
{
	struct accel_device *device = data;
	struct accel_buffer *buffer;
	uint64_t seed = (uint64_t)(uintptr_t)&buffer;
	uint32_t words[64], back[64];

	for (int round = 0; round < 100; round++) {
		if (accel_buffer_new(device, sizeof(words), &buffer))
			return "no buffer";
		if (accel_buffer_read(buffer, 0, back, sizeof(back)))
			return "no read";
		for (int i = 0; i < 64; i++) {
			words[i] = (uint32_t)test_random(&seed);
			if (back[i])
				return "a new buffer is not zero";
		}
		if (accel_buffer_write(buffer, 0, words, sizeof(words)) ||
		    accel_buffer_read(buffer, 0, back, sizeof(back)))
			return "no copy";
		if (memcmp(words, back, sizeof(words)) != 0)
			return "another's words";
		accel_buffer_free(buffer);
	}
	return NULL;
}

/* Runs a function that says what was wrong in several threads. */
static inline void share_run(void *(*function)(void *), void *data)
{
	pthread_t thread[SHARE_THREADS];
	void *wrong;

	for (int i = 0; i < SHARE_THREADS; i++)
		assert_int_equal(pthread_create(&thread[i], NULL, function, data), 0);
	for (int i = 0; i < SHARE_THREADS; i++) {
		pthread_join(thread[i], &wrong);
		if (wrong)
			fail_msg("%s", (const char *)wrong);
	}
}

static inline void share_check(const char *name)
{
	struct messages messages;
	struct accel_device *device = device_open(name, &messages);

	share_run(share_device, device);
	accel_device_free(device);
	assert_int_equal(messages.count, 0);
}

#endif
