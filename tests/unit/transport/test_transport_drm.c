/* SPDX-License-Identifier: MIT */
/* Jobs through the kernel module, on the kernel of fake_gloss.h. */
#define _GNU_SOURCE
#include <poll.h>
#include <time.h>
#include <unistd.h>
#include <xf86drm.h>

#include "fake_gloss.h"
#include "gloss_drm.h"
#include "share_test.h"
#include "transport_test.h"

#define UNUSED_BYTES (32u << 20)
#define UNUSED_BUFFERS 256

#define GLOSS(name) (DRM_COMMAND_BASE + DRM_GLOSS_##name)

static const struct accel_transport_ops *const ops = &accel_transport_drm;

static int setup(void **state)
{
	struct accel_transport_error error = { "" };

	fake_gloss_start();
	return ops->open("", state, &error);
}

/* Nothing may be left that the kernel would have to tidy up. */
static int teardown(void **state)
{
	unsigned int mappings;

	fake_gloss_release();
	ops->close(*state);
	mappings = fake_gloss_mappings();
	fake_gloss_stop();
	assert_int_equal(fake_gloss.files, 0);
	assert_int_equal(fake_gloss.left, 0);
	assert_int_equal(mappings, 0);
	return 0;
}

/* ---- what a job is ---- */

static void a_job_takes_two_ioctls(void **state)
{
	uint32_t stream[3000] = { 0 }, response[500];
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = 3000,
		.response = response,
		.response_words = 500,
	};
	struct gloss_status status;
	unsigned int ioctls;

	run(*state, &job, &status);
	ioctls = fake_gloss.ioctls;
	for (int i = 0; i < 10; i++)
		run(*state, &job, &status);
	assert_int_equal(fake_gloss.ioctls - ioctls, 20);
	assert_int_equal(fake_gloss.submits, 11);
	assert_int_equal(fake_gloss.waits, 11);
	assert_int_equal(fake_gloss.creates, 1);
}

static void a_fault_is_no_error_of_wait(void **state)
{
	const uint32_t stream[] = { 0, 0, 0xff000000, 0 };
	const struct accel_transport_job job = { .stream = stream, .stream_words = 4 };
	struct gloss_status status;

	run(*state, &job, &status);
	assert_int_equal(status.cause, GLOSS_FAULT_OPCODE);
	assert_int_equal(status.offset, 2);
	run_empty(*state);
}

static void what_is_no_job_is_refused(void **state)
{
	const struct accel_transport_slot unknown = { 1234ull | 4096ull << 32, GLOSS_RIGHTS_READ };
	const struct accel_transport_job jobs[] = {
		{ .stream_words = FAKE_WORDS_MAX + 1 },
		{ .response_words = FAKE_WORDS_MAX + 1 },
		{ .slots = GLOSS_SLOTS + 1 },
		{ .slot = &unknown, .slots = 1 },
	};
	uint64_t sequence;

	for (size_t i = 0; i < sizeof(jobs) / sizeof(jobs[0]); i++)
		assert_int_equal(ops->submit(*state, &jobs[i], &sequence), -EINVAL);
	assert_int_equal(fake_gloss.submits, 0);
	assert_int_equal(fake_gloss.creates, 1);
	run_empty(*state);
}

static void jobs_run_in_the_order_of_their_submission(void **state)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_READ_WRITE };
	uint32_t stream[4], response = 0;
	struct accel_transport_job job = { .stream = stream, .slot = &slot, .slots = 1 };
	struct gloss_status status;
	uint64_t sequence[100];

	assert_int_equal(ops->memory_new(*state, 4, &slot.object), 0);
	fake_gloss_hold();
	for (uint32_t i = 0; i < 100; i++) {
		job.stream_words = (uint32_t)packet_write(stream, 0, 0, i);
		sequence[i] = submit(*state, &job);
	}
	fake_gloss_release();
	job.stream_words = (uint32_t)packet_read(stream, 0, 0, 1);
	job.response = &response;
	job.response_words = 1;
	run(*state, &job, &status);
	assert_int_equal(response, 99);
	for (uint32_t i = 0; i < 100; i++)
		assert_int_equal(wait_for(*state, sequence[(37 * i) % 100], &status), 0);
	ops->memory_free(*state, slot.object);
}

/* ---- board memory ---- */

