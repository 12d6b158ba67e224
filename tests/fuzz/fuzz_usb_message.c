// SPDX-License-Identifier: MIT
/*
 * Any words from a board, in any pieces, to the library's parser of them, for libFuzzer. It must
 * stay in the response, which AddressSanitizer watches, and find the same whatever the pieces are.
 */
#include <stdlib.h>
#include <string.h>

#include "fuzz_usb_message_input.h"
#include "usb_message.h"

#define JOBS FUZZ_MESSAGE_JOBS

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* What came of the words. */
struct outcome {
	struct accel_usb_answer answer[JOBS];
	unsigned int ended, syncs;
	bool garbled;
};

static void check(bool condition)
{
	if (!condition)
		abort();
}

static void *memory(size_t bytes)
{
	void *block = calloc(1, bytes ? bytes : 1);

	check(block);
	return block;
}

static void outcome_init(struct outcome *outcome, const uint8_t *room)
{
	*outcome = (struct outcome){ .ended = 0 };
	for (uint32_t n = 0; n < JOBS; n++)
		outcome->answer[n] = (struct accel_usb_answer){
			.sequence = n, .stream_words = FUZZ_MESSAGE_STREAM_WORDS,
			.response = memory(4 * (size_t)FUZZ_MESSAGE_ROOM * room[n]),
			.response_words = FUZZ_MESSAGE_ROOM * room[n],
		};
}

static enum accel_usb_message take(struct accel_usb_parser *parser, struct outcome *outcome,
				   const uint32_t **words, size_t *count)
{
	struct accel_usb_answer *answer =
		outcome->ended < JOBS ? &outcome->answer[outcome->ended] : NULL;
	size_t before = *count;
	const uint32_t *from = *words;
	enum accel_usb_message message = accel_usb_parser_take(parser, answer, words, count);

	check(*count <= before && *words == from + (before - *count));
	check(message != ACCEL_USB_MORE || !*count);
	if (message == ACCEL_USB_COMPLETION)
		check(answer && answer->status.response_words <= answer->response_words &&
		      answer->status.offset <= answer->stream_words);
	return message;
}

static void run(struct outcome *outcome, const uint32_t *words, size_t count, size_t piece)
{
	struct accel_usb_parser parser;

	accel_usb_parser_start(&parser, FUZZ_MESSAGE_NONCE);
	while (count && !outcome->garbled) {
		size_t now = count < piece ? count : piece, left = now;
		const uint32_t *at = words;

		while (left && !outcome->garbled) {
			enum accel_usb_message message = take(&parser, outcome, &at, &left);

			outcome->ended += message == ACCEL_USB_COMPLETION;
			outcome->syncs += message == ACCEL_USB_SYNC;
			outcome->garbled = message == ACCEL_USB_GARBLED;
		}
		words += now;
		count -= now;
	}
	check(outcome->syncs <= 1);
}

static void check_same(const struct outcome *a, const struct outcome *b)
{
	check(a->ended == b->ended && a->syncs == b->syncs && a->garbled == b->garbled);
	for (unsigned int n = 0; n < a->ended; n++) {
		check(!memcmp(&a->answer[n].status, &b->answer[n].status,
			      sizeof(a->answer[n].status)));
		check(!memcmp(a->answer[n].response, b->answer[n].response,
			      4 * (size_t)a->answer[n].status.response_words));
	}
}

static void outcome_free(struct outcome *outcome)
{
	for (unsigned int n = 0; n < JOBS; n++)
		free(outcome->answer[n].response);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct outcome whole, pieces;
	uint32_t *words;
	size_t count;

	if (size < FUZZ_MESSAGE_HEAD_BYTES)
		return 0;
	count = (size - FUZZ_MESSAGE_HEAD_BYTES) / 4;
	words = memory(4 * count);
	memcpy(words, data + FUZZ_MESSAGE_HEAD_BYTES, 4 * count);
	outcome_init(&whole, data + 1);
	outcome_init(&pieces, data + 1);
	run(&whole, words, count, count);
	run(&pieces, words, count, 1u + data[0]);
	check_same(&whole, &pieces);
	outcome_free(&whole);
	outcome_free(&pieces);
	free(words);
	return 0;
}
