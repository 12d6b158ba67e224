/* SPDX-License-Identifier: MIT */
/*
 * Threads that work on the items of a list together with the one that calls. They are started when
 * they are first needed, as many as are wanted or can be had, and sleep between calls.
 */
#ifndef ACCEL_WORKERS_H
#define ACCEL_WORKERS_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

#include "transport/thread.h"

/* Does item number @item; @worker, less than the count of accel_workers_init, is this thread's. */
typedef void (*accel_work)(void *data, unsigned int worker, uint32_t item);

struct accel_worker {
	struct accel_workers *workers;
	pthread_t thread;
	unsigned int number; /* 0 is the calling thread's */
};

struct accel_workers {
	unsigned int count;   /* wanted, with the calling thread */
	pthread_mutex_t lock; /* protects what follows */
	pthread_cond_t posted, idle;
	accel_work work;
	void *data;
	uint32_t next, items; /* the next to be taken, and all */
	unsigned int working; /* threads besides the calling one that are at an item */
	bool stop;
	unsigned int threads; /* that were started */
	struct accel_worker worker[ACCEL_THREADS_MAX - 1];
};

/* @count is 1 to ACCEL_THREADS_MAX. Starts no thread; @workers must not move. */
void accel_workers_init(struct accel_workers *workers, unsigned int count);
void accel_workers_fini(struct accel_workers *workers);
/* Calls @work for each of @items, in any order, and returns when all are done. */
void accel_workers_run(struct accel_workers *workers, accel_work work, void *data, uint32_t items);

#endif
