/* SPDX-License-Identifier: MIT */
/*
 * Jobs on a board on USB: what is sent and received, and when that has failed. There are always
 * transfers in flight, of each direction several, and one thread for what comes of them. When
 * something is not as it ought to be, the thread ends all that is outstanding with an error,
 * resets the board and starts anew; if that fails, the board is gone for good.
 */
#ifndef ACCEL_USB_LINK_H
#define ACCEL_USB_LINK_H

#include <pthread.h>

#include "transport/job_table.h"
#include "transport/pool.h"
#include "transport/usb/message.h"
#include "transport/usb/node.h"

/* The memory of a message. */
struct accel_usb_buffer {
	struct accel_pool_buffer pooled;
	uint32_t word[];
};

struct accel_usb_job {
	struct accel_job_entry entry; /* first; the board has the lower half of its sequence */
	struct accel_usb_job *next;   /* that has not ended */
	struct accel_usb_answer answer;
	bool must;                        /* a fault in it is a failure of the board */
	bool forgotten;                   /* it is gone when it has ended */
	bool answered;                    /* to the end */
	int error;                        /* if it has ended so */
	size_t bytes;                     /* of the message */
	size_t started, sent;             /* given to transfers, and in those that have ended */
	struct accel_usb_buffer *message; /* NULL once it is sent */
};

struct accel_usb_link;

/*
 * Brings the board up, and starts the thread. @node stays the caller's, and lasts as long as
 * the link. -ENOMEM (the kernel's, too), -ENODEV (it is gone), -EIO (it does not do as a board
 * does).
 */
int accel_usb_link_new(struct accel_usb_node *node, struct accel_usb_link **link);
/* No job is outstanding. */
void accel_usb_link_free(struct accel_usb_link *link);

/* For good. */
bool accel_usb_link_is_gone(struct accel_usb_link *link);
/* What is behind @err of a job, for people; NULL: that says it all. */
const char *accel_usb_link_why(struct accel_usb_link *link, int err);
/* As struct accel_transport_ops.clocks. */
int accel_usb_clocks_read(struct accel_usb_link *link, struct accel_device_clocks *clocks);

/* A job with room for a message of @words words; NULL: out of memory. */
struct accel_usb_job *accel_usb_job_new(struct accel_usb_link *link, size_t words);
void accel_usb_job_free(struct accel_usb_link *link, struct accel_usb_job *job);

/* How often all that was outstanding has been lost. */
uint64_t accel_usb_link_losses(struct accel_usb_link *link);

/* While more than a bound is queued, waits until that is sent, or lost, or the board gone. */
void accel_usb_link_wait_for_room(struct accel_usb_link *link);

/*
 * Sends a job, which is the link's from then on, and stores its number. It does not wait.
 * -EAGAIN: losses are not @losses any more; -ENODEV. Then the job is still the caller's.
 */
int accel_usb_link_submit(struct accel_usb_link *link, struct accel_usb_job *job, uint64_t losses,
			  uint64_t *sequence);

/* As struct accel_transport_ops.wait. */
int accel_usb_link_wait(struct accel_usb_link *link, uint64_t sequence, int64_t timeout_ns,
			struct gloss_status *status);
/* Nobody will wait for the job. */
void accel_usb_link_forget(struct accel_usb_link *link, uint64_t sequence);

#endif
