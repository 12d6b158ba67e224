// SPDX-License-Identifier: MIT
/* Memory for messages to a board on USB: what comes back is used again, and not too much of it. */
#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "transport/usb/pool.h"

#define KEPT_WORDS ((size_t)8 << 20)
#define KEPT_BUFFERS 64

static struct accel_usb_pool pool;

static int setup(void **state)
{
	(void)state;
	accel_usb_pool_init(&pool);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	accel_usb_pool_fini(&pool);
	return 0;
}

/* All of it can be written. */
static struct accel_usb_buffer *get(size_t words)
{
	struct accel_usb_buffer *buffer = accel_usb_pool_get(&pool, words);

	assert_non_null(buffer);
	assert_true(buffer->room >= words);
	assert_true(malloc_usable_size(buffer) >= sizeof(*buffer) + 4 * buffer->room);
	buffer->word[0] = 1;
	buffer->word[words - 1] = 2;
	return buffer;
}

static size_t kept(size_t *words)
{
	size_t buffers = 0;

	*words = 0;
	for (const struct accel_usb_buffer *at = pool.unused; at; at = at->next) {
		*words += at->room;
		buffers++;
	}
	return buffers;
}

static void what_comes_back_is_used_again(void **state)
{
	struct accel_usb_buffer *first = get(70000), *second = get(70000);

	(void)state;
	assert_ptr_not_equal(first, second);
	accel_usb_pool_put(&pool, first);
	accel_usb_pool_put(&pool, second);
	assert_ptr_equal(get(66000), second);
	assert_ptr_equal(get(131072), first);
	accel_usb_pool_put(&pool, first);
	accel_usb_pool_put(&pool, second);
}

static void another_size_is_another_buffer(void **state)
{
	struct accel_usb_buffer *large = get(5000), *small;

	(void)state;
	accel_usb_pool_put(&pool, large);
	small = get(1);
	assert_ptr_not_equal(small, large);
	accel_usb_pool_put(&pool, small);
	assert_ptr_equal(get(5000), large);
	accel_usb_pool_put(&pool, large);
}

static void many_are_not_all_kept(void **state)
{
	struct accel_usb_buffer *buffer[2 * KEPT_BUFFERS];
	size_t words;

	(void)state;
	for (int n = 0; n < 2 * KEPT_BUFFERS; n++)
		buffer[n] = get(10);
	for (int n = 0; n < 2 * KEPT_BUFFERS; n++)
		accel_usb_pool_put(&pool, buffer[n]);
	assert_int_equal(kept(&words), KEPT_BUFFERS);
	assert_ptr_equal(pool.unused, buffer[2 * KEPT_BUFFERS - 1]);
}

static void large_ones_are_not_all_kept(void **state)
{
	struct accel_usb_buffer *buffer[4], *huge = get(KEPT_WORDS + 1);
	size_t words;

	(void)state;
	assert_int_equal(huge->room, KEPT_WORDS + 1);
	accel_usb_pool_put(&pool, huge);
	assert_int_equal(kept(&words), 0);
	for (int n = 0; n < 4; n++)
		buffer[n] = get(KEPT_WORDS / 2);
	for (int n = 0; n < 4; n++)
		accel_usb_pool_put(&pool, buffer[n]);
	assert_int_equal(kept(&words), 2);
	assert_int_equal(words, KEPT_WORDS);
}

static void more_than_there_can_be_is_out_of_memory(void **state)
{
	(void)state;
	assert_null(accel_usb_pool_get(&pool, SIZE_MAX));
	assert_null(accel_usb_pool_get(&pool, SIZE_MAX / 4));
	accel_usb_pool_put(&pool, NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(what_comes_back_is_used_again, setup, teardown),
		cmocka_unit_test_setup_teardown(another_size_is_another_buffer, setup, teardown),
		cmocka_unit_test_setup_teardown(many_are_not_all_kept, setup, teardown),
		cmocka_unit_test_setup_teardown(large_ones_are_not_all_kept, setup, teardown),
		cmocka_unit_test_setup_teardown(more_than_there_can_be_is_out_of_memory, setup,
						teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
