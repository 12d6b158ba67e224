/* SPDX-License-Identifier: MIT */
/* Host objects of a kernel device, mapped, for the jobs of one program. */
#ifndef ACCEL_DRM_BUFFER_H
#define ACCEL_DRM_BUFFER_H

#include "transport/pool.h"

struct accel_drm_buffer {
	struct accel_pool_buffer pooled;
	void *map;
	uint32_t handle; /* GEM */
};

/* The pool's data is an int, the device. Of @size 0 or more than the kernel makes: -EINVAL; -ENOMEM,
 * -ENODEV, -EIO. */
extern const struct accel_pool_kind accel_drm_buffer_kind;

/* Gives back a buffer that a job may still use: the kernel keeps it until then. */
void accel_drm_buffer_drop(int fd, struct accel_drm_buffer *buffer);

#endif
