/* SPDX-License-Identifier: MIT */
/* What is in /dev/dri and /sys, as the kernel of fake_gloss.h has it. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xf86drm.h>

#include "fake_gloss_priv.h"

#define NODE "/dev/dri/renderD128"

int __real_open(const char *path, int flags, ...);
int __real_close(int fd);
int __real_stat(const char *path, struct stat *status);
int __real_access(const char *path, int mode);
ssize_t __real_readlink(const char *path, char *to, size_t size);

int __wrap_open(const char *path, int flags, ...);
int __wrap_close(int fd);
int __wrap_stat(const char *path, struct stat *status);
int __wrap_access(const char *path, int mode);
ssize_t __wrap_readlink(const char *path, char *to, size_t size);
int __wrap_drmGetDevices2(uint32_t flags, drmDevicePtr *device, int max);
void __wrap_drmFreeDevices(drmDevicePtr *device, int count);

static char paths[FAKE_NODES][sizeof(NODE)];

/* The number of a node's path, whether it is there or not; -1: it is none of these. */
static int node_find(const char *path)
{
	unsigned int number;
	int length = 0;

	if (strncmp(path, "/dev/dri/", strlen("/dev/dri/")) != 0)
		return -1;
	path = strrchr(path, '/');
	if (sscanf(path, "/renderD%u%n", &number, &length) != 1 || path[length] || number < 128 ||
	    number >= 128 + FAKE_NODES)
		return -1;
	return (int)number - 128;
}

int __wrap_open(const char *path, int flags, ...)
{
	int fd, number = node_find(path);
	const struct fake_node *node;

	if (number < 0)
		return __real_open(path, flags);
	node = &fake_gloss.node[number];
	if (!node->present)
		fd = -ENOENT;
	else if (node->open_error)
		fd = -node->open_error;
	else
		fd = flags == (O_RDWR | O_CLOEXEC) ? fake_file_open((unsigned int)number) : -EINVAL;
	if (fd >= 0)
		return fd;
	errno = -fd;
	return -1;
}

int __wrap_close(int fd)
{
	fake_file_close(fd);
	return __real_close(fd);
}

int __wrap_stat(const char *path, struct stat *status)
{
	int number = node_find(path);

	if (number < 0)
		return __real_stat(path, status);
	*status = (struct stat){
		.st_mode = S_IFCHR | fake_gloss.node[number].mode,
		.st_gid = fake_gloss.node[number].group,
	};
	return 0;
}

int __wrap_access(const char *path, int mode)
{
	if (strcmp(path, "/sys/module/gloss") != 0)
		return __real_access(path, mode);
	errno = ENOENT;
	return fake_gloss.module_loaded ? 0 : -1;
}

ssize_t __wrap_readlink(const char *path, char *to, size_t size)
{
	unsigned int number;
	int length = 0;

	if (sscanf(path, "/sys/class/drm/renderD%u/device/driver%n", &number, &length) != 1 ||
	    !length || path[length])
		return __real_readlink(path, to, size);
	length = snprintf(to, size, "../../../bus/pci/drivers/%s",
			  fake_gloss.node[number - 128].driver);
	return length < (int)size ? length : (ssize_t)size;
}

/* The nodes from the last to the first, and between them a screen without a render node. */
int __wrap_drmGetDevices2(uint32_t flags, drmDevicePtr *device, int max)
{
	static char *nodes[FAKE_NODES][DRM_NODE_MAX];
	static drmDevice devices[FAKE_NODES];
	static drmDevice screen = { .available_nodes = 1 << DRM_NODE_PRIMARY };
	int i, count = 0;

	if (flags || max <= FAKE_NODES)
		return -EINVAL;
	for (i = FAKE_NODES - 1; i >= 0; i--) {
		if (!fake_gloss.node[i].present)
			continue;
		snprintf(paths[i], sizeof(paths[i]), "/dev/dri/renderD%d", 128 + i);
		nodes[i][DRM_NODE_RENDER] = paths[i];
		devices[i].nodes = nodes[i];
		devices[i].available_nodes = 1 << DRM_NODE_PRIMARY | 1 << DRM_NODE_RENDER;
		device[count++] = &devices[i];
		if (count == 1)
			device[count++] = &screen;
	}
	return count ? count : -ENOENT;
}

void __wrap_drmFreeDevices(drmDevicePtr *device, int count)
{
	(void)device;
	(void)count;
}
