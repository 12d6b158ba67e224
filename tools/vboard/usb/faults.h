/* SPDX-License-Identifier: MIT */
/*
 * What can go wrong with a USB board and its cable, on demand: the bridge asks here what is to
 * happen to a transfer. Armed on the command line or, while the host runs, in the fault window:
 * the register requests of interface 1.
 *
 * A fault with a count happens once, at the n-th from now, 1 being the next; 0: not.
 */
#ifndef VBOARD_USB_FAULTS_H
#define VBOARD_USB_FAULTS_H

#include <stdbool.h>
#include <stdint.h>

/* Registers of the fault window, 32 bits each. */
#define VBOARD_USB_FAULT_IDENTITY 0x00 /* ro: VBOARD_USB_FAULT_IDENTITY_VALUE */
/* The cable is pulled when the n-th transfer of the port comes; 0xffffffff: now. */
#define VBOARD_USB_FAULT_UNPLUG 0x04
#define VBOARD_USB_FAULT_REPLUG 0x08 /* it is back so many ms later; 0: never */
/*
 * The n-th transfer of the port is stalled, and the endpoint halts until the host clears that.
 * Transfers count when it is their turn: OUT when it begins, IN when it would end.
 */
#define VBOARD_USB_FAULT_STALL_OUT 0x0c
#define VBOARD_USB_FAULT_STALL_IN 0x10
#define VBOARD_USB_FAULT_SHORT_IN 0x14 /* the n-th IN transfer ends after half its words */
#define VBOARD_USB_FAULT_EMPTY_IN 0x18 /* so many empty transfers before the next words */
#define VBOARD_USB_FAULT_DELAY 0x1c    /* each completion leaves so many us later */
/* The n-th IN word and the 15 after it are noise, but none after CONTROL.reset. */
#define VBOARD_USB_FAULT_GARBAGE 0x20
/* The n-th completion does not leave, nor what is behind it, until CONTROL.reset; 0 ends it too. */
#define VBOARD_USB_FAULT_HANG 0x24
#define VBOARD_USB_FAULT_LOSE_OUT 0x28       /* the n-th OUT transfer ends well and is dropped */
#define VBOARD_USB_FAULT_EXIT 0x2c           /* the program ends at the n-th transfer */
#define VBOARD_USB_FAULT_JOBS 0x30           /* ro: completions that left */
#define VBOARD_USB_FAULT_REFUSE_CONTROL 0x34 /* the n-th register request is stalled */

#define VBOARD_USB_FAULT_IDENTITY_VALUE 0x42534655
#define VBOARD_USB_FAULT_UNPLUG_NOW 0xffffffff

/* Values of the window's registers that can be armed; all zero: nothing is. */
struct vboard_usb_faults_armed {
	uint32_t unplug, replug, stall_out, stall_in, short_in, empty_in, delay, garbage, hang;
	uint32_t lose_out, exit, refuse_control;
};

enum vboard_usb_fault {
	VBOARD_USB_FAULT_NONE,
	VBOARD_USB_STALL,
	VBOARD_USB_LOSE,
	VBOARD_USB_SHORT,
	VBOARD_USB_EMPTY,
};

struct vboard_usb_faults {
	struct vboard_usb_faults_armed armed;
	uint32_t jobs;

	uint32_t left; /* words of IN up to the next message */
	bool hung;
	uint64_t due;   /* when the completion that is late leaves; 0: none is */
	uint32_t noise; /* words yet to come */
	uint32_t random;
};

void vboard_usb_faults_init(struct vboard_usb_faults *faults,
			    const struct vboard_usb_faults_armed *armed);

/* A transfer of the port comes: is the cable pulled, does the program end? */
bool vboard_usb_faults_unplug(struct vboard_usb_faults *faults);
bool vboard_usb_faults_exit(struct vboard_usb_faults *faults);
/* What happens to the OUT transfer that begins. */
enum vboard_usb_fault vboard_usb_faults_out(struct vboard_usb_faults *faults);
/* What happens to the IN transfer that is about to end with @words words. */
enum vboard_usb_fault vboard_usb_faults_in(struct vboard_usb_faults *faults, uint32_t words);
/* A register request of the port comes; true: it is stalled. */
bool vboard_usb_faults_refuse(struct vboard_usb_faults *faults);

/*
 * The next @count words of IN, which may become noise. How many of them may leave now: the
 * others, and all that comes, only when they are no longer held.
 */
uint32_t vboard_usb_faults_words(struct vboard_usb_faults *faults, uint32_t *words, uint32_t count);
bool vboard_usb_faults_hold(struct vboard_usb_faults *faults);
/* When that may change, in ns of CLOCK_MONOTONIC; UINT64_MAX: it does not by itself. */
uint64_t vboard_usb_faults_due(const struct vboard_usb_faults *faults);

/* CONTROL.reset: the port drops its words, held ones too; what is armed stays. */
void vboard_usb_faults_reset(struct vboard_usb_faults *faults);

/* The fault window. */
uint32_t vboard_usb_faults_window_read(const struct vboard_usb_faults *faults, uint32_t offset);
void vboard_usb_faults_window_write(struct vboard_usb_faults *faults, uint32_t offset,
				    uint32_t value);

#endif
