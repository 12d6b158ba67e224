/* SPDX-License-Identifier: MIT */
/* What the tests of opening boards on USB share: names that open a board, or say why they do not. */
#ifndef USB_OPEN_TEST_H
#define USB_OPEN_TEST_H

#include "accel_test.h"
#include "fake_usb.h"

#define BOARD(serial) "Gloss USB board " serial ", 64-pixel tiles, 1 lanes"

static struct messages messages;

static inline int open_setup(void **state)
{
	(void)state;
	messages = (struct messages){ "", 0 };
	fake_usb_start(1);
	return 0;
}

static inline int open_teardown(void **state)
{
	(void)state;
	fake_usb_stop();
	return 0;
}

static inline int open_name(const char *name, struct accel_device **device)
{
	*device = NULL;
	return accel_device_new(name, messages_take, &messages, device);
}

static inline void assert_refused(const char *name, int answer, const char *message)
{
	struct accel_device *device;

	assert_int_equal(open_name(name, &device), answer);
	assert_null(device);
	assert_message(&messages, message);
	assert_true(strlen(messages.last) < 300);
}

/* And says nothing. */
static inline void assert_opens(const char *name, const char *what)
{
	struct accel_device_info info;
	struct accel_device *device;

	messages.count = 0;
	if (open_name(name, &device))
		fail_msg("%s does not open: %s", name, messages.last);
	accel_device_info(device, &info, sizeof(info));
	assert_string_equal(info.name, what);
	assert_int_equal(messages.count, 0);
	accel_device_free(device);
}

/* The boards have the serial numbers A, B and C. */
static inline void plug_boards(unsigned int count)
{
	static const char *const serials[] = { "A", "B", "C" };

	for (unsigned int n = 0; n < count; n++) {
		fake_usb.board[n].serial = serials[n];
		fake_usb_plug(n, true);
	}
}

#define open_test(name) cmocka_unit_test_setup_teardown(name, open_setup, open_teardown)

#endif
