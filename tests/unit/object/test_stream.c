/* SPDX-License-Identifier: MIT */
#include <pthread.h>

#include "accel_priv.h"
#include "accel_test.h"

struct fixture {
	struct messages messages;
	struct accel_device *device;
	struct accel_stream *stream;
	struct accel_buffer *buffer;
};

static int setup(void **state)
{
	static struct fixture fixture;

	fixture.device = device_open("model:memory=1048576", &fixture.messages);
	assert_int_equal(accel_stream_new(fixture.device, &fixture.stream), 0);
	assert_int_equal(accel_buffer_new(fixture.device, 4096, &fixture.buffer), 0);
	*state = &fixture;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *fixture = *state;

	accel_buffer_free(fixture->buffer);
	accel_stream_free(fixture->stream);
	accel_device_free(fixture->device);
	return 0;
}

static void words_are_copied_one_after_the_other(void **state)
{
	struct fixture *fixture = *state;
	uint32_t words[1000], i;
	const uint32_t *all;
	size_t count;

	all = accel_stream_words(fixture->stream, &count);
	assert_int_equal(count, 0);
	assert_int_equal(accel_stream_emit(fixture->stream, NULL, 0), 0);
	for (i = 0; i < 1000; i++) {
		words[0] = i;
		words[i] = i;
		assert_int_equal(accel_stream_emit(fixture->stream, words + i, 1), 0);
	}
	assert_int_equal(accel_stream_emit(fixture->stream, words, 1000), 0);
	all = accel_stream_words(fixture->stream, &count);
	assert_int_equal(count, 2000);
	for (i = 0; i < 1000; i++)
		assert_int_equal(all[i], i);
	assert_int_equal(all[1999], 999);
}

/* They move when there is no room for twice as many. */
static void words_of_the_stream_itself_may_be_emitted(void **state)
{
	struct fixture *fixture = *state;
	const uint32_t first[3] = { 7, 8, 9 };
	const uint32_t *all;
	size_t count = 3;

	assert_int_equal(accel_stream_emit(fixture->stream, first, 3), 0);
	while (count < 10000) {
		all = accel_stream_words(fixture->stream, &count);
		assert_int_equal(accel_stream_emit(fixture->stream, all, count), 0);
		all = accel_stream_words(fixture->stream, &count);
		assert_int_equal(accel_stream_emit(fixture->stream, all + count - 3, 3), 0);
	}
	all = accel_stream_words(fixture->stream, &count);
	for (size_t i = 0; i < count; i++)
		assert_int_equal(all[i], 7 + i % 3);
}

/* What a job is, whatever of it was lent: @words in random pieces, of which some are. */
static void emit_in_pieces(struct accel_stream *stream, uint64_t *seed, const uint32_t *words,
			   uint32_t count)
{
	for (uint32_t at = 0, now; at < count; at += now) {
		now = test_below(seed, 60);
		if (now > count - at)
			now = count - at;
		if (test_below(seed, 3))
			assert_int_equal(accel_stream_lend(stream, words + at, now), 0);
		else
			assert_int_equal(accel_stream_emit(stream, words + at, now), 0);
	}
}

static void lent_words_are_sent_where_they_were_appended(void **state)
{
	static uint32_t words[3 + 1000], back[1000];
	struct fixture *fixture = *state;
	struct accel_buffer *buffer;
	uint64_t seed = test_seed();

	assert_int_equal(accel_buffer_new(fixture->device, sizeof(back), &buffer), 0);
	gloss_write_memory_pack(words, &(struct gloss_write_memory){ .slot = 0 }, 2 + 1000);
	for (int n = 0; n < 50; n++) {
		for (uint32_t i = 0; i < 1000; i++)
			words[3 + i] = (uint32_t)test_random(&seed);
		accel_stream_slot(fixture->stream, buffer, ACCEL_SLOT_WRITE);
		emit_in_pieces(fixture->stream, &seed, words, 3 + 1000);
		assert_int_equal(accel_stream_finish(fixture->stream, NULL, 0), 0);
		assert_int_equal(accel_buffer_read(buffer, 0, back, sizeof(back)), 0);
		assert_memory_equal(back, words + 3, sizeof(back));
	}
	accel_buffer_free(buffer);
}

static int refuse(void *state, const struct accel_transport_job *job, uint64_t *sequence)
{
	(void)state;
	(void)job;
	(void)sequence;
	return -ENOMEM;
}

