/* SPDX-License-Identifier: MIT */
/* Batches of jobs for two boards on USB, as the words of OUT, and what happens to them. */
#ifndef TESTS_USB_JOBS_H
#define TESTS_USB_JOBS_H

#include "pair.h"
#include "usb_host.h"

#define JOBS 4 /* with a loss as many events as may wait */

/* What happens to a batch of jobs. */
enum kind {
	PLAIN,
	FULL,     /* IN is not read for a while */
	TORN,     /* the host stops at some word */
	LOST,     /* no job begins with the word behind them */
	HEAD,     /* a bit of a job's length, room or sequence is wrong */
	CHECKSUM, /* a bit of a job's checksum is wrong */
	RESET,    /* at some time, another one on each board */
	WILD,     /* a bit of anything is wrong */
	KINDS
};

struct usb_test {
	struct pair pair;                         /* first: a pair is the test */
	const struct gloss_usb_board_ops *ops[2]; /* the model's, the plugin's */
	struct usb_host host[2];
	bool synchronised;
	uint32_t nonce, sequence;
	struct usb_words stale; /* words of before the reset that come after it */

	/* The batch. */
	struct gloss_slot slot[JOBS][GLOSS_SLOTS];
	uint32_t head[JOBS]; /* where each begins in OUT */
	uint32_t jobs;

	/* A stream has stopped, and the plugin's core takes several words at once, or none. */
	bool short_of_words;

	uint64_t batches[KINDS], words;
};

static inline uint32_t below(struct usb_test *test, uint32_t n)
{
	return pair_below(&test->pair, n);
}

#define differ(test, ...) pair_differ(&(test)->pair, __VA_ARGS__)

/* Words to be sent to both boards. */
void usb_jobs_add_words(struct usb_test *test, const uint32_t *words, uint32_t count);
/* The jobs of the next batch, to be sent to both boards. */
void usb_jobs_make(struct usb_test *test, enum kind kind);
/* Sends one board what it has not got yet, in pieces of its own, or a part of it. 1: it can not. */
int usb_jobs_run(struct usb_test *test, enum kind kind, uint32_t side);

#endif
