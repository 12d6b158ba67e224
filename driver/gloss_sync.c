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

static int gloss_sync_check(struct drm_file *file, const struct drm_gloss_sync *sync)
{
	bool timeline = sync->flags & DRM_GLOSS_SYNC_TIMELINE;

	if (sync->flags & ~DRM_GLOSS_SYNC_TIMELINE || timeline != !!sync->point) {
		drm_dbg(file->minor->dev, "syncobj %u: flags %#x with point %llu\n", sync->handle,
			sync->flags, sync->point);
		return -EINVAL;
	}
	return 0;
}

/* Copies and checks an array of syncs; free it with kfree(). NULL for an empty one. */
static struct drm_gloss_sync *gloss_sync_copy(struct drm_file *file, u64 user, u32 count)
{
	struct drm_gloss_sync *syncs;
	unsigned int i;
	int ret;

	if (!count)
		return NULL;

	syncs = memdup_user(u64_to_user_ptr(user), count * sizeof(*syncs));
	if (IS_ERR(syncs))
		return syncs;

	for (i = 0; i < count; i++) {
		ret = gloss_sync_check(file, &syncs[i]);
		if (ret) {
			kfree(syncs);
			return ERR_PTR(ret);
		}
	}
	return syncs;
}

/* Makes the job wait for the in-syncs. */
int gloss_sync_wait_for(struct gloss_job *job, struct drm_file *file,
			const struct drm_gloss_submit *args)
{
	struct drm_gloss_sync *syncs = gloss_sync_copy(file, args->in_syncs, args->in_sync_count);
	struct dma_fence *fence;
	unsigned int i;
	int ret = 0;

	if (IS_ERR(syncs))
		return PTR_ERR(syncs);

	for (i = 0; i < args->in_sync_count && !ret; i++) {
		ret = drm_syncobj_find_fence(file, syncs[i].handle, syncs[i].point, 0, &fence);
		if (!ret)
			ret = drm_sched_job_add_dependency(&job->base, fence);
	}
	kfree(syncs);
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

static int gloss_sync_find_all(struct drm_file *file, const struct drm_gloss_sync *from,
			       struct gloss_sync *to, u32 count)
{
	unsigned int i;
	int ret = 0;

	for (i = 0; i < count && !ret; i++)
		ret = gloss_sync_find_one(file, &from[i], &to[i]);
	return ret;
}

/*
 * The out-syncs, with all that gloss_sync_signal() needs in order not to fail; NULL for
 * none. Free them with gloss_sync_free().
 */
struct gloss_sync *gloss_sync_find(struct drm_file *file, const struct drm_gloss_submit *args)
{
	u32 count = args->out_sync_count;
	struct drm_gloss_sync *from = gloss_sync_copy(file, args->out_syncs, count);
	struct gloss_sync *to;
	int ret;

	if (IS_ERR_OR_NULL(from))
		return ERR_CAST(from);

	to = kcalloc(count, sizeof(*to), GFP_KERNEL);
	ret = to ? gloss_sync_find_all(file, from, to, count) : -ENOMEM;
	kfree(from);
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

	for (i = 0; syncs && i < count; i++) {
		dma_fence_chain_free(syncs[i].chain);
		if (syncs[i].syncobj)
			drm_syncobj_put(syncs[i].syncobj);
	}
	kfree(syncs);
}
