/* SPDX-License-Identifier: MIT */
/* What the files of fake_gloss.h share: objects and files in fake_gloss.c, jobs in
 * fake_gloss_job.c, syncobjs in fake_gloss_syncobj.c, the names of things in fake_gloss_node.c. */
#ifndef FAKE_GLOSS_PRIV_H
#define FAKE_GLOSS_PRIV_H

#include <pthread.h>

#include "fake_gloss.h"
#include "gloss_drm.h"
#include "model/model.h"

#define PAGE 4096u
#define FILES 8
#define OBJECTS 1024u
#define SYNCOBJS 4u
#define HOST_BYTES (256ull << 20)

/* Bytes of the memfd that is mapped at fake.host, or of fake.board. */
struct object {
	unsigned int uses; /* handles and jobs; 0: not there */
	uint32_t kind;
	uint64_t base, size;
};

#define SYNC_FILES 4

struct syncobj {
	bool used;
	uint64_t submitted, signalled;
	/* Of one without points: what was copied to it. */
	struct syncobj *source;
	uint64_t point;
	/* Sync files to be signalled, each an eventfd; 0: none. */
	int sync_file[SYNC_FILES];
	uint64_t sync_point[SYNC_FILES];
};

struct file {
	int fd; /* 0: not open */
	unsigned int node;
	struct object *handle[OBJECTS]; /* handle h is the entry before h */
	struct syncobj syncobj[SYNCOBJS];
};

struct fake_state {
	pthread_mutex_t lock;   /* protects what follows, and fake_gloss */
	pthread_cond_t changed; /* a job came, or ended, or what the test set */
	int host_fd;
	uint8_t *host;
	uint8_t board[FAKE_BOARD_BYTES] __attribute__((aligned(4096)));
	bool held, gone;
	unsigned int lose_after;
	int lose_error;
};

extern struct fake_state fake;

/* NULL: there is none. */
struct object *fake_handle_find(const struct file *file, uint32_t handle);
struct syncobj *fake_syncobj_find(struct file *file, uint32_t handle);

/* Called with the lock held: ioctls, and the sync files of points that are signalled. */
int fake_syncobj_create(struct file *file, struct drm_syncobj_create *create);
int fake_syncobj_destroy(struct file *file, const struct drm_syncobj_destroy *destroy);
int fake_syncobj_wait(struct file *file, const struct drm_syncobj_timeline_wait *wait);
int fake_syncobj_transfer(struct file *file, const struct drm_syncobj_transfer *transfer);
int fake_syncobj_export(struct file *file, struct drm_syncobj_handle *handle);
void fake_syncobj_signal(struct syncobj *syncobj);

/* Called with the lock held. */
int fake_job_submit(struct file *file, const struct drm_gloss_submit *submit);
/* The thread that runs them. */
void fake_job_start(void);
void fake_job_stop(void);

/* An open file of node @node: a file descriptor, or -errno. */
int fake_file_open(unsigned int node);
/* Nothing if it is no file of ours; the descriptor stays. */
void fake_file_close(int fd);

#endif
