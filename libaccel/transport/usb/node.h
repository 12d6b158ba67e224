/* SPDX-License-Identifier: MIT */
/* A board on USB: finding it, having it for oneself, and its registers. */
#ifndef ACCEL_USB_NODE_H
#define ACCEL_USB_NODE_H

#include <libusb.h>
#include <stdbool.h>

#include "transport/usb/where.h"

/* What a program that gets no memory from the kernel's USB can do about it. */
#define USB_NO_MEMORY                                           \
	"the kernel has no memory for USB transfers, of which " \
	"/sys/module/usbcore/parameters/usbfs_memory_mb is the bound"

struct accel_usb_node {
	libusb_context *context;       /* of this board alone */
	libusb_device_handle *handle;  /* which has claimed the interface */
	bool stuck;                    /* transfers are in flight that do not end */
	char name[USB_NAME_BYTES];     /* as accel_device_new takes it */
	char serial[USB_SERIAL_BYTES]; /* "": it has none */
};

/*
 * Opens the board @where says, or the first that opens if that is "", and claims it.
 * An error of struct accel_transport_ops.open that @error explains.
 */
int accel_usb_node_open(const char *where, struct accel_usb_node *node,
			struct accel_transport_error *error);
/* No transfer is in flight, so the node is not stuck. */
void accel_usb_node_close(struct accel_usb_node *node);
/*
 * Claims the interface once more if that can be had: then it had been lost, as when somebody else
 * resets the bus. No transfer is in flight. -ENODEV: the board is gone.
 */
int accel_usb_node_claim_again(struct accel_usb_node *node);
/* That of an answer of libusb to a call for an open board: 0 (also for a count), -ENODEV, -ENOMEM,
 * or -EIO for all else. */
int accel_usb_node_error(int err);

/* As struct accel_transport_ops.list. */
int accel_usb_node_list(accel_device_list_fn found, void *data);

/*
 * Reads or writes the register at byte @offset. Must not be called from a callback of libusb. While
 * it waits, callbacks of other transfers may be called.
 * -ENODEV: the board is gone; -ENOMEM; -EIO: it did not answer, or not so.
 */
int accel_usb_node_read(struct accel_usb_node *node, uint16_t offset, uint32_t *value);
int accel_usb_node_write(struct accel_usb_node *node, uint16_t offset, uint32_t value);

#endif
