/* SPDX-License-Identifier: MIT */
/* A model with memory and slots, and a job that is put together packet by packet. */
#ifndef TESTS_MODEL_TEST_H
#define TESTS_MODEL_TEST_H

#include "accel_test.h"
#include "model/model.h"

#define MODEL_TEST_MEMORY (512 * 1024)
#define MODEL_TEST_WORDS 4096
#define MODEL_TEST_RESPONSE 32768

struct model_test {
	struct model model;
	struct accel_job job;
	struct gloss_status status;
	uint32_t words[MODEL_TEST_WORDS];
	uint32_t response[MODEL_TEST_RESPONSE];
	uint8_t memory[MODEL_TEST_MEMORY];
};

static inline struct model_test *model_test_new(int tile_size)
{
	struct model_test *t = calloc(1, sizeof(*t));

	assert_non_null(t);
	assert_int_equal(model_init(&t->model, tile_size, t->memory, sizeof(t->memory)), 0);
	t->job.stream = t->words;
	t->job.response = t->response;
	t->job.response_words = MODEL_TEST_RESPONSE;
	return t;
}

/* For cmocka: a fresh struct model_test each test. */
static inline int model_test_setup_64(void **state)
{
	*state = model_test_new(64);
	return 0;
}

static inline int model_test_setup_32(void **state)
{
	*state = model_test_new(32);
	return 0;
}

static inline int model_test_teardown(void **state)
{
	free(*state);
	return 0;
}

#define model_test(name) \
	cmocka_unit_test_setup_teardown(name, model_test_setup_64, model_test_teardown)
#define model_test_32(name) \
	cmocka_unit_test_setup_teardown(name, model_test_setup_32, model_test_teardown)

static inline void set_slot(struct model_test *t, int slot, uint32_t base, uint32_t size,
			    enum gloss_rights rights)
{
	t->job.slot[slot] = (struct gloss_slot){ base, size, rights };
}

static inline uint32_t memory_word(const struct model_test *t, uint32_t address)
{
	const uint8_t *byte = t->memory + address;

	return byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 | (uint32_t)byte[3] << 24;
}

static inline void put(struct model_test *t, uint32_t word)
{
	assert_true(t->job.stream_words < MODEL_TEST_WORDS);
	t->words[t->job.stream_words++] = word;
}

/* put_<packet>(t, (struct gloss_<packet>){ ... }) */
#define PUT_PACKET(packet, length)                                                     \
	static inline void put_##packet(struct model_test *t, struct gloss_##packet p) \
	{                                                                              \
		assert_true(t->job.stream_words + (length) < MODEL_TEST_WORDS);        \
		gloss_##packet##_pack(t->words + t->job.stream_words, &p);             \
		t->job.stream_words += 1 + (length);                                   \
	}

PUT_PACKET(read_memory, GLOSS_READ_MEMORY_WORDS)
PUT_PACKET(colour_surface, GLOSS_COLOUR_SURFACE_WORDS)
PUT_PACKET(depth_surface, GLOSS_DEPTH_SURFACE_WORDS)
PUT_PACKET(tile_begin, GLOSS_TILE_BEGIN_WORDS)
PUT_PACKET(tile_end, GLOSS_TILE_END_WORDS)
PUT_PACKET(depth_state, GLOSS_DEPTH_STATE_WORDS)
PUT_PACKET(colour_mask, GLOSS_COLOUR_MASK_WORDS)
PUT_PACKET(scissor, GLOSS_SCISSOR_WORDS)

/* The header alone: the payload is to be put after it. */
PUT_PACKET(triangle, 0)

/* The header and the two words before the data, which is to be put after them. */
static inline void put_write_memory(struct model_test *t, uint32_t slot, uint32_t offset,
				    uint32_t words)
{
	struct gloss_write_memory p = { slot, offset };

	assert_true(t->job.stream_words + 3 + words <= MODEL_TEST_WORDS);
	gloss_write_memory_pack(t->words + t->job.stream_words, &p, 2 + words);
	t->job.stream_words += 3;
}

static inline void put_counters(struct model_test *t)
{
	gloss_counters_pack(t->words + t->job.stream_words++);
}

/* A triangle over the whole tile in one colour and at one depth, 24 bits. */
static inline void put_cover(struct model_test *t, uint32_t rgb, uint32_t alpha, uint32_t depth)
{
	struct gloss_depth_wide plane = {
		.z = depth << GLOSS_DEPTH_FRACTION,
		.z_high = depth >> (32 - GLOSS_DEPTH_FRACTION),
	};

	put_triangle(t, (struct gloss_triangle){ GLOSS_GEOMETRY_COVERING, GLOSS_SHADING_FLAT, false,
						 alpha });
	gloss_depth_wide_pack(t->words + t->job.stream_words, &plane);
	t->job.stream_words += GLOSS_DEPTH_WIDE_WORDS;
	put(t, rgb);
}

/* Runs what was put; the next packet put begins a new stream. */
static inline void run(struct model_test *t)
{
	t->status = (struct gloss_status){ GLOSS_FAULT_NONE, ~0u, ~0u };
	assert_int_equal(model_run(&t->model, &t->job, &t->status), 0);
}

static inline void run_whole(struct model_test *t)
{
	run(t);
	if (t->status.cause)
		fail_msg("fault %d at word %u", t->status.cause, t->status.offset);
	assert_int_equal(t->status.offset, t->job.stream_words);
	t->job.stream_words = 0;
}

#endif
