// SPDX-License-Identifier: MIT
/* What is drawn: immediate mode, lists, clears, pixels that are read. */
#include "gl_scene.h"

#include <string.h>

static void a_square_is_where_it_belongs(void **state)
{
	(void)state;
	glColor3ub(255, 0, 0);
	square(8, 16);
	assert_int_equal(gl_pixel(8, 16), RED);
	assert_int_equal(gl_pixel(15, 23), RED);
	assert_int_equal(gl_pixel(7, 16), BLACK);
	assert_int_equal(gl_pixel(16, 16), BLACK);
	assert_int_equal(gl_pixel(8, 15), BLACK);
	assert_int_equal(gl_pixel(8, 24), BLACK);
}

static void each_filled_topology_is_drawn(void **state)
{
	static const GLenum mode[] = { GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN,
				       GL_QUADS,     GL_QUAD_STRIP,     GL_POLYGON };

	(void)state;
	for (int i = 0; i < 6; i++) {
		glBegin(mode[i]);
		glVertex2i(10 * i, 0);
		glVertex2i(10 * i + 8, 0);
		if (mode[i] == GL_QUAD_STRIP || mode[i] == GL_TRIANGLE_STRIP) {
			glVertex2i(10 * i, 8);
			glVertex2i(10 * i + 8, 8);
		} else {
			glVertex2i(10 * i + 8, 8);
			glVertex2i(10 * i, 8);
		}
		glEnd();
	}
	for (int i = 0; i < 6; i++) {
		assert_int_equal(gl_pixel(10 * i + 6, 1), WHITE);
		assert_int_equal(gl_pixel(10 * i + 1, 6), i == 0 ? BLACK : WHITE);
		assert_int_equal(gl_pixel(10 * i + 8, 1), BLACK);
	}
}

/* gl4es took the leftovers of a primitive for the beginning of the next. */
static void unfinished_primitives_leave_nothing_behind(void **state)
{
	(void)state;
	glBegin(GL_QUADS);
	square_corners(0, 0);
	glVertex2i(30, 30);
	glVertex2i(40, 30);
	glVertex2i(40, 40);
	glEnd();
	square(16, 0);
	glBegin(GL_TRIANGLE_STRIP);
	glVertex2i(50, 50);
	glVertex2i(60, 50);
	glEnd();
	square(32, 0);
	assert_int_equal(gl_pixel(4, 4), WHITE);
	assert_int_equal(gl_pixel(20, 4), WHITE);
	assert_int_equal(gl_pixel(36, 4), WHITE);
	assert_int_equal(gl_pixel(37, 33), BLACK);
	assert_int_equal(gl_pixel(25, 20), BLACK);
}

static void clears_are_in_the_order_of_drawing(void **state)
{
	(void)state;
	square(0, 0);
	gl_clear(BLUE);
	square(16, 0);
	assert_int_equal(gl_pixel(4, 4), BLUE);
	assert_int_equal(gl_pixel(20, 4), WHITE);
}

static void state_holds_for_what_comes_after_it(void **state)
{
	(void)state;
	glColor3f(1, 0, 0);
	square(0, 0);
	glTranslatef(16, 0, 0);
	square(0, 0);
	glColorMask(0, 1, 0, 1);
	glColor3f(1, 1, 1);
	glTranslatef(16, 0, 0);
	square(0, 0);
	glColorMask(1, 1, 1, 1);
	assert_int_equal(gl_pixel(4, 4), RED);
	assert_int_equal(gl_pixel(20, 4), RED);
	assert_int_equal(gl_pixel(36, 4), GREEN);
}

static void colours_belong_to_vertices(void **state)
{
	(void)state;
	glShadeModel(GL_FLAT);
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < 2; i++) {
		glColor3f(0, 1, 0);
		glVertex2i(32 * i, 0);
		glVertex2i(32 * i + 32, 0);
		glColor3f((GLfloat)i, 0, 1 - (GLfloat)i);
		glVertex2i(32 * i, 32);
	}
	glEnd();
	assert_int_equal(gl_pixel(4, 4), BLUE);
	assert_int_equal(gl_pixel(36, 4), RED);
}

