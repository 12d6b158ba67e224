// SPDX-License-Identifier: MIT
#include "grammar.h"

#include <string.h>

/* ---- reserved bits ---- */

static uint32_t reserved_in(const struct table_record *record, uint32_t word, bool header)
{
	/* A header's opcode and length are no fields of the packet's own. */
	uint32_t bits = header ? 0x00fff800 : ~0u;

	for (uint32_t n = 0; n < record->count; n++) {
		const struct table_field *field = &record->fields[n];

		if (field->word == word)
			bits &= ~(~0u >> (31 - (field->high - field->low)) << field->low);
	}
	return bits;
}

/* Finds reserved bit *@turn of a record, or takes what it has from *@turn. */
static bool find_bit(const struct table_record *record, bool packet, uint32_t *turn, uint32_t *word,
		     uint32_t *bit)
{
	for (*word = 0; *word < record->words + packet; ++*word) {
		uint32_t bits = reserved_in(record, *word, packet && *word == 0);

		for (*bit = 0; *bit < 32; ++*bit)
			if ((bits >> *bit & 1) && (*turn)-- == 0)
				return true;
	}
	return false;
}

/* Has a part of an earlier packet or part list this group already? */
static bool seen(const struct table_packet *packet, uint32_t part)
{
	for (uint32_t n = 0; n < part; n++)
		if (packet->parts[n].group == packet->parts[part].group)
			return true;
	return false;
}

/* The record of reserved bit @turn of all; NULL: there are fewer, *@left is what is above. */
static const struct table_record *find_reserved(uint32_t turn, uint32_t *word, uint32_t *bit,
						uint32_t *left)
{
	uint32_t count;
	const struct table_packet *packet = grammar_packets(&count);

	for (; count--; packet++) {
		if (find_bit(&packet->record, true, &turn, word, bit))
			return &packet->record;
		for (uint32_t n = 0; n < packet->count; n++)
			if (!seen(packet, n) &&
			    find_bit(packet->parts[n].group, false, &turn, word, bit))
				return packet->parts[n].group;
	}
	*left = turn;
	return NULL;
}

uint32_t grammar_reserved_bits(void)
{
	uint32_t word, bit, left = 0;

	find_reserved(~0u, &word, &bit, &left);
	return ~0u - left;
}

static bool set_reserved(struct grammar *g, uint64_t turn)
{
	const uint32_t bits = grammar_reserved_bits();
	const struct table_record *record;
	uint32_t word, bit, left;

	if (!bits)
		return false;
	record = find_reserved((uint32_t)(turn % bits), &word, &bit, &left);
	for (uint32_t n = 0; n < g->records; n++) {
		if (g->record[n].record != record)
			continue;
		g->damaged_at = g->record[n].at + word;
		g->words[g->damaged_at] |= 1u << bit;
		return true;
	}
	return false;
}

/* ---- opcodes ---- */

static bool set_opcode(struct grammar *g, uint64_t turn)
{
	uint32_t n;

	if (!g->records)
		return false;
	do
		n = grammar_below(g, g->records);
	while (!g->record[n].packet);
	g->damaged_at = g->record[n].at;
	g->words[g->damaged_at] &= 0x00ffffff;
	g->words[g->damaged_at] |= (uint32_t)(turn % 256) << 24;
	return true;
}

/* ---- words ---- */

static void flip(struct grammar *g, uint32_t at)
{
	for (uint32_t n = 1 + grammar_below(g, 3); n; n--)
		g->words[at] ^= 1u << grammar_below(g, 32);
}

static void drop(struct grammar *g, uint32_t at)
{
	uint32_t count = 1 + grammar_below(g, 3), left = g->job.stream_words - at;

	count = count < left ? count : left;
	memmove(g->words + at, g->words + at + count, 4 * (size_t)(left - count));
	g->job.stream_words -= count;
}

static void repeat(struct grammar *g, uint32_t at)
{
	uint32_t count = 1 + grammar_below(g, 40), left = g->job.stream_words - at;

	count = count < left ? count : left;
	if (g->job.stream_words + count > GRAMMAR_WORDS)
		return;
	memmove(g->words + at + count, g->words + at, 4 * (size_t)left);
	g->job.stream_words += count;
}

static void damage_words(struct grammar *g)
{
	for (uint32_t n = 1 + grammar_below(g, 2); n && g->job.stream_words; n--) {
		uint32_t at = grammar_below(g, g->job.stream_words);

		/* Headers are few among the words, and most of what is checked is in them. */
		if (grammar_once(g, 2))
			at = g->record[grammar_below(g, g->records)].at;
		at = at < g->job.stream_words ? at : 0;
		switch (grammar_below(g, 6)) {
		case 0:
			drop(g, at);
			break;
		case 1:
			repeat(g, at);
			break;
		case 2:
			g->job.stream_words = at;
			break;
		default:
			flip(g, at);
		}
	}
}

bool grammar_damage(struct grammar *g, uint64_t turn)
{
	switch (g->kind) {
	case GRAMMAR_DAMAGED:
		damage_words(g);
		return true;
	case GRAMMAR_OPCODE:
		return set_opcode(g, turn);
	case GRAMMAR_RESERVED:
		return set_reserved(g, turn);
	default:
		return true;
	}
}
