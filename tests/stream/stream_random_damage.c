// SPDX-License-Identifier: MIT
/* What can be wrong with a job, put into one that is right. */
#include <string.h>

#include "stream_random.h"

#define below stream_random_below
#define between stream_random_between
#define chance stream_random_chance

/* Offset of the header of a random packet; the stream is not empty and may be damaged already. */
static uint32_t random_header(struct stream_random *r)
{
	uint32_t at = 0, headers = 0, chosen = 0;

	while (at < r->job.stream_words) {
		if (below(r, ++headers) == 0)
			chosen = at;
		at += 1 + gloss_header_length(r->words[at]);
	}
	return chosen;
}

/* A word of the payload of a random packet, or its header if it has none. */
static uint32_t random_payload(struct stream_random *r)
{
	uint32_t at = random_header(r), length = gloss_header_length(r->words[at]);
	uint32_t left = r->job.stream_words - at - 1;

	if (length > left)
		length = left;
	return length ? at + 1 + below(r, length) : at;
}

static void flip(struct stream_random *r, uint32_t at)
{
	if (at < r->job.stream_words)
		r->words[at] ^= 1u << below(r, 32);
}

static void flip_any(struct stream_random *r)
{
	flip(r, below(r, r->job.stream_words));
}

static void flip_header(struct stream_random *r)
{
	flip(r, random_header(r));
}

/* The fields of most packets are in the first words. */
static void flip_payload(struct stream_random *r)
{
	uint32_t at = random_header(r);

	flip(r, at + (uint32_t)between(r, 1, 3));
}

static void replace_word(struct stream_random *r)
{
	uint32_t at = random_payload(r);

	r->words[at] = stream_random_word(r);
}

static void change_opcode(struct stream_random *r)
{
	uint32_t *header = &r->words[random_header(r)];

	*header = (*header & 0xffffff) | below(r, chance(r, 70) ? 0x40 : 0x100) << 24;
}

static void change_length(struct stream_random *r)
{
	uint32_t *header = &r->words[random_header(r)];
	uint32_t length = stream_random_word(r);

	if (chance(r, 70))
		length = gloss_header_length(*header) + (uint32_t)between(r, -2, 2);
	*header = (*header & ~GLOSS_LENGTH_MAX) | (length & GLOSS_LENGTH_MAX);
}

static void truncate_stream(struct stream_random *r)
{
	r->job.stream_words = below(r, r->job.stream_words);
}

static void delete_word(struct stream_random *r)
{
	uint32_t at = below(r, r->job.stream_words);

	memmove(r->words + at, r->words + at + 1, 4 * (r->job.stream_words - at - 1));
	r->job.stream_words--;
}

static void duplicate_word(struct stream_random *r)
{
	uint32_t at = below(r, r->job.stream_words);

	if (r->job.stream_words == STREAM_RANDOM_WORDS)
		return;
	memmove(r->words + at + 1, r->words + at, 4 * (r->job.stream_words - at));
	r->job.stream_words++;
}

/* Takes out a packet: a tile without its begin or end, a surface that is not set. */
static void delete_packet(struct stream_random *r)
{
	uint32_t at = random_header(r), words = 1 + gloss_header_length(r->words[at]);

	if (words > r->job.stream_words - at)
		words = r->job.stream_words - at;
	r->job.stream_words -= words;
	memmove(r->words + at, r->words + at + words, 4 * (r->job.stream_words - at));
}

static void take_rights(struct stream_random *r)
{
	struct gloss_slot *slot = &r->job.slot[below(r, GLOSS_SLOTS)];

	slot->rights = (enum gloss_rights)(slot->rights & below(r, 4));
}

static void shrink_slot(struct stream_random *r)
{
	struct gloss_slot *slot = &r->job.slot[below(r, GLOSS_SLOTS)];

	slot->size = below(r, slot->size + 1);
}

static void shrink_response(struct stream_random *r)
{
	r->job.response_words = chance(r, 40) ? r->response_used - (r->response_used > 0) :
						below(r, r->job.response_words + 1);
}

/* Moves a word that may be an offset by a row, a page or far out, or off its alignment. */
static void move_offset(struct stream_random *r)
{
	static const uint32_t by[] = { 1, 4, 128, 256, 4096, 65536, 1u << 31, ~0u, ~3u };
	uint32_t at = random_header(r);

	at += (uint32_t)between(r, 1, 2);
	if (at < r->job.stream_words)
		r->words[at] += by[below(r, sizeof(by) / sizeof(*by))];
}

static void (*const damages[])(struct stream_random *r) = {
	flip_any,
	flip_header,
	flip_payload,
	replace_word,
	change_opcode,
	change_length,
	truncate_stream,
	delete_word,
	duplicate_word,
	delete_packet,
	move_offset,
	shrink_response,
	/* Twice: most streams use few of the slots. */
	take_rights,
	take_rights,
	shrink_slot,
	shrink_slot,
};

void stream_random_damage(struct stream_random *r)
{
	for (int n = between(r, 1, 3); n > 0 && r->job.stream_words > 0; n--)
		damages[below(r, sizeof(damages) / sizeof(*damages))](r);
}
