/* SPDX-License-Identifier: GPL-2.0-only */
/* Jobs that the board has, and what it says and counts of them. */
#ifndef GLOSS_RING_H
#define GLOSS_RING_H

#include <linux/bits.h>
#include <linux/ktime.h>
#include <linux/list.h>
#include <linux/mutex.h>
#include <linux/spinlock.h>

#include "gloss_drm.h"
#include "gloss_regs.h"

struct gloss_device;
struct gloss_file;
struct gloss_job;

#define GLOSS_RING_ENTRIES	BIT(GLOSS_RING_MAX_LOG2)
/* What a job may still run for after its file was closed. */
#define GLOSS_CLOSED_LIMIT_MS	100
/*
 * A job that hung the board is run once more, as an empty one. If the board hangs again, it is the
 * board that is to blame.
 */
#define GLOSS_JOB_HANGS		2

/* What board and driver share, in coherent memory. */
struct gloss_ring_shared {
	__le32 descriptor[GLOSS_RING_ENTRIES][GLOSS_JOB_DESCRIPTOR_WORDS];
	__le32 completion[GLOSS_RING_ENTRIES][GLOSS_COMPLETION_WORDS];
	__le32 slot[GLOSS_RING_ENTRIES][GLOSS_SLOTS][GLOSS_SLOT_ENTRY_WORDS];
};

/* What went wrong last, for debugfs. */
struct gloss_ring_fault {
	u32 sequence;			/* of the job; 0: nothing yet */
	struct drm_gloss_status status;
	u64 dma_address;		/* with status.cause dma */
	pid_t pid;			/* of the job's file; 0: the driver's own job */
	ktime_t time;
};

/* STALL_STREAM to STALL_RESPONSE. */
#define GLOSS_STALLS	5

/* The board's counters, as they were read. */
struct gloss_clocks_seen {
	u64 clocks;
	u32 stall[GLOSS_STALLS];
};

/* What the board counted since they were read last, for whom. */
struct gloss_clocks {
	struct gloss_clocks_seen seen;
	bool ended;			/* jobs have, since then */
	struct gloss_file *file;	/* theirs, a reference; NULL: the driver's own */
	bool mixed;			/* they were of several files */
	s64 ns;				/* how long they took */
};

/* What the board has ended and no interrupt has told of. */
enum gloss_ring_news {
	GLOSS_RING_NOTHING,
	GLOSS_RING_ENDED,		/* a job, since this was asked last */
	GLOSS_RING_UNHEARD,		/* a job, which it had ended then already */
};

/* Jobs that the board has and has not ended, from head to tail. */
struct gloss_ring {
	struct gloss_ring_shared *shared;
	dma_addr_t address;		/* of @shared */

	/*
	 * Whoever gives the board jobs, looks whether it still moves, or resets it. Fences
	 * wait for that, so its holder must neither wait for one nor allocate memory.
	 */
	struct mutex push_lock;
	bool asleep;			/* jobs are only listed; under @push_lock */
	/* What the board had done when gloss_sched looked at it last; under @push_lock. */
	u32 seen_head, seen_progress;
	ktime_t seen;			/* since when that has not changed */
	u32 unheard;			/* of gloss_ring_news(); under @push_lock */

	/* Protects the following members. */
	spinlock_t lock;
	u16 head, tail;			/* counts of jobs, as in the board's registers */
	u32 sequence;			/* of the job put in last; never 0 */
	struct list_head list;		/* gloss_job.ring_node, from head to tail */
	ktime_t idle;			/* when the last job ended */
	u64 jobs, faults;		/* ended; of these with a cause */
	u64 busy_ns;
	struct gloss_ring_fault fault;
	struct gloss_clocks clocks;

	spinlock_t fence_lock;		/* of the fences of all jobs */
	u64 fence_context;
	u64 fence_sequence;		/* of the fence made last; of gloss_sched_run_job only */
};

/* gloss_ring.c */
int gloss_ring_init(struct gloss_device *gdev);
void gloss_ring_push(struct gloss_device *gdev, struct gloss_job *job);
unsigned int gloss_ring_reap(struct gloss_ring *ring);
enum gloss_ring_news gloss_ring_news(struct gloss_ring *ring);
void gloss_ring_fail(struct gloss_ring *ring, int error);
bool gloss_ring_blame(struct gloss_ring *ring, u32 sequence, struct gloss_ring_fault *fault);
s64 gloss_ring_ran_ms(struct gloss_ring *ring);
s64 gloss_ring_left_ms(struct gloss_ring *ring, unsigned int limit_ms, int *error);
void gloss_ring_rewind(struct gloss_ring *ring);
int gloss_ring_start(struct gloss_device *gdev);
struct gloss_job *gloss_ring_find(struct gloss_ring *ring, u32 sequence);
bool gloss_ring_idle(struct gloss_ring *ring);
u64 gloss_ring_engine_ns(struct gloss_ring *ring, const struct gloss_file *file);

/* Where the board finds what is @at, a part of @ring->shared. */
static inline dma_addr_t gloss_ring_address(const struct gloss_ring *ring, const void *at)
{
	return ring->address + (at - (const void *)ring->shared);
}

/* gloss_irq.c */
int gloss_irq_init(struct gloss_device *gdev);
void gloss_irq_fini(struct gloss_device *gdev);

/* gloss_clocks.c */
int gloss_clocks_init(struct gloss_device *gdev);
void gloss_clocks_ended(struct gloss_ring *ring, const struct gloss_job *job, s64 ns);
void gloss_clocks_next(struct gloss_ring *ring, const struct gloss_job *job);
void gloss_clocks_reset(struct gloss_ring *ring);
int gloss_clocks_get(struct gloss_file *file, struct drm_gloss_get_clocks *to);
int gloss_clocks_ioctl(struct drm_device *drm, void *data, struct drm_file *file);

#endif