/* Its own words may have moved by then. */
static void a_stream_with_lent_words_may_be_sent_again(void **state)
{
	struct fixture *fixture = *state;
	const struct accel_transport_ops *ops = fixture->device->ops;
	struct accel_transport_ops refusing = *ops;
	static const uint32_t nops[5000];
	const uint32_t end = 0xff000000;
	struct accel_fence_status status;
	struct accel_fence *fence;

	refusing.submit = refuse;
	fixture->device->ops = &refusing;
	assert_int_equal(accel_stream_emit(fixture->stream, nops, 2), 0);
	assert_int_equal(accel_stream_lend(fixture->stream, nops, 3), 0);
	assert_int_equal(accel_stream_submit(fixture->stream, NULL, 0, &fence), -ENOMEM);
	assert_int_equal(accel_stream_emit(fixture->stream, nops, 5000), 0);
	assert_int_equal(accel_stream_emit(fixture->stream, &end, 1), 0);
	assert_int_equal(accel_stream_submit(fixture->stream, NULL, 0, &fence), -ENOMEM);
	fixture->device->ops = ops;
	assert_int_equal(accel_stream_submit(fixture->stream, NULL, 0, &fence), 0);
	assert_int_equal(accel_fence_wait(fence, -1, &status, sizeof(status)), -EIO);
	assert_int_equal(status.fault, GLOSS_FAULT_OPCODE);
	assert_int_equal(status.offset, 5005);
	accel_fence_free(fence);
}

static void lent_words_count_and_are_forgotten(void **state)
{
	struct fixture *fixture = *state;
	uint32_t nops[3] = { 0, 0, 0xff000000 };
	struct accel_fence_status status;
	struct accel_fence *fence;
	size_t count;

	assert_int_equal(accel_stream_lend(fixture->stream, nops, 3), 0);
	assert_int_equal(accel_stream_lend(fixture->stream, nops, ACCEL_STREAM_WORDS_MAX - 2),
			 -E2BIG);
	assert_int_equal(accel_stream_emit(fixture->stream, nops, ACCEL_STREAM_WORDS_MAX - 2),
			 -E2BIG);
	accel_stream_reset(fixture->stream);
	accel_stream_words(fixture->stream, &count);
	assert_int_equal(count, 0);
	assert_int_equal(accel_stream_emit(fixture->stream, nops, 1), 0);
	assert_int_equal(accel_stream_lend(fixture->stream, nops, 3), 0);
	assert_int_equal(accel_stream_submit(fixture->stream, NULL, 0, &fence), 0);
	assert_int_equal(accel_fence_wait(fence, -1, &status, sizeof(status)), -EIO);
	assert_int_equal(status.offset, 3);
	accel_fence_free(fence);
}

static void a_stream_too_long_is_refused_before_its_words_are_read(void **state)
{
	struct fixture *fixture = *state;
	uint32_t word = 0;
	size_t count;

	assert_int_equal(accel_stream_emit(fixture->stream, &word, ACCEL_STREAM_WORDS_MAX + 1ull),
			 -E2BIG);
	assert_int_equal(accel_stream_emit(fixture->stream, &word, SIZE_MAX), -E2BIG);
	assert_int_equal(accel_stream_emit(fixture->stream, &word, 1), 0);
	assert_int_equal(accel_stream_emit(fixture->stream, &word, ACCEL_STREAM_WORDS_MAX), -E2BIG);
	assert_message(&fixture->messages, "more than 268435456 words");
	accel_stream_words(fixture->stream, &count);
	assert_int_equal(count, 1);
}

static void a_buffer_has_one_slot(void **state)
{
	struct fixture *fixture = *state;
	struct accel_buffer *other;

	assert_int_equal(accel_buffer_new(fixture->device, 64, &other), 0);
	assert_int_equal(accel_stream_slot(fixture->stream, fixture->buffer, ACCEL_SLOT_READ), 0);
	assert_int_equal(accel_stream_slot(fixture->stream, other, ACCEL_SLOT_READ), 1);
	assert_int_equal(accel_stream_slot(fixture->stream, fixture->buffer, ACCEL_SLOT_WRITE), 0);
	accel_buffer_free(other);
}

/* Copies a word to and back from slot 0; what the job says of it. */
static struct accel_fence_status touch(struct accel_stream *stream, bool write)
{
	struct accel_fence_status status;
	struct accel_fence *fence;
	uint32_t words[4], response;
	size_t count = write ? packet_write(words, 0, 0, 1) : packet_read(words, 0, 0, 1);

	assert_int_equal(accel_stream_emit(stream, words, count), 0);
	assert_int_equal(accel_stream_submit(stream, &response, 1, &fence), 0);
	accel_fence_wait(fence, -1, &status, sizeof(status));
	accel_fence_free(fence);
	return status;
}

