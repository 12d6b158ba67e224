/* SPDX-License-Identifier: MIT */
/* Jobs that nobody waits for, and accel_device_finish, on a board that works when it is let to. */
#include <pthread.h>
#include <stdatomic.h>

#include "transport/usb_test.h"

#define THREADS 8
#define JOBS 200

struct fixture {
	struct messages messages;
	struct accel_device *device;
	struct accel_stream *stream;
	struct accel_buffer *buffer;
};

static int setup(void **state)
{
	static struct fixture f;

	fake_usb_start(1);
	f.device = device_open("usb:", &f.messages);
	assert_int_equal(accel_stream_new(f.device, &f.stream), 0);
	assert_int_equal(accel_buffer_new(f.device, 4096, &f.buffer), 0);
	*state = &f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	fake_usb_release();
	accel_buffer_free(f->buffer);
	accel_stream_free(f->stream);
	accel_device_free(f->device);
	fake_usb_stop();
	return 0;
}

/* A job that writes a word, and that nobody waits for. */
static int write_detached(struct accel_stream *stream, struct accel_buffer *buffer, uint32_t value)
{
	uint32_t packet[4];
	int err = accel_stream_slot(stream, buffer, ACCEL_SLOT_WRITE);

	if (!err)
		err = accel_stream_emit(stream, packet, packet_write(packet, 0, 0, value));
	return err ? err : accel_stream_submit(stream, NULL, 0, NULL);
}

static int fail_detached(struct accel_stream *stream)
{
	const uint32_t unknown = 0xff000000;
	int err = accel_stream_emit(stream, &unknown, 1);

	return err ? err : accel_stream_submit(stream, NULL, 0, NULL);
}

static void a_submit_without_a_fence_does_not_wait(void **state)
{
	struct fixture *f = *state;
	uint32_t word = 0;

	/* The board does nothing, so a call that waited would not return. */
	fake_usb_hold();
	for (uint32_t value = 1; value <= 5; value++)
		assert_int_equal(write_detached(f->stream, f->buffer, value), 0);
	fake_usb_release();
	assert_int_equal(accel_device_finish(f->device), 0);
	assert_int_equal(accel_buffer_read(f->buffer, 0, &word, 4), 0);
	assert_int_equal(word, 5);
}

static void a_response_needs_a_fence(void **state)
{
	struct fixture *f = *state;
	uint32_t response;

	assert_int_equal(accel_stream_submit(f->stream, &response, 1, NULL), -EINVAL);
	assert_message(&f->messages, "a response that nobody waits for");
	assert_int_equal(accel_stream_finish(f->stream, &response, 1), 0);
}

static void finish_tells_of_the_first_that_failed_once(void **state)
{
	struct fixture *f = *state;

	assert_int_equal(accel_device_finish(f->device), 0);
	assert_int_equal(write_detached(f->stream, f->buffer, 1), 0);
	assert_int_equal(fail_detached(f->stream), 0);
	assert_int_equal(write_detached(f->stream, f->buffer, 2), 0);
	assert_int_equal(accel_device_finish(f->device), -EIO);
	assert_message(&f->messages, "unknown opcode");
	assert_int_equal(accel_device_finish(f->device), 0);
	/* Also if it was noticed before. */
	assert_int_equal(fail_detached(f->stream), 0);
	for (int i = 0; i < 10; i++)
		assert_int_equal(accel_stream_finish(f->stream, NULL, 0), 0);
	assert_int_equal(accel_device_finish(f->device), -EIO);
	assert_int_equal(accel_device_finish(f->device), 0);
}

static void of_jobs_with_a_fence_finish_says_nothing(void **state)
{
	const uint32_t unknown = 0xff000000;
	struct fixture *f = *state;
	struct accel_fence *fence;

	assert_int_equal(accel_stream_emit(f->stream, &unknown, 1), 0);
	assert_int_equal(accel_stream_submit(f->stream, NULL, 0, &fence), 0);
	assert_int_equal(accel_device_finish(f->device), 0);
	assert_int_equal(accel_fence_wait(fence, 0, NULL, 0), -EIO);
	accel_fence_free(fence);
}

