/* SPDX-License-Identifier: MIT */
/* A DRM node of the kernel module gloss: finding it, opening it, asking it. */
#ifndef ACCEL_DRM_NODE_H
#define ACCEL_DRM_NODE_H

#include <stddef.h>

#include "transport/transport.h"

/*
 * Opens the node @where, or the first render node of a Gloss board if that is "", and stores
 * its path, cut off if need be, in @path of @size bytes.
 * Returns a file descriptor, or an error of struct accel_transport_ops.open that @error explains.
 */
int accel_drm_node_open(const char *where, char *path, size_t size,
			struct accel_transport_error *error);

/*
 * Calls @each with the path of the render node of each Gloss board, in their order; none if it
 * can not be known. -ENOMEM.
 */
int accel_drm_node_list(void (*each)(void *data, const char *path), void *data);

/*
 * An ioctl, repeated when a signal interrupts it. 0, -ENOMEM (also of board memory), -ENODEV
 * (the board is gone), -EINVAL (the module does not take it), or -EIO for all else.
 */
int accel_drm_node_ioctl(int fd, unsigned long request, void *argument);
/* What it answers for @err, an -errno of the kernel. */
int accel_drm_node_error(int err);

#endif
