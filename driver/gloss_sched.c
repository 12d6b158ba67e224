// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: The scheduler, and jobs that hang
 *
 * The DRM scheduler picks the next job by priority, in turns between open files, and
 * keeps up to GLOSS_JOBS_AHEAD of them in the board's ring.
 *
 * A job at the ring's head that has not ended after timeout_ms is looked at. If it has
 * ended, an interrupt was lost. If the board moved since it was looked at last, the job is
 * only slow, and is given as long again. Else it hung, as it has at once when the board
 * reports a DMA error: the board is reset, and all jobs of the ring are run again, but
 * the one to blame as an empty job that ends with -EIO.
 *
 * The scheduler is stopped while the board is looked at, and asks for every job of the
 * ring again when it goes on; gloss_sched_run_job then returns the fence that is there.
 *
 * It lives until the last open file is closed, also when the board has gone before:
 * that is how the jobs which are still queued end.
 */
#include <drm/drm_drv.h>
#include <drm/drm_managed.h>
#include <drm/drm_print.h>
#include <linux/bitfield.h>
#include <linux/iopoll.h>
#include <linux/workqueue.h>

#include "gloss_drv.h"

/* Zero would be no time for the scheduler, and all the time for a poll. */
static unsigned int gloss_sched_timeout_ms(void)
{
	return max(gloss_timeout_ms, 1u);
}

/* Why a job must not be run, now that it is its turn. */
static int gloss_sched_refusal(const struct gloss_job *job)
{
	unsigned int i;

	if (job->file && READ_ONCE(job->file->closed))
		return -ECANCELED;
	for (i = 0; i < job->objects; i++)
		if (gloss_gem_is_board(job->object[i]) &&
		    READ_ONCE(to_gloss_board(job->object[i])->lost))
			return -EIO;
	return 0;
}

static struct dma_fence *gloss_sched_run(struct gloss_job *job)
{
	struct gloss_device *gdev = job->gdev;
	bool entered;
	int idx;

	if (job->state != GLOSS_JOB_WAITING)
		return dma_fence_get(job->fence);

	gloss_job_begin(job);
	if (!job->refused)
		job->refused = gloss_sched_refusal(job);

	entered = drm_dev_enter(&gdev->drm, &idx);
	if (!entered)
		gloss_device_set_gone(gdev, NULL);
	gloss_ring_push(gdev, job);
	if (entered)
		drm_dev_exit(idx);
	return dma_fence_get(job->fence);
}

/* Fences wait for this, so lockdep is told to look out for what must not wait for fences. */
static struct dma_fence *gloss_sched_run_job(struct drm_sched_job *base)
{
	bool signalling = dma_fence_begin_signalling();
	struct dma_fence *fence = gloss_sched_run(to_gloss_job(base));

	dma_fence_end_signalling(signalling);
	return fence;
}

/*
 * The last reference to an object may be a job's, and to drop that may take locks whose
 * owners wait for fences or for memory: not for this thread, which has jobs to run.
 */
static void gloss_sched_free_job(struct drm_sched_job *base)
{
	struct gloss_job *job = to_gloss_job(base);

	if (job->objects)
		queue_work(job->gdev->free_wq, &job->free);
	else
		gloss_job_free(job);
}

static void gloss_sched_read_fault(struct gloss_device *gdev, struct gloss_ring_fault *fault)
{
	fault->sequence = gloss_read(gdev, GLOSS_REG_FAULT_SEQUENCE);
	fault->status.cause = FIELD_GET(GLOSS_REG_FAULT_CAUSE_CAUSE,
					gloss_read(gdev, GLOSS_REG_FAULT_CAUSE));
	fault->dma_address = gloss_read(gdev, GLOSS_REG_DMA_ERROR_LOW) |
			     (u64)gloss_read(gdev, GLOSS_REG_DMA_ERROR_HIGH) << 32;
}

/* Who hung the board; @fault has what the board says of it. */
static int gloss_sched_blame(struct gloss_device *gdev, bool dma, struct gloss_ring_fault *fault)
{
	if (!gloss_ring_blame(&gdev->ring, fault->sequence, fault))
		return -EIO;

	if (dma)
		drm_err(&gdev->drm, "DMA to %#llx was refused: job %u of process %d is lost\n",
			fault->dma_address, fault->sequence, fault->pid);
	else
		drm_err(&gdev->drm, "job %u of process %d hung the board, and is lost\n",
			fault->sequence, fault->pid);
	return 0;
}

/* Resets the board; what it had not ended will be run again. */
static int gloss_sched_reset(struct gloss_device *gdev, bool dma)
{
	struct gloss_ring_fault fault = { .status.error = -EIO };
	unsigned int ended;
	int ret;

	if (dma)
		gloss_sched_read_fault(gdev, &fault);
	atomic_inc(&gdev->resets);
	ret = gloss_device_reset(gdev);
	if (ret)
		return ret;

	/* The board may have ended jobs after all, as the last thing before its reset. */
	ended = gloss_ring_reap(&gdev->ring);
	if ((dma || !ended) && !gloss_ring_idle(&gdev->ring)) {
		ret = gloss_sched_blame(gdev, dma, &fault);
		if (ret)
			return ret;
	}
	gloss_ring_rewind(&gdev->ring);
	return gloss_device_start(gdev);
}

