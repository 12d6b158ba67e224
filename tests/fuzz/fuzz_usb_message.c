// SPDX-License-Identifier: MIT
/*
 * Any words from a board, in any pieces, to the library's parser of them, for libFuzzer. It must
 * stay in the response, which AddressSanitizer watches, and find what INTERFACE.md says, whatever
 * the pieces are.
 */
#include <stdlib.h>
#include <string.h>

#include "fuzz_usb_message_input.h"
#include "transport/usb/message.h"

#define JOBS FUZZ_MESSAGE_JOBS

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* What came of the words. */
struct outcome {
	struct accel_usb_answer answer[JOBS];
	unsigned int ended, syncs;
	bool garbled;
	uint8_t checksums; /* of the input: bit n is set: job n's is not set right */
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
			.sequence = n,
			.stream_words = FUZZ_MESSAGE_STREAM_WORDS,
			.response = memory(4 * (size_t)FUZZ_MESSAGE_ROOM * room[n]),
			.response_words = FUZZ_MESSAGE_ROOM * room[n],
		};
}

static enum accel_usb_message take(struct accel_usb_parser *parser, struct outcome *outcome,
				   const uint32_t **words, size_t *count)
{
	struct accel_usb_answer *answer = outcome->ended < JOBS ? &outcome->answer[outcome->ended] :
								  NULL;
	size_t before = *count;
	const uint32_t *from = *words;
	enum accel_usb_message message = accel_usb_message_take(parser, answer, words, count);

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

	accel_usb_message_start(&parser, FUZZ_MESSAGE_NONCE);
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

/* ---- the same, by who has all the words at once ---- */

/* Where the words after the sync begin; 0: there is none. */
static size_t find_sync(const uint32_t *words, size_t count)
{
	for (size_t n = 4; n <= count; n++)
		if (words[n - 4] == GLOSS_USB_SYNC_MAGIC && words[n - 3] == FUZZ_MESSAGE_NONCE &&
		    words[n - 2] == ~FUZZ_MESSAGE_NONCE && words[n - 1] == ~GLOSS_USB_SYNC_MAGIC)
			return n;
	return 0;
}

static uint32_t checksum(uint32_t sum, const uint32_t *words, uint32_t count)
{
	while (count--) {
		sum = (uint32_t)(((uint64_t)sum << 32 | sum) >> 31);
		sum += *words++;
	}
	return sum;
}

/* Makes the checksum right, unless the input says otherwise. */
static bool is_checked(const struct outcome *outcome, const struct accel_usb_answer *answer,
		       uint32_t *words, uint32_t answered)
{
	uint32_t right = checksum(checksum(0, answer->response, answered), words, 4);

	if (!(outcome->checksums >> outcome->ended & 1))
		words[4] = right;
	return words[4] == right;
}

static bool is_completion(const struct accel_usb_answer *answer, const uint32_t *words,
			  uint32_t answered)
{
	uint32_t cause = words[0] & 0xffff;

	return cause <= GLOSS_FAULT_MEMORY && words[1] == answer->sequence &&
	       (cause ? words[2] <= answer->stream_words : words[2] == answer->stream_words) &&
	       words[3] == answered;
}

/* Reads job @outcome->ended; how many words it has, 0 if it does not end in these. */
static size_t read_answer(struct outcome *outcome, uint32_t *words, size_t count)
{
	struct accel_usb_answer *answer = &outcome->answer[outcome->ended];
	uint32_t answered = 0, chunk = GLOSS_USB_CHUNK_WORDS;
	size_t at = 0;

	for (; at < count && words[at] >> 16 == GLOSS_USB_RESPONSE_MAGIC; at += 1 + chunk) {
		bool first_or_full = chunk == GLOSS_USB_CHUNK_WORDS;

		chunk = words[at] & 0xffff;
		outcome->garbled = !first_or_full || !chunk || chunk > GLOSS_USB_CHUNK_WORDS ||
				   chunk > answer->response_words - answered;
		if (outcome->garbled || count - at - 1 < chunk)
			return 0;
		memcpy(answer->response + answered, words + at + 1, 4 * (size_t)chunk);
		answered += chunk;
	}
	if (at == count)
		return 0;
	outcome->garbled = words[at] >> 4 != GLOSS_USB_COMPLETION_MAGIC << 12;
	if (outcome->garbled || count - at < GLOSS_USB_COMPLETION_WORDS)
		return 0;
	outcome->garbled = !is_checked(outcome, answer, words + at, answered) ||
			   !is_completion(answer, words + at, answered);
	answer->status = (struct gloss_status){ (enum gloss_fault)(words[at] & 15), words[at + 2],
						answered };
	return outcome->garbled ? 0 : at + GLOSS_USB_COMPLETION_WORDS;
}

static void expect(struct outcome *outcome, uint32_t *words, size_t count)
{
	size_t at = find_sync(words, count), job = 1;

	outcome->syncs = at != 0;
	while (at && at < count && job && outcome->ended < JOBS) {
		job = read_answer(outcome, words + at, count - at);
		at += job;
		outcome->ended += job != 0;
	}
	if (at && at < count && outcome->ended == JOBS)
		outcome->garbled = true;
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
	struct outcome whole, pieces, expected;
	uint32_t *words;
	size_t count;

	if (size < FUZZ_MESSAGE_HEAD_BYTES)
		return 0;
	count = (size - FUZZ_MESSAGE_HEAD_BYTES) / 4;
	words = memory(4 * count);
	memcpy(words, data + FUZZ_MESSAGE_HEAD_BYTES, 4 * count);
	outcome_init(&whole, data + 1);
	outcome_init(&pieces, data + 1);
	outcome_init(&expected, data + 1);
	expected.checksums = data[1 + JOBS];
	expect(&expected, words, count);
	run(&whole, words, count, count);
	run(&pieces, words, count, 1u + data[0]);
	check_same(&expected, &whole);
	check_same(&expected, &pieces);
	outcome_free(&whole);
	outcome_free(&pieces);
	outcome_free(&expected);
	free(words);
	return 0;
}
