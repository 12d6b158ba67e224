// SPDX-License-Identifier: MIT
/* GLX and EGL on windows of an X server, whose pixels are asked for. */
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <cmocka.h>
#include <string.h>

#include "gl_display.h"

static Display *dpy;
static Window window;
static XVisualInfo *visual;

static Window window_new(int width, int height)
{
	XSetWindowAttributes attributes = { .colormap = XCreateColormap(dpy, DefaultRootWindow(dpy),
									visual->visual, AllocNone),
					    .override_redirect = True };
	Window made = XCreateWindow(dpy, DefaultRootWindow(dpy), 0, 0, (unsigned int)width,
				    (unsigned int)height, 0, visual->depth, InputOutput,
				    visual->visual, CWColormap | CWOverrideRedirect | CWBorderPixel,
				    &attributes);

	XMapWindow(dpy, made);
	XSync(dpy, False);
	return made;
}

static int setup(void **state)
{
	static int wanted[] = {
		GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 1, GLX_DEPTH_SIZE, 1, None
	};

	(void)state;
	dpy = XOpenDisplay(NULL);
	assert_non_null(dpy);
	visual = glXChooseVisual(dpy, DefaultScreen(dpy), wanted);
	assert_non_null(visual);
	window = window_new(60, 40);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	glXMakeCurrent(dpy, None, NULL);
	XFree(visual);
	XCloseDisplay(dpy);
	return 0;
}

static GLXContext context_new(GLXContext share)
{
	GLXContext context = glXCreateContext(dpy, visual, share, True);

	assert_non_null(context);
	return context;
}

/* As far as the screen's colours go: 0xRRGGBB, each 0 or ff. */
static unsigned long screen_pixel(Drawable drawable, int x, int y)
{
	XImage *image = XGetImage(dpy, drawable, x, y, 1, 1, AllPlanes, ZPixmap);
	unsigned long pixel, colour;

	assert_non_null(image);
	pixel = XGetPixel(image, 0, 0);
	colour = (pixel & visual->red_mask ? 0xff0000 : 0) |
		 (pixel & visual->green_mask ? 0xff00 : 0) | (pixel & visual->blue_mask ? 0xff : 0);
	XDestroyImage(image);
	return colour;
}

static void glx_shows_a_picture_at_the_swap(void **state)
{
	GLXContext context = context_new(NULL);

	(void)state;
	assert_true(glXMakeCurrent(dpy, window, context));
	gl_assert_gloss();
	gl_clear(0xffff0000);
	glFinish();
	assert_int_equal(screen_pixel(window, 30, 20), 0);
	glXSwapBuffers(dpy, window);
	assert_int_equal(screen_pixel(window, 0, 0), 0x0000ff);
	assert_int_equal(screen_pixel(window, 59, 39), 0x0000ff);
	gl_clear(0xff0000ff);
	glXSwapBuffers(dpy, window);
	assert_int_equal(screen_pixel(window, 59, 39), 0xff0000);
	glXDestroyContext(dpy, context);
}

static void glx_takes_a_new_size_after_the_swap(void **state)
{
	(void)state;
	assert_true(glXMakeCurrent(dpy, window, context_new(NULL)));
	gl_clear(0xff0000ff);
	glXSwapBuffers(dpy, window);
	XResizeWindow(dpy, window, 100, 80);
	XSync(dpy, False);
	gl_clear(0xff00ff00);
	assert_int_equal(gl_pixel(99, 79), 0xff00ff00);
	glXSwapBuffers(dpy, window);
	assert_int_equal(screen_pixel(window, 99, 0), 0x00ff00);
	assert_int_equal(screen_pixel(window, 0, 79), 0x00ff00);
}

