// SPDX-License-Identifier: MIT
/* "usb:" in a library that was built where libusb is not. */
#include <errno.h>

#include "transport/transport.h"

static int transport_usb_open(const char *where, void **state, struct accel_transport_error *error)
{
	(void)where;
	(void)state;
	accel_transport_say(error, "this library was built without libusb; install "
				   "libusb-1.0-0-dev and build it again");
	return -ENOSYS;
}

const struct accel_transport_ops accel_transport_usb = {
	.scheme = "usb",
	.open = transport_usb_open,
};