static void a_clear_keeps_to_scissor_and_mask(void **state)
{
	(void)state;
	glEnable(GL_SCISSOR_TEST);
	glScissor(8, 16, 4, 2);
	gl_clear(RED);
	glDisable(GL_SCISSOR_TEST);
	glColorMask(0, 0, 1, 0);
	gl_clear(WHITE);
	glColorMask(1, 1, 1, 1);
	assert_int_equal(gl_pixel(8, 16), RED | BLUE);
	assert_int_equal(gl_pixel(11, 17), RED | BLUE);
	assert_int_equal(gl_pixel(12, 17), BLUE);
	assert_int_equal(gl_pixel(8, 18), BLUE);
	assert_int_equal(gl_pixel(8, 15), BLUE);
}

static void the_depth_test_compares(void **state)
{
	GLfloat depth;

	(void)state;
	glClearDepth(0.5);
	glClear(GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glTranslatef(0, 0, 0.5f);
	square(0, 0);
	glTranslatef(0, 0, -1);
	square(16, 0);
	assert_int_equal(gl_pixel(20, 4), BLACK);
	assert_int_equal(gl_pixel(4, 4), WHITE);
	glReadPixels(4, 4, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
	assert_true(depth > 0.2499f && depth < 0.2501f);
	glReadPixels(20, 4, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
	assert_true(depth > 0.4999f && depth < 0.5001f);
}

static void a_new_surface_has_the_farthest_depth(void **state)
{
	(void)state;
	glEnable(GL_DEPTH_TEST);
	square(0, 0);
	assert_int_equal(gl_pixel(4, 4), WHITE);
}

static void culled_faces_are_not_drawn(void **state)
{
	(void)state;
	glEnable(GL_CULL_FACE);
	square(0, 0);
	glFrontFace(GL_CW);
	square(16, 0);
	glCullFace(GL_FRONT);
	square(32, 0);
	glCullFace(GL_FRONT_AND_BACK);
	square(48, 0);
	assert_int_equal(gl_pixel(4, 4), WHITE);
	assert_int_equal(gl_pixel(20, 4), BLACK);
	assert_int_equal(gl_pixel(36, 4), WHITE);
	assert_int_equal(gl_pixel(52, 4), BLACK);
}

static void lines_and_points_have_widths(void **state)
{
	(void)state;
	glLineWidth(3);
	glPointSize(4);
	glBegin(GL_LINES);
	glVertex2f(0, 10.5f);
	glVertex2f(40, 10.5f);
	glEnd();
	glBegin(GL_POINTS);
	glVertex2i(20, 30);
	glEnd();
	glLineWidth(1);
	glLineStipple(1, 0x00ff);
	glEnable(GL_LINE_STIPPLE);
	glBegin(GL_LINES);
	glVertex2f(0, 50.5f);
	glVertex2f(16, 50.5f);
	glEnd();
	assert_int_equal(gl_pixel(20, 9), WHITE);
	assert_int_equal(gl_pixel(20, 11), WHITE);
	assert_int_equal(gl_pixel(20, 8), BLACK);
	assert_int_equal(gl_pixel(20, 12), BLACK);
	assert_int_equal(gl_pixel(18, 28), WHITE);
	assert_int_equal(gl_pixel(21, 31), WHITE);
	assert_int_equal(gl_pixel(22, 32), BLACK);
	assert_int_equal(gl_pixel(4, 50), WHITE);
	assert_int_equal(gl_pixel(12, 50), BLACK);
}

static void a_clip_plane_cuts(void **state)
{
	static const GLdouble right_of_four[4] = { 1, 0, 0, -4 };

	(void)state;
	glClipPlane(GL_CLIP_PLANE2, right_of_four);
	glEnable(GL_CLIP_PLANE2);
	square(0, 0);
	assert_int_equal(gl_pixel(3, 4), BLACK);
	assert_int_equal(gl_pixel(4, 4), WHITE);
	glDisable(GL_CLIP_PLANE2);
	square(0, 0);
	assert_int_equal(gl_pixel(3, 4), WHITE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_square_is_where_it_belongs),
		TEST(each_filled_topology_is_drawn),
		TEST(unfinished_primitives_leave_nothing_behind),
		TEST(clears_are_in_the_order_of_drawing),
		TEST(state_holds_for_what_comes_after_it),
		TEST(colours_belong_to_vertices),
		TEST(a_clear_keeps_to_scissor_and_mask),
		TEST(the_depth_test_compares),
		TEST(a_new_surface_has_the_farthest_depth),
		TEST(culled_faces_are_not_drawn),
		TEST(lines_and_points_have_widths),
		TEST(a_clip_plane_cuts),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
