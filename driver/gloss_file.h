/* SPDX-License-Identifier: GPL-2.0-only */
/* Open files. */
#ifndef GLOSS_FILE_H
#define GLOSS_FILE_H

#include <drm/drm_file.h>
#include <drm/gpu_scheduler.h>
#include <linux/kref.h>
#include <linux/mutex.h>

#include "gloss_drm.h"
#include "gloss_gem.h"
#include "gloss_ring.h"

struct gloss_device;

/* Jobs of a file, queued or under way, above which SUBMIT waits. */
#define GLOSS_FILE_JOBS		1024
#define GLOSS_PRIORITIES	(DRM_GLOSS_PRIORITY_HIGH + 1)

/* An open file. Its jobs hold references, so it may outlive its closing. */
struct gloss_file {
	struct kref ref;
	struct gloss_device *gdev;
	pid_t pid;
	bool closed;			/* jobs that have not begun are cancelled */
	atomic_t jobs_lost;		/* DRM_GLOSS_PARAM_JOBS_LOST */
	atomic64_t engine_ns;		/* time the board worked for this file */
	atomic64_t jobs;		/* ended */
	u64 clocks, stall[GLOSS_STALLS];	/* of its jobs; under gloss_ring.lock */
	u64 held[GLOSS_SHARES];		/* under the lock of the gloss_share */
	atomic_t jobs_queued;		/* that exist */
	struct mutex lock;		/* keeps the jobs of an entity in order */
	struct drm_sched_entity entity[GLOSS_PRIORITIES];
};

static inline struct gloss_file *to_gloss_file(struct drm_file *drm)
{
	return drm->driver_priv;
}

/*
 * What drm-client-id and the tracepoints call a file: unlike a pid it is no other file's.
 * 0: the driver itself.
 */
static inline u64 gloss_file_client(const struct gloss_file *file)
{
	return file ? file->entity[0].fence_context : 0;
}

/* gloss_file.c */
int gloss_file_open(struct drm_device *drm, struct drm_file *file);
void gloss_file_close(struct drm_device *drm, struct drm_file *file);
void gloss_file_put(struct gloss_file *gfile);
void gloss_files_lost(struct gloss_device *gdev);

#endif
