// SPDX-License-Identifier: MIT
/* EGL without a window system: displays, formats, pbuffers and their errors. */
#include <GL/gl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "gl_display.h"

static struct gl_display gl;

static int setup(void **state)
{
	(void)state;
	gl_display_open(&gl);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	assert_true(eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
	assert_true(eglTerminate(gl.display));
	assert_true(eglReleaseThread());
	return 0;
}

static void egl_clears_a_pbuffer(void **state)
{
	EGLSurface surface = gl_display_pbuffer(&gl, 70, 50);

	(void)state;
	gl_display_context(&gl, surface, EGL_NO_CONTEXT);
	gl_clear(0x40302010);
	assert_int_equal(gl_pixel(0, 0), 0x40302010);
	assert_int_equal(gl_pixel(69, 49), 0x40302010);
	assert_int_equal(glGetError(), GL_NO_ERROR);
}

static void egl_keeps_a_pbuffer_through_a_swap(void **state)
{
	EGLSurface surface = gl_display_pbuffer(&gl, 8, 8);

	(void)state;
	gl_display_context(&gl, surface, EGL_NO_CONTEXT);
	gl_clear(0xff112233);
	assert_true(eglSwapBuffers(gl.display, surface));
	assert_int_equal(gl_pixel(7, 0), 0xff112233);
}

static void egl_draws_nothing_without_a_surface(void **state)
{
	(void)state;
	gl_display_context(&gl, EGL_NO_SURFACE, EGL_NO_CONTEXT);
	gl_clear(0xffffffff);
	glFinish();
}

static void egl_says_what_it_is(void **state)
{
	(void)state;
	assert_string_equal(eglQueryString(gl.display, EGL_VERSION), "1.5");
	assert_string_equal(eglQueryString(gl.display, EGL_CLIENT_APIS), "OpenGL");
	assert_non_null(strstr(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS),
			       "EGL_MESA_platform_surfaceless"));
	gl_display_context(&gl, EGL_NO_SURFACE, EGL_NO_CONTEXT);
	assert_int_equal(strncmp((const char *)glGetString(GL_VERSION), "1.1", 3), 0);
	assert_true(strlen((const char *)glGetString(GL_EXTENSIONS)) < 2048);
}

static EGLint attribute(EGLConfig config, EGLint name)
{
	EGLint value = -1;

	assert_true(eglGetConfigAttrib(gl.display, config, name, &value));
	return value;
}

static void egl_formats_with_stencil_are_not_conformant(void **state)
{
	EGLConfig configs[16];
	EGLint count;

	(void)state;
	assert_true(eglGetConfigs(gl.display, configs, 16, &count));
	assert_int_equal(count, 4);
	for (int i = 0; i < count; i++) {
		assert_int_equal(attribute(configs[i], EGL_DEPTH_SIZE), 24);
		assert_int_equal(attribute(configs[i], EGL_RED_SIZE), 8);
		assert_int_equal(attribute(configs[i], EGL_CONFIG_CAVEAT),
				 attribute(configs[i], EGL_STENCIL_SIZE) ?
					 EGL_NON_CONFORMANT_CONFIG :
					 EGL_NONE);
		assert_int_equal(attribute(configs[i], EGL_SURFACE_TYPE), EGL_PBUFFER_BIT);
	}
}

static int choose(const EGLint *wanted, EGLConfig *first)
{
	EGLint count = -1;

	assert_true(eglChooseConfig(gl.display, wanted, first, 1, &count));
	return count;
}

static void egl_chooses_what_was_asked_for(void **state)
{
	static const EGLint plain[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE };
	static const EGLint stencil[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_STENCIL_SIZE, 1,
					  EGL_NONE };
	static const EGLint window[] = { EGL_SURFACE_TYPE, EGL_WINDOW_BIT, EGL_NONE };
	static const EGLint deep[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RED_SIZE, 16,
				       EGL_NONE };
	EGLConfig config;

	(void)state;
	assert_int_equal(choose(plain, &config), 1);
	assert_int_equal(attribute(config, EGL_ALPHA_SIZE), 0);
	assert_int_equal(attribute(config, EGL_STENCIL_SIZE), 0);
	assert_int_equal(choose(stencil, &config), 1);
	assert_int_equal(attribute(config, EGL_STENCIL_SIZE), 8);
	assert_int_equal(choose(window, &config), 0);
	assert_int_equal(choose(deep, &config), 0);
}

