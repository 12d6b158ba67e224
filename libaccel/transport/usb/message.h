/* SPDX-License-Identifier: MIT */
/*
 * The words that a board on USB sends on IN: a parser, and nothing of USB. It takes any words, in
 * pieces of any size, and finds whatever is not as rtl/INTERFACE.md says; of a response it never
 * writes more than there is room for.
 */
#ifndef ACCEL_USB_MESSAGE_H
#define ACCEL_USB_MESSAGE_H

#include <stdbool.h>
#include <stddef.h>

#include "job.h"

/* A job as its answer has to fit it, and what it answered. */
struct accel_usb_answer {
	uint32_t sequence;
	uint32_t stream_words;
	uint32_t *response; /* room for response_words */
	uint32_t response_words;
	struct gloss_status status; /* valid once its completion was there */
};

/* What the words were, up to where the parser stopped. */
enum accel_usb_message {
	ACCEL_USB_MORE,       /* all were taken, and there is nothing to tell */
	ACCEL_USB_SYNC,       /* the sync looked for */
	ACCEL_USB_COMPLETION, /* the job's last word */
	ACCEL_USB_GARBLED     /* a word that can not be there: start again */
};

enum accel_usb_parser_state {
	ACCEL_USB_PARSER_SEARCH, /* for the sync: other words are dropped */
	ACCEL_USB_PARSER_HEADER,
	ACCEL_USB_PARSER_CHUNK,
	ACCEL_USB_PARSER_COMPLETION,
	ACCEL_USB_PARSER_GARBLED
};

struct accel_usb_parser {
	enum accel_usb_parser_state state;
	uint32_t nonce;
	/* The last ones of a search, the first of a completion. */
	uint32_t word[GLOSS_USB_COMPLETION_WORDS];
	unsigned int words; /* in there, of a completion */
	uint32_t answered;  /* response words of the job, with the chunk under way */
	uint32_t chunk;     /* words of it yet to come */
	uint32_t checksum;  /* of the response words that have come */
	bool last;          /* after a chunk that is not full there is no other */
};

/* Looks for the sync with @nonce. */
void accel_usb_message_start(struct accel_usb_parser *parser, uint32_t nonce);

/*
 * Takes words from *@words on, of which there are *@count, and steps both past those taken.
 * @answer is that of the job whose turn it is, the same until its completion; NULL: none, so
 * that any word is garbled. After ACCEL_USB_GARBLED that is the answer to all.
 */
enum accel_usb_message accel_usb_message_take(struct accel_usb_parser *parser,
					      struct accel_usb_answer *answer,
					      const uint32_t **words, size_t *count);

#endif
