// SPDX-License-Identifier: GPL-2.0-only
/*
 * The ioctl that makes a job. Everything that comes from a program is checked here, and
 * nothing after gloss_job_push() can fail; what is refused leaves nothing behind.
 */
#include <drm/drm_drv.h>
#include <drm/drm_gem.h>
#include <drm/drm_print.h>
#include <linux/capability.h>
#include <linux/uaccess.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

static int gloss_submit_check_counts(struct drm_device *drm, const struct drm_gloss_submit *args)
{
	if (args->slot_count > GLOSS_SLOTS || args->in_sync_count > DRM_GLOSS_SYNCS_MAX ||
	    args->out_sync_count > DRM_GLOSS_SYNCS_MAX) {
		drm_dbg(drm, "%u slots, %u in-syncs, %u out-syncs\n", args->slot_count,
			args->in_sync_count, args->out_sync_count);
		return -E2BIG;
	}
	return 0;
}

static int gloss_submit_check_strides(struct drm_device *drm, const struct drm_gloss_submit *args)
{
	u32 slot = args->slot_count ? sizeof(struct drm_gloss_slot) : 0;
	u32 sync = args->in_sync_count || args->out_sync_count ? sizeof(struct drm_gloss_sync) : 0;

	if (args->slot_stride != slot || args->sync_stride != sync) {
		drm_dbg(drm, "slots of %u bytes, syncs of %u\n", args->slot_stride,
			args->sync_stride);
		return -EINVAL;
	}
	return 0;
}

static int gloss_submit_check_priority(struct drm_device *drm, const struct drm_gloss_submit *args)
{
	if (args->flags & ~DRM_GLOSS_SUBMIT_EXPLICIT_SYNC || args->priority >= GLOSS_PRIORITIES) {
		drm_dbg(drm, "flags %#x, priority %u\n", args->flags, args->priority);
		return -EINVAL;
	}
	if (args->priority == DRM_GLOSS_PRIORITY_HIGH && !capable(CAP_SYS_NICE))
		return -EACCES;
	return 0;
}

static int gloss_submit_check(struct drm_device *drm, const struct drm_gloss_submit *args)
{
	return gloss_submit_check_counts(drm, args) ?:
	       gloss_submit_check_strides(drm, args) ?:
	       gloss_submit_check_priority(drm, args);
}

static bool gloss_submit_inside(u64 offset, u64 bytes, u64 size)
{
	return offset <= size && bytes <= size - offset;
}

/*
 * A host object with @bytes at @offset, which the board can reach; the reference is the
 * caller's, and the use, which gloss_gem_end_use() ends.
 */
static struct gloss_host_object *gloss_submit_find_host(struct drm_file *file, u32 handle,
							u64 offset, u64 bytes, u64 align)
{
	struct drm_gem_object *object = drm_gem_object_lookup(file, handle);
	int ret = -EINVAL;

	if (!object)
		return ERR_PTR(-ENOENT);

	if (!gloss_gem_is_host(object) || !IS_ALIGNED(offset, align) ||
	    !gloss_submit_inside(offset, bytes, object->size))
		drm_dbg(object->dev, "object %u has no %llu bytes at %llu for a job\n", handle,
			bytes, offset);
	else
		ret = gloss_host_use(to_gloss_host(object), to_gloss_file(file));
	if (ret) {
		drm_gem_object_put(object);
		return ERR_PTR(ret);
	}
	return to_gloss_host(object);
}

/* A stream or response; stores where the board finds its pages. */
static int gloss_submit_words(struct gloss_job *job, struct drm_file *file, u32 handle, u64 offset,
			      u32 words, bool write, dma_addr_t *list)
{
	struct gloss_host_object *host;

	if (!words)
		return handle || offset ? -EINVAL : 0;

	host = gloss_submit_find_host(file, handle, offset, (u64)words * sizeof(u32),
				      GLOSS_PAGE_BYTES);
	if (IS_ERR(host))
		return PTR_ERR(host);

	if (!write) {
		job->stream = host;
		job->stream_offset = offset;
	}
	*list = host->list_address + offset / GLOSS_PAGE_BYTES * sizeof(*host->list);
	return gloss_job_use(job, &host->base.base, write);
}

/* The driver itself writes the status, so it has to be in pages that the driver has. */
static int gloss_submit_status(struct gloss_job *job, struct drm_file *file, u32 handle,
			       u64 offset)
{
	struct gloss_host_object *host;

	if (!handle)
		return offset ? -EINVAL : 0;

	host = gloss_submit_find_host(file, handle, offset, sizeof(struct drm_gloss_status),
				      sizeof(struct drm_gloss_status));
	if (IS_ERR(host))
		return PTR_ERR(host);

	if (host->attach) {
		gloss_gem_end_use(&host->base.base);
		return -EINVAL;
	}
	job->status_page = host->pages[offset >> PAGE_SHIFT];
	job->status_offset = offset_in_page(offset);
	return gloss_job_use(job, &host->base.base, true);
}

