// SPDX-License-Identifier: GPL-2.0-only
/*
 * What a job waits for, and what it signals, beside the fences of its objects: syncobjs
 * that a program names.
 */
#include <drm/drm_print.h>
#include <drm/drm_syncobj.h>
#include <linux/dma-fence-chain.h>
#include <linux/slab.h>
#include <linux/uaccess.h>

#include "gloss_drv.h"
#include "gloss_job.h"

/* Copies the sync at @index of an array of the program's, and checks it. */
static int gloss_sync_copy(struct drm_file *file, u64 array, unsigned int index,
			   struct drm_gloss_sync *sync)
{
	const struct drm_gloss_sync __user *from = u64_to_user_ptr(array);
	bool timeline;

	if (copy_from_user(sync, from + index, sizeof(*sync)))
		return -EFAULT;

	timeline = sync->flags & DRM_GLOSS_SYNC_TIMELINE;
	if (sync->flags & ~DRM_GLOSS_SYNC_TIMELINE || timeline != !!sync->point) {
		drm_dbg(file->minor->dev, "syncobj %u: flags %#x with point %llu\n", sync->handle,
			sync->flags, sync->point);
		return -EINVAL;
	}
	return 0;
}

/* Makes the job wait for the in-syncs. */
int gloss_sync_wait_for(struct gloss_job *job, struct drm_file *file,
			const struct drm_gloss_submit *args)
{
	struct drm_gloss_sync sync;
	struct dma_fence *fence;
	unsigned int i;
	int ret = 0;

	for (i = 0; i < args->in_sync_count && !ret; i++) {
		ret = gloss_sync_copy(file, args->in_syncs, i, &sync);
		if (ret)
			break;
		ret = drm_syncobj_find_fence(file, sync.handle, sync.point, 0, &fence);
		if (!ret)
			ret = drm_sched_job_add_dependency(&job->base, fence);
	}
	return ret;
}

static int gloss_sync_find_one(struct drm_file *file, const struct drm_gloss_sync *from,
			       struct gloss_sync *to)
{
	if (from->point) {
		to->chain = dma_fence_chain_alloc();
		if (!to->chain)
			return -ENOMEM;
		to->point = from->point;
	}
	to->syncobj = drm_syncobj_find(file, from->handle);
	return to->syncobj ? 0 : -ENOENT;
}

/*
 * The out-syncs, with all that gloss_sync_signal() needs in order not to fail; NULL for
 * none. Free them with gloss_sync_free().
 */
struct gloss_sync *gloss_sync_find(struct drm_file *file, const struct drm_gloss_submit *args)
{
	unsigned int i, count = args->out_sync_count;
	struct drm_gloss_sync from;
	struct gloss_sync *to;
	int ret = 0;

	if (!count)
		return NULL;

	to = kcalloc(count, sizeof(*to), GFP_KERNEL);
	if (!to)
		return ERR_PTR(-ENOMEM);

	for (i = 0; i < count && !ret; i++)
		ret = gloss_sync_copy(file, args->out_syncs, i, &from) ?:
		      gloss_sync_find_one(file, &from, &to[i]);
	if (ret) {
		gloss_sync_free(to, count);
		return ERR_PTR(ret);
	}
	return to;
}

/* Makes the out-syncs signal with @fence. */
void gloss_sync_signal(struct gloss_sync *syncs, unsigned int count, struct dma_fence *fence)
{
	unsigned int i;

	for (i = 0; i < count; i++) {
		if (syncs[i].chain)
			drm_syncobj_add_point(syncs[i].syncobj, syncs[i].chain, fence,
					      syncs[i].point);
		else
			drm_syncobj_replace_fence(syncs[i].syncobj, fence);
		syncs[i].chain = NULL;
	}
}

void gloss_sync_free(struct gloss_sync *syncs, unsigned int count)
{
	unsigned int i;

	if (!syncs)
		return;

	for (i = 0; i < count; i++) {
		dma_fence_chain_free(syncs[i].chain);
		if (syncs[i].syncobj)
			drm_syncobj_put(syncs[i].syncobj);
	}
	kfree(syncs);
}