/* Memory of a buffer that the program has freed goes to another only when its job has ended. */
static void a_buffer_stays_until_its_job_has_ended(void **state)
{
	struct fixture *f = *state;
	struct accel_buffer *half, *other;
	uint32_t word = 1;

	assert_int_equal(accel_buffer_new(f->device, FAKE_USB_BOARD_BYTES / 2, &half), 0);
	fake_usb_hold();
	assert_int_equal(write_detached(f->stream, half, 7), 0);
	accel_buffer_free(half);
	assert_int_equal(accel_buffer_new(f->device, FAKE_USB_BOARD_BYTES / 2, &other), -ENOMEM);
	fake_usb_release();
	assert_int_equal(accel_device_finish(f->device), 0);
	assert_int_equal(accel_buffer_new(f->device, FAKE_USB_BOARD_BYTES / 2, &other), 0);
	assert_int_equal(accel_buffer_read(other, 0, &word, 4), 0);
	assert_int_equal(word, 0);
	accel_buffer_free(other);
}

/* Nobody ever calls accel_device_finish. */
static void jobs_that_have_ended_do_not_pile_up(void **state)
{
	struct fixture *f = *state;
	struct accel_buffer *half;

	for (int n = 0; n < 50; n++) {
		assert_int_equal(accel_buffer_new(f->device, FAKE_USB_BOARD_BYTES / 2, &half), 0);
		assert_int_equal(write_detached(f->stream, half, 7), 0);
		accel_buffer_free(half);
		assert_int_equal(accel_stream_finish(f->stream, NULL, 0), 0);
	}
}

/* What is given back, and in which order; the sanitizers and fake_usb_stop() see to it. */
static void a_device_may_go_before_its_jobs_have_ended(void **state)
{
	struct fixture *f = *state;
	struct accel_buffer *buffer;
	struct messages messages;
	struct accel_stream *stream;
	struct accel_device *device = device_open("model:", &messages);

	(void)f;
	assert_int_equal(accel_stream_new(device, &stream), 0);
	assert_int_equal(accel_buffer_new(device, 4096, &buffer), 0);
	for (uint32_t n = 0; n < JOBS; n++)
		assert_int_equal(write_detached(stream, buffer, n), 0);
	assert_int_equal(fail_detached(stream), 0);
	accel_device_free(device);
	accel_buffer_free(buffer);
	accel_stream_free(stream);
	/* The last free waits, and so has seen the failure. */
	assert_message(&messages, "unknown opcode");
}

/* ---- threads ---- */

static atomic_bool finished;

static void *finish(void *data)
{
	int err = accel_device_finish(data);

	atomic_store(&finished, true);
	return err ? "accel_device_finish failed" : NULL;
}

static void finish_waits_for_jobs_of_other_threads(void **state)
{
	struct fixture *f = *state;
	struct accel_fence *fence;
	pthread_t thread;
	void *wrong;

	atomic_store(&finished, false);
	fake_usb_hold();
	assert_int_equal(accel_stream_submit(f->stream, NULL, 0, &fence), 0);
	assert_int_equal(pthread_create(&thread, NULL, finish, f->device), 0);
	assert_int_equal(accel_fence_wait(fence, 20000000, NULL, 0), -ETIMEDOUT);
	assert_false(atomic_load(&finished));
	fake_usb_release();
	pthread_join(thread, &wrong);
	assert_null(wrong);
	assert_int_equal(accel_fence_wait(fence, 0, NULL, 0), 0);
	accel_fence_free(fence);
}

