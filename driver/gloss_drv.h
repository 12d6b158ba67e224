/* SPDX-License-Identifier: GPL-2.0-only */
/*
 * What the files of the module share: the board and the order of locks. A file is a noun, and its
 * functions begin with it; their structs and what protects these is in gloss_file.h, gloss_gem.h,
 * gloss_job.h, gloss_turn.h and gloss_ring.h.
 *
 *   gloss_drv     the module, PCI, the table of ioctls
 *   gloss_device  a board: registers, reset, its going away
 *   gloss_file    an open file
 *   gloss_gem     objects: the ioctls; gloss_host and gloss_memory, the two kinds
 *   gloss_list    bus addresses of a host object's pages
 *   gloss_pages   pages of host objects; gloss_share, how much one file may hold
 *   gloss_clear   jobs that empty board memory
 *   gloss_submit  the ioctl that makes a job; gloss_sync, what it waits for and signals
 *   gloss_job     a job, from its making to its end
 *   gloss_sched   the DRM scheduler, and what happens to a job that hangs
 *   gloss_turn    which job is next
 *   gloss_ring    jobs the board has
 *   gloss_irq     what it says of them; gloss_coredump, what is kept of a lost one
 *   gloss_clocks  what the board counts, for whom
 *   gloss_fence   fences of jobs
 *
 * Locks, outer ones first: gloss_clear.queue_lock, a reservation (dma_resv),
 * gloss_file.lock or gloss_clear.lock, gloss_ring.push_lock, gloss_ring.lock,
 * gloss_turns.lock, gloss_turns.fence_lock or gloss_ring.fence_lock. Under any of these may be
 * gloss_board.clear_lock.
 * Those of objects: gloss_hosts.lock, gloss_host.lock, the reservation of an imported one,
 * gloss_hosts.idle_lock or gloss_share.lock; under gloss_host.lock memory is allocated, and
 * whoever has that may need gloss_hosts.idle_lock. gloss_memory.lock is taken alone.
 * The interrupt takes the spinlocks of ring and turns.
 */
#ifndef GLOSS_DRV_H
#define GLOSS_DRV_H

#include <drm/drm_device.h>
#include <drm/gpu_scheduler.h>
#include <linux/atomic.h>
#include <linux/debugfs.h>
#include <linux/io.h>
#include <linux/wait.h>
#include <linux/workqueue.h>

#include "gloss_compat.h"
#include "gloss_drm.h"
#include "gloss_gem.h"
#include "gloss_regs.h"
#include "gloss_ring.h"
#include "gloss_turn.h"

struct drm_minor;
struct gloss_coredump;
struct seq_file;

/* Module parameters. */
extern unsigned int gloss_timeout_ms, gloss_job_limit_ms;

struct gloss_device {
	struct drm_device drm;
	void __iomem *registers;
	int irq;
	bool msi;
	/* The board has gone, or does not come out of reset. Set once and never cleared. */
	bool gone;

	/* What the board says of itself. */
	u32 version, tile_size, pixels_per_clock;

	struct gloss_ring ring;
	struct gloss_turns turns;
	struct gloss_hosts hosts;
	struct gloss_memory memory;
	struct gloss_clear clear;

	struct drm_gpu_scheduler sched;
	struct workqueue_struct *watch_wq;
	struct delayed_work watch;		/* looks whether the board still moves */
	struct workqueue_struct *free_wq;	/* frees jobs that have ended */
	atomic_t resets, interrupts_lost;	/* for debugfs */
	struct gloss_coredump *coredump;	/* the next that @report offers, or NULL */
	struct work_struct report;		/* of a reset, on free_wq */

	atomic_t jobs;			/* that exist, whatever their state */
	atomic_t jobs_ended;		/* of these, ended and not yet freed */
	wait_queue_head_t jobs_wait;	/* woken when a job is freed, or the board goes */
};

static inline struct gloss_device *to_gloss_device(struct drm_device *drm)
{
	return container_of(drm, struct gloss_device, drm);
}

static inline u32 gloss_device_tile_bytes(const struct gloss_device *gdev)
{
	return gdev->tile_size * gdev->tile_size * sizeof(u32);
}

/* gloss_device.c */
static inline u32 gloss_read(struct gloss_device *gdev, u32 reg)
{
	return readl(gdev->registers + reg);
}

static inline void gloss_write(struct gloss_device *gdev, u32 reg, u32 value)
{
	writel(value, gdev->registers + reg);
}

int gloss_device_identify(struct gloss_device *gdev);
int gloss_device_reset(struct gloss_device *gdev);
int gloss_device_start(struct gloss_device *gdev);
void gloss_device_set_gone(struct gloss_device *gdev, const char *why);

static inline bool gloss_device_gone(struct gloss_device *gdev)
{
	return READ_ONCE(gdev->gone);
}

/* gloss_sched.c */
int gloss_sched_init(struct gloss_device *gdev);
void gloss_sched_kick(struct gloss_device *gdev);
void gloss_sched_suspend(struct gloss_device *gdev);
void gloss_sched_resume(struct gloss_device *gdev);

/* gloss_coredump.c */
#define GLOSS_COREDUMP_REGS	21

/* What says what the board is doing, by name. */
extern const struct debugfs_reg32 gloss_coredump_regs[GLOSS_COREDUMP_REGS];

struct gloss_coredump *gloss_coredump_new(struct gloss_device *gdev);
void gloss_coredump_job(struct gloss_device *gdev, struct gloss_coredump *dump,
			const struct gloss_ring_fault *fault);
void gloss_coredump_init(struct gloss_device *gdev);

/* gloss_debugfs.c, gloss_fdinfo.c */
void gloss_debugfs_init(struct drm_minor *minor);
void gloss_fdinfo_show(struct seq_file *m, struct file *file);

#endif
