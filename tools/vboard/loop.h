/* SPDX-License-Identifier: MIT */
/* The thread of a board: answers the host at its socket, and works. */
#ifndef VBOARD_LOOP_H
#define VBOARD_LOOP_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

/* A door and its board, as its thread calls them. */
struct vboard_loop_ops {
	/*
	 * Does what the host asks, once there is something: 1; 0: the host is gone; -errno.
	 * -ECANCELED ends the boards of all other loops with the same ->ended too.
	 */
	int (*serve)(void *data);
	/* False: nothing to do until the host asks something, or until due. */
	bool (*work)(void *data);
	/* In ns of CLOCK_MONOTONIC; UINT64_MAX: never. */
	uint64_t (*due)(const void *data);
	/* What poll() of the socket is to wait for. */
	short (*events)(const void *data);
};

struct vboard_loop {
	const struct vboard_loop_ops *ops;
	void *data;
	int socket; /* to QEMU */
	int ended;  /* eventfd that is told when the thread has ended */
	int error;  /* that ended it, or 0 */
	pthread_t thread;
};

/* Starts the thread; ->ops, ->data, ->socket and ->ended are set. 0, or -errno. */
int vboard_loop_start(struct vboard_loop *loop);
/* Ends it if it has not ended yet. */
void vboard_loop_stop(struct vboard_loop *loop);

/* ns of CLOCK_MONOTONIC. */
uint64_t vboard_now(void);

#endif
