/* SPDX-License-Identifier: MIT */
/*
 * Each error that accel.h promises, and a call that answers it: a row of the tables in errors_*.c,
 * which test_errors.c goes through, and test_errors.sh compares with the comments of accel.h.
 */
#ifndef ERRORS_H
#define ERRORS_H

#include "accel_test.h"
#include "fake_usb.h"

struct reached {
	const char *function; /* NULL: the end of a table */
	int err;
	int (*call)(void);
};

extern const struct reached errors_device[], errors_memory[], errors_draw[], errors_stream[];

/* As new for each row, on a board of its own; its memory was used before. */
struct fixture {
	struct messages messages;
	struct accel_device *device;
	struct accel_buffer *buffer; /* of 4096 bytes */
	struct accel_target *target; /* of 64 by 64 pixels */
	struct accel_state *state;
	struct accel_draw *draw;
	struct accel_stream *stream;
	uint32_t pixels[64 * 64];
};

extern struct fixture test;

/* ---- what goes wrong ---- */

/* The next job. */
static inline void fail_board(void)
{
	fake_usb_arm(0, FAKE_USB_STALL_OUT, 1, 0);
}

static inline void unplug(void)
{
	fake_usb_unplug(0);
}

static inline void refuse_memory(void)
{
	fake_usb_limit_memory(1);
}

#endif
