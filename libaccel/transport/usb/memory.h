/* SPDX-License-Identifier: MIT */
/*
 * The memory of a board on USB, which the library hands out itself. A range is cleared by a job
 * ahead of the first that may see it. The calls are made one at a time, under the device's lock.
 */
#ifndef ACCEL_USB_MEMORY_H
#define ACCEL_USB_MEMORY_H

#include "transport/range.h"
#include "transport/transport.h"
#include "transport/usb/link.h"

struct accel_usb_memory {
	struct accel_usb_link *link;
	uint32_t tile_size;
	struct accel_range_space ranges;
	struct usb_object *objects;
};

void accel_usb_memory_init(struct accel_usb_memory *memory, struct accel_usb_link *link,
			   const struct accel_transport_info *info);

/* As in struct accel_transport_ops. */
int accel_usb_memory_new(struct accel_usb_memory *memory, uint64_t size, uint64_t *object);
void accel_usb_memory_free(struct accel_usb_memory *memory, uint64_t object);

/* The job's slots, into @words. -EINVAL: there is no such object. */
int accel_usb_memory_slots(struct accel_usb_memory *memory, const struct accel_transport_job *from,
			   uint32_t *words);
/*
 * Sees to it that what the job's slots name is zero before the job that is submitted next with
 * @losses, unless that answers -EAGAIN because a clearing job may have been lost.
 */
int accel_usb_memory_clear(struct accel_usb_memory *memory, const struct accel_transport_job *from,
			   uint64_t losses);

#endif
