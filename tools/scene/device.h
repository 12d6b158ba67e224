/* SPDX-License-Identifier: MIT */
/* A board for a program with a command line, and what the library says of it. */
#ifndef TOOLS_DEVICE_H
#define TOOLS_DEVICE_H

#include "accel.h"

/*
 * Opens the board called @name. If it does not open, one line on stderr says so,
 * "@program: what: @name: why". Returns 0 or -errno. @program has to last as long as the device.
 */
int device_open(const char *program, const char *name, struct accel_device **device);

/* What the library said last of any device, or what @error means if it said nothing. */
const char *device_reason(int error);
/* For a call whose message is not to be taken for that of an earlier one. */
void device_reason_forget(void);

#endif
