/* SPDX-License-Identifier: MIT */
/*
 * A gloss node as the kernel gives it, for tests of the module: nothing of libaccel is
 * between. Functions return 0 or what the system call said, as -errno.
 */
#ifndef GLOSS_NODE_H
#define GLOSS_NODE_H

#include <stdbool.h>
#include <stdint.h>

#include "gloss_drm.h"
#include "gloss_packets.h"

#define NODE_PAGE 4096u

/* A host object and where this process sees it. */
struct node_buffer {
	uint32_t handle;
	uint64_t size;
	void *map;
};

/* ---- one system call each; none is repeated after a signal ---- */

int node_ioctl(int fd, unsigned long request, const void *argument);
/* The file's number. */
int node_open(const char *path);
int node_param(int fd, uint32_t param, uint64_t *value);
int node_create(int fd, uint32_t kind, uint64_t size, uint32_t *handle);
int node_destroy(int fd, uint32_t handle);
int node_mmap_offset(int fd, uint32_t handle, uint64_t *offset);
int node_submit(int fd, const struct drm_gloss_submit *submit);
int node_sync_new(int fd, uint32_t *sync);

/* Waits for a point of a timeline, or with point 0 for a binary syncobj. -ETIME: too late. */
int node_wait(int fd, uint32_t sync, uint64_t point, int milliseconds);

/* What the fence of a binary syncobj ended with: 0 or an error; -EBUSY: it has not ended. */
int node_fence_error(int fd, uint32_t sync);
/* The same of a sync file, which outlives its board; waited for. */
int node_file_wait(int file, int milliseconds);

/* A mapped host object, all zero. */
int node_buffer_new(int fd, uint64_t size, struct node_buffer *buffer);
void node_buffer_free(int fd, struct node_buffer *buffer);

/* ---- packets; each returns the words it wrote at @to ---- */

uint32_t node_write(uint32_t *to, uint32_t slot, uint32_t offset, const uint32_t *words,
		    uint32_t count);
uint32_t node_read(uint32_t *to, uint32_t slot, uint32_t offset, uint32_t count);
/* Stores a cleared tile: 4 * tile * tile bytes from @offset on, all of them @value. */
uint32_t node_fill(uint32_t *to, uint32_t slot, uint32_t offset, uint32_t tile, uint32_t value);

/*
 * A tile, and triangles that cover it, in at most @room words: the most work that a word of a
 * stream can ask for.
 */
uint32_t node_long(uint32_t *to, uint32_t room);

/* ---- a file that runs jobs one at a time ---- */

/* Jobs that client_queue() can have under way. */
#define CLIENT_QUEUE 8u

#define CLIENT_STREAM_WORDS (8 * 1024u)
#define CLIENT_RESPONSE_WORDS (65 * 1024u)
#define CLIENT_STATUS_OFFSET (4 * (CLIENT_STREAM_WORDS + CLIENT_RESPONSE_WORDS))
#define CLIENT_HOST_BYTES (CLIENT_STATUS_OFFSET + NODE_PAGE)

struct client {
	int fd;
	struct node_buffer host; /* the next three are in it */
	uint32_t *stream, *response;
	volatile struct drm_gloss_status *status;
	uint32_t board; /* slot 0 of every job; 0: none */
	uint64_t board_size;
	uint32_t done;     /* binary, signalled by the last job */
	uint32_t timeline; /* @point, signalled by the last job */
	uint64_t point;
	uint32_t queued[CLIENT_QUEUE]; /* binary, signalled by the job of this number */
};

/* A submission and what it points to; so it must not be copied. */
struct client_job {
	struct drm_gloss_submit submit;
	struct drm_gloss_slot slot[GLOSS_SLOTS];
	struct drm_gloss_sync in[2], out[2];
};

/* @board_size 0: no board object. What was opened stays open on an error. */
int client_open(struct client *client, const char *path, uint64_t board_size);
void client_close(struct client *client);

/* A right submission of the first @words of the stream, to be changed before it is sent. */
void client_prepare(struct client *client, struct client_job *job, uint32_t words,
		    uint32_t response_words);
/* Sends it; client_wait() waits for it. */
int client_submit(struct client *client, const struct client_job *job);
/* Waits for the last job that was sent; the error of its fence. */
int client_wait(struct client *client, int milliseconds);
/* All of the above. */
int client_run(struct client *client, uint32_t words, uint32_t response_words);

/*
 * Sends job @n, below CLIENT_QUEUE, which writes to board memory and reads it back; all may
 * be under way at once. client_queue_wait() gives the error of its fence; it compares that
 * with what the job left in memory: -EBADMSG if they do not agree.
 */
int client_queue(struct client *client, uint32_t n);
int client_queue_wait(struct client *client, uint32_t n);

/* Does a job that writes to board memory, or without any an empty one, end as it should? */
bool client_works(struct client *client);

#endif
