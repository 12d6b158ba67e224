// SPDX-License-Identifier: MIT
/* The decoder: what it prints, which faults it finds, and that it agrees with the model on any
 * stream, sane or not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "decode/decode.h"
#include "model/model.h"

#define STREAM_MAX 4096

struct stream {
	uint32_t words[STREAM_MAX];
	size_t count;
};

static uint32_t *grow(struct stream *s, size_t words)
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
static uint32_t *put_triangle(struct stream *s, enum gloss_geometry geometry,
			      enum gloss_shading shading, bool alpha_linear)
{
	struct gloss_triangle p = { geometry, shading, alpha_linear, 0 };
	uint32_t *at = grow(s, 1 + gloss_triangle_length(&p));

	gloss_triangle_pack(at, &p);
	return at;
}

static uint32_t *put_write(struct stream *s, uint32_t slot, uint32_t offset, uint32_t words)
{
	uint32_t *at = grow(s, 3 + (size_t)words);

	gloss_write_memory_pack(at, &(struct gloss_write_memory){ slot, offset }, 2 + words);
	return at;
}

static void put_nop(struct stream *s, uint32_t length)
{
	gloss_nop_pack(grow(s, 1 + (size_t)length), length);
}

/* ---- printing ---- */

static char *print_all(const struct stream *s, unsigned int tile_size)
{
	struct decode_packet packet;
	struct decode decode;
	char *text = NULL;
	size_t size = 0, at = 0;
	FILE *out = open_memstream(&text, &size);

	assert_non_null(out);
	decode_init(&decode, tile_size);
	while (decode_next(&decode, s->words + at, s->count - at, &packet)) {
		decode_print(out, &packet);
		if (packet.fault)
			break;
		at += packet.count;
	}
	if (packet.fault)
		decode_print_fault(out, &packet);
	fclose(out);
	return text;
}

static void assert_prints(const struct stream *s, const char *expected)
{
	char *text = print_all(s, 0);

	assert_string_equal(text, expected);
	free(text);
}

static void decode_prints_enums_flags_and_hexadecimal(void **state)
{
	struct stream s = { .count = 0 };

	(void)state;
	PUT(&s, colour_surface, .slot = 3, .pitch = 512);
	PUT(&s, depth_state, .func = GLOSS_COMPARE_LEQUAL, .write = true);
	PUT(&s, tile_begin, .depth_load = false, .colour = 0xff102030, .depth = 0xffffff);
	PUT(&s, tile_end, .colour_output = GLOSS_TILE_OUTPUT_STORE, .colour = 256);
	assert_prints(&s, "      0  08000001  COLOUR_SURFACE\n"
			  "      1  02000003    slot=3 pitch=512\n"
			  "      2  20005800  DEPTH_STATE func=lequal write=yes\n"
			  "      3  10000002  TILE_BEGIN colour_load=no depth_load=no\n"
			  "      4  ff102030    colour=0xff102030\n"
			  "      5  00ffffff    depth=0x00ffffff\n"
			  "      6  11000802  TILE_END colour_output=store depth_output=drop\n"
			  "      7  00000100    colour=0x00000100\n"
			  "      8  00000000    depth=0x00000000\n");
}

