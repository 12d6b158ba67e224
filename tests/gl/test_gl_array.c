// SPDX-License-Identifier: MIT
/* Vertex arrays and buffer objects. */
#include "gl_scene.h"

#include <string.h>

/* Two squares of eight pixels, at 0 and at 16. */
#define SQUARES 0, 0, 8, 0, 8, 8, 0, 8, 16, 0, 24, 0, 24, 8, 16, 8
static const GLfloat floats[16] = { SQUARES };
static const GLdouble doubles[16] = { SQUARES };
static const GLshort shorts[16] = { SQUARES };
static const GLint ints[16] = { SQUARES };

static void positions_have_four_types(void **state)
{
	static const struct {
		GLenum type;
		const void *data;
	} form[] = {
		{ GL_FLOAT, floats }, { GL_DOUBLE, doubles }, { GL_SHORT, shorts }, { GL_INT, ints }
	};

	(void)state;
	glEnableClientState(GL_VERTEX_ARRAY);
	for (int i = 0; i < 4; i++) {
		gl_clear(BLACK);
		glVertexPointer(2, form[i].type, 0, form[i].data);
		glDrawArrays(GL_QUADS, 4, 4);
		assert_int_equal(gl_pixel(4, 4), BLACK);
		assert_int_equal(gl_pixel(20, 4), WHITE);
	}
	glVertexPointer(2, GL_UNSIGNED_BYTE, 0, floats);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glVertexPointer(5, GL_FLOAT, 0, floats);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
}

static void colours_of_bytes_are_interleaved(void **state)
{
	static const struct {
		GLubyte colour[4];
		GLfloat position[3];
	} vertex[3] = { { { 255, 0, 0, 255 }, { 0, 0, 0 } },
			{ { 255, 0, 0, 255 }, { 16, 0, 0 } },
			{ { 255, 0, 0, 255 }, { 0, 16, 0 } } };
	GLint type;

	(void)state;
	glInterleavedArrays(GL_C4UB_V3F, 0, vertex);
	glGetIntegerv(GL_COLOR_ARRAY_TYPE, &type);
	assert_int_equal(type, GL_UNSIGNED_BYTE);
	assert_false(glIsEnabled(GL_NORMAL_ARRAY));
	glDrawArrays(GL_TRIANGLES, 0, 3);
	assert_int_equal(gl_pixel(2, 2), RED);
	glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
	glDisableClientState(GL_COLOR_ARRAY);
	glPopClientAttrib();
	assert_true(glIsEnabled(GL_COLOR_ARRAY));
}

static void indices_have_three_types(void **state)
{
	static const GLubyte bytes[] = { 4, 5, 6, 7 };
	static const GLushort halves[] = { 4, 5, 6, 7 };
	static const GLuint words[] = { 4, 5, 6, 7 };

	(void)state;
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, floats);
	glColor3f(1, 0, 0);
	glDrawElements(GL_QUADS, 4, GL_UNSIGNED_BYTE, bytes);
	assert_int_equal(gl_pixel(20, 4), RED);
	glColor3f(0, 1, 0);
	glDrawElements(GL_QUADS, 4, GL_UNSIGNED_SHORT, halves);
	assert_int_equal(gl_pixel(20, 4), GREEN);
	glColor3f(1, 1, 1);
	glDrawRangeElements(GL_QUADS, 4, 7, 4, GL_UNSIGNED_INT, words);
	assert_int_equal(gl_pixel(20, 4), WHITE);
	assert_int_equal(gl_pixel(4, 4), BLACK);
	glDrawElements(GL_QUADS, 4, GL_FLOAT, words);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glDrawElements(GL_QUADS, -1, GL_UNSIGNED_INT, words);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
}

/* More than a call of the library takes at once: a column of squares for each range. */
static void many_ranges_are_one_call(void **state)
{
	enum { RANGES = 70 };
	GLfloat square[RANGES][4][2];
	GLint first[RANGES];
	GLsizei count[RANGES];

	(void)state;
	for (int i = 0; i < RANGES; i++) {
		const GLfloat x = (GLfloat)(i % 35), y = (GLfloat)(i / 35 * 8);
		const GLfloat corner[4][2] = {
			{ x, y }, { x + 1, y }, { x + 1, y + 4 }, { x, y + 4 }
		};

		memcpy(square[i], corner, sizeof(corner));
		first[i] = 4 * (RANGES - 1 - i);
		count[i] = i == 35 ? 0 : 4;
	}
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, square);
	glMultiDrawArrays(GL_QUADS, first, count, RANGES);
	assert_int_equal(gl_pixel(0, 9), WHITE);
	assert_int_equal(gl_pixel(0, 2), WHITE);
	assert_int_equal(gl_pixel(33, 2), WHITE);
	assert_int_equal(gl_pixel(34, 2), BLACK);
	gl_clear(BLACK);
	count[5] = -1;
	glMultiDrawArrays(GL_QUADS, first, count, RANGES);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	assert_int_equal(gl_pixel(0, 9), BLACK);
	count[5] = 4;
	glNewList(1, GL_COMPILE);
	glMultiDrawArrays(GL_QUADS, first, count, RANGES);
	glEndList();
	glCallList(1);
	assert_int_equal(gl_pixel(33, 2), WHITE);
	assert_int_equal(gl_pixel(34, 2), BLACK);
}

