/* SPDX-License-Identifier: MIT */
/*
 * Interface 1 of a virtual USB board: a sink and a source of bytes beside the port, for what the
 * bus alone can do. The functions end the program where they fail.
 */
#ifndef USB_PLAIN_H
#define USB_PLAIN_H

#include <stddef.h>
#include <stdint.h>

#define USB_PLAIN_SINK 0x03
#define USB_PLAIN_SOURCE 0x83

struct usb_plain;

/* @board as accel_device_new takes it, "usb:VID:PID/SERIAL". */
struct usb_plain *usb_plain_open(const char *board);
void usb_plain_close(struct usb_plain *plain);

/* Moves @bytes to the sink or from the source, in transfers of 64 KiB, four of them in flight;
 * returns how many seconds that took. */
double usb_plain_move(struct usb_plain *plain, uint8_t endpoint, size_t bytes);

#endif
