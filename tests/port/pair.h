/* SPDX-License-Identifier: MIT */
/*
 * Two boards that are to do the same, that of the C model and that of a plugin: board
 * memory of each, random jobs, comparing, and the program around it.
 *
 * PROGRAM [-n ROUNDS] PLUGIN; GLOSS_SEED is the seed of the first round.
 */
#ifndef TESTS_PAIR_H
#define TESTS_PAIR_H

#include <stdint.h>

#include "stream_random.h"

struct pair {
	const char *program, *plugin;
	uint64_t seed, random; /* of the round */
	uint8_t *memory[2];    /* the model's, the plugin's */
	struct stream_random stream;
};

/* What a program does with a pair; functions that are int return 1 for a failure. */
struct pair_test {
	const char *program;
	const char *symbol; /* of the plugin */
	/* Takes what the symbol stands for. False: it is no board of this tree. */
	bool (*load)(struct pair *pair, const void *ops);
	/* Board memory is filled and the same; so are random numbers. */
	int (*round)(struct pair *pair);
	void (*report)(const struct pair *pair, uint64_t rounds);
};

int pair_main(struct pair *pair, const struct pair_test *test, int argc, char **argv);

uint32_t pair_below(struct pair *pair, uint32_t n);

/* Says what differs and how to see it again; 1. */
int pair_differ(const struct pair *pair, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
int pair_compare_bytes(const struct pair *pair, const char *what, const uint8_t *model,
		       const uint8_t *other, uint32_t bytes);
int pair_compare_memory(const struct pair *pair);

/* Makes what the boards may have left different the same: what the slots of a job let it write. */
void pair_forgive_slots(struct pair *pair, const struct gloss_slot *slot);

/* The next job, to stream: valid, damaged, with too little room, with a stream that ends early. */
void pair_make_job(struct pair *pair, uint32_t tile_size);

#endif