static void board_memory_runs_out_and_comes_back(void **state)
{
	uint64_t object[3];

	assert_int_equal(ops->memory_new(*state, FAKE_BOARD_BYTES / 2, &object[0]), 0);
	assert_int_equal(ops->memory_new(*state, FAKE_BOARD_BYTES / 2, &object[1]), 0);
	assert_int_equal(ops->memory_new(*state, 4, &object[2]), -ENOMEM);
	assert_int_equal(ops->memory_new(*state, 1ull << 31, &object[2]), -ENOMEM);
	ops->memory_free(*state, object[1]);
	assert_int_equal(ops->memory_new(*state, 4, &object[2]), 0);
	ops->memory_free(*state, object[0]);
	ops->memory_free(*state, object[2]);
}

/* ---- waiting ---- */

static int64_t now_ns(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return now.tv_sec * 1000000000ll + now.tv_nsec;
}

static void *release_later(void *data)
{
	usleep(20000);
	fake_gloss_release();
	return data;
}

static void a_wait_for_a_running_job_times_out(void **state)
{
	struct gloss_status status;
	pthread_t thread;
	int64_t before;
	uint64_t sequence;

	fake_gloss_hold();
	sequence = submit_empty(*state);
	assert_int_equal(ops->wait(*state, sequence, 0, &status), -ETIMEDOUT);
	before = now_ns();
	assert_int_equal(ops->wait(*state, sequence, 20000000, &status), -ETIMEDOUT);
	assert_true(now_ns() - before >= 20000000);
	assert_int_equal(pthread_create(&thread, NULL, release_later, NULL), 0);
	assert_int_equal(ops->wait(*state, sequence, INT64_MAX, &status), 0);
	pthread_join(thread, NULL);
}

static void a_job_is_waited_for_once(void **state)
{
	struct gloss_status status;
	uint64_t sequence = submit_empty(*state);

	assert_int_equal(wait_for(*state, sequence, &status), 0);
	assert_int_equal(ops->wait(*state, sequence, -1, &status), -EINVAL);
	assert_int_equal(ops->wait(*state, sequence + 1, -1, &status), -EINVAL);
	run_empty(*state);
}

static void many_threads_wait_while_another_submits(void **state)
{
	struct waiter waiter[16];

	fake_gloss_hold();
	start_waiters(*state, waiter, 8);
	fake_gloss_release();
	start_waiters(*state, waiter + 8, 8);
	for (int i = 0; i < 100; i++)
		run_empty(*state);
	join_waiters(waiter, 16, 0);
}

/* ---- failures of the board ---- */

static void a_lost_job_fails_alone(void **state)
{
	static const struct {
		int error, answer;
	} lost[] = {
		{ -EIO, -EIO },    { -ENODEV, -ENODEV }, { -ECANCELED, -ENODEV },
		{ -EPROTO, -EIO }, { -ETIME, -ETIME },   { FAKE_NO_STATUS, -EIO },
	};
	struct gloss_status status;
	uint64_t sequence[3];

	for (size_t i = 0; i < sizeof(lost) / sizeof(lost[0]); i++) {
		fake_gloss_lose(1, lost[i].error);
		for (int j = 0; j < 3; j++)
			sequence[j] = submit_empty(*state);
		assert_int_equal(wait_for(*state, sequence[0], &status), 0);
		assert_int_equal(wait_for(*state, sequence[1], &status), lost[i].answer);
		assert_int_equal(status.cause, GLOSS_FAULT_NONE);
		assert_int_equal(wait_for(*state, sequence[2], &status), 0);
	}
}

static void an_unplugged_board_ends_every_wait_and_call(void **state)
{
	struct gloss_status status;
	struct waiter waiter[8];
	uint64_t object, later;
	const struct accel_transport_job job = { .stream_words = 0 };

	assert_int_equal(ops->memory_new(*state, 4096, &object), 0);
	fake_gloss_hold();
	start_waiters(*state, waiter, 8);
	later = submit_empty(*state);
	usleep(10000);
	fake_gloss_unplug();
	join_waiters(waiter, 8, -ENODEV);
	assert_int_equal(wait_for(*state, later, &status), -ENODEV);
	assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	assert_int_equal(ops->submit(*state, &job, &later), -ENODEV);
	assert_int_equal(ops->memory_new(*state, 4096, &object), -ENODEV);
	ops->memory_free(*state, object);
	ops->close(*state);
	assert_int_equal(fake_gloss.files, 0);
	assert_int_equal(fake_gloss_mappings(), 0);
	fake_gloss_stop();
	assert_int_equal(setup(state), 0);
}

