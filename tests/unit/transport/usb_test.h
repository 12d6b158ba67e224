/* SPDX-License-Identifier: MIT */
/* What the tests of "usb:" share: a board on the cable of fake_usb.h, and jobs on it. */
#ifndef USB_TEST_H
#define USB_TEST_H

#include "fake_usb.h"
#include "transport_test.h"

static const struct accel_transport_ops *const ops = &accel_transport_usb;

static inline void board_hold(void)
{
	fake_usb_hold();
}

static inline void board_release(void)
{
	fake_usb_release();
}

static inline int usb_setup(void **state)
{
	struct accel_transport_error error = { "" };

	fake_usb_start(test_seed());
	return ops->open("", state, &error);
}

/* What the library leaves behind ends the process there. */
static inline int usb_teardown(void **state)
{
	fake_usb_release();
	ops->close(*state);
	fake_usb_stop();
	return 0;
}

#define usb_test(name) cmocka_unit_test_setup_teardown(name, usb_setup, usb_teardown)

/* The error of a job that reads @count words of an object, in slot 0. */
static inline int read_words(void *state, uint64_t object, uint32_t *words, uint32_t count)
{
	const struct accel_transport_slot slot = { object, GLOSS_RIGHTS_READ };
	uint32_t stream[3];
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = (uint32_t)packet_read(stream, 0, 0, count),
		.response = words,
		.response_words = count,
		.slot = &slot,
		.slots = 1,
	};
	struct gloss_status status;
	int err = wait_for(state, submit(state, &job), &status);

	assert_int_equal(status.response_words, err ? 0 : count);
	return err;
}

#endif
