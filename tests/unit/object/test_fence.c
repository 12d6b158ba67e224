/* SPDX-License-Identifier: MIT */
/* Fences on a board whose answers the test chooses; faults on the model. */
#include <unistd.h>

#include "accel_priv.h"
#include "accel_test.h"

/* ---- a board that answers as it is told ---- */

struct board {
	int submit, wait; /* answers */
	int waits, memories;
	int timeout_at; /* the wait that is a time-out, 0: none */
	int change_at;  /* after so many waits the status is changed; 0: never */
	struct gloss_status changed;
	int64_t timeout; /* of the last wait */
	struct gloss_status status;
};

static void board_close(void *state)
{
	struct board *board = state;

	assert_int_equal(board->memories, 0);
}

static int board_memory_new(void *state, uint64_t size, uint64_t *object)
{
	struct board *board = state;

	(void)size;
	*object = (uint64_t)++board->memories;
	return 0;
}

static void board_memory_free(void *state, uint64_t object)
{
	struct board *board = state;

	(void)object;
	board->memories--;
}

static int board_submit(void *state, const struct accel_transport_job *job, uint64_t *sequence)
{
	struct board *board = state;

	(void)job;
	*sequence = 42;
	return board->submit;
}

static int board_wait(void *state, uint64_t sequence, int64_t timeout_ns,
		      struct gloss_status *status)
{
	struct board *board = state;

	assert_int_equal(sequence, 42);
	board->waits++;
	board->timeout = timeout_ns;
	*status = board->change_at && board->waits > board->change_at ? board->changed :
									board->status;
	return board->waits == board->timeout_at ? -ETIMEDOUT : board->wait;
}

static const struct accel_transport_ops board_ops = {
	.close = board_close,
	.memory_new = board_memory_new,
	.memory_free = board_memory_free,
	.submit = board_submit,
	.wait = board_wait,
};

struct fixture {
	struct messages messages;
	struct board board;
	struct accel_device *device;
	struct accel_stream *stream;
};

static int setup(void **state)
{
	struct fixture *fixture = calloc(1, sizeof(*fixture));

	fixture->device = calloc(1, sizeof(*fixture->device));
	fixture->device->ops = &board_ops;
	fixture->device->state = &fixture->board;
	fixture->device->message = messages_take;
	fixture->device->message_data = &fixture->messages;
	fixture->device->process = getpid();
	fixture->device->references = 1;
	pthread_mutex_init(&fixture->device->lock, NULL);
	*state = fixture;
	return accel_stream_new(fixture->device, &fixture->stream);
}

static int teardown(void **state)
{
	struct fixture *fixture = *state;

	accel_stream_free(fixture->stream);
	accel_device_free(fixture->device);
	free(fixture);
	return 0;
}

static struct accel_fence *submit(struct fixture *fixture)
{
	struct accel_fence *fence = NULL;

	assert_int_equal(accel_stream_submit(fixture->stream, NULL, 0, &fence), 0);
	return fence;
}

static void a_second_wait_gives_the_same_answer(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence *fence = submit(fixture);
	struct accel_fence_status first, second = { 0, 0, 0 };

	fixture->board.status = (struct gloss_status){ GLOSS_FAULT_SLOT, 17, 3 };
	assert_int_equal(accel_fence_wait(fence, -1, &first, sizeof(first)), -EIO);
	fixture->board.status = (struct gloss_status){ GLOSS_FAULT_NONE, 0, 0 };
	assert_int_equal(accel_fence_wait(fence, -1, &second, sizeof(second)), -EIO);
	assert_int_equal(second.fault, GLOSS_FAULT_SLOT);
	assert_int_equal(second.offset, 17);
	assert_int_equal(second.response_words, 3);
	assert_int_equal(fixture->board.waits, 1);
	assert_int_equal(fixture->messages.count, 1);
	assert_message(&fixture->messages, "word 17");
	accel_fence_free(fence);
	assert_int_equal(fixture->board.waits, 1);
}

static void a_timeout_is_not_the_end(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence_status status = { 7, 8, 9 };
	struct accel_fence *fence = submit(fixture);

	fixture->board.wait = -ETIMEDOUT;
	assert_int_equal(accel_fence_wait(fence, 1234, &status, sizeof(status)), -ETIMEDOUT);
	assert_int_equal(fixture->board.timeout, 1234);
	assert_int_equal(status.offset, 8);
	fixture->board.wait = 0;
	assert_int_equal(accel_fence_wait(fence, 0, &status, sizeof(status)), 0);
	assert_int_equal(status.offset, 0);
	assert_int_equal(fixture->messages.count, 0);
	accel_fence_free(fence);
}

