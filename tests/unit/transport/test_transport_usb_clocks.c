/* SPDX-License-Identifier: MIT */
/* The counters of a board's port, which begin again with each reset and wrap at 32 bits. */
#include "usb_test.h"

static struct messages messages;

/* What the registers read; a reset makes them 0. */
static struct {
	_Atomic uint64_t clocks;
	_Atomic uint32_t stall[5];
	_Atomic unsigned int moves; /* the upper half, after so many reads of the lower one */
} counters;

static uint32_t counting_read(struct gloss_usb_board *board, uint32_t offset)
{
	if (offset == GLOSS_REG_CLOCKS_HIGH)
		return (uint32_t)(counters.clocks >> 32);
	if (offset == GLOSS_REG_CLOCKS_LOW) {
		uint32_t low = (uint32_t)counters.clocks;

		if (counters.moves && !--counters.moves)
			counters.clocks += 1ull << 32;
		return low;
	}
	if (offset >= GLOSS_REG_STALL_STREAM && offset <= GLOSS_REG_STALL_RESPONSE)
		return counters.stall[(offset - GLOSS_REG_STALL_STREAM) / 4];
	return gloss_usb_board_model_t64.read(board, offset);
}

static void counting_write(struct gloss_usb_board *board, uint32_t offset, uint32_t value)
{
	if (offset == GLOSS_REG_CONTROL) {
		counters.clocks = 0;
		for (int i = 0; i < 5; i++)
			counters.stall[i] = 0;
	}
	gloss_usb_board_model_t64.write(board, offset, value);
}

static int setup(void **state)
{
	static struct gloss_usb_board_ops board;

	board = gloss_usb_board_model_t64;
	board.read = counting_read;
	board.write = counting_write;
	fake_usb_start(test_seed());
	fake_usb_unplug(0);
	fake_usb.board[0].ops = &board;
	fake_usb_plug(0, true);
	*state = device_open("usb:", &messages);
	return 0;
}

static int teardown(void **state)
{
	fake_usb_disarm();
	accel_device_free(*state);
	fake_usb_stop();
	return 0;
}

static void count(uint64_t clocks, uint32_t stalls)
{
	counters.clocks += clocks;
	for (uint32_t i = 0; i < 5; i++)
		counters.stall[i] += stalls * (i + 1);
}

static void assert_clocks(struct accel_device *device, uint64_t clocks, uint64_t stalls)
{
	struct accel_device_clocks now;

	assert_int_equal(accel_device_clocks(device, &now, sizeof(now)), 0);
	assert_int_equal(now.clocks, clocks);
	assert_int_equal(now.stall_stream, stalls);
	assert_int_equal(now.stall_raster, 2 * stalls);
	assert_int_equal(now.stall_tile, 3 * stalls);
	assert_int_equal(now.stall_memory, 4 * stalls);
	assert_int_equal(now.stall_response, 5 * stalls);
}

static int run_job(struct accel_device *device)
{
	struct accel_stream *stream;
	int err;

	assert_int_equal(accel_stream_new(device, &stream), 0);
	err = accel_stream_finish(stream, NULL, 0);
	accel_stream_free(stream);
	return err;
}

static void clocks_are_the_registers_of_the_port(void **state)
{
	assert_clocks(*state, 0, 0);
	count(1000, 10);
	assert_clocks(*state, 1000, 10);
	count(0x300000000, 100);
	assert_clocks(*state, 0x3000003e8, 110);
	assert_clocks(*state, 0x3000003e8, 110);
}

static void clocks_are_summed_over_resets_of_the_board(void **state)
{
	uint64_t sum = 0;

	for (int n = 0; n < 5; n++) {
		count(1000, 10);
		sum += 1000;
		fake_usb_arm(0, FAKE_USB_ERROR_IN, 1, 0);
		assert_int_equal(run_job(*state), -EIO);
		assert_int_equal(run_job(*state), 0);
		assert_clocks(*state, sum, sum / 100);
		count(500, 5);
		sum += 500;
		assert_clocks(*state, sum, sum / 100);
	}
}