static void rights_are_those_that_were_given(void **state)
{
	static const unsigned int rights[] = { ACCEL_SLOT_READ, ACCEL_SLOT_WRITE,
					       ACCEL_SLOT_READ | ACCEL_SLOT_WRITE };
	struct fixture *fixture = *state;
	size_t i;

	for (i = 0; i < 3; i++) {
		accel_stream_slot(fixture->stream, fixture->buffer, rights[i]);
		assert_int_equal(touch(fixture->stream, true).fault,
				 rights[i] & ACCEL_SLOT_WRITE ? 0 : GLOSS_FAULT_SLOT);
		accel_stream_slot(fixture->stream, fixture->buffer, rights[i]);
		assert_int_equal(touch(fixture->stream, false).fault,
				 rights[i] & ACCEL_SLOT_READ ? 0 : GLOSS_FAULT_SLOT);
	}
	for (i = 0; i < 2; i++) {
		accel_stream_slot(fixture->stream, fixture->buffer, ACCEL_SLOT_READ);
		accel_stream_slot(fixture->stream, fixture->buffer, ACCEL_SLOT_WRITE);
		assert_int_equal(touch(fixture->stream, i == 0).fault, 0);
	}
}

static void slots_do_not_last_past_submit_or_reset(void **state)
{
	struct fixture *fixture = *state;

	accel_stream_slot(fixture->stream, fixture->buffer, ACCEL_SLOT_READ);
	assert_int_equal(touch(fixture->stream, false).fault, 0);
	assert_int_equal(touch(fixture->stream, false).fault, GLOSS_FAULT_SLOT);
	accel_stream_slot(fixture->stream, fixture->buffer, ACCEL_SLOT_READ);
	accel_stream_reset(fixture->stream);
	assert_int_equal(touch(fixture->stream, false).fault, GLOSS_FAULT_SLOT);
}

static void the_slot_table_has_sixteen_entries(void **state)
{
	struct fixture *fixture = *state;
	struct accel_buffer *buffer[GLOSS_SLOTS];
	unsigned int i;

	for (i = 0; i < GLOSS_SLOTS; i++) {
		assert_int_equal(accel_buffer_new(fixture->device, 4, &buffer[i]), 0);
		assert_int_equal(accel_stream_slot(fixture->stream, buffer[i], ACCEL_SLOT_READ), i);
	}
	assert_int_equal(accel_stream_slot(fixture->stream, fixture->buffer, ACCEL_SLOT_READ),
			 -ENOSPC);
	assert_message(&fixture->messages, "more than 16 buffers");
	assert_int_equal(accel_stream_slot(fixture->stream, buffer[15], ACCEL_SLOT_WRITE), 15);
	for (i = 0; i < GLOSS_SLOTS; i++)
		accel_buffer_free(buffer[i]);
}

static void a_slot_of_another_device_or_no_right_is_refused(void **state)
{
	struct fixture *fixture = *state;
	struct accel_buffer *other;
	struct messages messages;
	struct accel_device *device;

	device = device_open("model:", &messages);
	assert_int_equal(accel_buffer_new(device, 64, &other), 0);
	assert_int_equal(accel_stream_slot(fixture->stream, other, ACCEL_SLOT_READ), -EINVAL);
	assert_message(&fixture->messages, "another device");
	assert_int_equal(accel_stream_slot(fixture->stream, fixture->buffer, 0), -EINVAL);
	assert_int_equal(accel_stream_slot(fixture->stream, fixture->buffer, 4), -EINVAL);
	assert_message(&fixture->messages, "no rights");
	accel_buffer_free(other);
	accel_device_free(device);
}

static void a_buffer_named_by_a_stream_outlives_its_name(void **state)
{
	struct fixture *fixture = *state;
	struct accel_buffer *all;
	struct messages messages;
	struct accel_stream *stream;
	struct accel_device *device;

	(void)fixture;
	device = device_open("model:memory=4096", &messages);
	assert_int_equal(accel_stream_new(device, &stream), 0);
	assert_int_equal(accel_buffer_new(device, 4096, &all), 0);
	assert_int_equal(accel_stream_slot(stream, all, ACCEL_SLOT_WRITE), 0);
	accel_buffer_free(all);
	assert_int_equal(accel_buffer_new(device, 4, &all), -ENOMEM);
	assert_int_equal(touch(stream, true).fault, 0);
	assert_int_equal(accel_buffer_new(device, 4096, &all), 0);
	accel_buffer_free(all);
	accel_stream_free(stream);
	accel_device_free(device);
}

static void an_empty_stream_is_a_job(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence_status status = { .fault = 9 };
	struct accel_fence *fence;

	assert_int_equal(accel_stream_submit(fixture->stream, NULL, 0, &fence), 0);
	assert_int_equal(accel_fence_wait(fence, -1, &status, sizeof(status)), 0);
	assert_int_equal(status.fault, 0);
	assert_int_equal(status.offset, 0);
	assert_int_equal(status.response_words, 0);
	accel_fence_free(fence);
}

