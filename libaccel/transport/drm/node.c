// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <grp.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xf86drm.h>

#include "transport/drm/node.h"

#define DRIVER "gloss"
#define DEVICES_MAX 64
#define GROUP_BYTES 4096

/* ---- why a node does not open ---- */

static void node_group_name(gid_t id, char *name, size_t size)
{
	char buffer[GROUP_BYTES];
	struct group group, *found;

	if (getgrgid_r(id, &group, buffer, sizeof(buffer), &found) || !found)
		snprintf(name, size, "%u", id);
	else
		snprintf(name, size, "%s", group.gr_name);
}

static int node_refuse_access(const char *path, struct accel_transport_error *error)
{
	const mode_t both = S_IRGRP | S_IWGRP;
	struct stat status;
	char group[32];

	if (stat(path, &status)) {
		accel_transport_say(error, "not permitted: %s", path);
		return -EACCES;
	}
	node_group_name(status.st_gid, group, sizeof(group));
	if ((status.st_mode & both) == both)
		accel_transport_say(error,
				    "not permitted: %s is for group %s; add yourself with "
				    "sudo usermod -aG %s $USER and log in again",
				    path, group, group);
	else
		accel_transport_say(error,
				    "not permitted: %s is of group %s and mode %04o; group "
				    "render and mode 0660 are usual",
				    path, group, status.st_mode & 07777u);
	return -EACCES;
}

static int node_refuse(const char *path, int err, struct accel_transport_error *error)
{
	switch (err) {
	case -EACCES:
	case -EPERM:
		return node_refuse_access(path, error);
	case -ENOENT:
		accel_transport_say(error,
				    "there is no %s; ls /dev/dri shows the nodes, sudo "
				    "modprobe " DRIVER " loads the module",
				    path);
		return -ENODEV;
	case -ENOMEM:
		return -ENOMEM;
	default:
		accel_transport_say(error, "%s: %s", path, strerror(-err));
		return -ENODEV;
	}
}

static int node_refuse_all(struct accel_transport_error *error)
{
	if (access("/sys/module/" DRIVER, F_OK))
		accel_transport_say(error, "no Gloss board: the kernel module is not loaded; try "
					   "sudo modprobe " DRIVER);
	else
		accel_transport_say(error, "no Gloss board: the kernel module is loaded and has "
					   "found none; lspci shows what is plugged in");
	return -ENODEV;
}

/* ---- one node ---- */

static int node_check(int fd, const char *path, struct accel_transport_error *error)
{
	drmVersionPtr version = drmGetVersion(fd);
	int err = 0;

	if (!version && errno == ENOMEM)
		return -ENOMEM;
	if (!version) {
		accel_transport_say(error,
				    errno == ENODEV ? "the board of %s is gone" :
						      "%s is no DRM node",
				    path);
		return -ENODEV;
	}
	if (strcmp(version->name, DRIVER) != 0) {
		accel_transport_say(error, "%s is driven by %s, not " DRIVER, path, version->name);
		err = -ENODEV;
	}
	drmFreeVersion(version);
	return err;
}

static int node_open(const char *path, struct accel_transport_error *error)
{
	int err, fd = open(path, O_RDWR | O_CLOEXEC);

	if (fd < 0)
		return node_refuse(path, -errno, error);
	err = node_check(fd, path, error);
	if (!err)
		return fd;
	close(fd);
	return err;
}

/* ---- the first node ---- */

/*
 * Asks sysfs: opening another driver's node could wake what sleeps, and one that may not be
 * opened is to be named.
 */
static bool node_is_ours(const char *path)
{
	char link[PATH_MAX], driver[PATH_MAX];
	const char *slash = strrchr(path, '/');
	ssize_t length;

	snprintf(link, sizeof(link), "/sys/class/drm%s/device/driver", slash ? slash : "");
	length = readlink(link, driver, sizeof(driver) - 1);
	if (length < 0)
		return false;
	driver[length] = '\0';
	slash = strrchr(driver, '/');
	return !strcmp(slash ? slash + 1 : driver, DRIVER);
}

/* The render node of our boards that comes next after @last; NULL: there is none. */
static const char *node_next(const drmDevicePtr *device, int devices, const char *last)
{
	const char *next = NULL;

	for (int i = 0; i < devices; i++) {
		const char *node;

		if (!(device[i]->available_nodes & 1 << DRM_NODE_RENDER))
			continue;
		node = device[i]->nodes[DRM_NODE_RENDER];
		if (!node_is_ours(node))
			continue;
		if (strverscmp(node, last) > 0 && (!next || strverscmp(node, next) < 0))
			next = node;
	}
	return next;
}

/* Of several boards the first that opens; if none does, the first says why. */
static int node_open_any(const drmDevicePtr *device, int devices, char *path, size_t size,
			 struct accel_transport_error *error)
{
	struct accel_transport_error later;
	const char *node = "";
	int fd, err = 0;

	while ((node = node_next(device, devices, node))) {
		fd = node_open(node, err ? &later : error);
		snprintf(path, size, "%s", node);
		if (fd >= 0)
			return fd;
		if (!err)
			err = fd;
	}
	return err ? err : node_refuse_all(error);
}

int accel_drm_node_open(const char *where, char *path, size_t size,
			struct accel_transport_error *error)
{
	drmDevicePtr device[DEVICES_MAX];
	int devices, fd;

	if (*where == '/') {
		snprintf(path, size, "%s", where);
		return node_open(where, error);
	}
	if (*where) {
		accel_transport_say(error, "give the path of a node, as in "
					   "drm:/dev/dri/renderD128, or none");
		return -EINVAL;
	}
	devices = drmGetDevices2(0, device, DEVICES_MAX);
	if (devices < 0)
		return devices == -ENOMEM ? -ENOMEM : node_refuse_all(error);
	fd = node_open_any(device, devices, path, size, error);
	drmFreeDevices(device, devices);
	return fd;
}

int accel_drm_node_list(void (*each)(void *data, const char *path), void *data)
{
	drmDevicePtr device[DEVICES_MAX];
	const char *node = "";
	int devices;

	devices = drmGetDevices2(0, device, DEVICES_MAX);
	if (devices < 0)
		return devices == -ENOMEM ? -ENOMEM : 0;
	while ((node = node_next(device, devices, node)))
		each(data, node);
	drmFreeDevices(device, devices);
	return 0;
}

/* ---- ioctls ---- */

int accel_drm_node_error(int err)
{
	switch (err) {
	case -ENOSPC:
		return -ENOMEM;
	case -ENOENT:
		return -EINVAL;
	case 0:
	case -ENOMEM:
	case -ENODEV:
	case -EINVAL:
		return err;
	default:
		return -EIO;
	}
}

int accel_drm_node_ioctl(int fd, unsigned long request, void *argument)
{
	return drmIoctl(fd, request, argument) ? accel_drm_node_error(-errno) : 0;
}
