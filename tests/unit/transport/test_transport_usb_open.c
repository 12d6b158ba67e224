/* SPDX-License-Identifier: MIT */
/* Which board on USB is opened, and what is said if none is. */
#include "usb_open_test.h"

/* ---- boards that open ---- */

static void the_board_says_what_it_is(void **state)
{
	struct accel_device_info info;
	struct accel_device *device;

	(void)state;
	assert_int_equal(open_name("usb:", &device), 0);
	accel_device_info(device, &info, sizeof(info));
	assert_string_equal(info.name, BOARD("VIRTUAL0"));
	assert_int_equal(info.tile_size, 64);
	assert_int_equal(info.pixels_per_clock, 1);
	assert_int_equal(info.memory_size, FAKE_USB_BOARD_BYTES);
	accel_device_free(device);
}

static void a_serial_number_that_does_not_fit_is_left_out(void **state)
{
	static char serial[] = "0123456789012345678901234567890123456789";

	(void)state;
	fake_usb.board[0].serial = serial;
	assert_opens("usb:", "Gloss USB board, 64-pixel tiles, 1 lanes");
	assert_opens("usb:/0123456789012345678901234567890123456789",
		     "Gloss USB board, 64-pixel tiles, 1 lanes");
	fake_usb.board[0].serial = NULL;
	assert_opens("usb:", "Gloss USB board, 64-pixel tiles, 1 lanes");
	assert_refused("usb:/0", -ENODEV, "there is no board usb:1209:0001/0");
}

static void a_board_opens_by_every_name(void **state)
{
	static const char *const names[] = {
		"usb",        "usb:",          "usb:1209:0001",
		"usb:1209:1", "usb:/VIRTUAL0", "usb:1209:0001/VIRTUAL0",
	};

	(void)state;
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		assert_opens(names[i], BOARD("VIRTUAL0"));
}

static void a_board_with_other_ids_opens_by_them(void **state)
{
	(void)state;
	fake_usb.board[0].vendor = 0xabcd;
	fake_usb.board[0].product = 0xEF;
	assert_opens("usb:abcd:00ef", BOARD("VIRTUAL0"));
	assert_opens("usb:ABCD:EF/VIRTUAL0", BOARD("VIRTUAL0"));
	assert_refused("usb:", -ENODEV, "no Gloss board 1209:0001 on USB");
}

static void the_first_board_is_taken_and_each_by_its_number(void **state)
{
	(void)state;
	plug_boards(3);
	assert_opens("usb:", BOARD("A"));
	assert_opens("auto", BOARD("A"));
	assert_opens("usb:/A", BOARD("A"));
	assert_opens("usb:/B", BOARD("B"));
	assert_opens("usb:1209:0001/C", BOARD("C"));
}

/* Three with one serial number, as of a batch that nobody has given numbers. */
static void boards_of_one_number_are_told_apart_by_their_ports(void **state)
{
	struct accel_device *first, *second;

	(void)state;
	for (unsigned int n = 0; n < 3; n++) {
		fake_usb.board[n].serial = n < 2 ? "SAME" : NULL;
		fake_usb_plug(n, true);
	}
	assert_opens("usb:1-1", BOARD("SAME"));
	assert_opens("usb:1-2", BOARD("SAME"));
	assert_opens("usb:1-3", "Gloss USB board, 64-pixel tiles, 1 lanes");
	assert_int_equal(open_name("usb:1-2", &second), 0);
	assert_refused("usb:1-2", -EBUSY, "usb:1-2 is in use by another program");
	assert_int_equal(open_name("usb:1-1", &first), 0);
	accel_device_free(first);
	accel_device_free(second);
	fake_usb.board[1].vendor = 0xabcd;
	assert_opens("usb:1-2", BOARD("SAME"));
	assert_refused("usb:1-4", -ENODEV, "there is no Gloss board at usb:1-4; gloss-info --list");
	assert_refused("usb:2-1", -ENODEV, "there is no Gloss board at usb:2-1");
	assert_refused("usb:1-1.1", -ENODEV, "there is no Gloss board at usb:1-1.1");
}

static void of_two_boards_one_that_opens_is_taken(void **state)
{
	(void)state;
	plug_boards(2);
	fake_usb.board[0].foreign = true;
	assert_opens("usb:", BOARD("B"));
	fake_usb.board[0].foreign = false;
	fake_usb.board[0].open_error = LIBUSB_ERROR_ACCESS;
	assert_opens("usb:", BOARD("B"));
	assert_opens("usb:/B", BOARD("B"));
	fake_usb.board[1].foreign = true;
	assert_refused("usb:", -EACCES, "not permitted: /dev/bus/usb/001/");
	assert_refused("usb:/B", -EACCES, "not permitted: /dev/bus/usb/001/");
}

static void two_boards_work_at_once(void **state)
{
	struct accel_device *first, *second;

	(void)state;
	plug_boards(2);
	assert_int_equal(open_name("usb:", &first), 0);
	assert_int_equal(open_name("usb:", &second), 0);
	assert_refused("usb:", -EBUSY, "usb:1209:0001/A is in use by another program");
	accel_device_free(first);
	accel_device_free(second);
}

/* ---- boards that do not ---- */

