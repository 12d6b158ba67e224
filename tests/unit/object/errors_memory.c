/* SPDX-License-Identifier: MIT */
/* Errors of buffers and targets. */
#include "errors.h"

/* Halves, quarters and so on: fewer than there are slots. */
static void fill_memory(void)
{
	struct accel_buffer *rest;
	uint64_t size = FAKE_USB_BOARD_BYTES;

	for (; size >= 4096; size /= 2)
		while (!accel_buffer_new(test.device, size, &rest)) {
			/* The stream keeps it. */
			assert_in_range(accel_stream_slot(test.stream, rest, ACCEL_SLOT_READ), 0,
					15);
			accel_buffer_free(rest);
		}
}

static int new_buffer(uint64_t size)
{
	struct accel_buffer *another;

	return accel_buffer_new(test.device, size, &another);
}

static int buffer_of_three_bytes(void)
{
	return new_buffer(3);
}

static int buffer_in_full_memory(void)
{
	fill_memory();
	return new_buffer(4096);
}

static int write_word(void)
{
	uint32_t word = 1;

	return accel_buffer_write(test.buffer, 0, &word, 4);
}

static int write_behind_the_end(void)
{
	uint32_t word = 1;

	return accel_buffer_write(test.buffer, 4096, &word, 4);
}

static int write_to_a_board_that_fails(void)
{
	fail_board();
	return write_word();
}

static int write_to_no_board(void)
{
	unplug();
	return write_word();
}

static int read_word(void)
{
	uint32_t word;

	return accel_buffer_read(test.buffer, 0, &word, 4);
}

static int read_half_a_word(void)
{
	uint32_t word;

	return accel_buffer_read(test.buffer, 0, &word, 2);
}

static int read_of_a_board_that_fails(void)
{
	fail_board();
	return read_word();
}

static int read_of_no_board(void)
{
	unplug();
	return read_word();
}

static int new_target(int width, int height)
{
	struct accel_target *another;

	return accel_target_new(test.device, width, height, &another);
}

static int target_of_no_height(void)
{
	return new_target(1, 0);
}

static int target_in_full_memory(void)
{
	fill_memory();
	return new_target(1, 1);
}

static int colour_with_a_short_pitch(void)
{
	return accel_target_read(test.target, ACCEL_PLANE_COLOUR, NULL, test.pixels, 4);
}

static int colour_of_a_board_that_fails(void)
{
	fail_board();
	return accel_target_read(test.target, ACCEL_PLANE_COLOUR, NULL, test.pixels, 256);
}

static int colour_of_no_board(void)
{
	unplug();
	return accel_target_read(test.target, ACCEL_PLANE_COLOUR, NULL, test.pixels, 256);
}

static int depth_with_an_odd_pitch(void)
{
	return accel_target_read(test.target, ACCEL_PLANE_DEPTH, NULL, test.pixels, 258);
}

static int depth_of_a_board_that_fails(void)
{
	fail_board();
	return accel_target_read(test.target, ACCEL_PLANE_DEPTH, NULL, test.pixels, 256);
}

static int depth_of_no_board(void)
{
	unplug();
	return accel_target_read(test.target, ACCEL_PLANE_DEPTH, NULL, test.pixels, 256);
}

static int write_a_plane_that_is_none(void)
{
	return accel_target_write(test.target, (enum accel_plane)2, NULL, test.pixels, 256);
}

static int pixels_to_a_board_that_fails(void)
{
	fail_board();
	return accel_target_write(test.target, ACCEL_PLANE_COLOUR, NULL, test.pixels, 256);
}

static int pixels_to_no_board(void)
{
	unplug();
	return accel_target_write(test.target, ACCEL_PLANE_DEPTH, NULL, test.pixels, 256);
}

const struct reached errors_memory[] = {
	{ "accel_device_new", -EIO, write_to_a_board_that_fails }, /* what it says of jobs */
	{ "accel_buffer_new", -EINVAL, buffer_of_three_bytes },
	{ "accel_buffer_new", -ENOMEM, buffer_in_full_memory },
	{ "accel_buffer_write", -EINVAL, write_behind_the_end },
	{ "accel_buffer_write", -EIO, write_to_a_board_that_fails },
	{ "accel_buffer_write", -ENODEV, write_to_no_board },
	{ "accel_buffer_read", -EINVAL, read_half_a_word },
	{ "accel_buffer_read", -EIO, read_of_a_board_that_fails },
	{ "accel_buffer_read", -ENODEV, read_of_no_board },
	{ "accel_target_new", -EINVAL, target_of_no_height },
	{ "accel_target_new", -ENOMEM, target_in_full_memory },
	{ "accel_target_read", -EINVAL, colour_with_a_short_pitch },
	{ "accel_target_read", -EIO, colour_of_a_board_that_fails },
	{ "accel_target_read", -ENODEV, colour_of_no_board },
	{ "accel_target_read", -EINVAL, depth_with_an_odd_pitch },
	{ "accel_target_read", -EIO, depth_of_a_board_that_fails },
	{ "accel_target_read", -ENODEV, depth_of_no_board },
	{ "accel_target_write", -EINVAL, write_a_plane_that_is_none },
	{ "accel_target_write", -EIO, pixels_to_a_board_that_fails },
	{ "accel_target_write", -ENODEV, pixels_to_no_board },
	{ .function = NULL },
};
