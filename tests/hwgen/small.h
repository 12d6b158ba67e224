/* SPDX-License-Identifier: MIT */
/* Generated from rtl/small.xml by tools/hwgen; do not edit. */
#ifndef SMALL_PACKETS_H
#define SMALL_PACKETS_H

#include <stdbool.h>
#include <stdint.h>

/* As the interface says. */
#define SMALL_VERSION 3u
#define SMALL_ROW_BYTES 0x100u
/* In both headers. */
#define SMALL_MAGIC 0xcafeu
#define SMALL_WIRE_PINS 4u

/* All values have names. */
enum small_colour {
	SMALL_COLOUR_RED = 0,
	/* As | grass. */
	SMALL_COLOUR_GREEN = 1,
	SMALL_COLOUR_BLUE = 2,
	SMALL_COLOUR_WHITE = 3,
};

enum small_form {
	SMALL_FORM_DOT = 0,
	SMALL_FORM_LINE = 1,
	SMALL_FORM_BOX = 2,
};

/* With gaps. */
enum small_power {
	SMALL_POWER_ONE = 1,
	SMALL_POWER_TWO = 2,
	SMALL_POWER_EIGHT = 8,
};

static inline bool small_power_known(uint32_t value)
{
	switch (value) {
	case SMALL_POWER_ONE:
	case SMALL_POWER_TWO:
	case SMALL_POWER_EIGHT:
		return true;
	default:
		return false;
	}
}

enum small_opcode {
	SMALL_OP_STOP = 0x00,
	SMALL_OP_SKIP = 0x01,
	SMALL_OP_DATA = 0x02,
	SMALL_OP_DRAW = 0xff,
};

/* A header: opcode in bits 31:24, payload length in words in bits 10:0,
 * bits 23:11 the packet's own. */
#define SMALL_LENGTH_MAX 2047u

static inline unsigned int small_header_opcode(uint32_t header)
{
	return header >> 24;
}

static inline unsigned int small_header_length(uint32_t header)
{
	return header & 0x7ffu;
}

/* ---- place ---- */

#define SMALL_PLACE_WORDS 3

/* Signed numbers. */
struct small_place {
	int32_t x;
	int32_t y;
	int32_t whole;
};

static inline void small_place_pack(uint32_t *words, const struct small_place *p)
{
	words[0] = ((uint32_t)p->x & 0xfffu) << 20 |
		   ((uint32_t)p->y & 0xfffu);
	words[1] = 0;
	words[2] = (uint32_t)p->whole;
}

static inline void small_place_unpack(const uint32_t *words, struct small_place *p)
{
	p->x = (int32_t)words[0] >> 20;
	p->y = (int32_t)(words[0] << 20) >> 20;
	p->whole = (int32_t)words[2];
}

/* @words: the 3 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int small_place_invalid(const uint32_t *words)
{
	if ((words[0] & 0x000ff000u) || ((int32_t)words[0] >> 20) < -100 ||
	    ((int32_t)(words[0] << 20) >> 20) > 100)
		return 0;
	if (words[1] & 0xffffffffu)
		return 1;
	return -1;
}

/* ---- extent ---- */

#define SMALL_EXTENT_WORDS 2

struct small_extent {
	uint32_t size;
	uint32_t size_high;
	uint32_t level;
	enum small_power mode;
};

static inline void small_extent_pack(uint32_t *words, const struct small_extent *p)
{
	words[0] = p->size;
	words[1] = (p->size_high & 0xffu) |
		   (p->level & 0xfu) << 28 |
		   ((uint32_t)p->mode & 0xfu) << 12;
}

static inline void small_extent_unpack(const uint32_t *words, struct small_extent *p)
{
	p->size = words[0];
	p->size_high = words[1] & 0xffu;
	p->level = words[1] >> 28;
	p->mode = (enum small_power)(words[1] >> 12 & 0xfu);
}

/* @words: the 2 of the group. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int small_extent_invalid(const uint32_t *words)
{
	if ((words[1] & 0x0fff0f00u) || (words[1] >> 28) < 2 || (words[1] >> 28) > 9 ||
	    !small_power_known(words[1] >> 12 & 0xfu))
		return 1;
	return -1;
}

/* ---- stop ---- */

#define SMALL_STOP_WORDS 0

/* Has nothing. */

/* Writes the header. */
static inline void small_stop_pack(uint32_t *words)
{
	words[0] = (uint32_t)SMALL_OP_STOP << 24 | SMALL_STOP_WORDS;
}

/* ---- skip ---- */

/* Writes the header. @length: payload words, at most 2047. */
static inline void small_skip_pack(uint32_t *words, uint32_t length)
{
	words[0] = (uint32_t)SMALL_OP_SKIP << 24 | length;
}

/* ---- data ---- */

#define SMALL_DATA_WORDS 1

