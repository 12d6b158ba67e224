// SPDX-License-Identifier: MIT
#include <string.h>

#include "stream_random.h"

/*
 * Numbers are drawn one to a statement: in a list of arguments or initialisers
 * compilers differ in which comes first.
 */

#define PAGE 4096u
#define SURFACES 4 /* slots 0 to 3 have room for tiles */
#define PACKET_MAX (1 + GLOSS_LENGTH_MAX)

/* splitmix64 */
uint32_t stream_random_word(struct stream_random *r)
{
	uint64_t z = r->state += 0x9e3779b97f4a7c15u;

	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return (uint32_t)(z >> 32);
}

uint32_t stream_random_below(struct stream_random *r, uint32_t n)
{
	return (uint32_t)((uint64_t)stream_random_word(r) * n >> 32);
}

int32_t stream_random_between(struct stream_random *r, int32_t low, int32_t high)
{
	return low + (int32_t)stream_random_below(r, (uint32_t)(high - low) + 1);
}

bool stream_random_chance(struct stream_random *r, uint32_t percent)
{
	return stream_random_below(r, 100) < percent;
}

#define below stream_random_below
#define between stream_random_between
#define chance stream_random_chance

void stream_random_emit(struct stream_random *r, uint32_t word)
{
	r->words[r->job.stream_words++] = word;
}

static void emit(struct stream_random *r, const uint32_t *words, uint32_t count)
{
	memcpy(r->words + r->job.stream_words, words, 4 * count);
	r->job.stream_words += count;
}

static uint32_t row_bytes(const struct stream_random *r)
{
	return 4 * (uint32_t)r->tile_size;
}

static uint32_t tile_words(const struct stream_random *r)
{
	return (uint32_t)(r->tile_size * r->tile_size);
}

/* ---- slots ---- */

/* One to four tiles, some with a pitch that leaves bytes between rows. */
static uint32_t surface_size(struct stream_random *r)
{
	uint32_t wide = (uint32_t)between(r, 1, 2), high = (uint32_t)between(r, 1, 2);

	return wide * row_bytes(r) * (uint32_t)r->tile_size * high +
	       (chance(r, 30) ? below(r, PAGE) : 0);
}

static enum gloss_rights random_rights(struct stream_random *r)
{
	return chance(r, 75) ? GLOSS_RIGHTS_READ_WRITE : (enum gloss_rights)below(r, 4);
}

/* Slots lie one after the other with a page between, but some share the place of another. */
static void random_slots(struct stream_random *r)
{
	uint32_t base = PAGE;

	for (uint32_t n = 0; n < GLOSS_SLOTS; n++) {
		struct gloss_slot *slot = &r->job.slot[n];

		if (n > 0 && chance(r, 15)) {
			*slot = r->job.slot[below(r, n)];
			slot->size -= below(r, slot->size / 2 + 1);
			slot->rights = random_rights(r);
			continue;
		}
		if (n < SURFACES)
			slot->size = surface_size(r);
		else if (chance(r, 75))
			slot->size = (uint32_t)between(r, 1, 2 * PAGE);
		slot->base = base;
		slot->rights = random_rights(r);
		base += (slot->size + PAGE - 1) / PAGE * PAGE + PAGE;
	}
}

/* A slot with @right and at least @size bytes, or -1. */
static int find_slot(struct stream_random *r, uint32_t right, uint32_t size)
{
	uint32_t first = below(r, GLOSS_SLOTS);

	for (uint32_t n = 0; n < GLOSS_SLOTS; n++) {
		uint32_t slot = (first + n) % GLOSS_SLOTS;

		if ((r->job.slot[slot].rights & right) == right && r->job.slot[slot].size >= size)
			return (int)slot;
	}
	return -1;
}

/* ---- packets between tiles ---- */

static void random_nop(struct stream_random *r)
{
	uint32_t length = below(r, chance(r, 90) ? 5 : 80);

	if (chance(r, 1))
		length = GLOSS_LENGTH_MAX;
	gloss_nop_pack(r->words + r->job.stream_words++, length);
	while (length-- > 0)
		stream_random_emit(r, stream_random_word(r));
}

