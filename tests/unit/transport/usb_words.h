/* SPDX-License-Identifier: MIT */
/* An object in a board's memory whose words are known. */
#ifndef USB_WORDS_H
#define USB_WORDS_H

#include "usb_test.h"

#define WORDS 3000u

static inline void write_words(void *state, uint64_t object)
{
	const struct accel_transport_slot slot = { object, GLOSS_RIGHTS_WRITE };
	uint32_t stream[3 + 1000];
	const struct accel_transport_job job = {
		.stream = stream, .stream_words = 3 + 1000, .slot = &slot, .slots = 1
	};
	struct gloss_status status;

	for (uint32_t at = 0; at < WORDS; at += 1000) {
		const struct gloss_write_memory write = { .slot = 0, .offset = 4 * at };

		gloss_write_memory_pack(stream, &write, 2 + 1000);
		for (uint32_t i = 0; i < 1000; i++)
			stream[3 + i] = at + i + 1;
		run(state, &job, &status);
		assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	}
}

static inline uint64_t object_with_words(void *state)
{
	uint64_t object;

	assert_int_equal(ops->memory_new(state, 4 * WORDS, &object), 0);
	write_words(state, object);
	return object;
}

static inline void assert_words(void *state, uint64_t object)
{
	uint32_t words[WORDS];

	assert_int_equal(read_words(state, object, words, WORDS), 0);
	for (uint32_t i = 0; i < WORDS; i++)
		assert_int_equal(words[i], i + 1);
}

#endif
