/* SPDX-License-Identifier: MIT */
/* Which board on USB is meant, and what each is called. */
#ifndef ACCEL_USB_WHERE_H
#define ACCEL_USB_WHERE_H

#include <libusb.h>
#include <stdbool.h>

#include "transport/transport.h"

#define USB_INTERFACE 0
#define USB_SERIAL_BYTES 128 /* a string of a descriptor has at most 126 characters */
#define USB_NAME_BYTES (sizeof("usb:0000:0000/") + USB_SERIAL_BYTES)

struct accel_usb_where {
	uint16_t vendor, product;
	const char *serial; /* NULL: any */
	const char *path;   /* of bus and ports; then ids and serial are any. NULL: any */
};

/* Reads what stands behind "usb:"; strings stay in @text. -EINVAL, which @error explains. */
int accel_usb_where_parse(const char *text, struct accel_usb_where *where,
			  struct accel_transport_error *error);
/* Bus and ports as the kernel has them, "1-2.3"; "" if that is not known. */
void accel_usb_where_path(libusb_device *device, char path[USB_NAME_BYTES]);
/* By its ids and @serial, or ("") by its ids alone. */
void accel_usb_where_name(const struct libusb_device_descriptor *descriptor, const char *serial,
			  char name[USB_NAME_BYTES]);

/* By bus and address, as lsusb has them. */
unsigned int accel_usb_where_place(libusb_device *device);
/* The board of @list that is meant and comes next after place @last; NULL: there is none. */
libusb_device *accel_usb_where_next(libusb_device *const *list, const struct accel_usb_where *where,
				    unsigned int last);

#endif
