/* SPDX-License-Identifier: MIT */
/*
 * A board inside this process: its memory, and a thread that runs jobs one
 * after the other. transport/model.c and transport/sim.c differ in what runs a
 * job; the rest of struct accel_transport_ops is here.
 */
#ifndef ACCEL_ENGINE_H
#define ACCEL_ENGINE_H

#include <pthread.h>
#include <stdbool.h>

#include "transport/job_table.h"
#include "transport/range.h"
#include "transport/transport.h"

#define ENGINE_MEMORY_DEFAULT (256ull << 20)
#define ENGINE_MEMORY_MAX (1ull << 32)

/* With as much in memory to be run, a further job waits: a program can not run away from it. */
#define ENGINE_QUEUED_MAX (64u << 20)

/*
 * Runs one job to its end; called from the engine's thread. An error means that
 * the board failed and is ready for the next job all the same.
 */
typedef int (*accel_engine_run)(void *data, const struct accel_job *job,
				struct gloss_status *status);

struct accel_engine_job;

struct accel_engine {
	accel_engine_run run;
	void *data;
	void *memory; /* zero but for what live ranges hold */
	uint64_t memory_size;
	struct accel_range_space ranges; /* under the device's lock */
	pthread_t thread;
	pthread_mutex_t lock; /* protects what follows */
	pthread_cond_t submitted, ended;
	struct accel_job_table jobs;            /* until they were waited for */
	struct accel_engine_job *first, **last; /* to be run, and the one that runs */
	uint64_t sequence;
	size_t queued; /* bytes of streams that have not been run */
	bool stop;
};

/*
 * Gets the memory, of @memory_size bytes, a multiple of 4096, and starts the
 * thread, which calls @run with @data. -ENOMEM.
 */
int accel_engine_init(struct accel_engine *engine, uint64_t memory_size, accel_engine_run run,
		      void *data);
/* Runs what is queued, ends the thread, and returns the memory. */
void accel_engine_fini(struct accel_engine *engine);

/*
 * Functions of struct accel_transport_ops, for a transport whose state starts
 * with its struct accel_engine.
 */
int accel_engine_memory_new(void *state, uint64_t size, uint64_t *object);
void accel_engine_memory_free(void *state, uint64_t object);
void accel_engine_wait_for_room(void *state);
int accel_engine_submit(void *state, const struct accel_transport_job *job, uint64_t *sequence);
int accel_engine_wait(void *state, uint64_t sequence, int64_t timeout_ns,
		      struct gloss_status *status);

#endif