static void a_refused_submit_leaves_the_stream_as_it_was(void **state)
{
	struct fixture *fixture = *state;
	struct accel_fence *fence = NULL;
	uint32_t words[4];
	size_t count;

	accel_stream_slot(fixture->stream, fixture->buffer, ACCEL_SLOT_READ);
	accel_stream_emit(fixture->stream, words, packet_read(words, 0, 0, 1));
	assert_int_equal(accel_stream_submit(fixture->stream, NULL, 1, &fence), -EINVAL);
	assert_null(fence);
	assert_message(&fixture->messages, "no buffer for 1 response words");
	accel_stream_words(fixture->stream, &count);
	assert_int_equal(count, 3);
	assert_int_equal(accel_stream_finish(fixture->stream, words, 1), 0);
	accel_stream_words(fixture->stream, &count);
	assert_int_equal(count, 0);
}

static void a_submit_without_a_fence_waits(void **state)
{
	struct fixture *fixture = *state;
	uint32_t words[4], response[2] = { 0, 5 };
	size_t count;

	accel_stream_slot(fixture->stream, fixture->buffer, ACCEL_SLOT_READ | ACCEL_SLOT_WRITE);
	accel_stream_emit(fixture->stream, words, packet_write(words, 0, 4, 123));
	accel_stream_emit(fixture->stream, words, packet_read(words, 0, 4, 1));
	assert_int_equal(accel_stream_finish(fixture->stream, response, 2), 0);
	assert_int_equal(response[0], 123);
	assert_int_equal(response[1], 5);
	words[0] = 0xff000000;
	accel_stream_emit(fixture->stream, words, 1);
	assert_int_equal(accel_stream_finish(fixture->stream, NULL, 0), -EIO);
	accel_stream_words(fixture->stream, &count);
	assert_int_equal(count, 0);
}

#define THREADS 4
#define JOBS 60
#define FLIGHT 3

/* A thread with a stream and a buffer of its own, and several jobs on their way at once. */
static const char *use_stream(struct accel_stream *stream, struct accel_buffer *buffer)
{
	struct accel_fence *fence[FLIGHT] = { NULL };
	uint32_t words[4], response[FLIGHT] = { 0 };
	uint32_t job;

	for (job = 0; job < JOBS + FLIGHT; job++) {
		uint32_t at = job % FLIGHT;

		if (fence[at] && accel_fence_wait(fence[at], -1, NULL, 0))
			return "a job failed";
		if (fence[at] && response[at] != (job - FLIGHT) * 3)
			return "another's answer";
		accel_fence_free(fence[at]);
		fence[at] = NULL;
		if (job >= JOBS)
			continue;
		accel_stream_slot(stream, buffer, ACCEL_SLOT_READ | ACCEL_SLOT_WRITE);
		accel_stream_emit(stream, words, packet_write(words, 0, 0, job * 3));
		accel_stream_emit(stream, words, packet_read(words, 0, 0, 1));
		if (accel_stream_submit(stream, &response[at], 1, &fence[at]))
			return "a job was not taken";
	}
	return NULL;
}

static void *use_device(void *data)
{
	struct accel_stream *stream;
	struct accel_buffer *buffer;
	const char *wrong;

	if (accel_stream_new(data, &stream) || accel_buffer_new(data, 64, &buffer))
		return "no memory";
	wrong = use_stream(stream, buffer);
	accel_buffer_free(buffer);
	accel_stream_free(stream);
	return (void *)wrong;
}

static void threads_have_a_stream_each(void **state)
{
	struct fixture *fixture = *state;
	pthread_t thread[THREADS];
	void *wrong;
	int i;

	for (i = 0; i < THREADS; i++)
		assert_int_equal(pthread_create(&thread[i], NULL, use_device, fixture->device), 0);
	for (i = 0; i < THREADS; i++) {
		pthread_join(thread[i], &wrong);
		if (wrong)
			fail_msg("%s", (const char *)wrong);
	}
}

#define stream_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		stream_test(words_are_copied_one_after_the_other),
		stream_test(words_of_the_stream_itself_may_be_emitted),
		stream_test(lent_words_are_sent_where_they_were_appended),
		stream_test(a_stream_with_lent_words_may_be_sent_again),
		stream_test(lent_words_count_and_are_forgotten),
		stream_test(a_stream_too_long_is_refused_before_its_words_are_read),
		stream_test(a_buffer_has_one_slot),
		stream_test(rights_are_those_that_were_given),
		stream_test(slots_do_not_last_past_submit_or_reset),
		stream_test(the_slot_table_has_sixteen_entries),
		stream_test(a_slot_of_another_device_or_no_right_is_refused),
		stream_test(a_buffer_named_by_a_stream_outlives_its_name),
		stream_test(an_empty_stream_is_a_job),
		stream_test(a_refused_submit_leaves_the_stream_as_it_was),
		stream_test(a_submit_without_a_fence_waits),
		stream_test(threads_have_a_stream_each),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
