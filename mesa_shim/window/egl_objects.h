/* SPDX-License-Identifier: MIT */
/* What the files of EGL share among themselves. */
#ifndef GLOSS_EGL_OBJECTS_H
#define GLOSS_EGL_OBJECTS_H

#include "window/egl.h"

#define GLOSS_EGL_PLATFORMS                                                                          \
	"EGL_EXT_client_extensions EGL_EXT_platform_base EGL_EXT_platform_x11 EGL_KHR_platform_x11 " \
	"EGL_EXT_platform_xcb EGL_MESA_platform_surfaceless"

/* With the display's lock: takes the object off its list and lets go of it. */
void gloss_egl_surface_free(struct egl_display *display, struct egl_surface *surface);
void gloss_egl_context_free(struct egl_display *display, struct egl_context *context);

#endif
