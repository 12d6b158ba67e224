// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>

#include "transport/job_table.h"
#include "transport/thread.h"

void accel_job_table_init(struct accel_job_table *table)
{
	*table = (struct accel_job_table){ .buckets = ACCEL_JOB_TABLE_FIRST };
	table->bucket = table->first;
}

void accel_job_table_fini(struct accel_job_table *table, void (*drop)(struct accel_job_entry *))
{
	for (size_t i = 0; i < table->buckets; i++) {
		struct accel_job_entry *entry = table->bucket[i], *next;

		for (; entry; entry = next) {
			next = entry->next;
			drop(entry);
		}
	}
	if (table->bucket != table->first)
		free((void *)table->bucket);
}

static struct accel_job_entry **table_bucket(const struct accel_job_table *table, uint64_t sequence)
{
	return &table->bucket[sequence & (table->buckets - 1)];
}

static void table_link(struct accel_job_table *table, struct accel_job_entry *entry)
{
	struct accel_job_entry **bucket = table_bucket(table, entry->sequence);

	entry->next = *bucket;
	*bucket = entry;
}

/* Without memory for more buckets they are shared by more jobs: slower, and right. */
static void table_grow(struct accel_job_table *table)
{
	struct accel_job_table old = *table;
	struct accel_job_entry **bucket;

	bucket = (struct accel_job_entry **)calloc(2 * old.buckets, sizeof(void *));
	if (!bucket)
		return;
	table->bucket = bucket;
	table->buckets = 2 * old.buckets;
	for (size_t i = 0; i < old.buckets; i++) {
		struct accel_job_entry *entry = old.bucket[i], *next;

		for (; entry; entry = next) {
			next = entry->next;
			table_link(table, entry);
		}
	}
	if (old.bucket != table->first)
		free((void *)old.bucket);
}

void accel_job_table_put(struct accel_job_table *table, struct accel_job_entry *entry,
			 uint64_t sequence)
{
	if (table->count == table->buckets)
		table_grow(table);
	entry->sequence = sequence;
	table_link(table, entry);
	table->count++;
}

struct accel_job_entry *accel_job_table_find(const struct accel_job_table *table, uint64_t sequence)
{
	struct accel_job_entry *entry = *table_bucket(table, sequence);

	while (entry && entry->sequence != sequence)
		entry = entry->next;
	return entry;
}

void accel_job_table_take(struct accel_job_table *table, struct accel_job_entry *entry)
{
	struct accel_job_entry **link = table_bucket(table, entry->sequence);

	while (*link != entry)
		link = &(*link)->next;
	*link = entry->next;
	table->count--;
}

int accel_job_table_wait(struct accel_job_table *table, uint64_t sequence, pthread_cond_t *ended,
			 pthread_mutex_t *lock, int64_t timeout_ns, struct accel_job_entry **entry)
{
	struct accel_job_entry *job = accel_job_table_find(table, sequence);
	int err = job ? accel_thread_wait(ended, lock, &job->ended, timeout_ns) : -EINVAL;

	if (err)
		return err;
	accel_job_table_take(table, job);
	*entry = job;
	return 0;
}
