/* SPDX-License-Identifier: MIT */
/* What the files of the library know of each other; accel.h says what is theirs to promise. */
#ifndef ACCEL_PRIV_H
#define ACCEL_PRIV_H

#include <pthread.h>
#include <stdatomic.h>
#include <sys/types.h>

#include "accel.h"
#include "transport/transport.h"

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
	       "words go to the board as they lie in memory, which it reads as little-endian");

/* Surfaces are padded to whole tiles of either size, so that a picture's place in memory does
 * not depend on the core. */
#define ACCEL_TARGET_ALIGN 64

/* Fences of jobs that nobody waits for, in the order in which they were submitted. */
struct accel_detached {
	pthread_mutex_t lock; /* of the list */
	struct accel_fence *first, **last;
	unsigned int fences;
	pthread_mutex_t turn;   /* who has it takes fences from the list */
	int result;             /* under turn: of the first that failed since it was told */
	_Atomic uint64_t ended; /* the last of their jobs that is known to have ended */
};

struct accel_device {
	const struct accel_transport_ops *ops;
	void *state; /* the transport's */
	struct accel_transport_info info;
	unsigned int threads;     /* that may work on a mesh, with the calling one */
	accel_message_fn message; /* may be NULL */
	void *message_data;
	struct accel_dump *dump; /* NULL: no job is written to files */
	pid_t process;           /* that opened it; in a child of fork() nothing works */
	pthread_mutex_t lock;    /* of calls of ops, see transport.h */
	atomic_uint references;
	/* Without references, and their memory still to be freed by who has the lock next. */
	struct accel_buffer *_Atomic freed;
	struct accel_buffer *busy; /* under lock: of those freed what a detached job uses */
	struct accel_detached detached;
};

struct accel_buffer {
	struct accel_device *device;
	uint64_t object; /* of the transport */
	uint64_t size;   /* bytes */
	atomic_uint references;
	_Atomic uint64_t busy;     /* the last detached job that uses it; 0: none has */
	_Atomic uint64_t written;  /* jobs so far that may write it */
	struct accel_buffer *next; /* of those freed */
};

struct accel_target {
	struct accel_device *device;
	int width, height; /* pixels, as asked for */
	uint32_t pitch;    /* bytes from a row to the next, of both surfaces */
	uint32_t rows;     /* height padded to ACCEL_TARGET_ALIGN */
	struct accel_buffer *colour, *depth;
	struct accel_content *content; /* what is known of its tiles, may be NULL */
};

enum accel_outcome_state { ACCEL_OUTCOME_PENDING, ACCEL_OUTCOME_DONE, ACCEL_OUTCOME_FAILED };

struct accel_state {
	/* Numbers that no state has had for other content, in this process: of what vertices' places
	 * and normals depend on, and of what light does. */
	uint64_t geometry_stamp, light_stamp;
	float modelview[16], projection[16];
	struct {
		int x, y, width, height;             /* width < 0: the whole target */
	} viewport, scissor;                         /* width < 0: no scissor */
	float clip_plane[ACCEL_USER_CLIP_PLANES][4]; /* eye space */
	unsigned int clip_planes;                    /* bit i: plane i is on */
	float depth_near, depth_far;
	enum accel_compare depth_func;
	bool depth_write;
	bool colour_mask[4];
	enum accel_cull cull;
	bool clockwise, bottom;                  /* front faces; row 0 is NDC y = -1 */
	enum accel_polygon_mode polygon_mode[2]; /* front, back */
	float offset_factor, offset_units;
	unsigned int offset_modes; /* bit 1 << mode: added there, and not nothing */
	enum accel_normals normals;
	bool lighting, two_sided, local_viewer;
	enum accel_tracks tracks[2]; /* front, back */
	float ambient[4];
	struct accel_material material[2]; /* front, back */
	struct accel_light light[ACCEL_LIGHTS];
	enum accel_shading shading;
	struct accel_line_style line;
	struct accel_point_style point;
};

/* sized.c */
/*
 * A struct that a program gives, whose first member is its size, as the library knows it: @known
 * bytes, with that size. -EINVAL: it has no size. -E2BIG: more in it is set than is known.
 */
