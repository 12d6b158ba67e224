// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "transport/engine.h"
#include "transport/thread.h"

struct accel_engine_job {
	struct accel_job_entry entry;  /* first, so that an entry is its job */
	struct accel_engine_job *next; /* to be run after it */
	int error;                     /* of the engine */
	struct gloss_status status;
	struct accel_job job;
	uint32_t *stream; /* until it has ended */
};

static size_t engine_bytes(const struct accel_engine_job *job)
{
	return (size_t)job->job.stream_words * sizeof(uint32_t);
}

static void engine_job_drop(struct accel_job_entry *entry)
{
	struct accel_engine_job *job = (struct accel_engine_job *)entry;

	free(job->stream);
	free(job);
}

/* ---- the thread ---- */

/* The next job, or NULL when the engine stops and all were run. */
static struct accel_engine_job *engine_next(struct accel_engine *engine)
{
	while (!engine->first && !engine->stop)
		pthread_cond_wait(&engine->submitted, &engine->lock);
	return engine->first;
}

static void *engine_thread(void *argument)
{
	struct accel_engine *engine = argument;
	struct accel_engine_job *job;

	pthread_mutex_lock(&engine->lock);
	while ((job = engine_next(engine))) {
		pthread_mutex_unlock(&engine->lock);
		job->error = engine->run(engine->data, &job->job, &job->status);
		free(job->stream);
		job->stream = NULL;
		pthread_mutex_lock(&engine->lock);
		engine->first = job->next;
		if (!engine->first)
			engine->last = &engine->first;
		engine->queued -= engine_bytes(job);
		job->entry.ended = true;
		pthread_cond_broadcast(&engine->ended);
	}
	pthread_mutex_unlock(&engine->lock);
	return NULL;
}

static void engine_destroy_locks(struct accel_engine *engine)
{
	pthread_cond_destroy(&engine->ended);
	pthread_cond_destroy(&engine->submitted);
	pthread_mutex_destroy(&engine->lock);
}

