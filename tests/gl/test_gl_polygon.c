// SPDX-License-Identifier: MIT
/* Polygons as outlines, edge flags from where programs have them, offset of depth, culling. */
#include "gl_scene.h"

/* The middles of the left, upper, right and lower edge of a square of eight pixels at 8, 8. */
static void assert_edges(GLuint left, GLuint upper, GLuint right, GLuint lower)
{
	assert_int_equal(gl_pixel(8, 12), left);
	assert_int_equal(gl_pixel(12, 16), upper);
	assert_int_equal(gl_pixel(16, 12), right);
	assert_int_equal(gl_pixel(12, 8), lower);
	assert_int_equal(gl_pixel(12, 12), BLACK);
	gl_clear(BLACK);
}

/* On the middles of pixels. */
static const GLfloat corner[4][2] = {
	{ 8.5f, 8.5f }, { 16.5f, 8.5f }, { 16.5f, 16.5f }, { 8.5f, 16.5f }
};

static void outlined(const GLboolean flag[4])
{
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		glEdgeFlag(flag[i]);
		glVertex2fv(corner[i]);
	}
	glEnd();
}

static void edges_without_a_flag_are_not_drawn(void **state)
{
	static const GLboolean some[4] = { 1, 0, 0, 1 }, all[4] = { 1, 1, 1, 1 };

	(void)state;
	glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
	outlined(all);
	assert_edges(WHITE, WHITE, WHITE, WHITE);
	outlined(some);
	assert_edges(WHITE, BLACK, BLACK, WHITE);
	glNewList(1, GL_COMPILE);
	outlined(some);
	glEndList();
	glCallList(1);
	assert_edges(WHITE, BLACK, BLACK, WHITE);
	glEdgeFlagPointer(0, some);
	glVertexPointer(2, GL_FLOAT, 0, corner);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_EDGE_FLAG_ARRAY);
	glDrawArrays(GL_QUADS, 0, 4);
	assert_edges(WHITE, BLACK, BLACK, WHITE);
	glDisableClientState(GL_EDGE_FLAG_ARRAY);
	glEdgeFlag(GL_FALSE);
	glDrawArrays(GL_QUADS, 0, 4);
	assert_edges(BLACK, BLACK, BLACK, BLACK);
	glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
	glDrawArrays(GL_QUADS, 0, 4);
	assert_int_equal(gl_pixel(12, 12), WHITE);
}

static void the_back_has_a_mode_of_its_own(void **state)
{
	static const GLboolean all[4] = { 1, 1, 1, 1 };

	(void)state;
	glPolygonMode(GL_BACK, GL_POINT);
	outlined(all);
	assert_int_equal(gl_pixel(12, 12), WHITE);
	gl_clear(BLACK);
	glFrontFace(GL_CW);
	outlined(all);
	assert_int_equal(gl_pixel(8, 8), WHITE);
	assert_int_equal(gl_pixel(12, 8), BLACK);
	assert_int_equal(gl_pixel(12, 12), BLACK);
}

static void an_offset_is_where_it_is_enabled(void **state)
{
	(void)state;
	glEnable(GL_DEPTH_TEST);
	glColor3ub(255, 0, 0);
	square(8, 8);
	glColor3ub(0, 255, 0);
	glPolygonOffset(0, -2);
	square(8, 8);
	assert_int_equal(gl_pixel(12, 12), RED);
	glEnable(GL_POLYGON_OFFSET_LINE);
	square(8, 8);
	assert_int_equal(gl_pixel(12, 12), RED);
	glEnable(GL_POLYGON_OFFSET_FILL);
	square(8, 8);
	assert_int_equal(gl_pixel(12, 12), GREEN);
}

static void polygons_culled_on_both_sides_leave_lines_and_points(void **state)
{
	(void)state;
	glEnable(GL_CULL_FACE);
	glCullFace(GL_FRONT_AND_BACK);
	square(8, 8);
	glBegin(GL_LINES);
	glVertex2f(8, 20.5f);
	glVertex2f(16, 20.5f);
	glEnd();
	glBegin(GL_POINTS);
	glVertex2f(30.5f, 30.5f);
	glEnd();
	assert_int_equal(gl_pixel(12, 12), BLACK);
	assert_int_equal(gl_pixel(12, 20), WHITE);
	assert_int_equal(gl_pixel(30, 30), WHITE);
}

static void a_stipple_of_no_bit_draws_no_line(void **state)
{
	(void)state;
	glEnable(GL_LINE_STIPPLE);
	for (int i = 0; i < 2; i++) {
		glLineStipple(1, i ? 0xffff : 0);
		glBegin(GL_LINES);
		glVertex2f(8, 20.5f);
		glVertex2f(16, 20.5f);
		glEnd();
		assert_int_equal(gl_pixel(12, 20), i ? WHITE : BLACK);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(edges_without_a_flag_are_not_drawn),
		TEST(the_back_has_a_mode_of_its_own),
		TEST(an_offset_is_where_it_is_enabled),
		TEST(polygons_culled_on_both_sides_leave_lines_and_points),
		TEST(a_stipple_of_no_bit_draws_no_line),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
