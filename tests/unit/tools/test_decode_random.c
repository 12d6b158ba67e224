// SPDX-License-Identifier: MIT
/* The decoder agrees with the model on any stream, sane or not. */
#include "decode_test.h"
#include "model/model.h"

static uint64_t seed;

static uint32_t any(void)
{
	return (uint32_t)test_random(&seed);
}

static uint32_t below(uint32_t end)
{
	return test_below(&seed, end);
}

static bool once_in(uint32_t times)
{
	return !below(times);
}

static void put_random_triangle(struct stream *s)
{
	enum gloss_geometry geometry = (enum gloss_geometry)below(3);
	uint32_t *at = put_triangle(s, geometry, (enum gloss_shading)below(3), once_in(2));
	uint32_t rows_word = geometry == GLOSS_GEOMETRY_WIDE ? 3 : 2;

	at[0] |= below(256) << 16;
	if (geometry != GLOSS_GEOMETRY_COVERING)
		at[rows_word] = below(40) << 16 | below(40) << 24;
	at[s->words + s->count - at - 1] = any() & 0xffffff; /* a colour of any shading */
}

static void put_random_small(struct stream *s)
{
	enum gloss_shading shading = (enum gloss_shading)below(3);
	enum gloss_row_words row_words = (enum gloss_row_words)below(5);
	uint32_t *at = put_small(s, shading, row_words), sent = 2 + 4 * (uint32_t)row_words;
	struct gloss_pixels_small pixels = { .x = below(64), .first_row = below(24) };

	pixels.last_row = below(sent + 1);
	at[0] |= below(256) << 16;
	gloss_pixels_small_pack(at + 1, &pixels);
	at[2] = any();
	at[3] = any();
	at[4] = shading == GLOSS_SHADING_FLAT ? any() & 0xffffff : any();
}

/* Mostly in order, mostly valid for a tile of 32. */
static void put_random(struct stream *s, bool *in_tile)
{
	enum gloss_tile_output colour = (enum gloss_tile_output)below(3);
	enum gloss_tile_output depth = (enum gloss_tile_output)below(3);
	uint32_t row = 128 * below(64);

	switch (below(*in_tile ? 8 : 11)) {
	case 0:
		PUT(s, colour_surface, .slot = below(16), .pitch = 128 * (1 + below(4)));
		break;
	case 1:
		PUT(s, depth_surface, .slot = below(16), .pitch = 128 * (1 + below(4)));
		break;
	case 2:
		PUT(s, depth_state, .func = (enum gloss_compare)below(8), .write = once_in(2));
		break;
	case 3:
		PUT(s, scissor, .x0 = below(33), .y0 = below(33), .x1 = below(34), .y1 = below(33));
		break;
	case 4:
		put_nop(s, below(4));
		break;
	case 5:
	case 6:
		if (*in_tile && once_in(3))
			PUT(s, tile_end, colour, depth, colour == GLOSS_TILE_OUTPUT_STORE ? row : 0,
			    depth == GLOSS_TILE_OUTPUT_STORE ? row : 0);
		else if (*in_tile && once_in(2))
			put_random_small(s);
		else if (*in_tile)
			put_random_triangle(s);
		else
			PUT(s, tile_begin, once_in(3), once_in(3), row, row);
		*in_tile = gloss_header_opcode(s->words[s->count - 3]) != GLOSS_OP_TILE_END;
		break;
	case 7:
		PUT(s, colour_mask, once_in(2), once_in(2), once_in(2), once_in(2));
		break;
	case 8:
		gloss_counters_pack(grow(s, 1));
		break;
	case 9:
		put_write(s, below(16), 4 * below(64), 1 + below(6));
		break;
	default:
		PUT(s, read_memory, below(16), 1 + below(9), 4 * below(64));
		break;
	}
}

