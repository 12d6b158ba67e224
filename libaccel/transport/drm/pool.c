// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <xf86drm.h>

#include "transport/drm/node.h"
#include "transport/drm/pool.h"
#include "gloss_drm.h"

#define PAGE 4096u

/* What is kept unused at most: the jobs of a few large frames, or many small ones. */
#define UNUSED_BYTES (32u << 20)
#define UNUSED_BUFFERS 256

void accel_drm_pool_init(struct accel_drm_pool *pool, int fd)
{
	*pool = (struct accel_drm_pool){ .fd = fd };
	pthread_mutex_init(&pool->lock, NULL);
}

/* ---- one buffer ---- */

static void pool_close_handle(int fd, uint32_t handle)
{
	struct drm_gem_close close = { .handle = handle };

	accel_drm_node_ioctl(fd, DRM_IOCTL_GEM_CLOSE, &close);
}

static int pool_map(int fd, struct accel_drm_buffer *buffer)
{
	struct drm_gloss_gem_mmap_offset place = { .handle = buffer->handle };
	int err;

	err = accel_drm_node_ioctl(fd, DRM_IOCTL_GLOSS_GEM_MMAP_OFFSET, &place);
	if (err)
		return err;
	buffer->map = mmap(NULL, buffer->size, PROT_READ | PROT_WRITE, MAP_SHARED, fd,
			   (off_t)place.offset);
	if (buffer->map != MAP_FAILED)
		return 0;
	return errno == ENODEV ? -ENODEV : -ENOMEM;
}

static int pool_new(int fd, uint64_t size, struct accel_drm_buffer **out)
{
	struct drm_gloss_gem_create create = { .size = size, .kind = DRM_GLOSS_GEM_HOST };
	struct accel_drm_buffer *buffer = malloc(sizeof(*buffer));
	int err;

	if (!buffer)
		return -ENOMEM;
	err = accel_drm_node_ioctl(fd, DRM_IOCTL_GLOSS_GEM_CREATE, &create);
	if (err)
		goto err_free;
	*buffer = (struct accel_drm_buffer){ .size = size, .handle = create.handle };
	err = pool_map(fd, buffer);
	if (err)
		goto err_close;
	*out = buffer;
	return 0;

err_close:
	pool_close_handle(fd, create.handle);
err_free:
	free(buffer);
	return err;
}

void accel_drm_pool_drop(struct accel_drm_pool *pool, struct accel_drm_buffer *buffer)
{
	munmap(buffer->map, buffer->size);
	pool_close_handle(pool->fd, buffer->handle);
	free(buffer);
}

static void pool_drop_list(struct accel_drm_pool *pool, struct accel_drm_buffer *buffer)
{
	while (buffer) {
		struct accel_drm_buffer *next = buffer->next;

		accel_drm_pool_drop(pool, buffer);
		buffer = next;
	}
}

/* ---- all of them ---- */

/* Powers of two pages, so that jobs of about the same size share; what is not kept is exact. */
static uint64_t pool_size(uint64_t bytes)
{
	uint64_t size = PAGE;

	if (bytes > UNUSED_BYTES)
		return (bytes + PAGE - 1) / PAGE * PAGE;
	while (size < bytes)
		size *= 2;
	return size;
}

static struct accel_drm_buffer *pool_take(struct accel_drm_pool *pool, uint64_t size)
{
	struct accel_drm_buffer **link, *buffer;

	pthread_mutex_lock(&pool->lock);
	for (link = &pool->unused; *link && (*link)->size != size;)
		link = &(*link)->next;
	buffer = *link;
	if (buffer)
		*link = buffer->next;
	pthread_mutex_unlock(&pool->lock);
	return buffer;
}

static struct accel_drm_buffer *pool_take_all(struct accel_drm_pool *pool)
{
	struct accel_drm_buffer *all;

	pthread_mutex_lock(&pool->lock);
	all = pool->unused;
	pool->unused = NULL;
	pthread_mutex_unlock(&pool->lock);
	return all;
}

/* All that is unused gives way when memory is short. */
int accel_drm_pool_get(struct accel_drm_pool *pool, uint64_t size, struct accel_drm_buffer **out)
{
	struct accel_drm_buffer *unused;
	int err;

	size = pool_size(size);
	*out = pool_take(pool, size);
	if (*out)
		return 0;
	err = pool_new(pool->fd, size, out);
	if (err != -ENOMEM)
		return err;
	unused = pool_take_all(pool);
	if (!unused)
		return -ENOMEM;
	pool_drop_list(pool, unused);
	return pool_new(pool->fd, size, out);
}

/* Takes out what is past the bound. Called with the lock held. */
static struct accel_drm_buffer *pool_trim(struct accel_drm_pool *pool)
{
	struct accel_drm_buffer **link = &pool->unused, *out = NULL;
	unsigned int buffers = 0;
	uint64_t bytes = 0;

	while (*link) {
		struct accel_drm_buffer *buffer = *link;

		if (buffers < UNUSED_BUFFERS && buffer->size <= UNUSED_BYTES - bytes) {
			buffers++;
			bytes += buffer->size;
			link = &buffer->next;
			continue;
		}
		*link = buffer->next;
		buffer->next = out;
		out = buffer;
	}
	return out;
}

void accel_drm_pool_put(struct accel_drm_pool *pool, struct accel_drm_buffer *buffer)
{
	struct accel_drm_buffer *out;

	pthread_mutex_lock(&pool->lock);
	buffer->next = pool->unused;
	pool->unused = buffer;
	out = pool_trim(pool);
	pthread_mutex_unlock(&pool->lock);
	pool_drop_list(pool, out);
}

void accel_drm_pool_fini(struct accel_drm_pool *pool)
{
	pool_drop_list(pool, pool_take_all(pool));
	pthread_mutex_destroy(&pool->lock);
}