/* The server is told by another connection; the program goes on. */
static void glx_survives_a_window_that_is_gone(void **state)
{
	Display *other = XOpenDisplay(NULL);
	GLXContext context = context_new(NULL);
	Window next;

	(void)state;
	assert_true(glXMakeCurrent(dpy, window, context));
	gl_clear(0xff0000ff);
	glXSwapBuffers(dpy, window);
	XDestroyWindow(other, window);
	XSync(other, False);
	XCloseDisplay(other);
	for (int frame = 0; frame < 3; frame++) {
		gl_clear(0xff00ff00);
		glXSwapBuffers(dpy, window);
	}
	assert_false(glXMakeCurrent(dpy, None, context));
	next = window_new(8, 8);
	assert_true(glXMakeCurrent(dpy, next, context));
	gl_clear(0xffff0000);
	glXSwapBuffers(dpy, next);
	assert_int_equal(screen_pixel(next, 4, 4), 0x0000ff);
}

static void glx_draws_on_two_displays(void **state)
{
	Display *first = dpy, *second = XOpenDisplay(NULL);
	Window theirs, mine = window;

	(void)state;
	assert_true(glXMakeCurrent(first, mine, context_new(NULL)));
	gl_clear(0xff0000ff);
	glXSwapBuffers(first, mine);
	dpy = second;
	theirs = window_new(20, 20);
	assert_true(glXMakeCurrent(second, theirs, context_new(NULL)));
	gl_clear(0xff00ff00);
	glXSwapBuffers(second, theirs);
	assert_int_equal(screen_pixel(theirs, 3, 3), 0x00ff00);
	/* The display is closed while a context draws on its window. */
	XCloseDisplay(second);
	dpy = first;
	gl_clear(0xffffffff);
	glFinish();
	assert_true(glXMakeCurrent(first, None, NULL));
	assert_int_equal(screen_pixel(mine, 30, 30), 0xff0000);
}

static void glx_draws_on_a_pbuffer(void **state)
{
	static const int size[] = { GLX_PBUFFER_WIDTH, 30, GLX_PBUFFER_HEIGHT, 20, None };
	static const int wanted[] = { GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT, GLX_ALPHA_SIZE, 8, None };
	GLXFBConfig *configs;
	GLXPbuffer pbuffer;
	unsigned int width;
	int count;

	(void)state;
	configs = glXChooseFBConfig(dpy, DefaultScreen(dpy), wanted, &count);
	assert_non_null(configs);
	pbuffer = glXCreatePbuffer(dpy, configs[0], size);
	assert_true(pbuffer);
	assert_true(glXMakeContextCurrent(dpy, pbuffer, pbuffer,
					  glXCreateNewContext(dpy, configs[0], GLX_RGBA_TYPE, NULL,
							      True)));
	gl_assert_gloss();
	gl_clear(0x80402010);
	assert_int_equal(gl_pixel(29, 19), 0x80402010);
	glXQueryDrawable(dpy, pbuffer, GLX_WIDTH, &width);
	assert_int_equal(width, 30);
	glXDestroyPbuffer(dpy, pbuffer);
	XFree(configs);
}

/* A pixmap has no swap: it has what was drawn when that is finished. */
static void glx_draws_on_a_pixmap(void **state)
{
	static const int wanted[] = { GLX_DRAWABLE_TYPE, GLX_PIXMAP_BIT, GLX_DOUBLEBUFFER, False,
				      None };
	Pixmap pixmap = XCreatePixmap(dpy, window, 24, 24, (unsigned int)visual->depth);
	GLXFBConfig *configs;
	GLXPixmap target;
	int count;

	(void)state;
	configs = glXChooseFBConfig(dpy, DefaultScreen(dpy), wanted, &count);
	assert_non_null(configs);
	target = glXCreatePixmap(dpy, configs[0], pixmap, NULL);
	assert_true(glXMakeContextCurrent(dpy, target, target,
					  glXCreateNewContext(dpy, configs[0], GLX_RGBA_TYPE, NULL,
							      True)));
	gl_clear(0xff00ffff);
	glXWaitGL();
	assert_int_equal(screen_pixel(pixmap, 23, 23), 0xffff00);
	XFree(configs);
}

static void glx_says_what_it_is(void **state)
{
	int major, minor;

	(void)state;
	assert_true(glXQueryVersion(dpy, &major, &minor));
	assert_int_equal(major * 10 + minor, 14);
	assert_string_equal(glXQueryServerString(dpy, DefaultScreen(dpy), GLX_VENDOR), "Gloss");
	assert_non_null(
		strstr(glXQueryExtensionsString(dpy, DefaultScreen(dpy)), "GLX_EXT_swap_control"));
}

