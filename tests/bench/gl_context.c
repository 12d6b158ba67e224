// SPDX-License-Identifier: MIT
/* Mesa is asked for by EGL on no surface. libepoxy opens it at run time, and may find nothing. */
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl_context.h"

static int missing(char message[PAINTER_MESSAGE], const char *driver, const char *what,
		   const char *packages)
{
	snprintf(message, PAINTER_MESSAGE, "%s: %s; Debian has it in %s", driver, what, packages);
	return -ENODEV;
}

/* libepoxy ends the program if it finds no library at all. */
static bool there_is(const char *library)
{
	return dlopen(library, RTLD_LAZY | RTLD_LOCAL) != NULL;
}

static EGLDisplay open_display(void)
{
	EGLDisplay display = EGL_NO_DISPLAY;

	if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") &&
	    epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
		display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
						   EGL_DEFAULT_DISPLAY, NULL);
	return display && eglInitialize(display, NULL, NULL) ? display : EGL_NO_DISPLAY;
}

static bool make_current(void)
{
	static const EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
					 EGL_OPENGL_BIT, EGL_NONE };
	EGLDisplay display = open_display();
	EGLContext context;
	EGLConfig config;
	EGLint count;

	if (!display || !eglBindAPI(EGL_OPENGL_API) ||
	    !eglChooseConfig(display, wanted, &config, 1, &count) || !count)
		return false;
	context = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
	return context && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
}

static bool make_target(int width, int height)
{
	GLuint frame, buffer[2];

	glGenFramebuffers(1, &frame);
	glGenRenderbuffers(2, buffer);
	glBindFramebuffer(GL_FRAMEBUFFER, frame);
	glBindRenderbuffer(GL_RENDERBUFFER, buffer[0]);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer[0]);
	glBindRenderbuffer(GL_RENDERBUFFER, buffer[1]);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffer[1]);
	glViewport(0, 0, width, height);
	return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

int gl_context_new(const char *driver, int width, int height, char message[PAINTER_MESSAGE])
{
	const char *renderer;

	/* All in one thread; threads would gain nothing, as processor time is counted. */
	setenv("LP_NUM_THREADS", "0", 1);
	setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
	setenv("GALLIUM_DRIVER", driver, 1);
	setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);
	if (!there_is("libEGL.so.1"))
		return missing(message, driver, "there is no libEGL.so.1", "libegl1");
	if (!there_is("libOpenGL.so.0") && !there_is("libGL.so.1"))
		return missing(message, driver, "there is no libOpenGL.so.0", "libopengl0");
	if (!make_current())
		return missing(message, driver, "EGL has no OpenGL without a surface",
			       "libegl-mesa0 and libgl1-mesa-dri");
	renderer = (const char *)glGetString(GL_RENDERER);
	if (!renderer || strncmp(renderer, driver, strlen(driver)) != 0)
		return missing(message, driver, "OpenGL has another driver", "libgl1-mesa-dri");
	if (!make_target(width, height))
		return missing(message, driver, "OpenGL has no framebuffer of this size",
			       "libgl1-mesa-dri");
	snprintf(message, PAINTER_MESSAGE, "%s, OpenGL %s", renderer,
		 (const char *)glGetString(GL_VERSION));
	return 0;
}
