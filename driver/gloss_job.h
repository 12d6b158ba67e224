/* SPDX-License-Identifier: GPL-2.0-only */
/* A job, from SUBMIT to its end. */
#ifndef GLOSS_JOB_H
#define GLOSS_JOB_H

#include <drm/gpu_scheduler.h>
#include <linux/dma-fence.h>
#include <linux/ktime.h>
#include <linux/list.h>
#include <linux/workqueue.h>

#include "gloss_drm.h"
#include "gloss_regs.h"
#include "gloss_turn.h"

struct dma_fence_chain;
struct drm_device;
struct drm_file;
struct drm_gem_object;
struct drm_syncobj;
struct gloss_board_object;
struct gloss_device;
struct gloss_file;
struct gloss_host_object;
struct page;
struct ww_acquire_ctx;

/* A job's objects: its slots, stream, response and status. */
#define GLOSS_JOB_OBJECTS	(GLOSS_SLOTS + 3)

enum gloss_job_state {
	GLOSS_JOB_WAITING,		/* the scheduler has it, or nobody yet */
	GLOSS_JOB_RUNNING,		/* it is in the ring */
	GLOSS_JOB_ENDED,
};

/* A range of board memory, as the board's slot table has it. */
struct gloss_job_slot {
	u32 base, size, rights;
};

struct gloss_job {
	struct drm_sched_job base;
	struct gloss_device *gdev;
	struct gloss_file *file;	/* NULL: the driver's own */
	struct gloss_board_object *clears;	/* the object whose clearing this is, or NULL */
	u32 clearing;			/* which one */

	struct gloss_turn turn;
	/* Allocated with the job, initialised when it is run. */
	struct dma_fence *fence;
	struct work_struct free;		/* of gloss_device.free_wq */
	enum gloss_job_state state;
	struct list_head ring_node;	/* in gloss_ring.list, while it is running */
	/* Why the board is to skip this job, which then is how it ends; 0: it is not. */
	int refused;
	unsigned int hangs;		/* how often it was to blame */

	/* For the board. */
	u32 sequence;
	u32 stream_words, response_words;
	dma_addr_t stream_list, response_list;
	struct gloss_host_object *stream;	/* one of @objects, or NULL: for a dump of it */
	u64 stream_offset;
	struct gloss_job_slot slot[GLOSS_SLOTS];

	/* Where the status goes; NULL: nowhere. The page is pinned by one of @objects. */
	struct page *status_page;
	u32 status_offset;

	ktime_t begun;			/* when it was put into the ring */

	bool explicit_sync;		/* DRM_GLOSS_SUBMIT_EXPLICIT_SYNC */
	/* References, none twice; bit i of @writes: the job writes object i. */
	struct drm_gem_object *object[GLOSS_JOB_OBJECTS];
	unsigned int objects;
	u32 writes;
};

static inline struct gloss_job *to_gloss_job(struct drm_sched_job *base)
{
	return container_of(base, struct gloss_job, base);
}

/* gloss_submit.c */
int gloss_submit_ioctl(struct drm_device *drm, void *data, struct drm_file *file);

/* gloss_sync.c */

/* An out-sync: a syncobj, and the point to add to it, if it is a timeline. */
struct gloss_sync {
	struct drm_syncobj *syncobj;
	struct dma_fence_chain *chain;
	u64 point;
};

int gloss_sync_wait_for(struct gloss_job *job, struct drm_file *file,
			const struct drm_gloss_submit *args);
struct gloss_sync *gloss_sync_find(struct drm_file *file, const struct drm_gloss_submit *args);
void gloss_sync_signal(struct gloss_sync *syncs, unsigned int count, struct dma_fence *fence);
void gloss_sync_free(struct gloss_sync *syncs, unsigned int count);

/* gloss_job.c */
struct gloss_job *gloss_job_new(struct gloss_device *gdev, struct gloss_file *file,
				u32 priority);
int gloss_job_use(struct gloss_job *job, struct drm_gem_object *object, bool write);
int gloss_job_lock(struct gloss_job *job, struct ww_acquire_ctx *ctx);
struct dma_fence *gloss_job_push(struct gloss_job *job, struct ww_acquire_ctx *ctx);
void gloss_job_begin(struct gloss_job *job);
int gloss_job_refusal(const struct gloss_job *job);
void gloss_job_refuse(struct gloss_job *job, int error);
void gloss_job_end(struct gloss_job *job, const struct drm_gloss_status *status);
void gloss_job_free(struct gloss_job *job);
void gloss_job_free_work(struct work_struct *work);

/* gloss_fence.c */
extern const struct dma_fence_ops gloss_fence_ops;
struct dma_fence *gloss_fence_new(void);
void gloss_fence_free(struct dma_fence *fence);

#endif
