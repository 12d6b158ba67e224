/* SPDX-License-Identifier: MIT */
/* Threads of the library, and waiting for what they do. */
#ifndef ACCEL_THREAD_H
#define ACCEL_THREAD_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

/* A thread that no signal is delivered to: those are for the program's own. 0, or -ENOMEM. */
int accel_thread_new(pthread_t *thread, void *(*run)(void *), void *argument);

/*
 * Between these two the calling thread is not cancelled, which would leave locks taken and jobs
 * without an owner. The first returns what the second takes.
 */
int accel_thread_hold_cancel(void);
void accel_thread_allow_cancel(int held);

/* The most that work on one thing. */
#define ACCEL_THREADS_MAX 64

/* Processors that this thread may run on, 1 to ACCEL_THREADS_MAX. */
unsigned int accel_thread_processors(void);

/* CLOCK_MONOTONIC */
int64_t accel_thread_now_ns(void);
int64_t accel_thread_now_ms(void);

/* A condition for accel_thread_wait, which waits against a clock that nobody sets. */
void accel_thread_condition_init(pthread_cond_t *condition);

/*
 * Waits until *@done, which is changed under @lock with a broadcast of @condition. Called with
 * @lock held, which it gives up while it sleeps. @timeout_ns < 0: for ever. 0, or -ETIMEDOUT.
 */
int accel_thread_wait(pthread_cond_t *condition, pthread_mutex_t *lock, const bool *done,
		      int64_t timeout_ns);

#endif