/* ---- the pool ---- */

static void run_many(void *state, int jobs, uint32_t words)
{
	uint32_t *response = calloc(words + 1, 4);
	const struct accel_transport_job job = { .response = response, .response_words = words };
	struct gloss_status status;
	uint64_t *sequence = calloc((size_t)jobs, sizeof(*sequence));

	fake_gloss_hold();
	for (int i = 0; i < jobs; i++)
		sequence[i] = submit(state, &job);
	fake_gloss_release();
	for (int i = 0; i < jobs; i++)
		assert_int_equal(wait_for(state, sequence[i], &status), 0);
	free(sequence);
	free(response);
}

static void unused_memory_is_bounded(void **state)
{
	unsigned int creates;

	run_many(*state, 300, 0);
	assert_int_equal(fake_gloss.creates, 300);
	assert_int_equal(fake_gloss.handles, UNUSED_BUFFERS);
	run_many(*state, 12, (4u << 20) / 4);
	assert_true(fake_gloss.host_bytes <= UNUSED_BYTES);
	assert_true(fake_gloss.host_bytes >= UNUSED_BYTES / 2);
	creates = fake_gloss.creates;
	run_many(*state, 4, (4u << 20) / 4);
	assert_int_equal(fake_gloss.creates, creates);
}

static void jobs_of_about_the_same_size_share(void **state)
{
	run_many(*state, 1, 7 * PAGE_WORDS);
	run_many(*state, 1, 7 * PAGE_WORDS - 1);
	run_many(*state, 1, 3 * PAGE_WORDS + 1);
	assert_int_equal(fake_gloss.creates, 1);
	run_many(*state, 1, 7 * PAGE_WORDS + 1);
	assert_int_equal(fake_gloss.creates, 2);
	run_many(*state, 1, 3 * PAGE_WORDS);
	assert_int_equal(fake_gloss.creates, 3);
}

static void a_job_larger_than_the_pool_takes_no_more_than_it_needs(void **state)
{
	uint32_t *stream = calloc(FAKE_WORDS_MAX, 4), *response = calloc(FAKE_WORDS_MAX, 4);
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = FAKE_WORDS_MAX,
		.response = response,
		.response_words = FAKE_WORDS_MAX,
	};
	struct gloss_status status;
	uint64_t sequence;

	run_empty(*state);
	sequence = submit(*state, &job);
	assert_int_equal(fake_gloss.host_bytes, 4096 + 4096 + 8ull * FAKE_WORDS_MAX);
	assert_int_equal(wait_for(*state, sequence, &status), 0);
	assert_int_equal(status.offset, FAKE_WORDS_MAX);
	assert_int_equal(fake_gloss.host_bytes, 4096);
	free(stream);
	free(response);
}

static void the_pool_gives_way_when_memory_is_short(void **state)
{
	run_many(*state, 8, 0);
	assert_int_equal(fake_gloss.handles, 8);
	fake_gloss.fail_request = GLOSS(GEM_CREATE);
	fake_gloss.fail_errno = ENOMEM;
	fake_gloss.fail_at = 1;
	run_many(*state, 1, PAGE_WORDS);
	assert_int_equal(fake_gloss.handles, 1);
}

/* ---- errors of the kernel ---- */

/* A life with every call; its first error. */
static int live(void *state)
{
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_WRITE };
	uint32_t stream[4], response;
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = (uint32_t)packet_write(stream, 0, 0, 3),
		.response = &response,
		.response_words = 1,
		.slot = &slot,
		.slots = 1,
	};
	struct gloss_status status;
	uint64_t sequence;
	int err;

	err = ops->memory_new(state, 4096, &slot.object);
	if (err)
		return err;
	err = ops->submit(state, &job, &sequence);
	if (!err)
		err = ops->wait(state, sequence, -1, &status);
	ops->memory_free(state, slot.object);
	return err;
}

