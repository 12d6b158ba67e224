// SPDX-License-Identifier: MIT
/*
 * Every fault and the word it is reported at, one check before another, and what
 * is left of a job after its fault: what came before, and nothing else.
 */
#include "model_test.h"
#include "stream_random.h"

#define HEADER(packet, flags, length) ((uint32_t)GLOSS_OP_##packet << 24 | (flags) | (length))
#define BIT(n) (1u << (n))
#define ANSWER_COLOUR ((uint32_t)GLOSS_TILE_OUTPUT_ANSWER << 11)
#define ANSWER_DEPTH ((uint32_t)GLOSS_TILE_OUTPUT_ANSWER << 13)
#define STORE_COLOUR ((uint32_t)GLOSS_TILE_OUTPUT_STORE << 11)
#define STORE_DEPTH ((uint32_t)GLOSS_TILE_OUTPUT_STORE << 13)
#define TRIANGLE(geometry, shading)                                                      \
	((uint32_t)GLOSS_OP_TRIANGLE << 24 | (uint32_t)GLOSS_GEOMETRY_##geometry << 11 | \
	 (uint32_t)GLOSS_SHADING_##shading << 13)
#define COLOUR_SURFACE(slot, pitch) HEADER(COLOUR_SURFACE, 0, 1), (pitch) << 16 | (slot)
#define DEPTH_SURFACE(slot, pitch) HEADER(DEPTH_SURFACE, 0, 1), (pitch) << 16 | (slot)
#define TILE_BEGIN HEADER(TILE_BEGIN, 0, 2), 0, 0
#define WORDS(...) .words = { __VA_ARGS__ }, .count = sizeof((uint32_t[]){ __VA_ARGS__ }) / 4

/* Slots of every case below; the others are empty. */
enum slots {
	WHOLE, /* one tile of 64 by 64, read and write */
	READ,  /* the same, read only */
	WRITE, /* the same, write only */
	SMALL, /* 100 bytes, read and write */
	ODD,   /* 103 bytes */
	LATE,  /* as WHOLE but four bytes shorter */
};

#define TILE_BYTES (64u * 256u)

struct fault_case {
	const char *name;
	uint32_t words[48];
	size_t count;
	enum gloss_fault fault;
	uint32_t at;   /* from the first of words */
	uint32_t room; /* in the response; 0: plenty */
	int tile_size; /* 0: 64 */
};

static const struct fault_case cases[] = {
	/* opcodes */
	{ "opcode 04", WORDS(0x04000000), GLOSS_FAULT_OPCODE, 0 },
	{ "opcode ff", WORDS(0xff000000), GLOSS_FAULT_OPCODE, 0 },
	{ "opcode before reserved bits", WORDS(0x05fff800), GLOSS_FAULT_OPCODE, 0 },
	{ "opcode before length", WORDS(0x06000005), GLOSS_FAULT_OPCODE, 0 },

	/* header bits */
	{ "nop reserved", WORDS(HEADER(NOP, BIT(11), 0)), GLOSS_FAULT_VALUE, 0 },
	{ "nop reserved high", WORDS(HEADER(NOP, BIT(23), 0)), GLOSS_FAULT_VALUE, 0 },
	{ "tile_begin reserved", WORDS(HEADER(TILE_BEGIN, BIT(13), 2), 0, 0), GLOSS_FAULT_VALUE,
	  0 },
	{ "tile_end reserved", WORDS(TILE_BEGIN, HEADER(TILE_END, BIT(15), 2), 0, 0),
	  GLOSS_FAULT_VALUE, 3 },
	{ "tile_end colour output 3", WORDS(TILE_BEGIN, HEADER(TILE_END, 3u << 11, 2), 0, 0),
	  GLOSS_FAULT_VALUE, 3 },
	{ "tile_end depth output 3", WORDS(TILE_BEGIN, HEADER(TILE_END, 3u << 13, 2), 0, 0),
	  GLOSS_FAULT_VALUE, 3 },
	{ "depth_state reserved", WORDS(HEADER(DEPTH_STATE, BIT(15), 0)), GLOSS_FAULT_VALUE, 0 },
	{ "colour_mask reserved", WORDS(HEADER(COLOUR_MASK, BIT(15), 0)), GLOSS_FAULT_VALUE, 0 },
	{ "triangle geometry 3", WORDS(TILE_BEGIN, HEADER(TRIANGLE, 3u << 11, 0)),
	  GLOSS_FAULT_VALUE, 3 },
	{ "triangle shading 3", WORDS(TILE_BEGIN, HEADER(TRIANGLE, 3u << 13, 0)), GLOSS_FAULT_VALUE,
	  3 },
	{ "header bits before length", WORDS(HEADER(COUNTERS, BIT(20), 1)), GLOSS_FAULT_VALUE, 0 },
	{ "header bits before order", WORDS(HEADER(TILE_END, BIT(20), 2), 0, 0), GLOSS_FAULT_VALUE,
	  0 },

	/* length */
	{ "write_memory without data", WORDS(HEADER(WRITE_MEMORY, 0, 2), WHOLE, 0),
	  GLOSS_FAULT_LENGTH, 0 },
	{ "write_memory without offset", WORDS(HEADER(WRITE_MEMORY, 0, 1), WHOLE),
	  GLOSS_FAULT_LENGTH, 0 },
	{ "read_memory too long", WORDS(HEADER(READ_MEMORY, 0, 3), 0x10000, 0, 0),
	  GLOSS_FAULT_LENGTH, 0 },
	{ "counters too long", WORDS(HEADER(COUNTERS, 0, 1), 0), GLOSS_FAULT_LENGTH, 0 },
	{ "surface too short", WORDS(HEADER(COLOUR_SURFACE, 0, 0)), GLOSS_FAULT_LENGTH, 0 },
	{ "scissor too long", WORDS(HEADER(SCISSOR, 0, 2), 0, 0), GLOSS_FAULT_LENGTH, 0 },
	{ "triangle too short", WORDS(TILE_BEGIN, TRIANGLE(COVERING, FLAT) | 4, 0, 0, 0, 0),
	  GLOSS_FAULT_LENGTH, 3 },
	{ "triangle too long", WORDS(TILE_BEGIN, TRIANGLE(COVERING, FLAT) | 6, 0, 0, 0, 0, 0, 0),
	  GLOSS_FAULT_LENGTH, 3 },
	{ "triangle without its alpha",
	  WORDS(TILE_BEGIN, TRIANGLE(COVERING, FLAT) | BIT(15) | 5, 0, 0, 0, 0, 0),
	  GLOSS_FAULT_LENGTH, 3 },
	{ "nop past the end", WORDS(HEADER(NOP, 0, 4), 0, 0, 0), GLOSS_FAULT_LENGTH, 0 },
	{ "longest nop past the end", WORDS(HEADER(NOP, 0, GLOSS_LENGTH_MAX)), GLOSS_FAULT_LENGTH,
	  0 },
	{ "scissor past the end", WORDS(HEADER(SCISSOR, 0, 1)), GLOSS_FAULT_LENGTH, 0 },
	{ "length before order", WORDS(HEADER(TILE_END, 0, 3), 0, 0, 0), GLOSS_FAULT_LENGTH, 0 },
	{ "end of stream before order", WORDS(HEADER(TILE_END, 0, 2), 0), GLOSS_FAULT_LENGTH, 0 },
	{ "end of stream before values", WORDS(HEADER(READ_MEMORY, 0, 2), 0xfff0),
	  GLOSS_FAULT_LENGTH, 0 },

	/* order */
	{ "write_memory in a tile", WORDS(TILE_BEGIN, HEADER(WRITE_MEMORY, 0, 3), WHOLE, 0, 0),
	  GLOSS_FAULT_ORDER, 3 },
	{ "read_memory in a tile", WORDS(TILE_BEGIN, HEADER(READ_MEMORY, 0, 2), 0x10000, 0),
	  GLOSS_FAULT_ORDER, 3 },
	{ "counters in a tile", WORDS(TILE_BEGIN, HEADER(COUNTERS, 0, 0)), GLOSS_FAULT_ORDER, 3 },
	{ "tile in a tile", WORDS(TILE_BEGIN, TILE_BEGIN), GLOSS_FAULT_ORDER, 3 },
	{ "tile_end outside", WORDS(HEADER(TILE_END, 0, 2), 0, 0), GLOSS_FAULT_ORDER, 0 },
	{ "triangle outside", WORDS(TRIANGLE(COVERING, FLAT) | 5, 0, 0, 0, 0, 0), GLOSS_FAULT_ORDER,
	  0 },
	{ "end in a tile", WORDS(TILE_BEGIN), GLOSS_FAULT_ORDER, 3 },
	{ "order before values", WORDS(TILE_BEGIN, HEADER(READ_MEMORY, 0, 2), 0xfff0, 1),
	  GLOSS_FAULT_ORDER, 3 },
	{ "order before room", WORDS(TILE_BEGIN, HEADER(COUNTERS, 0, 0)), GLOSS_FAULT_ORDER, 3,
	  .room = 1 },

	/* values */
	{ "write_memory reserved", WORDS(HEADER(WRITE_MEMORY, 0, 3), BIT(4), 0, 0),
	  GLOSS_FAULT_VALUE, 1 },
	{ "write_memory misaligned", WORDS(HEADER(WRITE_MEMORY, 0, 3), WHOLE, 2, 0),
	  GLOSS_FAULT_VALUE, 2 },
	{ "read_memory reserved", WORDS(HEADER(READ_MEMORY, 0, 2), 0x10000 | BIT(15), 0),
	  GLOSS_FAULT_VALUE, 1 },
	{ "read_memory of nothing", WORDS(HEADER(READ_MEMORY, 0, 2), WHOLE, 0), GLOSS_FAULT_VALUE,
	  1 },
	{ "read_memory misaligned", WORDS(HEADER(READ_MEMORY, 0, 2), 0x10000, 1), GLOSS_FAULT_VALUE,
	  2 },
	{ "colour_surface reserved", WORDS(HEADER(COLOUR_SURFACE, 0, 1), 256u << 16 | BIT(4)),
	  GLOSS_FAULT_VALUE, 1 },
	{ "colour_surface without pitch", WORDS(COLOUR_SURFACE(WHOLE, 0u)), GLOSS_FAULT_VALUE, 1 },
	{ "colour_surface pitch", WORDS(COLOUR_SURFACE(WHOLE, 128u)), GLOSS_FAULT_VALUE, 1 },
	{ "depth_surface pitch", WORDS(DEPTH_SURFACE(WHOLE, 257u)), GLOSS_FAULT_VALUE, 1 },
	{ "depth_surface pitch of 32", WORDS(DEPTH_SURFACE(WHOLE, 128u), DEPTH_SURFACE(WHOLE, 64u)),
	  GLOSS_FAULT_VALUE, 3, .tile_size = 32 },
	{ "tile_begin colour misaligned",
	  WORDS(COLOUR_SURFACE(WHOLE, 256u), HEADER(TILE_BEGIN, BIT(11), 2), 128, 0),
	  GLOSS_FAULT_VALUE, 3 },
	{ "tile_begin depth misaligned",
	  WORDS(DEPTH_SURFACE(WHOLE, 256u), HEADER(TILE_BEGIN, BIT(12), 2), 1, 4),
	  GLOSS_FAULT_VALUE, 4 },
	{ "tile_end colour misaligned",
	  WORDS(COLOUR_SURFACE(WHOLE, 256u), TILE_BEGIN, HEADER(TILE_END, STORE_COLOUR, 2), 64, 0),
	  GLOSS_FAULT_VALUE, 6 },
	{ "tile_end drop with an offset", WORDS(TILE_BEGIN, HEADER(TILE_END, 0, 2), 256, 0),
	  GLOSS_FAULT_VALUE, 4 },
	{ "tile_end answer with an offset",
	  WORDS(TILE_BEGIN, HEADER(TILE_END, ANSWER_DEPTH, 2), 0, 256), GLOSS_FAULT_VALUE, 5 },
	{ "scissor reserved", WORDS(HEADER(SCISSOR, 0, 1), BIT(31)), GLOSS_FAULT_VALUE, 1 },
	{ "scissor x0", WORDS(HEADER(SCISSOR, 0, 1), 65), GLOSS_FAULT_VALUE, 1 },
	{ "scissor y0", WORDS(HEADER(SCISSOR, 0, 1), 65u << 8), GLOSS_FAULT_VALUE, 1 },
	{ "scissor x1", WORDS(HEADER(SCISSOR, 0, 1), 65u << 16), GLOSS_FAULT_VALUE, 1 },
	{ "scissor y1", WORDS(HEADER(SCISSOR, 0, 1), 65u << 24), GLOSS_FAULT_VALUE, 1 },
	{ "scissor x1 of 32",
	  WORDS(HEADER(SCISSOR, 0, 1), 32u << 16, HEADER(SCISSOR, 0, 1), 33u << 16),
	  GLOSS_FAULT_VALUE, 3, .tile_size = 32 },
	{ "scissor y1 of 32",
	  WORDS(HEADER(SCISSOR, 0, 1), 32u << 24, HEADER(SCISSOR, 0, 1), 33u << 24),
	  GLOSS_FAULT_VALUE, 3, .tile_size = 32 },
	{ "edges_wide reserved",
	  WORDS(TILE_BEGIN, TRIANGLE(WIDE, FLAT) | 14, 0, 0, 0, 0, 0, 0, 0, 0, BIT(16), 0, 0, 0, 0,
		0),
	  GLOSS_FAULT_VALUE, 12 },
	{ "edges_wide rows",
	  WORDS(TILE_BEGIN, TRIANGLE(WIDE, FLAT) | 14, 0, 0, 1u << 16 | 63u << 24, 0, 0, 0, 0, 0, 0,
		0, 0, 0, 0, 0),
	  GLOSS_FAULT_VALUE, 6 },
	{ "edges_wide rows of 32",
	  WORDS(TILE_BEGIN, TRIANGLE(WIDE, FLAT) | 14, 0, 0, 31u << 16 | 1u << 24, 0, 0, 0, 0, 0, 0,
		0, 0, 0, 0, 0),
	  GLOSS_FAULT_VALUE, 6, .tile_size = 32 },
	{ "edges_wide rows before a later word",
	  WORDS(TILE_BEGIN, TRIANGLE(WIDE, FLAT) | 14, 0, 0, 1u << 16 | 63u << 24, BIT(31), 0, 0, 0,
		0, 0, 0, 0, 0, 0, 0),
	  GLOSS_FAULT_VALUE, 6 },
	{ "edges_wide earlier word before rows",
	  WORDS(TILE_BEGIN, TRIANGLE(WIDE, FLAT) | 14, BIT(13), 0, 1u << 16 | 63u << 24, 0, 0, 0, 0,
		0, 0, 0, 0, 0, 0, 0),
	  GLOSS_FAULT_VALUE, 4 },
	{ "edges_compact reserved",
	  WORDS(TILE_BEGIN, TRIANGLE(COMPACT, FLAT) | 10, 0, 0, 0, 0, BIT(30), 0, 0, 0, 0, 0),
	  GLOSS_FAULT_VALUE, 8 },
	{ "edges_compact rows",
	  WORDS(TILE_BEGIN, TRIANGLE(COMPACT, FLAT) | 10, 0, 16u << 16 | 16u << 24, 0, 0, 0, 0, 0,
		0, 0, 0),
	  GLOSS_FAULT_VALUE, 5, .tile_size = 32 },
	{ "depth_wide reserved",
	  WORDS(TILE_BEGIN, TRIANGLE(COVERING, FLAT) | 5, 0, 0, 0, BIT(24), 0), GLOSS_FAULT_VALUE,
	  7 },
	{ "depth_wide after edges",
	  WORDS(TILE_BEGIN, TRIANGLE(WIDE, FLAT) | 14, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, BIT(31),
		0),
	  GLOSS_FAULT_VALUE, 16 },
	{ "colour_flat reserved",
	  WORDS(TILE_BEGIN, TRIANGLE(COVERING, FLAT) | 5, 0, 0, 0, 0, BIT(24)), GLOSS_FAULT_VALUE,
	  8 },
	{ "colour_flat after alpha",
	  WORDS(TILE_BEGIN, TRIANGLE(COMPACT, FLAT) | BIT(15) | 13, 0, 0, 0, 0, 0, 0, 0, 0, 0, ~0u,
		~0u, ~0u, BIT(31)),
	  GLOSS_FAULT_VALUE, 16 },
	{ "values of the first word before the second",
	  WORDS(HEADER(WRITE_MEMORY, 0, 3), SMALL | BIT(31), 3, 0), GLOSS_FAULT_VALUE, 1 },
	{ "misaligned before surface", WORDS(HEADER(TILE_BEGIN, BIT(11), 2), 4, 0),
	  GLOSS_FAULT_VALUE, 1 },
	{ "misaligned before slot", WORDS(HEADER(READ_MEMORY, 0, 2), 0x10000 | WRITE, 0x40000001),
	  GLOSS_FAULT_VALUE, 2 },

	/* surfaces that are not set */
	{ "load without colour surface",
	  WORDS(DEPTH_SURFACE(WHOLE, 256u), HEADER(TILE_BEGIN, BIT(11), 2), 0, 0),
	  GLOSS_FAULT_ORDER, 3 },
	{ "load without depth surface",
	  WORDS(COLOUR_SURFACE(WHOLE, 256u), HEADER(TILE_BEGIN, BIT(11) | BIT(12), 2), 0, 0),
	  GLOSS_FAULT_ORDER, 4 },
	{ "store without colour surface",
	  WORDS(DEPTH_SURFACE(WHOLE, 256u), TILE_BEGIN, HEADER(TILE_END, STORE_COLOUR, 2), 0, 0),
	  GLOSS_FAULT_ORDER, 6 },
	{ "store without depth surface",
	  WORDS(COLOUR_SURFACE(WHOLE, 256u), TILE_BEGIN, HEADER(TILE_END, STORE_DEPTH, 2), 0, 0),
	  GLOSS_FAULT_ORDER, 7 },
	{ "colour before depth",
	  WORDS(COLOUR_SURFACE(WRITE, 256u), HEADER(TILE_BEGIN, BIT(11) | BIT(12), 2), 0, 1),
	  GLOSS_FAULT_SLOT, 3 },

	/* slots */
	{ "write without right", WORDS(HEADER(WRITE_MEMORY, 0, 3), READ, 0, 0), GLOSS_FAULT_SLOT,
	  2 },
	{ "read without right", WORDS(HEADER(READ_MEMORY, 0, 2), 0x10000 | WRITE, 0),
	  GLOSS_FAULT_SLOT, 2 },
	{ "empty slot", WORDS(HEADER(READ_MEMORY, 0, 2), 0x10000 | 15, 0), GLOSS_FAULT_SLOT, 2 },
	{ "write past the slot", WORDS(HEADER(WRITE_MEMORY, 0, 4), SMALL, 96, 0, 0),
	  GLOSS_FAULT_SLOT, 2 },
	{ "read past the slot", WORDS(HEADER(READ_MEMORY, 0, 2), 2u << 16 | SMALL, 96),
	  GLOSS_FAULT_SLOT, 2 },
	{ "read past a slot of odd size", WORDS(HEADER(READ_MEMORY, 0, 2), 1u << 16 | ODD, 100),
	  GLOSS_FAULT_SLOT, 2 },
	{ "read that starts past the slot", WORDS(HEADER(READ_MEMORY, 0, 2), 1u << 16 | SMALL, 100),
	  GLOSS_FAULT_SLOT, 2 },
	{ "write whose end wraps", WORDS(HEADER(WRITE_MEMORY, 0, 3), WHOLE, 0xfffffffc, 0),
	  GLOSS_FAULT_SLOT, 2 },
	{ "read whose end wraps", WORDS(HEADER(READ_MEMORY, 0, 2), 0xffff0000u | WHOLE, 0xfffffffc),
	  GLOSS_FAULT_SLOT, 2 },
	{ "load without right",
	  WORDS(COLOUR_SURFACE(WRITE, 256u), HEADER(TILE_BEGIN, BIT(11), 2), 0, 0),
	  GLOSS_FAULT_SLOT, 3 },
	{ "load four bytes past the slot",
	  WORDS(DEPTH_SURFACE(LATE, 256u), HEADER(TILE_BEGIN, BIT(12), 2), 0, 0), GLOSS_FAULT_SLOT,
	  4 },
	{ "load a row past the slot",
	  WORDS(COLOUR_SURFACE(WHOLE, 256u), HEADER(TILE_BEGIN, BIT(11), 2), 256, 0),
	  GLOSS_FAULT_SLOT, 3 },
	{ "load with too large a pitch",
	  WORDS(COLOUR_SURFACE(WHOLE, 0xff00u), HEADER(TILE_BEGIN, BIT(11), 2), 0, 0),
	  GLOSS_FAULT_SLOT, 3 },
	{ "load whose end wraps",
	  WORDS(COLOUR_SURFACE(WHOLE, 0xff00u), HEADER(TILE_BEGIN, BIT(11), 2), 0xffffff00, 0),
	  GLOSS_FAULT_SLOT, 3 },
	{ "store without right",
	  WORDS(DEPTH_SURFACE(READ, 256u), TILE_BEGIN, HEADER(TILE_END, STORE_DEPTH, 2), 0, 0),
	  GLOSS_FAULT_SLOT, 7 },
	{ "store past the slot",
	  WORDS(COLOUR_SURFACE(WHOLE, 256u), TILE_BEGIN, HEADER(TILE_END, STORE_COLOUR, 2), 256, 0),
	  GLOSS_FAULT_SLOT, 6 },
	{ "slot before room", WORDS(HEADER(READ_MEMORY, 0, 2), 10u << 16 | WRITE, 0),
	  GLOSS_FAULT_SLOT, 2, .room = 5 },

	/* the response */
	{ "room for counters", WORDS(HEADER(COUNTERS, 0, 0)), GLOSS_FAULT_RESPONSE, 0, .room = 3 },
	{ "room for read_memory", WORDS(HEADER(READ_MEMORY, 0, 2), 5u << 16, 0),
	  GLOSS_FAULT_RESPONSE, 2, .room = 4 },
	{ "room after an answer",
	  WORDS(HEADER(COUNTERS, 0, 0), HEADER(READ_MEMORY, 0, 2), 5u << 16, 0),
	  GLOSS_FAULT_RESPONSE, 3, .room = 8 },
	{ "room for colour", WORDS(TILE_BEGIN, HEADER(TILE_END, ANSWER_COLOUR, 2), 0, 0),
	  GLOSS_FAULT_RESPONSE, 4, .room = 4095 },
	{ "room for depth", WORDS(TILE_BEGIN, HEADER(TILE_END, ANSWER_DEPTH, 2), 0, 0),
	  GLOSS_FAULT_RESPONSE, 5, .room = 4095 },
	{ "room for depth after colour",
	  WORDS(TILE_BEGIN, HEADER(TILE_END, ANSWER_COLOUR | ANSWER_DEPTH, 2), 0, 0),
	  GLOSS_FAULT_RESPONSE, 5, .room = 8191 },
	{ "room for a tile of 32",
	  WORDS(TILE_BEGIN, HEADER(TILE_END, ANSWER_COLOUR, 2), 0, 0, TILE_BEGIN,
		HEADER(TILE_END, ANSWER_COLOUR, 2), 0, 0),
	  GLOSS_FAULT_RESPONSE, 10, .room = 2047, .tile_size = 32 },
	{ "colour's room before depth's value",
	  WORDS(TILE_BEGIN, HEADER(TILE_END, ANSWER_COLOUR, 2), 0, 1), GLOSS_FAULT_RESPONSE, 4,
	  .room = 1 },
};

static void default_slots(struct model_test *t)
{
	memset(t->job.slot, 0, sizeof(t->job.slot));
	set_slot(t, WHOLE, 4096, TILE_BYTES, GLOSS_RIGHTS_READ_WRITE);
	set_slot(t, READ, 4096, TILE_BYTES, GLOSS_RIGHTS_READ);
	set_slot(t, WRITE, 4096, TILE_BYTES, GLOSS_RIGHTS_WRITE);
	set_slot(t, SMALL, 4096, 100, GLOSS_RIGHTS_READ_WRITE);
	set_slot(t, ODD, 4096, 103, GLOSS_RIGHTS_READ_WRITE);
	set_slot(t, LATE, 4096, TILE_BYTES - 4, GLOSS_RIGHTS_READ_WRITE);
}

/* The case's words, between a write and others that must and must not happen. */
static uint32_t put_case(struct model_test *t, const struct fault_case *c, bool more)
{
	uint32_t first;

	t->job.stream_words = 0;
	put_write_memory(t, WHOLE, 0x100, 1);
	put(t, 0x600d);
	first = t->job.stream_words;
	for (size_t n = 0; n < c->count; n++)
		put(t, c->words[n]);
	if (more) {
		put_write_memory(t, WHOLE, 0x104, 1);
		put(t, 0xbad);
		put_counters(t);
	}
	return first;
}

static bool needs_the_end(const struct fault_case *c)
{
	return c->fault == GLOSS_FAULT_LENGTH || strstr(c->name, "end in a tile");
}

static void run_case(const struct fault_case *c, bool more)
{
	struct model_test *t = model_test_new(c->tile_size ? c->tile_size : 64);
	uint32_t first;

	default_slots(t);
	if (c->room)
		t->job.response_words = c->room;
	first = put_case(t, c, more);
	run(t);
	if (t->status.cause != c->fault || t->status.offset != first + c->at)
		fail_msg("%s: fault %d at word %d, not %d at %d", c->name, t->status.cause,
			 (int)(t->status.offset - first), c->fault, (int)c->at);
	for (uint32_t a = 0; a < sizeof(t->memory); a += 4)
		assert_int_equal(memory_word(t, a), a == 4096 + 0x100 ? 0x600d : 0);
	for (uint32_t n = t->status.response_words; n < MODEL_TEST_RESPONSE; n++)
		assert_int_equal(t->response[n], 0);
	assert_true(t->status.response_words <= t->job.response_words);
	free(t);
}

static void fault_is_reported_at_its_word(void **state)
{
	(void)state;
	for (size_t n = 0; n < sizeof(cases) / sizeof(*cases); n++)
		run_case(&cases[n], false);
}

static void nothing_after_a_fault_is_executed(void **state)
{
	(void)state;
	for (size_t n = 0; n < sizeof(cases) / sizeof(*cases); n++)
		if (!needs_the_end(&cases[n]))
			run_case(&cases[n], true);
}

/* Cases that lack but one word of room. */
static void room_that_is_just_enough_is_no_fault(void **state)
{
	(void)state;
	for (size_t n = 0; n < sizeof(cases) / sizeof(*cases); n++) {
		struct fault_case c = cases[n];
		struct model_test *t = model_test_new(c.tile_size ? c.tile_size : 64);

		if (c.fault == GLOSS_FAULT_RESPONSE && c.room > 1) {
			default_slots(t);
			t->job.response_words = c.room + 1;
			put_case(t, &c, false);
			run_whole(t);
			assert_int_equal(t->status.response_words, c.room + 1);
		}
		free(t);
	}
}

static void tile_is_dropped_at_a_fault(void **state)
{
	struct model_test *t = *state;

	default_slots(t);
	put_colour_surface(t, (struct gloss_colour_surface){ .slot = WHOLE, .pitch = 256 });
	put_tile_begin(t, (struct gloss_tile_begin){ .colour = 0x12345678 });
	put(t, 0xff000000);
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_STORE });
	run(t);
	assert_int_equal(t->status.cause, GLOSS_FAULT_OPCODE);
	for (uint32_t a = 0; a < sizeof(t->memory); a += 4)
		assert_int_equal(memory_word(t, a), 0);
}