static void *submit_and_finish(void *data)
{
	struct accel_device *device = data;
	struct accel_buffer *buffer = NULL;
	struct accel_stream *stream;
	int err = accel_stream_new(device, &stream);

	if (err)
		return "no stream";
	for (uint32_t n = 0; n < JOBS && !err; n++) {
		if (n % 10 == 0) {
			accel_buffer_free(buffer);
			buffer = NULL;
			err = accel_buffer_new(device, 4096, &buffer);
		}
		if (!err)
			err = write_detached(stream, buffer, n);
		if (!err && n % 50 == 49)
			err = accel_device_finish(device);
	}
	accel_buffer_free(buffer);
	accel_stream_free(stream);
	return err ? "a job failed" : NULL;
}

static void threads_submit_without_fences(void **state)
{
	struct accel_device *device;
	struct messages messages;
	pthread_t thread[THREADS];
	void *wrong;

	(void)state;
	device = device_open("model:", &messages);
	for (int i = 0; i < THREADS; i++)
		assert_int_equal(pthread_create(&thread[i], NULL, submit_and_finish, device), 0);
	for (int i = 0; i < THREADS; i++) {
		pthread_join(thread[i], &wrong);
		assert_null(wrong);
	}
	accel_device_free(device);
}

static atomic_bool stop;

static void *submit_on_and_on(void *data)
{
	struct accel_stream *stream;
	int err = accel_stream_new(data, &stream);

	if (err)
		return "no stream";
	/* Not for ever: nothing but memory bounds how many empty jobs wait. */
	for (int n = 0; n < 5000 && !err && !atomic_load(&stop); n++)
		err = accel_stream_submit(stream, NULL, 0, NULL);
	accel_stream_free(stream);
	return err ? "a job failed" : NULL;
}

static void finish_ends_though_others_submit_on(void **state)
{
	struct accel_device *device;
	struct messages messages;
	pthread_t thread[2];
	void *wrong;

	(void)state;
	atomic_store(&stop, false);
	device = device_open("model:", &messages);
	for (int i = 0; i < 2; i++)
		assert_int_equal(pthread_create(&thread[i], NULL, submit_on_and_on, device), 0);
	for (int i = 0; i < 20; i++)
		assert_int_equal(accel_device_finish(device), 0);
	atomic_store(&stop, true);
	for (int i = 0; i < 2; i++) {
		pthread_join(thread[i], &wrong);
		assert_null(wrong);
	}
	accel_device_free(device);
}

/* ---- a message function may call the library ---- */

struct caller {
	struct accel_device *device;
	int messages;
};

static void call_again(void *data, const char *line)
{
	struct caller *caller = data;

	(void)line;
	caller->messages++;
	accel_device_finish(caller->device);
}

static void the_message_of_a_failure_may_call_finish(void **state)
{
	struct caller caller = { NULL, 0 };
	struct accel_stream *stream;

	(void)state;
	assert_int_equal(accel_device_new("model:", call_again, &caller, &caller.device), 0);
	assert_int_equal(accel_stream_new(caller.device, &stream), 0);
	assert_int_equal(fail_detached(stream), 0);
	assert_int_equal(accel_device_finish(caller.device), -EIO);
	assert_int_equal(caller.messages, 1);
	accel_stream_free(stream);
	accel_device_free(caller.device);
}

#define detached_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		detached_test(a_submit_without_a_fence_does_not_wait),
		detached_test(a_response_needs_a_fence),
		detached_test(finish_tells_of_the_first_that_failed_once),
		detached_test(of_jobs_with_a_fence_finish_says_nothing),
		detached_test(a_buffer_stays_until_its_job_has_ended),
		detached_test(jobs_that_have_ended_do_not_pile_up),
		detached_test(a_device_may_go_before_its_jobs_have_ended),
		detached_test(finish_waits_for_jobs_of_other_threads),
		cmocka_unit_test(threads_submit_without_fences),
		cmocka_unit_test(finish_ends_though_others_submit_on),
		cmocka_unit_test(the_message_of_a_failure_may_call_finish),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
