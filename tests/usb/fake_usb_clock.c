/* SPDX-License-Identifier: MIT */
/*
 * Time that can leap: the library and the bus have it from here, everybody else from outside. Where
 * it does not leap it is slower than outside, so that what the library gives a board in seconds is
 * enough on a machine that is busy with other things.
 */
#include <errno.h>
#include <sched.h>
#include <stdatomic.h>
#include <time.h>
#include <unistd.h>

#include "fake_usb_priv.h"

#define NS_PER_S 1000000000ll
#define LEAP_NS 50000000ll     /* at once */
#define LEAP_AFTER_NS 100000ll /* nobody did anything for so long */
#define SLICE_NS 2000000ll
#define SLOWNESS 16 /* times slower than outside */

int __real_clock_gettime(clockid_t clock, struct timespec *now);
int __real_pthread_cond_clockwait(pthread_cond_t *cond, pthread_mutex_t *mutex, clockid_t clock,
				  const struct timespec *deadline);
int __wrap_clock_gettime(clockid_t clock, struct timespec *now);
int __wrap_pthread_cond_clockwait(pthread_cond_t *cond, pthread_mutex_t *mutex, clockid_t clock,
				  const struct timespec *deadline);
int __wrap_pthread_cond_timedwait(pthread_cond_t *cond, pthread_mutex_t *mutex,
				  const struct timespec *deadline);
int __wrap_nanosleep(const struct timespec *time, struct timespec *left);
int __wrap_usleep(useconds_t us);

static _Atomic int64_t leapt;

static int64_t to_ns(const struct timespec *time)
{
	return time->tv_sec * NS_PER_S + time->tv_nsec;
}

static struct timespec from_ns(int64_t ns)
{
	return (struct timespec){ ns / NS_PER_S, ns % NS_PER_S };
}

static int64_t real_ns(clockid_t clock)
{
	struct timespec now;

	__real_clock_gettime(clock, &now);
	return to_ns(&now);
}

/* What a clock says here when it says @now outside. */
static int64_t inside_ns(clockid_t clock, int64_t now)
{
	static _Atomic int64_t begins[2];
	int64_t begin = 0;

	if (atomic_compare_exchange_strong(&begins[clock == CLOCK_REALTIME], &begin, now))
		begin = now;
	return begin + (now - begin) / SLOWNESS + leapt;
}

static int64_t now_ns(clockid_t clock)
{
	return inside_ns(clock, real_ns(clock));
}

int64_t fake_usb_now_ns(void)
{
	return now_ns(CLOCK_MONOTONIC);
}

int64_t fake_usb_leapt_ns(void)
{
	return leapt;
}

void fake_clock_leap(int64_t ns)
{
	leapt += ns;
}

/* Until @ns from now, outside. False: it was that long. */
static bool real_wait(pthread_cond_t *cond, pthread_mutex_t *mutex, int64_t ns)
{
	struct timespec until = from_ns(real_ns(CLOCK_MONOTONIC) + ns);

	return __real_pthread_cond_clockwait(cond, mutex, CLOCK_MONOTONIC, &until) != ETIMEDOUT;
}

void fake_clock_wait(int64_t deadline, int64_t due)
{
	int64_t now = fake_usb_now_ns(), wait = deadline - now, leap = wait;

	if (leap > due - now)
		leap = due - now;
	else if (leap > LEAP_NS)
		leap = LEAP_NS;
	if (due == INT64_MAX && !fake.hurry && !fake.leap_always)
		leap = 0;
	if (wait > (leap ? LEAP_AFTER_NS : NS_PER_S))
		wait = leap ? LEAP_AFTER_NS : NS_PER_S;
	if (fake.leap_always && wait > 0)
		wait = 1;
	if (wait > 0 && !real_wait(&fake.changed, &fake.lock, wait) && leap > 0)
		fake_clock_leap(leap);
}

void fake_clock_stand_by(void)
{
	real_wait(&fake.changed, &fake.lock, SLICE_NS);
}

/* ---- in place of the C library's ---- */

int __wrap_clock_gettime(clockid_t clock, struct timespec *now)
{
	int err = __real_clock_gettime(clock, now);

	if (!err && (clock == CLOCK_MONOTONIC || clock == CLOCK_REALTIME))
		*now = from_ns(inside_ns(clock, to_ns(now)));
	return err;
}

/* Wakes now and then for nothing, which callers have to bear anyway: time may have leapt. */
int __wrap_pthread_cond_clockwait(pthread_cond_t *cond, pthread_mutex_t *mutex, clockid_t clock,
				  const struct timespec *deadline)
{
	int64_t left = to_ns(deadline) - now_ns(clock);

	if (left <= 0)
		return ETIMEDOUT;
	real_wait(cond, mutex, left < SLICE_NS ? left : SLICE_NS);
	return 0;
}

/* A time of so many years is of the clock that counts from 1970. */
int __wrap_pthread_cond_timedwait(pthread_cond_t *cond, pthread_mutex_t *mutex,
				  const struct timespec *deadline)
{
	bool realtime = deadline->tv_sec > 1000000000 && deadline->tv_sec < 4000000000;

	return __wrap_pthread_cond_clockwait(cond, mutex,
					     realtime ? CLOCK_REALTIME : CLOCK_MONOTONIC, deadline);
}

int __wrap_nanosleep(const struct timespec *time, struct timespec *left)
{
	(void)left;
	fake_clock_leap(to_ns(time));
	sched_yield();
	return 0;
}

int __wrap_usleep(useconds_t us)
{
	return __wrap_nanosleep(&(struct timespec){ us / 1000000, us % 1000000 * 1000l }, NULL);
}
