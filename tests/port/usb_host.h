/* SPDX-License-Identifier: MIT */
/*
 * A host with a USB board at its bridge, for tests: it sends the words of OUT that it is
 * told to, in pieces, keeps all that comes on IN and all events, and can tell the one from
 * the other.
 */
#ifndef TESTS_USB_HOST_H
#define TESTS_USB_HOST_H

#include <stdbool.h>
#include <stdint.h>

#include "vboard/board/usb.h"
#include "gloss_packets.h"
#include "job.h"

struct usb_words {
	uint32_t *word;
	uint32_t count, room;
};

struct usb_host {
	const struct gloss_usb_board_ops *ops;
	struct gloss_usb_board *board;
	uint32_t offer, take; /* words of OUT and IN at a time; a take of 0: none */

	struct usb_words out;   /* to be sent */
	uint32_t sent;          /* of them */
	struct usb_words in;    /* that came */
	struct usb_words burst; /* counts of IN words at which a burst ended */
	struct usb_words event; /* two words each */

	/* What was read of IN. */
	uint32_t read, bursts_read;
	struct usb_words response; /* of the last job */
	struct gloss_usb_completion completion;
};

/* A board of @ops with @memory, unsynchronised. False: out of memory. */
bool usb_host_init(struct usb_host *host, const struct gloss_usb_board_ops *ops, void *memory,
		   uint64_t size);
void usb_host_fini(struct usb_host *host);

void usb_words_add(struct usb_words *words, const uint32_t *word, uint32_t count);

/* ---- what is to be sent ---- */

void usb_host_sync(struct usb_host *host, uint32_t nonce);
/* A job with its first @slots slots. */
void usb_host_job(struct usb_host *host, const struct accel_job *job, uint32_t slots,
		  uint32_t sequence);

/* ---- what happens ---- */

/* Offers and takes a piece each and lets the board work. False: none of that moved anything. */
bool usb_host_step(struct usb_host *host);
/* Until nothing moves. False: that takes for ever. */
bool usb_host_run(struct usb_host *host);
/* Resets the board and writes NONCE; forgets what was to be sent and what came. False: as above. */
bool usb_host_reset(struct usb_host *host, uint32_t nonce);

uint32_t usb_host_read(struct usb_host *host, uint32_t offset);
void usb_host_write(struct usb_host *host, uint32_t offset, uint32_t value);

/* ---- what came ---- */

/* Is the echo of a usb_sync the next thing on IN? */
bool usb_host_echo(struct usb_host *host, uint32_t nonce);
/* Is a job's answer, right in all its chunks, the next thing? To response and completion. */
bool usb_host_answer(struct usb_host *host);
/* Was everything read? */
bool usb_host_empty(const struct usb_host *host);

#endif
