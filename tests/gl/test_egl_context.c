// SPDX-License-Identifier: MIT
/* Contexts, threads and processes. */
#include <GL/gl.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <cmocka.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gl_display.h"

static struct gl_display gl;
static EGLSurface one, two;

static int setup(void **state)
{
	(void)state;
	gl_display_open(&gl);
	one = gl_display_pbuffer(&gl, 16, 16);
	two = gl_display_pbuffer(&gl, 32, 16);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
	assert_true(eglTerminate(gl.display));
	return 0;
}

static void two_contexts_draw_on_one_surface(void **state)
{
	EGLContext first = gl_display_context(&gl, one, EGL_NO_CONTEXT), second;

	(void)state;
	gl_clear(0xff000001);
	second = gl_display_context(&gl, one, first);
	assert_int_equal(gl_pixel(3, 3), 0xff000001);
	gl_clear(0xff000002);
	assert_true(eglMakeCurrent(gl.display, one, one, first));
	assert_int_equal(gl_pixel(3, 3), 0xff000002);
	/* The clear colour is the context's, not the surface's. */
	glClear(GL_COLOR_BUFFER_BIT);
	assert_int_equal(gl_pixel(3, 3), 0xff000001);
	assert_true(eglDestroyContext(gl.display, second));
}

static void a_context_draws_on_two_surfaces(void **state)
{
	EGLContext context = gl_display_context(&gl, one, EGL_NO_CONTEXT);

	(void)state;
	gl_clear(0xff000003);
	assert_true(eglMakeCurrent(gl.display, two, two, context));
	gl_clear(0xff000004);
	assert_int_equal(gl_pixel(31, 0), 0xff000004);
	assert_true(eglMakeCurrent(gl.display, two, one, context));
	assert_int_equal(gl_pixel(15, 15), 0xff000003);
}

static void what_is_current_outlives_its_destruction(void **state)
{
	EGLContext context = gl_display_context(&gl, one, EGL_NO_CONTEXT);

	(void)state;
	assert_true(eglDestroySurface(gl.display, one));
	assert_true(eglDestroyContext(gl.display, context));
	gl_clear(0xff000005);
	assert_int_equal(gl_pixel(0, 0), 0xff000005);
	assert_true(eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
	assert_false(eglMakeCurrent(gl.display, two, two, context));
	assert_int_equal(eglGetError(), EGL_BAD_CONTEXT);
}

static void *take(void *context)
{
	EGLBoolean taken;

	assert_true(eglBindAPI(EGL_OPENGL_API));
	taken = eglMakeCurrent(gl.display, two, two, context);
	if (taken) {
		gl_clear(0xff000006);
		glFinish();
	} else {
		assert_int_equal(eglGetError(), EGL_BAD_ACCESS);
	}
	return taken ? context : NULL;
}

static void *in_thread(void *context)
{
	pthread_t thread;
	void *result;

	assert_int_equal(pthread_create(&thread, NULL, take, context), 0);
	assert_int_equal(pthread_join(thread, &result), 0);
	return result;
}

static void a_context_has_one_thread(void **state)
{
	EGLContext context = gl_display_context(&gl, one, EGL_NO_CONTEXT);

	(void)state;
	assert_null(in_thread(context));
	assert_true(eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
	assert_ptr_equal(in_thread(context), context);
	/* The thread has ended without letting go. */
	assert_true(eglMakeCurrent(gl.display, two, two, context));
	assert_int_equal(gl_pixel(0, 0), 0xff000006);
}

struct job {
	uint32_t colour;
	bool drawn;
};

static void *draw(void *data)
{
	EGLSurface surface = gl_display_pbuffer(&gl, 40, 40);
	struct job *job = data;
	EGLContext context;

	assert_true(eglBindAPI(EGL_OPENGL_API));
	context = gl_display_context(&gl, surface, EGL_NO_CONTEXT);
	job->drawn = true;
	for (uint32_t i = 0; i < 20; i++) {
		gl_clear(job->colour + i);
		job->drawn &= gl_pixel((int)i, (int)i) == job->colour + i;
	}
	eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
	eglDestroyContext(gl.display, context);
	eglDestroySurface(gl.display, surface);
	return NULL;
}

static void threads_draw_at_once(void **state)
{
	struct job jobs[] = { { .colour = 0xff100000 }, { .colour = 0xff200000 } };
	pthread_t threads[2];

	(void)state;
	for (int i = 0; i < 2; i++)
		assert_int_equal(pthread_create(&threads[i], NULL, draw, &jobs[i]), 0);
	for (int i = 0; i < 2; i++) {
		assert_int_equal(pthread_join(threads[i], NULL), 0);
		assert_true(jobs[i].drawn);
	}
}

static void a_child_has_a_device_of_its_own(void **state)
{
	EGLContext context = gl_display_context(&gl, one, EGL_NO_CONTEXT);
	int status;
	pid_t child;

	(void)state;
	gl_clear(0xff000007);
	glFinish();
	assert_true(eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
	child = fork();
	if (!child) {
		struct job job = { .colour = 0xff300000 };

		draw(&job);
		_exit(job.drawn ? 0 : 1);
	}
	assert_int_equal(waitpid(child, &status, 0), child);
	assert_int_equal(status, 0);
	assert_true(eglMakeCurrent(gl.display, one, one, context));
	assert_int_equal(gl_pixel(0, 0), 0xff000007);
}

#define TEST(test) cmocka_unit_test_setup_teardown(test, setup, teardown)

int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(two_contexts_draw_on_one_surface),
		TEST(a_context_draws_on_two_surfaces),
		TEST(what_is_current_outlives_its_destruction),
		TEST(a_context_has_one_thread),
		TEST(threads_draw_at_once),
		TEST(a_child_has_a_device_of_its_own),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
