/* SPDX-License-Identifier: GPL-2.0-only */
/*
 * Where kernels differ, from 6.1 on, so that no other file has to know. What one offers is
 * found by features.sh. A driver inside the kernel has no such file.
 */
#ifndef GLOSS_COMPAT_H
#define GLOSS_COMPAT_H

#include <drm/drm_drv.h>
#include <drm/drm_prime.h>
#include <drm/gpu_scheduler.h>
#include <linux/dma-buf.h>
#include <linux/fs.h>
#include <linux/mm.h>
#include <linux/pci.h>
#include <linux/shrinker.h>
#include <linux/slab.h>

#include "gloss_features.h"

#ifndef PCI_IRQ_INTX
#define PCI_IRQ_INTX	PCI_IRQ_LEGACY
#endif

/* Of struct drm_driver: what later kernels do by themselves. */
#ifdef GLOSS_HAVE_GEM_PRIME_MMAP
#define GLOSS_COMPAT_PRIME \
	.prime_handle_to_fd = drm_gem_prime_handle_to_fd, \
	.prime_fd_to_handle = drm_gem_prime_fd_to_handle, \
	.gem_prime_mmap = drm_gem_prime_mmap,
#else
#define GLOSS_COMPAT_PRIME
#endif

#ifdef GLOSS_HAVE_DRIVER_DATE
#define GLOSS_COMPAT_DATE	.date = "20261125",
#else
#define GLOSS_COMPAT_DATE
#endif

/* The name of a namespace, which later kernels want as a string. */
#ifdef GLOSS_HAVE_IMPORT_NS_NAME
#define GLOSS_COMPAT_IMPORT_NS(name)	MODULE_IMPORT_NS(name)
#else
#define GLOSS_COMPAT_IMPORT_NS(name)	MODULE_IMPORT_NS(#name)
#endif

#ifdef GLOSS_HAVE_SCHED_PRIORITY_LOW
#define GLOSS_SCHED_PRIORITY_LOW	DRM_SCHED_PRIORITY_LOW
#else
#define GLOSS_SCHED_PRIORITY_LOW	DRM_SCHED_PRIORITY_MIN
#endif

/* A scheduler that runs @ahead jobs at once, and does not watch how long they take. */
static inline int gloss_compat_sched_init(struct drm_gpu_scheduler *sched,
					  const struct drm_sched_backend_ops *ops, u32 ahead,
					  struct device *dev)
{
#if defined(GLOSS_HAVE_SCHED_INIT_ARGS)
	const struct drm_sched_init_args args = {
		.ops = ops,
#ifdef GLOSS_HAVE_SCHED_INIT_ARGS_NUM_RQS
		/* Zero compiles, and makes a scheduler without a queue for any priority. */
		.num_rqs = DRM_SCHED_PRIORITY_COUNT,
#endif
		.credit_limit = ahead,
		.timeout = MAX_SCHEDULE_TIMEOUT,
		.name = "gloss",
		.dev = dev,
	};

	return drm_sched_init(sched, &args);
#elif defined(GLOSS_HAVE_SCHED_INIT_SUBMIT_WQ)
	return drm_sched_init(sched, ops, NULL, DRM_SCHED_PRIORITY_COUNT, ahead, 0,
			      MAX_SCHEDULE_TIMEOUT, NULL, NULL, "gloss", dev);
#elif defined(GLOSS_HAVE_SCHED_INIT_NUM_RQS)
	return drm_sched_init(sched, ops, DRM_SCHED_PRIORITY_COUNT, ahead, 0,
			      MAX_SCHEDULE_TIMEOUT, NULL, NULL, "gloss", dev);
#else
	return drm_sched_init(sched, ops, ahead, 0, MAX_SCHEDULE_TIMEOUT, NULL, NULL, "gloss",
			      dev);
#endif
}

/* The member of struct drm_sched_backend_ops that is asked what else a job waits for. */
#ifdef GLOSS_HAVE_SCHED_PREPARE_JOB
#define GLOSS_COMPAT_PREPARE_JOB	prepare_job
#else
#define GLOSS_COMPAT_PREPARE_JOB	dependency
#endif

/* @client is what the scheduler's tracepoints call the job's file, where they name it. */
static inline int gloss_compat_sched_job_init(struct drm_sched_job *job,
					      struct drm_sched_entity *entity, void *owner,
					      u64 client)
{
#if defined(GLOSS_HAVE_SCHED_JOB_CLIENT)
	return drm_sched_job_init(job, entity, 1, owner, client);
#elif defined(GLOSS_HAVE_SCHED_JOB_CREDITS)
	return drm_sched_job_init(job, entity, 1, owner);
#else
	return drm_sched_job_init(job, entity, owner);
#endif
}

