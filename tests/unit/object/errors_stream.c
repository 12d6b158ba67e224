/* SPDX-License-Identifier: MIT */
/* Errors of streams and fences, and of a device that finishes them all. */
#include "errors.h"

static int stream_too_long(void)
{
	return accel_stream_emit(test.stream, test.pixels, ACCEL_STREAM_WORDS_MAX + 1ull);
}

static int slot_number_sixteen(void)
{
	struct accel_buffer *another;
	int slot = 0;

	for (int n = 0; n < 17 && slot >= 0; n++) {
		assert_int_equal(accel_buffer_new(test.device, 4, &another), 0);
		slot = accel_stream_slot(test.stream, another, ACCEL_SLOT_READ);
		accel_buffer_free(another);
	}
	return slot;
}

static int slot_without_rights(void)
{
	return accel_stream_slot(test.stream, test.buffer, 0);
}

static int submit_stream(void)
{
	return accel_stream_submit(test.stream, NULL, 0, NULL);
}

static int finish_stream(void)
{
	return accel_stream_finish(test.stream, NULL, 0);
}

static int response_without_a_fence(void)
{
	return accel_stream_submit(test.stream, test.pixels, 1, NULL);
}

static int response_to_nowhere(void)
{
	return accel_stream_finish(test.stream, NULL, 1);
}

static void emit_a_fault(void)
{
	const uint32_t unknown = 0xff000000;

	assert_int_equal(accel_stream_emit(test.stream, &unknown, 1), 0);
}

static int finish_a_job_with_a_fault(void)
{
	emit_a_fault();
	return finish_stream();
}

/* The board is missed when it is to do something. */
static int submit_to_no_board(void)
{
	unplug();
	assert_int_equal(finish_stream(), -ENODEV);
	return submit_stream();
}

static int finish_a_job_on_no_board(void)
{
	unplug();
	return finish_stream();
}

static int finish_a_job_without_memory(void)
{
	refuse_memory();
	return finish_stream();
}

static int finish_after_a_fault(void)
{
	emit_a_fault();
	assert_int_equal(submit_stream(), 0);
	return accel_device_finish(test.device);
}

static int finish_without_a_board(void)
{
	unplug();
	return accel_device_finish(test.device);
}

static int finish_without_memory(void)
{
	refuse_memory();
	return accel_device_finish(test.device);
}

/* What the fence of a job answers, which is then freed. */
static int wait_of(int64_t timeout_ns)
{
	struct accel_fence *fence;
	int err;

	assert_int_equal(accel_stream_submit(test.stream, NULL, 0, &fence), 0);
	err = accel_fence_wait(fence, timeout_ns, NULL, 0);
	fake_usb_release();
	accel_fence_free(fence);
	return err;
}

static int wait_for_a_job_that_runs(void)
{
	fake_usb_hold();
	return wait_of(0);
}

static int wait_on_a_board_that_fails(void)
{
	fail_board();
	return wait_of(-1);
}

static int wait_on_no_board(void)
{
	struct accel_fence *fence;
	int err;

	fake_usb_hold();
	assert_int_equal(accel_stream_submit(test.stream, NULL, 0, &fence), 0);
	unplug();
	err = accel_fence_wait(fence, -1, NULL, 0);
	accel_fence_free(fence);
	return err;
}

static int wait_without_memory(void)
{
	refuse_memory();
	return wait_of(-1);
}

/* A fence of a job that has ended. */
static int fence_fd(void)
{
	struct accel_fence *fence;
	int fd;

	assert_int_equal(accel_stream_submit(test.stream, NULL, 0, &fence), 0);
	fd = accel_fence_fd(fence);
	accel_fence_free(fence);
	return fd;
}

const struct reached errors_stream[] = {
	{ "accel_device_finish", -EIO, finish_after_a_fault },
	{ "accel_device_finish", -ENODEV, finish_without_a_board },
	{ "accel_device_finish", -ENOMEM, finish_without_memory },
	{ "accel_stream_emit", -E2BIG, stream_too_long },
	{ "accel_stream_slot", -ENOSPC, slot_number_sixteen },
	{ "accel_stream_slot", -EINVAL, slot_without_rights },
	{ "accel_stream_submit", -EINVAL, response_without_a_fence },
	{ "accel_stream_submit", -ENODEV, submit_to_no_board },
	{ "accel_stream_finish", -EINVAL, response_to_nowhere },
	{ "accel_stream_finish", -EIO, finish_a_job_with_a_fault },
	{ "accel_stream_finish", -ENODEV, finish_a_job_on_no_board },
	{ "accel_stream_finish", -ENOMEM, finish_a_job_without_memory },
	{ "accel_fence_wait", -ETIMEDOUT, wait_for_a_job_that_runs },
	{ "accel_fence_wait", -EIO, wait_on_a_board_that_fails },
	{ "accel_fence_wait", -ENODEV, wait_on_no_board },
	{ "accel_fence_wait", -ENOMEM, wait_without_memory },
	{ "accel_fence_fd", -ENOTSUP, fence_fd },
	{ .function = NULL },
};
