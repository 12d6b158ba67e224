// SPDX-License-Identifier: MIT
#include "grammar.h"

#include <string.h>

#include "decode/gloss_table.h"

#define PACKETS (sizeof(table_packets) / sizeof(*table_packets))

/* The longest packet, and a TILE_END, fit behind the last word that is not above. */
#define FULL (GRAMMAR_WORDS - GLOSS_LENGTH_MAX - 16)

/* One of how many fields, and packets, is wrong where one may be. */
#define FIELD 64
#define PACKET 40

const struct table_packet *grammar_packets(uint32_t *count)
{
	*count = PACKETS;
	return table_packets;
}

/* ---- numbers: splitmix64 ---- */

static uint64_t mix(uint64_t z)
{
	z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
	z = (z ^ z >> 27) * 0x94d049bb133111eb;
	return z ^ z >> 31;
}

uint32_t grammar_random(struct grammar *g)
{
	g->state += 0x9e3779b97f4a7c15;
	return (uint32_t)(mix(g->state) >> 32);
}

uint32_t grammar_below(struct grammar *g, uint32_t n)
{
	return (uint32_t)((uint64_t)grammar_random(g) * n >> 32);
}

/* ---- fields ---- */

static const struct table_field *find(const struct table_record *record, const char *name)
{
	const struct table_field *field = record->fields;

	while (strcmp(field->name, name) != 0)
		field++;
	return field;
}

static uint32_t field_mask(const struct table_field *field)
{
	return ~0u >> (31 - (field->high - field->low));
}

static void put_bits(uint32_t *word, const struct table_field *field, uint32_t value)
{
	uint32_t mask = field_mask(field);

	*word = (*word & ~(mask << field->low)) | (value & mask) << field->low;
}

uint32_t grammar_get(const struct grammar *g, const struct table_record *record, uint32_t at,
		     const char *name)
{
	const struct table_field *field = find(record, name);

	return g->words[at + field->word] >> field->low & field_mask(field);
}

void grammar_put(struct grammar *g, const struct table_record *record, uint32_t at,
		 const char *name, uint32_t value)
{
	const struct table_field *field = find(record, name);

	put_bits(&g->words[at + field->word], field, value);
}

/* The ends of a field of @mask, of both signs, and anything between. */
static uint32_t any_value(struct grammar *g, uint32_t mask)
{
	uint32_t top = mask ^ mask >> 1;

	switch (grammar_below(g, 10)) {
	case 0:
		return 0;
	case 1:
		return 1 & mask;
	case 2:
		return mask;
	case 3:
		return mask - 1;
	case 4:
		return top;
	case 5:
		return top - 1;
	case 6:
		return grammar_random(g) & mask >> grammar_below(g, 32);
	default:
		return grammar_random(g) & mask;
	}
}

static uint32_t field_value(struct grammar *g, const struct table_field *field)
{
	uint32_t value = any_value(g, field_mask(field));

	if (grammar_breaks(g, FIELD))
		return value;
	if (field->type == TABLE_ENUM)
		return field->enumeration->values[grammar_below(g, field->enumeration->count)]
			.value;
	if (field->type == TABLE_UINT && value < (uint64_t)field->min)
		return (uint32_t)field->min;
	return value;
}

/* ---- packets ---- */

static void note(struct grammar *g, const struct table_record *record,
		 const struct table_packet *packet, uint32_t at)
{
	if (g->records < GRAMMAR_RECORDS)
		g->record[g->records++] = (struct grammar_record){ record, packet, at };
}

static void fill(struct grammar *g, const struct table_record *record, uint32_t at)
{
	for (uint32_t n = 0; n < record->count; n++)
		put_bits(&g->words[at + record->fields[n].word], &record->fields[n],
			 field_value(g, &record->fields[n]));
}

/* Takes @count words that are 0; where they begin. */
static uint32_t take(struct grammar *g, uint32_t count)
{
	uint32_t at = g->job.stream_words;

	memset(g->words + at, 0, 4 * (size_t)count);
	g->job.stream_words += count;
	return at;
}

static void add_part(struct grammar *g, const struct table_part *part, uint32_t header)
{
	uint32_t at;

	if (!part->always &&
	    (header >> part->low & ~0u >> (31 - (part->high - part->low))) != part->value)
		return;
	at = take(g, part->group->words);
	note(g, part->group, NULL, at);
	fill(g, part->group, at);
	grammar_sense_part(g, part->group, at);
}

