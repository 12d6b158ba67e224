/* SPDX-License-Identifier: MIT */
/*
 * Host objects of a kernel device, mapped, for the jobs of one program. Those that are given
 * back are kept for the next job of their size, up to a bound, so that a program which does
 * the same again and again asks the kernel for none. Any thread may call any function.
 */
#ifndef ACCEL_DRM_POOL_H
#define ACCEL_DRM_POOL_H

#include <pthread.h>
#include <stdint.h>

struct accel_drm_buffer {
	struct accel_drm_buffer *next;
	void *map;
	uint64_t size;			/* bytes */
	uint32_t handle;		/* GEM */
};

struct accel_drm_pool {
	int fd;
	pthread_mutex_t lock;		/* protects unused */
	struct accel_drm_buffer *unused;	/* the latest first */
};

void accel_drm_pool_init(struct accel_drm_pool *pool, int fd);
/* Every buffer was put or dropped. */
void accel_drm_pool_fini(struct accel_drm_pool *pool);

/* A buffer of at least @size bytes, not 0; what is in it is anything. -EINVAL: larger than the
 * kernel makes; -ENOMEM, -ENODEV, -EIO. */
int accel_drm_pool_get(struct accel_drm_pool *pool, uint64_t size,
		       struct accel_drm_buffer **buffer);
/* Gives a buffer back that no job uses. */
void accel_drm_pool_put(struct accel_drm_pool *pool, struct accel_drm_buffer *buffer);
/* Gives back one that a job may still use: the kernel keeps it until then. */
void accel_drm_pool_drop(struct accel_drm_pool *pool, struct accel_drm_buffer *buffer);

#endif
