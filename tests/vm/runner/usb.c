// SPDX-License-Identifier: MIT
#include "runner.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define USB "/sys/bus/usb/devices"

/* As tools/udev has them. */
#define VENDOR "1209"
#define PRODUCT "0001"
#define NAME "Gloss board"

/* A line of @name in the device's directory, or "". */
static void attribute(char value[64], const char *device, const char *name)
{
	char path[512];
	FILE *file;

	snprintf(path, sizeof(path), USB "/%s/%s", device, name);
	file = fopen(path, "r");
	if (!file || !fgets(value, 64, file))
		value[0] = '\0';
	value[strcspn(value, "\n")] = '\0';
	if (file)
		fclose(file);
}

static bool is(const char *device, const char *name, const char *wanted)
{
	char value[64];

	attribute(value, device, name);
	return !strcmp(value, wanted);
}

/* A board's node gets the owner and mode that udev gives it; false: it has none. */
static bool own(const char *device, unsigned int group)
{
	char bus[64], number[64], path[160];
	struct stat now;

	attribute(bus, device, "busnum");
	attribute(number, device, "devnum");
	snprintf(path, sizeof(path), "/dev/bus/usb/%03d/%03d", atoi(bus), atoi(number));
	if (stat(path, &now))
		return false;
	if (now.st_gid == group && (now.st_mode & 0777) == 0660)
		return true;
	return !chown(path, 0, group) && !chmod(path, 0660);
}

int usb_own(unsigned int group)
{
	struct dirent *entry;
	int found = 0;
	DIR *dir = opendir(USB);

	while (dir && (entry = readdir(dir)))
		if (is(entry->d_name, "idVendor", VENDOR) &&
		    is(entry->d_name, "idProduct", PRODUCT) && is(entry->d_name, "product", NAME))
			found += own(entry->d_name, group);
	if (dir)
		closedir(dir);
	return found;
}
