/* SPDX-License-Identifier: MIT */
/*
 * Time that can leap: the library and the bus have it from here, everybody else from outside. It
 * leaps to the next moment that anybody waits for, and only while all threads sleep, so that who
 * was about to do something does it first, however busy the machine is. Otherwise it passes, but
 * slower than outside.
 */
#include <errno.h>
#include <stdatomic.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "fake_usb_priv.h"

#define NS_PER_S 1000000000ll
#define NS_PER_MS 1000000ll
#define NS_PER_US 1000ll
#define LOOK_NS 100000ll    /* outside, between two looks at who sleeps */
#define SLICE_NS 50000000ll /* outside, at most asleep without looking at the clock */
#define SLOWNESS 16         /* times slower than outside */

#define ROUND_NS 1000000ll /* of the bus, in a flood */
#define ROUNDS 16          /* at once */
#define FLOOD_ROUNDS 4096

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

/* Somebody asleep until @until, of CLOCK_MONOTONIC. */
struct sleeper {
	struct sleeper *next, **link;
	int64_t until;
	bool leaps; /* time leaps for it though the boards are held */
	pthread_cond_t *cond;
};

static struct {
	pthread_mutex_t lock; /* taken last */
	pthread_cond_t changed;
	struct sleeper *sleepers;
	unsigned int changes; /* of who sleeps */
	pthread_t thread;
	_Atomic long tid; /* of thread */
	bool runs, ends;
} clocks = { .lock = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER };

static _Atomic int64_t leapt;
static _Atomic unsigned int rounds; /* since anybody waited for the bus */
static atomic_bool stands;          /* but for who sleeps here */

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

/* Until @ns from now, outside. */
static void real_wait(pthread_cond_t *cond, pthread_mutex_t *mutex, int64_t ns)
{
	struct timespec until = from_ns(real_ns(CLOCK_MONOTONIC) + ns);

	__real_pthread_cond_clockwait(cond, mutex, CLOCK_MONOTONIC, &until);
}

/* ---- who sleeps ---- */

static void sleeper_add(struct sleeper *sleeper)
{
	pthread_mutex_lock(&clocks.lock);
	sleeper->next = clocks.sleepers;
	sleeper->link = &clocks.sleepers;
	if (sleeper->next)
		sleeper->next->link = &sleeper->next;
	clocks.sleepers = sleeper;
	clocks.changes++;
	pthread_cond_signal(&clocks.changed);
	pthread_mutex_unlock(&clocks.lock);
}

static void sleeper_remove(struct sleeper *sleeper)
{
	pthread_mutex_lock(&clocks.lock);
	*sleeper->link = sleeper->next;
	clocks.changes++;
	if (sleeper->next)
		sleeper->next->link = sleeper->link;
	pthread_mutex_unlock(&clocks.lock);
}

/* Wakes now and then for nothing, which callers have to bear anyway. */
static void sleep_until(int64_t until, bool leaps, pthread_cond_t *cond, pthread_mutex_t *mutex)
{
	struct sleeper sleeper = { .until = until, .leaps = leaps, .cond = cond };
	int64_t left = until - fake_usb_now_ns();

	if (left <= 0)
		return;
	sleeper_add(&sleeper);
	real_wait(cond, mutex, left < SLICE_NS / SLOWNESS ? left * SLOWNESS : SLICE_NS);
	sleeper_remove(&sleeper);
}

/* ---- leaps ---- */

static void wake_locked(void)
{
	int64_t now = fake_usb_now_ns();

	for (struct sleeper *s = clocks.sleepers; s; s = s->next)
		if (s->until <= now)
			pthread_cond_broadcast(s->cond);
}

void fake_clock_leap(int64_t ns)
{
	pthread_mutex_lock(&clocks.lock);
	leapt += ns;
	wake_locked();
	pthread_mutex_unlock(&clocks.lock);
}

/* To when the first of them wakes; INT64_MAX: nowhere. */
static int64_t leap_to_locked(void)
{
	bool leaps = !stands;
	int64_t until = INT64_MAX;

	for (const struct sleeper *s = clocks.sleepers; s; s = s->next) {
		leaps |= s->leaps;
		if (s->until < until)
			until = s->until;
	}
	return leaps ? until : INT64_MAX;
}

/* By @left, if all sleep; without the lock while that is looked at: who waits for it sleeps, too. */
static bool leap_locked(int64_t left)
{
	unsigned int changes = clocks.changes;
	bool all;

	pthread_mutex_unlock(&clocks.lock);
	all = fake_all_others_sleep(clocks.tid);
	pthread_mutex_lock(&clocks.lock);
	if (!all || clocks.changes != changes)
		return false;
	leapt += left;
	wake_locked();
	return true;
}

