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

static void materials_change_between_begin_and_end(void **state)
{
	static const GLfloat red[4] = { 1, 0, 0, 1 }, green[4] = { 0, 1, 0, 1 };
	static const GLfloat black[4] = { 0, 0, 0, 1 };

	(void)state;
	glEnable(GL_LIGHTING);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
	glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, red);
	glBegin(GL_QUADS);
	square_corners(0, 0);
	glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, green);
	square_corners(16, 0);
	glEnd();
	assert_int_equal(gl_pixel(4, 4), RED);
	assert_int_equal(gl_pixel(20, 4), GREEN);
}

static void a_light_shines(void **state)
{
	static const GLfloat toward[4] = { 0, 0, 1, 0 }, away[4] = { 0, 0, -1, 0 };
	static const GLfloat black[4] = { 0, 0, 0, 1 }, white[4] = { 1, 1, 1, 1 };

	(void)state;
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
	glMaterialfv(GL_FRONT, GL_DIFFUSE, white);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, toward);
	square(0, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, away);
	square(16, 0);
	assert_int_equal(gl_pixel(4, 4), WHITE);
	assert_int_equal(gl_pixel(20, 4), BLACK);
}

static void a_list_is_drawn_as_it_was_compiled(void **state)
{
	GLuint list = glGenLists(1);

	(void)state;
	glColor3f(0, 0, 1);
	glNewList(list, GL_COMPILE);
	square(0, 0);
	glColor3f(1, 0, 0);
	square(16, 0);
	glTranslatef(32, 0, 0);
	square(0, 0);
	glEndList();
	assert_int_equal(gl_pixel(4, 4), BLACK);
	/* The colour is that of when it is played. */
	glColor3f(0, 1, 0);
	glCallList(list);
	square(0, 16);
	assert_int_equal(gl_pixel(4, 4), GREEN);
	assert_int_equal(gl_pixel(20, 4), RED);
	assert_int_equal(gl_pixel(36, 4), RED);
	assert_int_equal(gl_pixel(36, 20), RED);
}

static void compile_and_execute_draws_once(void **state)
{
	GLfloat matrix[16], colour[4];

	(void)state;
	glNewList(7, GL_COMPILE);
	glTranslatef(8, 0, 0);
	glEndList();
	glNewList(8, GL_COMPILE_AND_EXECUTE);
	glColor3f(1, 0, 0);
	glGetFloatv(GL_CURRENT_COLOR, colour);
	assert_true(colour[1] == 0);
	glCallList(7);
	square(0, 0);
	glEndList();
	glGetFloatv(GL_MODELVIEW_MATRIX, matrix);
	assert_true(matrix[12] == 8);
	assert_int_equal(gl_pixel(12, 4), RED);
	glCallList(8);
	glGetFloatv(GL_MODELVIEW_MATRIX, matrix);
	assert_true(matrix[12] == 16);
	assert_int_equal(gl_pixel(20, 4), RED);
}

static void a_list_may_be_part_of_a_primitive(void **state)
{
	(void)state;
	glNewList(1, GL_COMPILE);
	square_corners(0, 0);
	glEndList();
	glNewList(2, GL_COMPILE);
	glBegin(GL_QUADS);
	glVertex2i(16, 0);
	glEndList();
	glNewList(3, GL_COMPILE);
	glVertex2i(24, 0);
	glVertex2i(24, 8);
	glVertex2i(16, 8);
	glEnd();
	glEndList();
	glBegin(GL_QUADS);
	glCallList(1);
	glEnd();
	glCallList(2);
	glCallList(3);
	assert_int_equal(gl_pixel(4, 4), WHITE);
	assert_int_equal(gl_pixel(20, 4), WHITE);
}

/* Colours of a list belong to the vertices after them, also where leftovers came between. */
static void a_list_keeps_colours_after_leftovers(void **state)
{
	(void)state;
	glNewList(1, GL_COMPILE);
	glBegin(GL_QUADS);
	square_corners(0, 0);
	glVertex2i(30, 30);
	glVertex2i(40, 30);
	glColor3f(1, 0, 0);
	glEnd();
	square(16, 0);
	glEndList();
	glColor3f(0, 1, 0);
	glCallList(1);
	assert_int_equal(gl_pixel(4, 4), GREEN);
	assert_int_equal(gl_pixel(17, 1), RED);
	assert_int_equal(gl_pixel(23, 1), RED);
	assert_int_equal(gl_pixel(20, 6), RED);
}

static void lists_are_called_by_base_and_bytes(void **state)
{
	static const GLubyte text[] = { 'a', 'b' };

	(void)state;
	glNewList(1000 + 'a', GL_COMPILE);
	square(0, 0);
	glEndList();
	glNewList(1000 + 'b', GL_COMPILE);
	square(16, 0);
	glEndList();
	glListBase(1000);
	glCallLists(2, GL_UNSIGNED_BYTE, text);
	assert_int_equal(gl_pixel(4, 4), WHITE);
	assert_int_equal(gl_pixel(20, 4), WHITE);
	assert_true(glIsList(1000 + 'a'));
	glDeleteLists(1000, 256);
	assert_false(glIsList(1000 + 'a'));
	glCallLists(2, GL_UNSIGNED_BYTE, text);
	/* A list that calls itself ends. */
	glNewList(5, GL_COMPILE);
	glCallList(5);
	glEndList();
	glCallList(5);
}

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
		TEST(materials_change_between_begin_and_end),
		TEST(a_light_shines),
		TEST(a_list_is_drawn_as_it_was_compiled),
		TEST(compile_and_execute_draws_once),
		TEST(a_list_may_be_part_of_a_primitive),
		TEST(a_list_keeps_colours_after_leftovers),
		TEST(lists_are_called_by_base_and_bytes),
		TEST(pixels_are_read_in_each_form),
		TEST(a_bitmap_is_at_the_raster_position),
		TEST(culled_faces_are_not_drawn),
		TEST(lines_and_points_have_widths),
		TEST(a_clip_plane_cuts),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
