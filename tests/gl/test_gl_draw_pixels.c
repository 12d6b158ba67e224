// SPDX-License-Identifier: MIT
/* Rectangles of pixels from memory and from the surface, written at once or drawn under tests. */
#include "gl_scene.h"

static const GLubyte four[4][4] = {
	{ 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 }, { 255, 255, 255, 255 }
};

/* Two rows of two pixels: red and green, above them blue and white. */
static void draw_four(int x, int y)
{
	glWindowPos2i(x, y);
	glDrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, four);
}

static void assert_four(int x, int y)
{
	assert_int_equal(gl_pixel(x, y), RED);
	assert_int_equal(gl_pixel(x + 1, y), GREEN);
	assert_int_equal(gl_pixel(x, y + 1), BLUE);
	assert_int_equal(gl_pixel(x + 1, y + 1), WHITE);
	assert_int_equal(gl_pixel(x - 1, y), BLACK);
	assert_int_equal(gl_pixel(x + 2, y), BLACK);
	assert_int_equal(gl_pixel(x, y + 2), BLACK);
}

static void pixels_lie_at_the_raster_position(void **state)
{
	(void)state;
	draw_four(5, 9);
	assert_four(5, 9);
	/* By runs, which a depth test makes of them. */
	gl_clear(BLACK);
	glEnable(GL_DEPTH_TEST);
	draw_four(5, 9);
	assert_four(5, 9);
	/* Half a pixel further their centres are still the same. */
	glDisable(GL_DEPTH_TEST);
	gl_clear(BLACK);
	glWindowPos2f(5.4f, 8.6f);
	glDrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, four);
	assert_four(5, 9);
}

static void zoom_repeats_and_turns_pixels(void **state)
{
	(void)state;
	for (int tested = 0; tested < 2; tested++) {
		if (tested)
			glEnable(GL_DEPTH_TEST);
		gl_clear(BLACK);
		glPixelZoom(3, 2);
		draw_four(10, 10);
		assert_int_equal(gl_pixel(12, 11), RED);
		assert_int_equal(gl_pixel(13, 11), GREEN);
		assert_int_equal(gl_pixel(15, 13), WHITE);
		assert_int_equal(gl_pixel(16, 13), BLACK);
		assert_int_equal(gl_pixel(15, 14), BLACK);
		glPixelZoom(-1, -1);
		draw_four(30, 30);
		assert_int_equal(gl_pixel(29, 29), RED);
		assert_int_equal(gl_pixel(28, 29), GREEN);
		assert_int_equal(gl_pixel(29, 28), BLUE);
		assert_int_equal(gl_pixel(30, 30), BLACK);
		glPixelZoom(0.5f, 1);
		draw_four(40, 40);
		assert_int_equal(gl_pixel(41, 40), BLACK);
		glPixelZoom(1, 1);
	}
}

static void what_is_out_of_view_is_cut(void **state)
{
	(void)state;
	glRasterPos2i(0, 0);
	glBitmap(0, 0, 0, 0, -1, -1, NULL);
	glDrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, four);
	assert_int_equal(gl_pixel(0, 0), WHITE);
	assert_int_equal(gl_pixel(1, 0), BLACK);
	draw_four(SIZE - 1, SIZE - 1);
	assert_int_equal(gl_pixel(SIZE - 1, SIZE - 1), RED);
	draw_four(3 * SIZE, 0);
	/* A raster position out of view is none. */
	glRasterPos2i(-1, 0);
	glDrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, four);
	assert_int_equal(gl_pixel(1, 0), BLACK);
}

static void scissor_and_masks_hold(void **state)
{
	(void)state;
	glEnable(GL_SCISSOR_TEST);
	glScissor(6, 0, 1, SIZE);
	draw_four(5, 5);
	assert_int_equal(gl_pixel(5, 5), BLACK);
	assert_int_equal(gl_pixel(6, 5), GREEN);
	glDisable(GL_SCISSOR_TEST);
	glColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_TRUE);
	draw_four(20, 20);
	assert_int_equal(gl_pixel(20, 20), RED);
	assert_int_equal(gl_pixel(21, 20), BLACK);
	assert_int_equal(gl_pixel(21, 21), RED);
}

/* The fragments have the depth of the raster position. */
static void colours_are_tested_by_depth(void **state)
{
	(void)state;
	glClear(GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glColor3f(1, 1, 1);
	glWindowPos3f(5, 5, 0.5f);
	glDrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, four);
	glWindowPos3f(6, 5, 0.75f);
	glDrawPixels(2, 2, GL_RGBA, GL_UNSIGNED_BYTE, four);
	assert_int_equal(gl_pixel(6, 5), GREEN);
	assert_int_equal(gl_pixel(7, 5), GREEN);
}