int accel_sized_in(void *own, size_t known, const void *given);
/* Says why accel_sized_in returned @err for a struct called @what, which @macro begins. */
void accel_sized_message(struct accel_device *device, const char *what, const char *macro, int err);
/* As much of a struct of the library, of @known bytes, as the program has room for; the rest of
 * its @size bytes is zero. */
void accel_sized_out(void *given, size_t size, const void *own, size_t known);

/* device.c */
struct accel_device *accel_device_ref(struct accel_device *device);
void accel_device_unref(struct accel_device *device);
/*
 * Around calls of ops: gets the lock, and cancellation held as @held. -ENODEV: this is a child of
 * the process that opened the device, and nothing was got.
 */
int accel_device_enter(struct accel_device *device, int *held);
void accel_device_leave(struct accel_device *device, int held);
/* What is behind an error of a job, for people. */
const char *accel_device_why(const struct accel_device *device, int err);
bool accel_device_is_inherited(const struct accel_device *device);
/* Frees a buffer that has no references, and its memory now or soon. Does not wait. */
void accel_device_free_buffer(struct accel_device *device, struct accel_buffer *buffer);
/* Formats one line for the device's message function, if there is one. */
void accel_device_message(struct accel_device *device, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

/* buffer.c */
struct accel_buffer *accel_buffer_ref(struct accel_buffer *buffer);
void accel_buffer_unref(struct accel_buffer *buffer);
/* Its memory is not free before job @sequence has ended, though that has no reference. */
void accel_buffer_busy(struct accel_buffer *buffer, uint64_t sequence);
/* @rows times @count words, @pitch bytes apart, packed into @words; the place was checked, and
 * @count is at most 65535. */
int accel_buffer_read_rows(struct accel_buffer *buffer, uint64_t offset, uint32_t pitch,
			   uint32_t count, uint32_t rows, uint32_t *words);
/* The other way. */
int accel_buffer_write_rows(struct accel_buffer *buffer, uint64_t offset, uint32_t pitch,
			    uint32_t count, uint32_t rows, const uint32_t *words);

/* stream.c */
/* As accel_stream_new, for copies of the library's own, which are not dumped. */
int accel_stream_new_copy(struct accel_device *device, struct accel_stream **stream);
struct accel_device *accel_stream_device(const struct accel_stream *stream);
/* Appends words as accel_stream_emit does, which are not copied: they are lent until the stream is
 * sent or reset. accel_stream_words does not show them. */
int accel_stream_lend(struct accel_stream *stream, const uint32_t *words, size_t count);
/* Sends the stream as a job more of @fence, as accel_stream_submit does. */
int accel_stream_send(struct accel_stream *stream, uint32_t *response, uint32_t response_words,
		      struct accel_fence *fence);

/* fence.c */
/* A fence of no job yet; NULL: out of memory. */
struct accel_fence *accel_fence_new(struct accel_device *device);
/* Sees to it that the next accel_fence_add has memory. -ENOMEM. */
int accel_fence_reserve(struct accel_fence *fence);
/* Of job @sequence, too; it takes over the references to the job's buffers. */
void accel_fence_add(struct accel_fence *fence, uint64_t sequence,
		     struct accel_buffer *const *buffer, unsigned int buffers);
/* The end of a call that returns @fence by @out; without that nobody waits for it. */
void accel_fence_give(struct accel_fence *fence, struct accel_fence **out);
/* Waits for @fence and frees it. */
int accel_fence_finish(struct accel_fence *fence);
/* What became of jobs, for who looks without waiting. NULL: out of memory. */
struct accel_outcome *accel_outcome_new(void);
void accel_outcome_unref(struct accel_outcome *outcome);
enum accel_outcome_state accel_outcome_look(const struct accel_outcome *outcome);
/* It is pending until the fence's jobs, all of which were added, are known to have ended. */
void accel_fence_tell(struct accel_fence *fence, struct accel_outcome *outcome);
void accel_fence_detached_init(struct accel_detached *detached);
void accel_fence_detached_fini(struct accel_detached *detached);
/* Frees the fences whose jobs have ended. Does not wait. */
void accel_fence_detached_reap(struct accel_detached *detached);
/* Waits for all; what accel_fence_wait says of the first that failed since the last call. */
int accel_fence_detached_finish(struct accel_detached *detached);

#endif