/* Finds out why a job has not ended. The scheduler is stopped. */
static void gloss_sched_look(struct gloss_device *gdev)
{
	struct gloss_ring *ring = &gdev->ring;
	u32 head, progress, status;

	if (gloss_ring_reap(ring)) {
		atomic_inc(&gdev->interrupts_lost);
		drm_notice(&gdev->drm, "an interrupt was lost\n");
	}
	if (gloss_ring_idle(ring))
		return;

	head = gloss_read(gdev, GLOSS_REG_HEAD);
	progress = gloss_read(gdev, GLOSS_REG_PROGRESS);
	status = gloss_read(gdev, GLOSS_REG_STATUS);
	if (status == U32_MAX) {
		gloss_device_set_gone(gdev, "it does not answer");
	} else if (status & GLOSS_REG_STATUS_DMA_ERROR ||
		   (head == ring->seen_head && progress == ring->seen_progress)) {
		if (gloss_sched_reset(gdev, status & GLOSS_REG_STATUS_DMA_ERROR))
			gloss_device_set_gone(gdev, "it can not be reset");
	} else {
		ring->seen_head = head;
		ring->seen_progress = progress;
	}
}

static enum drm_gpu_sched_stat gloss_sched_timedout(struct drm_sched_job *base)
{
	struct gloss_device *gdev = to_gloss_job(base)->gdev;
	bool signalling;
	int idx;

	down(&gdev->stop);
	drm_sched_stop(&gdev->sched, base);
	/* From here on @base may be ended. */
	signalling = dma_fence_begin_signalling();
	if (drm_dev_enter(&gdev->drm, &idx)) {
		if (!gloss_device_gone(gdev))
			gloss_sched_look(gdev);
		drm_dev_exit(idx);
	}
	drm_sched_resubmit_jobs(&gdev->sched);
	gloss_compat_sched_start(&gdev->sched);
	dma_fence_end_signalling(signalling);
	up(&gdev->stop);
	return DRM_GPU_SCHED_STAT_NOMINAL;
}

static const struct drm_sched_backend_ops gloss_sched_ops = {
	.run_job = gloss_sched_run_job,
	.timedout_job = gloss_sched_timedout,
	.free_job = gloss_sched_free_job,
};

/* Looks at the first job of the ring now, from a work. */
void gloss_sched_kick(struct gloss_device *gdev)
{
	drm_sched_fault(&gdev->sched);
}

/*
 * Before the board loses its power: lets it end what it has, if it can, and keeps the
 * rest queued.
 */
void gloss_sched_suspend(struct gloss_device *gdev)
{
	bool idle;

	down(&gdev->stop);
	drm_sched_stop(&gdev->sched, NULL);
	read_poll_timeout(gloss_ring_idle, idle, idle, USEC_PER_MSEC,
			  (u64)gloss_sched_timeout_ms() * USEC_PER_MSEC, false, &gdev->ring);
	/* As an interrupt may have been lost. */
	gloss_ring_reap(&gdev->ring);
}

void gloss_sched_resume(struct gloss_device *gdev)
{
	drm_sched_resubmit_jobs(&gdev->sched);
	gloss_compat_sched_start(&gdev->sched);
	up(&gdev->stop);
}

/* The last file is closed and the board has gone, so all jobs end by themselves. */
static void gloss_sched_fini(struct drm_device *drm, void *data)
{
	struct gloss_device *gdev = to_gloss_device(drm);

	wait_event(gdev->jobs_wait, !atomic_read(&gdev->jobs));
	drm_sched_fini(&gdev->sched);
}

static void gloss_sched_fini_queues(struct drm_device *drm, void *data)
{
	struct gloss_device *gdev = to_gloss_device(drm);

	destroy_workqueue(gdev->free_wq);
	destroy_workqueue(gdev->sched_wq);
}

static int gloss_sched_init_queues(struct gloss_device *gdev)
{
	/* Who waits for memory may wait for a fence, and that for this. */
	gdev->sched_wq = alloc_ordered_workqueue("gloss", WQ_MEM_RECLAIM);
	if (!gdev->sched_wq)
		return -ENOMEM;

	gdev->free_wq = alloc_workqueue("gloss_free", 0, 0);
	if (!gdev->free_wq) {
		destroy_workqueue(gdev->sched_wq);
		return -ENOMEM;
	}
	return drmm_add_action_or_reset(&gdev->drm, gloss_sched_fini_queues, NULL);
}

int gloss_sched_init(struct gloss_device *gdev)
{
	int ret;

	sema_init(&gdev->stop, 1);
	ret = gloss_sched_init_queues(gdev) ?:
	      gloss_compat_sched_init(&gdev->sched, &gloss_sched_ops, GLOSS_JOBS_AHEAD,
				      msecs_to_jiffies(gloss_sched_timeout_ms()),
				      gdev->sched_wq, gdev->drm.dev);
	if (ret)
		return ret;

	gloss_compat_sched_calm(&gdev->sched);
	return drmm_add_action_or_reset(&gdev->drm, gloss_sched_fini, NULL);
}
