/* SPDX-License-Identifier: MIT */
/* The memory of messages to a board on USB: what is kept, and how much of it. */
#include "accel_test.h"
#include "usb_pool.h"

#define UNUSED_WORDS ((size_t)8 << 20)
#define UNUSED_BUFFERS 64u

static int setup(void **state)
{
	static struct accel_usb_pool pool;

	accel_usb_pool_init(&pool);
	*state = &pool;
	return 0;
}

static int teardown(void **state)
{
	accel_usb_pool_fini(*state);
	return 0;
}

static struct accel_usb_buffer *get(struct accel_usb_pool *pool, size_t words)
{
	struct accel_usb_buffer *buffer = accel_usb_pool_get(pool, words);

	assert_non_null(buffer);
	assert_true(buffer->room >= words);
	buffer->word[0] = buffer->word[words - 1] = 1;
	return buffer;
}

static void messages_of_about_the_same_size_share(void **state)
{
	struct accel_usb_buffer *small = get(*state, 10), *large = get(*state, 3000);

	accel_usb_pool_put(*state, small);
	accel_usb_pool_put(*state, large);
	assert_ptr_equal(get(*state, 2500), large);
	assert_ptr_equal(get(*state, 500), small);
	accel_usb_pool_put(*state, small);
	accel_usb_pool_put(*state, large);
	accel_usb_pool_put(*state, NULL);
}

static void one_buffer_is_not_given_twice(void **state)
{
	struct accel_usb_buffer *first = get(*state, 100), *second = get(*state, 100);

	assert_ptr_not_equal(first, second);
	accel_usb_pool_put(*state, first);
	accel_usb_pool_put(*state, second);
}

static void check_kept(const struct accel_usb_pool *pool, unsigned int buffers)
{
	const struct accel_usb_buffer *buffer;
	unsigned int count = 0;
	size_t words = 0;

	for (buffer = pool->unused; buffer; buffer = buffer->next, count++)
		words += buffer->room;
	assert_int_equal(count, buffers);
	assert_true(words <= UNUSED_WORDS);
}

static void keep(struct accel_usb_pool *pool, unsigned int count, size_t words)
{
	struct accel_usb_buffer *buffer[UNUSED_BUFFERS + 10];

	for (unsigned int n = 0; n < count; n++)
		buffer[n] = get(pool, words);
	for (unsigned int n = 0; n < count; n++)
		accel_usb_pool_put(pool, buffer[n]);
}

static void what_is_kept_is_bounded(void **state)
{
	keep(*state, UNUSED_BUFFERS + 10, 1);
	check_kept(*state, UNUSED_BUFFERS);
	keep(*state, 5, UNUSED_WORDS / 4);
	check_kept(*state, 4);
}

static void what_is_too_large_to_be_kept_is_as_large_as_asked_for(void **state)
{
	struct accel_usb_buffer *buffer = get(*state, UNUSED_WORDS + 1);

	assert_int_equal(buffer->room, UNUSED_WORDS + 1);
	accel_usb_pool_put(*state, buffer);
	check_kept(*state, 0);
}

static void what_no_memory_has_is_not_there(void **state)
{
	assert_null(accel_usb_pool_get(*state, SIZE_MAX / 4 - 1));
	assert_null(accel_usb_pool_get(*state, SIZE_MAX));
}

#define pool_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		pool_test(messages_of_about_the_same_size_share),
		pool_test(one_buffer_is_not_given_twice),
		pool_test(what_is_kept_is_bounded),
		pool_test(what_is_too_large_to_be_kept_is_as_large_as_asked_for),
		pool_test(what_no_memory_has_is_not_there),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
