/* SPDX-License-Identifier: MIT */
/* Which board on USB is opened, and what is said if none is. */
#include "accel_test.h"
#include "fake_usb.h"

static struct messages messages;

static int setup(void **state)
{
	(void)state;
	messages = (struct messages){ "", 0 };
	fake_usb_start(1);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	fake_usb_stop();
	return 0;
}

static int open_name(const char *name, struct accel_device **device)
{
	*device = NULL;
	return accel_device_new(name, messages_take, &messages, device);
}

static void assert_refused(const char *name, int answer, const char *message)
{
	struct accel_device *device;

	assert_int_equal(open_name(name, &device), answer);
	assert_null(device);
	assert_message(&messages, message);
	assert_true(strlen(messages.last) < 300);
}

/* And says nothing. */
static void assert_opens(const char *name, const char *what)
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
static void plug_boards(unsigned int count)
{
	static const char *const serials[] = { "A", "B", "C" };

	for (unsigned int n = 0; n < count; n++) {
		fake_usb.board[n].serial = serials[n];
		fake_usb_plug(n, true);
	}
}

#define BOARD(serial) "Gloss USB board " serial ", 64-pixel tiles, 1 lanes"

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

/* ---- boards that say what no board does ---- */

static struct {
	uint32_t offset, value;
} lie;

static uint32_t lie_read(struct gloss_usb_board *board, uint32_t offset)
{
	return offset == lie.offset ? lie.value : gloss_usb_board_model_t64.read(board, offset);
}

static void plug_liar(void)
{
	static struct gloss_usb_board_ops liar;

	liar = gloss_usb_board_model_t64;
	liar.read = lie_read;
	fake_usb_unplug(0);
	fake_usb.board[0].ops = &liar;
	fake_usb_plug(0, true);
}

static void a_board_that_is_none_is_refused(void **state)
{
	static const struct {
		uint32_t offset, value;
		const char *message;
	} lies[] = {
		{ GLOSS_REG_IDENTITY, 0, "is no Gloss board: its IDENTITY is 0x00000000" },
		{ GLOSS_REG_IDENTITY, 0xffffffff, "its IDENTITY is 0xffffffff" },
		{ GLOSS_REG_VERSION, GLOSS_VERSION + 1, "speaks version 2 of the stream, not 1" },
		{ GLOSS_REG_CAPABILITIES, 0x0100, "0-pixel tiles, 1 lanes" },
		{ GLOSS_REG_CAPABILITIES, 0x0130, "48-pixel tiles, 1 lanes" },
		{ GLOSS_REG_CAPABILITIES, 0x0040, "64-pixel tiles, 0 lanes" },
		{ GLOSS_REG_CAPABILITIES, 0x0340, "64-pixel tiles, 3 lanes" },
		{ GLOSS_REG_CAPABILITIES, 0x1040, "64-pixel tiles, 16 lanes" },
		{ GLOSS_REG_MEMORY_PAGES, 0, "64-pixel tiles, 1 lanes, 0 pages" },
		{ GLOSS_REG_MEMORY_PAGES, (1 << 20) + 1, "1048577 pages" },
		{ GLOSS_REG_CONTROL, 2, "does not answer as a Gloss board does" },
	};

	(void)state;
	for (size_t i = 0; i < sizeof(lies) / sizeof(lies[0]); i++) {
		lie.offset = lies[i].offset;
		lie.value = lies[i].value;
		plug_liar();
		assert_refused("usb:", -ENODEV, lies[i].message);
		assert_message(&messages, "usb:1209:0001/VIRTUAL0");
	}
}

/* ---- errors of libusb ---- */

static void errors_of_libusb_are_told(void **state)
{
	static const struct {
		const char *function;
		int error, answer;
		const char *message;
	} errors[] = {
		{ "libusb_init", LIBUSB_ERROR_NO_MEM, -ENOMEM, "Insufficient memory" },
		{ "libusb_init", LIBUSB_ERROR_OTHER, -ENODEV, "USB can not be used here: Other" },
		{ "libusb_get_device_list", LIBUSB_ERROR_NO_MEM, -ENOMEM, "Insufficient memory" },
		{ "libusb_get_device_list", LIBUSB_ERROR_IO, -ENODEV,
		  "USB can not be looked at: Input" },
		{ "libusb_get_device_descriptor", LIBUSB_ERROR_IO, -ENODEV, "no Gloss board" },
		{ "libusb_get_active_config_descriptor", LIBUSB_ERROR_NOT_FOUND, -ENODEV,
		  "no Gloss board" },
		{ "libusb_open", LIBUSB_ERROR_NO_MEM, -ENOMEM,
		  "usb:1209:0001: Insufficient memory" },
		{ "libusb_open", LIBUSB_ERROR_ACCESS, -EACCES, "not permitted" },
		{ "libusb_open", LIBUSB_ERROR_NO_DEVICE, -ENODEV, "No such device" },
		{ "libusb_open", LIBUSB_ERROR_NOT_FOUND, -ENODEV, "Entity not found" },
		{ "libusb_claim_interface", LIBUSB_ERROR_BUSY, -EBUSY, "VIRTUAL0 is in use" },
		{ "libusb_claim_interface", LIBUSB_ERROR_NOT_FOUND, -ENODEV,
		  "usb:1209:0001/VIRTUAL0: Entity not found" },
		{ "libusb_claim_interface", LIBUSB_ERROR_NO_DEVICE, -ENODEV, "No such device" },
		{ "libusb_control_transfer", LIBUSB_ERROR_PIPE, -ENODEV, "does not answer" },
		{ "libusb_control_transfer", LIBUSB_ERROR_TIMEOUT, -ENODEV, "does not answer" },
		{ "libusb_control_transfer", LIBUSB_ERROR_NO_DEVICE, -ENODEV, "does not answer" },
		{ "libusb_alloc_transfer", LIBUSB_ERROR_NO_MEM, -ENOMEM, "usbfs_memory_mb" },
		{ "libusb_control_transfer", LIBUSB_ERROR_NO_MEM, -ENOMEM, "usbfs_memory_mb" },
		{ "libusb_submit_transfer", LIBUSB_ERROR_NO_DEVICE, -ENODEV, "VIRTUAL0 is gone" },
	};

	(void)state;
	for (size_t i = 0; i < sizeof(errors) / sizeof(errors[0]); i++) {
		fake_usb_fail(errors[i].function, 1, errors[i].error);
		assert_refused("usb:", errors[i].answer, errors[i].message);
		assert_int_equal(fake_usb.fired, i + 1);
	}
	assert_opens("usb:", BOARD("VIRTUAL0"));
}