static void decode_prints_signs_and_fractions(void **state)
{
	struct stream s = { .count = 0 };
	uint32_t *at;

	(void)state;
	PUT(&s, tile_begin, .colour = 0);
	at = put_triangle(&s, GLOSS_GEOMETRY_COMPACT, GLOSS_SHADING_FLAT, true);
	gloss_edges_compact_pack(at + 1, &(struct gloss_edges_compact){ .left_x = -5,
									.left_step = 127,
									.left_r = 1023,
									.first_row = 3,
									.last_row = 28 });
	gloss_depth_compact_pack(at + 7, &(struct gloss_depth_compact){ 96, -1, INT32_MIN });
	gloss_alpha_linear_pack(at + 10, &(struct gloss_alpha_linear){ 0x00600000, ~0u, 0 });
	gloss_colour_flat_pack(at + 13, &(struct gloss_colour_flat){ 1, 2, 255 });
	PUT(&s, tile_end, .colour = 0);
	assert_prints(
		&s,
		"      0  10000002  TILE_BEGIN colour_load=no depth_load=no\n"
		"      1  00000000    colour=0x00000000\n"
		"      2  00000000    depth=0x00000000\n"
		"      3  3000880d  TRIANGLE geometry=compact shading=flat alpha_linear=yes alpha=0\n"
		"      4  000003ff    edges_compact: left_r=1023 left_m=0 left_dy=0\n"
		"      5  1c037ffb      left_x=-5 left_step=127 first_row=3 last_row=28\n"
		"      6  00000000      right_r=0 right_m=0 right_dy=0\n"
		"      7  00000000      right_x=0 right_step=0 switch_row=0 side=0\n"
		"      8  00000000      middle_r=0 middle_m=0 middle_dy=0\n"
		"      9  00000000      middle_x=0 middle_step=0\n"
		"     10  00000060    depth_compact: z=1.50\n"
		"     11  ffffffff      dx=-0.02\n"
		"     12  80000000      dy=-33554432.00\n"
		"     13  00600000    alpha_linear: a=1.5000000\n"
		"     14  ffffffff      a_dx=-0.0000002\n"
		"     15  00000000      a_dy=0.0000000\n"
		"     16  00ff0201    colour_flat: red=1 green=2 blue=255\n"
		"     17  11000002  TILE_END colour_output=drop depth_output=drop\n"
		"     18  00000000    colour=0x00000000\n"
		"     19  00000000    depth=0x00000000\n");
}

static void decode_prints_a_number_of_two_words_whole(void **state)
{
	struct stream s = { .count = 0 };
	uint32_t *at;
	char *text;

	(void)state;
	PUT(&s, tile_begin, .colour = 0);
	at = put_triangle(&s, GLOSS_GEOMETRY_COVERING, GLOSS_SHADING_FLAT, false);
	gloss_depth_wide_pack(at + 1, &(struct gloss_depth_wide){ .z = 0x800,
								  .z_high = 1,
								  .dx = 0xfffff800,
								  .dx_high = 0xff,
								  .dy_high = 0x80 });
	text = print_all(&s, 0);
	assert_non_null(strstr(text, " z=1048576.5000\n"));
	assert_non_null(strstr(text, " dx=-0.5000\n"));
	assert_non_null(strstr(text, " dy=-134217728.0000\n"));
	assert_non_null(strstr(text, " z_high=0x01 dx_high=0xff dy_high=0x80\n"));
	free(text);
}

static void decode_prints_data_in_rows(void **state)
{
	struct stream s = { .count = 0 };
	uint32_t *at = put_write(&s, 1, 8, 9);

	(void)state;
	at[3] = 7;
	at[11] = 0xdeadbeef;
	assert_prints(
		&s,
		"      0  0100000b  WRITE_MEMORY\n"
		"      1  00000001    slot=1\n"
		"      2  00000008    offset=0x00000008\n"
		"      3  00000007 00000000 00000000 00000000 00000000 00000000 00000000 00000000\n"
		"     11  deadbeef\n");
}

static void decode_prints_a_broken_packet_up_to_its_fault(void **state)
{
	struct stream s = { .count = 0 };

	(void)state;
	PUT(&s, read_memory, .slot = 1, .count = 0, .offset = 3);
	assert_prints(&s, "      0  02000002  READ_MEMORY\n"
			  "      1  00000001    slot=1 count=0\n"
			  "fault VALUE at word 1: count is 0, not 1 to 65535\n");
}

/* ---- faults ---- */

static void assert_fault_of(const struct stream *s, unsigned int tile_size, enum gloss_fault fault,
			    uint64_t offset)
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

static void decode_takes_an_empty_stream(void **state)
{
	struct stream s = { .count = 0 };

	(void)state;
	assert_good(&s);
	assert_prints(&s, "");
}

