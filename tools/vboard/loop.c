// SPDX-License-Identifier: MIT
/* The thread of a board: answers the host, and works. */
#define _GNU_SOURCE
#include <errno.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <time.h>

#include "vboard.h"

/* A host that keeps asking may take as much of the board's time, and no more. */
#define ASKING_NS 200000

static uint64_t now(void)
{
	struct timespec time;

	clock_gettime(CLOCK_MONOTONIC, &time);
	return (uint64_t)time.tv_sec * 1000000000 + (uint64_t)time.tv_nsec;
}

/* Waits for a message until @due. 1: there is one, 0: none, or -errno. */
static int loop_wait(const struct vboard *vboard, uint64_t due)
{
	struct pollfd polls = { .fd = vboard->socket, .events = POLLIN };
	struct timespec left = { 0 };
	uint64_t time = due && due != UINT64_MAX ? now() : 0;
	int ret;

	if (due > time) {
		left.tv_sec = (time_t)((due - time) / 1000000000);
		left.tv_nsec = (long)((due - time) % 1000000000);
	}
	ret = ppoll(&polls, 1, due == UINT64_MAX ? NULL : &left, NULL);
	return ret >= 0 ? ret : errno == EINTR ? 0 : -errno;
}

/* Answers until the host has nothing more to ask or has asked for long. */
static int loop_answer(struct vboard *vboard)
{
	uint64_t until = now() + ASKING_NS;
	int ret;

	do {
		ret = vboard_door_pci_serve(vboard);
		if (ret <= 0)
			return ret;
		ret = loop_wait(vboard, 0);
	} while (ret > 0 && now() < until);
	return ret < 0 ? ret : 1;
}

/* Until QEMU is gone: 0, or -errno. */
static int loop_run(struct vboard *vboard)
{
	bool busy = false;
	int ret;

	for (;;) {
		ret = loop_wait(vboard, busy ? 0 : vboard_faults_due(&vboard->faults));
		if (ret > 0) {
			ret = loop_answer(vboard);
			if (ret <= 0)
				return ret;
		}
		if (ret < 0)
			return ret;
		busy = vboard_faults_work(&vboard->faults);
	}
}

static void *loop_thread(void *data)
{
	struct vboard *vboard = data;

	vboard->error = loop_run(vboard);
	/* QEMU is not to wait for answers that will not come. */
	shutdown(vboard->socket, SHUT_RDWR);
	eventfd_write(vboard->ended, 1);
	return NULL;
}

int vboard_loop_start(struct vboard *vboard)
{
	return -pthread_create(&vboard->thread, NULL, loop_thread, vboard);
}

void vboard_loop_stop(struct vboard *vboard)
{
	shutdown(vboard->socket, SHUT_RDWR);
	pthread_join(vboard->thread, NULL);
}