static void free_waits_for_ever(void **state)
{
	struct fixture *fixture = *state;

	accel_fence_free(submit(fixture));
	assert_int_equal(fixture->board.waits, 1);
	assert_true(fixture->board.timeout < 0);
}

static void a_board_that_failed_is_told_from_a_fault(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence_status status = { 9, 9, 9 };
	struct accel_fence *fence = submit(fixture);

	fixture->board.wait = -EIO;
	fixture->board.status = (struct gloss_status){ GLOSS_FAULT_SLOT, 1, 1 };
	assert_int_equal(accel_fence_wait(fence, -1, &status, sizeof(status)), -EIO);
	assert_int_equal(status.fault, 0);
	assert_int_equal(status.response_words, 0);
	assert_message(&fixture->messages, "the board failed and was reset");
	accel_fence_free(fence);
}

static void a_board_that_is_gone_ends_the_job(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence *fence = submit(fixture);

	fixture->board.wait = -ENODEV;
	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), -ENODEV);
	fixture->board.wait = 0;
	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), -ENODEV);
	assert_message(&fixture->messages, "the job was lost");
	accel_fence_free(fence);
}

static void a_job_that_is_not_taken_has_no_fence(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence *fence = NULL;
	const uint32_t word = 0;
	size_t count;

	fixture->board.submit = -ENODEV;
	accel_stream_emit(fixture->stream, &word, 1);
	assert_int_equal(accel_stream_submit(fixture->stream, NULL, 0, &fence), -ENODEV);
	assert_null(fence);
	assert_int_equal(fixture->board.waits, 0);
	assert_message(&fixture->messages, "a job was not taken");
	accel_stream_words(fixture->stream, &count);
	assert_int_equal(count, 1);
}

static void buffers_of_a_job_go_when_it_has_ended(void **state)
{
	struct fixture *fixture = *state;
	struct accel_buffer *buffer;
	struct accel_fence *fence;

	assert_int_equal(accel_buffer_new(fixture->device, 4, &buffer), 0);
	accel_stream_slot(fixture->stream, buffer, ACCEL_SLOT_READ);
	fence = submit(fixture);
	accel_buffer_free(buffer);
	fixture->board.wait = -ETIMEDOUT;
	accel_fence_wait(fence, 0, NULL, 0);
	assert_int_equal(fixture->board.memories, 1);
	fixture->board.wait = 0;
	accel_fence_wait(fence, 0, NULL, 0);
	assert_int_equal(fixture->board.memories, 0);
	accel_fence_free(fence);
}

/* ---- a fence of several jobs ---- */

static struct accel_fence *send_three(struct fixture *fixture)
{
	struct accel_fence *fence = accel_fence_new(fixture->device);

	assert_non_null(fence);
	for (int i = 0; i < 3; i++)
		assert_int_equal(accel_stream_send(fixture->stream, NULL, 0, fence), 0);
	assert_int_equal(fixture->board.waits, 0);
	return fence;
}

static void a_fence_of_several_jobs_waits_for_all(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence *fence = send_three(fixture);

	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
	assert_int_equal(fixture->board.waits, 3);
	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
	assert_int_equal(fixture->board.waits, 3);
	accel_fence_free(fence);
}

static void a_fence_of_several_jobs_tells_of_the_first_that_failed(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence *fence = send_three(fixture);
	struct accel_fence_status status;

	fixture->board.status = (struct gloss_status){ GLOSS_FAULT_SLOT, 17, 3 };
	fixture->board.change_at = 1;
	fixture->board.changed = (struct gloss_status){ GLOSS_FAULT_NONE, 4, 0 };
	assert_int_equal(accel_fence_wait(fence, -1, &status, sizeof(status)), -EIO);
	assert_int_equal(fixture->board.waits, 3);
	assert_int_equal(status.fault, GLOSS_FAULT_SLOT);
	assert_int_equal(status.offset, 17);
	assert_int_equal(fixture->messages.count, 1);
	accel_fence_free(fence);
}

static void a_fence_whose_second_job_runs_times_out_and_goes_on(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence *fence = send_three(fixture);

	fixture->board.timeout_at = 2;
	assert_int_equal(accel_fence_wait(fence, 0, NULL, 0), -ETIMEDOUT);
	assert_int_equal(fixture->board.waits, 2);
	assert_int_equal(accel_fence_wait(fence, 0, NULL, 0), 0);
	assert_int_equal(fixture->board.waits, 4);
	accel_fence_free(fence);
}

