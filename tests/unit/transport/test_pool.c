// SPDX-License-Identifier: MIT
/* Memory for jobs: what comes back is used again, and not too much of it is kept. */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "transport/pool.h"

#define PAGE 4096u
#define KEPT_BYTES (32u << 20)
#define KEPT_BUFFERS 64

struct buffer {
	struct accel_pool_buffer pooled;
	uint8_t bytes[];
};

/* What there is of memory, in buffers. */
struct memory {
	unsigned int used, max;
};

static struct memory memory;
static struct accel_pool pool;

static int memory_create(void *data, uint64_t size, struct accel_pool_buffer **out)
{
	struct memory *of = data;

	assert_int_equal(size % PAGE, 0);
	if (of->used == of->max || size > SIZE_MAX / 2)
		return -ENOMEM;
	of->used++;
	*out = malloc(sizeof(struct buffer) + size);
	return *out ? 0 : -ENOMEM;
}

static void memory_destroy(void *data, struct accel_pool_buffer *buffer)
{
	struct memory *of = data;

	of->used--;
	free(buffer);
}

static const struct accel_pool_kind kind = {
	.unused_bytes = KEPT_BYTES,
	.unused_buffers = KEPT_BUFFERS,
	.create = memory_create,
	.destroy = memory_destroy,
};

static int setup(void **state)
{
	(void)state;
	memory = (struct memory){ .max = UINT32_MAX };
	accel_pool_init(&pool, &kind, &memory);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	accel_pool_fini(&pool);
	return memory.used ? -1 : 0;
}

/* All of it can be written. */
static struct accel_pool_buffer *get(uint64_t bytes)
{
	struct accel_pool_buffer *buffer;

	assert_int_equal(accel_pool_get(&pool, bytes, &buffer), 0);
	assert_true(buffer->size >= bytes);
	((struct buffer *)buffer)->bytes[0] = 1;
	((struct buffer *)buffer)->bytes[bytes - 1] = 2;
	return buffer;
}

static unsigned int kept(uint64_t *bytes)
{
	unsigned int buffers = 0;

	*bytes = 0;
	for (const struct accel_pool_buffer *at = pool.unused; at; at = at->next) {
		*bytes += at->size;
		buffers++;
	}
	return buffers;
}

static void what_comes_back_is_used_again(void **state)
{
	struct accel_pool_buffer *first = get(280000), *second = get(280000);

	(void)state;
	assert_ptr_not_equal(first, second);
	accel_pool_put(&pool, first);
	accel_pool_put(&pool, second);
	assert_ptr_equal(get(264000), second);
	assert_ptr_equal(get(524288), first);
	accel_pool_put(&pool, first);
	accel_pool_put(&pool, second);
}

static void another_size_is_another_buffer(void **state)
{
	struct accel_pool_buffer *large = get(20000), *small;

	(void)state;
	accel_pool_put(&pool, large);
	small = get(1);
	assert_ptr_not_equal(small, large);
	accel_pool_put(&pool, small);
	assert_ptr_equal(get(20000), large);
	accel_pool_put(&pool, large);
}

static void many_are_not_all_kept(void **state)
{
	struct accel_pool_buffer *buffer[2 * KEPT_BUFFERS];
	uint64_t bytes;

	(void)state;
	for (int n = 0; n < 2 * KEPT_BUFFERS; n++)
		buffer[n] = get(10);
	for (int n = 0; n < 2 * KEPT_BUFFERS; n++)
		accel_pool_put(&pool, buffer[n]);
	assert_int_equal(kept(&bytes), KEPT_BUFFERS);
	assert_ptr_equal(pool.unused, buffer[2 * KEPT_BUFFERS - 1]);
}

static void large_ones_are_not_all_kept(void **state)
{
	struct accel_pool_buffer *buffer[4], *huge = get(KEPT_BYTES + 1);
	uint64_t bytes;

	(void)state;
	assert_int_equal(huge->size, KEPT_BYTES + PAGE);
	accel_pool_put(&pool, huge);
	assert_int_equal(kept(&bytes), 0);
	for (int n = 0; n < 4; n++)
		buffer[n] = get(KEPT_BYTES / 2);
	for (int n = 0; n < 4; n++)
		accel_pool_put(&pool, buffer[n]);
	assert_int_equal(kept(&bytes), 2);
	assert_int_equal(bytes, KEPT_BYTES);
}

static void more_than_there_can_be_is_out_of_memory(void **state)
{
	struct accel_pool_buffer *buffer;

	(void)state;
	assert_int_equal(accel_pool_get(&pool, UINT64_MAX, &buffer), -ENOMEM);
	assert_int_equal(accel_pool_get(&pool, UINT64_MAX / 2, &buffer), -ENOMEM);
	accel_pool_put(&pool, NULL);
}

static void what_is_unused_gives_way_when_memory_is_short(void **state)
{
	struct accel_pool_buffer *small[2] = { get(1), get(1) }, *large;

	(void)state;
	memory.max = 2;
	assert_int_equal(accel_pool_get(&pool, 2 * PAGE, &large), -ENOMEM);
	accel_pool_put(&pool, small[0]);
	large = get(2 * PAGE);
	assert_null(pool.unused);
	accel_pool_put(&pool, large);
	accel_pool_put(&pool, small[1]);
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
		cmocka_unit_test_setup_teardown(what_is_unused_gives_way_when_memory_is_short,
						setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
