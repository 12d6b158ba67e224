// SPDX-License-Identifier: MIT
/* Pixels that are read, and bitmaps. */
#include "gl_scene.h"

#include <string.h>

static void pixels_are_read_in_each_form(void **state)
{
	GLubyte bytes[6] = { 9, 9, 9, 9, 9, 9 };
	GLushort packed;
	GLfloat luminance;

	(void)state;
	gl_clear(0xff804020);
	glReadPixels(0, 0, 1, 1, GL_BGR, GL_UNSIGNED_BYTE, bytes);
	assert_int_equal(bytes[0], 0x80);
	assert_int_equal(bytes[2], 0x20);
	assert_int_equal(bytes[3], 9);
	glReadPixels(0, 0, 1, 1, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, &packed);
	assert_int_equal(packed, 4 << 11 | 16 << 5 | 16);
	glReadPixels(0, 0, 1, 1, GL_LUMINANCE, GL_FLOAT, &luminance);
	assert_true(luminance > 0.878f && luminance < 0.879f);
	glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_SHORT_5_6_5, &packed);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	/* Two pixels, of which the first is outside. */
	memset(bytes, 9, sizeof(bytes));
	glPixelStorei(GL_PACK_ALIGNMENT, 1);
	glReadPixels(-1, 0, 2, 1, GL_RED, GL_UNSIGNED_BYTE, bytes);
	assert_int_equal(bytes[0], 9);
	assert_int_equal(bytes[1], 0x20);
}

static void a_bitmap_is_at_the_raster_position(void **state)
{
	static const GLubyte bits[2] = { 0xa0, 0x60 };

	(void)state;
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glColor3f(1, 0, 0);
	glRasterPos2i(10, 20);
	glColor3f(1, 1, 1);
	glBitmap(3, 2, 0, 0, 4, 0, bits);
	glBitmap(3, 2, 0, 0, 4, 0, bits);
	assert_int_equal(gl_pixel(10, 20), RED);
	assert_int_equal(gl_pixel(11, 20), BLACK);
	assert_int_equal(gl_pixel(12, 20), RED);
	assert_int_equal(gl_pixel(11, 21), RED);
	assert_int_equal(gl_pixel(13, 20), BLACK);
	assert_int_equal(gl_pixel(14, 20), RED);
}

static void rows_are_written_as_pixel_store_says(void **state)
{
	static const GLint alignment[] = { 1, 2, 4, 8 }, row[] = { 9, 10, 12, 16 };
	GLubyte bytes[64];

	(void)state;
	gl_clear(0xff804020);
	for (int i = 0; i < 4; i++) {
		memset(bytes, 9, sizeof(bytes));
		glPixelStorei(GL_PACK_ALIGNMENT, alignment[i]);
		glReadPixels(0, 0, 3, 2, GL_RGB, GL_UNSIGNED_BYTE, bytes);
		assert_int_equal(bytes[8], 0x80);
		assert_int_equal(bytes[row[i]], 0x20);
		assert_int_equal(bytes[row[i] + 8], 0x80);
		assert_int_equal(bytes[row[i] + 9], 9);
		if (row[i] > 9)
			assert_int_equal(bytes[9], 9);
	}
	memset(bytes, 9, sizeof(bytes));
	glPixelStorei(GL_PACK_ALIGNMENT, 1);
	glPixelStorei(GL_PACK_ROW_LENGTH, 5);
	glPixelStorei(GL_PACK_SKIP_ROWS, 1);
	glPixelStorei(GL_PACK_SKIP_PIXELS, 2);
	glReadPixels(0, 0, 1, 2, GL_RED, GL_UNSIGNED_BYTE, bytes);
	for (int i = 0; i < 16; i++)
		assert_int_equal(bytes[i], i == 7 || i == 12 ? 0x20 : 9);
}

static void bytes_of_a_number_are_swapped(void **state)
{
	GLushort half;
	GLuint word;

	(void)state;
	gl_clear(0xff804020);
	glPixelStorei(GL_PACK_SWAP_BYTES, 1);
	glReadPixels(0, 0, 1, 1, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, &half);
	assert_int_equal(half, 0x1022);
	glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_INT_8_8_8_8, &word);
	assert_int_equal(word, 0xff804020);
	glPixelStorei(GL_PACK_SWAP_BYTES, 0);
	glReadPixels(0, 0, 1, 1, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, &word);
	assert_int_equal(word, 0xff204080);
}

/* Bits of one row, the second of three that are 40 bits long, from the third bit on. */
static void bits_are_read_as_pixel_store_says(void **state)
{
	GLubyte bits[24] = { 0 };

	(void)state;
	bits[8] = 0x38; /* of a row of 5 bytes at an alignment of 4 */
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 40);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, 1);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 2);
	glRasterPos2i(0, 0);
	glBitmap(4, 1, 0, 0, 0, 0, bits);
	glPixelStorei(GL_UNPACK_LSB_FIRST, 1);
	glRasterPos2i(8, 0);
	glBitmap(4, 1, 0, 0, 0, 0, bits);
	assert_int_equal(gl_pixel(0, 0), WHITE);
	assert_int_equal(gl_pixel(2, 0), WHITE);
	assert_int_equal(gl_pixel(3, 0), BLACK);
	assert_int_equal(gl_pixel(8, 0), BLACK);
	assert_int_equal(gl_pixel(9, 0), WHITE);
	assert_int_equal(gl_pixel(11, 0), WHITE);
}

/* How programs come to where glRasterPos is not valid. */
static void a_bitmap_may_begin_outside(void **state)
{
	static const GLubyte bits[4] = { 0xff };

	(void)state;
	glRasterPos2i(0, 0);
	glBitmap(0, 0, 0, 0, -4, 0, NULL);
	glBitmap(8, 1, 0, 0, 66, 0, bits);
	glBitmap(8, 1, 0, 0, 0, 0, bits);
	assert_int_equal(gl_pixel(3, 0), WHITE);
	assert_int_equal(gl_pixel(4, 0), BLACK);
	assert_int_equal(gl_pixel(61, 0), BLACK);
	assert_int_equal(gl_pixel(62, 0), WHITE);
	assert_int_equal(gl_pixel(63, 0), WHITE);
}

static void nothing_is_at_a_raster_position_that_is_clipped(void **state)
{
	static const GLubyte bits[4] = { 0xff };
	GLfloat before[4], after[4];
	GLboolean valid;

	(void)state;
	glRasterPos2i(-1, 4);
	glGetBooleanv(GL_CURRENT_RASTER_POSITION_VALID, &valid);
	assert_false(valid);
	glGetFloatv(GL_CURRENT_RASTER_POSITION, before);
	glBitmap(8, 1, 0, 0, 5, 0, bits);
	glGetFloatv(GL_CURRENT_RASTER_POSITION, after);
	assert_true(before[0] == after[0]);
	assert_int_equal(gl_pixel(0, 4), BLACK);
	glRasterPos2i(0, 4);
	glBitmap(8, 1, 0, 0, 5, 0, bits);
	assert_int_equal(gl_pixel(7, 4), WHITE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(pixels_are_read_in_each_form),
		TEST(a_bitmap_is_at_the_raster_position),
		TEST(rows_are_written_as_pixel_store_says),
		TEST(bytes_of_a_number_are_swapped),
		TEST(bits_are_read_as_pixel_store_says),
		TEST(a_bitmap_may_begin_outside),
		TEST(nothing_is_at_a_raster_position_that_is_clipped),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