/* It is only for people, unless it is what the board is known by. */
static void a_serial_number_that_can_not_be_read_is_done_without(void **state)
{
	(void)state;
	fake_usb_fail("libusb_get_string_descriptor_ascii", 1, LIBUSB_ERROR_PIPE);
	assert_opens("usb:", "Gloss USB board, 64-pixel tiles, 1 lanes");
	fake_usb_fail("libusb_get_string_descriptor_ascii", 1, LIBUSB_ERROR_PIPE);
	assert_refused("usb:/VIRTUAL0", -ENODEV, "usb:1209:0001: Pipe error");
}

static void an_error_that_passes_does_not_matter(void **state)
{
	static const char *const functions[] = {
		"libusb_submit_transfer",
		"libusb_handle_events",
		"libusb_cancel_transfer",
		"libusb_release_interface",
	};

	(void)state;
	for (size_t i = 0; i < sizeof(functions) / sizeof(functions[0]); i++) {
		fake_usb_fail(functions[i], 1, LIBUSB_ERROR_IO);
		assert_opens("usb:", BOARD("VIRTUAL0"));
	}
}

/* ---- the list ---- */

struct listed {
	char text[1024];
	int count;
};

static void list_take(void *data, const char *name, const char *line)
{
	struct listed *listed = data;
	size_t length = strlen(listed->text);

	if (strncmp(name, "usb:", 4) != 0)
		return;
	snprintf(listed->text + length, sizeof(listed->text) - length, "%s|%s\n", name, line);
	listed->count++;
}

static void every_board_is_listed_with_what_it_is_or_why_not(void **state)
{
	struct listed listed = { "", 0 };
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
	struct listed listed = { "", 0 };

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
	struct listed listed = { "", 0 };

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
	struct listed listed = { "", 0 };

	(void)state;
	fake_usb.board[0].serial = "\033[2J\nA";
	assert_int_equal(accel_device_list(list_take, &listed), 0);
	assert_non_null(strstr(listed.text, "usb:1209:0001/?[2J?A|"));
	assert_opens("usb:/?[2J?A", BOARD("?[2J?A"));
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

#define usb_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		usb_test(the_board_says_what_it_is),
		usb_test(a_serial_number_that_does_not_fit_is_left_out),
		usb_test(a_board_opens_by_every_name),
		usb_test(a_board_with_other_ids_opens_by_them),
		usb_test(the_first_board_is_taken_and_each_by_its_number),
		usb_test(boards_of_one_number_are_told_apart_by_their_ports),
		usb_test(of_two_boards_one_that_opens_is_taken),
		usb_test(two_boards_work_at_once),
		usb_test(what_is_no_name_is_refused),
		usb_test(no_board_is_said_with_what_to_do),
		usb_test(a_board_that_is_not_permitted_names_the_rule),
		usb_test(a_board_in_use_is_named),
		usb_test(a_driver_of_the_kernel_is_not_taken_for_a_program),
		usb_test(another_device_with_the_same_ids_is_let_alone),
		usb_test(a_board_that_is_none_is_refused),
		usb_test(errors_of_libusb_are_told),
		usb_test(a_serial_number_that_can_not_be_read_is_done_without),
		usb_test(an_error_that_passes_does_not_matter),
		usb_test(every_board_is_listed_with_what_it_is_or_why_not),
		usb_test(boards_of_one_number_are_listed_by_their_ports),
		usb_test(a_list_of_no_board_is_empty),
		usb_test(a_name_that_is_no_text_is_made_one),
		usb_test(auto_takes_the_model_without_a_board_and_says_nothing),
		usb_test(auto_says_why_a_board_that_is_there_is_not_taken),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
