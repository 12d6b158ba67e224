// SPDX-License-Identifier: MIT
/* Which faults the decoder finds. */
#include "decode_test.h"

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
	s.count = 0;
	PUT(&s, tile_begin, .colour = 0);
	at = put_small(&s, GLOSS_SHADING_FLAT, GLOSS_ROW_WORDS_ONE);
	PUT(&s, tile_end, .colour = 0);
	at[1] = 28u << 6 | 5u << 12;
	assert_fault_of(&s, 0, GLOSS_FAULT_NONE, 0);
	assert_fault_of(&s, 32, GLOSS_FAULT_VALUE, 4);
}

static void decode_finds_rows_that_were_not_sent(void **state)
{
	struct stream s = { .count = 0 };
	uint32_t *at;

	(void)state;
	PUT(&s, tile_begin, .colour = 0);
	at = put_small(&s, GLOSS_SHADING_LINEAR, GLOSS_ROW_WORDS_ONE);
	PUT(&s, tile_end, .colour = 0);
	at[1] = 5u << 12;
	assert_fault_of(&s, 64, GLOSS_FAULT_NONE, 0);
	at[1] = 6u << 12;
	assert_fault_of(&s, 64, GLOSS_FAULT_VALUE, 4);
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(decode_finds_unknown_opcodes),
		cmocka_unit_test(decode_finds_wrong_lengths),
		cmocka_unit_test(decode_finds_bad_values_in_headers),
		cmocka_unit_test(decode_finds_misaligned_offsets),
		cmocka_unit_test(decode_finds_packets_in_the_wrong_place),
		cmocka_unit_test(decode_finds_surfaces_that_are_not_set),
		cmocka_unit_test(decode_reports_the_first_of_several_faults),
		cmocka_unit_test(decode_checks_what_depends_on_the_tile_size),
		cmocka_unit_test(decode_finds_rows_that_were_not_sent),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
