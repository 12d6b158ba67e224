// SPDX-License-Identifier: MIT
/*
 * Vertex arrays of any types, sizes and strides, in memory that ends where the last vertex does or in
 * buffers that end earlier, drawn in each way there is. Nothing outside is read, which ASan and
 * valgrind see, and errors are those that the specification has. GL_ARRAYS says how many draws there
 * are, GLOSS_SEED which.
 */
#include "gl_scene.h"

#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "accel_test.h"

#define DRAWS 3000
#define VERTICES 20
#define MEMORY 4096
#define ARRAYS 7
#define BUFFERS 4
#define INDICES 5 /* the buffer of indices */

enum kind { POSITION, NORMAL, COLOUR, INDEX, EDGE, SECONDARY, TEXCOORD };

/* What may be given: types, and the least size; 0: the command takes none. */
static const struct {
	GLenum array;
	GLenum types[9];
	int least, most;
} kinds[ARRAYS] = {
	{ GL_VERTEX_ARRAY, { GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE }, 2, 4 },
	{ GL_NORMAL_ARRAY, { GL_BYTE, GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE }, 3, 3 },
	{ GL_COLOR_ARRAY,
	  { GL_BYTE, GL_UNSIGNED_BYTE, GL_SHORT, GL_UNSIGNED_SHORT, GL_INT, GL_UNSIGNED_INT,
	    GL_FLOAT, GL_DOUBLE },
	  3,
	  4 },
	{ GL_INDEX_ARRAY, { GL_UNSIGNED_BYTE, GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE }, 1, 1 },
	{ GL_EDGE_FLAG_ARRAY, { GL_UNSIGNED_BYTE }, 1, 1 },
	{ GL_SECONDARY_COLOR_ARRAY,
	  { GL_BYTE, GL_UNSIGNED_BYTE, GL_SHORT, GL_UNSIGNED_SHORT, GL_INT, GL_UNSIGNED_INT,
	    GL_FLOAT, GL_DOUBLE },
	  3,
	  3 },
	{ GL_TEXTURE_COORD_ARRAY, { GL_SHORT, GL_INT, GL_FLOAT, GL_DOUBLE }, 1, 4 },
};

struct fuzz {
	uint64_t seed;
	uint8_t *memory[ARRAYS + 1]; /* of a draw, freed after it; the last is that of indices */
	GLsizei vertices;            /* as many as each array in memory has */
};

static size_t type_size(GLenum type)
{
	switch (type) {
	case GL_BYTE:
	case GL_UNSIGNED_BYTE:
		return 1;
	case GL_SHORT:
	case GL_UNSIGNED_SHORT:
		return 2;
	case GL_DOUBLE:
		return 8;
	default:
		return 4;
	}
}

/* Any bits: numbers that are not finite are among them. Mostly they are small floats. */
static void fill(struct fuzz *fuzz, uint8_t *bytes, size_t size)
{
	bool floats = test_below(&fuzz->seed, 4);

	for (size_t i = 0; i < size; i++)
		bytes[i] = (uint8_t)test_random(&fuzz->seed);
	for (size_t i = 0; floats && i + sizeof(float) <= size; i += sizeof(float)) {
		float number = (float)test_below(&fuzz->seed, 64);

		memcpy(bytes + i, &number, sizeof(number));
	}
}

/* Buffers of other sizes than what lies in them needs. */
static void make_buffers(struct fuzz *fuzz)
{
	static uint8_t bytes[MEMORY];
	const GLuint gone = 1 + test_below(&fuzz->seed, BUFFERS);

	for (GLuint name = 1; name <= BUFFERS; name++) {
		size_t size = test_below(&fuzz->seed, 4) ? test_below(&fuzz->seed, MEMORY) :
							   test_below(&fuzz->seed, 16);

		fill(fuzz, bytes, size);
		glBindBuffer(GL_ARRAY_BUFFER, name);
		glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, bytes, GL_STATIC_DRAW);
	}
	if (!test_below(&fuzz->seed, 8))
		glDeleteBuffers(1, &gone);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
}

static void set_pointer(enum kind kind, GLint size, GLenum type, GLsizei stride, const void *at)
{
	switch (kind) {
	case POSITION:
		glVertexPointer(size, type, stride, at);
		break;
	case NORMAL:
		glNormalPointer(type, stride, at);
		break;
	case COLOUR:
		glColorPointer(size, type, stride, at);
		break;
	case INDEX:
		glIndexPointer(type, stride, at);
		break;
	case EDGE:
		glEdgeFlagPointer(stride, at);
		break;
	case SECONDARY:
		glSecondaryColorPointer(size, type, stride, at);
		break;
	case TEXCOORD:
		glTexCoordPointer(size, type, stride, at);
		break;
	}
}