static void decode_finds_unknown_opcodes(void **state)
{
	struct stream s = { .count = 0 };

	(void)state;
	put_nop(&s, 3);
	*grow(&s, 1) = 0xff000000;
	assert_fault(&s, OPCODE, 4);
}

static void decode_finds_wrong_lengths(void **state)
{
	struct stream nop = { .count = 0 }, mask = nop, write = nop, triangle = nop;

	(void)state;
	put_nop(&nop, 5);
	nop.count--;
	assert_fault(&nop, LENGTH, 0);
	PUT(&mask, colour_mask, .red = true);
	mask.words[0]++;
	grow(&mask, 1);
	assert_fault(&mask, LENGTH, 0);
	put_write(&write, 0, 0, 0);
	assert_fault(&write, LENGTH, 0);
	PUT(&triangle, tile_begin, .colour = 0);
	*put_triangle(&triangle, GLOSS_GEOMETRY_WIDE, GLOSS_SHADING_LINEAR, false) ^= 1;
	grow(&triangle, 8);
	assert_fault(&triangle, LENGTH, 3);
}

static void decode_finds_bad_values_in_headers(void **state)
{
	struct stream reserved = { .count = 0 }, range = reserved;

	(void)state;
	put_nop(&reserved, 0);
	reserved.words[0] |= 1u << 23;
	assert_fault(&reserved, VALUE, 0);
	PUT(&range, tile_begin, .colour = 0);
	put_triangle(&range, GLOSS_GEOMETRY_COVERING, GLOSS_SHADING_FLAT, false);
	range.words[3] |= 3u << 13;
	assert_fault(&range, VALUE, 3);
}

static void decode_finds_misaligned_offsets(void **state)
{
	struct stream write = { .count = 0 }, pitch = write, begin = write, end = write;

	(void)state;
	put_write(&write, 0, 6, 1);
	assert_fault(&write, VALUE, 2);
	PUT(&pitch, depth_surface, .pitch = 64);
	assert_fault(&pitch, VALUE, 1);
	PUT(&begin, colour_surface, .pitch = 256);
	PUT(&begin, tile_begin, .colour_load = true, .colour = 64);
	assert_fault(&begin, VALUE, 3);
	PUT(&end, tile_begin, .colour = 0);
	PUT(&end, tile_end, .depth_output = GLOSS_TILE_OUTPUT_ANSWER, .depth = 128);
	assert_fault(&end, VALUE, 5);
}

static void decode_finds_packets_in_the_wrong_place(void **state)
{
	struct stream twice = { .count = 0 }, copy = twice, counters = twice, end = twice;
	struct stream open = twice;

	(void)state;
	PUT(&twice, tile_begin, .colour = 0);
	PUT(&twice, tile_begin, .colour = 0);
	assert_fault(&twice, ORDER, 3);
	PUT(&copy, tile_begin, .colour = 0);
	put_write(&copy, 0, 0, 1);
	assert_fault(&copy, ORDER, 3);
	PUT(&counters, tile_begin, .colour = 0);
	gloss_counters_pack(grow(&counters, 1));
	assert_fault(&counters, ORDER, 3);
	PUT(&end, tile_end, .colour = 0);
	assert_fault(&end, ORDER, 0);
	PUT(&open, tile_begin, .colour = 0);
	put_nop(&open, 4);
	assert_fault(&open, ORDER, 8);
}

static void decode_finds_surfaces_that_are_not_set(void **state)
{
	struct stream load = { .count = 0 }, store = load;

	(void)state;
	PUT(&load, colour_surface, .pitch = 256);
	PUT(&load, tile_begin, .colour_load = true, .depth_load = true);
	assert_fault(&load, ORDER, 4);
	PUT(&store, depth_surface, .pitch = 256);
	PUT(&store, tile_begin, .colour = 0);
	PUT(&store, tile_end, .colour_output = GLOSS_TILE_OUTPUT_STORE);
	assert_fault(&store, ORDER, 6);
}