static void fail_one(void **state, unsigned int request, unsigned int at, int error, int answer)
{
	ops->close(*state);
	assert_int_equal(fake_gloss.left, 0);
	fake_gloss_stop();
	assert_int_equal(setup(state), 0);
	fake_gloss.fail_request = request;
	fake_gloss.fail_errno = error;
	fake_gloss.fail_at = at;
	if (live(*state) != answer)
		fail_msg("call %u of ioctl %#x failed with %s, and the answer was not %s", at,
			 request, strerrorname_np(error), strerrorname_np(-answer));
	assert_int_equal(fake_gloss.fail_at, 0);
	assert_int_equal(live(*state), 0);
}

static void every_answer_of_every_ioctl_is_told(void **state)
{
	static const struct {
		int error, answer;
	} errors[] = {
		{ EINTR, 0 },        { EAGAIN, 0 },       { ENOMEM, -ENOMEM }, { ENODEV, -ENODEV },
		{ EINVAL, -EINVAL }, { ENOENT, -EINVAL }, { ENOSPC, -ENOMEM }, { EFAULT, -EIO },
		{ EACCES, -EIO },    { E2BIG, -EIO },
	};
	/* The first object is in board memory, the second in host memory. */
	static const struct {
		unsigned int number, at;
	} calls[] = {
		{ GLOSS(GEM_CREATE), 1 },
		{ GLOSS(GEM_CREATE), 2 },
		{ GLOSS(GEM_MMAP_OFFSET), 1 },
		{ GLOSS(SUBMIT), 1 },
		{ _IOC_NR(DRM_IOCTL_SYNCOBJ_TIMELINE_WAIT), 1 },
	};

	for (size_t i = 0; i < sizeof(errors) / sizeof(errors[0]); i++)
		for (size_t j = 0; j < sizeof(calls) / sizeof(calls[0]); j++)
			fail_one(state, calls[j].number, calls[j].at, errors[i].error,
				 errors[i].answer);
}

static void a_job_that_the_kernel_refused_has_no_number(void **state)
{
	uint64_t sequence, first = submit_empty(*state);
	const struct accel_transport_job job = { .stream_words = 0 };
	struct gloss_status status;

	fake_gloss.fail_request = GLOSS(SUBMIT);
	fake_gloss.fail_errno = ENOMEM;
	fake_gloss.fail_at = 1;
	assert_int_equal(ops->submit(*state, &job, &sequence), -ENOMEM);
	assert_int_equal(submit_empty(*state), first + 1);
	assert_int_equal(wait_for(*state, first, &status), 0);
	assert_int_equal(wait_for(*state, first + 1, &status), 0);
}

/* The kernel may still write to it, so it is not for another job. */
static void the_memory_of_a_job_whose_wait_failed_is_not_used_again(void **state)
{
	struct gloss_status status;
	uint64_t sequence;

	fake_gloss_hold();
	sequence = submit_empty(*state);
	fake_gloss.fail_request = _IOC_NR(DRM_IOCTL_SYNCOBJ_TIMELINE_WAIT);
	fake_gloss.fail_errno = ENOMEM;
	fake_gloss.fail_at = 1;
	assert_int_equal(wait_for(*state, sequence, &status), -ENOMEM);
	assert_int_equal(fake_gloss.handles, 0);
	fake_gloss_release();
	run_empty(*state);
	assert_int_equal(fake_gloss.creates, 2);
}

/* ---- the library on it ---- */

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

#define drm_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		drm_test(a_job_takes_two_ioctls),
		drm_test(words_of_any_count_arrive),
		drm_test(a_slot_is_as_large_as_was_asked_for_and_has_its_rights),
		drm_test(a_fault_is_no_error_of_wait),
		drm_test(what_is_no_job_is_refused),
		drm_test(jobs_run_in_the_order_of_their_submission),
		drm_test(board_memory_runs_out_and_comes_back),
		drm_test(a_wait_for_a_running_job_times_out),
		drm_test(a_job_is_waited_for_once),
		drm_test(many_threads_wait_while_another_submits),
		drm_test(a_lost_job_fails_alone),
		drm_test(an_unplugged_board_ends_every_wait_and_call),
		drm_test(unused_memory_is_bounded),
		drm_test(jobs_of_about_the_same_size_share),
		drm_test(a_job_larger_than_the_pool_takes_no_more_than_it_needs),
		drm_test(the_pool_gives_way_when_memory_is_short),
		drm_test(every_answer_of_every_ioctl_is_told),
		drm_test(a_job_that_the_kernel_refused_has_no_number),
		drm_test(the_memory_of_a_job_whose_wait_failed_is_not_used_again),
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
