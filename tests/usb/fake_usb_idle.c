/* SPDX-License-Identifier: MIT */
/*
 * Whether all other threads of this process sleep. The kernel knows, and how busy the machine is
 * makes no difference: who was woken and waits for a processor does not sleep.
 */
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "fake_usb_priv.h"

#define THREADS_MAX 256

struct glance {
	unsigned int threads;
	struct {
		long tid;
		unsigned long turns; /* how often it has been given a processor */
	} thread[THREADS_MAX];
};

static bool read_file(long tid, const char *name, char *text, size_t room)
{
	char path[64];
	ssize_t length;
	int fd;

	snprintf(path, sizeof(path), "/proc/self/task/%ld/%s", tid, name);
	fd = open(path, O_RDONLY | O_CLOEXEC);
	if (fd < 0)
		return false;
	length = read(fd, text, room - 1);
	close(fd);
	text[length > 0 ? length : 0] = 0;
	return length > 0;
}

/*
 * In one of the calls that wait for another thread, or for time. Not read: so a thread waits for
 * its turn under valgrind, which runs one at a time.
 */
static bool sleeps(long tid)
{
	static const long waits[] = { SYS_futex, SYS_clock_nanosleep, SYS_nanosleep, SYS_poll,
				      SYS_ppoll, SYS_select,          SYS_pselect6 };
	char text[128], *end;
	long call;

	if (!read_file(tid, "syscall", text, sizeof(text)))
		return false;
	call = strtol(text, &end, 10);
	if (end == text)
		return false;
	for (size_t n = 0; n < sizeof(waits) / sizeof(waits[0]); n++)
		if (call == waits[n])
			return true;
	return false;
}

static bool count_turns(long tid, unsigned long *turns)
{
	char text[128];

	return read_file(tid, "schedstat", text, sizeof(text)) &&
	       sscanf(text, "%*u %*u %lu", turns) == 1;
}

/* False: one does not sleep. */
static bool look(struct glance *glance, long clock)
{
	long self = syscall(SYS_gettid);
	DIR *tasks = opendir("/proc/self/task");
	struct dirent *entry;
	bool all = true;

	if (!tasks)
		fake_violation("no /proc/self/task, from which it is known who sleeps");
	glance->threads = 0;
	while (all && (entry = readdir(tasks))) {
		long tid = strtol(entry->d_name, NULL, 10);

		if (tid <= 0 || tid == self || tid == clock)
			continue;
		if (glance->threads == THREADS_MAX)
			fake_violation("more than %d threads", THREADS_MAX);
		glance->thread[glance->threads].tid = tid;
		all = count_turns(tid, &glance->thread[glance->threads++].turns) && sleeps(tid);
	}
	closedir(tasks);
	return all;
}

/*
 * One may have woken another that had been looked at, and gone to sleep before it was looked at
 * itself: then the other is awake at the second look, or has had a turn.
 */
bool fake_all_others_sleep(long clock)
{
	struct glance first = { 0 }, second = { 0 };

	if (!look(&first, clock) || !look(&second, clock) || first.threads != second.threads)
		return false;
	return !memcmp(first.thread, second.thread, first.threads * sizeof(first.thread[0]));
}
