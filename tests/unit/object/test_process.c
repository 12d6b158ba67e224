/* SPDX-License-Identifier: MIT */
/* What a program may do to the threads and processes that use the library: end a thread within a
 * call, fork. What would hang is ended by SIGALRM. */
#include <unistd.h>

#include "child_test.h"
#include "transport/usb_test.h"

#define WORDS (1u << 20)

/* A device, and a job that takes it a while. */
struct fixture {
	const char *name;
	struct messages messages;
	struct accel_device *device;
	struct accel_buffer *buffer;
	struct accel_stream *stream;
	struct accel_fence *fence;
	_Atomic bool waiting;
};

static struct fixture fixture;
static uint32_t nops[WORDS];

static int setup(const char *name)
{
	alarm(test_patience_s());
	fake_usb_start(test_seed());
	fixture = (struct fixture){ .name = name };
	fixture.device = device_open(name, &fixture.messages);
	assert_int_equal(accel_buffer_new(fixture.device, 4096, &fixture.buffer), 0);
	assert_int_equal(accel_stream_new(fixture.device, &fixture.stream), 0);
	fake_usb_hold();
	assert_int_equal(accel_stream_emit(fixture.stream, nops, WORDS), 0);
	assert_int_equal(accel_stream_submit(fixture.stream, NULL, 0, &fixture.fence), 0);
	return 0;
}

static int setup_model(void **state)
{
	(void)state;
	return setup("model:");
}

static int setup_usb(void **state)
{
	(void)state;
	return setup("usb:");
}

static int teardown(void **state)
{
	(void)state;
	fake_usb_release();
	accel_fence_free(fixture.fence);
	accel_stream_free(fixture.stream);
	accel_buffer_free(fixture.buffer);
	accel_device_free(fixture.device);
	fake_usb_stop();
	alarm(0);
	return 0;
}

static void assert_device_works(void)
{
	uint32_t word = 5;

	assert_int_equal(accel_buffer_write(fixture.buffer, 0, &word, sizeof(word)), 0);
	word = 0;
	assert_int_equal(accel_buffer_read(fixture.buffer, 0, &word, sizeof(word)), 0);
	assert_int_equal(word, 5);
}

/* ---- threads that are ended ---- */

/* Where a thread ends that is cancelled, also if its job had ended before. */
static void end_here(void)
{
	for (;;)
		pause();
}

static void *wait_in_fence(void *data)
{
	(void)data;
	fixture.waiting = true;
	assert_int_equal(accel_fence_wait(fixture.fence, -1, NULL, 0), 0);
	end_here();
	return NULL;
}

static void *read_buffer(void *data)
{
	uint32_t word;

	(void)data;
	fixture.waiting = true;
	assert_int_equal(accel_buffer_read(fixture.buffer, 0, &word, sizeof(word)), 0);
	end_here();
	return NULL;
}

static void cancel_in(void *(*call)(void *))
{
	pthread_t thread;
	void *result;

	assert_int_equal(pthread_create(&thread, NULL, call, NULL), 0);
	while (!fixture.waiting)
		usleep(100);
	usleep(10000);
	assert_int_equal(pthread_cancel(thread), 0);
	usleep(1000);
	fake_usb_release();
	pthread_join(thread, &result);
	assert_ptr_equal(result, PTHREAD_CANCELED);
	assert_device_works();
}

static void a_thread_may_be_cancelled_while_it_waits(void **state)
{
	(void)state;
	cancel_in(wait_in_fence);
}

static void a_thread_may_be_cancelled_while_it_reads(void **state)
{
	(void)state;
	cancel_in(read_buffer);
}

/* ---- a child of fork ---- */

/* 0, or the line of what went wrong. */
#define must(condition)                        \
	do {                                   \
		if (!(condition))              \
			return __LINE__ % 256; \
	} while (0)

static int use_all_in_child(void)
{
	struct accel_device_clocks clocks;
	struct accel_buffer *buffer;
	struct accel_target *target;
	struct accel_stream *stream;
	struct accel_fence *fence;
	uint32_t word = 1;
	int err;

	must(accel_fence_wait(fixture.fence, -1, NULL, 0) == -ENODEV);
	must(accel_fence_wait(fixture.fence, 0, NULL, 0) == -ENODEV);
	must(accel_buffer_new(fixture.device, 4, &buffer) == -ENODEV);
	must(accel_target_new(fixture.device, 64, 64, &target) == -ENODEV);
	must(accel_buffer_write(fixture.buffer, 0, &word, 4) == -ENODEV);
	must(accel_buffer_read(fixture.buffer, 0, &word, 4) == -ENODEV);
	err = accel_device_clocks(fixture.device, &clocks, sizeof(clocks));
	must(err == -ENODEV || err == -ENOTSUP);
	must(accel_stream_new(fixture.device, &stream) == 0);
	must(accel_stream_slot(stream, fixture.buffer, ACCEL_SLOT_READ) == 0);
	must(accel_stream_submit(stream, NULL, 0, &fence) == -ENODEV);
	must(accel_stream_submit(stream, NULL, 0, NULL) == -ENODEV);
	must(accel_stream_finish(stream, NULL, 0) == -ENODEV);
	must(accel_device_finish(fixture.device) == -ENODEV);
	err = accel_fence_fd(fixture.fence);
	must(err == -ENODEV || err == -ENOTSUP);
	accel_stream_free(stream);
	return 0;
}

static int free_all_in_child(void)
{
	accel_fence_free(fixture.fence);
	accel_stream_free(fixture.stream);
	accel_buffer_free(fixture.buffer);
	accel_device_free(fixture.device);
	return 0;
}

static void a_child_is_refused_and_frees_what_it_has(void **state)
{
	(void)state;
	assert_int_equal(child_run(use_all_in_child, test_patience_s() / 2), 0);
	assert_int_equal(child_run(free_all_in_child, test_patience_s() / 2), 0);
	fake_usb_release();
	assert_int_equal(accel_fence_wait(fixture.fence, -1, NULL, 0), 0);
	assert_device_works();
}

/* clang-format off */
#define both(name)                                                                                 \
	{ #name " (model:)", name, setup_model, teardown, NULL },                                  \
	{ #name " (usb:)", name, setup_usb, teardown, NULL }
/* clang-format on */

int main(void)
{
	const struct CMUnitTest tests[] = {
		both(a_thread_may_be_cancelled_while_it_waits),
		both(a_thread_may_be_cancelled_while_it_reads),
		both(a_child_is_refused_and_frees_what_it_has),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
