// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accel_priv.h"

/* "auto" tries them in this order. */
static const struct accel_transport_ops *const transports[] = {
	&accel_transport_drm,
	&accel_transport_usb,
	&accel_transport_model,
	&accel_transport_sim,
};

#define TRANSPORTS (sizeof(transports) / sizeof(transports[0]))

/* ---- messages ---- */

void accel_transport_say(struct accel_transport_error *error, const char *format, ...)
{
	va_list arguments;

	va_start(arguments, format);
	vsnprintf(error->text, sizeof(error->text), format, arguments);
	va_end(arguments);
}

void accel_device_message(struct accel_device *device, const char *format, ...)
{
	va_list arguments;
	char line[512];

	if (!device->message)
		return;
	va_start(arguments, format);
	vsnprintf(line, sizeof(line), format, arguments);
	va_end(arguments);
	device->message(device->message_data, line);
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
	size_t i;

	for (i = 0; i < TRANSPORTS && err; i++) {
		struct accel_transport_error error = { "" };

		err = device_try(device, transports[i], "", &error);
		if (err && ((err != -ENODEV && err != -ENOSYS) || i + 1 == TRANSPORTS))
			device_message_open(device, transports[i]->scheme, &error, err);
	}
	return err;
}

static int device_open_name(struct accel_device *device, const char *name)
{
	size_t i, scheme = strcspn(name, ":");
	const char *where = name[scheme] ? name + scheme + 1 : "";

	if (!strncmp(name, "auto", scheme) && scheme == strlen("auto") && !*where)
		return device_open_any(device);
	for (i = 0; i < TRANSPORTS; i++)
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
	int err;

	device = malloc(sizeof(*device));
	if (!device)
		return -ENOMEM;
	*device = (struct accel_device){
		.message = message,
		.message_data = data,
		.references = 1,
	};
	err = device_open_name(device, name ? name : "auto");
	if (err)
		goto err_free;
	pthread_mutex_init(&device->lock, NULL);
	*out = device;
	return 0;

err_free:
	free(device);
	return err;
}

int accel_device_list(accel_device_list_fn found, void *data)
{
	size_t i;
	int err = 0;

	for (i = 0; i < TRANSPORTS && !err; i++)
		if (transports[i]->list)
			err = transports[i]->list(found, data);
	return err;
}

/* ---- lifetime ---- */

struct accel_device *accel_device_ref(struct accel_device *device)
{
	pthread_mutex_lock(&device->lock);
	device->references++;
	pthread_mutex_unlock(&device->lock);
	return device;
}

void accel_device_unref(struct accel_device *device)
{
	unsigned int left;

	pthread_mutex_lock(&device->lock);
	left = --device->references;
	pthread_mutex_unlock(&device->lock);
	if (left)
		return;
	device->ops->close(device->state);
	pthread_mutex_destroy(&device->lock);
	free(device);
}

void accel_device_free(struct accel_device *device)
{
	if (device)
		accel_device_unref(device);
}

/* ---- questions ---- */

void accel_device_info(struct accel_device *device, struct accel_device_info *info)
{
	*info = (struct accel_device_info){
		.tile_size = device->info.tile_size,
		.pixels_per_clock = device->info.pixels_per_clock,
		.memory_size = device->info.memory_size,
	};
	memcpy(info->name, device->info.name, sizeof(info->name));
}

int accel_device_clocks(struct accel_device *device, struct accel_device_clocks *clocks)
{
	if (!device->ops->clocks)
		return -ENOTSUP;
	pthread_mutex_lock(&device->lock);
	device->ops->clocks(device->state, clocks);
	pthread_mutex_unlock(&device->lock);
	return 0;
}
