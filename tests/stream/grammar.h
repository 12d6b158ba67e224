/* SPDX-License-Identifier: MIT */
/*
 * A second generator of random jobs, which shares nothing with stream_random.h: it walks the
 * packets of rtl/gloss.xml (tools/decode/gloss_table.h), so what is new there is in its jobs the day it is
 * there. Values are drawn at the ends of each field; what only the prose of gloss.xml says
 * (alignment, order, rights, room) is in grammar_sense.c.
 *
 *   grammar.c         packets, fields and parts to words
 *   grammar_sense.c   slots, and values that have a meaning there
 *   grammar_damage.c  what is wrong with a job
 */
#ifndef TESTS_STREAM_GRAMMAR_H
#define TESTS_STREAM_GRAMMAR_H

#include <stdbool.h>
#include <stdint.h>

#include "job.h"
#include "decode/table.h"

#define GRAMMAR_WORDS 8192
#define GRAMMAR_RECORDS 2048
#define GRAMMAR_RESPONSE (20 * 1024) /* words, most that a job has room for */
#define GRAMMAR_MEMORY (256 * 1024)  /* bytes of board memory */

/* How a job was made, and so what is known of its end. */
enum grammar_kind {
	GRAMMAR_SOUND,    /* as gloss.xml asks: no fault */
	GRAMMAR_WILD,     /* now and then a value that it forbids */
	GRAMMAR_DAMAGED,  /* bits flipped, words dropped or repeated, or the end cut off */
	GRAMMAR_OPCODE,   /* one packet has another opcode */
	GRAMMAR_RESERVED, /* one reserved bit is set */
	GRAMMAR_KINDS
};

/* A packet, whose word 0 is the header, or a part of a payload. */
struct grammar_record {
	const struct table_record *record;
	const struct table_packet *packet; /* NULL: a part */
	uint32_t at;                       /* its word 0 in the stream */
};

struct grammar {
	/* stream points into words, so the struct must not be copied; response is NULL and the
	 * caller's to set. */
	struct accel_job job;
	uint32_t words[GRAMMAR_WORDS];
	uint32_t slots; /* those behind are empty */
	uint32_t tile_size;

	enum grammar_kind kind;
	/* What the stream was before it was damaged. */
	struct grammar_record record[GRAMMAR_RECORDS];
	uint32_t records;
	uint32_t damaged_at; /* of OPCODE, RESERVED: the word that was changed */

	/* Of the generator. */
	uint64_t state;
	bool in_tile;
	uint64_t answered; /* words of the response that the stream asks for */
	struct grammar_surface {
		uint32_t slot, pitch; /* pitch 0: not set */
	} colour, depth;
};

/* The packets of gloss.xml. */
const struct table_packet *grammar_packets(uint32_t *count);

/* Job @number of @seed. The same for all engines of a @tile_size of 32 or 64. */
void grammar_make(struct grammar *g, uint64_t seed, uint64_t number, uint32_t tile_size);

/* How many reserved bits the packets and their parts have. Job by job each is set in turn, and so
 * each of the 256 opcodes is written. */
uint32_t grammar_reserved_bits(void);
/* Which of these jobs is one of @kind: counts those before it. */
uint64_t grammar_turn(uint64_t number, enum grammar_kind kind);

/* ---- between the files ---- */

uint32_t grammar_random(struct grammar *g);
uint32_t grammar_below(struct grammar *g, uint32_t n); /* 0 to @n - 1 */
/* One of @n times. */
static inline bool grammar_once(struct grammar *g, uint32_t n)
{
	return grammar_below(g, n) == 0;
}
/* Is the next rule to be broken? One of @n times, in jobs that may. */
static inline bool grammar_breaks(struct grammar *g, uint32_t n)
{
	return g->kind == GRAMMAR_WILD && grammar_once(g, n);
}

/* A field of a record whose word 0 is at @at; the record has it. */
uint32_t grammar_get(const struct grammar *g, const struct table_record *record, uint32_t at,
		     const char *name);
void grammar_put(struct grammar *g, const struct table_record *record, uint32_t at,
		 const char *name, uint32_t value);

/* grammar_sense.c: before anything else the slot table; a packet that is complete but for its
 * parts; a part that is complete. */
void grammar_make_slots(struct grammar *g);
void grammar_sense_packet(struct grammar *g, const struct table_packet *packet, uint32_t at);
void grammar_sense_part(struct grammar *g, const struct table_record *part, uint32_t at);
/* How likely this packet is to be next, 0: not at all if rules are kept. */
uint32_t grammar_weight(const struct grammar *g, const struct table_packet *packet);
/* Payload words of a packet that may have any number, beyond those of its record. */
uint32_t grammar_extra(struct grammar *g, const struct table_packet *packet);

/* grammar_damage.c: what the kind says; false: the stream does not have what is to be damaged. */
bool grammar_damage(struct grammar *g, uint64_t turn);

#endif
