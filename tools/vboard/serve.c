// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include "vboard/serve.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/signalfd.h>
#include <sys/socket.h>

static int signals = -1, ended = -1;

bool vboard_serve_init(void)
{
	sigset_t end;

	sigemptyset(&end);
	sigaddset(&end, SIGINT);
	sigaddset(&end, SIGTERM);
	pthread_sigmask(SIG_BLOCK, &end, NULL);
	signals = signalfd(-1, &end, SFD_CLOEXEC);
	ended = eventfd(0, EFD_CLOEXEC);
	if (signals >= 0 && ended >= 0)
		return true;
	vboard_error("signals", strerror(errno));
	return false;
}

bool vboard_serve_socket(const char *name, int fd)
{
	int domain = 0;
	socklen_t length = sizeof(domain);
	char why[64];

	if (!getsockopt(fd, SOL_SOCKET, SO_DOMAIN, &domain, &length) && domain == AF_UNIX)
		return true;
	snprintf(why, sizeof(why), "fd %d is not an open Unix socket", fd);
	vboard_error(name, why);
	return false;
}

void *vboard_serve_memory(uint64_t size)
{
	void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE,
			    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);

	return memory == MAP_FAILED ? NULL : memory;
}

/* Until all boards have ended, or a signal comes. */
static void serve_wait(unsigned int boards)
{
	struct pollfd polls[] = {
		{ .fd = signals, .events = POLLIN },
		{ .fd = ended, .events = POLLIN },
	};
	eventfd_t more;

	while (boards) {
		if (poll(polls, 2, -1) < 0 || polls[0].revents)
			return;
		if (!eventfd_read(ended, &more))
			boards -= more < boards ? (unsigned int)more : boards;
	}
}

enum vboard_exit vboard_serve_run(struct vboard_loop *const *loops, const char *const *names,
				  unsigned int count)
{
	enum vboard_exit ret = VBOARD_OK;
	unsigned int started;
	int err = 0;

	for (started = 0; started < count && !err; started += !err) {
		loops[started]->ended = ended;
		err = vboard_loop_start(loops[started]);
	}
	if (!err)
		serve_wait(count);
	for (unsigned int i = 0; i < started; i++) {
		vboard_loop_stop(loops[i]);
		if (!loops[i]->error || loops[i]->error == -ECANCELED)
			continue;
		vboard_error(names[i], strerror(-loops[i]->error));
		ret = VBOARD_FAILED;
	}
	if (err)
		vboard_error("thread", strerror(-err));
	return err ? VBOARD_FAILED : ret;
}
