/* SPDX-License-Identifier: MIT */
/* A conversation with a board on USB, made of random answers, and a parser that hears it. */
#ifndef USB_TALK_H
#define USB_TALK_H

#include "accel_test.h"
#include "transport/usb/checksum.h"
#include "transport/usb/message.h"

#define JOBS 6
#define ROOM 1400u
#define WORDS_MAX 8192
#define NONCE 0x1234567u
#define GUARD 0x5a5a5a5au
#define CHECKED (GLOSS_USB_COMPLETION_WORDS - 1) /* words of a completion */

/* A job, and what its answer ought to be. */
struct job {
	struct accel_usb_answer answer;
	struct gloss_status status;
	uint32_t response[ROOM + 1]; /* a guard behind it */
	uint32_t expected[ROOM];
};

/* All that a board says from a reset on. */
struct talk {
	struct job job[JOBS];
	unsigned int jobs;
	uint32_t word[WORDS_MAX];
	size_t words;
};

static struct talk talk;

/* ---- making a conversation ---- */

static inline void say(uint32_t word)
{
	assert_true(talk.words < WORDS_MAX);
	talk.word[talk.words++] = word;
}

static inline void say_sync(uint32_t nonce)
{
	say(GLOSS_USB_SYNC_MAGIC);
	say(nonce);
	say(~nonce);
	say(~GLOSS_USB_SYNC_MAGIC);
}

static inline void say_response(const struct job *job, uint32_t count)
{
	uint32_t done = 0;

	while (done < count) {
		uint32_t now = count - done < GLOSS_USB_CHUNK_WORDS ? count - done :
								      GLOSS_USB_CHUNK_WORDS;

		say(GLOSS_USB_RESPONSE_MAGIC << 16 | now);
		while (now--)
			say(job->expected[done++]);
	}
}

static inline void say_completion(const struct job *job)
{
	uint32_t sum = accel_usb_checksum(0, job->expected, job->status.response_words);

	say(GLOSS_USB_COMPLETION_MAGIC << 16 | job->status.cause);
	say(job->answer.sequence);
	say(job->status.offset);
	say(job->status.response_words);
	say(accel_usb_checksum(sum, talk.word + talk.words - CHECKED, CHECKED));
}

/* Sizes around a chunk's are likely. */
static inline uint32_t any_count(uint64_t *seed, uint32_t room)
{
	static const uint32_t counts[] = { 0, 1, 255, 256, 257, 511, 512, 513 };
	uint32_t count = test_below(seed, 2) ? counts[test_below(seed, 8)] :
					       test_below(seed, ROOM + 1);

	return count > room ? room : count;
}

static inline void say_job(uint64_t *seed)
{
	struct job *job = &talk.job[talk.jobs++];
	uint32_t room = test_below(seed, 3) ? ROOM : any_count(seed, ROOM);
	uint32_t words = test_below(seed, 100000);
	uint32_t cause = test_below(seed, 2) ? test_below(seed, GLOSS_FAULT_MEMORY + 1) : 0;

	*job = (struct job){ .answer = { .sequence = (uint32_t)test_random(seed),
					 .stream_words = words,
					 .response = job->response,
					 .response_words = room } };
	job->status = (struct gloss_status){ .cause = (enum gloss_fault)cause,
					     .offset = cause ? test_below(seed, words + 1) : words,
					     .response_words = any_count(seed, room) };
	memset(job->response, 0x5a, sizeof(job->response));
	for (uint32_t n = 0; n < ROOM; n++)
		job->expected[n] = (uint32_t)test_random(seed);
	say_response(job, job->status.response_words);
	say_completion(job);
}

static inline void make_talk(uint64_t *seed, unsigned int jobs)
{
	talk.jobs = 0;
	talk.words = 0;
	say_sync(NONCE);
	while (talk.jobs < jobs)
		say_job(seed);
}

/* ---- hearing it ---- */

struct hearing {
	struct accel_usb_parser parser;
	unsigned int syncs, jobs; /* that have come */
	bool garbled;
};

static inline void hear_start(struct hearing *hearing)
{
	*hearing = (struct hearing){ .syncs = 0 };
	accel_usb_message_start(&hearing->parser, NONCE);
	for (unsigned int n = 0; n < talk.jobs; n++)
		memset(talk.job[n].response, 0x5a, sizeof(talk.job[n].response));
}

/* The words, which are then gone: the parser may not keep where they were. */
static inline void hear(struct hearing *hearing, const uint32_t *from, size_t count)
{
	uint32_t copy[WORDS_MAX];
	const uint32_t *words = copy;

	memcpy(copy, from, count * sizeof(*from));
	while (count && !hearing->garbled) {
		struct job *job = hearing->jobs < talk.jobs ? &talk.job[hearing->jobs] : NULL;

		switch (accel_usb_message_take(&hearing->parser, job ? &job->answer : NULL, &words,
					       &count)) {
		case ACCEL_USB_SYNC:
			hearing->syncs++;
			break;
		case ACCEL_USB_COMPLETION:
			hearing->jobs++;
			break;
		case ACCEL_USB_GARBLED:
			hearing->garbled = true;
			break;
		default:
			assert_int_equal(count, 0);
		}
	}
	memset(copy, 0xa5, sizeof(copy));
}

static inline void check_job(const struct job *job)
{
	uint32_t words = job->status.response_words;

	assert_int_equal(job->answer.status.cause, job->status.cause);
	assert_int_equal(job->answer.status.offset, job->status.offset);
	assert_int_equal(job->answer.status.response_words, words);
	assert_memory_equal(job->response, job->expected, 4 * words);
	for (uint32_t n = words; n < ROOM + 1; n++)
		assert_int_equal(job->response[n], GUARD);
}

static inline void check_all(const struct hearing *hearing)
{
	assert_false(hearing->garbled);
	assert_int_equal(hearing->syncs, 1);
	assert_int_equal(hearing->jobs, talk.jobs);
	for (unsigned int n = 0; n < talk.jobs; n++)
		check_job(&talk.job[n]);
}

#endif
