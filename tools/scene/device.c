// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "scene/device.h"

static char library_message[512];

/* That a job could not be written to a file is the reason of no error. */
static void keep_message(void *data, const char *message)
{
	const char *program = data;

	if (!strncmp(message, "ACCEL_DUMP: ", strlen("ACCEL_DUMP: ")))
		fprintf(stderr, "%s: %s\n", program, message);
	else
		snprintf(library_message, sizeof(library_message), "%s", message);
}

const char *device_reason(int error)
{
	return library_message[0] ? library_message : strerror(-error);
}

void device_reason_forget(void)
{
	library_message[0] = '\0';
}

/* The library's reason follows 'device "drm:": ', which @name says already, as the colon. */
static void no_device(const char *program, const char *name, int error)
{
	const char *reason = strstr(library_message, "\": ");
	size_t length = strlen(name);

	reason = reason ? reason + 3 : NULL;
	if (error == -EINVAL && !reason)
		reason = "give drm:, usb:, model:, sim: or auto";
	if (length && name[length - 1] == ':')
		length--;
	fprintf(stderr, "%s: %s: %.*s: %s\n", program,
		error == -EINVAL ? "no such device" : "can not open device", (int)length, name,
		reason ? reason : strerror(-error));
}

int device_open(const char *program, const char *name, struct accel_device **device)
{
	int err;

	device_reason_forget();
	err = accel_device_new(name, keep_message, (void *)program, device);
	if (err)
		no_device(program, name, err);
	return err;
}
