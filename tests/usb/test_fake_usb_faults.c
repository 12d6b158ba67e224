/* SPDX-License-Identifier: MIT */
/* The faults of the libusb of fake_usb.h: each does what its name says. */
#include "usb_host.h"

static void a_halted_endpoint_stalls_until_it_is_cleared(void **state)
{
	static struct host host;
	uint32_t word = 0;
	int moved;

	(void)state;
	bus_start();
	host_open(&host);
	fake_usb_arm(0, FAKE_USB_STALL_OUT, 1, 0);
	for (int n = 0; n < 3; n++)
		assert_int_equal(libusb_bulk_transfer(host.handle, GLOSS_USB_ENDPOINT_OUT,
						      (unsigned char *)&word, 4, &moved, 1000),
				 LIBUSB_ERROR_PIPE);
	assert_int_equal(libusb_clear_halt(host.handle, GLOSS_USB_ENDPOINT_OUT), 0);
	host_synchronise(&host);
	host_close(&host);
	fake_usb_stop();
}

static void a_killed_host_leaves_its_job_on_the_board(void **state)
{
	static struct host host, next;
	uint32_t words[GLOSS_USB_JOB_WORDS];

	(void)state;
	bus_start();
	host_open(&host);
	host_synchronise(&host);
	gloss_usb_job_pack(words, &(struct gloss_usb_job){ .mark = GLOSS_USB_JOB_MAGIC,
							   .stream_words = 100 });
	host_send(&host, words, GLOSS_USB_JOB_WORDS);
	fake_usb_kill();
	assert_int_equal(host_write(&host, GLOSS_REG_NONCE, 1), LIBUSB_ERROR_NO_DEVICE);
	host_open(&next);
	assert_int_equal(host_read(&next, GLOSS_REG_NONCE), NONCE);
	while (!(host_read(&next, GLOSS_REG_STATUS) & GLOSS_REG_STATUS_RUNNING))
		;
	host_synchronise(&next);
	host_run(&next, 7, 300);
	host_close(&next);
	host_close(&host);
	fake_usb_stop();
}

static void a_call_fails_when_it_is_told_to(void **state)
{
	static struct host host;

	(void)state;
	bus_start();
	host_open(&host);
	fake_usb_fail("libusb_control_transfer", 2, LIBUSB_ERROR_IO);
	assert_int_equal(host_write(&host, GLOSS_REG_NONCE, 1), 4);
	assert_int_equal(host_write(&host, GLOSS_REG_NONCE, 1), LIBUSB_ERROR_IO);
	assert_int_equal(host_write(&host, GLOSS_REG_NONCE, 1), 4);
	fake_usb_fail(NULL, 1, LIBUSB_ERROR_NO_MEM);
	assert_null(libusb_alloc_transfer(0));
	host_close(&host);
	fake_usb_stop();
}

/* The words of a sync as they come back, with @fault: how many, at most @most. */
static size_t echo(enum fake_usb_fault fault, uint32_t value, uint32_t *words, size_t most)
{
	static struct host host;
	uint32_t sync[4] = { GLOSS_USB_SYNC_MAGIC, NONCE, ~NONCE, ~GLOSS_USB_SYNC_MAGIC };
	int moved, bytes = 0;

	bus_start();
	host_open(&host);
	host_write(&host, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	host_write(&host, GLOSS_REG_NONCE, NONCE);
	if (fault)
		fake_usb_arm(0, fault, 1, value);
	libusb_bulk_transfer(host.handle, GLOSS_USB_ENDPOINT_OUT, (unsigned char *)sync, 16, &moved,
			     1000);
	while (bytes < (int)(4 * most) &&
	       !libusb_bulk_transfer(host.handle, GLOSS_USB_ENDPOINT_IN,
				     (unsigned char *)words + bytes, 512, &moved, 1000))
		bytes += moved;
	assert_true(!fault || fake_usb_fired());
	host_close(&host);
	fake_usb_stop();
	return (size_t)bytes;
}

static void a_fault_does_what_its_name_says(void **state)
{
	static const struct {
		enum fake_usb_fault fault;
		uint32_t value;
		size_t bytes;
	} faults[] = {
		{ FAKE_USB_NO_FAULT, 0, 16 },   { FAKE_USB_SHORT_IN, 0, 16 },
		{ FAKE_USB_EMPTY_IN, 3, 16 },   { FAKE_USB_REPEAT_IN, 0, 32 },
		{ FAKE_USB_LOSE_IN, 0, 0 },     { FAKE_USB_LOSE_OUT, 0, 0 },
		{ FAKE_USB_HANG_IN, 0, 0 },     { FAKE_USB_HANG_OUT, 0, 0 },
		{ FAKE_USB_STALL_IN, 0, 0 },    { FAKE_USB_STALL_OUT, 0, 0 },
		{ FAKE_USB_ERROR_IN, 0, 0 },    { FAKE_USB_ERROR_OUT, 0, 0 },
		{ FAKE_USB_OVERFLOW_IN, 0, 0 }, { FAKE_USB_GLITCH, 0, 0 },
		{ FAKE_USB_UNPLUG, 0, 0 },      { FAKE_USB_KILL, 0, 0 },
		{ FAKE_USB_GARBAGE_IN, 3, 16 }, { FAKE_USB_GARBAGE_OUT, 0, 0 },
	};
	uint32_t right[256], words[256];

	(void)state;
	assert_int_equal(echo(FAKE_USB_NO_FAULT, 0, right, 128), 16);
	for (size_t n = 0; n < sizeof(faults) / sizeof(faults[0]); n++) {
		size_t bytes = echo(faults[n].fault, faults[n].value, words, 128);

		if (bytes != faults[n].bytes)
			fail_msg("%s: %zu bytes came", fake_usb_fault_name(faults[n].fault), bytes);
		if (bytes && faults[n].fault != FAKE_USB_GARBAGE_IN)
			assert_memory_equal(words, right, 16);
		if (faults[n].fault == FAKE_USB_GARBAGE_IN)
			assert_memory_not_equal(words, right, 16);
	}
	assert_in_range(echo(FAKE_USB_ODD_IN, 0, words, 128), 13, 15);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_halted_endpoint_stalls_until_it_is_cleared),
		cmocka_unit_test(a_killed_host_leaves_its_job_on_the_board),
		cmocka_unit_test(a_call_fails_when_it_is_told_to),
		cmocka_unit_test(a_fault_does_what_its_name_says),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
