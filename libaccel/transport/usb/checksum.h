/* SPDX-License-Identifier: MIT */
/* The checksum of what goes over USB, see rtl/INTERFACE.md. */
#ifndef ACCEL_USB_CHECKSUM_H
#define ACCEL_USB_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* That of @count words behind those that @sum is of; it begins with 0. */
static inline uint32_t accel_usb_checksum(uint32_t sum, const uint32_t *words, size_t count)
{
	size_t i;

	for (i = 0; i < count; i++)
		sum = (sum << 1 | sum >> 31) + words[i];
	return sum;
}

#endif
