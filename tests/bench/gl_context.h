/* SPDX-License-Identifier: MIT */
/* An OpenGL context of one of Mesa's drivers, without a window or a display. */
#ifndef TESTS_BENCH_GL_CONTEXT_H
#define TESTS_BENCH_GL_CONTEXT_H

#include <epoxy/gl.h>

#include "painter.h"

/*
 * Makes a context of @driver (llvmpipe, softpipe) current, which draws on colour and depth of its
 * own, of this size. Once in a process: the environment says which driver. @message: its version.
 * -ENODEV after @message.
 */
int gl_context_new(const char *driver, int width, int height, char message[PAINTER_MESSAGE]);

#endif
