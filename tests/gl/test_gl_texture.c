// SPDX-License-Identifier: MIT
/* Images of textures: what is kept of what a program gives, and what it is told. */
#include "gl_scene.h"

#include <string.h>

static GLint level_parameter(GLenum target, GLint level, GLenum pname)
{
	GLint value = -1;

	glGetTexLevelParameteriv(target, level, pname, &value);
	return value;
}

static void get_texels(GLenum target, uint8_t *texels)
{
	glPixelStorei(GL_PACK_ALIGNMENT, 1);
	glGetTexImage(target, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

/* Table 3.15, and 6.1 on the way back. */
static void a_base_format_keeps_its_components(void **state)
{
	static const uint8_t given[4] = { 10, 20, 30, 40 };
	static const struct {
		GLint internal;
		uint8_t back[4];
		GLenum size;
	} format[] = {
		{ GL_ALPHA, { 0, 0, 0, 40 }, GL_TEXTURE_ALPHA_SIZE },
		{ 1, { 10, 0, 0, 255 }, GL_TEXTURE_LUMINANCE_SIZE },
		{ GL_LUMINANCE16, { 10, 0, 0, 255 }, GL_TEXTURE_LUMINANCE_SIZE },
		{ 2, { 10, 0, 0, 40 }, GL_TEXTURE_LUMINANCE_SIZE },
		{ GL_INTENSITY8, { 10, 0, 0, 255 }, GL_TEXTURE_INTENSITY_SIZE },
		{ 3, { 10, 20, 30, 255 }, GL_TEXTURE_BLUE_SIZE },
		{ GL_RGB5_A1, { 10, 20, 30, 40 }, GL_TEXTURE_ALPHA_SIZE },
		{ GL_COMPRESSED_RGBA, { 10, 20, 30, 40 }, GL_TEXTURE_RED_SIZE },
	};
	uint8_t back[4];

	(void)state;
	for (size_t i = 0; i < sizeof(format) / sizeof(format[0]); i++) {
		glTexImage2D(GL_TEXTURE_2D, 0, format[i].internal, 1, 1, 0, GL_RGBA,
			     GL_UNSIGNED_BYTE, given);
		get_texels(GL_TEXTURE_2D, back);
		assert_memory_equal(back, format[i].back, 4);
		assert_int_equal(level_parameter(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT),
				 format[i].internal);
		assert_int_equal(level_parameter(GL_TEXTURE_2D, 0, format[i].size), 8);
		assert_int_equal(level_parameter(GL_TEXTURE_2D, 0, GL_TEXTURE_DEPTH_SIZE), 0);
	}
}

static void a_luminance_that_is_asked_for_is_red(void **state)
{
	static const uint8_t given[4] = { 10, 20, 30, 40 };
	uint8_t back[2] = { 0, 0 };

	(void)state;
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, given);
	glGetTexImage(GL_TEXTURE_2D, 0, GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE, back);
	assert_int_equal(back[0], 10);
	assert_int_equal(back[1], 40);
}

static void images_are_unpacked_as_they_lie(void **state)
{
	static const GLushort packed[2] = { 0xf800, 0x001f }; /* red, blue */
	static const uint8_t rows[] = { 9, 9, 9, 9, 1, 2, 3, 9, 4, 5, 6, 9 };
	uint8_t back[4][4];

	(void)state;
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2, 1, 0, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, packed);
	get_texels(GL_TEXTURE_2D, back[0]);
	assert_memory_equal(back[0], ((uint8_t[]){ 255, 0, 0, 255, 0, 0, 255, 255 }), 8);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, 1);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 1);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 3);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, rows);
	get_texels(GL_TEXTURE_2D, back[0]);
	assert_int_equal(back[0][0], 2);
	assert_int_equal(back[1][2], 3);
	assert_int_equal(back[2][1], 5);
	assert_int_equal(back[3][0], 6);
}

static void an_image_of_three_dimensions_has_slices(void **state)
{
	uint8_t given[2][4][2] = { { { 0 } } }, part = 77, back[2][2][2][4];

	(void)state;
	for (int z = 0; z < 2; z++)
		for (int y = 0; y < 2; y++)
			for (int x = 0; x < 2; x++)
				given[z][y][x] = (uint8_t)(100 * z + 10 * y + x);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, 4);
	glTexImage3D(GL_TEXTURE_3D, 0, GL_LUMINANCE, 2, 2, 2, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE,
		     given);
	glTexSubImage3D(GL_TEXTURE_3D, 0, 1, 0, 1, 1, 1, 1, GL_RED, GL_UNSIGNED_BYTE, &part);
	get_texels(GL_TEXTURE_3D, back[0][0][0]);
	assert_int_equal(back[0][1][1][0], 11);
	assert_int_equal(back[1][1][0][0], 110);
	assert_int_equal(back[1][0][1][0], 77);
	assert_int_equal(level_parameter(GL_TEXTURE_3D, 0, GL_TEXTURE_DEPTH), 2);
}