int accel_engine_init(struct accel_engine *engine, uint64_t memory_size, accel_engine_run run,
		      void *data)
{
	*engine = (struct accel_engine){ .run = run, .data = data, .memory_size = memory_size };
	if (memory_size > SIZE_MAX)
		return -ENOMEM;
	/* Pages come as they are touched, and come zero. */
	engine->memory = mmap(NULL, memory_size, PROT_READ | PROT_WRITE,
			      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
	if (engine->memory == MAP_FAILED)
		return -ENOMEM;
	accel_range_init(&engine->ranges, memory_size);
	engine->last = &engine->first;
	accel_job_table_init(&engine->jobs);
	pthread_mutex_init(&engine->lock, NULL);
	pthread_cond_init(&engine->submitted, NULL);
	accel_thread_condition_init(&engine->ended);
	if (accel_thread_new(&engine->thread, engine_thread, engine))
		goto err_unmap;
	return 0;

err_unmap:
	engine_destroy_locks(engine);
	munmap(engine->memory, memory_size);
	return -ENOMEM;
}

void accel_engine_fini(struct accel_engine *engine)
{
	pthread_mutex_lock(&engine->lock);
	engine->stop = true;
	pthread_cond_signal(&engine->submitted);
	pthread_mutex_unlock(&engine->lock);
	pthread_join(engine->thread, NULL);
	accel_job_table_fini(&engine->jobs, engine_job_drop);
	engine_destroy_locks(engine);
	accel_range_fini(&engine->ranges);
	munmap(engine->memory, engine->memory_size);
}

/* ---- board memory ---- */

int accel_engine_memory_new(void *state, uint64_t size, uint64_t *object)
{
	struct accel_engine *engine = state;

	return accel_range_new(&engine->ranges, size, object);
}

/*
 * Whole pages go back to the system, which makes them zero again; where its pages
 * are larger than the steps of ranges, a neighbour may be on the same.
 */
static void engine_zero(void *memory, uint64_t size)
{
	if (sysconf(_SC_PAGESIZE) > ACCEL_RANGE_ALIGN || madvise(memory, size, MADV_DONTNEED))
		memset(memory, 0, size);
}

void accel_engine_memory_free(void *state, uint64_t object)
{
	struct accel_engine *engine = state;
	const struct accel_range *range = accel_range_find(&engine->ranges, object);

	engine_zero((uint8_t *)engine->memory + range->base, range->size);
	accel_range_free(&engine->ranges, object);
}

/* ---- jobs ---- */

static int engine_fill_slots(const struct accel_engine *engine,
			     const struct accel_transport_job *from, struct gloss_slot *slot)
{
	if (from->slots > GLOSS_SLOTS)
		return -EINVAL;
	for (uint32_t i = 0; i < from->slots; i++) {
		const struct accel_range *range;

		range = accel_range_find(&engine->ranges, from->slot[i].object);
		if (!range || range->size > UINT32_MAX)
			return -EINVAL;
		slot[i] = (struct gloss_slot){
			.base = (uint32_t)range->base,
			.size = (uint32_t)range->size,
			.rights = from->slot[i].rights,
		};
	}
	return 0;
}

/* NULL: out of memory, or there are no words. */
static uint32_t *engine_copy(const struct accel_transport_job *from)
{
	const size_t bytes = (size_t)from->stream_words * sizeof(uint32_t);
	uint32_t *stream;

	if (!bytes || bytes / sizeof(uint32_t) != from->stream_words)
		return NULL;
	stream = malloc(bytes);
	if (stream)
		accel_transport_copy(from, stream);
	return stream;
}

static struct accel_engine_job *engine_job_new(const struct accel_transport_job *from)
{
	struct accel_engine_job *job = malloc(sizeof(*job));

	if (!job)
		return NULL;
	*job = (struct accel_engine_job){
		.stream = engine_copy(from),
		.job = {
			.stream_words = from->stream_words,
			.response = from->response,
			.response_words = from->response_words,
		},
	};
	job->job.stream = job->stream;
	if (job->stream || !from->stream_words)
		return job;
	free(job);
	return NULL;
}

int accel_engine_submit(void *state, const struct accel_transport_job *from, uint64_t *sequence)
{
	struct accel_engine *engine = state;
	struct accel_engine_job *job = engine_job_new(from);
	int err;

	if (!job)
		return -ENOMEM;
	err = engine_fill_slots(engine, from, job->job.slot);
	if (err)
		goto err_free;
	pthread_mutex_lock(&engine->lock);
	*sequence = ++engine->sequence;
	accel_job_table_put(&engine->jobs, &job->entry, *sequence);
	*engine->last = job;
	engine->last = &job->next;
	engine->queued += engine_bytes(job);
	pthread_cond_signal(&engine->submitted);
	pthread_mutex_unlock(&engine->lock);
	return 0;

err_free:
	engine_job_drop(&job->entry);
	return err;
}

void accel_engine_wait_for_room(void *state)
{
	struct accel_engine *engine = state;

	pthread_mutex_lock(&engine->lock);
	while (engine->queued >= ENGINE_QUEUED_MAX)
		pthread_cond_wait(&engine->ended, &engine->lock);
	pthread_mutex_unlock(&engine->lock);
}

int accel_engine_wait(void *state, uint64_t sequence, int64_t timeout_ns,
		      struct gloss_status *status)
{
	struct accel_engine *engine = state;
	struct accel_job_entry *entry;
	struct accel_engine_job *job;
	int err;

	pthread_mutex_lock(&engine->lock);
	err = accel_job_table_wait(&engine->jobs, sequence, &engine->ended, &engine->lock,
				   timeout_ns, &entry);
	pthread_mutex_unlock(&engine->lock);
	if (err)
		return err;
	job = (struct accel_engine_job *)entry;
	*status = job->status;
	err = job->error ? -EIO : 0;
	engine_job_drop(entry);
	return err;
}
