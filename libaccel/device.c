// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "accel_priv.h"
#include "dump.h"
#include "transport/thread.h"

/* "auto" tries them in this order. */
static const struct accel_transport_ops *const transports[] = {
	&accel_transport_drm,
	&accel_transport_usb,
	&accel_transport_model,
	&accel_transport_sim,
};

#define TRANSPORTS (sizeof(transports) / sizeof(transports[0]))

/* ---- messages ---- */

void accel_device_message(struct accel_device *device, const char *format, ...)
{
	va_list arguments;
	char line[512];
	int held;

	if (!device->message)
		return;
	va_start(arguments, format);
	vsnprintf(line, sizeof(line), format, arguments);
	va_end(arguments);
	held = accel_thread_hold_cancel();
	device->message(device->message_data, line);
	accel_thread_allow_cancel(held);
}

static void device_message_open(struct accel_device *device, const char *scheme,
				const struct accel_transport_error *error, int err)
{
	accel_device_message(device, "device \"%s:\": %s", scheme,
			     *error->text ? error->text : strerror(-err));
}

/* ---- opening ---- */

static int device_try(struct accel_device *device, const struct accel_transport_ops *ops,
		      const char *where, struct accel_transport_error *error)
{
	int err = ops->open(where, &device->state, error);

	if (err)
		return err;
	device->ops = ops;
	ops->info(device->state, &device->info);
	device->threads = device->info.threads ? device->info.threads : accel_thread_processors();
	if (device->info.version == GLOSS_VERSION)
		return 0;
	accel_transport_say(error, "the board speaks version %u of the stream, not %u",
			    device->info.version, GLOSS_VERSION);
	ops->close(device->state);
	return -ENODEV;
}

static int device_open(struct accel_device *device, const struct accel_transport_ops *ops,
		       const char *where)
{
	struct accel_transport_error error = { "" };
	int err = device_try(device, ops, where, &error);

	if (err)
		device_message_open(device, ops->scheme, &error, err);
	return err;
}

/*
 * The answer of the last one tried, if none opens. Of a board that is just not there nothing
 * is said while there are others.
 */
static int device_open_any(struct accel_device *device)
{
	int err = -ENODEV;

	for (size_t i = 0; i < TRANSPORTS && err; i++) {
		struct accel_transport_error error = { "" };

		err = device_try(device, transports[i], "", &error);
		if (err && ((err != -ENODEV && err != -ENOSYS) || i + 1 == TRANSPORTS))
			device_message_open(device, transports[i]->scheme, &error, err);
	}
	return err;
}

static int device_open_name(struct accel_device *device, const char *name)
{
	size_t scheme = strcspn(name, ":");
	const char *where = name[scheme] ? name + scheme + 1 : "";

	if (!strncmp(name, "auto", scheme) && scheme == strlen("auto") && !*where)
		return device_open_any(device);
	for (size_t i = 0; i < TRANSPORTS; i++)
		if (strlen(transports[i]->scheme) == scheme &&
		    !memcmp(transports[i]->scheme, name, scheme))
			return device_open(device, transports[i], where);
	accel_device_message(device, "no kind of device is called \"%s\"", name);
	return -EINVAL;
}

int accel_device_new(const char *name, accel_message_fn message, void *data,
		     struct accel_device **out)
{
	struct accel_device *device;
	int err, held;

	device = malloc(sizeof(*device));
	if (!device)
		return -ENOMEM;
	*device = (struct accel_device){
		.message = message,
		.message_data = data,
		.process = getpid(),
		.references = 1,
	};
	err = accel_dump_new(&device->dump);
	if (err)
		goto err_free;
	held = accel_thread_hold_cancel();
	err = device_open_name(device, name ? name : "auto");
	accel_thread_allow_cancel(held);
	if (err)
		goto err_free_dump;
	pthread_mutex_init(&device->lock, NULL);
	accel_fence_detached_init(&device->detached);
	*out = device;
	return 0;

err_free_dump:
	accel_dump_free(device->dump);
err_free:
	free(device);
	return err;
}

int accel_device_list(accel_device_list_fn found, void *data)
{
	int err = 0, held = accel_thread_hold_cancel();

	for (size_t i = 0; i < TRANSPORTS && !err; i++)
		if (transports[i]->list)
			err = transports[i]->list(found, data);
	accel_thread_allow_cancel(held);
	return err;
}

/* ---- calls of the transport ---- */

bool accel_device_is_inherited(const struct accel_device *device)
{
	return device->process != getpid();
}

const char *accel_device_why(const struct accel_device *device, int err)
{
	const char *why = NULL;

	if (device->ops->why && !accel_device_is_inherited(device))
		why = device->ops->why(device->state, err);
	return why ? why : strerror(-err);
}

