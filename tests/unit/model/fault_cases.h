/* SPDX-License-Identifier: MIT */
/* Streams that end in a fault, and the word it is reported at: of each check, and of two that both
 * fail. */
#ifndef FAULT_CASES_H
#define FAULT_CASES_H

#include <stddef.h>
#include <stdint.h>

#include "gloss_packets.h"

/* Slots of every case; the others are empty. */
enum slots {
	WHOLE, /* one tile of 64 by 64, read and write */
	READ,  /* the same, read only */
	WRITE, /* the same, write only */
	SMALL, /* 100 bytes, read and write */
	ODD,   /* 103 bytes */
	LATE,  /* as WHOLE but four bytes shorter */
};

struct fault_case {
	const char *name;
	uint32_t words[48];
	size_t count;
	enum gloss_fault fault;
	uint32_t at;   /* from the first of words */
	uint32_t room; /* in the response; 0: plenty */
	int tile_size; /* 0: 64 */
};

extern const struct fault_case fault_cases[];
extern const size_t fault_cases_count;

#endif
