/* SPDX-License-Identifier: MIT */
/*
 * The jobs of a transport by their numbers, from submit until they were waited for. To find one
 * takes the same time among many as among few. Not locked: the caller sees to that.
 */
#ifndef ACCEL_JOB_TABLE_H
#define ACCEL_JOB_TABLE_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define ACCEL_JOB_TABLE_FIRST 64u

/* Part of a job. */
struct accel_job_entry {
	struct accel_job_entry *next; /* of the same bucket */
	uint64_t sequence;
	bool ended; /* for accel_job_table_wait(), and nothing else looks at the job any more */
};

struct accel_job_table {
	struct accel_job_entry **bucket; /* of sequence modulo buckets, a power of two */
	size_t buckets, count;
	struct accel_job_entry *first[ACCEL_JOB_TABLE_FIRST];
};

void accel_job_table_init(struct accel_job_table *table);
/* Calls @drop, which may be NULL if there are none, with each job that is still there. */
void accel_job_table_fini(struct accel_job_table *table, void (*drop)(struct accel_job_entry *));

/* Numbers that follow one another are found fastest. No other entry has this one's. */
void accel_job_table_put(struct accel_job_table *table, struct accel_job_entry *entry,
			 uint64_t sequence);
/* NULL: there is no such job. */
struct accel_job_entry *accel_job_table_find(const struct accel_job_table *table,
					     uint64_t sequence);
/* Takes out one that is there. */
void accel_job_table_take(struct accel_job_table *table, struct accel_job_entry *entry);

/*
 * Waits until the job with this number has ->ended, and takes it out. @lock, under which the table
 * and ->ended change, is held, and @ended broadcast, as for accel_thread_wait(). -EINVAL: there is
 * no such job; -ETIMEDOUT. An error leaves *@entry alone.
 */
int accel_job_table_wait(struct accel_job_table *table, uint64_t sequence, pthread_cond_t *ended,
			 pthread_mutex_t *lock, int64_t timeout_ns, struct accel_job_entry **entry);

#endif