static void decode_reports_the_first_of_several_faults(void **state)
{
	struct stream s = { .count = 0 };

	(void)state;
	/* Reserved bit, length, end of stream, place, and a payload value. */
	PUT(&s, tile_begin, .colour = 0);
	PUT(&s, read_memory, .count = 0);
	s.words[3] |= 1u << 20 | 4;
	s.count--;
	assert_fault(&s, VALUE, 3);
	s.words[3] &= ~(1u << 20);
	assert_fault(&s, LENGTH, 3);
	s.words[3] &= ~4u;
	assert_fault(&s, LENGTH, 3);
	s.count++;
	assert_fault(&s, ORDER, 3);
	s.words[0] = 2; /* a NOP */
	assert_fault(&s, VALUE, 4);
}

static void decode_checks_what_depends_on_the_tile_size(void **state)
{
	struct stream s = { .count = 0 };
	uint32_t *at;

	(void)state;
	PUT(&s, colour_surface, .pitch = 128);
	assert_fault_of(&s, 0, GLOSS_FAULT_NONE, 0);
	assert_fault_of(&s, 32, GLOSS_FAULT_NONE, 0);
	assert_fault_of(&s, 64, GLOSS_FAULT_VALUE, 1);
	s.count = 0;
	PUT(&s, scissor, .x1 = 33, .y1 = 64);
	assert_fault_of(&s, 0, GLOSS_FAULT_NONE, 0);
	assert_fault_of(&s, 32, GLOSS_FAULT_VALUE, 1);
	assert_fault_of(&s, 64, GLOSS_FAULT_NONE, 0);
	s.words[1] |= 0x7f;
	assert_fault_of(&s, 0, GLOSS_FAULT_VALUE, 1);
	s.count = 0;
	PUT(&s, tile_begin, .colour = 0);
	at = put_triangle(&s, GLOSS_GEOMETRY_WIDE, GLOSS_SHADING_FLAT, false);
	PUT(&s, tile_end, .colour = 0);
	at[3] = 20u << 16 | 12u << 24;
	assert_fault_of(&s, 0, GLOSS_FAULT_NONE, 0);
	assert_fault_of(&s, 32, GLOSS_FAULT_VALUE, 6);
	assert_fault_of(&s, 64, GLOSS_FAULT_NONE, 0);
	at[3] = 52u << 16 | 12u << 24;
	assert_fault_of(&s, 0, GLOSS_FAULT_VALUE, 6);
}

/* ---- any stream ---- */

static uint64_t seed;

static uint32_t any(void)
{
	seed = seed * 6364136223846793005u + 1442695040888963407u;
	return (uint32_t)(seed >> 32);
}

static uint32_t below(uint32_t end)
{
	return any() % end;
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
		cmocka_unit_test(decode_prints_enums_flags_and_hexadecimal),
		cmocka_unit_test(decode_prints_signs_and_fractions),
		cmocka_unit_test(decode_prints_a_number_of_two_words_whole),
		cmocka_unit_test(decode_prints_data_in_rows),
		cmocka_unit_test(decode_prints_a_broken_packet_up_to_its_fault),
		cmocka_unit_test(decode_takes_an_empty_stream),
		cmocka_unit_test(decode_finds_unknown_opcodes),
		cmocka_unit_test(decode_finds_wrong_lengths),
		cmocka_unit_test(decode_finds_bad_values_in_headers),
		cmocka_unit_test(decode_finds_misaligned_offsets),
		cmocka_unit_test(decode_finds_packets_in_the_wrong_place),
		cmocka_unit_test(decode_finds_surfaces_that_are_not_set),
		cmocka_unit_test(decode_reports_the_first_of_several_faults),
		cmocka_unit_test(decode_checks_what_depends_on_the_tile_size),
		cmocka_unit_test(decode_agrees_with_the_model_on_random_streams),
		cmocka_unit_test(decode_without_a_tile_size_finds_what_both_sizes_find),
		cmocka_unit_test(decode_prints_any_bytes),
	};
	const char *given = getenv("GLOSS_SEED");

	seed = given ? strtoull(given, NULL, 0) : (uint64_t)time(NULL);
	printf("GLOSS_SEED=%llu\n", (unsigned long long)seed);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
