/* SPDX-License-Identifier: MIT */
/*
 * Random jobs for comparing engines: the same seed gives the same job, words,
 * slot table and response room alike, on any machine.
 *
 * A valid job runs to its end on any engine and uses everything the interface
 * has: each packet and form, several tiles that are loaded where others were
 * stored, triangles from a sliver of a pixel to the whole tile, real ones and
 * ones that only the registers' wrapping gives a meaning. A damaged job is a
 * valid one with a few faults put in, and may still be valid.
 */
#ifndef TESTS_STREAM_RANDOM_H
#define TESTS_STREAM_RANDOM_H

#include <stdbool.h>
#include <stdint.h>

#include "job.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Most words a stream may have and an answer may take. */
#define STREAM_RANDOM_WORDS 8192
#define STREAM_RANDOM_RESPONSE 65536

/* Bytes of board memory that hold all slots; between slots lie pages of none. */
#define STREAM_RANDOM_MEMORY (512 * 1024)

struct stream_random {
	/* stream points into words, so the struct must not be copied; response is
	 * NULL and the caller's to set, to room for response_words. */
	struct accel_job job;
	uint32_t words[STREAM_RANDOM_WORDS];
	int tile_size;

	/* Of the generator. */
	uint64_t state;
	uint32_t response_used;
	uint32_t budget; /* words after which the stream is brought to its end */
	struct stream_surface {
		uint32_t slot, pitch; /* pitch 0: not set */
	} colour, depth;
};

/* @tile_size 32 or 64. Most streams are short, some take thousands of words. */
void stream_random_valid(struct stream_random *r, uint64_t seed, int tile_size);

/* Damages a valid job; what is done follows from its seed too. Slots are only made smaller. */
void stream_random_damage(struct stream_random *r);

/* Fills board memory before a job. */
void stream_random_memory(uint8_t *memory, uint32_t bytes, uint64_t seed);

/* ---- the generator's numbers, and the files it consists of ---- */

uint32_t stream_random_word(struct stream_random *r);
/* 0 to @n - 1; @n is not 0. */
uint32_t stream_random_below(struct stream_random *r, uint32_t n);
/* @low to @high, both included. */
int32_t stream_random_between(struct stream_random *r, int32_t low, int32_t high);
bool stream_random_chance(struct stream_random *r, uint32_t percent);

/* Appends a word. There is room for any packet whenever job.stream_words is below budget. */
void stream_random_emit(struct stream_random *r, uint32_t word);

/* stream_random_triangle.c: appends a TRIANGLE. */
void stream_random_triangle(struct stream_random *r);
/* stream_random_small.c: appends a TRIANGLE_SMALL. */
void stream_random_small(struct stream_random *r);

#ifdef __cplusplus
}
#endif

#endif
