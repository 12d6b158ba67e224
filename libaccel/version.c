// SPDX-License-Identifier: MIT
#include "accel_priv.h"

#define TEXT_OF(number) #number
#define TEXT(number) TEXT_OF(number)

const char *accel_version(void)
{
	return TEXT(ACCEL_VERSION_MAJOR) "." TEXT(ACCEL_VERSION_MINOR) "." TEXT(
		ACCEL_VERSION_PATCH);
}