static void a_cube_has_six_faces(void **state)
{
	uint8_t back[4];

	(void)state;
	for (GLenum face = 0; face < 6; face++) {
		const uint8_t given = (uint8_t)(40 * face);

		glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGB, 1, 1, 0, GL_RED,
			     GL_UNSIGNED_BYTE, &given);
	}
	get_texels(GL_TEXTURE_CUBE_MAP_NEGATIVE_Z, back);
	assert_int_equal(back[0], 200);
	get_texels(GL_TEXTURE_CUBE_MAP_NEGATIVE_X, back);
	assert_int_equal(back[0], 40);
	glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X, 0, GL_RGB, 2, 1, 0, GL_RED, GL_UNSIGNED_BYTE,
		     back);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glTexImage2D(GL_TEXTURE_CUBE_MAP, 0, GL_RGB, 1, 1, 0, GL_RED, GL_UNSIGNED_BYTE, back);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

/* Of any size, with one level. */
static void a_rectangle_is_not_repeated(void **state)
{
	static const uint8_t given[3][4] = { { 1 }, { 2 }, { 3 } };
	uint8_t back[3][4];
	GLint wrap;

	(void)state;
	glTexImage2D(GL_TEXTURE_RECTANGLE, 0, GL_RGB, 3, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, given);
	get_texels(GL_TEXTURE_RECTANGLE, back[0]);
	assert_int_equal(back[2][0], 3);
	glTexImage2D(GL_TEXTURE_RECTANGLE, 1, GL_RGB, 3, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, given);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glTexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_WRAP_S, GL_REPEAT);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glTexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glGetTexParameteriv(GL_TEXTURE_RECTANGLE, GL_TEXTURE_WRAP_S, &wrap);
	assert_int_equal(wrap, GL_CLAMP_TO_EDGE);
	glTexImage2D(GL_PROXY_TEXTURE_RECTANGLE, 0, GL_RGB, 2049, 1, 0, GL_RGB, GL_FLOAT, NULL);
	assert_int_equal(level_parameter(GL_PROXY_TEXTURE_RECTANGLE, 0, GL_TEXTURE_WIDTH), 0);
}

static void parts_are_replaced(void **state)
{
	static const uint8_t zero[4][4] = { { 0 } }, two[2] = { 50, 60 };
	uint8_t back[16][4];

	(void)state;
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, 4, 4, 0, GL_RED, GL_UNSIGNED_BYTE, zero);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 1, 2, 2, 1, GL_RED, GL_UNSIGNED_BYTE, two);
	get_texels(GL_TEXTURE_2D, back[0]);
	assert_int_equal(back[4 * 2 + 1][0], 50);
	assert_int_equal(back[4 * 2 + 2][0], 60);
	assert_int_equal(back[4 * 2 + 3][0], 0);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 3, 2, 2, 1, GL_RED, GL_UNSIGNED_BYTE, two);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glTexSubImage2D(GL_TEXTURE_2D, 0, -1, 2, 2, 1, GL_RED, GL_UNSIGNED_BYTE, two);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glTexSubImage2D(GL_TEXTURE_2D, 3, 0, 0, 1, 1, GL_RED, GL_UNSIGNED_BYTE, two);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
}

/* The first texels of an image with a border are at -1. */
static void a_border_is_part_of_the_image(void **state)
{
	static const uint8_t given[4] = { 1, 2, 3, 4 }, edge = 9;
	uint8_t back[4][4];

	(void)state;
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexImage1D(GL_TEXTURE_1D, 0, GL_LUMINANCE, 4, 1, GL_RED, GL_UNSIGNED_BYTE, given);
	glTexSubImage1D(GL_TEXTURE_1D, 0, -1, 1, GL_RED, GL_UNSIGNED_BYTE, &edge);
	get_texels(GL_TEXTURE_1D, back[0]);
	assert_int_equal(back[0][0], 9);
	assert_int_equal(back[1][0], 2);
	assert_int_equal(level_parameter(GL_TEXTURE_1D, 0, GL_TEXTURE_BORDER), 1);
	assert_int_equal(level_parameter(GL_TEXTURE_1D, 0, GL_TEXTURE_WIDTH), 4);
}