/* It is one time, not one for each job. */
static void the_time_of_a_wait_is_that_of_all_its_jobs(void **state)
{
	const int64_t timeout = INT64_C(1) << 40;
	struct fixture *fixture = *state;
	struct accel_fence *fence = send_three(fixture);

	assert_int_equal(accel_fence_wait(fence, timeout, NULL, 0), 0);
	assert_true(fixture->board.timeout < timeout);
	accel_fence_free(fence);
}

static void a_fence_outlives_the_name_of_its_device(void **state)
{
	struct messages messages;
	struct accel_device *device;
	struct accel_stream *stream;
	struct accel_fence *fence;

	(void)state;
	device = device_open("model:", &messages);
	assert_int_equal(accel_stream_new(device, &stream), 0);
	assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
	accel_stream_free(stream);
	accel_device_free(device);
	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
	accel_fence_free(fence);
}

/* In whatever order: it takes the same steps for each, see test_job_table.c. */
static void many_fences_are_freed_newest_first(void **state)
{
	static struct accel_fence *fence[100000];
	struct messages messages;
	struct accel_device *device = device_open("model:", &messages);
	struct accel_stream *stream;

	(void)state;
	assert_int_equal(accel_stream_new(device, &stream), 0);
	for (int i = 0; i < 100000; i++)
		assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence[i]), 0);
	for (int i = 100000; i-- > 0;)
		accel_fence_free(fence[i]);
	accel_stream_free(stream);
	accel_device_free(device);
}

/* ---- what the model makes of wrong streams ---- */

static void a_fault_says_its_cause_and_its_word(void **state)
{
	static const struct {
		uint32_t words[6];
		size_t count;
		unsigned int fault;
		uint32_t offset;
		const char *message;
	} wrong[] = {
		{ { 0xff000000 }, 1, GLOSS_FAULT_OPCODE, 0, "word 0 of its stream: unknown op" },
		{ { 0, 0x02000001, 0 }, 3, GLOSS_FAULT_LENGTH, 1, "wrong length" },
		{ { 0, 0x02000002, 0x10000, 3 }, 4, GLOSS_FAULT_VALUE, 3, "value out of range" },
		{ { 0, 0, 0x11000002, 0, 0 }, 5, GLOSS_FAULT_ORDER, 2, "packet not allowed here" },
		{ { 0x02000002, 0x10003, 0 }, 3, GLOSS_FAULT_SLOT, 2, "outside its slot" },
		{ { 0x03000000 }, 1, GLOSS_FAULT_RESPONSE, 0, "response buffer too small" },
	};
	struct accel_fence_status status;
	struct accel_stream *stream;
	struct accel_fence *fence;
	struct messages messages;
	struct accel_device *device;
	size_t i;

	(void)state;
	device = device_open("model:", &messages);
	assert_int_equal(accel_stream_new(device, &stream), 0);
	for (i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		accel_stream_emit(stream, wrong[i].words, wrong[i].count);
		assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
		assert_int_equal(accel_fence_wait(fence, -1, &status, sizeof(status)), -EIO);
		assert_int_equal(status.fault, wrong[i].fault);
		assert_int_equal(status.offset, wrong[i].offset);
		assert_message(&messages, wrong[i].message);
		accel_fence_free(fence);
	}
	accel_stream_free(stream);
	accel_device_free(device);
}

#define fence_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		fence_test(a_second_wait_gives_the_same_answer),
		fence_test(a_timeout_is_not_the_end),
		fence_test(free_waits_for_ever),
		fence_test(a_board_that_failed_is_told_from_a_fault),
		fence_test(a_board_that_is_gone_ends_the_job),
		fence_test(a_job_that_is_not_taken_has_no_fence),
		fence_test(buffers_of_a_job_go_when_it_has_ended),
		fence_test(a_fence_of_several_jobs_waits_for_all),
		fence_test(a_fence_of_several_jobs_tells_of_the_first_that_failed),
		fence_test(a_fence_whose_second_job_runs_times_out_and_goes_on),
		fence_test(the_time_of_a_wait_is_that_of_all_its_jobs),
		cmocka_unit_test(a_fence_outlives_the_name_of_its_device),
		cmocka_unit_test(many_fences_are_freed_newest_first),
		cmocka_unit_test(a_fault_says_its_cause_and_its_word),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
