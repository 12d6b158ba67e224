/* SPDX-License-Identifier: MIT */
/* What a kernel does to "usb:" that is not the board's fault: no memory for transfers, a claim that
 * is lost, a board that lost its power unseen, file descriptors that somebody has closed. */
#include <unistd.h>

#include "child_test.h"
#include "usb_test.h"

#define WORDS 60000u

static struct messages messages;
static uint32_t stream[3 + WORDS], back[WORDS];

static int setup(void **state)
{
	alarm(test_patience_s());
	fake_usb_start(test_seed());
	*state = device_open("usb:", &messages);
	return 0;
}

static int teardown(void **state)
{
	fake_usb_disarm();
	fake_usb_limit_memory(0);
	accel_device_free(*state);
	fake_usb_stop();
	alarm(0);
	return 0;
}

/* Writes much and reads it back; 0: it was right. */
static int copy(struct accel_device *device)
{
	struct accel_buffer *buffer;
	uint64_t seed = 1;
	int err = accel_buffer_new(device, sizeof(back), &buffer);

	if (err)
		return err;
	for (uint32_t i = 0; i < WORDS; i++)
		stream[i] = (uint32_t)test_random(&seed);
	err = accel_buffer_write(buffer, 0, stream, sizeof(back));
	if (!err)
		err = accel_buffer_read(buffer, 0, back, sizeof(back));
	if (!err)
		assert_memory_equal(back, stream, sizeof(back));
	accel_buffer_free(buffer);
	return err;
}

/* ---- memory for transfers ---- */

static void a_submit_that_is_refused_memory_once_fails_no_job(void **state)
{
	unsigned int resets = fake_usb.resets;

	for (unsigned int at = 1; at < 12; at++) {
		fake_usb_fail("libusb_submit_transfer", at, LIBUSB_ERROR_NO_MEM);
		assert_int_equal(copy(*state), 0);
		assert_int_equal(fake_usb.resets, resets);
	}
	assert_true(fake_usb.fired > 5);
}

static void a_board_works_with_little_memory(void **state)
{
	static const size_t limits[] = {
		4 << 20, 2 << 20, 1 << 20, (1 << 20) + 100, 600000, 300000,
		132000,  100000,  66000,   65536,           40000,  33000
	};

	for (size_t i = 0; i < sizeof(limits) / sizeof(limits[0]); i++) {
		accel_device_free(*state);
		fake_usb_limit_memory(limits[i]);
		*state = device_open("usb:", &messages);
		for (int n = 0; n < 3; n++)
			if (copy(*state))
				fail_msg("with %zu bytes: %s", limits[i], messages.last);
	}
	fake_usb_limit_memory(0);
}

static void memory_that_becomes_little_is_made_do_with(void **state)
{
	for (size_t limit = 3 << 20; limit > 100000; limit = limit * 3 / 4) {
		unsigned int resets = fake_usb.resets;

		fake_usb_limit_memory(limit);
		assert_int_equal(copy(*state), 0);
		assert_int_equal(fake_usb.resets, resets);
	}
}

static void without_memory_jobs_fail_and_the_board_stays(void **state)
{
	int err;

	for (int n = 0; n < 5; n++) {
		fake_usb_limit_memory(100);
		assert_int_equal(copy(*state), -ENOMEM);
		assert_message(&messages, "usbfs_memory_mb");
		assert_int_equal(copy(*state), -ENOMEM);
		fake_usb_limit_memory(0);
		/* Those that were there when it was tried the last time. */
		do
			err = copy(*state);
		while (err == -ENOMEM);
		assert_int_equal(err, 0);
	}
}

static void memory_that_comes_back_is_used_again(void **state)
{
	accel_device_free(*state);
	fake_usb_limit_memory(40000);
	*state = device_open("usb:", &messages);
	fake_usb_take_depth_in();
	assert_int_equal(copy(*state), 0);
	assert_in_range(fake_usb_take_depth_in(), 1, 2);
	fake_usb_limit_memory(0);
	for (int n = 0; n < 20; n++) {
		assert_int_equal(copy(*state), 0);
		fake_usb_rest(1000);
	}
	assert_int_equal(copy(*state), 0);
	assert_int_equal(fake_usb_take_depth_in(), 4);
}

static void a_board_does_not_open_without_memory_and_says_so(void **state)
{
	struct accel_device *device;

	accel_device_free(*state);
	for (size_t limit = 1; limit < 16384; limit *= 2) {
		fake_usb_limit_memory(limit);
		assert_int_equal(accel_device_new("usb:", messages_take, &messages, &device),
				 -ENOMEM);
		assert_message(&messages, "usbfs_memory_mb");
	}
	fake_usb_limit_memory(0);
	*state = device_open("usb:", &messages);
}

/* ---- power ---- */

