/* SPDX-License-Identifier: MIT */
/* What a USB board says it is: USB 3.2 specification, chapter 9. */
#ifndef VBOARD_USB_DESCRIPTORS_H
#define VBOARD_USB_DESCRIPTORS_H

#include <stdbool.h>
#include <stdint.h>

/* Interface 1, which only the virtual board has: plain bulk transfers, and the fault window. */
#define VBOARD_USB_PLAIN_SUBCLASS 0x46
#define VBOARD_USB_PLAIN_SINK 0x03
#define VBOARD_USB_PLAIN_SOURCE 0x83

#define VBOARD_USB_INTERFACES 2
#define VBOARD_USB_SERIAL_MAX 60      /* characters */
#define VBOARD_USB_DESCRIPTOR_MAX 256 /* bytes of any of them */

struct vboard_usb_endpoint {
	uint8_t address, interface;
	bool interrupt; /* or bulk */
	uint16_t packet_bytes;
	uint8_t interval;
};

#define VBOARD_USB_ENDPOINTS 5

/* All endpoints but the control endpoint. */
void vboard_usb_endpoints(struct vboard_usb_endpoint endpoints[VBOARD_USB_ENDPOINTS], bool super);

/*
 * The descriptor that a GET_DESCRIPTOR with @value asks for, into @bytes of
 * VBOARD_USB_DESCRIPTOR_MAX. Its length; -1: there is none.
 */
int vboard_usb_descriptor(uint8_t *bytes, uint16_t value, bool super, const char *serial);

/* bcdDevice */
#define VBOARD_USB_DEVICE_VERSION 0x0100

#endif
