// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: A job's life
 *
 * gloss_submit_ioctl, or gloss_clear_board, makes a job, gives it the objects it uses,
 * locks their reservations and pushes it to its entity. From then on the scheduler owns
 * it: when all it depends on is done and it is the job's turn, gloss_sched_run_job puts it
 * into the ring. The interrupt finds that it has ended, writes its status to the page that
 * waits for it, and signals its fence. At last a work frees it, and drops what it used.
 */
#include <drm/drm_gem.h>
#include <linux/dma-resv.h>
#include <linux/highmem.h>
#include <linux/slab.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"
#include "gloss_trace.h"

static int gloss_job_init(struct gloss_device *gdev, struct gloss_job *job,
			  struct gloss_file *file, u32 priority)
{
	struct drm_sched_entity *entity = file ? &file->entity[priority] : &gdev->clear.entity;
	int ret = -ENOMEM;

	job->fence = gloss_fence_new();
	if (!job->fence)
		return ret;

	ret = gloss_turn_init(&gdev->turns, &job->turn, file, priority);
	if (ret)
		goto free_fence;

	ret = gloss_compat_sched_job_init(&job->base, entity, file, gloss_file_client(file));
	if (ret)
		goto fini_turn;
	return 0;

fini_turn:
	gloss_turn_fini(&gdev->turns, &job->turn);
free_fence:
	gloss_fence_free(job->fence);
	return ret;
}

/* A job of @file, or without a file the driver's own, which has no priority but comes first. */
struct gloss_job *gloss_job_new(struct gloss_device *gdev, struct gloss_file *file, u32 priority)
{
	struct gloss_job *job;
	int ret;

	job = kzalloc(sizeof(*job), GFP_KERNEL_ACCOUNT);
	if (!job)
		return ERR_PTR(-ENOMEM);

	ret = gloss_job_init(gdev, job, file, priority);
	if (ret) {
		kfree(job);
		return ERR_PTR(ret);
	}

	job->gdev = gdev;
	INIT_WORK(&job->free, gloss_job_free_work);
	if (file) {
		kref_get(&file->ref);
		atomic_inc(&file->jobs_queued);
		job->file = file;
	}
	atomic_inc(&gdev->jobs);
	return job;
}

/*
 * Notes that the job reads, or also writes, an object. Takes over the reference, and the use
 * of a host object, on an error too. -EINVAL: two objects for one reservation, which only
 * the same dma-buf, imported by two files, can be.
 */
int gloss_job_use(struct gloss_job *job, struct drm_gem_object *object, bool write)
{
	unsigned int i;

	for (i = 0; i < job->objects; i++)
		if (job->object[i]->resv == object->resv)
			break;

	if (i < job->objects) {
		bool same = job->object[i] == object;

		gloss_gem_end_use(object);
		if (!same)
			return -EINVAL;
	} else {
		job->object[job->objects++] = object;
	}
	if (write)
		job->writes |= BIT(i);
	return 0;
}

/* What the kernel itself does with an object comes before any job, such as its clearing. */
static int gloss_job_depend_kernel(struct gloss_job *job, struct dma_resv *resv)
{
	struct dma_resv_iter cursor;
	struct dma_fence *fence;
	int ret;

	dma_resv_for_each_fence(&cursor, resv, DMA_RESV_USAGE_KERNEL, fence) {
		ret = drm_sched_job_add_dependency(&job->base, dma_fence_get(fence));
		if (ret)
			return ret;
	}
	return 0;
}

static int gloss_job_depend_on(struct gloss_job *job, unsigned int i)
{
	/* To clear an object comes before all else that may be queued for it. */
	if (job->clears)
		return 0;
	if (job->explicit_sync)
		return gloss_job_depend_kernel(job, job->object[i]->resv);
	return drm_sched_job_add_implicit_dependencies(&job->base, job->object[i],
						       job->writes & BIT(i));
}

static int gloss_job_depend(struct gloss_job *job)
{
	unsigned int i;
	int ret;

	for (i = 0; i < job->objects; i++) {
		ret = dma_resv_reserve_fences(job->object[i]->resv, 1) ?:
		      gloss_job_depend_on(job, i);
		if (ret)
			return ret;
	}
	return 0;
}

/* Locks all objects, and makes the job wait for what is still done with them. */
int gloss_job_lock(struct gloss_job *job, struct ww_acquire_ctx *ctx)
{
	int ret;

	ret = drm_gem_lock_reservations(job->object, job->objects, ctx);
	if (ret)
		return ret;

	ret = gloss_job_depend(job);
	if (ret)
		drm_gem_unlock_reservations(job->object, job->objects, ctx);
	return ret;
}

static void gloss_job_add_fence(struct gloss_job *job, struct dma_fence *fence)
{
	unsigned int i;

	for (i = 0; i < job->objects; i++) {
		enum dma_resv_usage usage = DMA_RESV_USAGE_READ;

		if (job->clears)
			usage = DMA_RESV_USAGE_KERNEL;
		else if (job->explicit_sync)
			usage = DMA_RESV_USAGE_BOOKKEEP;
		else if (job->writes & BIT(i))
			usage = DMA_RESV_USAGE_WRITE;
		dma_resv_add_fence(job->object[i]->resv, fence, usage);
	}
}