/* What a list has of arrays is what they were when it was compiled. */
static void a_list_keeps_arrays(void **state)
{
	GLfloat position[16];
	GLuint list = glGenLists(1);

	(void)state;
	memcpy(position, floats, sizeof(position));
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, position);
	glNewList(list, GL_COMPILE);
	glDrawArrays(GL_QUADS, 0, 4);
	glColor3f(1, 0, 0);
	glDrawArrays(GL_QUADS, 4, 4);
	glEndList();
	memset(position, 0, sizeof(position));
	glDisableClientState(GL_VERTEX_ARRAY);
	glColor3f(0, 1, 0);
	glCallList(list);
	assert_int_equal(gl_pixel(4, 4), GREEN);
	assert_int_equal(gl_pixel(20, 4), RED);
}

static void array_elements_are_vertices(void **state)
{
	(void)state;
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_SHORT, 0, shorts);
	glBegin(GL_POLYGON);
	for (int i = 4; i < 8; i++)
		glArrayElement(i);
	glEnd();
	assert_int_equal(gl_pixel(20, 4), WHITE);
}

static void buffers_hold_arrays_and_indices(void **state)
{
	static const GLubyte index[] = { 0, 1, 2, 3, 4, 5, 6, 7 };
	GLuint buffer[2];
	GLfloat *mapped;
	GLint size;

	(void)state;
	glGenBuffers(1, buffer);
	/* A name that was never generated is as good. */
	buffer[1] = 4711;
	glBindBuffer(GL_ARRAY_BUFFER, buffer[0]);
	glBufferData(GL_ARRAY_BUFFER, sizeof(floats), floats, GL_STATIC_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer[1]);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(index), NULL, GL_DYNAMIC_DRAW);
	glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, sizeof(index), index);
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, NULL);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
	glDrawElements(GL_QUADS, 4, GL_UNSIGNED_BYTE, (const void *)(uintptr_t)4);
	assert_int_equal(gl_pixel(20, 4), WHITE);
	assert_int_equal(gl_pixel(4, 4), BLACK);
	glBindBuffer(GL_ARRAY_BUFFER, buffer[0]);
	mapped = glMapBuffer(GL_ARRAY_BUFFER, GL_READ_WRITE);
	assert_true(mapped[2] == 8);
	assert_null(glMapBuffer(GL_ARRAY_BUFFER, GL_READ_ONLY));
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	assert_true(glUnmapBuffer(GL_ARRAY_BUFFER));
	glGetBufferParameteriv(GL_ARRAY_BUFFER, GL_BUFFER_SIZE, &size);
	assert_int_equal(size, sizeof(floats));
	glBufferSubData(GL_ARRAY_BUFFER, 60, 8, floats);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	assert_true(glIsBuffer(4711));
	glDeleteBuffers(2, buffer);
	assert_false(glIsBuffer(4711));
	/* Nothing is read of what is gone, or lies beyond its end. */
	glDrawArrays(GL_QUADS, 0, 400);
	glBindBuffer(GL_ARRAY_BUFFER, buffer[0]);
	glBufferData(GL_ARRAY_BUFFER, 32, floats, GL_STATIC_DRAW);
	glVertexPointer(2, GL_FLOAT, 0, NULL);
	glDrawArrays(GL_QUADS, 0, 400);
	assert_int_equal(gl_pixel(4, 4), WHITE);
}

static void nothing_is_drawn_from_a_mapped_buffer(void **state)
{
	(void)state;
	glBindBuffer(GL_ARRAY_BUFFER, 1);
	glBufferData(GL_ARRAY_BUFFER, sizeof(floats), floats, GL_STATIC_DRAW);
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, NULL);
	assert_non_null(glMapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY));
	glDrawArrays(GL_QUADS, 0, 4);
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	assert_true(glUnmapBuffer(GL_ARRAY_BUFFER));
	glDrawArrays(GL_QUADS, 4, 4);
	assert_int_equal(gl_pixel(4, 4), BLACK);
	assert_int_equal(gl_pixel(20, 4), WHITE);
}

/* Which processors other than x86 refuse to read in one piece. */
static void numbers_may_lie_at_odd_places(void **state)
{
	static const GLushort index[] = { 7, 6, 5, 4 };
	uint8_t bytes[1 + sizeof(doubles)], indices[1 + sizeof(index)];

	(void)state;
	memcpy(bytes + 1, doubles, sizeof(doubles));
	memcpy(indices + 1, index, sizeof(index));
	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_DOUBLE, 0, bytes + 1);
	glDrawElements(GL_QUADS, 4, GL_UNSIGNED_SHORT, indices + 1);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++)
		glArrayElement(i);
	glEnd();
	assert_int_equal(gl_pixel(4, 4), WHITE);
	assert_int_equal(gl_pixel(20, 4), WHITE);
}

/* As GL_EXT_vertex_array has it. */
static void arrays_are_enabled_like_capabilities_too(void **state)
{
	(void)state;
	glVertexPointer(2, GL_FLOAT, 0, floats);
	glEnable(GL_VERTEX_ARRAY);
	assert_int_equal(glGetError(), GL_NO_ERROR);
	assert_true(glIsEnabled(GL_VERTEX_ARRAY));
	glDrawArrays(GL_QUADS, 4, 4);
	glDisable(GL_VERTEX_ARRAY);
	glDrawArrays(GL_QUADS, 0, 4);
	assert_int_equal(gl_pixel(4, 4), BLACK);
	assert_int_equal(gl_pixel(20, 4), WHITE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(positions_have_four_types),
		TEST(colours_of_bytes_are_interleaved),
		TEST(indices_have_three_types),
		TEST(a_list_keeps_arrays),
		TEST(many_ranges_are_one_call),
		TEST(array_elements_are_vertices),
		TEST(buffers_hold_arrays_and_indices),
		TEST(nothing_is_drawn_from_a_mapped_buffer),
		TEST(numbers_may_lie_at_odd_places),
		TEST(arrays_are_enabled_like_capabilities_too),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
