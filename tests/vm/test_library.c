// SPDX-License-Identifier: MIT
/*
 * The library when its board fails: the guilty job is told, threads that wait are woken, and
 * nothing crashes on memory of a board that has gone. As root, for the board's fault window.
 */
#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "accel.h"
#include "vboard/pci/faults.h"
#include "gloss_packets.h"
#include "vm_board.h"
#include "vm_test.h"

#define WAITERS 4

static const char *pci;
static char node[BOARD_PATH];
static volatile uint32_t *window;
static struct accel_device *device;
static struct accel_buffer *buffer;
static char message[512];

static void keep_message(void *data, const char *line)
{
	(void)data;
	snprintf(message, sizeof(message), "%s", line);
}

static void arm(uint32_t fault, uint32_t value)
{
	window[fault / 4] = value;
}

static int setup(void **state)
{
	char name[BOARD_PATH + 4];

	(void)state;
	pci = vm_env("GLOSS_PCI_MODEL");
	assert_int_equal(board_node(pci, vm_patience_ms(), node), 0);
	window = vm_faults("GLOSS_PCI_MODEL");
	snprintf(name, sizeof(name), "drm:%s", node);
	return accel_device_new(name, keep_message, NULL, &device) ||
	       accel_buffer_new(device, 4096, &buffer);
}

static int teardown(void **state)
{
	(void)state;
	accel_buffer_free(buffer);
	accel_device_free(device);
	return 0;
}

static void the_board_works(void)
{
	const uint32_t value = (uint32_t)clock();
	uint32_t back = ~value;

	assert_int_equal(accel_buffer_write(buffer, 4, &value, sizeof(value)), 0);
	assert_int_equal(accel_buffer_read(buffer, 4, &back, sizeof(back)), 0);
	assert_int_equal(back, value);
}

/* An empty job that nobody has waited for yet. */
static struct accel_fence *start(void)
{
	struct accel_fence *fence = NULL;
	struct accel_stream *stream;

	assert_int_equal(accel_stream_new(device, &stream), 0);
	assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
	accel_stream_free(stream);
	return fence;
}

/* ---- failures that the driver brings the board back from ---- */

static void fails_alone(uint32_t fault)
{
	struct accel_fence *fence[3];
	struct accel_fence_status status;
	int failed = 0;

	vm_expect("gloss ");
	arm(fault, 2);
	for (int i = 0; i < 3; i++)
		fence[i] = start();
	for (int i = 0; i < 3; i++) {
		int err = accel_fence_wait(fence[i], vm_patience_ms() * 1000000ll, &status,
					   sizeof(status));

		assert_int_equal(status.fault, GLOSS_FAULT_NONE);
		assert_true(!err || err == -EIO);
		failed += err != 0;
		accel_fence_free(fence[i]);
	}
	assert_int_equal(failed, 1);
	assert_string_equal(message, "the board failed and was reset");
	vm_expect_end();
	the_board_works();
}

static void a_job_that_hangs_fails_alone(void **state)
{
	(void)state;
	fails_alone(VBOARD_FAULT_HANG);
}

static void a_job_whose_dma_is_refused_fails_alone(void **state)
{
	(void)state;
	fails_alone(VBOARD_FAULT_REFUSE_DMA);
}

static void a_lost_interrupt_loses_no_job(void **state)
{
	(void)state;
	vm_expect("gloss ");
	arm(VBOARD_FAULT_LOSE_INTERRUPTS, 1);
	the_board_works();
	vm_expect_end();
	the_board_works();
}

/* Whether waits for a slow job timed out; it may have ended before them. */
static bool slow_job_times_out(void)
{
	const int64_t wait_ns[] = { 0, 20000000 };
	struct accel_fence *fence = start();
	bool late = true;

	for (int i = 0; i < 2; i++) {
		int err = accel_fence_wait(fence, wait_ns[i], NULL, 0);

		assert_true(!err || err == -ETIMEDOUT);
		late = late && err;
	}
	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
	accel_fence_free(fence);
	return late;
}

/* Not as long as a hang, and a busy machine may sleep through it: seen once is enough. */
static void a_slow_job_times_out_and_ends(void **state)
{
	bool late = false;

	(void)state;
	arm(VBOARD_FAULT_SLOW, 400000);
	for (int i = 0; i < 20 && !late; i++)
		late = slow_job_times_out();
	arm(VBOARD_FAULT_SLOW, 0);
	assert_true(late);
}

/* ---- fences as files ---- */

static bool readable(int fd, int timeout_ms)
{
	struct pollfd file = { .fd = fd, .events = POLLIN };

	return poll(&file, 1, timeout_ms) == 1 && file.revents == POLLIN;
}

