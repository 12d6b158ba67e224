/* SPDX-License-Identifier: MIT */
/* The library on "drm:": what accel.h promises of it, and what only the kernel has to tell. */
#include <poll.h>
#include <unistd.h>

#include "drm_test.h"
#include "share_test.h"

static void threads_share_a_device(void **state)
{
	(void)state;
	share_check("drm:");
}

/* As examples/triangle.c does. */
static void draw(const char *name, uint32_t pixel[64 * 64])
{
	static const float corner[3][3] = { { -0.9f, -0.8f, 0 },
					    { 0.9f, -0.8f, 0 },
					    { 0, 0.9f, 0 } };
	static const float colour[3][4] = { { 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 } };
	static const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
							 .vertices = 3,
							 .position = { .data = corner },
							 .colour = { .data = colour });
	struct accel_device *device;
	struct accel_target *target;
	struct accel_state *state;
	struct messages messages;
	struct accel_draw *draw;

	device = device_open(name, &messages);
	assert_int_equal(accel_draw_new(device, &draw), 0);
	assert_int_equal(accel_target_new(device, 64, 64, &target), 0);
	assert_int_equal(accel_state_new(&state), 0);
	assert_int_equal(accel_draw_begin(draw, target, NULL), 0);
	assert_int_equal(accel_draw_mesh(draw, state, &mesh), 0);
	assert_int_equal(accel_draw_finish(draw), 0);
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixel, 64 * 4), 0);
	accel_draw_free(draw);
	accel_state_free(state);
	accel_target_free(target);
	accel_device_free(device);
}

static void a_picture_is_that_of_the_model(void **state)
{
	uint32_t pixel[64 * 64], model[64 * 64];

	(void)state;
	draw("drm:/dev/dri/renderD128", pixel);
	draw("model:", model);
	assert_memory_equal(pixel, model, sizeof(pixel));
	assert_int_not_equal(pixel[32 * 64 + 32], 0);
}

/* A device with a frame that was begun, and a stream. */
struct library {
	struct accel_device *device;
	struct accel_target *target;
	struct accel_draw *draw;
	struct accel_stream *stream;
	struct messages messages;
};

static void library_open(struct library *library)
{
	library->device = device_open("drm:", &library->messages);
	assert_int_equal(accel_target_new(library->device, 64, 64, &library->target), 0);
	assert_int_equal(accel_draw_new(library->device, &library->draw), 0);
	assert_int_equal(accel_stream_new(library->device, &library->stream), 0);
	assert_int_equal(accel_draw_begin(library->draw, library->target, NULL), 0);
}

static void library_close(struct library *library)
{
	accel_stream_free(library->stream);
	accel_draw_free(library->draw);
	accel_target_free(library->target);
	accel_device_free(library->device);
}

static void what_the_kernel_refuses_is_an_error_of_submit(void **state)
{
	struct library library;
	struct accel_fence *fence;

	(void)state;
	library_open(&library);
	fake_gloss.fail_request = GLOSS(SUBMIT);
	fake_gloss.fail_errno = EFAULT;
	fake_gloss.fail_at = 1;
	assert_int_equal(accel_stream_submit(library.stream, NULL, 0, NULL), -EIO);
	fake_gloss.fail_at = 1;
	assert_int_equal(accel_draw_submit(library.draw, &fence), -EIO);
	/* Nothing was sent. */
	assert_int_equal(accel_draw_finish(library.draw), 0);
	assert_int_equal(accel_stream_finish(library.stream, NULL, 0), 0);
	library_close(&library);
}

static void a_job_that_runs_for_too_long_is_told_by_whoever_waits(void **state)
{
	struct library library;

	(void)state;
	library_open(&library);
	fake_gloss_lose(0, -ETIME);
	assert_int_equal(accel_draw_finish(library.draw), -ETIME);
	assert_message(&library.messages, "ran for longer than a job may");
	fake_gloss_lose(0, -ETIME);
	assert_int_equal(accel_stream_finish(library.stream, NULL, 0), -ETIME);
	fake_gloss_lose(0, -ETIME);
	assert_int_equal(accel_stream_submit(library.stream, NULL, 0, NULL), 0);
	assert_int_equal(accel_device_finish(library.device), -ETIME);
	assert_int_equal(accel_device_finish(library.device), 0);
	library_close(&library);
}

static bool readable(int fd)
{
	struct pollfd file = { .fd = fd, .events = POLLIN };

	return poll(&file, 1, 0) == 1 && file.revents == POLLIN;
}