static void add_packet(struct grammar *g, const struct table_packet *packet)
{
	uint32_t at = take(g, 1 + packet->record.words), extra, length;

	note(g, &packet->record, packet, at);
	fill(g, &packet->record, at);
	for (uint32_t n = 0; n < packet->count; n++)
		add_part(g, &packet->parts[n], g->words[at]);
	if (packet->variable && !packet->count) {
		extra = grammar_extra(g, packet);
		for (uint32_t first = take(g, extra), n = 0; n < extra; n++)
			g->words[first + n] = any_value(g, ~0u);
	}
	length = g->job.stream_words - at - 1;
	if (grammar_breaks(g, PACKET))
		length += grammar_once(g, 2) ? 1u : ~0u;
	g->words[at] |= packet->opcode << 24 | (length & GLOSS_LENGTH_MAX);
	grammar_sense_packet(g, packet, at);
}

static const struct table_packet *choose(struct grammar *g)
{
	uint32_t sum = 0, at;

	if (grammar_breaks(g, PACKET))
		return &table_packets[grammar_below(g, PACKETS)];
	for (uint32_t n = 0; n < PACKETS; n++)
		sum += grammar_weight(g, &table_packets[n]);
	at = grammar_below(g, sum);
	for (uint32_t n = 0;; n++) {
		uint32_t weight = grammar_weight(g, &table_packets[n]);

		if (at < weight)
			return &table_packets[n];
		at -= weight;
	}
}

static void close_tile(struct grammar *g)
{
	uint32_t n = 0;

	while (table_packets[n].opcode != GLOSS_OP_TILE_END)
		n++;
	add_packet(g, &table_packets[n]);
}

/* ---- jobs ---- */

static void make_stream(struct grammar *g, uint64_t state)
{
	uint32_t packets;

	g->state = state;
	g->job = (struct accel_job){ .stream = g->words };
	g->records = 0;
	g->in_tile = false;
	g->answered = 0;
	g->colour = g->depth = (struct grammar_surface){ 0, 0 };
	grammar_make_slots(g);
	packets = grammar_below(g, grammar_once(g, 8) ? 120 : 20);
	for (uint32_t n = 0; n < packets && g->job.stream_words < FULL; n++)
		add_packet(g, choose(g));
	if (g->in_tile && !grammar_breaks(g, 8))
		close_tile(g);
}

/* Exactly enough, or about that. */
static void make_room(struct grammar *g)
{
	uint32_t room = g->answered < GRAMMAR_RESPONSE ? (uint32_t)g->answered : GRAMMAR_RESPONSE;

	if (grammar_breaks(g, 3))
		room = grammar_once(g, 2) ? room - !!room : grammar_below(g, room + 1);
	else if (grammar_once(g, 3))
		room += grammar_below(g, GRAMMAR_RESPONSE - room + 1);
	g->job.response_words = room;
}

/* Of eight jobs in a row. */
static const enum grammar_kind kinds[] = {
	GRAMMAR_SOUND, GRAMMAR_WILD, GRAMMAR_DAMAGED, GRAMMAR_OPCODE,
	GRAMMAR_SOUND, GRAMMAR_WILD, GRAMMAR_DAMAGED, GRAMMAR_RESERVED,
};

#define KINDS (sizeof(kinds) / sizeof(*kinds))

uint64_t grammar_turn(uint64_t number, enum grammar_kind kind)
{
	uint64_t turn = 0, before = 0;

	for (uint32_t n = 0; n < KINDS; n++) {
		turn += kinds[n] == kind;
		before += n < number % KINDS && kinds[n] == kind;
	}
	return number / KINDS * turn + before;
}

void grammar_make(struct grammar *g, uint64_t seed, uint64_t number, uint32_t tile_size)
{
	uint64_t state = mix(seed) ^ mix(number + 1);

	g->tile_size = tile_size;
	g->kind = kinds[number % KINDS];
	do {
		state = mix(state + 1);
		make_stream(g, state);
		make_room(g);
	} while (!grammar_damage(g, grammar_turn(number, g->kind)));
}
