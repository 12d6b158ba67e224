/* SPDX-License-Identifier: MIT */
/* Which calls wait for a board that stands still, and which do not. A call that ought not to is
 * made while the board is held, so that it would wait for ever: SIGALRM ends that. */
#include <unistd.h>

#include "usb_test.h"

#define QUEUED_MAX (4u << 20)
#define WORDS (QUEUED_MAX / 4 + 1000)

static struct messages messages;

static int setup(void **state)
{
	alarm(test_patience_s());
	fake_usb_start(test_seed());
	*state = device_open("usb:", &messages);
	return 0;
}

static int teardown(void **state)
{
	accel_device_free(*state);
	fake_usb_stop();
	alarm(0);
	return 0;
}

/* ---- a thread that waits in accel_stream_submit ---- */

struct sender {
	pthread_t thread;
	struct accel_stream *stream;
	_Atomic int sent;
};

static uint32_t nops[WORDS];

static void *send_in_thread(void *data)
{
	struct sender *sender = data;
	struct accel_fence *fence[2];

	for (int i = 0; i < 2; i++, sender->sent++) {
		assert_int_equal(accel_stream_emit(sender->stream, nops, WORDS), 0);
		assert_int_equal(accel_stream_submit(sender->stream, NULL, 0, &fence[i]), 0);
	}
	for (int i = 0; i < 2; i++) {
		assert_int_equal(accel_fence_wait(fence[i], -1, NULL, 0), 0);
		accel_fence_free(fence[i]);
	}
	return NULL;
}

/* The board does nothing from now on; the second job of the thread waits for room. */
static void start_sender(struct accel_device *device, struct sender *sender)
{
	sender->sent = 0;
	assert_int_equal(accel_stream_new(device, &sender->stream), 0);
	fake_usb_hold();
	assert_int_equal(pthread_create(&sender->thread, NULL, send_in_thread, sender), 0);
	while (sender->sent < 1)
		usleep(100);
	for (int i = 0; i < 100; i++)
		usleep(100);
}

static void join_sender(struct sender *sender)
{
	assert_int_equal(sender->sent, 1);
	fake_usb_release();
	pthread_join(sender->thread, NULL);
	accel_stream_free(sender->stream);
}

/* A job with a buffer of its own, which has ended but was not waited for. */
static struct accel_fence *ended_job(struct accel_device *device)
{
	struct accel_fence *fence, *later;
	struct accel_stream *stream;
	struct accel_buffer *buffer;
	uint32_t words[4];

	assert_int_equal(accel_buffer_new(device, 4096, &buffer), 0);
	assert_int_equal(accel_stream_new(device, &stream), 0);
	accel_stream_slot(stream, buffer, ACCEL_SLOT_WRITE);
	accel_stream_emit(stream, words, packet_write(words, 0, 0, 1));
	assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
	assert_int_equal(accel_stream_submit(stream, NULL, 0, &later), 0);
	assert_int_equal(accel_fence_wait(later, -1, NULL, 0), 0);
	accel_fence_free(later);
	accel_stream_free(stream);
	accel_buffer_free(buffer);
	return fence;
}

static void a_wait_of_no_time_does_not_wait_while_another_thread_submits(void **state)
{
	struct accel_fence *fence = ended_job(*state), *running;
	struct accel_stream *stream;
	struct sender sender;

	start_sender(*state, &sender);
	assert_int_equal(accel_fence_wait(fence, 0, NULL, 0), 0);
	accel_fence_free(fence);
	assert_int_equal(accel_stream_new(*state, &stream), 0);
	accel_stream_free(stream);
	join_sender(&sender);

	assert_int_equal(accel_stream_new(*state, &stream), 0);
	fake_usb_hold();
	assert_int_equal(accel_stream_submit(stream, NULL, 0, &running), 0);
	assert_int_equal(accel_fence_wait(running, 0, NULL, 0), -ETIMEDOUT);
	fake_usb_release();
	accel_fence_free(running);
	accel_stream_free(stream);
}

static void objects_come_and_go_while_another_thread_submits(void **state)
{
	struct accel_buffer *buffer, *all;
	struct accel_target *target;
	struct accel_draw *draw;
	struct sender sender;

	assert_int_equal(accel_buffer_new(*state, FAKE_USB_BOARD_BYTES, &all), 0);
	start_sender(*state, &sender);
	accel_buffer_free(all);
	assert_int_equal(accel_buffer_new(*state, FAKE_USB_BOARD_BYTES, &all), 0);
	accel_buffer_free(all);
	assert_int_equal(accel_buffer_new(*state, 4, &buffer), 0);
	assert_int_equal(accel_target_new(*state, 64, 64, &target), 0);
	assert_int_equal(accel_draw_new(*state, &draw), 0);
	accel_draw_free(draw);
	accel_target_free(target);
	accel_buffer_free(buffer);
	join_sender(&sender);
}