static void what_is_no_image_is_an_error(void **state)
{
	static const struct {
		GLint level, internal;
		GLsizei width, height;
		GLint border;
		GLenum format, type, error;
	} call[] = {
		{ -1, 4, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, GL_INVALID_VALUE },
		{ 12, 4, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, GL_INVALID_VALUE },
		{ 0, 5, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, GL_INVALID_VALUE },
		{ 0, 4, 3, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, GL_INVALID_VALUE },
		{ 0, 4, -1, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, GL_INVALID_VALUE },
		{ 0, 4, 4096, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, GL_INVALID_VALUE },
		{ 0, 4, 4, 4, 2, GL_RGBA, GL_UNSIGNED_BYTE, GL_INVALID_VALUE },
		{ 0, 4, 4, 4, 0, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, GL_INVALID_ENUM },
		{ 0, 4, 4, 4, 0, GL_RGBA, GL_BITMAP, GL_INVALID_ENUM },
		{ 0, 4, 4, 4, 0, GL_RGB, GL_UNSIGNED_SHORT_4_4_4_4, GL_INVALID_OPERATION },
		{ 0, 4, 4, 4, 0, GL_DEPTH_COMPONENT, GL_FLOAT, GL_INVALID_OPERATION },
		{ 0, GL_DEPTH_COMPONENT, 4, 4, 0, GL_RGBA, GL_FLOAT, GL_INVALID_OPERATION },
	};

	(void)state;
	for (size_t i = 0; i < sizeof(call) / sizeof(call[0]); i++) {
		glTexImage2D(GL_TEXTURE_2D, call[i].level, call[i].internal, call[i].width,
			     call[i].height, call[i].border, call[i].format, call[i].type, NULL);
		assert_int_equal(glGetError(), call[i].error);
		assert_int_equal(level_parameter(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH), 0);
	}
}

/* gluBuild2DMipmaps halves until a proxy has a size. */
static void a_proxy_says_what_fits(void **state)
{
	(void)state;
	glTexImage2D(GL_PROXY_TEXTURE_2D, 0, GL_RGB, 2048, 1024, 0, GL_RGB, GL_FLOAT, NULL);
	assert_int_equal(level_parameter(GL_PROXY_TEXTURE_2D, 0, GL_TEXTURE_WIDTH), 2048);
	assert_int_equal(level_parameter(GL_PROXY_TEXTURE_2D, 0, GL_TEXTURE_GREEN_SIZE), 8);
	glTexImage2D(GL_PROXY_TEXTURE_2D, 0, GL_RGB, 4096, 4096, 0, GL_RGB, GL_FLOAT, NULL);
	assert_int_equal(level_parameter(GL_PROXY_TEXTURE_2D, 0, GL_TEXTURE_WIDTH), 0);
	assert_int_equal(level_parameter(GL_PROXY_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT), 0);
	assert_int_equal(glGetError(), GL_NO_ERROR);
	glNewList(1, GL_COMPILE);
	glTexImage3D(GL_PROXY_TEXTURE_3D, 0, GL_RGB, 8, 4, 2, 0, GL_RGB, GL_FLOAT, NULL);
	glEndList();
	assert_int_equal(level_parameter(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_DEPTH), 2);
	glTexSubImage2D(GL_PROXY_TEXTURE_2D, 0, 0, 0, 1, 1, GL_RGB, GL_FLOAT, NULL);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

static void a_list_keeps_the_pixels(void **state)
{
	uint8_t given[4][2] = { { 1, 2 }, { 3, 4 } }, back[4][4];

	(void)state;
	glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
	glNewList(1, GL_COMPILE);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, 1, 2, 0, GL_RED, GL_UNSIGNED_BYTE, given);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 1, 1, 1, GL_RED, GL_UNSIGNED_BYTE, &given[1][1]);
	glEndList();
	memset(given, 0, sizeof(given));
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 1);
	assert_int_equal(level_parameter(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH), 0);
	glCallList(1);
	get_texels(GL_TEXTURE_2D, back[0]);
	assert_int_equal(back[0][0], 1);
	assert_int_equal(back[1][0], 4);
}

static void what_was_drawn_is_copied(void **state)
{
	uint8_t back[16][4];

	(void)state;
	glColor3f(1, 0, 0);
	square(8, 0);
	glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 6, 6, 4, 4, 0);
	get_texels(GL_TEXTURE_2D, back[0]);
	assert_int_equal(back[0][0], 0);
	assert_int_equal(back[2][0], 255);
	assert_int_equal(back[4 + 3][0], 255);
	assert_int_equal(back[8 + 3][0], 0);
	glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 8, 0, 1, 1);
	get_texels(GL_TEXTURE_2D, back[0]);
	assert_int_equal(back[0][0], 255);
	glCopyTexImage2D(GL_TEXTURE_2D, 0, 4, 0, 0, 4, 4, 0);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 3, 0, 0, 0, 2, 1);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
}

