// SPDX-License-Identifier: MIT
/* Items that are worked on by several threads: each once, whatever the system gives of them. */
#include <stdatomic.h>

#include "accel_test.h"
#include "transport/workers.h"

#define ITEMS 1000

/* Threads that the system will still give. */
static int threads_left;

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
			  void *(*start)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
			  void *(*start)(void *), void *argument);

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
			  void *(*start)(void *), void *argument)
{
	if (!threads_left)
		return EAGAIN;
	threads_left--;
	return __real_pthread_create(thread, attributes, start, argument);
}

struct list {
	unsigned int workers;
	uint32_t done[ITEMS];
	atomic_uint busy[ACCEL_THREADS_MAX];
	atomic_uint wrong;
};

static void work(void *data, unsigned int worker, uint32_t item)
{
	struct list *list = data;

	if (worker >= list->workers || atomic_fetch_add(&list->busy[worker], 1))
		atomic_fetch_add(&list->wrong, 1);
	list->done[item]++;
	atomic_fetch_sub(&list->busy[worker], 1);
}

static void run(struct accel_workers *workers, uint32_t items)
{
	static struct list list;

	memset(&list, 0, sizeof(list));
	list.workers = workers->count;
	accel_workers_run(workers, work, &list, items);
	for (uint32_t i = 0; i < ITEMS; i++)
		assert_int_equal(list.done[i], i < items);
	assert_int_equal(list.wrong, 0);
}

static void each_item_is_done_once(void **state)
{
	static const uint32_t items[] = { 0, 1, 2, 3, 7, ITEMS };
	struct accel_workers workers;

	(void)state;
	for (unsigned int count = 1; count <= 8; count++) {
		threads_left = 8;
		accel_workers_init(&workers, count);
		for (int n = 0; n < 30; n++)
			run(&workers, items[n % 6]);
		assert_int_equal(workers.threads, count - 1);
		accel_workers_fini(&workers);
	}
}

static void threads_start_when_there_is_something_for_them(void **state)
{
	struct accel_workers workers;

	(void)state;
	threads_left = 8;
	accel_workers_init(&workers, 4);
	run(&workers, 0);
	run(&workers, 1);
	assert_int_equal(workers.threads, 0);
	run(&workers, 2);
	assert_int_equal(workers.threads, 1);
	run(&workers, 100);
	assert_int_equal(workers.threads, 3);
	accel_workers_fini(&workers);
}

static void fewer_threads_do_the_same_work(void **state)
{
	struct accel_workers workers;

	(void)state;
	accel_workers_init(&workers, 4);
	for (int given = 0; given < 3; given++) {
		threads_left = given ? 1 : 0;
		run(&workers, ITEMS);
		assert_int_equal(workers.threads, given);
	}
	accel_workers_fini(&workers);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_item_is_done_once),
		cmocka_unit_test(threads_start_when_there_is_something_for_them),
		cmocka_unit_test(fewer_threads_do_the_same_work),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
