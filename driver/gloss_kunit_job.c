// SPDX-License-Identifier: GPL-2.0-only
/* A gloss_job.c that only notes what it is asked to do. */
#include <linux/module.h>

#include "gloss_kunit.h"

struct gloss_kunit_jobs *gloss_kunit_jobs;

void gloss_kunit_jobs_init(struct kunit *test)
{
	gloss_kunit_jobs = kunit_kzalloc(test, sizeof(*gloss_kunit_jobs), GFP_KERNEL);
	KUNIT_ASSERT_NOT_NULL(test, gloss_kunit_jobs);
}

struct gloss_job *gloss_job_new(struct gloss_device *gdev, struct gloss_file *file,
				u32 priority)
{
	struct gloss_job *job = &gloss_kunit_jobs->job[gloss_kunit_jobs->count];

	if (gloss_kunit_jobs->count == GLOSS_KUNIT_JOBS)
		return ERR_PTR(-ENOMEM);
	gloss_kunit_jobs->count++;
	job->gdev = gdev;
	job->file = file;
	return job;
}

int gloss_job_use(struct gloss_job *job, struct drm_gem_object *object, bool write)
{
	job->writes |= write << job->objects;
	job->object[job->objects++] = object;
	return 0;
}

int gloss_job_lock(struct gloss_job *job, struct ww_acquire_ctx *ctx)
{
	return gloss_kunit_jobs->count == gloss_kunit_jobs->fail_at ? -EINTR : 0;
}

struct dma_fence *gloss_job_push(struct gloss_job *job, struct ww_acquire_ctx *ctx)
{
	gloss_kunit_jobs->pushed++;
	return NULL;
}

void gloss_job_free(struct gloss_job *job)
{
	gloss_kunit_jobs->freed++;
}

MODULE_DESCRIPTION("KUnit tests of the gloss driver");
MODULE_LICENSE("GPL");
GLOSS_COMPAT_IMPORT_NS(DMA_BUF);
