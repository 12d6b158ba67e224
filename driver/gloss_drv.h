/* SPDX-License-Identifier: GPL-2.0-only */
/*
 * What the files of the module share. A file is a noun, and its functions begin with it:
 *
 *   gloss_drv     the module, PCI, the table of ioctls
 *   gloss_device  a board: registers, reset, its going away
 *   gloss_file    an open file
 *   gloss_gem     objects: the ioctls; gloss_host and gloss_memory, the two kinds
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
#include <drm/drm_file.h>
#include <drm/drm_gem_shmem_helper.h>
#include <drm/drm_mm.h>
#include <drm/gpu_scheduler.h>
#include <linux/debugfs.h>
#include <linux/dma-fence.h>
#include <linux/io.h>
#include <linux/kref.h>
#include <linux/ktime.h>
#include <linux/list.h>
#include <linux/mutex.h>
#include <linux/spinlock.h>
#include <linux/wait.h>
#include <linux/workqueue.h>

#include "gloss_compat.h"
#include "gloss_drm.h"
#include "gloss_regs.h"

#define GLOSS_HOST_SIZE_MAX	SZ_256M
#define GLOSS_STREAM_WORDS_MAX	(GLOSS_HOST_SIZE_MAX / sizeof(u32))
#define GLOSS_RING_ENTRIES	BIT(GLOSS_RING_MAX_LOG2)
/* Jobs that are in the ring at once: the one that runs, and one for the board to go on with. */
#define GLOSS_JOBS_AHEAD	2
/* Jobs of a file, queued or under way, above which SUBMIT waits. */
#define GLOSS_FILE_JOBS		1024
/* How long after the end of its job an interrupt may come. */
#define GLOSS_INTERRUPT_MS	100
/* What a job may still run for after its file was closed. */
#define GLOSS_CLOSED_LIMIT_MS	100
/*
 * A job that hung the board is run once more, as an empty one. If the board hangs again, it is the
 * board that is to blame.
 */
#define GLOSS_JOB_HANGS		2
#define GLOSS_PRIORITIES	(DRM_GLOSS_PRIORITY_HIGH + 1)
/* A job's objects: its slots, stream, response and status. */
#define GLOSS_JOB_OBJECTS	(GLOSS_SLOTS + 3)

struct gloss_coredump;
struct gloss_device;
struct gloss_job;

extern unsigned int gloss_timeout_ms, gloss_job_limit_ms;

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

/* Who goes first. */
enum gloss_rank {
	GLOSS_RANK_OWN,			/* the driver's own jobs */
	GLOSS_RANK_HIGH,
	GLOSS_RANK_NORMAL,
	GLOSS_RANK_LOW,
	GLOSS_RANKS,
};

/* Jobs that have their turn, and those that wait for it. */
struct gloss_turns {
	spinlock_t lock;		/* protects the following members, and each gloss_turn */
	struct list_head waiting[GLOSS_RANKS];	/* gloss_turn.node */
	unsigned int taken;		/* by jobs that have not ended */
	unsigned int own;		/* jobs of the driver's own that have not had their turn */
	bool held;
	spinlock_t fence_lock;		/* of the fences of all turns */
};

enum gloss_turn_state {
	GLOSS_TURN_NONE,		/* not asked for */
	GLOSS_TURN_WAITING,
	GLOSS_TURN_HAD,
};

/* A job's turn. */
struct gloss_turn {
	struct gloss_file *file;	/* the job's */
	enum gloss_rank rank;
	enum gloss_turn_state state;
	bool counts;			/* in gloss_turns.taken */
	struct list_head node;
	struct dma_fence *fence;	/* signals when it is the job's turn */
};

/* The host objects of a board. */
struct gloss_hosts {
	struct mutex lock;		/* protects @list */
	struct list_head list;		/* all of them */

	/* Protects the following, and each object's uses and place in @idle. */
	spinlock_t idle_lock;
	struct list_head idle;		/* pinned, and no job uses them; the oldest first */
	unsigned long idle_pages;	/* of these */

	struct shrinker *shrinker;
};

/* What a file may hold of something that nobody takes from it, and what that is. */
enum gloss_share_kind {
	GLOSS_SHARE_PAGES,		/* of the host, pinned */
	GLOSS_SHARE_MEMORY,		/* of the board, bytes */
	GLOSS_SHARES,
};