static void depths_are_drawn_in_the_raster_colour(void **state)
{
	static const GLfloat depth[2] = { 0.25f, 0.75f };
	GLfloat back[3] = { 0 };

	(void)state;
	glClearDepth(0.5);
	glClear(GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glColor3f(1, 0, 0);
	glWindowPos2i(5, 5);
	glDrawPixels(2, 1, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
	assert_int_equal(gl_pixel(5, 5), RED);
	assert_int_equal(gl_pixel(6, 5), BLACK);
	glReadPixels(5, 5, 2, 1, GL_DEPTH_COMPONENT, GL_FLOAT, back);
	assert_float_equal(back[0], 0.25f, 1e-6f);
	assert_float_equal(back[1], 0.5f, 1e-6f);
	/* As programs bring back depths that they have read. */
	glDepthFunc(GL_ALWAYS);
	glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
	glPixelTransferf(GL_DEPTH_SCALE, 0.5f);
	glDrawPixels(2, 1, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
	glPixelTransferf(GL_DEPTH_SCALE, 1);
	glReadPixels(5, 5, 3, 1, GL_DEPTH_COMPONENT, GL_FLOAT, back);
	assert_float_equal(back[0], 0.125f, 1e-6f);
	assert_float_equal(back[1], 0.375f, 1e-6f);
	assert_float_equal(back[2], 0.5f, 1e-6f);
}

static void what_was_drawn_is_copied(void **state)
{
	(void)state;
	draw_four(5, 5);
	glWindowPos2i(20, 20);
	glCopyPixels(5, 5, 2, 2, GL_COLOR);
	assert_four(20, 20);
	/* One pixel further over itself: all is read before. */
	glWindowPos2i(6, 5);
	glCopyPixels(5, 5, 2, 2, GL_COLOR);
	assert_int_equal(gl_pixel(5, 5), RED);
	assert_int_equal(gl_pixel(6, 5), RED);
	assert_int_equal(gl_pixel(7, 5), GREEN);
	/* What lies out of the surface is not copied. */
	draw_four(0, 0);
	glWindowPos2i(40, 40);
	glCopyPixels(-1, 0, 3, 2, GL_COLOR);
	assert_four(41, 40);
	glCopyPixels(0, 0, 1, 1, GL_RGBA);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glCopyPixels(0, 0, -1, 1, GL_COLOR);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glCopyPixels(0, 0, 1, 1, GL_STENCIL);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
}

static void the_raster_position_is_lit(void **state)
{
	static const GLfloat light[4] = { 0, 0, 1, 0 }, blue[4] = { 0, 0, 1, 1 };
	static const GLfloat black[4] = { 0, 0, 0, 1 };
	GLfloat colour[4];

	(void)state;
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, light);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
	glMaterialfv(GL_FRONT, GL_DIFFUSE, blue);
	glNormal3f(0, 0, 1);
	glRasterPos2i(9, 9);
	glGetFloatv(GL_CURRENT_RASTER_COLOR, colour);
	assert_float_equal(colour[0], 0, 1e-3f);
	assert_float_equal(colour[2], 1, 1e-3f);
	glNormal3f(0, 0, -1);
	glRasterPos2i(9, 9);
	glGetFloatv(GL_CURRENT_RASTER_COLOR, colour);
	assert_float_equal(colour[2], 0, 1e-3f);
	assert_int_equal(gl_pixel(9, 9), BLACK);
}

static void there_is_no_accumulation_buffer(void **state)
{
	GLint bits = -1;

	(void)state;
	glGetIntegerv(GL_ACCUM_RED_BITS, &bits);
	assert_int_equal(bits, 0);
	glAccum(GL_LOAD, 1);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glAccum(GL_COLOR, 1);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
}

static void all_formats_are_drawn(void **state)
{
	static const GLushort packed[1] = { 0x07e0 };
	static const GLfloat bgr[3] = { 0, 0, 2 };
	static const GLubyte grey[2] = { 255, 0 }, bits = 0x80;
	static const GLfloat green[2] = { 0, 1 };

	(void)state;
	glWindowPos2i(1, 1);
	glDrawPixels(1, 1, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, packed);
	assert_int_equal(gl_pixel(1, 1), GREEN);
	glDrawPixels(1, 1, GL_BGR, GL_FLOAT, bgr);
	assert_int_equal(gl_pixel(1, 1), RED);
	glDrawPixels(1, 1, GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE, grey);
	assert_int_equal(gl_pixel(1, 1), 0x00ffffff);
	glPixelMapfv(GL_PIXEL_MAP_I_TO_G, 2, green);
	glPixelMapfv(GL_PIXEL_MAP_I_TO_A, 1, green + 1);
	glDrawPixels(2, 1, GL_COLOR_INDEX, GL_BITMAP, &bits);
	assert_int_equal(gl_pixel(1, 1), GREEN);
	assert_int_equal(gl_pixel(2, 1), BLACK);
	glDrawPixels(1, 1, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, &bits);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glDrawPixels(1, 1, GL_RGB, GL_BITMAP, &bits);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glDrawPixels(1, 1, GL_RGBA, GL_UNSIGNED_SHORT_5_6_5, packed);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
}

static void a_list_keeps_pixels(void **state)
{
	GLubyte pixel[4] = { 255, 0, 0, 255 };

	(void)state;
	glNewList(1, GL_COMPILE);
	glDrawPixels(1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
	glCopyPixels(3, 3, 1, 1, GL_COLOR);
	glEndList();
	pixel[0] = 0;
	glWindowPos2i(3, 3);
	glCallList(1);
	assert_int_equal(gl_pixel(3, 3), RED);
	glWindowPos2i(4, 4);
	glCallList(1);
	assert_int_equal(gl_pixel(4, 4), RED);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(pixels_lie_at_the_raster_position),
		TEST(zoom_repeats_and_turns_pixels),
		TEST(what_is_out_of_view_is_cut),
		TEST(scissor_and_masks_hold),
		TEST(colours_are_tested_by_depth),
		TEST(depths_are_drawn_in_the_raster_colour),
		TEST(what_was_drawn_is_copied),
		TEST(the_raster_position_is_lit),
		TEST(all_formats_are_drawn),
		TEST(there_is_no_accumulation_buffer),
		TEST(a_list_keeps_pixels),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
