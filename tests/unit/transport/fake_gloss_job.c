/* SPDX-License-Identifier: MIT */
/* Jobs as the module takes them, and as the C model runs them. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "fake_gloss_priv.h"

#define JOBS 1024u
#define JOB_OBJECTS (3 + GLOSS_SLOTS) /* stream, response, status, slots */

struct job {
	struct object *object[JOB_OBJECTS]; /* a use each; NULL: none */
	struct accel_job job;
	struct drm_gloss_status *status;
	struct syncobj *syncobj;
	uint64_t point;
};

static pthread_t thread;
static struct model model;
static struct job jobs[JOBS];
static unsigned int jobs_ended, jobs_queued; /* counts */
static bool stopping;

/* A range of a host object for a job; @bytes 0: none, and then nothing may be given. */
static int submit_host(const struct file *file, uint32_t handle, uint64_t offset, uint64_t bytes,
		       uint32_t align, struct object **o)
{
	*o = NULL;
	if (!bytes)
		return handle || offset ? -EINVAL : 0;
	*o = fake_handle_find(file, handle);
	if (!*o)
		return -ENOENT;
	return (*o)->kind != DRM_GLOSS_GEM_HOST || offset % align || offset > (*o)->size ||
			       bytes > (*o)->size - offset ?
		       -EINVAL :
		       0;
}

static int submit_slot(const struct file *file, const struct drm_gloss_slot *from,
		       struct gloss_slot *to, struct object **o)
{
	*o = NULL;
	if (!from->handle)
		return from->rights || from->offset || from->size ? -EINVAL : 0;
	*o = fake_handle_find(file, from->handle);
	if (!*o)
		return -ENOENT;
	if ((*o)->kind != DRM_GLOSS_GEM_BOARD || !from->rights || from->rights > 3 ||
	    from->offset % PAGE || from->size % 4 || !from->size || from->size >> 32 ||
	    from->offset > (*o)->size || from->size > (*o)->size - from->offset)
		return -EINVAL;
	*to = (struct gloss_slot){
		.base = (uint32_t)((*o)->base + from->offset),
		.size = (uint32_t)from->size,
		.rights = (enum gloss_rights)from->rights,
	};
	return 0;
}

/* This library's way to wait: one point of one timeline, always after the last. */
static int submit_syncs(struct file *file, const struct drm_gloss_submit *submit, struct job *job)
{
	const struct drm_gloss_sync *sync = (const void *)(uintptr_t)submit->out_syncs;

	if (submit->in_sync_count || submit->in_syncs || submit->out_sync_count != 1 ||
	    submit->sync_stride != sizeof(*sync) || sync->flags != DRM_GLOSS_SYNC_TIMELINE)
		return -EINVAL;
	job->syncobj = fake_syncobj_find(file, sync->handle);
	job->point = sync->point;
	if (!job->syncobj)
		return -ENOENT;
	return sync->point == job->syncobj->submitted + 1 ? 0 : -EINVAL;
}

static int submit_slots(const struct file *file, const struct drm_gloss_submit *submit,
			struct job *job)
{
	const struct drm_gloss_slot *slot = (const void *)(uintptr_t)submit->slots;
	int err = 0;

	if (submit->slot_count > GLOSS_SLOTS)
		return -E2BIG;
	if (submit->slot_stride != (submit->slot_count ? sizeof(*slot) : 0))
		return -EINVAL;
	for (uint32_t i = 0; i < submit->slot_count && !err; i++)
		err = submit_slot(file, &slot[i], &job->job.slot[i], &job->object[3 + i]);
	return err;
}

static int submit_check(struct file *file, const struct drm_gloss_submit *submit, struct job *job)
{
	int err;

	if (submit->flags || submit->priority || submit->stream_words > FAKE_WORDS_MAX ||
	    submit->response_words > FAKE_WORDS_MAX)
		return -EINVAL;
	err = submit_host(file, submit->stream, submit->stream_offset, 4ull * submit->stream_words,
			  PAGE, &job->object[0]);
	if (!err)
		err = submit_host(file, submit->response, submit->response_offset,
				  4ull * submit->response_words, PAGE, &job->object[1]);
	if (!err)
		err = submit_host(file, submit->status, submit->status_offset,
				  sizeof(struct drm_gloss_status), 16, &job->object[2]);
	if (!err)
		err = submit_slots(file, submit, job);
	return err ? err : submit_syncs(file, submit, job);
}

int fake_job_submit(struct file *file, const struct drm_gloss_submit *submit)
{
	struct job *job = &jobs[jobs_queued % JOBS];
	int err;

	if (jobs_queued - jobs_ended == JOBS)
		return -ENOMEM;
	*job = (struct job){ .point = 0 };
	err = submit_check(file, submit, job);
	if (err)
		return err;
	job->job.stream_words = submit->stream_words;
	job->job.response_words = submit->response_words;
	if (job->object[0])
		job->job.stream = (void *)(fake.host + job->object[0]->base +
					   submit->stream_offset);
	if (job->object[1])
		job->job.response = (void *)(fake.host + job->object[1]->base +
					     submit->response_offset);
	job->status = (void *)(fake.host + job->object[2]->base + submit->status_offset);
	for (unsigned int i = 0; i < JOB_OBJECTS; i++)
		if (job->object[i])
			job->object[i]->uses++;
	job->syncobj->submitted = job->point;
	jobs_queued++;
	fake_gloss.submits++;
	pthread_cond_broadcast(&fake.changed);
	return 0;
}

/* ---- running them ---- */

static void job_end(struct job *job, const struct drm_gloss_status *status)
{
	if (status->error != FAKE_NO_STATUS)
		*job->status = *status;
	for (unsigned int i = 0; i < JOB_OBJECTS; i++)
		if (job->object[i])
			job->object[i]->uses--;
	job->syncobj->signalled = job->point;
	fake_syncobj_signal(job->syncobj);
	jobs_ended++;
	pthread_cond_broadcast(&fake.changed);
}

/* Called with the lock held, which it gives up while the model works. */
static void job_run(struct job *job)
{
	struct drm_gloss_status status = { .error = fake.gone ? -ENODEV : 0 };
	struct gloss_status ended;
	int err;

	if (!status.error && fake.lose_error && !fake.lose_after--) {
		status.error = fake.lose_error;
		fake.lose_error = 0;
	}
	if (!status.error) {
		pthread_mutex_unlock(&fake.lock);
		err = model_run(&model, &job->job, &ended);
		pthread_mutex_lock(&fake.lock);
		status = (struct drm_gloss_status){ err, ended.cause, ended.offset,
						    ended.response_words };
	}
	job_end(job, &status);
}

static void *run_jobs(void *data)
{
	(void)data;
	pthread_mutex_lock(&fake.lock);
	while (!stopping) {
		if (jobs_ended != jobs_queued && (!fake.held || fake.gone))
			job_run(&jobs[jobs_ended % JOBS]);
		else
			pthread_cond_wait(&fake.changed, &fake.lock);
	}
	pthread_mutex_unlock(&fake.lock);
	return NULL;
}

void fake_job_start(void)
{
	jobs_ended = jobs_queued = 0;
	stopping = false;
	if (model_init(&model, 64, fake.board, sizeof(fake.board)) ||
	    pthread_create(&thread, NULL, run_jobs, NULL))
		abort();
}

void fake_job_stop(void)
{
	pthread_mutex_lock(&fake.lock);
	stopping = true;
	pthread_cond_broadcast(&fake.changed);
	pthread_mutex_unlock(&fake.lock);
	pthread_join(thread, NULL);
}
