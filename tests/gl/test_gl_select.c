// SPDX-License-Identifier: MIT
/* Selection and feedback: what would be drawn is told. */
#include "gl_scene.h"

#include <string.h>

static GLuint hits[64];
static GLfloat numbers[128];

static void begin_select(GLsizei size)
{
	glSelectBuffer(size, hits);
	assert_int_equal(glRenderMode(GL_SELECT), 0);
	glInitNames();
}

static void begin_feedback(GLenum type)
{
	glFeedbackBuffer(128, type, numbers);
	assert_int_equal(glRenderMode(GL_FEEDBACK), 0);
}

static void point(GLfloat x, GLfloat y, GLfloat z)
{
	glBegin(GL_POINTS);
	glVertex3f(x, y, z);
	glEnd();
}

static void a_hit_has_the_names_and_depths(void **state)
{
	(void)state;
	begin_select(64);
	glPushName(5);
	glPushName(6);
	point(10, 10, 0);
	point(20, 10, -1); /* the far plane: window z is 1 */
	glLoadName(7);
	point(-10, 10, 0); /* out of view */
	glPopName();
	square(0, 0);
	assert_int_equal(glRenderMode(GL_RENDER), 2);
	assert_int_equal(hits[0], 2);
	assert_int_equal(hits[1] >> 24, 0x7f);
	assert_int_equal(hits[2], 0xffffffff);
	assert_int_equal(hits[3], 5);
	assert_int_equal(hits[4], 6);
	assert_int_equal(hits[5], 1);
	assert_int_equal(hits[8], 5);
	/* Nothing was drawn. */
	assert_int_equal(gl_pixel(10, 10), BLACK);
	assert_int_equal(gl_pixel(4, 4), BLACK);
	square(0, 0);
	assert_int_equal(gl_pixel(4, 4), WHITE);
}

static void what_is_culled_or_clipped_is_no_hit(void **state)
{
	static const GLdouble left[4] = { -1, 0, 0, 4 };

	(void)state;
	begin_select(64);
	glEnable(GL_CULL_FACE);
	glCullFace(GL_FRONT);
	square(0, 0);
	glDisable(GL_CULL_FACE);
	glClipPlane(GL_CLIP_PLANE0, left);
	glEnable(GL_CLIP_PLANE0);
	point(10, 10, 0);
	assert_int_equal(glRenderMode(GL_RENDER), 0);
}

static void a_small_buffer_is_told(void **state)
{
	(void)state;
	begin_select(3);
	glPushName(1);
	point(1, 1, 0);
	assert_int_equal(glRenderMode(GL_RENDER), -1);
	assert_int_equal(hits[0], 1);
	glFeedbackBuffer(2, GL_2D, numbers);
	glRenderMode(GL_FEEDBACK);
	point(1, 1, 0);
	assert_int_equal(glRenderMode(GL_RENDER), -1);
	/* And the next time is as the first. */
	begin_select(64);
	point(1, 1, 0);
	assert_int_equal(glRenderMode(GL_RENDER), 1);
}

static void the_stack_of_names_has_ends(void **state)
{
	GLint depth;

	(void)state;
	glPushName(1); /* without an effect outside of selection */
	glPopName();
	glPopName();
	assert_int_equal(glGetError(), GL_NO_ERROR);
	begin_select(64);
	glPopName();
	assert_int_equal(glGetError(), GL_STACK_UNDERFLOW);
	glLoadName(1);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	for (GLuint i = 0; i < 64; i++)
		glPushName(i);
	glGetIntegerv(GL_NAME_STACK_DEPTH, &depth);
	assert_int_equal(depth, 64);
	glPushName(64);
	assert_int_equal(glGetError(), GL_STACK_OVERFLOW);
	glSelectBuffer(1, hits);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glRenderMode(GL_LINES);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	assert_int_equal(glRenderMode(GL_RENDER), 0);
	glRenderMode(GL_FEEDBACK);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
}

