/* SPDX-License-Identifier: MIT */
/*
 * EGL 1.5 behind libglvnd's libEGL, which checks displays and hands the calls on. Errors are this
 * thread's, as EGL has them; each function here that fails has set one.
 */
#ifndef GLOSS_EGL_H
#define GLOSS_EGL_H

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <pthread.h>
#include <stdbool.h>
#include <xcb/xcb.h>

struct gloss_binding;
struct gloss_config;
struct gloss_surface;

struct egl_surface {
	struct egl_surface *next;
	struct gloss_surface *surface;
	EGLint type; /* EGL_WINDOW_BIT, EGL_PIXMAP_BIT or EGL_PBUFFER_BIT */
};

struct egl_context {
	struct egl_context *next;
	struct gloss_binding *binding;
};

/* A display is there for ever, as programs may keep its handle. */
struct egl_display {
	struct egl_display *next;
	EGLenum platform;
	void *native;                 /* what the program has named it by */
	xcb_connection_t *connection; /* NULL: without windows */
	pthread_mutex_t lock;         /* protects what follows */
	bool initialized;
	struct egl_surface *surfaces;
	struct egl_context *contexts;
};

/* Sets the thread's error and returns whether that is EGL_SUCCESS. */
EGLBoolean gloss_egl_result(EGLint error);
EGLint gloss_egl_get_error(void);

/* libglvnd's way of opening a display. NULL: not of a kind that is known. */
EGLDisplay gloss_egl_platform_display(EGLenum platform, void *native, const EGLAttrib *attributes);
/* False: not initialized. */
bool gloss_egl_ready(struct egl_display *display);
/* NULL, with an error: there is no such object. */
struct egl_surface *gloss_egl_surface(struct egl_display *display, EGLSurface surface);
struct egl_context *gloss_egl_context(struct egl_display *display, EGLContext context);
const struct gloss_config *gloss_egl_config(struct egl_display *display, EGLConfig config);
/* The API that is bound in this thread, as libEGL has it. */
EGLenum gloss_egl_api(void);

EGLBoolean gloss_egl_initialize(EGLDisplay dpy, EGLint *major, EGLint *minor);
EGLBoolean gloss_egl_terminate(EGLDisplay dpy);
const char *gloss_egl_query_string(EGLDisplay dpy, EGLint name);
EGLBoolean gloss_egl_release_thread(void);

EGLBoolean gloss_egl_get_configs(EGLDisplay dpy, EGLConfig *configs, EGLint size, EGLint *count);
EGLBoolean gloss_egl_choose_config(EGLDisplay dpy, const EGLint *wanted, EGLConfig *configs,
				   EGLint size, EGLint *count);
EGLBoolean gloss_egl_get_config_attrib(EGLDisplay dpy, EGLConfig config, EGLint name,
				       EGLint *value);

EGLContext gloss_egl_create_context(EGLDisplay dpy, EGLConfig config, EGLContext share,
				    const EGLint *attributes);
EGLBoolean gloss_egl_destroy_context(EGLDisplay dpy, EGLContext context);
EGLBoolean gloss_egl_query_context(EGLDisplay dpy, EGLContext context, EGLint name, EGLint *value);
EGLBoolean gloss_egl_make_current(EGLDisplay dpy, EGLSurface draw, EGLSurface read,
				  EGLContext context);
EGLBoolean gloss_egl_wait_client(void);
EGLBoolean gloss_egl_wait_native(EGLint engine);

EGLSurface gloss_egl_create_window(EGLDisplay dpy, EGLConfig config, EGLNativeWindowType window,
				   const EGLint *attributes);
EGLSurface gloss_egl_create_pixmap(EGLDisplay dpy, EGLConfig config, EGLNativePixmapType pixmap,
				   const EGLint *attributes);
EGLSurface gloss_egl_create_platform_window(EGLDisplay dpy, EGLConfig config, void *window,
					    const EGLAttrib *attributes);
EGLSurface gloss_egl_create_platform_pixmap(EGLDisplay dpy, EGLConfig config, void *pixmap,
					    const EGLAttrib *attributes);
EGLSurface gloss_egl_create_pbuffer(EGLDisplay dpy, EGLConfig config, const EGLint *attributes);
EGLSurface gloss_egl_create_pbuffer_from(EGLDisplay dpy, EGLenum type, EGLClientBuffer buffer,
					 EGLConfig config, const EGLint *attributes);
EGLBoolean gloss_egl_destroy_surface(EGLDisplay dpy, EGLSurface surface);
EGLBoolean gloss_egl_query_surface(EGLDisplay dpy, EGLSurface surface, EGLint name, EGLint *value);
EGLBoolean gloss_egl_surface_attrib(EGLDisplay dpy, EGLSurface surface, EGLint name, EGLint value);
EGLBoolean gloss_egl_swap_buffers(EGLDisplay dpy, EGLSurface surface);
EGLBoolean gloss_egl_swap_interval(EGLDisplay dpy, EGLint interval);
EGLBoolean gloss_egl_copy_buffers(EGLDisplay dpy, EGLSurface surface, EGLNativePixmapType target);
EGLBoolean gloss_egl_tex_image(EGLDisplay dpy, EGLSurface surface, EGLint buffer);

EGLSync gloss_egl_create_sync(EGLDisplay dpy, EGLenum type, const EGLAttrib *attributes);
EGLBoolean gloss_egl_destroy_sync(EGLDisplay dpy, EGLSync sync);
EGLint gloss_egl_client_wait_sync(EGLDisplay dpy, EGLSync sync, EGLint flags, EGLTime timeout);
EGLBoolean gloss_egl_wait_sync(EGLDisplay dpy, EGLSync sync, EGLint flags);
EGLBoolean gloss_egl_get_sync_attrib(EGLDisplay dpy, EGLSync sync, EGLint name, EGLAttrib *value);

#endif
