// SPDX-License-Identifier: MIT
#include "usb_jobs.h"

#include <string.h>

#include "transport/usb/checksum.h"

/* ---- words of OUT ---- */

void usb_jobs_add_words(struct usb_test *test, const uint32_t *words, uint32_t count)
{
	for (uint32_t side = 0; side < 2; side++)
		usb_words_add(&test->host[side].out, words, count);
}

static void flip(struct usb_test *test, uint32_t word)
{
	uint32_t bit = 1u << below(test, 32);

	for (uint32_t side = 0; side < 2; side++)
		test->host[side].out.word[word] ^= bit;
}

/* Where job @n ends. */
static uint32_t tail(const struct usb_test *test, uint32_t n)
{
	return (n + 1 < test->jobs ? test->head[n + 1] : test->host[0].out.count) - 1;
}

/* Another length, room or sequence, and the checksum that goes with it. */
static void change_head(struct usb_test *test, uint32_t n)
{
	uint32_t from = test->head[n] + GLOSS_USB_JOB_STREAM_WORDS_WORD;

	flip(test, test->head[n] + 1 + below(test, 3));
	for (uint32_t side = 0; side < 2; side++) {
		uint32_t *out = test->host[side].out.word;

		out[tail(test, n)] = accel_usb_checksum(0, out + from, tail(test, n) - from);
	}
}

static void make_job(struct usb_test *test, uint32_t n)
{
	const struct accel_job *job = &test->pair.stream.job;
	uint32_t slots = GLOSS_SLOTS;

	pair_make_job(&test->pair, test->ops[0]->tile_size);
	/* Slots that are not sent are empty. */
	while (slots && !job->slot[slots - 1].size)
		slots--;
	if (below(test, 8) == 0)
		slots = below(test, slots + 1);
	memset(test->slot[n], 0, sizeof(test->slot[n]));
	memcpy(test->slot[n], job->slot, slots * sizeof(job->slot[0]));
	test->head[n] = test->host[0].out.count;
	for (uint32_t side = 0; side < 2; side++)
		usb_host_job(&test->host[side], job, slots, test->sequence);
	test->sequence += 1 + below(test, 0x10000000);
}

static uint32_t lost_word(struct usb_test *test)
{
	uint32_t word = GLOSS_USB_JOB_MAGIC << 8 | below(test, GLOSS_SLOTS + 1);

	if (below(test, 4) == 0)
		return GLOSS_USB_SYNC_MAGIC;
	if (below(test, 4) == 0)
		return (word & ~GLOSS_USB_JOB_SLOTS) | (GLOSS_SLOTS + 1 + below(test, 15));
	return word ^ 1u << (5 + below(test, 27));
}

void usb_jobs_make(struct usb_test *test, enum kind kind)
{
	uint32_t jobs = 1 + below(test, kind == LOST ? JOBS - 1 : JOBS);
	uint32_t words, word;

	for (test->jobs = 0; test->jobs < jobs; test->jobs++)
		make_job(test, test->jobs);
	words = test->host[0].out.count - test->head[0];
	if (kind == LOST) {
		word = lost_word(test);
		usb_jobs_add_words(test, &word, 1);
		make_job(test, jobs);
	}
	if (kind == HEAD)
		change_head(test, below(test, jobs));
	if (kind == CHECKSUM)
		flip(test, tail(test, below(test, jobs)));
	if (kind == WILD)
		flip(test, test->head[0] + below(test, words));
	if (kind == TORN) {
		words = below(test, words);
		for (uint32_t side = 0; side < 2; side++)
			test->host[side].out.count = test->head[0] + words;
	}
}

/* ---- what happens to them ---- */

/* Small pieces are for short batches: each is a step of a simulator. */
static uint32_t piece(struct usb_test *test, uint32_t words)
{
	uint32_t least = words / 2000;

	return least + (1u << below(test, 14));
}

static void pace(struct usb_test *test, struct usb_host *host)
{
	host->offer = piece(test, host->out.count - host->sent);
	host->take = piece(test, STREAM_RANDOM_RESPONSE / 4);
}

int usb_jobs_run(struct usb_test *test, enum kind kind, uint32_t side)
{
	struct usb_host *host = &test->host[side];
	uint32_t steps = below(test, 30);

	pace(test, host);
	if (kind == FULL)
		host->take = 0;
	if (kind == FULL || kind == RESET)
		while (steps && usb_host_step(host))
			steps--;
	if (kind == FULL)
		pace(test, host);
	if (kind != RESET && !usb_host_run(host))
		return differ(test, "board %u does not come to rest", side);
	if (kind != RESET && host->sent != host->out.count)
		return differ(test, "board %u does not take word %u of OUT", side, host->sent);
	return 0;
}
