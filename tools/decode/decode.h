/* SPDX-License-Identifier: MIT */
/*
 * Walks a command stream packet by packet, finds where it breaks, and prints
 * it in names. The checks and their order are those of the core, without the
 * ones that take more than the stream: SLOT, RESPONSE and MEMORY. Any bytes
 * will do as a stream; nothing here allocates or keeps state of its own.
 */
#ifndef DECODE_H
#define DECODE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "gloss_packets.h"
#include "decode/table.h"

/* Words that hold any packet. */
#define DECODE_PACKET_MAX (GLOSS_LENGTH_MAX + 1)

struct decode {
	unsigned int tile_size; /* T, or 0: only what is wrong for both 32 and 64 */
	uint64_t offset;        /* words before the next packet */
	bool in_tile, colour_surface, depth_surface; /* open; set */
};

struct decode_packet {
	uint64_t offset;                 /* of the header, in words */
	const uint32_t *words;           /* lent by decode_next's caller */
	size_t count;                    /* words that are the packet's; 0: no packet */
	const struct table_packet *type; /* NULL: unknown opcode */
	enum gloss_fault fault;
	uint64_t fault_offset;
	char reason[160]; /* what is wrong, in words; "" without a fault */
};

void decode_init(struct decode *decode, unsigned int tile_size);

/*
 * Reads the packet at the start of @words. @count are there: all to the end
 * of the stream, or at least DECODE_PACKET_MAX of them. False: the stream is
 * over, with packet->fault if it may not end here. After a fault there is
 * nothing more to read.
 */
bool decode_next(struct decode *decode, const uint32_t *words, size_t count,
		 struct decode_packet *packet);

/* Reads a whole stream; @last is the faulty packet, or the stream's end. */
enum gloss_fault decode_stream(const uint32_t *words, size_t count, unsigned int tile_size,
			       struct decode_packet *last);

/* One line a word: offset, the word, its fields. Of a broken packet, up to the broken word. */
void decode_print(FILE *out, const struct decode_packet *packet);
/* In lower case, as in gloss.xml. */
const char *decode_fault_name(enum gloss_fault fault);
/* "fault NAME at word N: reason", for a packet with a fault. */
void decode_print_fault(FILE *out, const struct decode_packet *packet);

/* ---- between decode.c and print.c ---- */

/* Words of a packet whose fields are in one record. */
struct decode_run {
	const struct table_record *record;
	unsigned int word; /* of the packet, where the run begins */
	unsigned int words;
};

#define DECODE_RUNS_MAX 16

/* Splits a packet with this header, the header too, into runs; returns their number. */
unsigned int decode_runs(const struct table_packet *type, uint32_t header,
			 struct decode_run runs[DECODE_RUNS_MAX]);

/* The field's bits in its word, sign-extended if it has a sign. */
int64_t decode_field(const struct table_field *field, uint32_t word);

#endif
