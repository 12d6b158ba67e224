// SPDX-License-Identifier: MIT
/* Writes hostile boards for the fuzzer to start from: fuzz_usb_corpus DIRECTORY SEED COUNT. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz_usb_input.h"

#define PIECES 12

struct input {
	struct fuzz_usb_head head;
	uint8_t byte[4096];
	size_t count;
};

/* splitmix64 */
static uint32_t below(uint64_t *seed, uint32_t limit)
{
	uint64_t z = *seed += 0x9e3779b97f4a7c15;

	z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
	z = (z ^ z >> 27) * 0x94d049bb133111eb;
	return (uint32_t)((z ^ z >> 31) % limit);
}

/* Some registers are as they are, then one is not. */
static void put_register(struct input *input, uint64_t *seed)
{
	static const uint32_t values[] = { 0, 1, 0x80, 0x840, 0xffffffff };
	uint32_t value = values[below(seed, 5)];

	input->head.flags |= FUZZ_USB_REGISTERS;
	for (uint32_t left = below(seed, 10); left; left--)
		input->byte[input->count++] = 0;
	input->byte[input->count++] = 0xe0;
	for (int n = 0; n < 4; n++)
		input->byte[input->count++] = (uint8_t)(value >> 8 * n);
}

/* Most are honest in all but one thing, so that many boards open. */
static void put_head(struct input *input, uint64_t *seed)
{
	struct fuzz_usb_head *head = &input->head;

	head->flags = (uint8_t)(below(seed, 4) | below(seed, 4) << 4);
	head->flags |= below(seed, 8) ? 0 : FUZZ_USB_CHECKSUMS;
	head->jobs = (uint8_t)(1 + below(seed, 6));
	head->response = (uint8_t)below(seed, 256);
	head->interfaces = 2;
	head->endpoints = 3;
	switch (below(seed, 8)) {
	case 0:
		head->flags |= FUZZ_USB_DESCRIPTORS;
		head->endpoint[below(seed, 3)][0] = (uint8_t)below(seed, 256);
		break;
	case 1:
		put_register(input, seed);
		break;
	case 2:
		head->texts = (uint8_t)below(seed, 16);
		break;
	case 3:
		head->call = (uint8_t)(1 + below(seed, 60));
		head->error = (uint8_t)below(seed, 12);
		break;
	case 4:
		head->fault[0][0] = (uint8_t)(1 + below(seed, 30));
		head->fault[0][1] = (uint8_t)(1 + below(seed, below(seed, 2) ? 2 : 60));
		head->fault[0][2] = (uint8_t)below(seed, 256);
		break;
	default:
		break;
	}
}

static void put_pieces(struct input *input, uint64_t *seed)
{
	for (int n = 0; n < PIECES; n++) {
		uint8_t piece = (uint8_t)below(seed, below(seed, 2) ? 0x20 : 0x100);

		input->byte[input->count++] = piece;
		if (piece < 0x80 || piece >= 0xe0)
			continue;
		for (uint32_t left = piece < 0xa0 ? 4 * ((piece & 0x1fu) + 1) : 4; left; left--)
			input->byte[input->count++] = (uint8_t)below(seed, 256);
	}
}

static void put_half(struct input *input, uint32_t half)
{
	input->byte[input->count++] = (uint8_t)half;
	input->byte[input->count++] = (uint8_t)(half >> 8);
}

/* Answers as the board might make them, to jobs that it has not looked at. */
static void put_answers(struct input *input, uint64_t *seed)
{
	input->head.response = (uint8_t)below(seed, 40);
	input->byte[input->count++] = 0xe0;
	for (uint32_t job = 1; job <= 8; job++) {
		uint32_t answered = 0;

		while (below(seed, 3)) {
			uint32_t count = below(seed, 4) ? 1 + below(seed, 300) : 256;

			input->byte[input->count++] = 0xc0;
			put_half(input, count);
			answered += count;
		}
		input->byte[input->count++] = 0xd0;
		input->byte[input->count++] = (uint8_t)(below(seed, 3) ? 1 : 0);
		input->byte[input->count++] = (uint8_t)(below(seed, 8) ? job : below(seed, 256));
		put_half(input, below(seed, 100));
		put_half(input, below(seed, 8) ? answered : below(seed, 1000));
		if (below(seed, 2))
			input->byte[input->count++] = 0xf0;
	}
}

static int write_input(const struct input *input, const char *path)
{
	FILE *file = fopen(path, "wb");
	int error;

	if (!file)
		return -1;
	fwrite(&input->head, sizeof(input->head), 1, file);
	fwrite(input->byte, 1, input->count, file);
	error = ferror(file);
	return fclose(file) || error ? -1 : 0;
}

int main(int argc, char **argv)
{
	char path[4096];
	uint64_t seed;

	if (argc != 4) {
		fprintf(stderr, "usage: fuzz_usb_corpus DIRECTORY SEED COUNT\n");
		return 2;
	}
	seed = strtoull(argv[2], NULL, 0);
	for (int left = atoi(argv[3]); left > 0; left--) {
		struct input input = { .count = 0 };

		put_head(&input, &seed);
		if (left % 4 == 1)
			put_answers(&input, &seed);
		else if (left % 4)
			put_pieces(&input, &seed);
		snprintf(path, sizeof(path), "%s/%d", argv[1], left);
		if (write_input(&input, path)) {
			perror(path);
			return 1;
		}
	}
	return 0;
}
