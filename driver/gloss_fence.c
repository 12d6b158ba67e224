// SPDX-License-Identifier: GPL-2.0-only
/*
 * The driver's fences. Programs only get those of the scheduler, in syncobjs and sync files;
 * these keep a reference to the job's fence, possibly for longer than the board is there.
 * So the module, whose code the fences need, is not unloaded before the last of them is freed.
 */
#include <linux/dma-fence.h>
#include <linux/rcupdate.h>
#include <linux/slab.h>
#include <linux/wait.h>

#include "gloss_drv.h"

static atomic_t gloss_fences = ATOMIC_INIT(0);
static DECLARE_WAIT_QUEUE_HEAD(gloss_fences_wait);

static void gloss_fence_free_rcu(struct rcu_head *rcu)
{
	gloss_fence_free(container_of(rcu, struct dma_fence, rcu));
}

static void gloss_fence_release(struct dma_fence *fence)
{
	call_rcu(&fence->rcu, gloss_fence_free_rcu);
}

static const char *gloss_fence_driver_name(struct dma_fence *fence)
{
	return "gloss";
}

static const char *gloss_fence_timeline_name(struct dma_fence *fence)
{
	return "ring";
}

const struct dma_fence_ops gloss_fence_ops = {
	.get_driver_name = gloss_fence_driver_name,
	.get_timeline_name = gloss_fence_timeline_name,
	.release = gloss_fence_release,
};

/* A fence that is not yet initialised, accounted to the caller; NULL: out of memory. */
struct dma_fence *gloss_fence_new(void)
{
	struct dma_fence *fence = kzalloc(sizeof(*fence), GFP_KERNEL_ACCOUNT);

	if (fence)
		atomic_inc(&gloss_fences);
	return fence;
}

/* Frees one that was never initialised; drop the reference to others instead. */
void gloss_fence_free(struct dma_fence *fence)
{
	kfree(fence);
	if (atomic_dec_and_test(&gloss_fences))
		wake_up_all(&gloss_fences_wait);
}

/* Waits until there is no fence; as long as a program keeps a sync file, there may be one. */
void gloss_fences_wait_for_none(void)
{
	wait_event_idle(gloss_fences_wait, !atomic_read(&gloss_fences));
	/* The last gloss_fence_free_rcu() has to return, too. */
	rcu_barrier();
}
