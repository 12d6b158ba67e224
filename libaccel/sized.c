// SPDX-License-Identifier: MIT
/* Structs of accel.h that grow, between programs and libraries of different versions. */
#include <errno.h>
#include <string.h>

#include "accel_priv.h"

/* No struct is as large: what is larger was never set. */
#define SIZE_MAX_SANE 4096

/* Are the bytes from @known on, of those that the library has no member for, all zero? */
static bool sized_rest_is_zero(const uint8_t *given, size_t known, size_t size)
{
	for (size_t i = known; i < size; i++)
		if (given[i])
			return false;
	return true;
}

int accel_sized_in(void *own, size_t known, const void *given)
{
	size_t size;

	memcpy(&size, given, sizeof(size));
	if (size < sizeof(size) || size > SIZE_MAX_SANE)
		return -EINVAL;
	if (!sized_rest_is_zero(given, known, size))
		return -E2BIG;
	memset(own, 0, known);
	memcpy(own, given, size < known ? size : known);
	memcpy(own, &known, sizeof(known));
	return 0;
}

void accel_sized_message(struct accel_device *device, const char *what, const char *macro, int err)
{
	if (err == -E2BIG)
		accel_device_message(device,
				     "a %s with more than libaccel %s knows: the program "
				     "needs a newer library",
				     what, accel_version());
	else
		accel_device_message(device, "a %s whose size is not set: begin it with %s()", what,
				     macro);
}

void accel_sized_out(void *given, size_t size, const void *own, size_t known)
{
	size_t both = size < known ? size : known;

	memcpy(given, own, both);
	memset((uint8_t *)given + both, 0, size - both);
}
