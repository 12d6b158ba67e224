/* SPDX-License-Identifier: MIT */
/* Errors of devices and of their list. */
#include "errors.h"

static int open_name(const char *name)
{
	struct accel_device *another;
	int err = accel_device_new(name, messages_take, &test.messages, &another);

	if (!err)
		accel_device_free(another);
	return err;
}

static int open_no_board(void)
{
	return open_name("usb:/NONE");
}

static int open_without_its_support(void)
{
	setenv("GLOSS_SIM_PATH", "/nonexistent", 1);
	return open_name("sim:tile=32,lanes=2");
}

static int open_without_permission(void)
{
	fake_usb.board[0].open_error = LIBUSB_ERROR_ACCESS;
	return open_name("usb:");
}

static int open_twice(void)
{
	return open_name("usb:");
}

static int open_no_name(void)
{
	return open_name("model:tile=33");
}

static int open_without_memory(void)
{
	fake_usb_fail("libusb_init", 1, LIBUSB_ERROR_NO_MEM);
	return open_name("usb:");
}

static void found(void *data, const char *name, const char *line)
{
	(void)data;
	(void)name;
	(void)line;
}

static int list_without_memory(void)
{
	fake_usb_fail("libusb_init", 1, LIBUSB_ERROR_NO_MEM);
	return accel_device_list(found, NULL);
}

static int clocks(void)
{
	struct accel_device_clocks sum;

	return accel_device_clocks(test.device, &sum, sizeof(sum));
}

static int clocks_of_a_model(void)
{
	assert_int_equal(accel_stream_finish(test.stream, NULL, 0), 0);
	return clocks();
}

static int clocks_of_a_board_that_does_not_answer(void)
{
	fake_usb_fail("libusb_control_transfer", 1, LIBUSB_ERROR_PIPE);
	return clocks();
}

static int clocks_of_no_board(void)
{
	unplug();
	return clocks();
}

const struct reached errors_device[] = {
	{ "accel_device_list", -ENOMEM, list_without_memory },
	{ "accel_device_new", -ENODEV, open_no_board },
	{ "accel_device_new", -ENOSYS, open_without_its_support },
	{ "accel_device_new", -EACCES, open_without_permission },
	{ "accel_device_new", -EBUSY, open_twice },
	{ "accel_device_new", -EINVAL, open_no_name },
	{ "accel_device_new", -ENOMEM, open_without_memory },
	{ "accel_device_clocks", -ENOTSUP, clocks_of_a_model },
	{ "accel_device_clocks", -EIO, clocks_of_a_board_that_does_not_answer },
	{ "accel_device_clocks", -ENODEV, clocks_of_no_board },
	{ .function = NULL },
};