static void answers_before_a_fault_are_valid(void **state)
{
	struct model_test *t = *state;

	put_counters(t);
	put_tile_begin(t, (struct gloss_tile_begin){ .colour = 0x12345678 });
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_ANSWER });
	put_tile_begin(t, (struct gloss_tile_begin){ 0 });
	run(t);
	assert_int_equal(t->status.cause, GLOSS_FAULT_ORDER);
	assert_int_equal(t->status.offset, 10);
	assert_int_equal(t->status.response_words, 4 + 64 * 64);
	assert_int_equal(t->response[4 + 64 * 64 - 1], 0x12345678);
}

/* A valid job gives the same on a model that ran damaged ones and on one that never ran. */
static void next_job_is_not_changed_by_a_fault(void **state)
{
	static struct stream_random damaged, valid;
	static struct model_test used, fresh;
	uint64_t seed = test_seed();

	(void)state;
	assert_int_equal(model_init(&used.model, 64, used.memory, MODEL_TEST_MEMORY), 0);
	for (int n = 0; n < 200; n++, seed++) {
		uint32_t *response = malloc(4 * STREAM_RANDOM_RESPONSE * 2 + 800);

		assert_non_null(response);
		stream_random_valid(&damaged, seed, 64);
		stream_random_damage(&damaged);
		damaged.job.response = response;
		model_run(&used.model, &damaged.job, &used.status);
		stream_random_valid(&valid, seed + 1000, 64);
		memcpy(fresh.memory, used.memory, MODEL_TEST_MEMORY);
		model_init(&fresh.model, 64, fresh.memory, MODEL_TEST_MEMORY);
		valid.job.response = response;
		model_run(&used.model, &valid.job, &used.status);
		valid.job.response = response + STREAM_RANDOM_RESPONSE + 100;
		model_run(&fresh.model, &valid.job, &fresh.status);
		assert_memory_equal(&used.status, &fresh.status, sizeof(used.status));
		assert_int_equal(used.status.cause, GLOSS_FAULT_NONE);
		assert_memory_equal(response, valid.job.response, 4 * used.status.response_words);
		assert_memory_equal(used.memory, fresh.memory, MODEL_TEST_MEMORY);
		free(response);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(fault_is_reported_at_its_word),
		cmocka_unit_test(nothing_after_a_fault_is_executed),
		cmocka_unit_test(room_that_is_just_enough_is_no_fault),
		model_test(tile_is_dropped_at_a_fault),
		model_test(answers_before_a_fault_are_valid),
		cmocka_unit_test(next_job_is_not_changed_by_a_fault),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
