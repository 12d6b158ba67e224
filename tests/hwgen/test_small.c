// SPDX-License-Identifier: MIT
/* What the C that hwgen writes does, on small.h and small_regs.h, which have one of everything. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "small.h"
#include "small_regs.h"

static void hwgen_signed_fields_keep_their_sign(void **state)
{
	struct small_place in = { .x = -2048, .y = -1, .whole = INT32_MIN }, out;
	uint32_t words[SMALL_PLACE_WORDS];

	(void)state;
	small_place_pack(words, &in);
	assert_int_equal(words[0], 0x80000fff);
	assert_int_equal(words[1], 0);
	small_place_unpack(words, &out);
	assert_int_equal(out.x, in.x);
	assert_int_equal(out.y, in.y);
	assert_int_equal(out.whole, in.whole);
}

static void hwgen_values_too_wide_stay_in_their_bits(void **state)
{
	struct small_extent p = { .size = ~0u, .size_high = ~0u, .level = ~0u, .mode = ~0u };
	uint32_t words[SMALL_EXTENT_WORDS];

	(void)state;
	small_extent_pack(words, &p);
	assert_int_equal(words[1], 0xf000f0ff);
}

static void hwgen_invalid_finds_the_first_bad_word(void **state)
{
	uint32_t place[] = { 0, 0, 0 };

	(void)state;
	assert_int_equal(small_place_invalid(place), -1);
	place[1] = 1; /* a word without fields */
	assert_int_equal(small_place_invalid(place), 1);
	place[0] = 1u << 15; /* between two fields */
	assert_int_equal(small_place_invalid(place), 0);
}

static void hwgen_invalid_knows_ranges_and_gaps(void **state)
{
	static const struct {
		int32_t x, y;
		int invalid;
	} places[] = { { -100, 100, -1 }, { -101, 0, 0 }, { 0, 101, 0 }, { 2047, -2048, -1 } };
	static const struct {
		uint32_t level;
		unsigned int mode;
		int invalid;
	} extents[] = { { 2, 1, -1 }, { 9, 8, -1 }, { 1, 1, 1 }, { 10, 1, 1 }, { 5, 3, 1 } };
	uint32_t words[3];

	(void)state;
	for (size_t i = 0; i < sizeof(places) / sizeof(places[0]); i++) {
		small_place_pack(words, &(struct small_place){ places[i].x, places[i].y, 0 });
		assert_int_equal(small_place_invalid(words), places[i].invalid);
	}
	for (size_t i = 0; i < sizeof(extents) / sizeof(extents[0]); i++) {
		small_extent_pack(words, &(struct small_extent){
						 .level = extents[i].level,
						 .mode = (enum small_power)extents[i].mode });
		assert_int_equal(small_extent_invalid(words), extents[i].invalid);
	}
}

static void hwgen_headers_have_opcode_length_and_fields(void **state)
{
	struct small_draw in = { SMALL_FORM_BOX, true, 200 }, out;
	struct small_data data = { 0x12345678 };
	uint32_t words[2];

	(void)state;
	small_draw_pack(words, &in);
	assert_int_equal(small_header_opcode(words[0]), SMALL_OP_DRAW);
	assert_int_equal(words[0] & 0x00fff800, 200u << 16 | 1u << 13 | 2u << 11);
	small_draw_unpack(words, &out);
	assert_int_equal(out.form, SMALL_FORM_BOX);
	assert_true(out.plain);
	assert_int_equal(out.count, 200);
	small_data_pack(words, &data, 9);
	assert_int_equal(words[0], 0x02000009);
	assert_int_equal(words[1], 0x12345678);
}

static void hwgen_length_is_the_sum_of_the_parts(void **state)
{
	(void)state;
	assert_int_equal(small_draw_length(&(struct small_draw){ SMALL_FORM_DOT, true, 0 }), 3);
	assert_int_equal(small_draw_length(&(struct small_draw){ SMALL_FORM_DOT, false, 0 }), 5);
	assert_int_equal(small_draw_length(&(struct small_draw){ SMALL_FORM_BOX, false, 7 }), 10);
}

static void hwgen_header_valid_knows_bits_enums_and_ranges(void **state)
{
	(void)state;
	assert_true(small_opcode_known(0xff));
	assert_false(small_opcode_known(0x03));
	assert_true(small_header_valid(0x01000005));
	assert_false(small_header_valid(0x01000805)); /* reserved */
	assert_true(small_header_valid(0xffc83000));
	assert_false(small_header_valid(0xffc93000)); /* count 201 */
	assert_false(small_header_valid(0xffc83800)); /* form 3 */
	assert_false(small_header_valid(0xff004000)); /* reserved */
}

static void hwgen_masks_and_packers_agree(void **state)
{
	uint32_t words[SMALL_ENTRY_WORDS];

	(void)state;
	small_entry_pack(words, &(struct small_entry){ .low = 1, .high = ~0u });
	assert_int_equal(words[SMALL_ENTRY_LOW_WORD], 1);
	assert_int_equal(words[SMALL_ENTRY_HIGH_WORD], SMALL_ENTRY_HIGH);
}

static void hwgen_names_are_those_of_the_values(void **state)
{
	(void)state;
	assert_string_equal(small_power_name(SMALL_POWER_EIGHT), "eight");
	assert_string_equal(small_power_name(3), "unknown");
	assert_string_equal(small_colour_name(SMALL_COLOUR_RED), "red");
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(hwgen_signed_fields_keep_their_sign),
		cmocka_unit_test(hwgen_values_too_wide_stay_in_their_bits),
		cmocka_unit_test(hwgen_invalid_finds_the_first_bad_word),
		cmocka_unit_test(hwgen_invalid_knows_ranges_and_gaps),
		cmocka_unit_test(hwgen_headers_have_opcode_length_and_fields),
		cmocka_unit_test(hwgen_length_is_the_sum_of_the_parts),
		cmocka_unit_test(hwgen_header_valid_knows_bits_enums_and_ranges),
		cmocka_unit_test(hwgen_masks_and_packers_agree),
		cmocka_unit_test(hwgen_names_are_those_of_the_values),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
