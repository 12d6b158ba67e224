/* SPDX-License-Identifier: MIT */
/* The libusb of fake_usb.h: a host that knows no more than INTERFACE.md runs jobs through it. */
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "accel_test.h"
#include "fake_usb.h"
#include "transport/usb/checksum.h"

#define NONCE 0x1234567
#define TRANSFER_BYTES 4096

struct host {
	libusb_context *context;
	libusb_device_handle *handle;
	uint32_t in[65536];
	size_t in_words;
};

static void bus_start(void)
{
	fake_usb_start(test_seed());
}

/* ---- a host ---- */

static void host_open(struct host *host)
{
	libusb_device **list;

	*host = (struct host){ .in_words = 0 };
	assert_int_equal(libusb_init(&host->context), 0);
	assert_int_equal(libusb_get_device_list(host->context, &list), 1);
	assert_int_equal(libusb_open(list[0], &host->handle), 0);
	libusb_free_device_list(list, 1);
	assert_int_equal(libusb_claim_interface(host->handle, 0), 0);
}

static void host_close(struct host *host)
{
	libusb_close(host->handle);
	libusb_exit(host->context);
}

static int host_write(struct host *host, uint16_t offset, uint32_t value)
{
	unsigned char byte[4] = { (unsigned char)value, (unsigned char)(value >> 8),
				  (unsigned char)(value >> 16), (unsigned char)(value >> 24) };

	return libusb_control_transfer(host->handle, 0x41, GLOSS_USB_WRITE_REGISTER, offset, 0,
				       byte, 4, 1000);
}

static uint32_t host_read(struct host *host, uint16_t offset)
{
	unsigned char byte[4];

	assert_int_equal(libusb_control_transfer(host->handle, 0xc1, GLOSS_USB_READ_REGISTER,
						 offset, 0, byte, 4, 1000),
			 4);
	return byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 | (uint32_t)byte[3] << 24;
}

/* The fake's machine and these tests' are little-endian. */
static void host_send(struct host *host, const uint32_t *words, size_t count)
{
	int moved;

	assert_int_equal(libusb_bulk_transfer(host->handle, GLOSS_USB_ENDPOINT_OUT,
					      (unsigned char *)words, (int)(4 * count), &moved,
					      1000),
			 0);
	assert_int_equal(moved, 4 * count);
}

/* Until there are @count words. */
static void host_receive(struct host *host, size_t count)
{
	int moved;

	while (host->in_words < count) {
		assert_int_equal(libusb_bulk_transfer(host->handle, GLOSS_USB_ENDPOINT_IN,
						      (unsigned char *)(host->in + host->in_words),
						      TRANSFER_BYTES, &moved, 1000),
				 0);
		assert_int_equal(moved % 4, 0);
		host->in_words += (size_t)moved / 4;
	}
	assert_int_equal(host->in_words, count);
	host->in_words = 0;
}

static void host_synchronise(struct host *host)
{
	uint32_t words[4] = { GLOSS_USB_SYNC_MAGIC, NONCE, ~NONCE, ~GLOSS_USB_SYNC_MAGIC };

	assert_int_equal(host_write(host, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET), 4);
	assert_int_equal(host_write(host, GLOSS_REG_NONCE, NONCE), 4);
	host_send(host, words, 4);
	host_receive(host, 4);
	assert_memory_equal(host->in, words, sizeof(words));
}

/* Reads @count words of the slot at 4096 back, of which the first is written. */
static void host_run(struct host *host, uint32_t value, uint32_t count)
{
	uint32_t chunks = (count + 255) / 256, stream[64];
	size_t words = GLOSS_USB_JOB_WORDS + GLOSS_SLOT_ENTRY_WORDS;

	words += packet_write(stream + words, 0, 0, value);
	words += packet_read(stream + words, 0, 0, count);
	gloss_usb_job_pack(stream, &(struct gloss_usb_job){ .slots = 1,
							    .mark = GLOSS_USB_JOB_MAGIC,
							    .sequence = 5,
							    .stream_words = (uint32_t)(words - 8),
							    .response_words = count });
	gloss_slot_entry_pack(stream + 4,
			      &(struct gloss_slot_entry){ .base = 4096,
							  .size = 4096,
							  .rights = GLOSS_RIGHTS_READ_WRITE });
	stream[words] = accel_usb_checksum(0, stream + GLOSS_USB_JOB_STREAM_WORDS_WORD,
					   words - GLOSS_USB_JOB_STREAM_WORDS_WORD);
	host_send(host, stream, words + GLOSS_USB_JOB_END_WORDS);
	host_receive(host, count + chunks + GLOSS_USB_COMPLETION_WORDS);
	assert_int_equal(host->in[1], value);
	assert_int_equal(host->in[count + chunks + 1], 5);
}

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

/* ---- faults ---- */

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
		cmocka_unit_test(a_host_runs_jobs),
		cmocka_unit_test(a_cancelled_transfer_ends_in_its_callback),
		cmocka_unit_test(a_transfer_times_out_without_waiting_outside),
		cmocka_unit_test(unplugging_ends_transfers_and_calls),
		cmocka_unit_test(an_interface_has_one_owner),
		cmocka_unit_test(a_halted_endpoint_stalls_until_it_is_cleared),
		cmocka_unit_test(a_killed_host_leaves_its_job_on_the_board),
		cmocka_unit_test(a_call_fails_when_it_is_told_to),
		cmocka_unit_test(a_wrong_call_ends_the_process),
		cmocka_unit_test(a_fault_does_what_its_name_says),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
