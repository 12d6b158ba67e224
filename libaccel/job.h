/* SPDX-License-Identifier: MIT */
/*
 * A job as every engine takes it: the model, the Verilated core and, with
 * slots named by object instead of address, the kernel and USB boards.
 */
#ifndef ACCEL_JOB_H
#define ACCEL_JOB_H

#include <stdint.h>

#include "gloss_packets.h"

/* A range of board memory a stream may name. A size of 0 is an empty slot. */
struct gloss_slot {
	uint32_t base; /* byte address in board memory, multiple of 4096 */
	uint32_t size; /* bytes */
	enum gloss_rights rights;
};

struct accel_job {
	const uint32_t *stream;
	uint32_t stream_words;
	uint32_t *response;      /* may be NULL if response_words is 0 */
	uint32_t response_words; /* room, in words */
	struct gloss_slot slot[GLOSS_SLOTS];
};

#endif
