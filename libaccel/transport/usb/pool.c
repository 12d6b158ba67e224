// SPDX-License-Identifier: MIT
#include <stdlib.h>

#include "transport/usb/pool.h"

/* What is kept unused at most: the messages of a few large frames, or many small ones. */
#define UNUSED_WORDS ((size_t)8 << 20)
#define UNUSED_BUFFERS 64
#define SMALLEST_WORDS 1024

void accel_usb_pool_init(struct accel_usb_pool *pool)
{
	pool->unused = NULL;
	pthread_mutex_init(&pool->lock, NULL);
}

static void pool_free_list(struct accel_usb_buffer *buffer)
{
	while (buffer) {
		struct accel_usb_buffer *next = buffer->next;

		free(buffer);
		buffer = next;
	}
}

void accel_usb_pool_fini(struct accel_usb_pool *pool)
{
	pool_free_list(pool->unused);
	pthread_mutex_destroy(&pool->lock);
}

/* Powers of two, so that messages of about the same size share; what is not kept is exact. */
static size_t pool_room(size_t words)
{
	size_t room = SMALLEST_WORDS;

	if (words > UNUSED_WORDS)
		return words;
	while (room < words)
		room *= 2;
	return room;
}

struct accel_usb_buffer *accel_usb_pool_get(struct accel_usb_pool *pool, size_t words)
{
	struct accel_usb_buffer **link, *buffer;
	size_t room = pool_room(words);

	pthread_mutex_lock(&pool->lock);
	for (link = &pool->unused; *link && (*link)->room != room;)
		link = &(*link)->next;
	buffer = *link;
	if (buffer)
		*link = buffer->next;
	pthread_mutex_unlock(&pool->lock);
	if (buffer || room > (SIZE_MAX - sizeof(*buffer)) / sizeof(uint32_t))
		return buffer;
	buffer = malloc(sizeof(*buffer) + room * sizeof(uint32_t));
	if (buffer)
		buffer->room = room;
	return buffer;
}

/* Takes out what is past the bound. */
static struct accel_usb_buffer *pool_trim_locked(struct accel_usb_pool *pool)
{
	struct accel_usb_buffer **link = &pool->unused, *out = NULL;
	unsigned int buffers = 0;
	size_t words = 0;

	while (*link) {
		struct accel_usb_buffer *buffer = *link;

		if (buffers < UNUSED_BUFFERS && buffer->room <= UNUSED_WORDS - words) {
			buffers++;
			words += buffer->room;
			link = &buffer->next;
			continue;
		}
		*link = buffer->next;
		buffer->next = out;
		out = buffer;
	}
	return out;
}

void accel_usb_pool_put(struct accel_usb_pool *pool, struct accel_usb_buffer *buffer)
{
	struct accel_usb_buffer *out;

	if (!buffer)
		return;
	pthread_mutex_lock(&pool->lock);
	buffer->next = pool->unused;
	pool->unused = buffer;
	out = pool_trim_locked(pool);
	pthread_mutex_unlock(&pool->lock);
	pool_free_list(out);
}
