/* SPDX-License-Identifier: MIT */
/* Streams to decode, packet by packet, and what the tests of the decoder say of their faults. */
#ifndef DECODE_TEST_H
#define DECODE_TEST_H

#include "accel_test.h"
#include "decode/decode.h"

#define STREAM_MAX 4096

struct stream {
	uint32_t words[STREAM_MAX];
	size_t count;
};

static inline uint32_t *grow(struct stream *s, size_t words)
{
	uint32_t *at = s->words + s->count;

	assert_true(s->count + words <= STREAM_MAX);
	memset(at, 0, words * sizeof(*at));
	s->count += words;
	return at;
}

#define PUT(s, name, ...)                                             \
	gloss_##name##_pack(grow(s, 1 + (size_t)GLOSS_##name##_SIZE), \
			    &(struct gloss_##name){ __VA_ARGS__ })
#define GLOSS_colour_surface_SIZE GLOSS_COLOUR_SURFACE_WORDS
#define GLOSS_depth_surface_SIZE GLOSS_DEPTH_SURFACE_WORDS
#define GLOSS_tile_begin_SIZE GLOSS_TILE_BEGIN_WORDS
#define GLOSS_tile_end_SIZE GLOSS_TILE_END_WORDS
#define GLOSS_read_memory_SIZE GLOSS_READ_MEMORY_WORDS
#define GLOSS_depth_state_SIZE GLOSS_DEPTH_STATE_WORDS
#define GLOSS_colour_mask_SIZE GLOSS_COLOUR_MASK_WORDS
#define GLOSS_scissor_SIZE GLOSS_SCISSOR_WORDS

/* A triangle whose payload is zero, which is valid; returns its header. */
static inline uint32_t *put_triangle(struct stream *s, enum gloss_geometry geometry,
				     enum gloss_shading shading, bool alpha_linear)
{
	struct gloss_triangle p = { geometry, shading, alpha_linear, 0 };
	uint32_t *at = grow(s, 1 + gloss_triangle_length(&p));

	gloss_triangle_pack(at, &p);
	return at;
}

/* The same, small. */
static inline uint32_t *put_small(struct stream *s, enum gloss_shading shading,
				  enum gloss_row_words row_words)
{
	struct gloss_triangle_small p = { shading, row_words, 0 };
	uint32_t *at = grow(s, 1 + gloss_triangle_small_length(&p));

	gloss_triangle_small_pack(at, &p);
	return at;
}

static inline uint32_t *put_write(struct stream *s, uint32_t slot, uint32_t offset, uint32_t words)
{
	uint32_t *at = grow(s, 3 + (size_t)words);

	gloss_write_memory_pack(at, &(struct gloss_write_memory){ slot, offset }, 2 + words);
	return at;
}

static inline void put_nop(struct stream *s, uint32_t length)
{
	gloss_nop_pack(grow(s, 1 + (size_t)length), length);
}

static inline void assert_fault_of(const struct stream *s, unsigned int tile_size,
				   enum gloss_fault fault, uint64_t offset)
{
	struct decode_packet last;

	if (decode_stream(s->words, s->count, tile_size, &last) != fault ||
	    (fault && last.fault_offset != offset))
		fail_msg("fault %s at word %u (%s), not %s at word %u",
			 decode_fault_name(last.fault), (unsigned int)last.fault_offset,
			 last.reason, decode_fault_name(fault), (unsigned int)offset);
	assert_int_equal(fault != 0, last.reason[0] != '\0');
}

#define assert_fault(s, fault, offset) assert_fault_of(s, 0, GLOSS_FAULT_##fault, offset)
#define assert_good(s) assert_fault(s, NONE, 0)

#endif
