// SPDX-License-Identifier: MIT
/* Display lists: what they keep, and when it is done. */
#include "gl_scene.h"

#include <string.h>

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

static void errors_come_when_a_list_is_played(void **state)
{
	(void)state;
	glNewList(1, GL_COMPILE);
	glBegin(GL_POLYGON + 1);
	glEndList();
	assert_int_equal(glGetError(), GL_NO_ERROR);
	glCallList(1);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	/* A list that is executed does not end within a primitive. */
	glNewList(2, GL_COMPILE_AND_EXECUTE);
	glBegin(GL_QUADS);
	glEndList();
	square_corners(0, 0);
	glEnd();
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glEndList();
	assert_int_equal(gl_pixel(4, 4), WHITE);
	gl_clear(BLACK);
	glCallList(2);
	assert_int_equal(gl_pixel(4, 4), WHITE);
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

/* What a list has of state, is done when it is called, in the order of the list. */
static void state_in_a_list_is_set_when_it_is_called(void **state)
{
	static const GLfloat red[4] = { 1, 0, 0, 1 };
	GLint function, pattern;
	GLfloat diffuse[4];

	(void)state;
	glNewList(1, GL_COMPILE);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE);
	glEnable(GL_BLEND);
	glLineStipple(1, 0x1234);
	glLightfv(GL_LIGHT1, GL_DIFFUSE, red);
	glPushAttrib(GL_ENABLE_BIT);
	glDisable(GL_BLEND);
	glEndList();
	glGetIntegerv(GL_BLEND_SRC, &function);
	assert_int_equal(function, GL_ONE);
	assert_false(glIsEnabled(GL_BLEND));
	glCallList(1);
	glGetIntegerv(GL_BLEND_SRC, &function);
	assert_int_equal(function, GL_SRC_ALPHA);
	glGetIntegerv(GL_LINE_STIPPLE_PATTERN, &pattern);
	assert_int_equal(pattern, 0x1234);
	glGetLightfv(GL_LIGHT1, GL_DIFFUSE, diffuse);
	assert_true(diffuse[0] == 1 && diffuse[1] == 0);
	assert_false(glIsEnabled(GL_BLEND));
	glPopAttrib();
	assert_true(glIsEnabled(GL_BLEND));
}

/* Those of where memory is belong to the program, and are done at once. */
static void client_state_is_in_no_list(void **state)
{
	GLint alignment;

	(void)state;
	glNewList(1, GL_COMPILE);
	glPixelStorei(GL_PACK_ALIGNMENT, 1);
	glEnableClientState(GL_COLOR_ARRAY);
	glEndList();
	glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
	assert_int_equal(alignment, 1);
	assert_true(glIsEnabled(GL_COLOR_ARRAY));
	glPixelStorei(GL_PACK_ALIGNMENT, 8);
	glDisableClientState(GL_COLOR_ARRAY);
	glCallList(1);
	glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
	assert_int_equal(alignment, 8);
	assert_false(glIsEnabled(GL_COLOR_ARRAY));
}

static void empty_lists_and_names_without_one_do_nothing(void **state)
{
	(void)state;
	glNewList(1, GL_COMPILE);
	glEndList();
	glNewList(2, GL_COMPILE_AND_EXECUTE);
	glEndList();
	glCallList(1);
	glCallList(2);
	glCallList(3);
	glCallList(0);
	assert_true(glIsList(1));
	assert_false(glIsList(3));
	glDeleteLists(1, 3);
	glDeleteLists(0, 1);
	assert_false(glIsList(1));
	glCallList(1);
	square(0, 0);
	assert_int_equal(gl_pixel(4, 4), WHITE);
}

/* While a list is made anew, its name is that of the old one. */
static void a_list_that_calls_itself_calls_the_old_one(void **state)
{
	GLint index;

	(void)state;
	glNewList(1, GL_COMPILE);
	glTranslatef(16, 0, 0);
	glEndList();
	glNewList(1, GL_COMPILE_AND_EXECUTE);
	glGetIntegerv(GL_LIST_INDEX, &index);
	assert_int_equal(index, 1);
	glCallList(1);
	square(0, 0);
	glEndList();
	glGetIntegerv(GL_LIST_INDEX, &index);
	assert_int_equal(index, 0);
	assert_int_equal(gl_pixel(20, 4), WHITE);
	assert_int_equal(gl_pixel(4, 4), BLACK);
}

static void errors_in_a_list_are_those_of_its_call(void **state)
{
	(void)state;
	glNewList(1, GL_COMPILE);
	glDepthFunc(GL_ALPHA);
	glColor3f(1, 0, 0);
	glEndList();
	assert_int_equal(glGetError(), GL_NO_ERROR);
	glCallList(1);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	square(0, 0);
	assert_int_equal(gl_pixel(4, 4), RED);
	glEndList();
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glNewList(0, GL_COMPILE);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glNewList(1, GL_RENDER);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glNewList(1, GL_COMPILE);
	glNewList(2, GL_COMPILE);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	glEndList();
}

/* Those of a list without normals are the current one, of when it is called. */
static void a_list_takes_the_normal_of_its_call(void **state)
{
	(void)state;
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glNewList(1, GL_COMPILE);
	square(0, 0);
	glEndList();
	glNormal3f(0, 0, 1);
	glCallList(1);
	assert_int_equal(gl_pixel(4, 4) & 255, 214); /* 0.2 of 0.2 and 0.8 */
	glNormal3f(0, 0, -1);
	glCallList(1);
	assert_int_equal(gl_pixel(4, 4) & 255, 10);
}

static void a_bitmap_in_a_list_keeps_its_bits(void **state)
{
	GLubyte bits[8] = { 0xff };

	(void)state;
	glNewList(1, GL_COMPILE);
	glBitmap(8, 1, 0, 0, 8, 0, bits);
	glEndList();
	bits[0] = 0;
	glRasterPos2i(4, 4);
	glCallList(1);
	glCallList(1);
	assert_int_equal(gl_pixel(4, 4), WHITE);
	assert_int_equal(gl_pixel(19, 4), WHITE);
	assert_int_equal(gl_pixel(20, 4), BLACK);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_list_is_drawn_as_it_was_compiled),
		TEST(compile_and_execute_draws_once),
		TEST(errors_come_when_a_list_is_played),
		TEST(a_list_may_be_part_of_a_primitive),
		TEST(a_list_keeps_colours_after_leftovers),
		TEST(lists_are_called_by_base_and_bytes),
		TEST(state_in_a_list_is_set_when_it_is_called),
		TEST(client_state_is_in_no_list),
		TEST(empty_lists_and_names_without_one_do_nothing),
		TEST(a_list_that_calls_itself_calls_the_old_one),
		TEST(errors_in_a_list_are_those_of_its_call),
		TEST(a_list_takes_the_normal_of_its_call),
		TEST(a_bitmap_in_a_list_keeps_its_bits),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
