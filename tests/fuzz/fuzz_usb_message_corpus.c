// SPDX-License-Identifier: MIT
/*
 * Writes what a board may answer to jobs, some of it damaged, as inputs of fuzz_usb_message to
 * start from: fuzz_usb_message_corpus DIRECTORY SEED COUNT.
 */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "fuzz_usb_message_input.h"
#include "gloss_packets.h"
#include "gloss_regs.h"
#include "transport/usb/checksum.h"

#define WORDS_MAX 4096u

struct input {
	uint8_t head[FUZZ_MESSAGE_HEAD_BYTES];
	uint32_t word[WORDS_MAX];
	uint32_t count;
};

/* splitmix64 */
static uint32_t below(uint64_t *seed, uint32_t limit)
{
	uint64_t z = *seed += 0x9e3779b97f4a7c15;

	z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
	z = (z ^ z >> 27) * 0x94d049bb133111eb;
	return (uint32_t)((z ^ z >> 31) % limit);
}

static void put_sync(struct input *input, uint64_t *seed)
{
	while (below(seed, 2))
		input->word[input->count++] = below(seed, 1000);
	gloss_usb_sync_pack(input->word + input->count,
			    &(struct gloss_usb_sync){ .mark = GLOSS_USB_SYNC_MAGIC,
						      .nonce = FUZZ_MESSAGE_NONCE,
						      .nonce_complement = ~FUZZ_MESSAGE_NONCE,
						      .mark_complement = ~GLOSS_USB_SYNC_MAGIC });
	input->count += GLOSS_USB_SYNC_WORDS;
}

/* Returns the checksum with its words. */
static uint32_t put_chunk(struct input *input, uint32_t count, uint32_t sum)
{
	const uint32_t *words = input->word + input->count + GLOSS_USB_RESPONSE_WORDS;

	gloss_usb_response_pack(input->word + input->count,
				&(struct gloss_usb_response){ .count = count,
							      .mark = GLOSS_USB_RESPONSE_MAGIC });
	input->count += GLOSS_USB_RESPONSE_WORDS;
	for (uint32_t n = 0; n < count; n++)
		input->word[input->count++] = n;
	return accel_usb_checksum(sum, words, count);
}

static void put_completion(struct input *input, const struct gloss_usb_completion *completion,
			   uint32_t sum)
{
	uint32_t *words = input->word + input->count;

	gloss_usb_completion_pack(words, completion);
	words[GLOSS_USB_COMPLETION_CHECKSUM_WORD] = accel_usb_checksum(
		sum, words, GLOSS_USB_COMPLETION_CHECKSUM_WORD);
	input->count += GLOSS_USB_COMPLETION_WORDS;
}

static void put_job(struct input *input, uint32_t job, uint64_t *seed)
{
	uint8_t room = (uint8_t)below(seed, below(seed, 3) ? 16 : 256);
	uint32_t words = below(seed, FUZZ_MESSAGE_ROOM * room + 1u), left = words;
	bool fault = below(seed, 4) == 0;
	uint32_t sum = 0;

	input->head[1 + job] = room;
	for (; left > GLOSS_USB_CHUNK_WORDS; left -= GLOSS_USB_CHUNK_WORDS)
		sum = put_chunk(input, GLOSS_USB_CHUNK_WORDS, sum);
	if (left)
		sum = put_chunk(input, left, sum);
	put_completion(input,
		       &(struct gloss_usb_completion){
			       .cause = fault ? GLOSS_FAULT_SLOT : GLOSS_FAULT_NONE,
			       .mark = GLOSS_USB_COMPLETION_MAGIC,
			       .sequence = job,
			       .offset = fault ? below(seed, FUZZ_MESSAGE_STREAM_WORDS) :
						 FUZZ_MESSAGE_STREAM_WORDS,
			       .response_words = words },
		       sum);
}

static int write_input(const struct input *input, const char *path)
{
	FILE *file = fopen(path, "wb");
	int error;

	if (!file)
		return -1;
	fwrite(input->head, 1, sizeof(input->head), file);
	fwrite(input->word, 4, input->count, file);
	error = ferror(file);
	return fclose(file) || error ? -1 : 0;
}

int main(int argc, char **argv)
{
	char path[4096];
	uint64_t seed;

	if (argc != 4) {
		fprintf(stderr, "usage: fuzz_usb_message_corpus DIRECTORY SEED COUNT\n");
		return 2;
	}
	seed = strtoull(argv[2], NULL, 0);
	for (int left = atoi(argv[3]); left > 0; left--) {
		struct input input = { .count = 0 };

		input.head[0] = (uint8_t)below(&seed, 256);
		input.head[1 + FUZZ_MESSAGE_JOBS] = (uint8_t)(left % 4 ? 0 : below(&seed, 16));
		put_sync(&input, &seed);
		for (uint32_t job = 0; job < FUZZ_MESSAGE_JOBS; job++)
			put_job(&input, job, &seed);
		if (left % 8 == 0)
			put_chunk(&input, 1, 0);
		if (left % 2)
			input.word[below(&seed, input.count)] ^= 1u << below(&seed, 32);
		snprintf(path, sizeof(path), "%s/%d", argv[1], left);
		if (write_input(&input, path)) {
			perror(path);
			return 1;
		}
	}
	return 0;
}
