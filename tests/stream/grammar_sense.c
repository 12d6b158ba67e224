// SPDX-License-Identifier: MIT
/* What the prose of gloss.xml asks for and its fields do not say. */
#include "grammar.h"

#include <string.h>

/* One of how many rules is broken where one may be. */
#define RULE 12

#define PAGES (GRAMMAR_MEMORY / GLOSS_PAGE_BYTES)

/* ---- slots ---- */

/* Of a place with @left bytes behind it: a tile, a page, all, or a few bytes more or less. */
static uint32_t slot_size(struct grammar *g, uint32_t left)
{
	const uint32_t tile = 4 * g->tile_size * g->tile_size;
	const uint32_t size[] = { tile, 4 * g->tile_size, 2 * tile, GLOSS_PAGE_BYTES, 8, left, left,
				  left };
	uint32_t bytes = size[grammar_below(g, 8)];

	if (grammar_once(g, 3))
		bytes += grammar_below(g, 9) - 4;
	return bytes && bytes <= left ? bytes : left;
}

static enum gloss_rights slot_rights(struct grammar *g)
{
	if (!grammar_once(g, 4))
		return GLOSS_RIGHTS_READ_WRITE;
	return (enum gloss_rights)grammar_below(g, 4);
}

/* At random pages, so that they overlap; sometimes at the very end of memory. */
void grammar_make_slots(struct grammar *g)
{
	g->slots = grammar_once(g, 4) ? grammar_below(g, GLOSS_SLOTS + 1) : GLOSS_SLOTS;
	for (uint32_t n = 0; n < g->slots; n++) {
		uint32_t page = grammar_once(g, 8) ? PAGES - 1 : grammar_below(g, PAGES);
		uint32_t base = grammar_once(g, 4) ? 0 : page * GLOSS_PAGE_BYTES;

		if (!grammar_once(g, 8))
			g->job.slot[n] = (struct gloss_slot){
				.base = base,
				.size = slot_size(g, GRAMMAR_MEMORY - base),
				.rights = slot_rights(g),
			};
	}
}

static bool slot_allows(const struct grammar *g, uint32_t slot, enum gloss_rights right,
			uint64_t bytes)
{
	return (g->job.slot[slot].rights & right) && g->job.slot[slot].size >= bytes;
}

/* One that allows it, if there is one: false. */
static bool find_slot(struct grammar *g, enum gloss_rights right, uint64_t bytes, uint32_t *slot)
{
	*slot = grammar_below(g, GLOSS_SLOTS);
	for (uint32_t n = 0; n < GLOSS_SLOTS && !slot_allows(g, *slot, right, bytes); n++)
		*slot = (*slot + 1) % GLOSS_SLOTS;
	return slot_allows(g, *slot, right, bytes);
}

/* A multiple of @align in a slot from which @bytes fit: the first, the last, or one between; or,
 * where rules are not kept, one too far, far too far, or no multiple. */
static uint32_t offset_in(struct grammar *g, uint32_t slot, uint64_t bytes, uint32_t align)
{
	uint64_t size = g->job.slot[slot].size;
	uint32_t last = size < bytes ? 0 : (uint32_t)(size - bytes) / align;

	if (grammar_breaks(g, RULE)) {
		const uint32_t wrong[] = { (last + 1) * align, 0u - align,
					   last * align + grammar_below(g, align) };

		return wrong[grammar_below(g, 3)];
	}
	if (grammar_once(g, 3))
		return grammar_once(g, 2) ? 0 : last * align;
	return grammar_below(g, last + 1) * align;
}

/* ---- packets ---- */

static bool any_slot_allows(const struct grammar *g, enum gloss_rights right)
{
	uint32_t slot = 0;

	while (slot < GLOSS_SLOTS && !slot_allows(g, slot, right, 4))
		slot++;
	return slot < GLOSS_SLOTS;
}

uint32_t grammar_weight(const struct grammar *g, const struct table_packet *packet)
{
	switch (packet->opcode) {
	case GLOSS_OP_WRITE_MEMORY:
		return !g->in_tile && any_slot_allows(g, GLOSS_RIGHTS_WRITE) ? 4 : 0;
	case GLOSS_OP_READ_MEMORY:
		return !g->in_tile && any_slot_allows(g, GLOSS_RIGHTS_READ) &&
				       g->answered < GRAMMAR_RESPONSE ?
			       4 :
			       0;
	case GLOSS_OP_COUNTERS:
		return g->in_tile || g->answered + GLOSS_COUNTER_WORDS > GRAMMAR_RESPONSE ? 0 : 2;
	case GLOSS_OP_TILE_BEGIN:
		return g->in_tile ? 0 : 12;
	case GLOSS_OP_TILE_END:
		return g->in_tile ? 4 : 0;
	case GLOSS_OP_TRIANGLE:
	case GLOSS_OP_TRIANGLE_SMALL:
		return g->in_tile ? 16 : 0;
	default:
		return 2;
	}
}