/* From lists, elements and four dimensions as from elsewhere. */
static void every_way_to_draw_is_selected(void **state)
{
	static const GLfloat corner[3][4] = { { 0, 0, 0, 2 }, { 16, 0, 0, 2 }, { 0, 16, 0, 2 } };
	static const GLubyte index[3] = { 0, 1, 2 };

	(void)state;
	glNewList(1, GL_COMPILE);
	glLoadName(2);
	point(3, 3, 0);
	glEndList();
	glVertexPointer(4, GL_FLOAT, 0, corner);
	glEnableClientState(GL_VERTEX_ARRAY);
	begin_select(64);
	glPushName(1);
	glCallList(1);
	glLoadName(3);
	glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, index);
	glLoadName(4);
	glRectf(1, 1, 2, 2);
	glLoadName(5);
	glRasterPos2f(5, 5);
	assert_int_equal(glRenderMode(GL_RENDER), 4);
	for (int i = 0; i < 4; i++)
		assert_int_equal(hits[4 * i + 3], 2 + i);
}

static void feedback_is_what_is_in_the_window(void **state)
{
	(void)state;
	begin_feedback(GL_3D_COLOR);
	glColor3f(1, 0, 0);
	point(3, 5, -1);
	glPassThrough(17);
	glBegin(GL_LINES);
	glVertex2f(1, 1);
	glVertex2f(2, 1);
	glEnd();
	assert_int_equal(glRenderMode(GL_RENDER), 8 + 2 + 15);
	assert_float_equal(numbers[0], GL_POINT_TOKEN, 0);
	assert_float_equal(numbers[1], 3, 1e-4f);
	assert_float_equal(numbers[2], 5, 1e-4f);
	assert_float_equal(numbers[3], 1, 1e-6f);
	assert_float_equal(numbers[4], 1, 0);
	assert_float_equal(numbers[5], 0, 0);
	assert_float_equal(numbers[8], GL_PASS_THROUGH_TOKEN, 0);
	assert_float_equal(numbers[9], 17, 0);
	assert_float_equal(numbers[10], GL_LINE_RESET_TOKEN, 0);
	assert_float_equal(numbers[18], 2, 1e-4f);
	assert_int_equal(gl_pixel(3, 5), BLACK);
}

static void polygons_are_clipped_in_feedback(void **state)
{
	(void)state;
	begin_feedback(GL_2D);
	glRectf(-4, 4, 4, 8);
	assert_int_equal(glRenderMode(GL_RENDER), 2 + 4 * 2);
	assert_float_equal(numbers[0], GL_POLYGON_TOKEN, 0);
	assert_float_equal(numbers[1], 4, 0);
	for (int i = 0; i < 4; i++)
		assert_true(numbers[2 + 2 * i] > -1e-3f && numbers[2 + 2 * i] < 4.001f);
	begin_feedback(GL_4D_COLOR_TEXTURE);
	glTexCoord2f(0.5f, 0.25f);
	glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
	glRectf(1, 1, 2, 2);
	assert_int_equal(glRenderMode(GL_RENDER), 4 * 13);
	assert_float_equal(numbers[0], GL_POINT_TOKEN, 0);
	assert_float_equal(numbers[4], 1, 1e-6f);
	assert_float_equal(numbers[9], 0.5f, 0);
	assert_float_equal(numbers[10], 0.25f, 0);
}

static void rectangles_of_pixels_are_tokens(void **state)
{
	static const GLubyte bits[4] = { 0xff, 0xff, 0xff, 0xff };

	(void)state;
	glWindowPos2i(2, 3);
	begin_feedback(GL_2D);
	glBitmap(8, 1, 0, 0, 4, 0, bits);
	glDrawPixels(1, 1, GL_RGBA, GL_UNSIGNED_BYTE, bits);
	glCopyPixels(0, 0, 1, 1, GL_COLOR);
	glClear(GL_COLOR_BUFFER_BIT);
	assert_int_equal(glRenderMode(GL_RENDER), 9);
	assert_float_equal(numbers[0], GL_BITMAP_TOKEN, 0);
	assert_float_equal(numbers[1], 2, 0);
	assert_float_equal(numbers[3], GL_DRAW_PIXEL_TOKEN, 0);
	assert_float_equal(numbers[4], 6, 0);
	assert_float_equal(numbers[6], GL_COPY_PIXEL_TOKEN, 0);
	assert_int_equal(gl_pixel(2, 3), BLACK);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_hit_has_the_names_and_depths),   TEST(what_is_culled_or_clipped_is_no_hit),
		TEST(a_small_buffer_is_told),           TEST(the_stack_of_names_has_ends),
		TEST(every_way_to_draw_is_selected),    TEST(feedback_is_what_is_in_the_window),
		TEST(polygons_are_clipped_in_feedback), TEST(rectangles_of_pixels_are_tokens),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