/* The one that frees it does not wait, and the next to have the range finds it zero. */
static void memory_may_go_while_it_is_being_cleared(void **state)
{
	struct accel_device *device = *state;
	struct accel_transport_error error = { "" };
	struct accel_transport_slot slot = { .rights = GLOSS_RIGHTS_WRITE };
	uint32_t stream[4], words[1024];
	const struct accel_transport_job job = {
		.stream = stream,
		.stream_words = (uint32_t)packet_write(stream, 0, 0, 7),
		.slot = &slot,
		.slots = 1,
	};
	struct gloss_status status;
	uint64_t sequence, object;
	void *board;

	accel_device_free(device);
	assert_int_equal(ops->open("", &board, &error), 0);
	assert_int_equal(ops->memory_new(board, sizeof(words), &slot.object), 0);
	fake_usb_hold();
	sequence = submit(board, &job);
	ops->memory_free(board, slot.object);
	assert_int_equal(ops->memory_new(board, sizeof(words), &object), 0);
	assert_int_equal(object, slot.object);
	fake_usb_release();
	assert_int_equal(wait_for(board, sequence, &status), 0);
	assert_int_equal(read_words(board, object, words, 1024), 0);
	for (int i = 0; i < 1024; i++)
		assert_int_equal(words[i], 0);
	ops->memory_free(board, object);
	ops->close(board);
	*state = device_open("usb:", &messages);
}

/* ---- a board that has less memory than it says ---- */

static uint32_t boast(struct gloss_usb_board *board, uint32_t offset)
{
	return offset == GLOSS_REG_MEMORY_PAGES ? 1u << 20 :
						  gloss_usb_board_model_t64.read(board, offset);
}

static int boaster_setup(void **state)
{
	static struct gloss_usb_board_ops boaster;

	alarm(test_patience_s());
	boaster = gloss_usb_board_model_t64;
	boaster.read = boast;
	fake_usb_start(test_seed());
	fake_usb_unplug(0);
	fake_usb.board[0].ops = &boaster;
	fake_usb_plug(0, true);
	*state = device_open("usb:", &messages);
	return 0;
}

static int boaster_teardown(void **state)
{
	return teardown(state);
}

#define BUFFERS 15

/* More words to clear them than may be queued at once. */
static struct accel_stream *stream_of_too_much_memory(struct accel_device *device)
{
	struct accel_buffer *buffer;
	struct accel_stream *stream;

	assert_int_equal(accel_stream_new(device, &stream), 0);
	for (int i = 0; i < BUFFERS; i++) {
		assert_int_equal(accel_buffer_new(device, 256u << 20, &buffer), 0);
		assert_in_range(accel_stream_slot(stream, buffer, ACCEL_SLOT_READ), 0, 15);
		accel_buffer_free(buffer);
	}
	return stream;
}

static void a_submit_ends_though_clearing_fails_for_ever(void **state)
{
	struct accel_stream *stream = stream_of_too_much_memory(*state);
	struct accel_fence *fence;
	int err;

	err = accel_stream_submit(stream, NULL, 0, &fence);
	if (!err) {
		err = accel_fence_wait(fence, -1, NULL, 0);
		accel_fence_free(fence);
	}
	assert_int_equal(err, -EIO);
	assert_in_range(fake_usb.resets, 2, 8);
	accel_stream_free(stream);
}

static void a_board_that_fails_again_and_again_is_given_up(void **state)
{
	struct accel_buffer *buffer;
	uint32_t word;
	int err = -EIO, calls = 0;

	assert_int_equal(accel_buffer_new(*state, 1u << 30, &buffer), 0);
	for (; err == -EIO; calls++)
		err = accel_buffer_read(buffer, 0, &word, sizeof(word));
	assert_int_equal(err, -ENODEV);
	assert_in_range(calls, 2, 20);
	assert_in_range(fake_usb.resets, 10, 40);
	accel_buffer_free(buffer);
}

#define wait_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
#define boaster_test(name) cmocka_unit_test_setup_teardown(name, boaster_setup, boaster_teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		wait_test(a_wait_of_no_time_does_not_wait_while_another_thread_submits),
		wait_test(objects_come_and_go_while_another_thread_submits),
		wait_test(memory_may_go_while_it_is_being_cleared),
		boaster_test(a_submit_ends_though_clearing_fails_for_ever),
		boaster_test(a_board_that_fails_again_and_again_is_given_up),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