static void glx_refuses_versions_with_shaders(void **state)
{
	static const int core[] = { GLX_CONTEXT_MAJOR_VERSION_ARB, 3, None };
	PFNGLXCREATECONTEXTATTRIBSARBPROC create = (PFNGLXCREATECONTEXTATTRIBSARBPROC)
		glXGetProcAddress((const GLubyte *)"glXCreateContextAttribsARB");
	int count;
	GLXFBConfig *configs = glXGetFBConfigs(dpy, DefaultScreen(dpy), &count);

	(void)state;
	assert_non_null(create);
	assert_null(create(dpy, configs[0], NULL, True, core));
	assert_non_null(create(dpy, configs[0], NULL, True, NULL));
	XFree(configs);
}

static void glx_swap_intervals_are_kept(void **state)
{
	PFNGLXSWAPINTERVALEXTPROC set = (PFNGLXSWAPINTERVALEXTPROC)glXGetProcAddress(
		(const GLubyte *)"glXSwapIntervalEXT");
	PFNGLXGETSWAPINTERVALMESAPROC get = (PFNGLXGETSWAPINTERVALMESAPROC)glXGetProcAddress(
		(const GLubyte *)"glXGetSwapIntervalMESA");
	unsigned int interval;

	(void)state;
	assert_true(glXMakeCurrent(dpy, window, context_new(NULL)));
	set(dpy, window, 2);
	assert_int_equal(get(), 2);
	glXQueryDrawable(dpy, window, GLX_SWAP_INTERVAL_EXT, &interval);
	assert_int_equal(interval, 2);
	set(dpy, window, 0);
	assert_int_equal(get(), 0);
}

static void egl_shows_a_picture_at_the_swap(void **state)
{
	struct gl_display gl = { .display = eglGetDisplay((EGLNativeDisplayType)dpy) };
	EGLSurface surface;
	EGLint count, width;

	(void)state;
	assert_true(eglInitialize(gl.display, NULL, NULL));
	assert_true(eglBindAPI(EGL_OPENGL_API));
	assert_true(eglChooseConfig(gl.display, NULL, &gl.config, 1, &count));
	assert_int_equal(count, 1);
	surface = eglCreateWindowSurface(gl.display, gl.config, window, NULL);
	assert_non_null(surface);
	gl_display_context(&gl, surface, EGL_NO_CONTEXT);
	gl_clear(0xff0000ff);
	assert_true(eglSwapBuffers(gl.display, surface));
	assert_int_equal(screen_pixel(window, 59, 39), 0xff0000);
	assert_true(eglQuerySurface(gl.display, surface, EGL_WIDTH, &width));
	assert_int_equal(width, 60);
	assert_null(eglCreateWindowSurface(gl.display, gl.config, 12345, NULL));
	assert_int_equal(eglGetError(), EGL_BAD_NATIVE_WINDOW);
	XDestroyWindow(dpy, window);
	XSync(dpy, False);
	assert_false(eglSwapBuffers(gl.display, surface));
	assert_int_equal(eglGetError(), EGL_BAD_NATIVE_WINDOW);
	assert_true(eglMakeCurrent(gl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
	assert_true(eglTerminate(gl.display));
}

#define TEST(test) cmocka_unit_test_setup_teardown(test, setup, teardown)

int main(void)
{
	static const struct CMUnitTest tests[] = {
		TEST(glx_shows_a_picture_at_the_swap),
		TEST(glx_takes_a_new_size_after_the_swap),
		TEST(glx_survives_a_window_that_is_gone),
		TEST(glx_draws_on_two_displays),
		TEST(glx_draws_on_a_pbuffer),
		TEST(glx_draws_on_a_pixmap),
		TEST(glx_says_what_it_is),
		TEST(glx_refuses_versions_with_shaders),
		TEST(glx_swap_intervals_are_kept),
		TEST(egl_shows_a_picture_at_the_swap),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