struct gloss_share {
	spinlock_t lock;		/* protects the following, and gloss_file.held of this */
	u64 total, held;
};

/* Board memory. */
struct gloss_memory {
	u64 size;			/* bytes; does not change after probe */
	u32 granule;			/* objects begin and end at multiples of this */
	struct gloss_share share;
	struct mutex lock;		/* protects the following members */
	struct drm_mm mm;
};

/* The stream that clears tiles from the start of slot 0; any number of them is a prefix. */
struct gloss_clear {
	dma_addr_t list_address;
	struct mutex queue_lock;	/* an object's clearing is queued once */
	struct mutex lock;		/* keeps the entity's jobs in order */
	struct drm_sched_entity entity;
};

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
 * An object in pages of the host. While it is mapped, @list has the bus address of each 4096
 * bytes of it, and @list_address is where the board finds the list. While a job uses it, it
 * stays pinned, and, as long as there is a board, mapped.
 */
struct gloss_host_object {
	struct drm_gem_shmem_object base;
	struct list_head node;		/* in gloss_hosts.list */
	struct list_head idle;		/* in gloss_hosts.idle */
	unsigned int uses;		/* by jobs */
	struct dma_buf_attachment *attach;	/* of an imported object, else NULL */
	struct work_struct put;		/* drops a reference of the shrinker's */

	struct mutex lock;		/* protects the following */
	struct page **pages;		/* NULL: not pinned, or imported */
	struct gloss_file *payer;	/* for whom they are pinned */
	__le64 *list;
	dma_addr_t list_address;
};

/* An object in board memory. */
struct gloss_board_object {
	struct drm_gem_object base;
	struct drm_mm_node node;
	struct gloss_file *payer;	/* whose share it is of */
	bool cleared;			/* or to be; set under gloss_clear.queue_lock */

	/*
	 * Protects the following members, which are of the clearing that was queued last. While the
	 * board has not got all of its jobs, or if one failed, a job that is to run and names the
	 * object ends with -EIO: it might read what is somebody else's.
	 */
	spinlock_t clear_lock;
	u32 clearing;			/* its number, which its jobs have too */
	u32 unclear;			/* jobs of it that the board has not got */
	bool clear_failed;
	struct gloss_file *clearer;	/* whose jobs these are, a reference, or NULL */
};

extern const struct drm_gem_object_funcs gloss_host_funcs;
extern const struct drm_gem_object_funcs gloss_board_funcs;

static inline bool gloss_gem_is_host(const struct drm_gem_object *object)
{
	return object->funcs == &gloss_host_funcs;
}

static inline bool gloss_gem_is_board(const struct drm_gem_object *object)
{
	return object->funcs == &gloss_board_funcs;
}

static inline struct gloss_host_object *to_gloss_host(struct drm_gem_object *object)
{
	return container_of(to_drm_gem_shmem_obj(object), struct gloss_host_object, base);
}

static inline struct gloss_board_object *to_gloss_board(struct drm_gem_object *object)
{
	return container_of(object, struct gloss_board_object, base);
}

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

/* gloss_file.c */
int gloss_file_open(struct drm_device *drm, struct drm_file *file);
void gloss_file_close(struct drm_device *drm, struct drm_file *file);
void gloss_file_put(struct gloss_file *gfile);
void gloss_files_lost(struct gloss_device *gdev);

/* gloss_gem.c */
int gloss_gem_create_ioctl(struct drm_device *drm, void *data, struct drm_file *file);
int gloss_gem_mmap_offset_ioctl(struct drm_device *drm, void *data, struct drm_file *file);

/* gloss_host.c */
int gloss_hosts_init(struct gloss_device *gdev);
void gloss_hosts_unmap(struct gloss_device *gdev);
struct drm_gem_object *gloss_host_new(struct drm_device *drm, size_t size);
struct drm_gem_object *gloss_host_create(struct gloss_device *gdev, size_t size);
struct drm_gem_object *gloss_host_import(struct drm_device *drm,
					 struct dma_buf_attachment *attach, struct sg_table *sgt);
