/* SPDX-License-Identifier: MIT */
/*
 * What userspace asks of the gloss kernel module, on a render node or a primary
 * node. A job is a command stream (rtl/INTERFACE.md), a response buffer and a
 * table of slots: ranges of board memory, the only ones its stream can reach.
 *
 * All structs have the same layout for 32 and 64-bit programs. Reserved fields and
 * unknown flags must be zero, else the answer is -EINVAL.
 */
#ifndef _GLOSS_DRM_H_
#define _GLOSS_DRM_H_

#include "drm.h"

#if defined(__cplusplus)
extern "C" {
#endif

#define DRM_GLOSS_GET_PARAM		0x00
#define DRM_GLOSS_GEM_CREATE		0x01
#define DRM_GLOSS_GEM_MMAP_OFFSET	0x02
#define DRM_GLOSS_SUBMIT		0x03
#define DRM_GLOSS_GET_CLOCKS		0x04

#define DRM_IOCTL_GLOSS_GET_PARAM \
	DRM_IOWR(DRM_COMMAND_BASE + DRM_GLOSS_GET_PARAM, struct drm_gloss_get_param)
#define DRM_IOCTL_GLOSS_GEM_CREATE \
	DRM_IOWR(DRM_COMMAND_BASE + DRM_GLOSS_GEM_CREATE, struct drm_gloss_gem_create)
#define DRM_IOCTL_GLOSS_GEM_MMAP_OFFSET \
	DRM_IOWR(DRM_COMMAND_BASE + DRM_GLOSS_GEM_MMAP_OFFSET, struct drm_gloss_gem_mmap_offset)
#define DRM_IOCTL_GLOSS_SUBMIT \
	DRM_IOW(DRM_COMMAND_BASE + DRM_GLOSS_SUBMIT, struct drm_gloss_submit)
#define DRM_IOCTL_GLOSS_GET_CLOCKS \
	DRM_IOR(DRM_COMMAND_BASE + DRM_GLOSS_GET_CLOCKS, struct drm_gloss_get_clocks)

/**
 * enum drm_gloss_param - what GET_PARAM can tell
 */
enum drm_gloss_param {
	/** @DRM_GLOSS_PARAM_VERSION: version of the board's command stream */
	DRM_GLOSS_PARAM_VERSION,
	/** @DRM_GLOSS_PARAM_TILE_SIZE: pixels of a tile's side, 32 or 64 */
	DRM_GLOSS_PARAM_TILE_SIZE,
	/** @DRM_GLOSS_PARAM_PIXELS_PER_CLOCK: 1, 2, 4 or 8 */
	DRM_GLOSS_PARAM_PIXELS_PER_CLOCK,
	/** @DRM_GLOSS_PARAM_MEMORY_SIZE: bytes of board memory */
	DRM_GLOSS_PARAM_MEMORY_SIZE,
	/** @DRM_GLOSS_PARAM_SLOTS: entries of a job's slot table */
	DRM_GLOSS_PARAM_SLOTS,
	/** @DRM_GLOSS_PARAM_STREAM_WORDS_MAX: words of the longest stream or response */
	DRM_GLOSS_PARAM_STREAM_WORDS_MAX,
	/**
	 * @DRM_GLOSS_PARAM_JOBS_LOST: jobs of this open file that hung the board, ran too
	 * long or were lost with it; a fault of a stream is not counted
	 */
	DRM_GLOSS_PARAM_JOBS_LOST,
	/** @DRM_GLOSS_PARAM_JOB_LIMIT: milliseconds a job may run; then it ends with -ETIME */
	DRM_GLOSS_PARAM_JOB_LIMIT,
	/**
	 * @DRM_GLOSS_PARAM_JOBS_QUEUED: jobs of an open file that may be unfinished before
	 * SUBMIT waits
	 */
	DRM_GLOSS_PARAM_JOBS_QUEUED,
};

/**
 * struct drm_gloss_get_param - ask for a number
 */
struct drm_gloss_get_param {
	/** @param: in, enum drm_gloss_param; unknown: -EINVAL */
	__u32 param;
	/** @pad: must be zero */
	__u32 pad;
	/** @value: out */
	__u64 value;
};

/**
 * enum drm_gloss_gem_kind - where an object's bytes are
 */
enum drm_gloss_gem_kind {
	/**
	 * @DRM_GLOSS_GEM_HOST: in pages of the host, which programs map and the board
	 * reads streams from and writes responses to; can be exported as dma-buf
	 */
	DRM_GLOSS_GEM_HOST,
	/**
	 * @DRM_GLOSS_GEM_BOARD: in board memory, which only jobs reach; can not be
	 * mapped or exported. Reads zero until it is written.
	 */
	DRM_GLOSS_GEM_BOARD,
};

/**
 * struct drm_gloss_gem_create - make an object
 *
 * -EINVAL: size zero or too large for its kind, or a bad field; -ENOSPC: no such
 * range of board memory is free, or this open file would hold more than its share of it;
 * -ENOMEM; -EINTR.
 *
 * An open file may hold at most share_percent, a parameter of the module, of the board memory
 * that other files leave; so one file can not have all of MEMORY_SIZE. Memory is charged to the
 * file that made the object until the object is gone: its handles are closed, and the jobs that
 * use it have ended. An object is one range and is never moved. So after many objects of
 * different sizes the largest free range may be smaller than all that is free.
 */
struct drm_gloss_gem_create {
	/** @size: in, bytes; out, rounded up to whole pages of 4096 bytes */
	__u64 size;
	/** @kind: in, enum drm_gloss_gem_kind */
	__u32 kind;
	/** @flags: must be zero */
	__u32 flags;
	/** @handle: out, a GEM handle of this open file */
	__u32 handle;
	/** @pad: must be zero */
	__u32 pad;
};

/**
 * struct drm_gloss_gem_mmap_offset - where to map a host object
 *
 * -ENOENT: no such handle; -EINVAL: an object in board memory, an imported one, or a bad
 * field.
 */
struct drm_gloss_gem_mmap_offset {
	/** @handle: in */
	__u32 handle;
	/** @pad: must be zero */
	__u32 pad;
	/** @offset: out, what to pass to mmap() of the node */
	__u64 offset;
};

#define DRM_GLOSS_SLOT_READ	(1 << 0)
#define DRM_GLOSS_SLOT_WRITE	(1 << 1)

/**
 * struct drm_gloss_slot - a range of board memory that a job's stream may name
 */
struct drm_gloss_slot {
	/** @handle: of a board object; 0: this slot is empty, all other fields are zero */
	__u32 handle;
	/** @rights: DRM_GLOSS_SLOT_READ, DRM_GLOSS_SLOT_WRITE or both */
	__u32 rights;
	/** @offset: bytes from the object's start, a multiple of 4096 */
	__u64 offset;
	/** @size: bytes, a multiple of 4, not zero, inside the object, below 2^32 */
	__u64 size;
};

#define DRM_GLOSS_SYNC_TIMELINE	(1 << 0)

/**
 * struct drm_gloss_sync - a syncobj to wait for before, or to signal after a job
 */
struct drm_gloss_sync {
	/** @handle: of a syncobj */
	__u32 handle;
	/** @flags: 0, or DRM_GLOSS_SYNC_TIMELINE */
	__u32 flags;
	/** @point: of a timeline, not zero; zero without DRM_GLOSS_SYNC_TIMELINE */
	__u64 point;
};

/**
 * enum drm_gloss_priority - which of several files' waiting jobs the board takes next
 */
enum drm_gloss_priority {
	/** @DRM_GLOSS_PRIORITY_NORMAL: the usual */
	DRM_GLOSS_PRIORITY_NORMAL,
	/** @DRM_GLOSS_PRIORITY_LOW: after all others */
	DRM_GLOSS_PRIORITY_LOW,
	/** @DRM_GLOSS_PRIORITY_HIGH: before all others; takes CAP_SYS_NICE, else -EACCES */
	DRM_GLOSS_PRIORITY_HIGH,
};

/**
 * struct drm_gloss_status - what became of a job
 *
 * Written to a host object before the job's fence signals.
 */
struct drm_gloss_status {
	/**
	 * @error: 0: the board ended the job, and @cause says how; -EIO: it hung the board
	 * or met a DMA error; -ETIME: it ran for longer than DRM_GLOSS_PARAM_JOB_LIMIT, and
	 * may have done part of its work; -ENODEV: the board is gone; -ECANCELED: the file
	 * was closed first. The job's fence has the same error, or -EIO if @cause is not zero.
	 */
	__s32 error;
	/** @cause: enum gloss_fault of the stream (rtl/INTERFACE.md); 0: none */
	__u32 cause;
	/** @offset: word of the stream the fault is at; without one the stream's length */
	__u32 offset;
	/** @response_words: words of the response that are valid */
	__u32 response_words;
};

/**
 * DRM_GLOSS_SUBMIT_EXPLICIT_SYNC - only in-syncs order the job
 *
 * The job does not wait for what other jobs, or other drivers, still do with its objects, and
 * they do not wait for it. This is for programs that order all their jobs by syncobjs. Such a
 * program has to put fences itself on the dma-bufs that it shares with others. The job waits
 * for the clearing of new board memory in any case.
 */
#define DRM_GLOSS_SUBMIT_EXPLICIT_SYNC	(1 << 0)

/* Most entries of in_syncs, and of out_syncs. */
#define DRM_GLOSS_SYNCS_MAX	64

/**
 * struct drm_gloss_submit - queue a job
 *
 * Jobs of one open file and priority run in the order of their submission, each when its
 * in-syncs and, without DRM_GLOSS_SUBMIT_EXPLICIT_SYNC, the fences of its objects'
 * reservations have signalled. Open files take turns, a job each; those of a higher
 * priority go first. A job that is refused has no effect. Each range must be inside its
 * host object.
 *
 * While DRM_GLOSS_PARAM_JOBS_QUEUED jobs of the file have not ended, SUBMIT waits for one of
 * them, or, if the file is O_NONBLOCK, fails with -EAGAIN.
 *
 * The first job that uses a host object pins its pages and charges them to its open file. All
 * boards together pin at most pin_percent, a parameter of the module, of the machine's memory,
 * and a file at most its share of that, as of board memory; -ENOMEM: it would hold more. Pages
 * stay charged until the object is gone, or until the kernel needs them while no job uses it.
 *
 * -ENOENT: a handle names nothing; -EINVAL: a bad field, or an object of the wrong kind;
 * -EFAULT: a bad pointer; -E2BIG: too many slots or syncs; -EACCES: priority; -ENODEV: the
 * board is gone; -ENOMEM; -EINTR.
 */
struct drm_gloss_submit {
	/** @flags: 0, or DRM_GLOSS_SUBMIT_EXPLICIT_SYNC */
	__u32 flags;
	/** @priority: enum drm_gloss_priority */
	__u32 priority;
	/** @stream: handle of the host object that holds the stream */
	__u32 stream;
	/** @stream_words: its length; 0: an empty job, @stream and @stream_offset are 0 */
	__u32 stream_words;
	/** @stream_offset: bytes, a multiple of 4096 */
	__u64 stream_offset;
	/** @response: handle of the host object that receives the response */
	__u32 response;
	/** @response_words: its room; 0: none, @response and @response_offset are 0 */
	__u32 response_words;
	/** @response_offset: bytes, a multiple of 4096 */
	__u64 response_offset;
	/** @status: handle of the host object that receives struct drm_gloss_status; 0: none */
	__u32 status;
	/** @slot_count: entries of @slots, at most DRM_GLOSS_PARAM_SLOTS */
	__u32 slot_count;
	/** @status_offset: bytes, a multiple of 16; 0 without @status */
	__u64 status_offset;
	/** @slots: pointer to struct drm_gloss_slot; entry i is the stream's slot i */
	__u64 slots;
	/** @in_syncs: pointer to struct drm_gloss_sync, waited for before the job */
	__u64 in_syncs;
	/** @out_syncs: pointer to struct drm_gloss_sync, signalled when the job has ended */
	__u64 out_syncs;
	/** @in_sync_count: entries of @in_syncs */
	__u32 in_sync_count;
	/** @out_sync_count: entries of @out_syncs */
	__u32 out_sync_count;
	/** @slot_stride: sizeof(struct drm_gloss_slot); 0 if @slot_count is */
	__u32 slot_stride;
	/** @sync_stride: sizeof(struct drm_gloss_sync); 0 if both counts are */
	__u32 sync_stride;
};

/**
 * struct drm_gloss_get_clocks - where the board's clocks went
 *
 * These are sums over the jobs of this open file that have ended. A job is left out if the
 * driver had not read the counters between its end and that of another file's job, or between
 * its end and a reset.
 * -EOPNOTSUPP: the board has no clock, as a model of one; -ENODEV: the board is gone.
 */
struct drm_gloss_get_clocks {
	/** @clocks: out, in which the core had a job */
	__u64 clocks;
	/** @stall_stream: out, of these, in which the core waited for stream words */
	__u64 stall_stream;
	/** @stall_raster: out, in which a complete triangle waited for raster */
	__u64 stall_raster;
	/** @stall_tile: out, in which triangles waited for a tile buffer */
	__u64 stall_tile;
	/** @stall_memory: out, in which the core waited for board memory */
	__u64 stall_memory;
	/** @stall_response: out, in which response words waited to be taken */
	__u64 stall_response;
};

#if defined(__cplusplus)
}
#endif

#endif
