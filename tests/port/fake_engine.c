// SPDX-License-Identifier: MIT
#include "fake_engine.h"

static bool fake_begin(void *data, const struct accel_job *job)
{
	struct fake_engine *fake = data;

	fake->job = *job;
	fake->taken = 0;
	fake->answered = 0;
	fake->begun++;
	return !fake->refuses;
}

static void fake_step(void *data, struct port_step *step)
{
	struct fake_engine *fake = data;
	uint32_t left = fake->job.stream_words - fake->taken;
	uint32_t room = fake->job.response_words - fake->answered;

	fake->window_short |= step->count < left &&
			      step->count <= gloss_header_length(step->words[0]);
	step->taken = fake->bite < step->count ? fake->bite : step->count;
	for (uint32_t n = 0; n < step->taken; n++)
		fake->stream[(fake->taken + n) % FAKE_STREAM_MAX] = step->words[n];
	fake->taken += step->taken;
	step->answered = fake->answers < room ? fake->answers : room;
	for (uint32_t n = 0; n < step->answered; n++)
		step->answer[n] = fake_engine_answer(fake->answered + n);
	fake->answered += step->answered;
}

static void fake_end(void *data, struct gloss_status *status)
{
	struct fake_engine *fake = data;

	fake->ended++;
	*status = (struct gloss_status){ fake->cause, fake->taken, fake->answered };
}

struct port_engine fake_engine_init(struct fake_engine *fake)
{
	*fake = (struct fake_engine){ .bite = 1 };
	return (struct port_engine){ fake, fake_begin, fake_step, fake_end };
}

const uint32_t *fake_engine_words(void)
{
	static uint32_t words[FAKE_STREAM_MAX];

	for (uint32_t n = 0; n < FAKE_STREAM_MAX; n++)
		words[n] = 0x50000000 + n;
	return words;
}
