/* SPDX-License-Identifier: MIT */
/* What tests of EGL begin with. A libglvnd that does not find the vendor library takes Mesa without a
 * word, so each asserts whom it has. */
#ifndef GL_DISPLAY_H
#define GL_DISPLAY_H

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdint.h>

struct gl_display {
	EGLDisplay display;
	EGLConfig config; /* with alpha, without stencil */
};

/* Initializes the display without windows. */
void gl_display_open(struct gl_display *gl);
EGLSurface gl_display_pbuffer(const struct gl_display *gl, int width, int height);
/* A context, current on @surface, which may be EGL_NO_SURFACE. */
EGLContext gl_display_context(const struct gl_display *gl, EGLSurface surface, EGLContext share);
/* Whether the current context is Gloss's. */
void gl_assert_gloss(void);
/* Clears all to a colour of bytes. */
void gl_clear(uint32_t rgba);
/* A pixel, from the lower left corner: R in the lowest byte. */
uint32_t gl_pixel(int x, int y);

#endif
