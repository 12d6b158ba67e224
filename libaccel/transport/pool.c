// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stddef.h>

#include "transport/pool.h"

#define PAGE 4096u

void accel_pool_init(struct accel_pool *pool, const struct accel_pool_kind *kind, void *data)
{
	*pool = (struct accel_pool){ .kind = kind, .data = data };
	pthread_mutex_init(&pool->lock, NULL);
}

static void pool_destroy_list(struct accel_pool *pool, struct accel_pool_buffer *buffer)
{
	while (buffer) {
		struct accel_pool_buffer *next = buffer->next;

		pool->kind->destroy(pool->data, buffer);
		buffer = next;
	}
}

/* Powers of two pages, so that jobs of about the same size share; what is not kept is whole pages. */
static uint64_t pool_size(const struct accel_pool *pool, uint64_t bytes)
{
	uint64_t size = PAGE;

	if (bytes > pool->kind->unused_bytes)
		return (bytes + PAGE - 1) / PAGE * PAGE;
	while (size < bytes)
		size *= 2;
	return size;
}

static struct accel_pool_buffer *pool_take(struct accel_pool *pool, uint64_t size)
{
	struct accel_pool_buffer **link, *buffer;

	pthread_mutex_lock(&pool->lock);
	for (link = &pool->unused; *link && (*link)->size != size;)
		link = &(*link)->next;
	buffer = *link;
	if (buffer)
		*link = buffer->next;
	pthread_mutex_unlock(&pool->lock);
	return buffer;
}

static struct accel_pool_buffer *pool_take_all(struct accel_pool *pool)
{
	struct accel_pool_buffer *all;

	pthread_mutex_lock(&pool->lock);
	all = pool->unused;
	pool->unused = NULL;
	pthread_mutex_unlock(&pool->lock);
	return all;
}

static int pool_create(struct accel_pool *pool, uint64_t size, struct accel_pool_buffer **buffer)
{
	int err = pool->kind->create(pool->data, size, buffer);

	if (!err)
		**buffer = (struct accel_pool_buffer){ .size = size };
	return err;
}

/* All that is unused gives way when memory is short. */
int accel_pool_get(struct accel_pool *pool, uint64_t size, struct accel_pool_buffer **buffer)
{
	struct accel_pool_buffer *unused;
	int err;

	if (size > UINT64_MAX - PAGE)
		return -ENOMEM;
	size = pool_size(pool, size);
	*buffer = pool_take(pool, size);
	if (*buffer)
		return 0;
	err = pool_create(pool, size, buffer);
	if (err != -ENOMEM)
		return err;
	unused = pool_take_all(pool);
	if (!unused)
		return -ENOMEM;
	pool_destroy_list(pool, unused);
	return pool_create(pool, size, buffer);
}

/* Takes out what is past the bound. */
static struct accel_pool_buffer *pool_trim_locked(struct accel_pool *pool)
{
	struct accel_pool_buffer **link = &pool->unused, *out = NULL;
	unsigned int buffers = 0;
	uint64_t bytes = 0;

	while (*link) {
		struct accel_pool_buffer *buffer = *link;

		if (buffers < pool->kind->unused_buffers &&
		    buffer->size <= pool->kind->unused_bytes - bytes) {
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

void accel_pool_put(struct accel_pool *pool, struct accel_pool_buffer *buffer)
{
	struct accel_pool_buffer *out;

	if (!buffer)
		return;
	pthread_mutex_lock(&pool->lock);
	buffer->next = pool->unused;
	pool->unused = buffer;
	out = pool_trim_locked(pool);
	pthread_mutex_unlock(&pool->lock);
	pool_destroy_list(pool, out);
}

void accel_pool_fini(struct accel_pool *pool)
{
	pool_destroy_list(pool, pool_take_all(pool));
	pthread_mutex_destroy(&pool->lock);
}