int gloss_host_use(struct gloss_host_object *host, struct gloss_file *file);
void gloss_host_end_use(struct gloss_host_object *host);
void gloss_host_set_busy(struct gloss_host_object *host);
unsigned long gloss_host_try_unpin(struct gloss_host_object *host);

/* Drops a reference to an object that a job uses, or was to use. */
static inline void gloss_gem_end_use(struct drm_gem_object *object)
{
	if (gloss_gem_is_host(object))
		gloss_host_end_use(to_gloss_host(object));
	drm_gem_object_put(object);
}

/* gloss_pages.c */
int gloss_pages_init(struct gloss_device *gdev);
bool gloss_pages_charge(struct gloss_file *file, unsigned long count);
void gloss_pages_uncharge(struct gloss_file *file, unsigned long count);
struct page **gloss_pages_get(struct drm_gem_object *object);
void gloss_pages_put(struct drm_gem_object *object, struct page **pages);
unsigned long gloss_pages_shrink(struct gloss_hosts *hosts, unsigned long wanted);
void gloss_pages_put_work(struct work_struct *work);
void gloss_pages_print(struct gloss_hosts *hosts, struct drm_printer *p);

/* gloss_share.c */
bool gloss_share_take(struct gloss_share *share, enum gloss_share_kind kind,
		      struct gloss_file *file, u64 more);
void gloss_share_give_back(struct gloss_share *share, enum gloss_share_kind kind,
			   struct gloss_file *file, u64 less);

/* gloss_memory.c */
int gloss_memory_init(struct gloss_device *gdev);
struct drm_gem_object *gloss_board_create(struct gloss_device *gdev, struct gloss_file *file,
					  u64 size);
void gloss_memory_clear(struct gloss_device *gdev);

/* gloss_clear.c */
int gloss_clear_init(struct gloss_device *gdev);
int gloss_clear_board(struct gloss_board_object *board, struct gloss_file *file, u32 priority);
void gloss_clear_again(struct gloss_board_object *board);
bool gloss_clear_missing(struct gloss_board_object *board);
void gloss_clear_begun(const struct gloss_job *job);
void gloss_clear_failed(const struct gloss_job *job);

static inline u32 gloss_clear_tile_bytes(const struct gloss_device *gdev)
{
	return gdev->tile_size * gdev->tile_size * sizeof(u32);
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

/* gloss_sched.c */
int gloss_sched_init(struct gloss_device *gdev);
void gloss_sched_kick(struct gloss_device *gdev);
void gloss_sched_suspend(struct gloss_device *gdev);
void gloss_sched_resume(struct gloss_device *gdev);

/* gloss_turn.c */
void gloss_turns_init(struct gloss_turns *turns);
int gloss_turn_init(struct gloss_turns *turns, struct gloss_turn *turn, struct gloss_file *file,
		    u32 priority);
struct dma_fence *gloss_turn_ask(struct gloss_turns *turns, struct gloss_turn *turn);
void gloss_turn_end(struct gloss_turns *turns, struct gloss_turn *turn);
void gloss_turn_fini(struct gloss_turns *turns, struct gloss_turn *turn);
void gloss_turns_close(struct gloss_turns *turns, const struct gloss_file *file);
void gloss_turns_hold(struct gloss_turns *turns, bool hold);
bool gloss_turns_idle(struct gloss_turns *turns);

/* gloss_fence.c */
extern const struct dma_fence_ops gloss_fence_ops;
struct dma_fence *gloss_fence_new(void);
void gloss_fence_free(struct dma_fence *fence);

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

/*
 * What drm-client-id and the tracepoints call a file: unlike a pid it is no other file's.
 * 0: the driver itself.
 */
static inline u64 gloss_file_client(const struct gloss_file *file)
{
	return file ? file->entity[0].fence_context : 0;
}

/* gloss_clocks.c */
int gloss_clocks_init(struct gloss_device *gdev);
void gloss_clocks_ended(struct gloss_ring *ring, const struct gloss_job *job, s64 ns);
void gloss_clocks_next(struct gloss_ring *ring, const struct gloss_job *job);
void gloss_clocks_reset(struct gloss_ring *ring);
int gloss_clocks_get(struct gloss_file *file, struct drm_gloss_get_clocks *to);
int gloss_clocks_ioctl(struct drm_device *drm, void *data, struct drm_file *file);

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