static void smaller_images_are_made(void **state)
{
	static const uint8_t given[8] = { 0, 100, 20, 40, 200, 100, 0, 0 };
	uint8_t back[2][4];

	(void)state;
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, 4, 2, 0, GL_RED, GL_UNSIGNED_BYTE, given);
	assert_int_equal(level_parameter(GL_TEXTURE_2D, 1, GL_TEXTURE_WIDTH), 2);
	assert_int_equal(level_parameter(GL_TEXTURE_2D, 2, GL_TEXTURE_WIDTH), 1);
	assert_int_equal(level_parameter(GL_TEXTURE_2D, 3, GL_TEXTURE_WIDTH), 0);
	glGetTexImage(GL_TEXTURE_2D, 1, GL_RGBA, GL_UNSIGNED_BYTE, back);
	assert_int_equal(back[0][0], 100);
	assert_int_equal(back[1][0], 15);
}

static void pixels_are_transferred_on_their_way(void **state)
{
	static const uint8_t index[2] = { 1, 3 }, bits = 0x40;
	static const GLfloat red[4] = { 0, 0.2f, 0.4f, 1 };
	uint8_t back[2][4];
	GLfloat map[4];

	(void)state;
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glPixelMapfv(GL_PIXEL_MAP_I_TO_R, 4, red);
	glTexImage1D(GL_TEXTURE_1D, 0, GL_RGB, 2, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, index);
	get_texels(GL_TEXTURE_1D, back[0]);
	assert_int_equal(back[0][0], 51);
	assert_int_equal(back[1][0], 255);
	glPixelTransferi(GL_INDEX_OFFSET, 2);
	glTexImage1D(GL_TEXTURE_1D, 0, GL_RGB, 2, 0, GL_COLOR_INDEX, GL_BITMAP, &bits);
	glPixelTransferi(GL_INDEX_OFFSET, 0);
	get_texels(GL_TEXTURE_1D, back[0]);
	assert_int_equal(back[0][0], 102);
	assert_int_equal(back[1][0], 255);
	glPixelTransferf(GL_RED_SCALE, 0.5f);
	glPixelTransferf(GL_GREEN_BIAS, 1);
	get_texels(GL_TEXTURE_1D, back[0]);
	assert_int_equal(back[1][0], 128);
	assert_int_equal(back[1][1], 255);
	glGetPixelMapfv(GL_PIXEL_MAP_I_TO_R, map);
	assert_memory_equal(map, red, sizeof(map));
	glPixelMapfv(GL_PIXEL_MAP_I_TO_R, 3, red);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glPixelTransferf(GL_ZOOM_X, 1);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

static void depths_are_images_too(void **state)
{
	static const GLfloat given[2] = { 0.25f, 1 };
	GLuint back[2];

	(void)state;
	glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 2, 1, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
		     given);
	glGetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, back);
	assert_int_equal(back[0] >> 24, 0x40);
	assert_int_equal(back[1], 0xffffffff);
	assert_int_equal(level_parameter(GL_TEXTURE_2D, 0, GL_TEXTURE_DEPTH_SIZE), 24);
	glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_INT, back);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
}

static void there_are_no_compressed_images(void **state)
{
	GLint formats = -1;

	(void)state;
	glGetIntegerv(GL_NUM_COMPRESSED_TEXTURE_FORMATS, &formats);
	assert_int_equal(formats, 0);
	glCompressedTexImage2D(GL_TEXTURE_2D, 0, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, 4, 4, 0, 8, NULL);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glGetCompressedTexImage(GL_TEXTURE_2D, 0, &formats);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	assert_int_equal(level_parameter(GL_TEXTURE_2D, 0, GL_TEXTURE_COMPRESSED), GL_FALSE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_base_format_keeps_its_components),
		TEST(a_luminance_that_is_asked_for_is_red),
		TEST(images_are_unpacked_as_they_lie),
		TEST(an_image_of_three_dimensions_has_slices),
		TEST(a_cube_has_six_faces),
		TEST(a_rectangle_is_not_repeated),
		TEST(parts_are_replaced),
		TEST(a_border_is_part_of_the_image),
		TEST(what_is_no_image_is_an_error),
		TEST(a_proxy_says_what_fits),
		TEST(a_list_keeps_the_pixels),
		TEST(what_was_drawn_is_copied),
		TEST(smaller_images_are_made),
		TEST(pixels_are_transferred_on_their_way),
		TEST(depths_are_images_too),
		TEST(there_are_no_compressed_images),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
