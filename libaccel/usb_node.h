/* SPDX-License-Identifier: MIT */
/* A board on USB: finding it, having it for oneself, and its registers. */
#ifndef ACCEL_USB_NODE_H
#define ACCEL_USB_NODE_H

#include <libusb.h>

#include "transport.h"

struct accel_usb_node {
	libusb_context *context;	/* of this board alone */
	libusb_device_handle *handle;	/* which has claimed the interface */
	char name[sizeof("usb:0000:0000/") + 128];	/* as accel_device_new takes it */
};

/*
 * Opens the board @where says, or the first that opens if that is "", and claims it.
 * An error of struct accel_transport_ops.open that @error explains.
 */
int accel_usb_node_open(const char *where, struct accel_usb_node *node,
			struct accel_transport_error *error);
/* No transfer is in flight. */
void accel_usb_node_close(struct accel_usb_node *node);
/* What the board is called among its like: its serial number, "" if it has none. */
const char *accel_usb_node_serial(const struct accel_usb_node *node);

/* As struct accel_transport_ops.list. */
int accel_usb_node_list(accel_device_list_fn found, void *data);

/*
 * Registers, at byte @offset. Not to be called in a callback of libusb, and may call some.
 * -ENODEV: the board is gone; -EIO: it did not answer, or not so.
 */
int accel_usb_node_read(struct accel_usb_node *node, uint16_t offset, uint32_t *value);
int accel_usb_node_write(struct accel_usb_node *node, uint16_t offset, uint32_t value);

#endif
