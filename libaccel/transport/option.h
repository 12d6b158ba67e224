/* SPDX-License-Identifier: MIT */
/* What may follow the colon of a device name: "tile=32,lanes=4". */
#ifndef ACCEL_OPTION_H
#define ACCEL_OPTION_H

#include <stdint.h>

#include "transport/transport.h"

/* A number, named by @name; 0 in @multiple_of means a power of two. */
struct accel_option {
	const char *name;
	uint64_t min, max;
	uint64_t multiple_of;
	uint64_t *value; /* keeps its default if the option is not given */
};

/*
 * Reads @text, options separated by commas, into the values of @options, whose
 * last entry has no name. -EINVAL: an option that is unknown, given twice or not
 * such a number; @error says which. Values may have been set before the wrong one.
 */
int accel_option_parse(const char *text, const struct accel_option *options,
		       struct accel_transport_error *error);

#endif
