// SPDX-License-Identifier: MIT
/* "drm:" in a library that was built where libdrm is not. */
#include <errno.h>

#include "transport/transport.h"

static int transport_drm_open(const char *where, void **state, struct accel_transport_error *error)
{
	(void)where;
	(void)state;
	accel_transport_say(error, "this library was built without libdrm; install libdrm-dev and "
				   "build it again");
	return -ENOSYS;
}

const struct accel_transport_ops accel_transport_drm = {
	.scheme = "drm",
	.open = transport_drm_open,
};
