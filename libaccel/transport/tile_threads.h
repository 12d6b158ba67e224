/* SPDX-License-Identifier: MIT */
/*
 * Threads that draw the tiles of a job of "model:", beside the one that runs it. They are started
 * when a job first has two tiles to draw, as many as are wanted or can be had.
 */
#ifndef ACCEL_TILE_THREADS_H
#define ACCEL_TILE_THREADS_H

#include <pthread.h>

#include "model/model.h"
#include "transport/thread.h"

/* So far the pass over the stream may be ahead of drawing. */
#define ACCEL_TILE_PIECES 64

struct accel_tile_threads {
	int tile_size;
	void *memory; /* board memory, and its bytes */
	size_t memory_size;
	unsigned int wanted; /* besides the one that runs the job */
	struct model own;    /* that one's, to draw with */

	pthread_mutex_t lock; /* protects what follows */
	pthread_cond_t posted, idle;
	struct model_piece piece[ACCEL_TILE_PIECES]; /* a ring of what is not taken yet */
	unsigned int first, count;
	unsigned int drawing; /* threads that are at a piece */
	bool refused;         /* by the system, a thread; asked again for the next job */
	bool stop;
	struct model_counters counters; /* of pieces that were drawn */
	unsigned int threads;
	pthread_t thread[ACCEL_THREADS_MAX];
};

/*
 * Starts none so far. @count is 1 to ACCEL_THREADS_MAX, with the thread that runs jobs; the rest is
 * what their model was made with.
 */
void accel_tile_threads_init(struct accel_tile_threads *threads, unsigned int count, int tile_size,
			     void *memory, size_t memory_size);
/* Ends them. No job runs. */
void accel_tile_threads_fini(struct accel_tile_threads *threads);

/* Of model_run_parallel(), for a struct accel_tile_threads. */
extern const struct model_drawer accel_tile_drawer;

#endif
