// SPDX-License-Identifier: MIT
/*
 * The calls of the library that gloss-info makes, with boards that no machine has: one that tries
 * to break out of a line, one that is in use, and so on. FAKE_LIST says which are listed.
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accel.h"

#define EVIL "\033]0;pwned\a'\"\\$(touch pwned)`touch pwned`\n\xff%s"

struct accel_device {
	bool evil, counts;
};

static const struct answer {
	const char *name;
	int error;
	const char *message; /* NULL: none */
} answers[] = {
	{ "board:", 0, NULL },
	{ "evil:", 0, NULL },
	{ "usb:1209:0001/BUSY", -EBUSY,
	  "device \"usb:\": usb:1209:0001/BUSY is in use by another program" },
	{ "usb:1209:0001/DENIED", -EACCES,
	  "device \"usb:\": not permitted: install 60-gloss.rules and plug the board in again" },
	{ "usb:", -ENODEV, "device \"usb:\": no Gloss board is plugged in" },
	{ "full:", -ENOMEM, NULL },
	{ "auto", 0, NULL },
};

int accel_device_new(const char *name, accel_message_fn message, void *data,
		     struct accel_device **out)
{
	static struct accel_device device;

	for (size_t i = 0; i < sizeof(answers) / sizeof(answers[0]); i++) {
		if (strcmp(answers[i].name, name) != 0)
			continue;
		if (answers[i].message)
			message(data, answers[i].message);
		device = (struct accel_device){ .evil = !strcmp(name, "evil:"),
						.counts = !strcmp(name, "board:") };
		*out = &device;
		return answers[i].error;
	}
	return -EINVAL;
}

void accel_device_free(struct accel_device *device)
{
	(void)device;
}

void accel_device_info(struct accel_device *device, struct accel_device_info *info, size_t size)
{
	(void)size;
	*info = (struct accel_device_info){
		.name = "board of a test",
		.tile_size = 32,
		.pixels_per_clock = 4,
		.memory_size = device->evil ? 4096 : 1ull << 32,
	};
	if (device->evil)
		snprintf(info->name, sizeof(info->name), "%s", EVIL);
}

int accel_device_clocks(struct accel_device *device, struct accel_device_clocks *clocks,
			size_t size)
{
	(void)size;
	if (!device->counts)
		return -ENOTSUP;
	*clocks = (struct accel_device_clocks){ 1ull << 40, 2, 3, 4, 5, 6 };
	return 0;
}

int accel_device_list(accel_device_list_fn found, void *data)
{
	const char *what = getenv("FAKE_LIST");

	if (!what)
		return -EINVAL;
	if (!strcmp(what, "error"))
		return -ENOMEM;
	if (strcmp(what, "none") != 0) {
		found(data, "drm:/dev/dri/renderD128", "Gloss PCI board");
		found(data, "usb:1209:0001/" EVIL, EVIL);
		found(data, "usb:", "");
	}
	return 0;
}
