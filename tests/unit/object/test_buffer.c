/* SPDX-License-Identifier: MIT */
#include "accel_test.h"

#define SIZE 1200004u /* several jobs' worth, and not whole packets */

struct fixture {
	struct messages messages;
	struct accel_device *device;
};

static int setup(void **state)
{
	static struct fixture fixture;

	fixture.device = device_open("model:memory=4194304", &fixture.messages);
	*state = &fixture;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *fixture = *state;

	accel_device_free(fixture->device);
	return 0;
}

static struct accel_buffer *buffer_of(struct fixture *fixture, uint64_t size)
{
	struct accel_buffer *buffer = NULL;

	assert_int_equal(accel_buffer_new(fixture->device, size, &buffer), 0);
	return buffer;
}

static void a_size_that_can_not_be_is_refused(void **state)
{
	static const uint64_t sizes[] = { 0, 1, 6, (1ull << 31) + 4, 1ull << 32, UINT64_MAX - 3 };
	struct fixture *fixture = *state;
	struct accel_buffer *buffer;
	size_t i;

	for (i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++)
		assert_int_equal(accel_buffer_new(fixture->device, sizes[i], &buffer), -EINVAL);
	assert_message(&fixture->messages, "can not have");
}

static void the_largest_buffer_works_to_its_end(void **state)
{
	const uint64_t size = 1ull << 31;
	struct accel_buffer *buffer;
	struct messages messages;
	struct accel_device *device;
	uint32_t word = 0x12345678, back = 1;

	(void)state;
	device = device_open("model:memory=4294967296", &messages);
	assert_int_equal(accel_buffer_new(device, size, &buffer), 0);
	assert_int_equal(accel_buffer_write(buffer, size - 4, &word, 4), 0);
	assert_int_equal(accel_buffer_read(buffer, size - 4, &back, 4), 0);
	assert_int_equal(back, word);
	assert_int_equal(accel_buffer_read(buffer, size - 8, &back, 4), 0);
	assert_int_equal(back, 0);
	accel_buffer_free(buffer);
	accel_device_free(device);
}

static void board_memory_ends_and_comes_back(void **state)
{
	struct fixture *fixture = *state;
	struct accel_buffer *all = buffer_of(fixture, 4194304), *more;

	assert_int_equal(accel_buffer_new(fixture->device, 4, &more), -ENOMEM);
	assert_message(&fixture->messages, "no board memory for a buffer of 4 bytes");
	accel_buffer_free(all);
	all = buffer_of(fixture, 4194304);
	accel_buffer_free(all);
}

static void content_is_zero_also_where_another_was(void **state)
{
	struct fixture *fixture = *state;
	struct accel_buffer *buffer = buffer_of(fixture, SIZE);
	uint8_t *bytes = malloc(SIZE);
	size_t i;

	memset(bytes, 0xa5, SIZE);
	assert_int_equal(accel_buffer_write(buffer, 0, bytes, SIZE), 0);
	accel_buffer_free(buffer);
	buffer = buffer_of(fixture, SIZE);
	assert_int_equal(accel_buffer_read(buffer, 0, bytes, SIZE), 0);
	for (i = 0; i < SIZE; i++)
		assert_int_equal(bytes[i], 0);
	accel_buffer_free(buffer);
	free(bytes);
}

static void random_copies_land_where_they_should(void **state)
{
	struct fixture *fixture = *state;
	struct accel_buffer *buffer = buffer_of(fixture, SIZE);
	uint8_t *shadow = calloc(1, SIZE), *bytes = malloc(SIZE + 1);
	uint64_t seed = test_seed();
	int round;

	for (round = 0; round < 60; round++) {
		uint32_t offset = test_below(&seed, SIZE / 4) * 4;
		uint32_t size = test_below(&seed, round % 4 ? 4096 : SIZE / 4) * 4;
		uint8_t *data = bytes + round % 2; /* not aligned, every other time */
		size_t i;

		if (size > SIZE - offset)
			size = SIZE - offset;
		for (i = 0; i < size; i++)
			data[i] = (uint8_t)(i * 7 + (size_t)round);
		assert_int_equal(accel_buffer_write(buffer, offset, data, size), 0);
		memcpy(shadow + offset, data, size);
		offset = test_below(&seed, SIZE / 4) * 4;
		assert_int_equal(accel_buffer_read(buffer, offset, data, SIZE - offset), 0);
		assert_memory_equal(data, shadow + offset, SIZE - offset);
	}
	accel_buffer_free(buffer);
	free(shadow);
	free(bytes);
}

static void a_copy_outside_or_between_words_is_refused(void **state)
{
	static const struct {
		uint64_t offset, size;
	} wrong[] = {
		{ 1, 4 },
		{ 2, 4 },
		{ 0, 2 },
		{ 0, 68 },
		{ 4, 64 },
		{ 64, 4 },
		{ 68, 0 },
		{ UINT64_MAX - 3, 4 },
		{ UINT64_MAX - 3, 8 },
		{ 4, UINT64_MAX - 3 },
		{ 1ull << 32, 4 },
		{ 0, 1ull << 32 },
		{ 1ull << 63, 1ull << 63 },
	};
	struct fixture *fixture = *state;
	struct accel_buffer *buffer = buffer_of(fixture, 64);
	uint32_t words[32] = { 0 };
	size_t i;

	for (i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		assert_int_equal(accel_buffer_write(buffer, wrong[i].offset, words, wrong[i].size),
				 -EINVAL);
		assert_int_equal(accel_buffer_read(buffer, wrong[i].offset, words, wrong[i].size),
				 -EINVAL);
	}
	assert_message(&fixture->messages, "of a buffer of 64");
	assert_int_equal(accel_buffer_write(buffer, 64, words, 0), 0);
	assert_int_equal(accel_buffer_read(buffer, 0, NULL, 0), 0);
	assert_int_equal(accel_buffer_read(buffer, 60, words, 4), 0);
	accel_buffer_free(buffer);
}

static void a_copy_comes_after_the_jobs_before_it(void **state)
{
	struct fixture *fixture = *state;
	struct accel_buffer *buffer = buffer_of(fixture, 64);
	struct accel_stream *stream;
	struct accel_fence *fence;
	uint32_t words[4], back;

	assert_int_equal(accel_stream_new(fixture->device, &stream), 0);
	assert_int_equal(accel_stream_slot(stream, buffer, ACCEL_SLOT_WRITE), 0);
	accel_stream_emit(stream, words, packet_write(words, 0, 8, 77));
	assert_int_equal(accel_stream_submit(stream, NULL, 0, &fence), 0);
	assert_int_equal(accel_buffer_read(buffer, 8, &back, 4), 0);
	assert_int_equal(back, 77);
	accel_fence_free(fence);
	accel_stream_free(stream);
	accel_buffer_free(buffer);
}

#define buffer_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		buffer_test(a_size_that_can_not_be_is_refused),
		cmocka_unit_test(the_largest_buffer_works_to_its_end),
		buffer_test(board_memory_ends_and_comes_back),
		buffer_test(content_is_zero_also_where_another_was),
		buffer_test(random_copies_land_where_they_should),
		buffer_test(a_copy_outside_or_between_words_is_refused),
		buffer_test(a_copy_comes_after_the_jobs_before_it),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
