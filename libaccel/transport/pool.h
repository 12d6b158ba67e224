/* SPDX-License-Identifier: MIT */
/*
 * Memory for jobs. What has been used is kept for the next job of its size, up to a bound, as new
 * memory costs more than to fill it. What a buffer is, a transport says. Any thread may call any
 * function.
 */
#ifndef ACCEL_POOL_H
#define ACCEL_POOL_H

#include <pthread.h>
#include <stdint.h>

/* The first member of a transport's buffer. */
struct accel_pool_buffer {
	struct accel_pool_buffer *next;
	uint64_t size; /* bytes there are, at least as many as asked for */
};

struct accel_pool_kind {
	/* What is kept unused at most: the jobs of a few large frames, or many small ones. */
	uint64_t unused_bytes;
	unsigned int unused_buffers;
	/* Makes a buffer of @size bytes; the pool sets its struct accel_pool_buffer. -errno. */
	int (*create)(void *data, uint64_t size, struct accel_pool_buffer **buffer);
	void (*destroy)(void *data, struct accel_pool_buffer *buffer);
};

struct accel_pool {
	const struct accel_pool_kind *kind;
	void *data;                       /* for its functions */
	pthread_mutex_t lock;             /* protects unused */
	struct accel_pool_buffer *unused; /* the latest first */
};

void accel_pool_init(struct accel_pool *pool, const struct accel_pool_kind *kind, void *data);
/* Every buffer was put, or is destroyed by its transport. */
void accel_pool_fini(struct accel_pool *pool);

/* A buffer of at least @size bytes, in which there is anything. -ENOMEM, also for more than any
 * buffer can have; else what create returns. */
int accel_pool_get(struct accel_pool *pool, uint64_t size, struct accel_pool_buffer **buffer);
/* Gives a buffer back that no job uses. Takes NULL. */
void accel_pool_put(struct accel_pool *pool, struct accel_pool_buffer *buffer);

#endif
