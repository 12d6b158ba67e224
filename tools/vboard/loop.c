// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include "vboard/loop.h"

#include <errno.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <time.h>

/* A host that keeps asking may take as much of the board's time, and no more. */
#define ASKING_NS 200000

uint64_t vboard_now(void)
{
	struct timespec time;

	clock_gettime(CLOCK_MONOTONIC, &time);
	return (uint64_t)time.tv_sec * 1000000000 + (uint64_t)time.tv_nsec;
}

/* Waits for the host until @due. 1: it asks something, 0: not, or -errno. */
static int loop_wait(const struct vboard_loop *loop, uint64_t due)
{
	struct pollfd polls = { .fd = loop->socket, .events = loop->ops->events(loop->data) };
	struct timespec left = { 0 };
	uint64_t time = due && due != UINT64_MAX ? vboard_now() : 0;
	int ret;

	if (due > time) {
		left.tv_sec = (time_t)((due - time) / 1000000000);
		left.tv_nsec = (long)((due - time) % 1000000000);
	}
	ret = ppoll(&polls, 1, due == UINT64_MAX ? NULL : &left, NULL);
	return ret >= 0 ? ret : errno == EINTR ? 0 : -errno;
}

/* Answers until the host has nothing more to ask or has asked for long. */
static int loop_answer(const struct vboard_loop *loop)
{
	uint64_t until = vboard_now() + ASKING_NS;
	int ret;

	do {
		ret = loop->ops->serve(loop->data);
		if (ret <= 0)
			return ret;
		ret = loop_wait(loop, 0);
	} while (ret > 0 && vboard_now() < until);
	return ret < 0 ? ret : 1;
}

/* Until QEMU is gone: 0, or -errno. */
static int loop_run(const struct vboard_loop *loop)
{
	bool busy = false;
	int ret;

	for (;;) {
		ret = loop_wait(loop, busy ? 0 : loop->ops->due(loop->data));
		if (ret > 0) {
			ret = loop_answer(loop);
			if (ret <= 0)
				return ret;
		}
		if (ret < 0)
			return ret;
		busy = loop->ops->work(loop->data);
	}
}

static void *loop_thread(void *data)
{
	struct vboard_loop *loop = data;

	loop->error = loop_run(loop);
	/* QEMU is not to wait for answers that will not come. */
	shutdown(loop->socket, SHUT_RDWR);
	eventfd_write(loop->ended, loop->error == -ECANCELED ? UINT32_MAX : 1);
	return NULL;
}

int vboard_loop_start(struct vboard_loop *loop)
{
	return -pthread_create(&loop->thread, NULL, loop_thread, loop);
}

void vboard_loop_stop(struct vboard_loop *loop)
{
	shutdown(loop->socket, SHUT_RDWR);
	pthread_join(loop->thread, NULL);
}
