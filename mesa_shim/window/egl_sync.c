// SPDX-License-Identifier: MIT
/*
 * Syncs of EGL 1.5. One is made by waiting for what was drawn, so each is signaled from the beginning
 * and all are alike: a handle says no more than that there is one.
 */
#include <stdlib.h>

#include "window/binding.h"
#include "window/egl.h"

struct egl_sync {
	struct egl_display *display;
};

EGLSync gloss_egl_create_sync(EGLDisplay dpy, EGLenum type, const EGLAttrib *attributes)
{
	struct egl_sync *sync;

	if (!gloss_egl_ready(dpy))
		return EGL_NO_SYNC;
	if (type != EGL_SYNC_FENCE || (attributes && attributes[0] != EGL_NONE)) {
		gloss_egl_result(EGL_BAD_ATTRIBUTE);
		return EGL_NO_SYNC;
	}
	if (!gloss_binding_current()) {
		gloss_egl_result(EGL_BAD_MATCH);
		return EGL_NO_SYNC;
	}
	sync = malloc(sizeof(*sync));
	if (!sync) {
		gloss_egl_result(EGL_BAD_ALLOC);
		return EGL_NO_SYNC;
	}
	sync->display = dpy;
	gloss_egl_wait_client();
	return sync;
}

/* Whether @handle is one of that display. A wild one is the program's fault, as it is elsewhere. */
static bool sync_valid(EGLDisplay dpy, EGLSync handle)
{
	const struct egl_sync *sync = handle;

	if (!gloss_egl_ready(dpy))
		return false;
	return gloss_egl_result(sync && sync->display == dpy ? EGL_SUCCESS : EGL_BAD_PARAMETER);
}

EGLBoolean gloss_egl_destroy_sync(EGLDisplay dpy, EGLSync sync)
{
	if (!sync_valid(dpy, sync))
		return EGL_FALSE;
	free(sync);
	return EGL_TRUE;
}

EGLint gloss_egl_client_wait_sync(EGLDisplay dpy, EGLSync sync, EGLint flags, EGLTime timeout)
{
	(void)flags;
	(void)timeout;
	return sync_valid(dpy, sync) ? EGL_CONDITION_SATISFIED : EGL_FALSE;
}

EGLBoolean gloss_egl_wait_sync(EGLDisplay dpy, EGLSync sync, EGLint flags)
{
	if (!sync_valid(dpy, sync))
		return EGL_FALSE;
	return gloss_egl_result(flags ? EGL_BAD_PARAMETER : EGL_SUCCESS);
}

EGLBoolean gloss_egl_get_sync_attrib(EGLDisplay dpy, EGLSync sync, EGLint name, EGLAttrib *value)
{
	if (!sync_valid(dpy, sync))
		return EGL_FALSE;
	switch (name) {
	case EGL_SYNC_TYPE:
		*value = EGL_SYNC_FENCE;
		return EGL_TRUE;
	case EGL_SYNC_STATUS:
		*value = EGL_SIGNALED;
		return EGL_TRUE;
	case EGL_SYNC_CONDITION:
		*value = EGL_SYNC_PRIOR_COMMANDS_COMPLETE;
		return EGL_TRUE;
	default:
		return gloss_egl_result(EGL_BAD_ATTRIBUTE);
	}
}