static void stalls_are_right_though_their_registers_wrap(void **state)
{
	uint64_t stalls = 0;

	for (int n = 0; n < 20; n++) {
		count(0x30000000, 0x30000000);
		stalls += 0x30000000;
		assert_clocks(*state, stalls, stalls);
	}
}

/* The lower half wraps between two reads. */
static void clocks_are_read_as_a_whole(void **state)
{
	counters.clocks = 0xffffffff;
	counters.moves = 1;
	assert_clocks(*state, 0x1ffffffff, 0);
}

/* While there is always a job nobody asks, but time passes. */
static void stalls_that_wrap_while_nobody_asks_are_counted(void **state)
{
	struct accel_stream *stream;
	struct accel_fence *fence, *next;

	assert_int_equal(accel_stream_new(*state, &stream), 0);
	assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
	count(1, 0xc0000000 / 5);
	for (int n = 0; n < 60; n++) {
		fake_usb_hold();
		assert_int_equal(accel_stream_submit(stream, NULL, 0, &next), 0);
		fake_usb_rest(500);
		fake_usb_release();
		assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
		accel_fence_free(fence);
		fence = next;
	}
	accel_fence_free(fence);
	count(1, 0xc0000000 / 5);
	assert_clocks(*state, 2, 2 * (uint64_t)(0xc0000000 / 5));
	accel_stream_free(stream);
}

static void a_board_without_a_clock_says_so_once_it_has_done_a_job(void **state)
{
	struct accel_device_clocks clocks;

	assert_clocks(*state, 0, 0);
	assert_int_equal(run_job(*state), 0);
	assert_int_equal(accel_device_clocks(*state, &clocks, sizeof(clocks)), -ENOTSUP);
}

static void a_board_that_is_gone_has_no_clocks(void **state)
{
	struct accel_device_clocks clocks;

	fake_usb_fail("libusb_control_transfer", 1, LIBUSB_ERROR_PIPE);
	assert_int_equal(accel_device_clocks(*state, &clocks, sizeof(clocks)), -EIO);
	fake_usb_unplug(0);
	assert_int_equal(accel_device_clocks(*state, &clocks, sizeof(clocks)), -ENODEV);
	while (run_job(*state) != -ENODEV)
		;
	assert_int_equal(accel_device_clocks(*state, &clocks, sizeof(clocks)), -ENODEV);
}

struct asker {
	pthread_t thread;
	struct accel_device *device;
	_Atomic bool stop;
};

static void *ask_in_thread(void *data)
{
	struct asker *asker = data;
	struct accel_device_clocks clocks;

	while (!asker->stop)
		accel_device_clocks(asker->device, &clocks, sizeof(clocks));
	return NULL;
}

/* Whoever asks has the handle, which the start of the board changes. */
static void clocks_may_be_asked_for_at_any_time(void **state)
{
	struct asker asker = { .device = *state };
	int err;

	assert_int_equal(pthread_create(&asker.thread, NULL, ask_in_thread, &asker), 0);
	for (int n = 0; n < 20; n++) {
		fake_usb_arm(0, n % 2 ? FAKE_USB_BUS_RESET : FAKE_USB_ERROR_IN, 1, 0);
		/* Or whoever asks has the fault, before there is a job. */
		err = run_job(*state);
		assert_true(!err || err == -EIO);
		assert_int_equal(run_job(*state), 0);
	}
	asker.stop = true;
	pthread_join(asker.thread, NULL);
}

#define clocks_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		clocks_test(clocks_are_the_registers_of_the_port),
		clocks_test(clocks_are_summed_over_resets_of_the_board),
		clocks_test(stalls_are_right_though_their_registers_wrap),
		clocks_test(clocks_are_read_as_a_whole),
		clocks_test(stalls_that_wrap_while_nobody_asks_are_counted),
		clocks_test(a_board_without_a_clock_says_so_once_it_has_done_a_job),
		clocks_test(a_board_that_is_gone_has_no_clocks),
		clocks_test(clocks_may_be_asked_for_at_any_time),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