/* In a buffer, maybe from beyond its end on, or at an odd place of memory of the size that is needed. */
static void set_array(struct fuzz *fuzz, enum kind kind)
{
	GLenum type = GL_NONE;
	GLint size = kinds[kind].least;
	size_t element, stride;

	while (!type)
		type = kinds[kind].types[test_below(&fuzz->seed, 9)];
	size += (GLint)test_below(&fuzz->seed, (uint32_t)(kinds[kind].most - size + 1));
	element = type_size(type) * (size_t)size;
	/* Less than an element is allowed. */
	stride = test_below(&fuzz->seed, 2) ? 0 : 1 + test_below(&fuzz->seed, 70);
	if (test_below(&fuzz->seed, 2)) {
		glBindBuffer(GL_ARRAY_BUFFER, 1 + test_below(&fuzz->seed, BUFFERS));
		set_pointer(kind, size, type, (GLsizei)stride,
			    (const void *)(uintptr_t)test_below(&fuzz->seed, MEMORY / 2));
		glBindBuffer(GL_ARRAY_BUFFER, 0);
	} else {
		size_t bytes = (stride ? stride : element) * (size_t)(fuzz->vertices - 1) + element;

		fuzz->memory[kind] = malloc(bytes + 1);
		assert_non_null(fuzz->memory[kind]);
		fill(fuzz, fuzz->memory[kind] + 1, bytes);
		set_pointer(kind, size, type, (GLsizei)stride, fuzz->memory[kind] + 1);
	}
	if (test_below(&fuzz->seed, 4))
		glEnableClientState(kinds[kind].array);
}

static GLenum any_mode(struct fuzz *fuzz)
{
	return GL_POINTS + test_below(&fuzz->seed, GL_POLYGON + 1);
}

/* A range of the vertices that there are. */
static void any_range(struct fuzz *fuzz, GLint *first, GLsizei *count)
{
	*first = (GLint)test_below(&fuzz->seed, (uint32_t)fuzz->vertices);
	*count = (GLsizei)test_below(&fuzz->seed, (uint32_t)(fuzz->vertices - *first + 1));
}

static void draw_ranges(struct fuzz *fuzz)
{
	GLint first[3];
	GLsizei count[3];

	for (int i = 0; i < 3; i++)
		any_range(fuzz, &first[i], &count[i]);
	if (test_below(&fuzz->seed, 2))
		glDrawArrays(any_mode(fuzz), first[0], count[0]);
	else
		glMultiDrawArrays(any_mode(fuzz), first, count, 3);
}

static void put_index(uint8_t *bytes, size_t size, uint32_t i, uint32_t index)
{
	const uint16_t two = (uint16_t)index;

	if (size == 1)
		bytes[i] = (uint8_t)index;
	else if (size == 2)
		memcpy(bytes + 2 * (size_t)i, &two, 2);
	else
		memcpy(bytes + 4 * (size_t)i, &index, 4);
}

/* Indices at an odd place of memory, or of a buffer that may end before them. */
static const void *make_indices(struct fuzz *fuzz, GLenum type, GLsizei count)
{
	const size_t size = type_size(type), bytes = size * (size_t)count;
	uint8_t *memory = malloc(bytes + 1);

	assert_non_null(memory);
	fuzz->memory[ARRAYS] = memory;
	memory[0] = 0;
	for (uint32_t i = 0; i < (uint32_t)count; i++)
		put_index(memory + 1, size, i, test_below(&fuzz->seed, (uint32_t)fuzz->vertices));
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
	if (test_below(&fuzz->seed, 2))
		return memory + 1;
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, INDICES);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER,
		     (GLsizeiptr)(bytes + 1 - (bytes && !test_below(&fuzz->seed, 8))), memory,
		     GL_STREAM_DRAW);
	return (const void *)(uintptr_t)1;
}

static void draw_indices(struct fuzz *fuzz)
{
	static const GLenum types[] = { GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_UNSIGNED_INT };
	const GLenum type = types[test_below(&fuzz->seed, 3)], mode = any_mode(fuzz);
	const GLsizei count = (GLsizei)test_below(&fuzz->seed, 3 * VERTICES);
	const void *indices = make_indices(fuzz, type, count);

	switch (test_below(&fuzz->seed, 3)) {
	case 0:
		glDrawElements(mode, count, type, indices);
		break;
	case 1:
		glDrawRangeElements(mode, 0, (GLuint)fuzz->vertices, count, type, indices);
		break;
	default:
		glMultiDrawElements(mode, &count, type, &indices, 1);
		break;
	}
}

static void draw_elements_one_by_one(struct fuzz *fuzz)
{
	glBegin(any_mode(fuzz));
	for (uint32_t i = test_below(&fuzz->seed, 2 * VERTICES); i; i--)
		glArrayElement((GLint)test_below(&fuzz->seed, (uint32_t)fuzz->vertices));
	glEnd();
}

