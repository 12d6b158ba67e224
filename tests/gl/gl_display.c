// SPDX-License-Identifier: MIT
#include "gl_display.h"

#include <GL/gl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <string.h>

void gl_display_open(struct gl_display *gl)
{
	static const EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
					 EGL_OPENGL_BIT,   EGL_ALPHA_SIZE,  8,
					 EGL_NONE };
	EGLint major, minor, count;

	gl->display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, NULL, NULL);
	assert_non_null(gl->display);
	assert_true(eglInitialize(gl->display, &major, &minor));
	assert_int_equal(major * 10 + minor, 15);
	assert_string_equal(eglQueryString(gl->display, EGL_VENDOR), "Gloss");
	assert_true(eglBindAPI(EGL_OPENGL_API));
	assert_true(eglChooseConfig(gl->display, wanted, &gl->config, 1, &count));
	assert_int_equal(count, 1);
}

EGLSurface gl_display_pbuffer(const struct gl_display *gl, int width, int height)
{
	const EGLint size[] = { EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE };
	EGLSurface surface = eglCreatePbufferSurface(gl->display, gl->config, size);

	assert_ptr_not_equal(surface, EGL_NO_SURFACE);
	return surface;
}

EGLContext gl_display_context(const struct gl_display *gl, EGLSurface surface, EGLContext share)
{
	EGLContext context = eglCreateContext(gl->display, gl->config, share, NULL);

	assert_ptr_not_equal(context, EGL_NO_CONTEXT);
	assert_true(eglMakeCurrent(gl->display, surface, surface, context));
	gl_assert_gloss();
	return context;
}

void gl_assert_gloss(void)
{
	const char *renderer = (const char *)glGetString(GL_RENDERER);

	assert_non_null(renderer);
	assert_int_equal(strncmp(renderer, "Gloss", 5), 0);
	assert_string_equal((const char *)glGetString(GL_VENDOR), "Gloss");
}

void gl_clear(uint32_t rgba)
{
	glClearColor((float)(rgba & 255) / 255, (float)(rgba >> 8 & 255) / 255,
		     (float)(rgba >> 16 & 255) / 255, (float)(rgba >> 24) / 255);
	glClear(GL_COLOR_BUFFER_BIT);
}

uint32_t gl_pixel(int x, int y)
{
	uint8_t p[4] = { 0, 0, 0, 0 };

	glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p);
	return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}
