/* SPDX-License-Identifier: MIT */
/*
 * Each call of libusb answers each error that there is, once, at each place where a program's
 * life has it: opening, memory, jobs, closing. The program is told, or helped; then it lives again.
 */
#include "accel_test.h"
#include "fake_usb.h"

#define CALLS_MAX 40 /* of one function: those after it are the same */
#define WORDS 3000

/* 0: with the right bytes. */
static int live_with_buffer(struct accel_buffer *buffer)
{
	uint32_t words[WORDS], back[WORDS];
	uint64_t seed = 1;
	int err;

	for (int n = 0; n < WORDS; n++)
		words[n] = (uint32_t)test_random(&seed);
	err = accel_buffer_read(buffer, 0, back, sizeof(back));
	for (int n = 0; n < WORDS && !err; n++)
		assert_int_equal(back[n], 0);
	if (!err)
		err = accel_buffer_write(buffer, 0, words, sizeof(words));
	if (!err)
		err = accel_buffer_read(buffer, 0, back, sizeof(back));
	if (!err)
		assert_memory_equal(back, words, sizeof(words));
	return err;
}

static int live(void)
{
	struct accel_device *device;
	struct accel_buffer *buffer;
	struct messages messages = { "", 0 };
	int err = accel_device_new("usb:", messages_take, &messages, &device);

	if (err) {
		assert_true(messages.count > 0 || err == -ENOMEM);
		return err;
	}
	err = accel_buffer_new(device, 4 * WORDS, &buffer);
	if (!err) {
		err = live_with_buffer(buffer);
		accel_buffer_free(buffer);
	}
	accel_device_free(device);
	return err;
}

static bool is_clean(int err)
{
	return !err || err == -EIO || err == -ENODEV || err == -ENOMEM || err == -EACCES ||
	       err == -EBUSY;
}

/* False: it has no such call. */
static bool fail_call(const char *function, unsigned int at, int error, uint64_t seed)
{
	bool came;
	int err;

	fake_usb_start(seed);
	fake_usb_fail(function, at, error);
	err = live();
	came = fake_usb_fired();
	if (!is_clean(err) || (err && !came))
		fail_msg("call %u of %s: %s: %s", at, function, libusb_error_name(error),
			 strerror(-err));
	fake_usb_disarm();
	err = live();
	if (err)
		fail_msg("after call %u of %s: %s: %s", at, function, libusb_error_name(error),
			 strerror(-err));
	fake_usb_stop();
	return came;
}

static void every_error_of_every_call_is_told_or_helped(void **state)
{
	static const char *const functions[] = {
		"libusb_init",
		"libusb_set_option",
		"libusb_get_device_list",
		"libusb_get_device_descriptor",
		"libusb_get_active_config_descriptor",
		"libusb_open",
		"libusb_get_string_descriptor_ascii",
		"libusb_set_auto_detach_kernel_driver",
		"libusb_get_configuration",
		"libusb_claim_interface",
		"libusb_release_interface",
		"libusb_control_transfer",
		"libusb_bulk_transfer",
		"libusb_interrupt_transfer",
		"libusb_alloc_transfer",
		"libusb_submit_transfer",
		"libusb_cancel_transfer",
		"libusb_clear_halt",
		"libusb_reset_device",
		"libusb_handle_events",
		"libusb_hotplug_register_callback",
	};
	uint64_t seed = test_seed();
	unsigned int lives = 0;

	(void)state;
	for (size_t n = 0; n < sizeof(functions) / sizeof(functions[0]); n++)
		for (int error = LIBUSB_ERROR_IO; error >= LIBUSB_ERROR_NOT_SUPPORTED; error--)
			for (unsigned int at = 1; at <= CALLS_MAX; at++, lives++)
				if (!fail_call(functions[n], at, error, test_random(&seed)))
					break;
	print_message("%u lives\n", lives);
	assert_true(lives > 300);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_error_of_every_call_is_told_or_helped),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
