/* SPDX-License-Identifier: MIT */
/*
 * What a hostile board does, as bytes: a head that any bytes are right for, then what it says
 * instead of what an honest one would. Each piece of that begins with a byte:
 *
 *   00 to 7f   4 times as many honest words and one more
 *   80 to 9f   that many, and one more, words that follow, little-endian
 *   a0 to af   the next honest word, xor the word that follows
 *   b0 to bf   honest words are dropped, 1 to 16
 *   c0 to cf   a chunk of a response, its count in two bytes, its words made up
 *   d0 to df   a completion: cause and sequence in a byte each, offset and response words in two
 *   e0 to ef   the usb_sync that the host waits for
 *   f0 to ff   the burst ends
 *
 * Whatever the words are, the checksum of a completion is that of the answer it ends, as nobody
 * would guess it, unless FUZZ_USB_CHECKSUMS is set. With FUZZ_USB_REGISTERS a read register takes
 * a byte, and from e0 on its value.
 */
#ifndef FUZZ_USB_INPUT_H
#define FUZZ_USB_INPUT_H

#include <stdint.h>

#define FUZZ_USB_FAULTS 3

/* Of flags. */
#define FUZZ_USB_SUPER 0x01u
#define FUZZ_USB_SMALL 0x02u       /* tiles of 32 pixels */
#define FUZZ_USB_DESCRIPTORS 0x04u /* those below are used */
#define FUZZ_USB_REGISTERS 0x08u
#define FUZZ_USB_AFTER 0x30u /* what comes when the bytes have ended */
#define FUZZ_USB_AFTER_SILENCE 0x10u
#define FUZZ_USB_AFTER_ENDLESS 0x20u /* made-up words; anything else: honest ones */
#define FUZZ_USB_CHECKSUMS 0x40u     /* they are as the words say, and mostly wrong */

struct fuzz_usb_head {
	uint8_t flags;
	uint8_t jobs, response; /* how many of them, and pages they ask for */
	/* Of the descriptors; all but the counts xor what is right. */
	uint8_t interface_class, interface_subclass, interface_protocol;
	uint8_t interfaces, endpoints;
	uint8_t endpoint[3][2];            /* address and attributes */
	uint8_t texts;                     /* bits 1:0: serial number, 3:2: product */
	uint8_t fault[FUZZ_USB_FAULTS][3]; /* kind, at, root of a 16th of the value */
	uint8_t call, error;               /* this call fails; 0: none */
};

#endif