static void *clock_run(void *data)
{
	(void)data;
	pthread_mutex_lock(&clocks.lock);
	clocks.tid = syscall(SYS_gettid);
	while (!clocks.ends) {
		int64_t until = leap_to_locked(), left = until - fake_usb_now_ns();

		if (until == INT64_MAX)
			pthread_cond_wait(&clocks.changed, &clocks.lock);
		else if (left <= 0 || !leap_locked(left))
			real_wait(&clocks.changed, &clocks.lock, LOOK_NS);
	}
	pthread_mutex_unlock(&clocks.lock);
	return NULL;
}

/* A child of fork() has neither the thread nor those who slept. */
static void fork_prepare(void)
{
	pthread_mutex_lock(&clocks.lock);
}

static void fork_in_parent(void)
{
	pthread_mutex_unlock(&clocks.lock);
}

static void fork_in_child(void)
{
	pthread_mutex_init(&clocks.lock, NULL);
	pthread_cond_init(&clocks.changed, NULL);
	clocks.sleepers = NULL;
	clocks.runs = false;
	clocks.tid = 0;
}

void fake_clock_start(void)
{
	static bool prepared;

	stands = false;
	if (clocks.runs)
		return;
	if (!prepared && pthread_atfork(fork_prepare, fork_in_parent, fork_in_child))
		fake_violation("no memory for the clock");
	prepared = true;
	clocks.ends = false;
	if (pthread_create(&clocks.thread, NULL, clock_run, NULL))
		fake_violation("no thread for the clock");
	clocks.runs = true;
}

void fake_clock_stop(void)
{
	if (!clocks.runs)
		return;
	pthread_mutex_lock(&clocks.lock);
	clocks.ends = true;
	pthread_cond_signal(&clocks.changed);
	pthread_mutex_unlock(&clocks.lock);
	pthread_join(clocks.thread, NULL);
	clocks.runs = false;
}

void fake_clock_stand(bool value)
{
	pthread_mutex_lock(&clocks.lock);
	stands = value;
	pthread_cond_signal(&clocks.changed);
	pthread_mutex_unlock(&clocks.lock);
}

/* In a flood nobody sleeps until there is something new, and it has an end, too. */
void fake_clock_round(void)
{
	if (++rounds >= FLOOD_ROUNDS && !(rounds % ROUNDS) && fake_all_others_sleep(clocks.tid))
		fake_clock_leap(ROUNDS * ROUND_NS);
}

/* ---- waits ---- */

void fake_clock_wait(pthread_cond_t *cond, pthread_mutex_t *mutex, int64_t deadline, int64_t due)
{
	rounds = 0;
	sleep_until(deadline < due ? deadline : due, due != INT64_MAX, cond, mutex);
}

/* ---- in place of the C library's ---- */

int __wrap_clock_gettime(clockid_t clock, struct timespec *now)
{
	int err = __real_clock_gettime(clock, now);

	if (!err && (clock == CLOCK_MONOTONIC || clock == CLOCK_REALTIME))
		*now = from_ns(inside_ns(clock, to_ns(now)));
	return err;
}

int __wrap_pthread_cond_clockwait(pthread_cond_t *cond, pthread_mutex_t *mutex, clockid_t clock,
				  const struct timespec *deadline)
{
	int64_t left = to_ns(deadline) - now_ns(clock);

	if (left <= 0)
		return ETIMEDOUT;
	sleep_until(fake_usb_now_ns() + left, false, cond, mutex);
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

/* If all others sleep and nobody wakes before: many short ones after another take no time so. */
static bool leap_alone(int64_t until)
{
	int64_t left = until - fake_usb_now_ns();
	bool done = true;

	pthread_mutex_lock(&clocks.lock);
	for (const struct sleeper *s = clocks.sleepers; s; s = s->next)
		done &= s->until > until;
	done = done && (left <= 0 || leap_locked(left));
	pthread_mutex_unlock(&clocks.lock);
	return done;
}

static void sleep_ns(int64_t ns)
{
	pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
	pthread_cond_t cond = PTHREAD_COND_INITIALIZER;
	int64_t until = fake_usb_now_ns() + ns;

	if (leap_alone(until))
		return;
	pthread_mutex_lock(&mutex);
	while (fake_usb_now_ns() < until)
		sleep_until(until, true, &cond, &mutex);
	pthread_mutex_unlock(&mutex);
}

void fake_usb_rest(unsigned int ms)
{
	sleep_ns(ms * NS_PER_MS);
}

int __wrap_nanosleep(const struct timespec *time, struct timespec *left)
{
	(void)left;
	sleep_ns(to_ns(time));
	return 0;
}

int __wrap_usleep(useconds_t us)
{
	sleep_ns(us * NS_PER_US);
	return 0;
}
