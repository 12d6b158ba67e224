/* SPDX-License-Identifier: MIT */
/*
 * A kernel with the gloss module and boards on the C model, in this process: libdrm is the real
 * one, and what it asks the kernel comes here (ioctl() is put in place of the C library's;
 * open, close, readlink, access, stat and drmGetDevices2 by the linker's --wrap). Arguments
 * are checked as the module does. It allocates nothing after the start, so that tests which
 * let memory run out meet only the library's calls.
 */
#ifndef FAKE_GLOSS_H
#define FAKE_GLOSS_H

#include <stdbool.h>
#include <stdint.h>

#define FAKE_NODES 3
#define FAKE_WORDS_MAX (4u << 20)
#define FAKE_BOARD_BYTES (8u << 20)

/* A node in /dev/dri: renderD128 and so on, in this order. */
struct fake_node {
	bool present;
	int open_error;           /* errno of open(); 0: it opens */
	unsigned int mode, group; /* what stat() tells */
	const char *driver;
};

/* What a test may set at any time, and what it may look at. */
struct fake_gloss {
	struct fake_node node[FAKE_NODES];
	bool module_loaded, has_clock;
	uint32_t version, tile_size;

	/* The @fail_at-th ioctl from now on, of number @fail_request if that is not 0, ends with
	 * @fail_errno. */
	unsigned int fail_at, fail_request;
	int fail_errno;

	unsigned int ioctls, submits, creates, waits; /* calls so far */
	unsigned int opened;                   /* of all opens, the number of the last node */
	unsigned int files, handles, syncobjs; /* that are there now */
	unsigned int left;   /* handles and syncobjs that were there when files closed */
	uint64_t host_bytes; /* of host objects that have a handle */
};

extern struct fake_gloss fake_gloss;

/* The board's thread starts and ends; all as new, one node. */
void fake_gloss_start(void);
void fake_gloss_stop(void);

/* The board runs no job until it is let go. */
void fake_gloss_hold(void);
void fake_gloss_release(void);
/* The job after @jobs others ends with @error in its status, or with none. */
#define FAKE_NO_STATUS 1
void fake_gloss_lose(unsigned int jobs, int error);
/* Jobs that wait are lost, and every call says -ENODEV from now on. */
void fake_gloss_unplug(void);

/* How many host objects are mapped. */
unsigned int fake_gloss_mappings(void);

#endif
