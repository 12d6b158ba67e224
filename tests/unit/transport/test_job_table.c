/* SPDX-License-Identifier: MIT */
#include <errno.h>

#include "accel_test.h"
#include "transport/job_table.h"
#include "transport/thread.h"

#define JOBS 100000u

static struct accel_job_entry jobs[JOBS];
static struct accel_job_table table;
static unsigned int dropped;

static int setup(void **state)
{
	(void)state;
	accel_job_table_init(&table);
	return 0;
}

static int teardown(void **state)
{
	(void)state;
	accel_job_table_fini(&table, NULL);
	return 0;
}

static void put_all(uint64_t first)
{
	for (uint32_t i = 0; i < JOBS; i++)
		accel_job_table_put(&table, &jobs[i], first + i);
}

/* Jobs that are looked at until @job is found. */
static unsigned int steps_to(const struct accel_job_entry *job)
{
	struct accel_job_entry *at = table.bucket[job->sequence % table.buckets];
	unsigned int steps = 1;

	for (; at != job; at = at->next)
		steps++;
	return steps;
}

static void take(struct accel_job_entry *job)
{
	assert_ptr_equal(accel_job_table_find(&table, job->sequence), job);
	accel_job_table_take(&table, job);
	assert_null(accel_job_table_find(&table, job->sequence));
}

static void a_job_is_found_by_its_number_alone(void **state)
{
	(void)state;
	put_all(7);
	for (uint32_t i = 0; i < JOBS; i++)
		assert_ptr_equal(accel_job_table_find(&table, 7 + i), &jobs[i]);
	assert_null(accel_job_table_find(&table, 6));
	assert_null(accel_job_table_find(&table, 7 + JOBS));
	for (uint32_t i = 0; i < JOBS; i++)
		take(&jobs[i]);
	assert_int_equal(table.count, 0);
}

static void the_newest_of_many_jobs_is_found_as_fast_as_the_oldest(void **state)
{
	(void)state;
	put_all(1);
	for (uint32_t i = JOBS; i-- > 0;) {
		assert_int_equal(steps_to(&jobs[i]), 1);
		take(&jobs[i]);
	}
}

/* As when one fence is kept for long. */
static void an_old_job_does_not_make_later_ones_slow(void **state)
{
	(void)state;
	accel_job_table_put(&table, &jobs[0], 1);
	for (uint64_t sequence = 2; sequence < 3 * (uint64_t)JOBS; sequence++) {
		accel_job_table_put(&table, &jobs[1], sequence);
		assert_in_range(steps_to(&jobs[1]), 1, 2);
		take(&jobs[1]);
	}
	assert_int_equal(table.buckets, ACCEL_JOB_TABLE_FIRST);
	take(&jobs[0]);
}

static void jobs_leave_in_any_order(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	put_all(UINT64_MAX / 3);
	for (uint32_t left = JOBS; left;) {
		uint32_t i = test_below(&seed, JOBS);

		while (!jobs[i].sequence)
			i = (i + 1) % JOBS;
		take(&jobs[i]);
		jobs[i].sequence = 0;
		left--;
	}
}

static void a_job_is_waited_for_until_it_has_ended(void **state)
{
	pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
	struct accel_job_entry *entry = NULL;
	pthread_cond_t ended;

	(void)state;
	accel_thread_condition_init(&ended);
	pthread_mutex_lock(&lock);
	assert_int_equal(accel_job_table_wait(&table, 1, &ended, &lock, -1, &entry), -EINVAL);
	accel_job_table_put(&table, &jobs[0], 1);
	assert_int_equal(accel_job_table_wait(&table, 1, &ended, &lock, 0, &entry), -ETIMEDOUT);
	assert_null(entry);
	jobs[0].ended = true;
	assert_int_equal(accel_job_table_wait(&table, 1, &ended, &lock, -1, &entry), 0);
	assert_ptr_equal(entry, &jobs[0]);
	assert_null(accel_job_table_find(&table, 1));
	pthread_mutex_unlock(&lock);
	pthread_cond_destroy(&ended);
	jobs[0].ended = false;
}

static void count_dropped(struct accel_job_entry *entry)
{
	entry->sequence = 0;
	dropped++;
}

static void what_is_left_is_dropped(void **state)
{
	(void)state;
	put_all(1);
	take(&jobs[17]);
	accel_job_table_fini(&table, count_dropped);
	assert_int_equal(dropped, JOBS - 1);
	accel_job_table_init(&table);
}

#define table_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		table_test(a_job_is_found_by_its_number_alone),
		table_test(the_newest_of_many_jobs_is_found_as_fast_as_the_oldest),
		table_test(an_old_job_does_not_make_later_ones_slow),
		table_test(jobs_leave_in_any_order),
		table_test(a_job_is_waited_for_until_it_has_ended),
		table_test(what_is_left_is_dropped),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
