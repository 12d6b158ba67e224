// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: The scheduler, and jobs that hang
 *
 * The DRM scheduler keeps the jobs of each entity in order and knows what they wait for. Which
 * of the entities is next decides gloss_turn; what is run, the scheduler gives to the ring.
 *
 * How long that takes is watched here, and not by the scheduler, whose own timer would take it
 * apart for each late job. As long as the ring has jobs, a work looks at it every timeout_ms.
 * If a job has ended, and its interrupt has not come a moment later, that was lost. If the board
 * has not moved for timeout_ms, the job at the ring's head hung; if the job has run for
 * job_limit_ms, it ends all the same. A DMA error makes the driver look at once, and the board
 * names the job. Then the board is reset, and given the ring again, with an empty job in place of
 * the one to blame, which so ends in its turn. Neither the scheduler nor the other jobs' fences
 * notice.
 *
 * The scheduler lives until the last open file is closed, also when the board has gone before:
 * that is how the jobs which are still queued end.
 */
#include <drm/drm_drv.h>
#include <drm/drm_managed.h>
#include <drm/drm_print.h>
#include <linux/bitfield.h>
#include <linux/iopoll.h>
#include <linux/slab.h>
#include <linux/workqueue.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

/* How long after the end of its job an interrupt may come. */
#define GLOSS_INTERRUPT_MS	100

/* Zero would be no time at all for a job. */
static unsigned int gloss_sched_timeout_ms(void)
{
	return max(gloss_timeout_ms, 1u);
}

static unsigned int gloss_sched_limit_ms(void)
{
	return max(READ_ONCE(gloss_job_limit_ms), 1u);
}

/* Nothing, if a look is due anyhow. */
static void gloss_sched_look_in(struct gloss_device *gdev, unsigned int ms)
{
	queue_delayed_work(gdev->watch_wq, &gdev->watch, msecs_to_jiffies(ms) + 1);
}

static struct dma_fence *gloss_sched_prepare_job(struct drm_sched_job *base,
						 struct drm_sched_entity *entity)
{
	struct gloss_job *job = to_gloss_job(base);

	return gloss_turn_ask(&job->gdev->turns, &job->turn);
}

static struct dma_fence *gloss_sched_run(struct gloss_job *job)
{
	struct gloss_device *gdev = job->gdev;
	/* The job may end, and be freed, as soon as the board has it. */
	struct dma_fence *fence = job->fence;
	bool entered;
	int idx;

