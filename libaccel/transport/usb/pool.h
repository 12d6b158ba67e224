/* SPDX-License-Identifier: MIT */
/*
 * Memory for messages to a board on USB. What has been sent is kept for the next message of its
 * size, up to a bound, as memory that is new to the program costs more than to send what is
 * in it. Any thread may call any function.
 */
#ifndef ACCEL_USB_POOL_H
#define ACCEL_USB_POOL_H

#include <pthread.h>
#include <stddef.h>
#include <stdint.h>

struct accel_usb_buffer {
	struct accel_usb_buffer *next;
	size_t room;			/* words */
	uint32_t word[];
};

struct accel_usb_pool {
	pthread_mutex_t lock;		/* protects unused */
	struct accel_usb_buffer *unused;	/* the latest first */
};

void accel_usb_pool_init(struct accel_usb_pool *pool);
/* Every buffer was put. */
void accel_usb_pool_fini(struct accel_usb_pool *pool);

/* A buffer with room for @words words, in which there is anything; NULL: out of memory. */
struct accel_usb_buffer *accel_usb_pool_get(struct accel_usb_pool *pool, size_t words);
/* Takes NULL. */
void accel_usb_pool_put(struct accel_usb_pool *pool, struct accel_usb_buffer *buffer);

#endif
