// SPDX-License-Identifier: MIT
#define _GNU_SOURCE /* sched_getaffinity() */
#include <errno.h>
#include <sched.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include "transport/thread.h"

#define NS_PER_S 1000000000
#define NS_PER_MS 1000000

/* A longer wait is one for ever; the sum with the present still fits any time_t. */
#define WAIT_MAX_S 1000000000

int accel_thread_new(pthread_t *thread, void *(*run)(void *), void *argument)
{
	sigset_t all, old;
	int err;

	sigfillset(&all);
	pthread_sigmask(SIG_SETMASK, &all, &old);
	err = pthread_create(thread, NULL, run, argument);
	pthread_sigmask(SIG_SETMASK, &old, NULL);
	return err ? -ENOMEM : 0;
}

unsigned int accel_thread_processors(void)
{
	long count;
	cpu_set_t set;

	if (!sched_getaffinity(0, sizeof(set), &set))
		count = CPU_COUNT(&set);
	else /* There are more than the set has room for. */
		count = sysconf(_SC_NPROCESSORS_ONLN);
	return count < 1 ? 1 : count > ACCEL_THREADS_MAX ? ACCEL_THREADS_MAX : (unsigned int)count;
}

int accel_thread_hold_cancel(void)
{
	int held;

	pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &held);
	return held;
}

void accel_thread_allow_cancel(int held)
{
	pthread_setcancelstate(held, NULL);
}

int64_t accel_thread_now_ns(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return now.tv_sec * (int64_t)NS_PER_S + now.tv_nsec;
}

int64_t accel_thread_now_ms(void)
{
	return accel_thread_now_ns() / NS_PER_MS;
}

void accel_thread_condition_init(pthread_cond_t *condition)
{
	pthread_condattr_t attributes;

	pthread_condattr_init(&attributes);
	pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
	pthread_cond_init(condition, &attributes);
	pthread_condattr_destroy(&attributes);
}

static struct timespec thread_deadline(int64_t timeout_ns)
{
	struct timespec at;

	clock_gettime(CLOCK_MONOTONIC, &at);
	at.tv_sec += (time_t)(timeout_ns / NS_PER_S);
	at.tv_nsec += (long)(timeout_ns % NS_PER_S);
	if (at.tv_nsec >= NS_PER_S) {
		at.tv_nsec -= NS_PER_S;
		at.tv_sec++;
	}
	return at;
}

int accel_thread_wait(pthread_cond_t *condition, pthread_mutex_t *lock, const bool *done,
		      int64_t timeout_ns)
{
	struct timespec deadline;

	if (timeout_ns < 0 || timeout_ns / NS_PER_S > WAIT_MAX_S) {
		while (!*done)
			pthread_cond_wait(condition, lock);
		return 0;
	}
	deadline = thread_deadline(timeout_ns);
	while (!*done)
		if (pthread_cond_timedwait(condition, lock, &deadline) == ETIMEDOUT)
			return *done ? 0 : -ETIMEDOUT;
	return 0;
}
