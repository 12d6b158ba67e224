/* SPDX-License-Identifier: MIT */
/*
 * What can go wrong with a virtual USB board (tools/vboard/usb/faults.h), for tests in the virtual
 * machine: beside whoever has the board. The functions end the program where they fail.
 */
#ifndef USB_CABLE_H
#define USB_CABLE_H

#include <stdbool.h>
#include <stdint.h>

struct usb_cable;

/* @board as accel_device_new takes it, "usb:VID:PID/SERIAL". Waits until it is plugged in. */
struct usb_cable *usb_cable_open(const char *board);
void usb_cable_close(struct usb_cable *cable);

/* A register of the fault window. False: the board is not there any more. */
bool usb_cable_arm(struct usb_cable *cable, uint32_t offset, uint32_t value);
bool usb_cable_read(struct usb_cable *cable, uint32_t offset, uint32_t *value);
/* Nothing is armed any more. False: as above. */
bool usb_cable_disarm(struct usb_cable *cable);

#endif