uint32_t grammar_extra(struct grammar *g, const struct table_packet *packet)
{
	uint32_t most = grammar_once(g, 40) ? GLOSS_LENGTH_MAX - packet->record.words : 12;
	uint32_t least = packet->least - packet->record.words;

	if (grammar_breaks(g, RULE))
		return 0;
	if (grammar_once(g, 2))
		return least;
	return least + grammar_below(g, most - least + 1);
}

static void sense_write(struct grammar *g, const struct table_packet *packet, uint32_t at)
{
	uint32_t words = g->job.stream_words - at - 1 - packet->record.words, slot;

	if (!find_slot(g, GLOSS_RIGHTS_WRITE, 4ull * words, &slot) && words > 1) {
		/* Too much for any slot: the least that it may be. */
		words = 1;
		g->job.stream_words = at + 1 + packet->least;
		g->words[at] = (g->words[at] & ~(uint32_t)GLOSS_LENGTH_MAX) | packet->least;
		find_slot(g, GLOSS_RIGHTS_WRITE, 4, &slot);
	}
	if (!grammar_breaks(g, RULE))
		grammar_put(g, &packet->record, at, "slot", slot);
	grammar_put(g, &packet->record, at, "offset", offset_in(g, slot, 4ull * words, 4));
}

static void sense_read(struct grammar *g, const struct table_packet *packet, uint32_t at)
{
	uint32_t count = grammar_get(g, &packet->record, at, "count"), slot;
	uint64_t left = GRAMMAR_RESPONSE - g->answered;

	if (!grammar_breaks(g, RULE) && !grammar_once(g, 8))
		count = 1 + count % 40;
	if (!grammar_breaks(g, RULE) && count > left)
		count = left ? (uint32_t)left : 1;
	if (!find_slot(g, GLOSS_RIGHTS_READ, 4ull * count, &slot) && !grammar_breaks(g, RULE)) {
		find_slot(g, GLOSS_RIGHTS_READ, 4, &slot);
		count = g->job.slot[slot].size / 4 % 65536;
		count = count ? count : 1;
		count = count > left ? 1 : count;
	}
	grammar_put(g, &packet->record, at, "count", count);
	if (!grammar_breaks(g, RULE))
		grammar_put(g, &packet->record, at, "slot", slot);
	grammar_put(g, &packet->record, at, "offset", offset_in(g, slot, 4ull * count, 4));
	g->answered += count;
}

static void sense_surface(struct grammar *g, const struct table_packet *packet, uint32_t at,
			  struct grammar_surface *surface)
{
	uint32_t row = 4 * g->tile_size, most = 65535 / row;
	uint32_t rows = grammar_once(g, 6) ? most : 1 + grammar_below(g, 6);

	if (!grammar_breaks(g, RULE))
		grammar_put(g, &packet->record, at, "pitch", rows * row);
	surface->slot = grammar_get(g, &packet->record, at, "slot");
	surface->pitch = grammar_get(g, &packet->record, at, "pitch");
}

/* May a tile be loaded from a surface, or stored to it? */
static bool surface_allows(const struct grammar *g, const struct grammar_surface *surface,
			   enum gloss_rights right, uint64_t *bytes)
{
	*bytes = (uint64_t)(g->tile_size - 1) * surface->pitch + 4 * g->tile_size;
	return surface->pitch && slot_allows(g, surface->slot, right, *bytes);
}

static void sense_begin(struct grammar *g, const struct table_packet *packet, uint32_t at,
			const char *name, const char *load, const struct grammar_surface *surface)
{
	uint64_t bytes;

	if (!surface_allows(g, surface, GLOSS_RIGHTS_READ, &bytes) && !grammar_breaks(g, RULE))
		grammar_put(g, &packet->record, at, load, 0);
	if (grammar_get(g, &packet->record, at, load))
		grammar_put(g, &packet->record, at, name,
			    offset_in(g, surface->slot, bytes, 4 * g->tile_size));
}

