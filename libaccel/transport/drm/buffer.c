// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <xf86drm.h>

#include "gloss_drm.h"
#include "transport/drm/buffer.h"
#include "transport/drm/node.h"

static void buffer_close_handle(int fd, uint32_t handle)
{
	struct drm_gem_close close = { .handle = handle };

	accel_drm_node_ioctl(fd, DRM_IOCTL_GEM_CLOSE, &close);
}

static int buffer_map(int fd, struct accel_drm_buffer *buffer, uint64_t size)
{
	struct drm_gloss_gem_mmap_offset place = { .handle = buffer->handle };
	int err;

	err = accel_drm_node_ioctl(fd, DRM_IOCTL_GLOSS_GEM_MMAP_OFFSET, &place);
	if (err)
		return err;
	buffer->map = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, (off_t)place.offset);
	if (buffer->map != MAP_FAILED)
		return 0;
	return errno == ENODEV ? -ENODEV : -ENOMEM;
}

static int buffer_create(void *data, uint64_t size, struct accel_pool_buffer **out)
{
	struct drm_gloss_gem_create create = { .size = size, .kind = DRM_GLOSS_GEM_HOST };
	struct accel_drm_buffer *buffer = malloc(sizeof(*buffer));
	int fd = *(const int *)data;
	int err;

	if (!buffer)
		return -ENOMEM;
	err = accel_drm_node_ioctl(fd, DRM_IOCTL_GLOSS_GEM_CREATE, &create);
	if (err)
		goto err_free;
	*buffer = (struct accel_drm_buffer){ .handle = create.handle };
	err = buffer_map(fd, buffer, size);
	if (err)
		goto err_close;
	*out = &buffer->pooled;
	return 0;

err_close:
	buffer_close_handle(fd, create.handle);
err_free:
	free(buffer);
	return err;
}

void accel_drm_buffer_drop(int fd, struct accel_drm_buffer *buffer)
{
	munmap(buffer->map, buffer->pooled.size);
	buffer_close_handle(fd, buffer->handle);
	free(buffer);
}

static void buffer_destroy(void *data, struct accel_pool_buffer *buffer)
{
	accel_drm_buffer_drop(*(const int *)data, (struct accel_drm_buffer *)buffer);
}

const struct accel_pool_kind accel_drm_buffer_kind = {
	.unused_bytes = 32u << 20,
	.unused_buffers = 256,
	.create = buffer_create,
	.destroy = buffer_destroy,
};