/* To be called before the fence of @job signals that it failed. */
static inline void gloss_compat_sched_job_failed(struct drm_sched_job *job, int error)
{
#ifdef GLOSS_HAVE_SCHED_FENCE_NO_RESULT
	/* This scheduler does not look at the error of a job's own fence. */
	dma_fence_set_error(&job->s_fence->finished, error);
#endif
}

/* For callers that have not locked the dma-buf's reservation, which later kernels ask for. */
static inline void gloss_compat_dma_buf_unmap(struct dma_buf_attachment *attach,
					      struct sg_table *sgt)
{
#ifdef GLOSS_HAVE_DMA_BUF_UNMAP_UNLOCKED
	dma_buf_unmap_attachment_unlocked(attach, sgt, DMA_BIDIRECTIONAL);
#else
	dma_buf_unmap_attachment(attach, sgt, DMA_BIDIRECTIONAL);
#endif
}

/* Tells by a uevent that the board was reset, or is lost. */
static inline void gloss_compat_wedged(struct drm_device *drm, bool recovered)
{
#if defined(GLOSS_HAVE_DEV_WEDGED_EVENT_INFO)
	drm_dev_wedged_event(drm, recovered ? DRM_WEDGE_RECOVERY_NONE :
			     DRM_WEDGE_RECOVERY_REBIND | DRM_WEDGE_RECOVERY_BUS_RESET, NULL);
#elif defined(GLOSS_HAVE_DEV_WEDGED_EVENT)
	drm_dev_wedged_event(drm, recovered ? DRM_WEDGE_RECOVERY_NONE :
			     DRM_WEDGE_RECOVERY_REBIND | DRM_WEDGE_RECOVERY_BUS_RESET);
#endif
}

static inline int gloss_compat_mmap(struct file *file, struct vm_area_struct *vma)
{
#ifdef GLOSS_HAVE_CALL_MMAP
	return call_mmap(file, vma);
#else
	return vfs_mmap(file, vma);
#endif
}

static inline bool gloss_compat_is_cow_mapping(const struct vm_area_struct *vma)
{
#ifdef GLOSS_HAVE_VMA_IS_COW_MAPPING
	return vma_is_cow_mapping(vma);
#else
	return is_cow_mapping(vma->vm_flags);
#endif
}

static inline void gloss_compat_vm_flags_set(struct vm_area_struct *vma, vm_flags_t flags)
{
#ifdef GLOSS_HAVE_VM_FLAGS_SET
	vm_flags_set(vma, flags);
#else
	vma->vm_flags |= flags;
#endif
}

typedef unsigned long (*gloss_compat_shrinker_fn)(struct shrinker *, struct shrink_control *);

#ifdef GLOSS_HAVE_SHRINKER_ALLOC
static inline struct shrinker *gloss_compat_shrinker_new(gloss_compat_shrinker_fn count,
							 gloss_compat_shrinker_fn scan,
							 void *owner)
{
	struct shrinker *shrinker = shrinker_alloc(0, "drm-gloss");

	if (!shrinker)
		return NULL;
	shrinker->count_objects = count;
	shrinker->scan_objects = scan;
	shrinker->private_data = owner;
	shrinker_register(shrinker);
	return shrinker;
}

static inline void *gloss_compat_shrinker_owner(struct shrinker *shrinker)
{
	return shrinker->private_data;
}

static inline void gloss_compat_shrinker_free(struct shrinker *shrinker)
{
	shrinker_free(shrinker);
}
#else
struct gloss_compat_shrinker {
	struct shrinker base;
	void *owner;
};

static inline struct shrinker *gloss_compat_shrinker_new(gloss_compat_shrinker_fn count,
							 gloss_compat_shrinker_fn scan,
							 void *owner)
{
	struct gloss_compat_shrinker *shrinker = kzalloc(sizeof(*shrinker), GFP_KERNEL);

	if (!shrinker)
		return NULL;
	shrinker->base.count_objects = count;
	shrinker->base.scan_objects = scan;
	shrinker->base.seeks = DEFAULT_SEEKS;
	shrinker->owner = owner;
	if (register_shrinker(&shrinker->base, "drm-gloss")) {
		kfree(shrinker);
		return NULL;
	}
	return &shrinker->base;
}

static inline void *gloss_compat_shrinker_owner(struct shrinker *shrinker)
{
	return container_of(shrinker, struct gloss_compat_shrinker, base)->owner;
}

static inline void gloss_compat_shrinker_free(struct shrinker *shrinker)
{
	unregister_shrinker(shrinker);
	kfree(container_of(shrinker, struct gloss_compat_shrinker, base));
}
#endif

#endif