static void what_is_no_name_is_refused(void **state)
{
	static const char *const names[] = {
		"usb:1209",        "usb:1209:",   "usb::0001",      "usb:/",
		"usb:1209:0001/",  "usb:12090:1", "usb:1209:00001", "usb:0x1209:1",
		"usb:1209:0001:1", "usb:1209/A",  "usb:tile=32",    "usb: ",
		"usb:1209:0001 ",  "usb:1-",      "usb:-1",         "usb:1-2.",
		"usb:1-2 ",        "usb:1-2.3-4", "usb:1-a",        "usb:1209:0001@1-2",
	};

	(void)state;
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		assert_refused(names[i], -EINVAL, "name a board as in usb:1209:0001/SERIAL");
	assert_int_equal(fake_usb.calls, 0);
}

static void no_board_is_said_with_what_to_do(void **state)
{
	(void)state;
	assert_refused("usb:/OTHER", -ENODEV,
		       "there is no board usb:1209:0001/OTHER; gloss-info "
		       "--list shows those that are there");
	fake_usb_unplug(0);
	assert_refused("usb:", -ENODEV,
		       "no Gloss board 1209:0001 on USB; lsusb shows what is plugged in");
	assert_refused("usb:1234:5678", -ENODEV, "no Gloss board 1234:5678 on USB");
}

static void a_board_that_is_not_permitted_names_the_rule(void **state)
{
	(void)state;
	fake_usb.board[0].open_error = LIBUSB_ERROR_ACCESS;
	assert_refused("usb:", -EACCES, "not permitted: /dev/bus/usb/001/");
	assert_message(&messages, "60-gloss.rules");
	assert_refused("usb:/VIRTUAL0", -EACCES, "60-gloss.rules");
}

static void a_board_in_use_is_named(void **state)
{
	(void)state;
	fake_usb.board[0].foreign = true;
	assert_refused("usb:", -EBUSY, "usb:1209:0001/VIRTUAL0 is in use by another program");
	assert_refused("usb:/VIRTUAL0", -EBUSY, "usb:1209:0001/VIRTUAL0 is in use");
	fake_usb.board[0].foreign = false;
	assert_opens("usb:", BOARD("VIRTUAL0"));
}

static void a_driver_of_the_kernel_is_not_taken_for_a_program(void **state)
{
	(void)state;
	fake_usb.board[0].kernel_driver = true;
	assert_refused("usb:", -EBUSY, "usb:1209:0001/VIRTUAL0 is held by a driver of the kernel");
	assert_message(&messages, "/sys/bus/usb/devices/1-1:*/driver");
	assert_refused("usb:1-1", -EBUSY, "usb:1-1 is held by a driver of the kernel");
	fake_usb.board[0].kernel_driver = false;
	assert_opens("usb:", BOARD("VIRTUAL0"));
}

/* With the ids of pid.codes for tests there is much else. */
static void another_device_with_the_same_ids_is_let_alone(void **state)
{
	const struct fake_usb_board good = fake_usb.board[0];
	struct fake_usb_board *board = &fake_usb.board[0];

	(void)state;
	for (unsigned int n = 0; n < 9; n++) {
		*board = good;
		board->open_error = LIBUSB_ERROR_OTHER; /* it is not even opened */
		switch (n) {
		case 0:
			board->interface_class = 3;
			break;
		case 1:
			board->interface_subclass++;
			break;
		case 2:
			board->interface_protocol++;
			break;
		case 3:
			board->interfaces = 0;
			break;
		case 4:
			board->endpoints = 2;
			break;
		case 5:
			board->endpoint[0].address = 2;
			break;
		case 6:
			board->endpoint[1].attributes = LIBUSB_TRANSFER_TYPE_INTERRUPT;
			break;
		case 7:
			board->endpoint[2].attributes = LIBUSB_TRANSFER_TYPE_BULK;
			break;
		default:
			board->vendor++;
			break;
		}
		assert_refused("usb:", -ENODEV, "no Gloss board 1209:0001 on USB");
	}
	*board = good;
	assert_opens("usb:", BOARD("VIRTUAL0"));
}

/* ---- auto ---- */

static void auto_takes_the_model_without_a_board_and_says_nothing(void **state)
{
	struct accel_device_info info;
	struct accel_device *device;

	(void)state;
	fake_usb_unplug(0);
	assert_int_equal(open_name("auto", &device), 0);
	accel_device_info(device, &info, sizeof(info));
	assert_non_null(strstr(info.name, "model"));
	assert_int_equal(messages.count, 0);
	accel_device_free(device);
}

static void auto_says_why_a_board_that_is_there_is_not_taken(void **state)
{
	struct accel_device *device;

	(void)state;
	fake_usb.board[0].foreign = true;
	assert_int_equal(open_name("auto", &device), 0);
	assert_message(&messages, "device \"usb:\": usb:1209:0001/VIRTUAL0 is in use");
	assert_int_equal(messages.count, 1);
	accel_device_free(device);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		open_test(the_board_says_what_it_is),
		open_test(a_serial_number_that_does_not_fit_is_left_out),
		open_test(a_board_opens_by_every_name),
		open_test(a_board_with_other_ids_opens_by_them),
		open_test(the_first_board_is_taken_and_each_by_its_number),
		open_test(boards_of_one_number_are_told_apart_by_their_ports),
		open_test(of_two_boards_one_that_opens_is_taken),
		open_test(two_boards_work_at_once),
		open_test(what_is_no_name_is_refused),
		open_test(no_board_is_said_with_what_to_do),
		open_test(a_board_that_is_not_permitted_names_the_rule),
		open_test(a_board_in_use_is_named),
		open_test(a_driver_of_the_kernel_is_not_taken_for_a_program),
		open_test(another_device_with_the_same_ids_is_let_alone),
		open_test(auto_takes_the_model_without_a_board_and_says_nothing),
		open_test(auto_says_why_a_board_that_is_there_is_not_taken),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
