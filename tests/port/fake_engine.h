/* SPDX-License-Identifier: MIT */
/* An engine for the model of a port that does what a test tells it. */
#ifndef TESTS_FAKE_ENGINE_H
#define TESTS_FAKE_ENGINE_H

#include "vboard/port/base.h"

#define FAKE_STREAM_MAX 8192

/* Takes @bite words a step and answers @answers for each step, until the job has no more room. */
struct fake_engine {
	uint32_t bite, answers;
	enum gloss_fault cause;
	bool refuses;

	struct accel_job job;
	uint32_t begun, ended;
	uint32_t stream[FAKE_STREAM_MAX];
	uint32_t taken, answered;
	bool window_short; /* was ever shorter than it may be */
};

/* @fake with a bite of 1. */
struct port_engine fake_engine_init(struct fake_engine *fake);

/* FAKE_STREAM_MAX words for a stream, no two the same. */
const uint32_t *fake_engine_words(void);
/* Word @n of what it answers. */
static inline uint32_t fake_engine_answer(uint32_t n)
{
	return 0xa0000000 + n;
}

#endif
