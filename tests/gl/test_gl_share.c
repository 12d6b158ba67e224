// SPDX-License-Identifier: MIT
/* Lists and buffers that contexts share, also while another thread changes or deletes them. */
#include "gl_scene.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

#define ROUNDS 300
#define BUFFER 1
#define INDICES 2
#define LIST 3

static const GLfloat corners[] = { 0, 0, 8, 0, 8, 8, 0, 8 };
static const GLushort numbers[] = { 0, 1, 2, 3 };
static atomic_bool drawn;

/* A thread with a context that shares the first one's objects. */
struct other {
	EGLContext share;
	void (*work)(void);
};

static void *other_main(void *data)
{
	const struct other *other = data;
	EGLContext context;

	assert_true(eglBindAPI(EGL_OPENGL_API));
	context = gl_display_context(&gl, gl_display_pbuffer(&gl, 8, 8), other->share);
	other->work();
	assert_int_equal(glGetError(), GL_NO_ERROR);
	eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
	eglDestroyContext(gl.display, context);
	eglReleaseThread();
	return NULL;
}

static pthread_t other_start(struct other *other, void (*work)(void))
{
	pthread_t thread;

	*other = (struct other){ eglGetCurrentContext(), work };
	assert_int_equal(pthread_create(&thread, NULL, other_main, other), 0);
	return thread;
}

static void fill_buffers(void)
{
	glBindBuffer(GL_ARRAY_BUFFER, BUFFER);
	glBufferData(GL_ARRAY_BUFFER, sizeof(corners), corners, GL_STATIC_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, INDICES);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(numbers), numbers, GL_STATIC_DRAW);
}

static void compile_square(void)
{
	glNewList(LIST, GL_COMPILE);
	square(0, 0);
	glEndList();
}

static void what_one_context_makes_another_draws(void **state)
{
	struct other other;
	GLint size;

	(void)state;
	assert_int_equal(pthread_join(other_start(&other, fill_buffers), NULL), 0);
	assert_int_equal(pthread_join(other_start(&other, compile_square), NULL), 0);
	glTranslatef(16, 0, 0);
	glCallList(LIST);
	assert_int_equal(gl_pixel(20, 4), WHITE);
	glBindBuffer(GL_ARRAY_BUFFER, BUFFER);
	glGetBufferParameteriv(GL_ARRAY_BUFFER, GL_BUFFER_SIZE, &size);
	assert_int_equal(size, sizeof(corners));
	glVertexPointer(2, GL_FLOAT, 0, NULL);
	glEnableClientState(GL_VERTEX_ARRAY);
	glTranslatef(16, 0, 0);
	glDrawArrays(GL_QUADS, 0, 4);
	assert_int_equal(gl_pixel(36, 4), WHITE);
}

/* Deletes them, or gives them less, as long as the other draws. */
static void end_buffers(void)
{
	const GLuint names[] = { BUFFER, INDICES };

	for (int i = 0; !drawn; i++) {
		fill_buffers();
		if (i % 3 == 0)
			glBufferData(GL_ARRAY_BUFFER, 1, corners, GL_STATIC_DRAW);
		else if (i % 3 == 1)
			glBufferSubData(GL_ARRAY_BUFFER, 0, 8, corners);
		else
			glDeleteBuffers(2, names);
	}
}

static void buffers_end_in_one_thread_while_another_draws(void **state)
{
	struct other other;
	pthread_t thread;

	(void)state;
	fill_buffers();
	glVertexPointer(2, GL_FLOAT, 0, NULL);
	glEnableClientState(GL_VERTEX_ARRAY);
	drawn = false;
	thread = other_start(&other, end_buffers);
	for (int i = 0; i < ROUNDS; i++) {
		uint32_t pixel;

		gl_clear(BLACK);
		glDrawElements(GL_QUADS, 4, GL_UNSIGNED_SHORT, NULL);
		glDrawArrays(GL_QUADS, 0, 4);
		glBegin(GL_QUADS);
		for (int j = 0; j < 4; j++)
			glArrayElement(j);
		glEnd();
		pixel = gl_pixel(4, 4);
		assert_true(pixel == BLACK || pixel == WHITE);
	}
	drawn = true;
	assert_int_equal(pthread_join(thread, NULL), 0);
}

static void end_lists(void)
{
	for (int i = 0; !drawn; i++) {
		compile_square();
		if (i % 2)
			glDeleteLists(LIST, 1);
	}
}

static void lists_end_in_one_thread_while_another_plays(void **state)
{
	struct other other;
	pthread_t thread;

	(void)state;
	drawn = false;
	thread = other_start(&other, end_lists);
	for (int i = 0; i < ROUNDS; i++) {
		uint32_t pixel;

		gl_clear(BLACK);
		glCallList(LIST);
		pixel = gl_pixel(4, 4);
		assert_true(pixel == BLACK || pixel == WHITE);
	}
	drawn = true;
	assert_int_equal(pthread_join(thread, NULL), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(what_one_context_makes_another_draws),
		TEST(buffers_end_in_one_thread_while_another_draws),
		TEST(lists_end_in_one_thread_while_another_plays),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
