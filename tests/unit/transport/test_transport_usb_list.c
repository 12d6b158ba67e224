/* SPDX-License-Identifier: MIT */
/* The list of the boards on USB. */
#include "list_test.h"
#include "usb_open_test.h"

static void every_board_is_listed_with_what_it_is_or_why_not(void **state)
{
	struct listed listed = { .kind = "usb:" };
	char *second;

	(void)state;
	plug_boards(3);
	fake_usb.board[0].speed = LIBUSB_SPEED_SUPER;
	fake_usb.board[1].open_error = LIBUSB_ERROR_ACCESS;
	fake_usb.board[2].foreign = true;
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	assert_int_equal(listed.count, 3);
	assert_int_equal(strncmp(listed.text, "usb:1209:0001/A|Gloss USB board /dev/bus/usb/001/",
				 49),
			 0);
	assert_non_null(strstr(listed.text, ", super speed\n"));
	second = strchr(listed.text, '\n') + 1;
	assert_int_equal(strncmp(second, "usb:1209:0001|not permitted: /dev/bus/usb/001/", 45), 0);
	assert_non_null(strstr(second, "usb:1209:0001/C|Gloss USB board"));
	assert_non_null(strstr(second, ", high speed\n"));
}

static void boards_of_one_number_are_listed_by_their_ports(void **state)
{
	struct listed listed = { .kind = "usb:" };

	(void)state;
	plug_boards(3);
	fake_usb.board[0].serial = fake_usb.board[2].serial = "SAME";
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	assert_int_equal(listed.count, 3);
	assert_int_equal(strncmp(listed.text, "usb:1-1|Gloss USB board", 23), 0);
	assert_non_null(strstr(listed.text, "\nusb:1209:0001/B|Gloss USB board"));
	assert_non_null(strstr(listed.text, "\nusb:1-3|Gloss USB board"));
	assert_non_null(strstr(listed.text, ", port 1-2, high speed"));
}

static void a_list_of_no_board_is_empty(void **state)
{
	struct listed listed = { .kind = "usb:" };

	(void)state;
	fake_usb_unplug(0);
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	fake_usb_fail("libusb_init", 1, LIBUSB_ERROR_OTHER);
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	fake_usb_fail("libusb_get_device_list", 1, LIBUSB_ERROR_IO);
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	assert_int_equal(listed.count, 0);
	fake_usb_fail("libusb_init", 1, LIBUSB_ERROR_NO_MEM);
	assert_int_equal(accel_device_list(list_take, &listed), -ENOMEM);
	fake_usb_fail("libusb_get_device_list", 1, LIBUSB_ERROR_NO_MEM);
	assert_int_equal(accel_device_list(list_take, &listed), -ENOMEM);
}

/* No serial number writes to a terminal but letters, and it is still a name. */
static void a_name_that_is_no_text_is_made_one(void **state)
{
	struct listed listed = { .kind = "usb:" };

	(void)state;
	fake_usb.board[0].serial = "\033[2J\nA";
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	assert_non_null(strstr(listed.text, "usb:1209:0001/?[2J?A|"));
	assert_opens("usb:/?[2J?A", BOARD("?[2J?A"));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		open_test(every_board_is_listed_with_what_it_is_or_why_not),
		open_test(boards_of_one_number_are_listed_by_their_ports),
		open_test(a_list_of_no_board_is_empty),
		open_test(a_name_that_is_no_text_is_made_one),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
