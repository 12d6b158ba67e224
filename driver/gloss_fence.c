// SPDX-License-Identifier: GPL-2.0-only
/*
 * The driver's fences. Programs only get those of the scheduler, in syncobjs and sync files;
 * these keep a reference to the job's fence, possibly for longer than the board is there.
 * So each fence holds a reference to the module, whose code it needs.
 */
#include <linux/dma-fence.h>
#include <linux/module.h>
#include <linux/rcupdate.h>
#include <linux/slab.h>

#include "gloss_drv.h"
#include "gloss_job.h"

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

/*
 * A fence that is not yet initialised, accounted to the caller; NULL: out of memory. Whoever has
 * a job made, an open file or an object, has a reference to the module.
 */
struct dma_fence *gloss_fence_new(void)
{
	struct dma_fence *fence = kzalloc(sizeof(*fence), GFP_KERNEL_ACCOUNT);

	if (fence)
		__module_get(THIS_MODULE);
	return fence;
}

/* Frees one that was never initialised; drop the reference to others instead. */
void gloss_fence_free(struct dma_fence *fence)
{
	kfree(fence);
	/* Whoever unloads the module waits until gloss_fence_free_rcu() has returned, too. */
	module_put(THIS_MODULE);
}