/* The memory of the buffers in @list that no job uses any more. */
static void device_free_list_locked(struct accel_device *device, struct accel_buffer *list)
{
	uint64_t ended = atomic_load(&device->detached.ended);

	while (list) {
		struct accel_buffer *buffer = list;

		list = buffer->next;
		if (atomic_load(&buffer->busy) > ended) {
			buffer->next = device->busy;
			device->busy = buffer;
			continue;
		}
		device->ops->memory_free(device->state, buffer->object);
		free(buffer);
	}
}

static void device_free_memory_locked(struct accel_device *device)
{
	struct accel_buffer *busy = device->busy;

	device->busy = NULL;
	device_free_list_locked(device, busy);
	device_free_list_locked(device, atomic_exchange(&device->freed, NULL));
}

/* What was freed while the lock was held was left to its holder, who may just have let it go. */
static void device_free_left(struct accel_device *device)
{
	while (atomic_load(&device->freed) && !pthread_mutex_trylock(&device->lock)) {
		device_free_memory_locked(device);
		pthread_mutex_unlock(&device->lock);
	}
}

int accel_device_enter(struct accel_device *device, int *held)
{
	if (accel_device_is_inherited(device))
		return -ENODEV;
	*held = accel_thread_hold_cancel();
	accel_fence_detached_reap(&device->detached);
	pthread_mutex_lock(&device->lock);
	device_free_memory_locked(device);
	return 0;
}

void accel_device_leave(struct accel_device *device, int held)
{
	pthread_mutex_unlock(&device->lock);
	device_free_left(device);
	accel_thread_allow_cancel(held);
}

void accel_device_free_buffer(struct accel_device *device, struct accel_buffer *buffer)
{
	int held;

	if (accel_device_is_inherited(device)) {
		free(buffer);
		return;
	}
	buffer->next = atomic_load(&device->freed);
	while (!atomic_compare_exchange_weak(&device->freed, &buffer->next, buffer))
		;
	held = accel_thread_hold_cancel();
	device_free_left(device);
	accel_thread_allow_cancel(held);
}

/* ---- lifetime ---- */

struct accel_device *accel_device_ref(struct accel_device *device)
{
	atomic_fetch_add(&device->references, 1);
	return device;
}

/* What a child of fork() has of the transport is a copy, whose threads and locks are not its
 * own, and a board that is not its own either. */
static void device_close(struct accel_device *device)
{
	int held;

	if (accel_device_is_inherited(device))
		return;
	held = accel_thread_hold_cancel();
	accel_fence_detached_finish(&device->detached);
	atomic_store(&device->detached.ended, UINT64_MAX);
	device_free_memory_locked(device);
	device->ops->close(device->state);
	accel_thread_allow_cancel(held);
	accel_fence_detached_fini(&device->detached);
	pthread_mutex_destroy(&device->lock);
}

void accel_device_unref(struct accel_device *device)
{
	if (atomic_fetch_sub(&device->references, 1) != 1)
		return;
	device_close(device);
	accel_dump_free(device->dump);
	free(device);
}

void accel_device_free(struct accel_device *device)
{
	if (device)
		accel_device_unref(device);
}

/* ---- questions ---- */

void accel_device_info(struct accel_device *device, struct accel_device_info *info, size_t size)
{
	struct accel_device_info known = {
		.tile_size = device->info.tile_size,
		.pixels_per_clock = device->info.pixels_per_clock,
		.memory_size = device->info.memory_size,
	};

	memcpy(known.name, device->info.name, sizeof(known.name));
	accel_sized_out(info, size, &known, sizeof(known));
}

int accel_device_clocks(struct accel_device *device, struct accel_device_clocks *clocks,
			size_t size)
{
	struct accel_device_clocks known;
	int err, held;

	if (!device->ops->clocks)
		return -ENOTSUP;
	if (accel_device_is_inherited(device))
		return -ENODEV;
	held = accel_thread_hold_cancel();
	err = device->ops->clocks(device->state, &known);
	accel_thread_allow_cancel(held);
	if (!err)
		accel_sized_out(clocks, size, &known, sizeof(known));
	return err;
}

/* ---- waiting ---- */

/* The board executes jobs one after the other, so the end of an empty one is that of all before. */
static int device_finish_jobs(struct accel_device *device)
{
	struct accel_stream *stream;
	int err = accel_stream_new_copy(device, &stream);

	if (err)
		return err;
	err = accel_stream_finish(stream, NULL, 0);
	accel_stream_free(stream);
	return err;
}

int accel_device_finish(struct accel_device *device)
{
	int err, left, held;

	if (accel_device_is_inherited(device))
		return -ENODEV;
	err = device_finish_jobs(device);
	left = accel_fence_detached_finish(&device->detached);
	/* Gives back the memory that their buffers had. */
	if (!accel_device_enter(device, &held))
		accel_device_leave(device, held);
	return left ? left : err;
}
