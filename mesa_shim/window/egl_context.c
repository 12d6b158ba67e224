// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>

#include "state/context.h"
#include "window/binding.h"
#include "window/config.h"
#include "window/egl.h"
#include "window/egl_objects.h"

struct egl_context *gloss_egl_context(struct egl_display *display, EGLContext handle)
{
	struct egl_context *context;

	if (!gloss_egl_ready(display))
		return NULL;
	pthread_mutex_lock(&display->lock);
	context = display->contexts;
	while (context && context != handle)
		context = context->next;
	pthread_mutex_unlock(&display->lock);
	if (!context)
		gloss_egl_result(EGL_BAD_CONTEXT);
	return context;
}

/* Versions above 1.x and profiles are for programs with shaders. */
static EGLint context_attributes(const EGLint *attributes)
{
	EGLint major = 1;

	for (; attributes && attributes[0] != EGL_NONE; attributes += 2) {
		switch (attributes[0]) {
		case EGL_CONTEXT_MAJOR_VERSION:
			major = attributes[1];
			break;
		case EGL_CONTEXT_MINOR_VERSION:
		case EGL_CONTEXT_FLAGS_KHR:
		case EGL_CONTEXT_OPENGL_PROFILE_MASK:
		case EGL_CONTEXT_OPENGL_DEBUG:
		case EGL_CONTEXT_OPENGL_FORWARD_COMPATIBLE:
		case EGL_CONTEXT_OPENGL_ROBUST_ACCESS:
		case EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY:
			break;
		default:
			return EGL_BAD_ATTRIBUTE;
		}
	}
	return major == 1 ? EGL_SUCCESS : EGL_BAD_MATCH;
}

static struct egl_context *context_new(struct egl_display *display,
				       const struct gloss_config *config,
				       struct gloss_binding *share)
{
	struct egl_context *context = calloc(1, sizeof(*context));

	if (!context || gloss_binding_new(config, display, 0, share, &context->binding)) {
		free(context);
		gloss_egl_result(EGL_BAD_ALLOC);
		return NULL;
	}
	pthread_mutex_lock(&display->lock);
	context->next = display->contexts;
	display->contexts = context;
	pthread_mutex_unlock(&display->lock);
	gloss_egl_result(EGL_SUCCESS);
	return context;
}

EGLContext gloss_egl_create_context(EGLDisplay dpy, EGLConfig handle, EGLContext share,
				    const EGLint *attributes)
{
	const struct gloss_config *config = NULL;
	struct egl_context *shared = NULL;

	if (!gloss_egl_ready(dpy))
		return EGL_NO_CONTEXT;
	if (handle != EGL_NO_CONFIG_KHR) {
		config = gloss_egl_config(dpy, handle);
		if (!config)
			return EGL_NO_CONTEXT;
	}
	if (share != EGL_NO_CONTEXT) {
		shared = gloss_egl_context(dpy, share);
		if (!shared)
			return EGL_NO_CONTEXT;
	}
	if (gloss_egl_api() != EGL_OPENGL_API) {
		gloss_egl_result(EGL_BAD_MATCH);
		return EGL_NO_CONTEXT;
	}
	if (!gloss_egl_result(context_attributes(attributes)))
		return EGL_NO_CONTEXT;
	return context_new(dpy, config, shared ? shared->binding : NULL);
}

void gloss_egl_context_free(struct egl_display *display, struct egl_context *context)
{
	struct egl_context **link = &display->contexts;

	while (*link != context)
		link = &(*link)->next;
	*link = context->next;
	gloss_binding_destroy(context->binding);
	free(context);
}

EGLBoolean gloss_egl_destroy_context(EGLDisplay dpy, EGLContext handle)
{
	struct egl_display *display = dpy;
	struct egl_context *context = gloss_egl_context(display, handle);

	if (!context)
		return EGL_FALSE;
	pthread_mutex_lock(&display->lock);
	gloss_egl_context_free(display, context);
	pthread_mutex_unlock(&display->lock);
	return gloss_egl_result(EGL_SUCCESS);
}

EGLBoolean gloss_egl_query_context(EGLDisplay dpy, EGLContext handle, EGLint name, EGLint *value)
{
	struct egl_context *context = gloss_egl_context(dpy, handle);

	if (!context)
		return EGL_FALSE;
	switch (name) {
	case EGL_CONFIG_ID:
		*value = context->binding->config ? context->binding->config->id : 0;
		break;
	case EGL_CONTEXT_CLIENT_TYPE:
		*value = EGL_OPENGL_API;
		break;
	case EGL_CONTEXT_CLIENT_VERSION:
		*value = 1;
		break;
	case EGL_RENDER_BUFFER:
		*value = EGL_NONE;
		if (context->binding == gloss_binding_current() && gloss_binding_draw())
			*value = EGL_BACK_BUFFER;
		break;
	default:
		return gloss_egl_result(EGL_BAD_ATTRIBUTE);
	}
	return gloss_egl_result(EGL_SUCCESS);
}

/* Colours of all formats are alike, so that any context may draw on any surface. */
static EGLBoolean context_bind(struct gloss_binding *binding, struct egl_surface *draw,
			       struct egl_surface *read)
{
	switch (gloss_binding_make_current(binding, draw ? draw->surface : NULL,
					   read ? read->surface : NULL)) {
	case 0:
		return gloss_egl_result(EGL_SUCCESS);
	case -EACCES:
		return gloss_egl_result(EGL_BAD_ACCESS);
	default:
		return gloss_egl_result(EGL_BAD_ALLOC);
	}
}

EGLBoolean gloss_egl_make_current(EGLDisplay dpy, EGLSurface draw, EGLSurface read,
				  EGLContext handle)
{
	struct egl_surface *surfaces[2] = { NULL, NULL };
	struct egl_context *context;

	if (handle == EGL_NO_CONTEXT) {
		if (draw != EGL_NO_SURFACE || read != EGL_NO_SURFACE)
			return gloss_egl_result(EGL_BAD_MATCH);
		return context_bind(NULL, NULL, NULL);
	}
	context = gloss_egl_context(dpy, handle);
	if (!context)
		return EGL_FALSE;
	if ((draw == EGL_NO_SURFACE) != (read == EGL_NO_SURFACE))
		return gloss_egl_result(EGL_BAD_MATCH);
	if (draw != EGL_NO_SURFACE) {
		surfaces[0] = gloss_egl_surface(dpy, draw);
		surfaces[1] = gloss_egl_surface(dpy, read);
		if (!surfaces[0] || !surfaces[1])
			return EGL_FALSE;
	}
	return context_bind(context->binding, surfaces[0], surfaces[1]);
}

EGLBoolean gloss_egl_wait_client(void)
{
	struct gloss_binding *binding = gloss_binding_current();

	if (binding)
		gloss_context_finish(binding->context);
	return gloss_egl_result(EGL_SUCCESS);
}

/* What X draws is in its own memory; there is nothing to wait for before drawing on ours. */
EGLBoolean gloss_egl_wait_native(EGLint engine)
{
	return gloss_egl_result(engine == EGL_CORE_NATIVE_ENGINE ? EGL_SUCCESS : EGL_BAD_PARAMETER);
}
