/* SPDX-License-Identifier: MIT */
/*
 * The seam between the library and a board. A transport is a table of
 * functions; device.c holds the list of tables and nothing else in the library
 * knows which one it talks to.
 *
 * The library calls one function of a device at a time, and these do not wait for
 * the board; except wait, fence_fd, wait_for_room, clocks and why, which any number of threads may
 * be in at any time. It calls none in a child of fork(), and all with the thread's
 * cancellation disabled. Errors are -errno; a transport never prints, exits or keeps
 * what it was lent.
 */
#ifndef ACCEL_TRANSPORT_H
#define ACCEL_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "accel.h"
#include "job.h"

/* What a board says of itself. */
struct accel_transport_info {
	char name[64];             /* for people: "model", "Verilated core", ... */
	uint32_t version;          /* GLOSS_VERSION of the board */
	uint32_t tile_size;        /* 32 or 64 */
	uint32_t pixels_per_clock; /* 1, 2, 4, 8 */
	uint64_t memory_size;      /* bytes of board memory */
	unsigned int threads;      /* that the library may use at a time; 0: one a processor */
};

/* A range of board memory that a job may use. */
struct accel_transport_slot {
	uint64_t object; /* from memory_new */
	enum gloss_rights rights;
};

/* Words of a stream that lie together. */
struct accel_transport_part {
	const uint32_t *words;
	size_t count;
};

/* A job in the library's terms; see struct accel_job. */
struct accel_transport_job {
	const uint32_t *stream;                  /* NULL: it is in parts */
	const struct accel_transport_part *part; /* as many as have stream_words together */
	uint32_t stream_words;
	uint32_t *response;
	uint32_t response_words;
	const struct accel_transport_slot *slot;
	uint32_t slots; /* at most GLOSS_SLOTS */
};

/* Why a board did not open, in one line for people; empty: errno says it all. */
struct accel_transport_error {
	char text[256];
};

/* Formats @error's text; cut off if it is too long. */
void accel_transport_say(struct accel_transport_error *error, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

/* Copies the stream of @job, the only time that this is done, to where the board has it from. */
void accel_transport_copy(const struct accel_transport_job *job, void *to);

struct accel_transport_ops {
	/* Scheme of device names, without the colon: "model". */
	const char *scheme;

	/* Board memory changes by what jobs say and by nothing else, whatever becomes of them. */
	bool memory_keeps;

	/*
	 * Opens a board. @where is the text after the colon, "" if none.
	 * Stores the transport's own state in *@state; on an error it may say
	 * more in @error.
	 * -ENODEV: no such board; -EACCES: not allowed; -EBUSY: another
	 * program has it; -ENOSYS: support for it is not installed; -EINVAL:
	 * @where is not understood; -ENOMEM.
	 */
	int (*open)(const char *where, void **state, struct accel_transport_error *error);

	/*
	 * Calls @found as accel_device_list() says, with names that start with
	 * the scheme. -ENOMEM. May be NULL: support for it is not built in.
	 */
	int (*list)(accel_device_list_fn found, void *data);

	/* Ends the board's use. No job is outstanding. */
	void (*close)(void *state);

	/* Fills @info; does not fail. */
	void (*info)(void *state, struct accel_transport_info *info);

	/*
	 * A range of board memory, its content zero. A job can reach @size bytes
	 * of it, 4 to 2^31, a multiple of 4, and no more.
	 * -ENOMEM: the board has no such range left.
	 */
	int (*memory_new)(void *state, uint64_t size, uint64_t *object);

	/* Every job that names @object has ended. */
	void (*memory_free)(void *state, uint64_t object);

	/*
	 * Called before submit. If a lot is queued, waits until the board has
	 * some of that, or has failed. May be NULL.
	 */
	void (*wait_for_room)(void *state);

	/*
	 * Starts a job. The stream and slot list are the caller's again on
	 * return; the response buffer belongs to the board until the job has
	 * been waited for. Stores a number for wait in *@sequence.
	 * -ENODEV: the board is gone; -EIO: it fails again and again; -ENOMEM;
	 * -EINVAL: not a job. Then it has no number, and nothing was lent.
	 */
	int (*submit)(void *state, const struct accel_transport_job *job, uint64_t *sequence);

	/*
	 * Waits until job @sequence has ended and fills @status; a fault is in
	 * there, and not an error of wait. @timeout_ns < 0 waits for ever.
	 * -ETIMEDOUT: still running; any other answer is the last one for this
	 * job, whose number is then forgotten and whose response buffer is the
	 * caller's again. -ENODEV: the board is gone; -EIO: the board failed and
	 * was reset; -ETIME: the job ran for longer than it may; -ENOMEM: there was
	 * none to run it; @status then has no fault.
	 */
	int (*wait)(void *state, uint64_t sequence, int64_t timeout_ns,
		    struct gloss_status *status);

	/*
	 * A file descriptor, the caller's, that is readable once job @sequence has ended, whether
	 * it was waited for or not. Any number of threads may be in it. May be NULL: boards have
	 * none. -EMFILE: no more files can be opened; -EIO, -ENODEV, -ENOMEM.
	 */
	int (*fence_fd)(void *state, uint64_t sequence);

	/*
	 * Clocks of all jobs that have ended. May be NULL: the board has no clock to count.
	 * -ENOTSUP: so has this one; -EIO, -ENODEV.
	 */
	int (*clocks)(void *state, struct accel_device_clocks *clocks);

	/*
	 * What is behind an @err of submit or wait, in words for people; NULL: that says
	 * it all. May be NULL.
	 */
	const char *(*why)(void *state, int err);
};

extern const struct accel_transport_ops accel_transport_drm;
extern const struct accel_transport_ops accel_transport_model;
extern const struct accel_transport_ops accel_transport_sim;
extern const struct accel_transport_ops accel_transport_usb;

#endif