static void draw(struct fuzz *fuzz)
{
	void (*const ways[])(struct fuzz *) = { draw_ranges, draw_indices,
						draw_elements_one_by_one };
	bool listed = !test_below(&fuzz->seed, 4);

	if (listed)
		glNewList(1, test_below(&fuzz->seed, 2) ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
	ways[test_below(&fuzz->seed, 3)](fuzz);
	if (listed) {
		glEndList();
		glCallList(1);
	}
}

static void begin_draw(struct fuzz *fuzz)
{
	memset(fuzz->memory, 0, sizeof(fuzz->memory));
	fuzz->vertices = 1 + (GLsizei)test_below(&fuzz->seed, VERTICES);
	make_buffers(fuzz);
	for (int kind = 0; kind < ARRAYS; kind++)
		set_array(fuzz, (enum kind)kind);
	if (test_below(&fuzz->seed, 4))
		glDisable(GL_LIGHTING);
	else
		glEnable(GL_LIGHTING);
}

/* What was in this draw's memory is not to be read by a later one. */
static void end_draw(struct fuzz *fuzz)
{
	for (int kind = 0; kind < ARRAYS; kind++)
		glDisableClientState(kinds[kind].array);
	for (int i = 0; i <= ARRAYS; i++)
		free(fuzz->memory[i]);
}

static int draws_asked_for(void)
{
	const char *given = getenv("GL_ARRAYS");

	return given && atoi(given) > 0 ? atoi(given) : DRAWS;
}

static void arrays_of_any_form_are_drawn_without_an_error(void **state)
{
	struct fuzz fuzz = { .seed = test_seed() };

	(void)state;
	for (int n = 0; n < draws_asked_for(); n++) {
		GLenum error;

		begin_draw(&fuzz);
		draw(&fuzz);
		end_draw(&fuzz);
		error = glGetError();
		if (error)
			fail_msg("draw %d: error %#x", n, error);
		/* So that what is drawn comes to the core at times. */
		if (n % 64 == 63)
			glFinish();
	}
}

static void wrong_arguments_of_arrays_are_errors(void **state)
{
	static const GLubyte index[4] = { 0, 1, 2, 3 };
	static const GLfloat floats[8] = { 0 };
	const void *indices = index;
	const GLsizei minus = -1;

	(void)state;
	glVertexPointer(2, GL_FLOAT, 0, floats);
	glEnableClientState(GL_VERTEX_ARRAY);
	for (int kind = 0; kind < ARRAYS; kind++) {
		set_pointer((enum kind)kind, kinds[kind].least, kinds[kind].types[0], -1, floats);
		assert_int_equal(glGetError(), GL_INVALID_VALUE);
		if (kind == EDGE)
			continue;
		set_pointer((enum kind)kind, kinds[kind].least, GL_2_BYTES, 0, floats);
		assert_int_equal(glGetError(), GL_INVALID_ENUM);
		if (kinds[kind].least == kinds[kind].most && kind != SECONDARY)
			continue;
		set_pointer((enum kind)kind, kinds[kind].least - 1, kinds[kind].types[0], 0,
			    floats);
		assert_int_equal(glGetError(), GL_INVALID_VALUE);
		set_pointer((enum kind)kind, kinds[kind].most + 1, kinds[kind].types[0], 0, floats);
		assert_int_equal(glGetError(), GL_INVALID_VALUE);
	}
	glDrawArrays(GL_POLYGON + 1, 0, 3);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glDrawArrays(GL_POINTS, -1, 3);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glDrawArrays(GL_POINTS, INT_MAX, INT_MAX);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glDrawElements(GL_POINTS, 3, GL_BYTE, index);
	assert_int_equal(glGetError(), GL_INVALID_ENUM);
	glDrawRangeElements(GL_POINTS, 2, 1, 3, GL_UNSIGNED_BYTE, index);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glMultiDrawArrays(GL_POINTS, &minus, &minus, 1);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glMultiDrawElements(GL_POINTS, &minus, GL_UNSIGNED_BYTE, &indices, 1);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glMultiDrawArrays(GL_POINTS, NULL, NULL, -1);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glMultiDrawElements(GL_POINTS, NULL, GL_UNSIGNED_BYTE, NULL, -1);
	assert_int_equal(glGetError(), GL_INVALID_VALUE);
	glBegin(GL_POINTS);
	glDrawArrays(GL_POINTS, 0, 1);
	glEnd();
	assert_int_equal(glGetError(), GL_INVALID_OPERATION);
	assert_int_equal(gl_pixel(0, 0), BLACK);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(arrays_of_any_form_are_drawn_without_an_error),
		TEST(wrong_arguments_of_arrays_are_errors),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