static void put_random_stream(struct stream *s)
{
	bool in_tile = false;
	uint32_t packets = 1 + below(24);

	s->count = 0;
	while (packets--)
		put_random(s, &in_tile);
	if (in_tile && !once_in(8))
		PUT(s, tile_end, .colour = 0);
	if (once_in(2))
		s->words[below((uint32_t)s->count)] ^= 1u << below(32);
	if (once_in(8))
		s->words[below((uint32_t)s->count)] = any();
	if (once_in(8))
		s->count = below((uint32_t)s->count + 1);
}

#define MEMORY_SIZE 65536
#define RESPONSE_WORDS 65536

static void decode_agrees_with_the_model_on_random_streams(void **state)
{
	static uint32_t memory[MEMORY_SIZE / 4], response[RESPONSE_WORDS];
	static struct model model;
	static struct stream s;
	struct accel_job job = { .stream = s.words,
				 .response = response,
				 .response_words = RESPONSE_WORDS };
	unsigned int found[8] = { 0 };
	struct gloss_status status;
	struct decode_packet last;

	(void)state;
	assert_int_equal(model_init(&model, 32, memory, sizeof(memory)), 0);
	for (unsigned int i = 0; i < GLOSS_SLOTS; i++)
		job.slot[i] = (struct gloss_slot){ 0, MEMORY_SIZE, GLOSS_RIGHTS_READ_WRITE };
	for (int i = 0; i < 4000; i++) {
		put_random_stream(&s);
		job.stream_words = (uint32_t)s.count;
		assert_int_equal(model_run(&model, &job, &status), 0);
		decode_stream(s.words, s.count, 32, &last);
		found[status.cause]++;
		if (status.cause == GLOSS_FAULT_SLOT || status.cause == GLOSS_FAULT_RESPONSE)
			assert_true(!last.fault || last.fault_offset > status.offset);
		else
			assert_fault_of(&s, 32, status.cause, status.offset);
	}
	for (int fault = GLOSS_FAULT_NONE; fault <= GLOSS_FAULT_SLOT; fault++)
		assert_in_range(found[fault], 20, 4000);
}

/* A fault for either size alone is not one for both; one for neither is not one either. */
static void decode_without_a_tile_size_finds_what_both_sizes_find(void **state)
{
	static struct stream s;
	struct decode_packet either, small, large;

	(void)state;
	for (int i = 0; i < 4000; i++) {
		put_random_stream(&s);
		decode_stream(s.words, s.count, 0, &either);
		decode_stream(s.words, s.count, 32, &small);
		decode_stream(s.words, s.count, 64, &large);
		if (!small.fault || !large.fault)
			assert_false(either.fault);
		if (either.fault)
			assert_true(small.fault_offset <= either.fault_offset &&
				    large.fault_offset <= either.fault_offset);
	}
}

static void decode_prints_any_bytes(void **state)
{
	static struct stream s;
	FILE *out = fopen("/dev/null", "w");

	(void)state;
	assert_non_null(out);
	for (int i = 0; i < 20000; i++) {
		struct decode_packet packet;
		struct decode decode;
		size_t at = 0;

		s.count = below(80);
		for (size_t word = 0; word < s.count; word++)
			s.words[word] = any();
		if (s.count)
			s.words[0] &= once_in(2) ? 0x33ffffff : 0x30ff001f;
		decode_init(&decode, 64);
		decode.in_tile = once_in(2);
		while (decode_next(&decode, s.words + at, s.count - at, &packet)) {
			assert_in_range(packet.count, 1, s.count - at);
			decode_print(out, &packet);
			if (packet.fault)
				break;
			at += packet.count;
		}
		assert_true(packet.fault || at == s.count);
		assert_true(packet.fault_offset <= s.count);
	}
	fclose(out);
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(decode_agrees_with_the_model_on_random_streams),
		cmocka_unit_test(decode_without_a_tile_size_finds_what_both_sizes_find),
		cmocka_unit_test(decode_prints_any_bytes),
	};

	seed = test_seed();
	return cmocka_run_group_tests(tests, NULL, NULL);
}
