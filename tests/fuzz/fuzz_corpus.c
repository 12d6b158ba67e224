// SPDX-License-Identifier: MIT
/* Writes random jobs as inputs for the fuzzer to start from: fuzz_corpus DIRECTORY SEED COUNT. */
#include <stdio.h>
#include <stdlib.h>

#include "fuzz_input.h"

#define WORDS_MAX 600 /* short ones, so that many are tried in a second */

static void put_head(const struct stream_random *r, uint8_t head[FUZZ_HEAD_BYTES])
{
	head[0] = r->tile_size == 64;
	for (int n = 0; n < 3; n++)
		head[1 + n] = (uint8_t)(r->job.response_words >> 8 * n);
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++) {
		const struct gloss_slot *slot = &r->job.slot[n];
		uint8_t *bytes = head + 4 + FUZZ_SLOT_BYTES * n;

		bytes[0] = (uint8_t)(slot->base / FUZZ_PAGE);
		bytes[1] = (uint8_t)(slot->size >> 2);
		bytes[2] = (uint8_t)(slot->size >> 10);
		bytes[3] = (uint8_t)(slot->size << 2 & 0x0c) | (uint8_t)slot->rights;
	}
}

static int write_job(const struct stream_random *r, const char *path)
{
	uint8_t head[FUZZ_HEAD_BYTES], word[4];
	FILE *file = fopen(path, "wb");
	int error;

	if (!file)
		return -1;
	put_head(r, head);
	fwrite(head, 1, sizeof(head), file);
	for (uint32_t n = 0; n < r->job.stream_words; n++) {
		for (int byte = 0; byte < 4; byte++)
			word[byte] = (uint8_t)(r->words[n] >> 8 * byte);
		fwrite(word, 1, sizeof(word), file);
	}
	error = ferror(file);
	return fclose(file) || error ? -1 : 0;
}

int main(int argc, char **argv)
{
	static struct stream_random r;
	uint64_t seed;
	char path[4096];

	if (argc != 4) {
		fprintf(stderr, "usage: fuzz_corpus DIRECTORY SEED COUNT\n");
		return 2;
	}
	seed = strtoull(argv[2], NULL, 0);
	for (int left = atoi(argv[3]); left > 0; seed++) {
		stream_random_valid(&r, seed, seed % 2 ? 32 : 64);
		if (r.job.stream_words > WORDS_MAX)
			continue;
		if (left-- % 4 == 0)
			stream_random_damage(&r);
		snprintf(path, sizeof(path), "%s/%llu", argv[1], (unsigned long long)seed);
		if (write_job(&r, path)) {
			perror(path);
			return 1;
		}
	}
	return 0;
}
