// SPDX-License-Identifier: MIT
/* What the decoder prints of a stream. */
#include "decode_test.h"

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

static void decode_prints_a_small_triangle(void **state)
{
	struct stream s = { .count = 0 };
	uint32_t *at;
	char *text;

	(void)state;
	PUT(&s, tile_begin, .colour = 0);
	at = put_small(&s, GLOSS_SHADING_LINEAR, GLOSS_ROW_WORDS_ONE);
	gloss_pixels_small_pack(at + 1,
				&(struct gloss_pixels_small){ .x = 9, .last_row = 2, .last_0 = 3 });
	gloss_depth_small_pack(at + 2, &(struct gloss_depth_small){ 24, -2, 3, 1 });
	gloss_colour_linear_small_pack(at + 4,
				       &(struct gloss_colour_linear_small){
					       .red = -1, .blue_dx = -4, .slope_scale = 2 });
	at[8] = 0x00004030;
	text = print_all(&s, 0);
	assert_non_null(strstr(text, " TRIANGLE_SMALL shading=linear row_words=one alpha=0\n"));
	assert_non_null(strstr(text, " pixels_small: x=9 first_row=0 last_row=2 first_0=0 last_0=3 "
				     "first_1=0 last_1=0\n"));
	assert_non_null(strstr(text, " depth_small: z=1.50\n"));
	assert_non_null(strstr(text, " dx=-2 dy=3 scale=1\n"));
	assert_non_null(
		strstr(text, " colour_linear_small: red=-1 green=0 blue=0 slope_scale=2\n"));
	assert_non_null(strstr(text, " blue_fraction=0 blue_dx=-4 blue_dy=0\n"));
	assert_non_null(strstr(text, " rows_one: rows_2=0x00004030\n"));
	free(text);
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

static void decode_takes_an_empty_stream(void **state)
{
	struct stream s = { .count = 0 };

	(void)state;
	assert_good(&s);
	assert_prints(&s, "");
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(decode_prints_enums_flags_and_hexadecimal),
		cmocka_unit_test(decode_prints_signs_and_fractions),
		cmocka_unit_test(decode_prints_a_small_triangle),
		cmocka_unit_test(decode_prints_a_number_of_two_words_whole),
		cmocka_unit_test(decode_prints_data_in_rows),
		cmocka_unit_test(decode_prints_a_broken_packet_up_to_its_fault),
		cmocka_unit_test(decode_takes_an_empty_stream),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
