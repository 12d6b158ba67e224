/* SPDX-License-Identifier: MIT */
/* What is said of a board on USB that says what no board does, and of errors of libusb. */
#include "usb_open_test.h"

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

int main(void)
{
	const struct CMUnitTest tests[] = {
		open_test(a_board_that_is_none_is_refused),
		open_test(errors_of_libusb_are_told),
		open_test(a_serial_number_that_can_not_be_read_is_done_without),
		open_test(an_error_that_passes_does_not_matter),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