static void a_fence_has_a_file_descriptor_that_is_readable_at_its_end(void **state)
{
	struct library library;
	struct accel_fence *fence[3];
	int fd[3];

	(void)state;
	library_open(&library);
	assert_int_equal(accel_stream_submit(library.stream, NULL, 0, &fence[0]), 0);
	assert_int_equal(accel_fence_wait(fence[0], -1, NULL, 0), 0);
	fake_gloss_hold();
	for (int i = 1; i < 3; i++)
		assert_int_equal(accel_stream_submit(library.stream, NULL, 0, &fence[i]), 0);
	for (int i = 0; i < 3; i++) {
		fd[i] = accel_fence_fd(fence[i]);
		assert_true(fd[i] >= 0);
		assert_int_equal(readable(fd[i]), i == 0);
	}
	fake_gloss_release();
	for (int i = 0; i < 3; i++)
		accel_fence_free(fence[i]);
	/* They outlive the fences and the device. */
	library_close(&library);
	for (int i = 0; i < 3; i++) {
		assert_true(readable(fd[i]));
		close(fd[i]);
	}
}

static void what_the_kernel_has_no_file_descriptor_for_is_told(void **state)
{
	static const unsigned int calls[] = {
		_IOC_NR(DRM_IOCTL_SYNCOBJ_CREATE),
		_IOC_NR(DRM_IOCTL_SYNCOBJ_TRANSFER),
		_IOC_NR(DRM_IOCTL_SYNCOBJ_HANDLE_TO_FD),
	};
	static const struct {
		int error, answer;
	} errors[] = {
		{ EMFILE, -EMFILE }, { ENFILE, -EMFILE }, { ENOMEM, -ENOMEM },
		{ ENODEV, -ENODEV }, { EACCES, -EIO },
	};
	struct library library;
	struct accel_fence *fence;
	unsigned int syncobjs;

	(void)state;
	library_open(&library);
	assert_int_equal(accel_stream_submit(library.stream, NULL, 0, &fence), 0);
	syncobjs = fake_gloss.syncobjs;
	for (size_t i = 0; i < sizeof(calls) / sizeof(calls[0]); i++)
		for (size_t j = 0; j < sizeof(errors) / sizeof(errors[0]); j++) {
			fake_gloss.fail_request = calls[i];
			fake_gloss.fail_errno = errors[j].error;
			fake_gloss.fail_at = 1;
			assert_int_equal(accel_fence_fd(fence), errors[j].answer);
		}
	assert_int_equal(fake_gloss.syncobjs, syncobjs);
	accel_fence_free(fence);
	library_close(&library);
}

static void clocks_are_what_the_kernel_tells(void **state)
{
	const struct accel_device_clocks told = { 1ull << 40, 2, 3, 4, 5, 6 };
	struct accel_device_clocks clocks;
	struct accel_device *device;
	struct messages messages;

	(void)state;
	device = device_open("drm:", &messages);
	assert_int_equal(accel_device_clocks(device, &clocks, sizeof(clocks)), -ENOTSUP);
	fake_gloss.has_clock = true;
	assert_int_equal(accel_device_clocks(device, &clocks, sizeof(clocks)), 0);
	assert_memory_equal(&clocks, &told, sizeof(clocks));
	/* A program of before the stalls. */
	memset(&clocks, 0xee, sizeof(clocks));
	assert_int_equal(accel_device_clocks(device, &clocks, sizeof(clocks.clocks)), 0);
	assert_int_equal(clocks.clocks, told.clocks);
	assert_int_equal(clocks.stall_stream, 0xeeeeeeeeeeeeeeee);
	fake_gloss.fail_at = 1;
	fake_gloss.fail_errno = ENODEV;
	assert_int_equal(accel_device_clocks(device, &clocks, sizeof(clocks)), -ENODEV);
	accel_device_free(device);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		drm_test(threads_share_a_device),
		drm_test(a_picture_is_that_of_the_model),
		drm_test(what_the_kernel_refuses_is_an_error_of_submit),
		drm_test(a_job_that_runs_for_too_long_is_told_by_whoever_waits),
		drm_test(a_fence_has_a_file_descriptor_that_is_readable_at_its_end),
		drm_test(what_the_kernel_has_no_file_descriptor_for_is_told),
		drm_test(clocks_are_what_the_kernel_tells),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
