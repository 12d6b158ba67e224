// SPDX-License-Identifier: GPL-2.0-only
/**
 * DOC: Clocks of a file's jobs
 *
 * The board counts clocks, and where they went, of all jobs since its reset. A file is told of
 * its own jobs alone: what others do, and when, is not its business. So the counters are
 * read when a job of another file may be next, or after a second, as the smaller ones wrap; one
 * client costs no more than that. They move only when a job ends, so what the next one has
 * done by then is not in them. If jobs of several files have ended before the driver looked,
 * nobody gets these clocks.
 */
#include <drm/drm_drv.h>
#include <drm/drm_managed.h>

#include "gloss_drv.h"
#include "gloss_file.h"
#include "gloss_job.h"

static u64 gloss_clocks_read_total(struct gloss_device *gdev)
{
	u32 high, low;

	do {
		high = gloss_read(gdev, GLOSS_REG_CLOCKS_HIGH);
		low = gloss_read(gdev, GLOSS_REG_CLOCKS_LOW);
	} while (high != gloss_read(gdev, GLOSS_REG_CLOCKS_HIGH));
	return (u64)high << 32 | low;
}

static void gloss_clocks_read(struct gloss_device *gdev, struct gloss_clocks_seen *seen)
{
	unsigned int i;

	seen->clocks = gloss_clocks_read_total(gdev);
	for (i = 0; i < GLOSS_STALLS; i++)
		seen->stall[i] = gloss_read(gdev, GLOSS_REG_STALL_STREAM + i * sizeof(u32));
}

/* A file is kept until it has its clocks, though it may be closed by then. */
static void gloss_clocks_forget_file(struct gloss_clocks *clocks)
{
	if (clocks->file)
		gloss_file_put(clocks->file);
	clocks->file = NULL;
	clocks->ended = false;
	clocks->mixed = false;
	clocks->ns = 0;
}

/* Gives what was counted since the last time to the file whose jobs ended since then. */
static void gloss_clocks_take(struct gloss_ring *ring)
{
	struct gloss_clocks *clocks = &ring->clocks;
	struct gloss_clocks_seen now;
	unsigned int i;

	gloss_clocks_read(container_of(ring, struct gloss_device, ring), &now);
	if (clocks->file && !clocks->mixed && now.clocks != U64_MAX) {
		clocks->file->clocks += now.clocks - clocks->seen.clocks;
		for (i = 0; i < GLOSS_STALLS; i++)
			clocks->file->stall[i] += now.stall[i] - clocks->seen.stall[i];
	}
	clocks->seen = now;
	gloss_clocks_forget_file(clocks);
}

/* A job that the board had has ended, after @ns of work; under the ring's lock, as all here. */
void gloss_clocks_ended(struct gloss_ring *ring, const struct gloss_job *job, s64 ns)
{
	struct gloss_clocks *clocks = &ring->clocks;

	lockdep_assert_held(&ring->lock);
	if (!clocks->ended && job->file) {
		kref_get(&job->file->ref);
		clocks->file = job->file;
	}
	clocks->mixed |= job->file != clocks->file;
	clocks->ended = true;
	clocks->ns += ns;
}

/* @job, or if it is NULL who knows which, is the next to end. */
void gloss_clocks_next(struct gloss_ring *ring, const struct gloss_job *job)
{
	struct gloss_clocks *clocks = &ring->clocks;

	lockdep_assert_held(&ring->lock);
	if (!clocks->ended)
		return;
	if (clocks->ns >= NSEC_PER_SEC || (job && (clocks->mixed || job->file != clocks->file)))
		gloss_clocks_take(ring);
}

/* The board was reset, and counts from zero. */
void gloss_clocks_reset(struct gloss_ring *ring)
{
	lockdep_assert_held(&ring->lock);
	memset(&ring->clocks.seen, 0, sizeof(ring->clocks.seen));
	gloss_clocks_forget_file(&ring->clocks);
}

static void gloss_clocks_fini(struct drm_device *drm, void *data)
{
	gloss_clocks_forget_file(&to_gloss_device(drm)->ring.clocks);
}

/* The file that is remembered last is given up with the board. */
int gloss_clocks_init(struct gloss_device *gdev)
{
	return drmm_add_action_or_reset(&gdev->drm, gloss_clocks_fini, NULL);
}

/* A board without a clock ends jobs all the same. */
static bool gloss_clocks_there(struct gloss_device *gdev)
{
	return !gloss_read(gdev, GLOSS_REG_JOBS) || gloss_clocks_read_total(gdev);
}

/* What was counted of @file's jobs up to now; -EOPNOTSUPP: nothing is; -ENODEV. */
int gloss_clocks_get(struct gloss_file *file, struct drm_gloss_get_clocks *to)
{
	struct gloss_ring *ring = &file->gdev->ring;
	unsigned long flags;
	int idx;

	if (!drm_dev_enter(&file->gdev->drm, &idx))
		return -ENODEV;
	if (!gloss_clocks_there(file->gdev)) {
		drm_dev_exit(idx);
		return -EOPNOTSUPP;
	}

	spin_lock_irqsave(&ring->lock, flags);
	if (ring->clocks.ended && ring->clocks.file == file && !gloss_device_gone(file->gdev))
		gloss_clocks_take(ring);
	*to = (struct drm_gloss_get_clocks) {
		.clocks = file->clocks,
		.stall_stream = file->stall[0],
		.stall_raster = file->stall[1],
		.stall_tile = file->stall[2],
		.stall_memory = file->stall[3],
		.stall_response = file->stall[4],
	};
	spin_unlock_irqrestore(&ring->lock, flags);
	drm_dev_exit(idx);
	return 0;
}

int gloss_clocks_ioctl(struct drm_device *drm, void *data, struct drm_file *file)
{
	if (gloss_device_gone(to_gloss_device(drm)))
		return -ENODEV;
	return gloss_clocks_get(to_gloss_file(file), data);
}
