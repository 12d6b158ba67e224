/* SPDX-License-Identifier: MIT */
/* A clock that moves only when the test says so: link with --wrap=clock_gettime. */
#ifndef STILL_CLOCK_H
#define STILL_CLOCK_H

#include <stdint.h>
#include <time.h>

static uint64_t still_clock_us = 1000000;

int __wrap_clock_gettime(clockid_t clock, struct timespec *now);

int __wrap_clock_gettime(clockid_t clock, struct timespec *now)
{
	(void)clock;
	now->tv_sec = (time_t)(still_clock_us / 1000000);
	now->tv_nsec = (long)(still_clock_us % 1000000 * 1000);
	return 0;
}

static inline void time_passes(uint64_t us)
{
	still_clock_us += us;
}

#endif
