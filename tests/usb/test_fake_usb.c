/* SPDX-License-Identifier: MIT */
/* The libusb of fake_usb.h: what it promises to a host, and what it demands of it. */
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "usb_host.h"

static void a_host_runs_jobs(void **state)
{
	static struct host host;

	(void)state;
	bus_start();
	host_open(&host);
	assert_int_equal(host_read(&host, GLOSS_REG_IDENTITY), GLOSS_IDENTITY);
	host_synchronise(&host);
	for (uint32_t n = 1; n < 200; n++)
		host_run(&host, n, n * 5);
	host_close(&host);
	fake_usb_stop();
}

/* ---- what libusb promises ---- */

struct ended {
	unsigned int count;
	enum libusb_transfer_status status;
};

static void count_end(struct libusb_transfer *transfer)
{
	struct ended *ended = transfer->user_data;

	ended->count++;
	ended->status = transfer->status;
}

static void handle_events(struct host *host, int ms)
{
	struct timeval tv = { 0, ms * 1000 };

	assert_int_equal(libusb_handle_events_timeout(host->context, &tv), 0);
}

static struct libusb_transfer *transfer_new(struct host *host, unsigned char *buffer,
					    struct ended *ended, unsigned int timeout)
{
	struct libusb_transfer *transfer = libusb_alloc_transfer(0);

	*ended = (struct ended){ .count = 0 };
	libusb_fill_bulk_transfer(transfer, host->handle, GLOSS_USB_ENDPOINT_IN, buffer, 512,
				  count_end, ended, timeout);
	assert_int_equal(libusb_submit_transfer(transfer), 0);
	return transfer;
}

static void a_cancelled_transfer_ends_in_its_callback(void **state)
{
	static struct host host;
	struct libusb_transfer *transfer;
	unsigned char buffer[512];
	struct ended ended;

	(void)state;
	bus_start();
	host_open(&host);
	transfer = transfer_new(&host, buffer, &ended, 0);
	assert_int_equal(libusb_cancel_transfer(transfer), 0);
	assert_int_equal(ended.count, 0);
	while (!ended.count)
		handle_events(&host, 10);
	assert_int_equal(ended.status, LIBUSB_TRANSFER_CANCELLED);
	assert_int_equal(libusb_cancel_transfer(transfer), LIBUSB_ERROR_NOT_FOUND);
	libusb_free_transfer(transfer);
	host_close(&host);
	fake_usb_stop();
}

static void a_transfer_times_out_without_waiting_outside(void **state)
{
	static struct host host;
	struct libusb_transfer *transfer;
	unsigned char buffer[512];
	struct ended ended;
	int64_t before;

	(void)state;
	bus_start();
	host_open(&host);
	before = fake_usb_now_ns();
	transfer = transfer_new(&host, buffer, &ended, 100000);
	while (!ended.count)
		handle_events(&host, 100);
	assert_int_equal(ended.status, LIBUSB_TRANSFER_TIMED_OUT);
	assert_true(fake_usb_now_ns() - before >= 100000000000);
	libusb_free_transfer(transfer);
	host_close(&host);
	fake_usb_stop();
}

static void unplugging_ends_transfers_and_calls(void **state)
{
	static struct host host;
	struct libusb_transfer *transfer;
	unsigned char buffer[512];
	struct ended ended;

	(void)state;
	bus_start();
	host_open(&host);
	transfer = transfer_new(&host, buffer, &ended, 0);
	fake_usb_unplug(0);
	while (!ended.count)
		handle_events(&host, 10);
	assert_true(ended.status == LIBUSB_TRANSFER_NO_DEVICE ||
		    ended.status == LIBUSB_TRANSFER_ERROR);
	assert_int_equal(libusb_submit_transfer(transfer), LIBUSB_ERROR_NO_DEVICE);
	fake_usb_plug(0, false);
	assert_int_equal(libusb_submit_transfer(transfer), LIBUSB_ERROR_NO_DEVICE);
	assert_int_equal(host_write(&host, GLOSS_REG_NONCE, 1), LIBUSB_ERROR_NO_DEVICE);
	libusb_free_transfer(transfer);
	host_close(&host);
	host_open(&host);
	host_synchronise(&host);
	host_close(&host);
	fake_usb_stop();
}

static void an_interface_has_one_owner(void **state)
{
	static struct host host;
	libusb_device_handle *second;

	(void)state;
	bus_start();
	host_open(&host);
	assert_int_equal(libusb_open(libusb_get_device(host.handle), &second), 0);
	assert_int_equal(libusb_claim_interface(second, 0), LIBUSB_ERROR_BUSY);
	assert_int_equal(libusb_release_interface(host.handle, 0), 0);
	assert_int_equal(libusb_claim_interface(second, 0), 0);
	libusb_close(second);
	host_close(&host);
	fake_usb_stop();
}

/* ---- what its caller may not do ---- */

static void submit_twice(struct host *host, struct libusb_transfer *transfer)
{
	(void)host;
	libusb_submit_transfer(transfer);
}

static void free_in_flight(struct host *host, struct libusb_transfer *transfer)
{
	(void)host;
	libusb_free_transfer(transfer);
}

static void close_in_flight(struct host *host, struct libusb_transfer *transfer)
{
	(void)transfer;
	libusb_close(host->handle);
}

static void release_in_flight(struct host *host, struct libusb_transfer *transfer)
{
	(void)transfer;
	libusb_release_interface(host->handle, 0);
}

static void ask_without_claim(struct host *host, struct libusb_transfer *transfer)
{
	libusb_cancel_transfer(transfer);
	while (fake_usb.in_flight)
		handle_events(host, 10);
	libusb_release_interface(host->handle, 0);
	host_write(host, GLOSS_REG_NONCE, 1);
}

static void use_after_close(struct host *host, struct libusb_transfer *transfer)
{
	libusb_cancel_transfer(transfer);
	while (fake_usb.in_flight)
		handle_events(host, 10);
	libusb_close(host->handle);
	libusb_submit_transfer(transfer);
}

static void leave_it_all(struct host *host, struct libusb_transfer *transfer)
{
	(void)host;
	(void)transfer;
	fake_usb_stop();
}

static void misbehave(void (*wrong)(struct host *host, struct libusb_transfer *transfer))
{
	static struct host host;
	unsigned char buffer[512];
	struct ended ended;

	fclose(stderr);
	signal(SIGABRT, SIG_DFL);
	host_open(&host);
	wrong(&host, transfer_new(&host, buffer, &ended, 0));
	_exit(0);
}

static void a_wrong_call_ends_the_process(void **state)
{
	static void (*const wrong[])(struct host *, struct libusb_transfer *) = {
		submit_twice,      free_in_flight,  close_in_flight, release_in_flight,
		ask_without_claim, use_after_close, leave_it_all,
	};
	int status;

	(void)state;
	bus_start();
	for (size_t n = 0; n < sizeof(wrong) / sizeof(wrong[0]); n++) {
		pid_t child = fork();

		if (!child)
			misbehave(wrong[n]);
		assert_int_equal(waitpid(child, &status, 0), child);
		if (!WIFSIGNALED(status) || WTERMSIG(status) != SIGABRT)
			fail_msg("wrong call %zu is not noticed", n);
	}
	fake_usb_stop();
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_host_runs_jobs),
		cmocka_unit_test(a_cancelled_transfer_ends_in_its_callback),
		cmocka_unit_test(a_transfer_times_out_without_waiting_outside),
		cmocka_unit_test(unplugging_ends_transfers_and_calls),
		cmocka_unit_test(an_interface_has_one_owner),
		cmocka_unit_test(a_wrong_call_ends_the_process),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