struct small_data {
	uint32_t address;
};

/* Writes the header and the word after it. @length: payload words, at most 2047. */
static inline void small_data_pack(uint32_t *words, const struct small_data *p, uint32_t length)
{
	words[0] = (uint32_t)SMALL_OP_DATA << 24 | length;
	words[1] = p->address;
}

/* @words starts at the header. */
static inline void small_data_unpack(const uint32_t *words, struct small_data *p)
{
	p->address = words[1];
}

/* @words: the 1 behind the header. Index of the first with a reserved bit set or a
 * field out of range, or -1. */
static inline int small_data_invalid(const uint32_t *words)
{
	(void)words;
	return -1;
}

/* ---- draw ---- */

/* Has parts. */
struct small_draw {
	enum small_form form;
	bool plain;
	uint32_t count;
};

/* Payload words of a packet with this header. */
static inline uint32_t small_draw_length(const struct small_draw *p)
{
	uint32_t length = 0;

	length += SMALL_PLACE_WORDS;
	if (p->form == SMALL_FORM_BOX)
		length += SMALL_EXTENT_WORDS;
	if (!p->plain)
		length += SMALL_EXTENT_WORDS;
	if (p->count == 7)
		length += SMALL_PLACE_WORDS;
	return length;
}

/* Writes the header. */
static inline void small_draw_pack(uint32_t *words, const struct small_draw *p)
{
	words[0] = (uint32_t)SMALL_OP_DRAW << 24 | small_draw_length(p) |
		   ((uint32_t)p->form & 0x3u) << 11 |
		   (uint32_t)p->plain << 13 |
		   (p->count & 0xffu) << 16;
}

/* @words starts at the header. */
static inline void small_draw_unpack(const uint32_t *words, struct small_draw *p)
{
	p->form = (enum small_form)(words[0] >> 11 & 0x3u);
	p->plain = words[0] >> 13 & 0x1u;
	p->count = words[0] >> 16 & 0xffu;
}

/* ---- state ---- */

#define SMALL_STATE_WORDS 1

struct small_state {
	enum small_colour colour;
	/* A keyword of SystemVerilog alone. */
	uint32_t edge;
};

static inline void small_state_pack(uint32_t *words, const struct small_state *p)
{
	words[0] = ((uint32_t)p->colour & 0x3u) |
		   (p->edge & 0x3u) << 8;
}

static inline void small_state_unpack(const uint32_t *words, struct small_state *p)
{
	p->colour = (enum small_colour)(words[0] & 0x3u);
	p->edge = words[0] >> 8 & 0x3u;
}

/* ---- entry ---- */

#define SMALL_ENTRY_WORDS 2

/* In host memory. */
struct small_entry {
	uint32_t low;
	/* Narrow. */
	uint32_t high;
};

static inline void small_entry_pack(uint32_t *words, const struct small_entry *p)
{
	words[0] = p->low;
	words[1] = p->high & 0xffu;
}

static inline void small_entry_unpack(const uint32_t *words, struct small_entry *p)
{
	p->low = words[0];
	p->high = words[1] & 0xffu;
}

/* ---- message ---- */

#define SMALL_MESSAGE_WORDS 1

struct small_message {
	uint32_t size;
};

static inline void small_message_pack(uint32_t *words, const struct small_message *p)
{
	words[0] = p->size & 0xffu;
}

static inline void small_message_unpack(const uint32_t *words, struct small_message *p)
{
	p->size = words[0] & 0xffu;
}

/* ---- wave ---- */

#define SMALL_WAVE_WORDS 1

struct small_wave {
	/* As wide as a word. */
	uint32_t length;
};

static inline void small_wave_pack(uint32_t *words, const struct small_wave *p)
{
	words[0] = p->length;
}

static inline void small_wave_unpack(const uint32_t *words, struct small_wave *p)
{
	p->length = words[0];
}

/* ---- any packet ---- */

static inline bool small_opcode_known(unsigned int opcode)
{
	switch (opcode) {
	case SMALL_OP_STOP:
	case SMALL_OP_SKIP:
	case SMALL_OP_DATA:
	case SMALL_OP_DRAW:
		return true;
	default:
		return false;
	}
}

/* Are the header's reserved bits zero and its fields in range? The opcode is known. */
static inline bool small_header_valid(uint32_t header)
{
	switch (small_header_opcode(header)) {
	case SMALL_OP_STOP:
		return !(header & 0x00fff800u);
	case SMALL_OP_SKIP:
		return !(header & 0x00fff800u);
	case SMALL_OP_DATA:
		return !(header & 0x00fff800u);
	case SMALL_OP_DRAW:
		return !((header & 0x0000c000u) || (header >> 11 & 0x3u) > 2 ||
			 (header >> 16 & 0xffu) > 200);
	default:
		return false;
	}
}

#endif