static void a_board_that_lost_its_power_is_gone_with_what_it_held(void **state)
{
	struct accel_buffer *buffer, *more;
	uint32_t word = 7;

	assert_int_equal(accel_buffer_new(*state, 4096, &buffer), 0);
	assert_int_equal(accel_buffer_write(buffer, 0, &word, 4), 0);
	fake_usb_arm(0, FAKE_USB_GLITCH, 1, 0);
	assert_int_equal(copy(*state), -ENODEV);
	assert_message(&messages, "the board has lost its power");
	assert_int_equal(accel_buffer_read(buffer, 0, &word, 4), -ENODEV);
	assert_int_equal(accel_buffer_new(*state, 4096, &more), -ENODEV);
	assert_int_equal(word, 7);
	accel_buffer_free(buffer);
	accel_device_free(*state);
	*state = device_open("usb:", &messages);
	assert_int_equal(copy(*state), 0);
}

/* With a job before and after it that the board has answered. */
static void power_lost_while_the_board_starts_again_is_noticed_too(void **state)
{
	for (uint64_t at = 1; at < 12; at++) {
		fake_usb_arm(0, FAKE_USB_STALL_OUT, 1, 0);
		fake_usb_arm(0, FAKE_USB_GLITCH, at, 0);
		if (!copy(*state))
			continue;
		while (!copy(*state))
			;
		assert_int_equal(copy(*state), -ENODEV);
		assert_message(&messages, "the board has lost its power");
		fake_usb_disarm();
		accel_device_free(*state);
		*state = device_open("usb:", &messages);
	}
}

/* What resets the bus may come before the first job, which then meets a board that works. */
static void check_failed_at_most(struct accel_device *device)
{
	int err = copy(device);

	assert_true(!err || err == -EIO);
	if (err)
		assert_message(&messages, "the board failed and was reset");
}

static void a_board_that_kept_its_power_keeps_what_it_held(void **state)
{
	static const enum fake_usb_fault faults[] = { FAKE_USB_STALL_OUT, FAKE_USB_ERROR_IN,
						      FAKE_USB_HANG_IN, FAKE_USB_BUS_RESET };
	struct accel_buffer *buffer;
	uint32_t word = 0x1234567;

	assert_int_equal(accel_buffer_new(*state, 4096, &buffer), 0);
	assert_int_equal(accel_buffer_write(buffer, 0, &word, 4), 0);
	for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++) {
		fake_usb_arm(0, faults[i], 1, 0);
		check_failed_at_most(*state);
		fake_usb_disarm();
		word = 0;
		assert_int_equal(accel_buffer_read(buffer, 0, &word, 4), 0);
		assert_int_equal(word, 0x1234567);
	}
	accel_buffer_free(buffer);
}

/* ---- the claim ---- */

/* What was submitted before the library knew, the kernel claims for; but not each time. */
static void a_claim_that_a_bus_reset_took_is_made_again(void **state)
{
	for (int n = 0; n < 10; n++) {
		fake_usb_arm(0, FAKE_USB_BUS_RESET, 1 + (uint64_t)n * 5, 0);
		check_failed_at_most(*state);
		assert_int_equal(copy(*state), 0);
		assert_int_equal(fake_usb.claims, 1);
	}
	assert_int_equal(fake_usb.fired, 10);
	assert_in_range(fake_usb.implicit_claims, 0, 9);
}

/* ---- transfers that do not end ---- */

static int close_without_events(void)
{
	struct accel_device *device;

	fake_usb_start(1);
	if (accel_device_new("usb:", NULL, NULL, &device))
		return 1;
	fake_usb_fail_always("libusb_handle_events", LIBUSB_ERROR_IO);
	accel_device_free(device);
	return 0;
}

static int work_without_events(void)
{
	struct accel_device *device;

	fake_usb_start(1);
	if (accel_device_new("usb:", messages_take, &messages, &device))
		return 1;
	fake_usb_fail_always("libusb_handle_events", LIBUSB_ERROR_IO);
	/* NOLINTNEXTLINE(misc-redundant-expression): the second time, too */
	if (copy(device) != -ENODEV || copy(device) != -ENODEV)
		return 2;
	if (!strstr(messages.last, "transfers on USB do not end"))
		return 3;
	accel_device_free(device);
	return 0;
}

/* In processes of their own, since what is in flight stays in flight. */
static void a_board_whose_transfers_do_not_end_is_left_in_bounded_time(void **state)
{
	(void)state;
	assert_int_equal(child_run(close_without_events, test_patience_s() / 2), 0);
	assert_int_equal(child_run(work_without_events, test_patience_s() / 2), 0);
}

#define kernel_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_board_whose_transfers_do_not_end_is_left_in_bounded_time),
		kernel_test(a_submit_that_is_refused_memory_once_fails_no_job),
		kernel_test(a_board_works_with_little_memory),
		kernel_test(memory_that_becomes_little_is_made_do_with),
		kernel_test(without_memory_jobs_fail_and_the_board_stays),
		kernel_test(memory_that_comes_back_is_used_again),
		kernel_test(a_board_does_not_open_without_memory_and_says_so),
		kernel_test(a_board_that_lost_its_power_is_gone_with_what_it_held),
		kernel_test(power_lost_while_the_board_starts_again_is_noticed_too),
		kernel_test(a_board_that_kept_its_power_keeps_what_it_held),
		kernel_test(a_claim_that_a_bus_reset_took_is_made_again),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
