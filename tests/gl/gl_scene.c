// SPDX-License-Identifier: MIT
#include "gl_scene.h"

struct gl_display gl;

int gl_scene_setup(void **state)
{
	(void)state;
	gl_display_open(&gl);
	gl_display_context(&gl, gl_display_pbuffer(&gl, SIZE, SIZE), EGL_NO_CONTEXT);
	gl_clear(BLACK);
	glMatrixMode(GL_PROJECTION);
	glOrtho(0, SIZE, 0, SIZE, -1, 1);
	glMatrixMode(GL_MODELVIEW);
	return 0;
}

int gl_scene_teardown(void **state)
{
	(void)state;
	assert_int_equal(glGetError(), GL_NO_ERROR);
	assert_true(eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
	assert_true(eglTerminate(gl.display));
	assert_true(eglReleaseThread());
	return 0;
}

void square_corners(int x, int y)
{
	glVertex2i(x, y);
	glVertex2i(x + 8, y);
	glVertex2i(x + 8, y + 8);
	glVertex2i(x, y + 8);
}

void square(int x, int y)
{
	glBegin(GL_QUADS);
	square_corners(x, y);
	glEnd();
}