	gloss_job_begin(job);
	dma_fence_get(fence);
	entered = drm_dev_enter(&gdev->drm, &idx);
	if (!entered)
		gloss_device_set_gone(gdev, NULL);
	gloss_ring_push(gdev, job);
	if (entered) {
		gloss_sched_look_in(gdev, min(gloss_sched_timeout_ms(), gloss_sched_limit_ms()));
		drm_dev_exit(idx);
	}
	return fence;
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

/* Says who is to blame for a reset. A program that was closed on purpose is no error. */
static void gloss_sched_tell(struct gloss_device *gdev, const struct gloss_ring_fault *fault,
			     bool dma)
{
	struct drm_device *drm = &gdev->drm;

	if (dma)
		drm_err(drm, "DMA to %#llx was refused: job %u of process %d is lost\n",
			fault->dma_address, fault->sequence, fault->pid);
	else if (fault->status.error == -EIO)
		drm_err(drm, "job %u of process %d hung the board, and is lost\n",
			fault->sequence, fault->pid);
	else if (fault->status.error == -ETIME)
		drm_err(drm, "job %u of process %d ran for more than %u ms, and is lost\n",
			fault->sequence, fault->pid, gloss_sched_limit_ms());
}

/* Resets the board, and has it go on with what it had not ended, but for one job. */
static int gloss_sched_reset(struct gloss_device *gdev, bool dma, int error)
{
	struct gloss_ring_fault fault = { .status.error = error };
	struct gloss_coredump *dump = gloss_coredump_new(gdev);
	struct gloss_ring *ring = &gdev->ring;
	unsigned int ended;
	int ret;

	if (dma)
		gloss_sched_read_fault(gdev, &fault);
	atomic_inc(&gdev->resets);
	ret = gloss_device_reset(gdev);
	if (ret)
		goto free_dump;

	/* The board may have ended jobs after all, as the last thing before its reset. */
	ended = gloss_ring_reap(ring);
	if ((dma || !ended) && !gloss_ring_idle(ring)) {
		ret = gloss_ring_blame(ring, fault.sequence, &fault) ? 0 : -EIO;
		if (ret)
			goto free_dump;
		gloss_sched_tell(gdev, &fault, dma);
		gloss_coredump_job(gdev, dump, &fault);
		dump = NULL;
	}
	gloss_ring_rewind(ring);
	ret = gloss_ring_start(gdev);

free_dump:
	kfree(dump);
	return ret;
}

/* Whether the board has done anything in the last timeout_ms, or has not had a job for so long. */
static bool gloss_sched_moved(struct gloss_device *gdev)
{
	struct gloss_ring *ring = &gdev->ring;
	u32 head = gloss_read(gdev, GLOSS_REG_HEAD);
	u32 progress = gloss_read(gdev, GLOSS_REG_PROGRESS);
	ktime_t now = ktime_get();

	if (head != ring->seen_head || progress != ring->seen_progress) {
		ring->seen_head = head;
		ring->seen_progress = progress;
		ring->seen = now;
	}
	return min(ktime_ms_delta(now, ring->seen), gloss_ring_ran_ms(ring)) <
	       gloss_sched_timeout_ms();
}

/* What the job at the ring's head is to end with now, or 0: nothing is wrong with it. */
static int gloss_sched_judge(struct gloss_device *gdev, u32 status)
{
	int error;

	if (status & GLOSS_REG_STATUS_DMA_ERROR)
		return -EIO;
	if (gloss_ring_left_ms(&gdev->ring, gloss_sched_limit_ms(), &error) <= 0)
		return error;
	return gloss_sched_moved(gdev) ? 0 : -EIO;
}

/* Whether the board has ended a job and told of it, which may yet be heard. */
static bool gloss_sched_interrupt_due(struct gloss_device *gdev)
{
	enum gloss_ring_news news = gloss_ring_news(&gdev->ring);

	if (news == GLOSS_RING_UNHEARD && gloss_ring_reap(&gdev->ring)) {
		atomic_inc(&gdev->interrupts_lost);
		drm_notice(&gdev->drm, "an interrupt was lost\n");
	}
	return news == GLOSS_RING_ENDED;
}

/* Finds out why the ring's jobs have not ended. */
static void gloss_sched_look(struct gloss_device *gdev)
{
	struct gloss_ring *ring = &gdev->ring;
	u32 status;
	int error;

	if (gloss_sched_interrupt_due(gdev) || gloss_ring_idle(ring))
		return;

	status = gloss_read(gdev, GLOSS_REG_STATUS);
	if (status == U32_MAX) {
		gloss_device_set_gone(gdev, "it does not answer");
		return;
	}
	error = gloss_sched_judge(gdev, status);
	if (error && gloss_sched_reset(gdev, status & GLOSS_REG_STATUS_DMA_ERROR, error))
		gloss_device_set_gone(gdev, "it can not be reset");
}

static unsigned int gloss_sched_next_look_ms(struct gloss_device *gdev)
{
	int error;
	s64 left = gloss_ring_left_ms(&gdev->ring, gloss_sched_limit_ms(), &error);

	if (READ_ONCE(gdev->ring.unheard))
		return GLOSS_INTERRUPT_MS;
	return clamp_t(s64, left, 1, gloss_sched_timeout_ms());
}

static void gloss_sched_watch(struct work_struct *work)
{
	struct gloss_device *gdev = container_of(work, struct gloss_device, watch.work);
	struct gloss_ring *ring = &gdev->ring;
	bool signalling;
	int idx;

	if (!drm_dev_enter(&gdev->drm, &idx))
		return;

	signalling = dma_fence_begin_signalling();
	mutex_lock(&ring->push_lock);
	if (!gloss_device_gone(gdev) && !ring->asleep)
		gloss_sched_look(gdev);
	mutex_unlock(&ring->push_lock);
	dma_fence_end_signalling(signalling);

	if (!gloss_ring_idle(ring))
		gloss_sched_look_in(gdev, gloss_sched_next_look_ms(gdev));
	drm_dev_exit(idx);
}

static const struct drm_sched_backend_ops gloss_sched_ops = {
	.GLOSS_COMPAT_PREPARE_JOB = gloss_sched_prepare_job,
	.run_job = gloss_sched_run_job,
	.free_job = gloss_sched_free_job,
};

/* Looks at the ring now. */
void gloss_sched_kick(struct gloss_device *gdev)
{
	mod_delayed_work(gdev->watch_wq, &gdev->watch, 0);
}

/*
 * Before the board loses its power: lets it end what it has, if it can, and keeps the rest
 * queued.
 */
void gloss_sched_suspend(struct gloss_device *gdev)
{
	struct gloss_ring *ring = &gdev->ring;
	bool idle;

	gloss_turns_hold(&gdev->turns, true);
	read_poll_timeout(gloss_turns_idle, idle, idle, USEC_PER_MSEC,
			  (u64)gloss_sched_timeout_ms() * USEC_PER_MSEC, false, &gdev->turns);

	mutex_lock(&ring->push_lock);
	ring->asleep = true;
	gloss_device_reset(gdev);
	/* As an interrupt may have been lost. */
	gloss_ring_reap(ring);
	gloss_ring_fail(ring, -EIO);
	mutex_unlock(&ring->push_lock);
}

/* The board may not come back; then its jobs end. */
void gloss_sched_resume(struct gloss_device *gdev)
{
	struct gloss_ring *ring = &gdev->ring;

	mutex_lock(&ring->push_lock);
	if (!gloss_device_gone(gdev)) {
		gloss_ring_rewind(ring);
		if (gloss_device_reset(gdev) ?: gloss_ring_start(gdev))
			gloss_device_set_gone(gdev, "it did not come back from sleep");
	}
	ring->asleep = false;
	mutex_unlock(&ring->push_lock);

	gloss_memory_clear(gdev);
	gloss_files_lost(gdev);
	gloss_turns_hold(&gdev->turns, false);
}

/* The last file is closed and the board has gone, so all jobs end by themselves. */
static void gloss_sched_fini(struct drm_device *drm, void *data)
{
	struct gloss_device *gdev = to_gloss_device(drm);

	wait_event(gdev->jobs_wait, !atomic_read(&gdev->jobs));
	cancel_delayed_work_sync(&gdev->watch);
	drm_sched_fini(&gdev->sched);
}

static void gloss_sched_fini_queues(struct drm_device *drm, void *data)
{
	struct gloss_device *gdev = to_gloss_device(drm);

	destroy_workqueue(gdev->free_wq);
	destroy_workqueue(gdev->watch_wq);
}

static int gloss_sched_init_queues(struct gloss_device *gdev)
{
	/* Who waits for memory may wait for a fence, and that for this. */
	gdev->watch_wq = alloc_ordered_workqueue("gloss", WQ_MEM_RECLAIM);
	if (!gdev->watch_wq)
		return -ENOMEM;

	gdev->free_wq = alloc_workqueue("gloss_free", WQ_UNBOUND, 0);
	if (!gdev->free_wq) {
		destroy_workqueue(gdev->watch_wq);
		return -ENOMEM;
	}
	return drmm_add_action_or_reset(&gdev->drm, gloss_sched_fini_queues, NULL);
}

int gloss_sched_init(struct gloss_device *gdev)
{
	int ret;

	gloss_turns_init(&gdev->turns);
	INIT_DELAYED_WORK(&gdev->watch, gloss_sched_watch);
	gloss_coredump_init(gdev);
	ret = gloss_sched_init_queues(gdev) ?:
	      gloss_compat_sched_init(&gdev->sched, &gloss_sched_ops, GLOSS_RING_ENTRIES - 1,
				      gdev->drm.dev);
	if (ret)
		return ret;
	return drmm_add_action_or_reset(&gdev->drm, gloss_sched_fini, NULL);
}
