// SPDX-License-Identifier: MIT
#include "window/binding.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>

#include "state/context.h"
#include "window/device.h"
#include "window/surface.h"

struct thread_binding {
	struct gloss_binding *binding;
	struct gloss_surface *draw, *read;
};

static _Thread_local struct thread_binding current;

/* Protects the flags of all bindings. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* A thread that ends lets go of its context, so that others can have it. */
static pthread_key_t thread_key;
static pthread_once_t thread_once = PTHREAD_ONCE_INIT;

static void thread_end(void *unused)
{
	(void)unused;
	gloss_binding_make_current(NULL, NULL, NULL);
}

static void thread_key_new(void)
{
	pthread_key_create(&thread_key, thread_end);
}

int gloss_binding_new(const struct gloss_config *config, void *display, int screen,
		      struct gloss_binding *share, struct gloss_binding **out)
{
	struct accel_device *device = gloss_device();
	struct gloss_binding *binding;

	if (!device)
		return -ENODEV;
	binding = calloc(1, sizeof(*binding));
	if (!binding)
		return -ENOMEM;
	binding->config = config;
	binding->display = display;
	binding->screen = screen;
	binding->context = gloss_context_new(device, share ? share->context : NULL);
	if (!binding->context) {
		free(binding);
		return -ENOMEM;
	}
	*out = binding;
	return 0;
}

static void binding_free(struct gloss_binding *binding)
{
	gloss_context_free(binding->context);
	free(binding);
}

void gloss_binding_destroy(struct gloss_binding *binding)
{
	bool in_use;

	pthread_mutex_lock(&lock);
	binding->destroyed = true;
	in_use = binding->current;
	pthread_mutex_unlock(&lock);
	if (!in_use)
		binding_free(binding);
}

/* False: another thread has it. */
static bool binding_take(struct gloss_binding *binding)
{
	bool taken;

	pthread_mutex_lock(&lock);
	taken = !binding->current || binding == current.binding;
	if (taken)
		binding->current = true;
	pthread_mutex_unlock(&lock);
	return taken;
}

static void binding_leave(struct gloss_binding *binding)
{
	bool unused;

	pthread_mutex_lock(&lock);
	binding->current = false;
	unused = binding->destroyed;
	pthread_mutex_unlock(&lock);
	if (unused)
		binding_free(binding);
}

int gloss_binding_make_current(struct gloss_binding *binding, struct gloss_surface *draw,
			       struct gloss_surface *read)
{
	struct thread_binding old = current;

	if (binding && !binding_take(binding))
		return -EACCES;
	/* That frames fail is told by no call of OpenGL, and the new context is current either way. */
	gloss_context_bind(binding ? binding->context : NULL, draw, read);
	current.binding = binding;
	current.draw = gloss_surface_ref(draw);
	current.read = gloss_surface_ref(read);
	gloss_surface_unref(old.draw);
	gloss_surface_unref(old.read);
	if (old.binding && old.binding != binding)
		binding_leave(old.binding);
	pthread_once(&thread_once, thread_key_new);
	pthread_setspecific(thread_key, binding);
	return 0;
}

struct gloss_binding *gloss_binding_current(void)
{
	return current.binding;
}

struct gloss_surface *gloss_binding_draw(void)
{
	return current.draw;
}

struct gloss_surface *gloss_binding_read(void)
{
	return current.read;
}

static int binding_send(const struct gloss_surface *surface)
{
	if (current.binding && surface == current.draw)
		return gloss_context_flush(current.binding->context);
	return 0;
}

int gloss_binding_swap(struct gloss_surface *surface)
{
	int sent = binding_send(surface), shown = gloss_surface_present(surface);

	gloss_surface_pace(surface);
	return sent ? sent : shown;
}

int gloss_binding_copy(struct gloss_surface *surface, struct gloss_x11 *x11)
{
	int sent = binding_send(surface), copied = gloss_surface_copy(surface, x11);

	return sent ? sent : copied;
}
