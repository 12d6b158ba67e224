/* SPDX-License-Identifier: MIT */
/* The message of a job to a board on USB. */
#ifndef ACCEL_USB_JOB_MESSAGE_H
#define ACCEL_USB_JOB_MESSAGE_H

#include "transport/transport.h"
#include "transport/usb/link.h"

/* A job without its slots, its stream and its end, and where these go. NULL: out of memory. */
struct accel_usb_job *accel_usb_job_message_begin(struct accel_usb_link *link,
						  const struct accel_transport_job *from,
						  uint32_t **rest);
/* The slots and the stream are there. */
void accel_usb_job_message_finish(struct accel_usb_job *job);

#endif
