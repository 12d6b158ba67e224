/* SPDX-License-Identifier: GPL-2.0-only */
/*
 * Objects, in pages of the host and in board memory; how much of both one file may hold; and the
 * clearing of board memory.
 */
#ifndef GLOSS_GEM_H
#define GLOSS_GEM_H

#include <drm/drm_gem_shmem_helper.h>
#include <drm/drm_mm.h>
#include <drm/gpu_scheduler.h>
#include <linux/list.h>
#include <linux/mutex.h>
#include <linux/sizes.h>
#include <linux/spinlock.h>
#include <linux/workqueue.h>

struct dma_buf_attachment;
struct drm_file;
struct drm_printer;
struct gloss_device;
struct gloss_file;
struct gloss_job;
struct shrinker;

#define GLOSS_HOST_SIZE_MAX	SZ_256M
#define GLOSS_STREAM_WORDS_MAX	(GLOSS_HOST_SIZE_MAX / sizeof(u32))

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
	struct drm_sched_entity entity;	/* of the driver's own jobs */
	unsigned int jobs;		/* of these, that exist; under @queue_lock */
};

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

static inline bool gloss_host_imported(const struct gloss_host_object *host)
{
	return host->attach;
}

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

/* gloss_list.c */
int gloss_list_make(struct gloss_host_object *host);
void gloss_list_unmake(struct gloss_host_object *host);

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
void gloss_clear_ended(struct gloss_device *gdev);

#endif