static uint32_t copy_words(struct stream_random *r)
{
	return chance(r, 80) ? (uint32_t)between(r, 1, 40) : (uint32_t)between(r, 1, 1100);
}

/* Any multiple of 4, often close to where a burst has to be cut. */
static uint32_t copy_offset(struct stream_random *r, int slot, uint32_t bytes)
{
	uint32_t last = (r->job.slot[slot].size - bytes) / 4, offset = below(r, last + 1);

	if (chance(r, 30))
		offset = (offset & ~(PAGE / 4 - 1)) + PAGE / 4 - (uint32_t)between(r, 0, 20);
	if (chance(r, 15))
		offset = last;
	return 4 * (offset > last ? last : offset);
}

static void random_write(struct stream_random *r)
{
	uint32_t count = copy_words(r), words[1 + GLOSS_WRITE_MEMORY_WORDS];
	int slot = find_slot(r, GLOSS_RIGHTS_WRITE, 4 * count);
	struct gloss_write_memory p = { .slot = (uint32_t)slot };

	if (slot < 0)
		return;
	p.offset = copy_offset(r, slot, 4 * count);
	gloss_write_memory_pack(words, &p, GLOSS_WRITE_MEMORY_WORDS + count);
	emit(r, words, 1 + GLOSS_WRITE_MEMORY_WORDS);
	while (count-- > 0)
		stream_random_emit(r, stream_random_word(r));
}

/* Takes response words; false: the job shall not answer that much. */
static bool answer(struct stream_random *r, uint32_t words)
{
	if (words > STREAM_RANDOM_RESPONSE - r->response_used)
		return false;
	r->response_used += words;
	return true;
}

static void random_read(struct stream_random *r)
{
	uint32_t count = copy_words(r), words[1 + GLOSS_READ_MEMORY_WORDS];
	int slot = find_slot(r, GLOSS_RIGHTS_READ, 4 * count);
	struct gloss_read_memory p = { .slot = (uint32_t)slot, .count = count };

	if (slot < 0 || !answer(r, count))
		return;
	p.offset = copy_offset(r, slot, 4 * count);
	gloss_read_memory_pack(words, &p);
	emit(r, words, 1 + GLOSS_READ_MEMORY_WORDS);
}

static void random_counters(struct stream_random *r)
{
	if (answer(r, GLOSS_COUNTER_WORDS))
		gloss_counters_pack(r->words + r->job.stream_words++);
}

/* ---- surfaces and tiles ---- */

/* Bytes from the first to past the last of a tile. */
static uint32_t tile_bytes(const struct stream_random *r, uint32_t pitch)
{
	return ((uint32_t)r->tile_size - 1) * pitch + row_bytes(r);
}

/* Mostly one a tile fits in, because the packet itself takes any. */
static struct stream_surface random_surface(struct stream_random *r)
{
	struct stream_surface surface;

	surface.slot = below(r, chance(r, 97) ? SURFACES : GLOSS_SLOTS);
	surface.pitch = row_bytes(r) * (uint32_t)between(r, 1, 3);
	while (surface.pitch > row_bytes(r) &&
	       tile_bytes(r, surface.pitch) > r->job.slot[surface.slot].size)
		surface.pitch -= row_bytes(r);
	if (chance(r, 3))
		surface.pitch = row_bytes(r) * (1 + below(r, 0xffff / row_bytes(r)));
	return surface;
}

static void random_colour_surface(struct stream_random *r)
{
	uint32_t words[1 + GLOSS_COLOUR_SURFACE_WORDS];
	struct gloss_colour_surface p;

	r->colour = random_surface(r);
	p = (struct gloss_colour_surface){ r->colour.slot, r->colour.pitch };
	gloss_colour_surface_pack(words, &p);
	emit(r, words, 1 + GLOSS_COLOUR_SURFACE_WORDS);
}

