/* SPDX-License-Identifier: MIT */
/* What tests of drawing begin with: a black pbuffer, in which one unit is one pixel. */
#ifndef GL_SCENE_H
#define GL_SCENE_H

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "gl_display.h"

#define SIZE 64
#define RED 0xff0000ffu
#define GREEN 0xff00ff00u
#define BLUE 0xffff0000u
#define WHITE 0xffffffffu
#define BLACK 0xff000000u

extern struct gl_display gl;

int gl_scene_setup(void **state);
/* Fails if an error was not asked for. */
int gl_scene_teardown(void **state);
/* The corners of a square of eight pixels whose lower left is @x, @y, and the square in the current colour. */
void square_corners(int x, int y);
void square(int x, int y);

#define TEST(name) cmocka_unit_test_setup_teardown(name, gl_scene_setup, gl_scene_teardown)

#endif