static void a_fence_is_a_sync_file_too(void **state)
{
	enum { JOBS = 32 }; /* 13 seconds of them, for a busy machine to look once */
	struct accel_fence *fence[JOBS];
	int fd[JOBS + 1];

	(void)state;
	arm(VBOARD_FAULT_SLOW, 400000);
	for (int i = 0; i < JOBS; i++) {
		fence[i] = start();
		fd[i] = accel_fence_fd(fence[i]);
		assert_true(fd[i] >= 0);
	}
	/* The board works on the first. */
	assert_false(readable(fd[JOBS - 1], 0));
	assert_int_equal(accel_fence_wait(fence[JOBS - 1], 0, NULL, 0), -ETIMEDOUT);
	arm(VBOARD_FAULT_SLOW, 0);
	/* The last one's end is that of all, and a file may outlive its fence. */
	assert_true(readable(fd[JOBS - 1], vm_patience_ms()));
	for (int i = 0; i < JOBS; i++)
		assert_int_equal(accel_fence_wait(fence[i], 0, NULL, 0), 0);
	fd[JOBS] = accel_fence_fd(fence[0]);
	for (int i = 0; i < JOBS; i++)
		accel_fence_free(fence[i]);
	for (int i = 0; i < JOBS + 1; i++) {
		assert_true(readable(fd[i], 0));
		close(fd[i]);
	}
}

static void nobody_waits_for_a_job_without_a_fence(void **state)
{
	const uint32_t unknown = 0xff000000;
	struct accel_stream *stream;

	(void)state;
	assert_int_equal(accel_stream_new(device, &stream), 0);
	arm(VBOARD_FAULT_SLOW, 400000);
	assert_int_equal(accel_stream_submit(stream, NULL, 0, NULL), 0);
	assert_int_equal(accel_stream_emit(stream, &unknown, 1), 0);
	assert_int_equal(accel_stream_submit(stream, NULL, 0, NULL), 0);
	arm(VBOARD_FAULT_SLOW, 0);
	assert_int_equal(accel_device_finish(device), -EIO);
	assert_int_equal(accel_device_finish(device), 0);
	accel_stream_free(stream);
	the_board_works();
}

/* ---- a board that goes ---- */

static void *wait_for(void *fence)
{
	return (void *)(intptr_t)accel_fence_wait(fence, -1, NULL, 0);
}

static void everything_is_enodev(void)
{
	struct accel_stream *stream;
	struct accel_buffer *other;
	uint32_t words[64] = { 0 };

	assert_int_equal(accel_buffer_new(device, 4096, &other), -ENODEV);
	assert_int_equal(accel_buffer_write(buffer, 0, words, sizeof(words)), -ENODEV);
	assert_int_equal(accel_buffer_read(buffer, 0, words, sizeof(words)), -ENODEV);
	assert_int_equal(accel_stream_new(device, &stream), 0);
	assert_int_equal(accel_stream_emit(stream, words, 64), 0);
	assert_int_equal(accel_stream_finish(stream, NULL, 0), -ENODEV);
	accel_stream_free(stream);
}

static void come_back(void **state)
{
	teardown(state);
	assert_int_equal(board_rescan(), 0);
	assert_int_equal(setup(state), 0);
	the_board_works();
}

static void a_board_that_dies_wakes_every_thread(void **state)
{
	pthread_t thread[WAITERS];
	struct accel_fence *fence[WAITERS];
	void *answer;
	int gone = 0;

	the_board_works();
	vm_expect("gloss |pci");
	arm(VBOARD_FAULT_SLOW, 400000);
	for (int i = 0; i < WAITERS; i++) {
		fence[i] = start();
		assert_int_equal(pthread_create(&thread[i], NULL, wait_for, fence[i]), 0);
	}
	arm(VBOARD_FAULT_DIE, VBOARD_FAULT_DIE_NOW);
	for (int i = 0; i < WAITERS; i++) {
		pthread_join(thread[i], &answer);
		assert_true(!answer || (intptr_t)answer == -ENODEV);
		gone += answer != NULL;
		accel_fence_free(fence[i]);
	}
	assert_true(gone > 0);
	everything_is_enodev();
	arm(VBOARD_FAULT_SLOW, 0);
	arm(VBOARD_FAULT_DIE, 0);
	assert_int_equal(board_remove(pci), 0);
	everything_is_enodev();
	come_back(state);
	vm_expect_end();
}

/* What the library had mapped is still written to by a job that can not be sent. */
static void a_board_that_is_pulled_out_ends_every_call(void **state)
{
	struct accel_fence *fence[WAITERS];
	int gone = 0;

	the_board_works();
	vm_expect("gloss |pci");
	arm(VBOARD_FAULT_SLOW, 400000);
	for (int i = 0; i < WAITERS; i++)
		fence[i] = start();
	assert_int_equal(board_remove(pci), 0);
	for (int i = 0; i < WAITERS; i++) {
		int err = accel_fence_wait(fence[i], vm_patience_ms() * 1000000ll, NULL, 0);

		assert_true(!err || err == -ENODEV);
		gone += err != 0;
		accel_fence_free(fence[i]);
	}
	assert_true(gone > 0);
	everything_is_enodev();
	come_back(state);
	arm(VBOARD_FAULT_SLOW, 0);
	vm_expect_end();
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_job_that_hangs_fails_alone),
		cmocka_unit_test(a_job_whose_dma_is_refused_fails_alone),
		cmocka_unit_test(a_lost_interrupt_loses_no_job),
		cmocka_unit_test(a_slow_job_times_out_and_ends),
		cmocka_unit_test(a_fence_is_a_sync_file_too),
		cmocka_unit_test(nobody_waits_for_a_job_without_a_fence),
		cmocka_unit_test(a_board_that_dies_wakes_every_thread),
		cmocka_unit_test(a_board_that_is_pulled_out_ends_every_call),
	};

	return cmocka_run_group_tests(tests, setup, teardown);
}
