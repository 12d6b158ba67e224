// SPDX-License-Identifier: MIT
#include <string.h>

#include "transport/usb/checksum.h"
#include "transport/usb/message.h"

/* Bits of a completion's first word that are zero. */
#define COMPLETION_ZERO 0x0000fff0u
/* Words of it that its checksum is of. */
#define COMPLETION_CHECKED (GLOSS_USB_COMPLETION_WORDS - 1)

void accel_usb_message_start(struct accel_usb_parser *parser, uint32_t nonce)
{
	*parser = (struct accel_usb_parser){ .state = ACCEL_USB_PARSER_SEARCH, .nonce = nonce };
}

static enum accel_usb_message parser_garbled(struct accel_usb_parser *parser)
{
	parser->state = ACCEL_USB_PARSER_GARBLED;
	return ACCEL_USB_GARBLED;
}

/* ---- the sync ---- */

static enum accel_usb_message parser_search(struct accel_usb_parser *parser, uint32_t word)
{
	struct gloss_usb_sync sync;

	memmove(parser->word, parser->word + 1, (GLOSS_USB_SYNC_WORDS - 1) * sizeof(word));
	parser->word[GLOSS_USB_SYNC_WORDS - 1] = word;
	gloss_usb_sync_unpack(parser->word, &sync);
	if (sync.mark != GLOSS_USB_SYNC_MAGIC || sync.mark_complement != ~sync.mark ||
	    sync.nonce != parser->nonce || sync.nonce_complement != ~sync.nonce)
		return ACCEL_USB_MORE;
	parser->state = ACCEL_USB_PARSER_HEADER;
	return ACCEL_USB_SYNC;
}

/* ---- a job's answer ---- */

static enum accel_usb_message parser_chunk_begin(struct accel_usb_parser *parser,
						 const struct accel_usb_answer *answer,
						 uint32_t count)
{
	if (!count || count > GLOSS_USB_CHUNK_WORDS || parser->last ||
	    count > answer->response_words - parser->answered)
		return parser_garbled(parser);
	parser->state = ACCEL_USB_PARSER_CHUNK;
	parser->answered += count;
	parser->chunk = count;
	parser->last = count < GLOSS_USB_CHUNK_WORDS;
	return ACCEL_USB_MORE;
}

static enum accel_usb_message parser_header(struct accel_usb_parser *parser,
					    const struct accel_usb_answer *answer, uint32_t word)
{
	struct gloss_usb_response response;

	gloss_usb_response_unpack(&word, &response);
	if (response.mark == GLOSS_USB_RESPONSE_MAGIC)
		return parser_chunk_begin(parser, answer, response.count);
	if (response.mark != GLOSS_USB_COMPLETION_MAGIC || word & COMPLETION_ZERO)
		return parser_garbled(parser);
	parser->state = ACCEL_USB_PARSER_COMPLETION;
	parser->word[0] = word;
	parser->words = 1;
	return ACCEL_USB_MORE;
}

/* Returns how many of the @count words are the chunk's. */
static size_t parser_chunk(struct accel_usb_parser *parser, const struct accel_usb_answer *answer,
			   const uint32_t *words, size_t count)
{
	if (count > parser->chunk)
		count = parser->chunk;
	memcpy(answer->response + parser->answered - parser->chunk, words, count * sizeof(*words));
	parser->checksum = accel_usb_checksum(parser->checksum, words, count);
	parser->chunk -= (uint32_t)count;
	if (!parser->chunk)
		parser->state = ACCEL_USB_PARSER_HEADER;
	return count;
}

static bool completion_fits(const struct accel_usb_parser *parser,
			    const struct gloss_usb_completion *completion,
			    const struct accel_usb_answer *answer)
{
	return completion->checksum ==
		       accel_usb_checksum(parser->checksum, parser->word, COMPLETION_CHECKED) &&
	       completion->cause <= GLOSS_FAULT_MEMORY &&
	       completion->sequence == answer->sequence &&
	       completion->response_words == parser->answered &&
	       (completion->cause ? completion->offset <= answer->stream_words :
				    completion->offset == answer->stream_words);
}

static enum accel_usb_message parser_completion(struct accel_usb_parser *parser,
						struct accel_usb_answer *answer, uint32_t word)
{
	struct gloss_usb_completion completion;

	parser->word[parser->words++] = word;
	if (parser->words < GLOSS_USB_COMPLETION_WORDS)
		return ACCEL_USB_MORE;
	gloss_usb_completion_unpack(parser->word, &completion);
	if (!completion_fits(parser, &completion, answer))
		return parser_garbled(parser);
	answer->status = (struct gloss_status){
		.cause = completion.cause,
		.offset = completion.offset,
		.response_words = completion.response_words,
	};
	parser->state = ACCEL_USB_PARSER_HEADER;
	parser->answered = 0;
	parser->checksum = 0;
	parser->last = false;
	return ACCEL_USB_COMPLETION;
}

/* ---- any word ---- */

static enum accel_usb_message parser_word(struct accel_usb_parser *parser,
					  struct accel_usb_answer *answer, uint32_t word)
{
	if (parser->state == ACCEL_USB_PARSER_SEARCH)
		return parser_search(parser, word);
	if (!answer)
		return parser_garbled(parser);
	switch (parser->state) {
	case ACCEL_USB_PARSER_HEADER:
		return parser_header(parser, answer, word);
	case ACCEL_USB_PARSER_COMPLETION:
		return parser_completion(parser, answer, word);
	default:
		return parser_garbled(parser);
	}
}

enum accel_usb_message accel_usb_message_take(struct accel_usb_parser *parser,
					      struct accel_usb_answer *answer,
					      const uint32_t **words, size_t *count)
{
	enum accel_usb_message message = ACCEL_USB_MORE;

	while (*count && message == ACCEL_USB_MORE) {
		size_t taken = 1;

		if (parser->state == ACCEL_USB_PARSER_CHUNK && answer)
			taken = parser_chunk(parser, answer, *words, *count);
		else
			message = parser_word(parser, answer, **words);
		*words += taken;
		*count -= taken;
	}
	return message;
}