static void random_depth_surface(struct stream_random *r)
{
	uint32_t words[1 + GLOSS_DEPTH_SURFACE_WORDS];
	struct gloss_depth_surface p;

	r->depth = chance(r, 10) ? r->colour : random_surface(r);
	if (!r->depth.pitch)
		r->depth = random_surface(r);
	p = (struct gloss_depth_surface){ r->depth.slot, r->depth.pitch };
	gloss_depth_surface_pack(words, &p);
	emit(r, words, 1 + GLOSS_DEPTH_SURFACE_WORDS);
}

static bool tile_fits(const struct stream_random *r, const struct stream_surface *surface,
		      uint32_t right)
{
	const struct gloss_slot *slot = &r->job.slot[surface->slot];

	return surface->pitch && (slot->rights & right) &&
	       tile_bytes(r, surface->pitch) <= slot->size;
}

/* Few places, so that a tile is loaded where another was stored, wholly or by some of its rows. */
static uint32_t tile_offset(struct stream_random *r, const struct stream_surface *surface)
{
	uint32_t unit = row_bytes(r);
	uint32_t last = (r->job.slot[surface->slot].size - tile_bytes(r, surface->pitch)) / unit;
	uint32_t offset = 0;

	switch (below(r, 6)) {
	case 0:
		offset = 1;
		break;
	case 1:
		offset = surface->pitch / unit * (uint32_t)between(r, 1, r->tile_size);
		break;
	case 2:
		offset = below(r, last + 1);
		break;
	default:
		break;
	}
	return unit * (offset > last ? last : offset);
}

static uint32_t clear_depth(struct stream_random *r)
{
	uint32_t stencil = stream_random_word(r) & 0xff000000;

	switch (below(r, 3)) {
	case 0:
		return stencil | 0xffffff;
	case 1:
		return stencil;
	default:
		return stream_random_word(r);
	}
}

static void random_tile_begin(struct stream_random *r)
{
	uint32_t words[1 + GLOSS_TILE_BEGIN_WORDS];
	struct gloss_tile_begin p;

	p.colour = stream_random_word(r);
	p.depth = clear_depth(r);
	p.colour_load = chance(r, 50) && tile_fits(r, &r->colour, GLOSS_RIGHTS_READ);
	p.depth_load = chance(r, 40) && tile_fits(r, &r->depth, GLOSS_RIGHTS_READ);
	if (p.colour_load)
		p.colour = tile_offset(r, &r->colour);
	if (p.depth_load)
		p.depth = tile_offset(r, &r->depth);
	gloss_tile_begin_pack(words, &p);
	emit(r, words, 1 + GLOSS_TILE_BEGIN_WORDS);
}

static enum gloss_tile_output random_output(struct stream_random *r,
					    const struct stream_surface *surface)
{
	if (chance(r, 60) && tile_fits(r, surface, GLOSS_RIGHTS_WRITE))
		return GLOSS_TILE_OUTPUT_STORE;
	if (chance(r, 40) && answer(r, tile_words(r)))
		return GLOSS_TILE_OUTPUT_ANSWER;
	return GLOSS_TILE_OUTPUT_DROP;
}

static void random_tile_end(struct stream_random *r)
{
	uint32_t words[1 + GLOSS_TILE_END_WORDS];
	struct gloss_tile_end p = { .colour_output = random_output(r, &r->colour) };

	p.depth_output = random_output(r, &r->depth);
	if (p.colour_output == GLOSS_TILE_OUTPUT_STORE)
		p.colour = tile_offset(r, &r->colour);
	if (p.depth_output == GLOSS_TILE_OUTPUT_STORE)
		p.depth = tile_offset(r, &r->depth);
	gloss_tile_end_pack(words, &p);
	emit(r, words, 1 + GLOSS_TILE_END_WORDS);
}

/* ---- state ---- */