static bool gloss_submit_slot_valid(const struct drm_gloss_slot *slot, u64 size)
{
	return slot->rights && !(slot->rights & ~(DRM_GLOSS_SLOT_READ | DRM_GLOSS_SLOT_WRITE)) &&
	       IS_ALIGNED(slot->offset, GLOSS_PAGE_BYTES) && IS_ALIGNED(slot->size, sizeof(u32)) &&
	       slot->size && slot->size <= U32_MAX &&
	       gloss_submit_inside(slot->offset, slot->size, size);
}

static int gloss_submit_slot(struct gloss_job *job, struct drm_file *file, u32 priority,
			     const struct drm_gloss_slot *slot, struct gloss_job_slot *to)
{
	struct drm_gem_object *object;
	int ret;

	if (!slot->handle)
		return slot->rights || slot->offset || slot->size ? -EINVAL : 0;

	object = drm_gem_object_lookup(file, slot->handle);
	if (!object)
		return -ENOENT;

	if (!gloss_gem_is_board(object) || !gloss_submit_slot_valid(slot, object->size)) {
		drm_dbg(object->dev, "no slot: object %u, rights %#x, %llu bytes at %llu\n",
			slot->handle, slot->rights, slot->size, slot->offset);
		drm_gem_object_put(object);
		return -EINVAL;
	}
	ret = gloss_clear_board(to_gloss_board(object), job->file, priority);
	if (ret) {
		drm_gem_object_put(object);
		return ret;
	}
	*to = (struct gloss_job_slot) {
		.base = to_gloss_board(object)->node.start + slot->offset,
		.size = slot->size,
		.rights = slot->rights,
	};
	return gloss_job_use(job, object, slot->rights & DRM_GLOSS_SLOT_WRITE);
}

static int gloss_submit_slots(struct gloss_job *job, struct drm_file *file,
			      const struct drm_gloss_submit *args)
{
	const struct drm_gloss_slot __user *from = u64_to_user_ptr(args->slots);
	struct drm_gloss_slot slot;
	unsigned int i;
	int ret = 0;

	for (i = 0; i < args->slot_count && !ret; i++) {
		if (copy_from_user(&slot, from + i, sizeof(slot)))
			return -EFAULT;
		ret = gloss_submit_slot(job, file, args->priority, &slot, &job->slot[i]);
	}
	return ret;
}

/* Gives the job everything it needs. */
static int gloss_submit_fill(struct gloss_job *job, struct drm_file *file,
			     const struct drm_gloss_submit *args)
{
	job->explicit_sync = args->flags & DRM_GLOSS_SUBMIT_EXPLICIT_SYNC;
	job->stream_words = args->stream_words;
	job->response_words = args->response_words;
	return gloss_submit_words(job, file, args->stream, args->stream_offset,
				  args->stream_words, false, &job->stream_list) ?:
	       gloss_submit_words(job, file, args->response, args->response_offset,
				  args->response_words, true, &job->response_list) ?:
	       gloss_submit_status(job, file, args->status, args->status_offset) ?:
	       gloss_submit_slots(job, file, args) ?:
	       gloss_sync_wait_for(job, file, args);
}

/* Queues a job, or frees it; makes the out-syncs signal when it has ended. */
static int gloss_submit_job(struct gloss_job *job, struct drm_file *file,
			    const struct drm_gloss_submit *args)
{
	struct ww_acquire_ctx ctx;
	struct gloss_sync *syncs;
	struct dma_fence *fence;
	int ret;

	syncs = gloss_sync_find(file, args);
	if (IS_ERR(syncs))
		return PTR_ERR(syncs);

	ret = gloss_job_lock(job, &ctx);
	if (!ret) {
		fence = gloss_job_push(job, &ctx);
		gloss_sync_signal(syncs, args->out_sync_count, fence);
		dma_fence_put(fence);
	}
	gloss_sync_free(syncs, args->out_sync_count);
	return ret;
}

/*
 * Jobs that are queued take up memory of the kernel: there is an end to it. Who has so many
 * waits for one of them, as for a full pipe.
 */
static int gloss_submit_wait_for_room(struct gloss_device *gdev, const struct drm_file *file)
{
	const struct gloss_file *gfile = file->driver_priv;

	if (atomic_read(&gfile->jobs_queued) < GLOSS_FILE_JOBS)
		return 0;
	if (file->filp->f_flags & O_NONBLOCK)
		return -EAGAIN;
	return wait_event_interruptible(gdev->jobs_wait,
					atomic_read(&gfile->jobs_queued) < GLOSS_FILE_JOBS ||
					gloss_device_gone(gdev));
}

int gloss_submit_ioctl(struct drm_device *drm, void *data, struct drm_file *file)
{
	struct gloss_device *gdev = to_gloss_device(drm);
	struct gloss_file *gfile = to_gloss_file(file);
	const struct drm_gloss_submit *args = data;
	struct gloss_job *job;
	int ret;

	if (gloss_device_gone(gdev))
		return -ENODEV;

	ret = gloss_submit_check(drm, args) ?: gloss_submit_wait_for_room(gdev, file);
	if (ret)
		return ret;

	job = gloss_job_new(gdev, gfile, args->priority);
	if (IS_ERR(job))
		return PTR_ERR(job);

	ret = gloss_submit_fill(job, file, args) ?: gloss_submit_job(job, file, args);
	if (ret)
		gloss_job_free(job);
	return ret;
}
