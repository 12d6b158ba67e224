/* SPDX-License-Identifier: MIT */
/* A fault of a USB cable, of its board or of a call: chosen at random, armed, and what may come of
 * it. */
#ifndef USB_FAULT_H
#define USB_FAULT_H

#include <stdbool.h>
#include <stdint.h>

#include "fake_usb.h"

#define USB_FAULT_CALL FAKE_USB_FAULTS /* not the cable: a call answers an error */

struct usb_fault {
	int kind; /* enum fake_usb_fault, or USB_FAULT_CALL */
	uint64_t at;
	uint32_t value;
	int error;
	bool early; /* armed before the board is opened */
};

/* Those of a case. */
struct usb_faults {
	struct usb_fault fault[2];
	int count;
};

const char *usb_fault_name(int kind);

/* The protocol has a place for it, so nothing may come of it. */
bool usb_fault_harmless(const struct usb_fault *fault);
/* The host is told, so that it need not wait until nothing has moved for long. */
bool usb_fault_is_told(const struct usb_fault *fault);
bool usb_fault_ends_host(const struct usb_fault *fault);
bool usb_fault_kills(const struct usb_fault *fault);
bool usb_fault_delays(const struct usb_fault *fault);

/* Mostly one; a second one may come while the library gets over the first. */
struct usb_faults usb_faults_choose(uint64_t *seed);
bool usb_faults_any(const struct usb_faults *faults, bool (*is)(const struct usb_fault *fault));
bool usb_faults_all(const struct usb_faults *faults, bool (*is)(const struct usb_fault *fault));
/* Those that are to come before the board is opened, or those that are not. */
void usb_faults_arm(const struct usb_faults *faults, bool early);

#endif