/*
 * Gives a job whose objects are locked to the scheduler, and unlocks them. Can not fail.
 * Returns the fence that signals when the job has ended.
 */
struct dma_fence *gloss_job_push(struct gloss_job *job, struct ww_acquire_ctx *ctx)
{
	struct mutex *lock = job->file ? &job->file->lock : &job->gdev->clear.lock;
	struct dma_fence *fence;
	bool signalling;

	mutex_lock(lock);
	signalling = dma_fence_begin_signalling();
	drm_sched_job_arm(&job->base);
	fence = dma_fence_get(&job->base.s_fence->finished);
	gloss_job_add_fence(job, fence);
	trace_gloss_submit(job);
	/* Once it is pushed, the job may end, and be gone with its objects. */
	drm_gem_unlock_reservations(job->object, job->objects, ctx);
	drm_sched_entity_push_job(&job->base);
	dma_fence_end_signalling(signalling);
	mutex_unlock(lock);
	return fence;
}

/* Why a job must not be run, now that it is its turn; 0: it may. */
int gloss_job_refusal(const struct gloss_job *job)
{
	unsigned int i;

	if (job->file && READ_ONCE(job->file->closed))
		return -ECANCELED;
	if (job->clears)
		return 0;
	for (i = 0; i < job->objects; i++)
		if (gloss_gem_is_board(job->object[i]) &&
		    gloss_clear_missing(to_gloss_board(job->object[i])))
			return -EIO;
	return 0;
}

/* The board will get an empty job in its place, and that ends with @error. */
void gloss_job_refuse(struct gloss_job *job, int error)
{
	job->refused = error;
	if (job->clears)
		gloss_clear_failed(job);
}

/* The scheduler has decided for the job; its fence takes its place among the ring's. */
void gloss_job_begin(struct gloss_job *job)
{
	struct gloss_ring *ring = &job->gdev->ring;
	int refusal = gloss_job_refusal(job);

	dma_fence_init(job->fence, &gloss_fence_ops, &ring->fence_lock, ring->fence_context,
		       ++ring->fence_sequence);
	if (refusal)
		gloss_job_refuse(job, refusal);
	else if (job->clears)
		gloss_clear_begun(job);
}

static void gloss_job_write_status(struct gloss_job *job, const struct drm_gloss_status *status)
{
	if (job->status_page)
		memcpy_to_page(job->status_page, job->status_offset, (const char *)status,
			       sizeof(*status));
}

/* Clearing is no job that a program knows of. */
static void gloss_job_count(struct gloss_job *job, const struct drm_gloss_status *status)
{
	if (!job->file || job->clears)
		return;

	atomic64_inc(&job->file->jobs);
	if (status->error == -EIO || status->error == -ETIME || status->error == -ENODEV)
		atomic_inc(&job->file->jobs_lost);
}

/* Ends a job that has begun. It may be freed at once. The ring is locked. */
void gloss_job_end(struct gloss_job *job, const struct drm_gloss_status *status)
{
	int error = status->error ?: status->cause ? -EIO : 0;

	trace_gloss_done(job, status);
	gloss_job_write_status(job, status);
	if (error) {
		trace_gloss_fault(job, status);
		gloss_compat_sched_job_failed(&job->base, error);
		dma_fence_set_error(job->fence, error);
		if (job->clears)
			gloss_clear_failed(job);
	}
	gloss_job_count(job, status);
	job->state = GLOSS_JOB_ENDED;
	gloss_turn_end(&job->gdev->turns, &job->turn);
	atomic_inc(&job->gdev->jobs_ended);
	dma_fence_signal(job->fence);
}

/* A job the scheduler has dropped, as its file was closed, before its turn came. */
static void gloss_job_dropped(struct gloss_job *job)
{
	const struct drm_gloss_status status = { .error = -ECANCELED };

	gloss_job_write_status(job, &status);
	if (job->clears)
		gloss_clear_failed(job);
}

static void gloss_job_free_fence(struct gloss_job *job)
{
	if (job->fence->ops)
		dma_fence_put(job->fence);
	else
		gloss_fence_free(job->fence);
}

/* Frees a job that was pushed and has ended, or one that was never pushed. */
void gloss_job_free(struct gloss_job *job)
{
	struct gloss_device *gdev = job->gdev;
	unsigned int i;

	if (job->base.sched && job->state == GLOSS_JOB_WAITING)
		gloss_job_dropped(job);
	if (job->state == GLOSS_JOB_ENDED)
		atomic_dec(&gdev->jobs_ended);

	gloss_turn_fini(&gdev->turns, &job->turn);
	gloss_job_free_fence(job);
	drm_sched_job_cleanup(&job->base);
	for (i = 0; i < job->objects; i++)
		gloss_gem_end_use(job->object[i]);
	if (job->file) {
		atomic_dec(&job->file->jobs_queued);
		gloss_file_put(job->file);
	}
	kfree(job);

	atomic_dec(&gdev->jobs);
	wake_up_all(&gdev->jobs_wait);
}

void gloss_job_free_work(struct work_struct *work)
{
	struct gloss_job *job = container_of(work, struct gloss_job, free);

	if (!job->file)
		gloss_clear_ended(job->gdev);
	gloss_job_free(job);
}
