// SPDX-License-Identifier: MIT
#include <X11/Xlib-xcb.h>
#include <stdlib.h>
#include <string.h>

#include "window/binding.h"
#include "window/egl.h"
#include "window/egl_objects.h"

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct egl_display *displays;

static _Thread_local EGLint error = EGL_SUCCESS;

EGLBoolean gloss_egl_result(EGLint result)
{
	error = result;
	return result == EGL_SUCCESS;
}

EGLint gloss_egl_get_error(void)
{
	EGLint last = error;

	error = EGL_SUCCESS;
	return last;
}

/* The connection that the program has, or one of our own to $DISPLAY. */
static xcb_connection_t *display_connect(EGLenum platform, void *native)
{
	xcb_connection_t *connection;

	if (native && platform == EGL_PLATFORM_XCB_EXT)
		return native;
	if (native)
		return XGetXCBConnection(native);
	connection = xcb_connect(NULL, NULL);
	if (!xcb_connection_has_error(connection))
		return connection;
	xcb_disconnect(connection);
	return NULL;
}

static struct egl_display *display_new(EGLenum platform, void *native)
{
	struct egl_display *display = calloc(1, sizeof(*display));

	if (!display)
		return NULL;
	display->platform = platform;
	display->native = native;
	if (platform != EGL_PLATFORM_SURFACELESS_MESA)
		display->connection = display_connect(platform, native);
	if (!display->connection && platform != EGL_PLATFORM_SURFACELESS_MESA &&
	    platform != EGL_NONE) {
		free(display);
		return NULL;
	}
	pthread_mutex_init(&display->lock, NULL);
	display->next = displays;
	displays = display;
	return display;
}

/* EGL_NONE is the default display: that of $DISPLAY, or without one a display without windows. */
EGLDisplay gloss_egl_platform_display(EGLenum platform, void *native, const EGLAttrib *attributes)
{
	struct egl_display *display;

	if (platform != EGL_NONE && platform != EGL_PLATFORM_X11_KHR &&
	    platform != EGL_PLATFORM_XCB_EXT && platform != EGL_PLATFORM_SURFACELESS_MESA)
		return EGL_NO_DISPLAY;
	if (platform == EGL_PLATFORM_SURFACELESS_MESA && native) {
		gloss_egl_result(EGL_BAD_PARAMETER);
		return EGL_NO_DISPLAY;
	}
	/* The one attribute there is on these platforms names a screen, and windows know theirs. */
	for (; attributes && attributes[0] != EGL_NONE; attributes += 2) {
		if (platform == EGL_PLATFORM_SURFACELESS_MESA) {
			gloss_egl_result(EGL_BAD_ATTRIBUTE);
			return EGL_NO_DISPLAY;
		}
	}
	pthread_mutex_lock(&lock);
	display = displays;
	while (display && (display->platform != platform || display->native != native))
		display = display->next;
	if (!display)
		display = display_new(platform, native);
	pthread_mutex_unlock(&lock);
	return display;
}

bool gloss_egl_ready(struct egl_display *display)
{
	bool ready;

	pthread_mutex_lock(&display->lock);
	ready = display->initialized;
	pthread_mutex_unlock(&display->lock);
	if (!ready)
		gloss_egl_result(EGL_NOT_INITIALIZED);
	return ready;
}

EGLBoolean gloss_egl_initialize(EGLDisplay dpy, EGLint *major, EGLint *minor)
{
	struct egl_display *display = dpy;

	pthread_mutex_lock(&display->lock);
	display->initialized = true;
	pthread_mutex_unlock(&display->lock);
	if (major)
		*major = 1;
	if (minor)
		*minor = 5;
	return gloss_egl_result(EGL_SUCCESS);
}

/* What is current in a thread stays that until the thread lets go. */
EGLBoolean gloss_egl_terminate(EGLDisplay dpy)
{
	struct egl_display *display = dpy;

	pthread_mutex_lock(&display->lock);
	while (display->surfaces)
		gloss_egl_surface_free(display, display->surfaces);
	while (display->contexts)
		gloss_egl_context_free(display, display->contexts);
	display->initialized = false;
	pthread_mutex_unlock(&display->lock);
	return gloss_egl_result(EGL_SUCCESS);
}

const char *gloss_egl_query_string(EGLDisplay dpy, EGLint name)
{
	if (dpy == EGL_NO_DISPLAY) {
		gloss_egl_result(name == EGL_EXTENSIONS ? EGL_SUCCESS : EGL_BAD_DISPLAY);
		return name == EGL_EXTENSIONS ? GLOSS_EGL_PLATFORMS : NULL;
	}
	if (!gloss_egl_ready(dpy))
		return NULL;
	gloss_egl_result(EGL_SUCCESS);
	switch (name) {
	case EGL_VENDOR:
		return "Gloss";
	case EGL_VERSION:
		return "1.5";
	case EGL_CLIENT_APIS:
		return "OpenGL";
	case EGL_EXTENSIONS:
		return "EGL_KHR_create_context EGL_KHR_no_config_context "
		       "EGL_KHR_surfaceless_context";
	default:
		break;
	}
	gloss_egl_result(EGL_BAD_PARAMETER);
	return NULL;
}

EGLBoolean gloss_egl_release_thread(void)
{
	gloss_binding_make_current(NULL, NULL, NULL);
	return gloss_egl_result(EGL_SUCCESS);
}