static void sense_end(struct grammar *g, const struct table_packet *packet, uint32_t at,
		      const char *name, const char *output, const struct grammar_surface *surface)
{
	uint32_t pixels = g->tile_size * g->tile_size;
	uint32_t kind = grammar_get(g, &packet->record, at, output);
	uint64_t bytes;

	if (kind == GLOSS_TILE_OUTPUT_STORE &&
	    !surface_allows(g, surface, GLOSS_RIGHTS_WRITE, &bytes) && !grammar_breaks(g, RULE))
		kind = GLOSS_TILE_OUTPUT_ANSWER;
	if (kind == GLOSS_TILE_OUTPUT_ANSWER && g->answered + pixels > GRAMMAR_RESPONSE)
		kind = GLOSS_TILE_OUTPUT_DROP;
	grammar_put(g, &packet->record, at, output, kind);
	if (kind == GLOSS_TILE_OUTPUT_STORE)
		grammar_put(g, &packet->record, at, name,
			    offset_in(g, surface->slot, bytes, 4 * g->tile_size));
	else if (!grammar_breaks(g, RULE))
		grammar_put(g, &packet->record, at, name, 0);
	if (kind == GLOSS_TILE_OUTPUT_ANSWER)
		g->answered += pixels;
}

static void sense_scissor(struct grammar *g, const struct table_packet *packet, uint32_t at)
{
	static const char *const names[] = { "x0", "y0", "x1", "y1" };

	for (uint32_t n = 0; n < 4; n++) {
		uint32_t value = grammar_get(g, &packet->record, at, names[n]);

		/* More of them with something inside. */
		if (n >= 2 && grammar_once(g, 2))
			value = g->tile_size;
		if (value > g->tile_size && !grammar_breaks(g, RULE))
			value = grammar_once(g, 2) ? g->tile_size : value % g->tile_size;
		grammar_put(g, &packet->record, at, names[n], value);
	}
}

void grammar_sense_packet(struct grammar *g, const struct table_packet *packet, uint32_t at)
{
	switch (packet->opcode) {
	case GLOSS_OP_WRITE_MEMORY:
		sense_write(g, packet, at);
		break;
	case GLOSS_OP_READ_MEMORY:
		sense_read(g, packet, at);
		break;
	case GLOSS_OP_COUNTERS:
		g->answered += GLOSS_COUNTER_WORDS;
		break;
	case GLOSS_OP_COLOUR_SURFACE:
		sense_surface(g, packet, at, &g->colour);
		break;
	case GLOSS_OP_DEPTH_SURFACE:
		sense_surface(g, packet, at, &g->depth);
		break;
	case GLOSS_OP_TILE_BEGIN:
		sense_begin(g, packet, at, "colour", "colour_load", &g->colour);
		sense_begin(g, packet, at, "depth", "depth_load", &g->depth);
		g->in_tile = true;
		break;
	case GLOSS_OP_TILE_END:
		sense_end(g, packet, at, "colour", "colour_output", &g->colour);
		sense_end(g, packet, at, "depth", "depth_output", &g->depth);
		g->in_tile = false;
		break;
	case GLOSS_OP_SCISSOR:
		sense_scissor(g, packet, at);
		break;
	}
}

/* Rows stay in the tile, and are no more than there are words for; the header is before this. */
static void sense_pixels(struct grammar *g, const struct table_record *part, uint32_t at)
{
	uint32_t first = grammar_get(g, part, at, "first_row");
	uint32_t last = grammar_get(g, part, at, "last_row");
	uint32_t sent = GLOSS_SMALL_HEAD_ROWS +
			GLOSS_SMALL_WORD_ROWS * (g->words[at - 1] >> 13 & 7);

	if (last >= sent && !grammar_breaks(g, RULE))
		grammar_put(g, part, at, "last_row", last %= sent);
	if (first + last >= g->tile_size && !grammar_breaks(g, RULE))
		grammar_put(g, part, at, "first_row", first % (g->tile_size - last));
	if (grammar_once(g, 2)) {
		grammar_put(g, part, at, "first_0", 0);
		grammar_put(g, part, at, "last_1", 15);
	}
}

/* Of the parts only edges and rows have a rule; and most shall have pixels. */
void grammar_sense_part(struct grammar *g, const struct table_record *part, uint32_t at)
{
	uint32_t first, last;

	if (strcmp(part->name, "pixels_small") == 0)
		sense_pixels(g, part, at);
	if (strncmp(part->name, "edges", 5) != 0)
		return;
	first = grammar_get(g, part, at, "first_row");
	last = grammar_get(g, part, at, "last_row");
	if (first + last >= g->tile_size && !grammar_breaks(g, RULE)) {
		first %= g->tile_size;
		last = grammar_once(g, 2) ? g->tile_size - 1 - first :
					    last % (g->tile_size - first);
		grammar_put(g, part, at, "first_row", first);
		grammar_put(g, part, at, "last_row", last);
	}
	if (grammar_once(g, 2)) {
		grammar_put(g, part, at, "left_x", grammar_below(g, g->tile_size));
		grammar_put(g, part, at, "left_step", grammar_below(g, 3) - 1);
		grammar_put(g, part, at, "right_x", grammar_below(g, 2 * g->tile_size));
		grammar_put(g, part, at, "right_step", grammar_below(g, 3) - 1);
	}
}
