// SPDX-License-Identifier: MIT
#include "window/device.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "accel.h"
#include "window/settings.h"

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct accel_device *device;
static pid_t owner; /* after a fork the device is the parent's alone */

/* With $GLOSS_DEBUG it is said why a device does not open and which one is taken. */
static void device_open(void)
{
	bool debug = secure_getenv("GLOSS_DEBUG");
	struct accel_device_info info;
	char line[128];

	if (accel_device_new(gloss_setting(GLOSS_SETTING_DEVICE),
			     debug ? accel_message_print : NULL, NULL, &device)) {
		device = NULL;
		return;
	}
	owner = getpid();
	if (!debug)
		return;
	accel_device_info(device, &info, sizeof(info));
	snprintf(line, sizeof(line), "gloss: draws on %s", info.name);
	accel_message_print(NULL, line);
}

struct accel_device *gloss_device(void)
{
	struct accel_device *opened;

	pthread_mutex_lock(&lock);
	if (device && owner != getpid()) {
		accel_device_free(device);
		device = NULL;
	}
	if (!device)
		device_open();
	opened = device;
	pthread_mutex_unlock(&lock);
	return opened;
}