static void random_depth_state(struct stream_random *r)
{
	struct gloss_depth_state p;

	p.func = (enum gloss_compare)below(r, 8);
	p.write = chance(r, 70);
	gloss_depth_state_pack(r->words + r->job.stream_words++, &p);
}

static void random_colour_mask(struct stream_random *r)
{
	struct gloss_colour_mask p;

	p.red = chance(r, 80);
	p.green = chance(r, 80);
	p.blue = chance(r, 80);
	p.alpha = chance(r, 80);
	gloss_colour_mask_pack(r->words + r->job.stream_words++, &p);
}

/* A range of 0 to @size: all of it, most of it, or any, also an empty one. */
static void random_range(struct stream_random *r, uint32_t size, uint32_t *low, uint32_t *high)
{
	uint32_t any = chance(r, 30) ? size + 1 : size / 4;

	if (chance(r, 20)) {
		*low = 0;
		*high = size;
		return;
	}
	*low = below(r, any);
	*high = size - below(r, any);
}

static void random_scissor(struct stream_random *r)
{
	uint32_t words[1 + GLOSS_SCISSOR_WORDS];
	struct gloss_scissor p;

	random_range(r, (uint32_t)r->tile_size, &p.x0, &p.x1);
	random_range(r, (uint32_t)r->tile_size, &p.y0, &p.y1);
	gloss_scissor_pack(words, &p);
	emit(r, words, 1 + GLOSS_SCISSOR_WORDS);
}

/* ---- a stream ---- */

typedef void (*packet_fn)(struct stream_random *r);

/* Packets that may stand anywhere; the often ones twice. */
static const packet_fn anywhere[] = {
	random_nop,     random_depth_state,    random_depth_state,   random_colour_mask,
	random_scissor, random_colour_surface, random_depth_surface,
};
static const packet_fn between_tiles[] = {
	random_write, random_read, random_counters, random_colour_surface, random_depth_surface,
};

static bool over(const struct stream_random *r)
{
	return r->job.stream_words >= r->budget;
}

static void random_tile(struct stream_random *r)
{
	int triangles = chance(r, 20) ? 0 : between(r, 1, 12);

	random_tile_begin(r);
	while (triangles > 0 && !over(r)) {
		if (chance(r, 25)) {
			anywhere[below(r, sizeof(anywhere) / sizeof(*anywhere))](r);
			continue;
		}
		if (chance(r, 40))
			stream_random_small(r);
		else
			stream_random_triangle(r);
		triangles--;
	}
	random_tile_end(r);
}

static uint32_t random_budget(struct stream_random *r)
{
	if (chance(r, 3))
		return (uint32_t)between(r, 1, STREAM_RANDOM_WORDS - 2 * PACKET_MAX);
	if (chance(r, 5))
		return 0;
	return (uint32_t)between(r, 1, 300);
}

void stream_random_valid(struct stream_random *r, uint64_t seed, int tile_size)
{
	r->job = (struct accel_job){ .stream = r->words };
	r->tile_size = tile_size;
	r->state = seed;
	r->response_used = 0;
	r->colour = r->depth = (struct stream_surface){ 0, 0 };
	random_slots(r);
	r->budget = random_budget(r);
	while (!over(r)) {
		if (chance(r, 40))
			random_tile(r);
		else if (chance(r, 30))
			anywhere[below(r, sizeof(anywhere) / sizeof(*anywhere))](r);
		else
			between_tiles[below(r, sizeof(between_tiles) / sizeof(*between_tiles))](r);
	}
	r->job.response_words = r->response_used + (chance(r, 50) ? 0 : below(r, 100));
}

void stream_random_memory(uint8_t *memory, uint32_t bytes, uint64_t seed)
{
	uint64_t z = seed;

	for (uint32_t n = 0; n < bytes; n++) {
		if (n % 8 == 0)
			z = (z + 0x9e3779b97f4a7c15u) * 0xd1342543de82ef95u;
		memory[n] = (uint8_t)(z >> 8 * (7 - n % 8));
	}
}