static void egl_reports_wrong_arguments(void **state)
{
	static const EGLint nonsense[] = { EGL_FALSE, 1, EGL_NONE };
	static const EGLint huge[] = { EGL_WIDTH, 100000, EGL_HEIGHT, 4, EGL_NONE };
	static const EGLint negative[] = { EGL_WIDTH, -1, EGL_NONE };
	EGLint count;

	(void)state;
	assert_false(eglChooseConfig(gl.display, nonsense, NULL, 0, &count));
	assert_int_equal(eglGetError(), EGL_BAD_ATTRIBUTE);
	assert_false(eglGetConfigAttrib(gl.display, &count, EGL_RED_SIZE, &count));
	assert_int_equal(eglGetError(), EGL_BAD_CONFIG);
	assert_null(eglCreatePbufferSurface(gl.display, gl.config, huge));
	assert_int_equal(eglGetError(), EGL_BAD_ALLOC);
	assert_null(eglCreatePbufferSurface(gl.display, gl.config, negative));
	assert_int_equal(eglGetError(), EGL_BAD_PARAMETER);
	assert_false(eglDestroySurface(gl.display, (EGLSurface)&count));
	assert_int_equal(eglGetError(), EGL_BAD_SURFACE);
	assert_false(eglDestroyContext(gl.display, (EGLContext)&count));
	assert_int_equal(eglGetError(), EGL_BAD_CONTEXT);
	assert_null(eglCreateWindowSurface(gl.display, gl.config, 1, NULL));
	assert_int_equal(eglGetError(), EGL_BAD_NATIVE_WINDOW);
	assert_int_equal(eglGetError(), EGL_SUCCESS);
}

static void egl_limits_the_largest_pbuffer(void **state)
{
	static const EGLint largest[] = { EGL_WIDTH,           100000,   EGL_HEIGHT, 4,
					  EGL_LARGEST_PBUFFER, EGL_TRUE, EGL_NONE };
	EGLSurface surface = eglCreatePbufferSurface(gl.display, gl.config, largest);
	EGLint width;

	(void)state;
	assert_non_null(surface);
	assert_true(eglQuerySurface(gl.display, surface, EGL_WIDTH, &width));
	assert_int_equal(width, 2048);
}

static void egl_is_over_after_terminate(void **state)
{
	EGLint count;

	(void)state;
	assert_true(eglTerminate(gl.display));
	assert_false(eglGetConfigs(gl.display, NULL, 0, &count));
	assert_int_equal(eglGetError(), EGL_NOT_INITIALIZED);
	assert_true(eglInitialize(gl.display, NULL, NULL));
	assert_true(eglGetConfigs(gl.display, NULL, 0, &count));
}

static void egl_syncs_are_signaled(void **state)
{
	EGLAttrib status = 0;
	EGLSync sync;

	(void)state;
	assert_ptr_equal(eglCreateSync(gl.display, EGL_SYNC_FENCE, NULL), EGL_NO_SYNC);
	assert_int_equal(eglGetError(), EGL_BAD_MATCH);
	gl_display_context(&gl, gl_display_pbuffer(&gl, 4, 4), EGL_NO_CONTEXT);
	gl_clear(0xff0000ff);
	sync = eglCreateSync(gl.display, EGL_SYNC_FENCE, NULL);
	assert_ptr_not_equal(sync, EGL_NO_SYNC);
	assert_int_equal(eglClientWaitSync(gl.display, sync, 0, 0), EGL_CONDITION_SATISFIED);
	assert_true(eglGetSyncAttrib(gl.display, sync, EGL_SYNC_STATUS, &status));
	assert_int_equal(status, EGL_SIGNALED);
	assert_true(eglDestroySync(gl.display, sync));
}

static void egl_without_a_device_has_no_context(void **state)
{
	char *device = getenv("GLOSS_DEVICE");

	(void)state;
	assert_non_null(device);
	setenv("GLOSS_DEVICE", "model:nonsense", 1);
	assert_ptr_equal(eglCreateContext(gl.display, gl.config, EGL_NO_CONTEXT, NULL),
			 EGL_NO_CONTEXT);
	assert_int_equal(eglGetError(), EGL_BAD_ALLOC);
	setenv("GLOSS_DEVICE", "model:", 1);
	gl_display_context(&gl, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

#define TEST(test) cmocka_unit_test_setup_teardown(test, setup, teardown)

/* That of no device comes first, as the device stays. */
int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(egl_without_a_device_has_no_context),
		TEST(egl_clears_a_pbuffer),
		TEST(egl_keeps_a_pbuffer_through_a_swap),
		TEST(egl_draws_nothing_without_a_surface),
		TEST(egl_says_what_it_is),
		TEST(egl_formats_with_stencil_are_not_conformant),
		TEST(egl_chooses_what_was_asked_for),
		TEST(egl_reports_wrong_arguments),
		TEST(egl_limits_the_largest_pbuffer),
		TEST(egl_is_over_after_terminate),
		TEST(egl_syncs_are_signaled),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
