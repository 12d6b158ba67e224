// SPDX-License-Identifier: MIT
/*
 * Many jobs of several processes at once. Every job reads a number from board memory and
 * leaves its own there, so a job that is lost, runs twice or out of order shows in the
 * next one's answer.
 */
#include <errno.h>
#include <sys/wait.h>
#include <xf86drm.h>

#include "vm_test.h"
#include "gloss_node.h"

#define check(condition, ...)                 \
	do {                                  \
		if (!(condition))             \
			vm_fail(__VA_ARGS__); \
	} while (0)

enum {
	PROCESSES = 4,
	JOBS = 2500,  /* of each process */
	WINDOW = 300, /* under way at once in each: more than a ring holds */
	PATTERN = 8,
	ANSWER = 1 + PATTERN,
};

/* ---- a storm ---- */

/* Kernels that check themselves are slow, and fewer jobs show them all there is. */
static uint32_t jobs = JOBS;

struct storm {
	int fd;
	uint32_t process;
	uint32_t board, timeline, binary;
	struct node_buffer streams, responses, status; /* a page each, and 16 bytes */
	uint32_t words[WINDOW];
};

static uint32_t *page(const struct node_buffer *buffer, uint32_t n)
{
	return (uint32_t *)buffer->map + NODE_PAGE / 4 * (n % WINDOW);
}

static struct drm_gloss_status *status_of(const struct storm *storm, uint32_t n)
{
	return (struct drm_gloss_status *)storm->status.map + n % WINDOW;
}

static uint32_t pattern(const struct storm *storm, uint32_t n, uint32_t word)
{
	return (storm->process << 28) ^ (n * 0x9e3779b1u) ^ (word << 4);
}

static void storm_open(struct storm *storm, uint32_t process)
{
	int err;

	*storm = (struct storm){ .process = process };
	storm->fd = node_open(vm_env("GLOSS_NODE_MODEL"));
	check(storm->fd >= 0, "open: %s", strerror(-storm->fd));
	err = node_create(storm->fd, DRM_GLOSS_GEM_BOARD, NODE_PAGE, &storm->board);
	check(!err, "board object: %s", strerror(-err));
	err = node_sync_new(storm->fd, &storm->timeline)                                ?:
		      node_sync_new(storm->fd, &storm->binary)                          ?:
		      node_buffer_new(storm->fd, WINDOW * NODE_PAGE, &storm->streams)   ?:
		      node_buffer_new(storm->fd, WINDOW * NODE_PAGE, &storm->responses) ?:
		      node_buffer_new(storm->fd, 2 * NODE_PAGE, &storm->status);
	check(!err, "objects: %s", strerror(-err));
}

/* Answers the last job's number and this one's pattern, from memory. */
static void write_stream(struct storm *storm, uint32_t n)
{
	uint32_t words[1 + PATTERN] = { n }, *stream = page(&storm->streams, n), at;

	for (uint32_t i = 0; i < PATTERN; i++)
		words[1 + i] = pattern(storm, n, i);
	at = node_read(stream, 0, 0, 1);
	at += node_write(stream + at, 0, 0, words, 1 + PATTERN);
	at += node_read(stream + at, 0, 4, PATTERN);
	storm->words[n % WINDOW] = at;
	memset(page(&storm->responses, n), 0xee, 4 * ANSWER);
	*status_of(storm, n) = (struct drm_gloss_status){ 1, ~0u, ~0u, ~0u };
}

/*
 * One process is patient, one is privileged, and one changes from job to job: order
 * between priorities is only what its in-syncs ask for.
 */
static uint32_t priority(const struct storm *storm, uint32_t n)
{
	static const uint32_t priorities[PROCESSES] = {
		DRM_GLOSS_PRIORITY_NORMAL,
		DRM_GLOSS_PRIORITY_LOW,
		DRM_GLOSS_PRIORITY_HIGH,
	};

	if (storm->process == PROCESSES - 1)
		return n % 3 ? DRM_GLOSS_PRIORITY_NORMAL : DRM_GLOSS_PRIORITY_LOW;
	return priorities[storm->process];
}

static void send_job(struct storm *storm, uint32_t n)
{
	struct drm_gloss_slot slot = { storm->board, 3, 0, NODE_PAGE };
	struct drm_gloss_sync in = { storm->timeline, DRM_GLOSS_SYNC_TIMELINE, n - 1 };
	struct drm_gloss_sync out[2] = {
		{ storm->timeline, DRM_GLOSS_SYNC_TIMELINE, n },
		{ .handle = storm->binary },
	};
	struct drm_gloss_submit submit = {
		.priority = priority(storm, n),
		.stream = storm->streams.handle,
		.stream_words = storm->words[n % WINDOW],
		.stream_offset = n % WINDOW * NODE_PAGE,
		.response = storm->responses.handle,
		.response_words = ANSWER,
		.response_offset = n % WINDOW * NODE_PAGE,
		.status = storm->status.handle,
		.slot_count = 1,
		.status_offset = n % WINDOW * sizeof(struct drm_gloss_status),
		.slots = (uintptr_t)&slot,
		.in_syncs = (uintptr_t)&in,
		.out_syncs = (uintptr_t)out,
		.in_sync_count = n > 1 && storm->process == PROCESSES - 1,
		.out_sync_count = 1 + n % 2,
		.slot_stride = sizeof(slot),
		.sync_stride = sizeof(in),
	};
	int err;

	do
		err = node_submit(storm->fd, &submit);
	while (err == -EINTR);
	check(!err, "process %u, job %u: %s", storm->process, n, strerror(-err));
}

static void check_job(const struct storm *storm, uint32_t n)
{
	const struct drm_gloss_status *status = status_of(storm, n);
	const uint32_t *answer = page(&storm->responses, n);
	int err = node_wait(storm->fd, storm->timeline, n, vm_patience_ms());

	check(!err, "process %u, wait for job %u: %s", storm->process, n, strerror(-err));
	check(!status->error && !status->cause && status->offset == storm->words[n % WINDOW] &&
		      status->response_words == ANSWER,
	      "process %u, job %u: status %d %u %u %u", storm->process, n, status->error,
	      status->cause, status->offset, status->response_words);
	check(answer[0] == n - 1, "process %u: job %u ran after job %u", storm->process, n,
	      answer[0]);
	for (uint32_t i = 0; i < PATTERN; i++)
		check(answer[1 + i] == pattern(storm, n, i),
		      "process %u, job %u: word %u is 0x%08x", storm->process, n, i, answer[1 + i]);
}

static void storm_main(uint32_t process)
{
	struct storm storm;

	storm_open(&storm, process);
	for (uint32_t n = 1; n <= jobs + WINDOW; n++) {
		if (n > WINDOW)
			check_job(&storm, n - WINDOW);
		if (n > jobs)
			continue;
		write_stream(&storm, n);
		send_job(&storm, n);
	}
	check(!node_wait(storm.fd, storm.binary, 0, vm_patience_ms()) &&
		      !node_fence_error(storm.fd, storm.binary),
	      "process %u: binary syncobj", process);
}

/* ---- a chain: each process's job waits for one of the process before ---- */

enum {
	ROUNDS = 100,
	FILLERS = 20,
};

struct link {
	int fd;
	struct node_buffer stream; /* NOPs, so that the fillers take some time */
	struct node_buffer status; /* one for each round; all processes see it */
	uint32_t before, timeline; /* syncobjs of the process before, and its own */
};

static struct link links[PROCESSES];

static void import_sync(struct link *link, const struct link *before)
{
	int file;

	check(!drmSyncobjHandleToFD(before->fd, before->timeline, &file), "export a syncobj");
	check(!drmSyncobjFDToHandle(link->fd, file, &link->before), "import a syncobj");
	close(file);
}

static void make_links(void)
{
	for (int p = 0; p < PROCESSES; p++) {
		struct link *link = &links[p];
		int err;

		link->fd = node_open(vm_env("GLOSS_NODE_MODEL"));
		check(link->fd >= 0, "open: %s", strerror(-link->fd));
		err = node_sync_new(link->fd, &link->timeline)                        ?:
			      node_buffer_new(link->fd, 4 * NODE_PAGE, &link->stream) ?:
			      node_buffer_new(link->fd, NODE_PAGE, &link->status);
		check(!err, "objects: %s", strerror(-err));
		memset(link->status.map, 0xff, NODE_PAGE);
		if (p)
			import_sync(link, &links[p - 1]);
	}
}

/* Waits until the process before has sent its job, which need not have run. */
static void wait_for_link(const struct link *link, uint64_t round)
{
	uint32_t sync = link->before;

	check(!drmSyncobjTimelineWait(link->fd, &sync, &round, 1, INT64_MAX,
				      DRM_SYNCOBJ_WAIT_FLAGS_WAIT_FOR_SUBMIT |
					      DRM_SYNCOBJ_WAIT_FLAGS_WAIT_AVAILABLE,
				      NULL),
	      "no job to wait for");
}

static void send_link(const struct link *link, uint32_t round)
{
	struct drm_gloss_sync in = { link->before, DRM_GLOSS_SYNC_TIMELINE, round };
	struct drm_gloss_sync out = { link->timeline, DRM_GLOSS_SYNC_TIMELINE, round };
	struct drm_gloss_submit submit = {
		.stream = link->stream.handle,
		.stream_words = NODE_PAGE,
		.sync_stride = 0,
	};
	int err = 0;

	for (int n = 0; n < FILLERS && !err; n++)
		err = node_submit(link->fd, &submit);
	submit.status = link->status.handle;
	submit.status_offset = sizeof(struct drm_gloss_status) * round;
	submit.in_syncs = (uintptr_t)&in;
	submit.in_sync_count = link->before ? 1 : 0;
	submit.out_syncs = (uintptr_t)&out;
	submit.out_sync_count = 1;
	submit.sync_stride = sizeof(in);
	if (!err)
		err = node_submit(link->fd, &submit);
	check(!err, "round %u: %s", round, strerror(-err));
}

static bool link_ended(const struct link *link, uint32_t round)
{
	const volatile struct drm_gloss_status *status = link->status.map;

	return !status[round].error && status[round].offset == NODE_PAGE;
}

static void chain_main(uint32_t process)
{
	const struct link *link = &links[process];

	for (uint32_t round = 1; round <= ROUNDS; round++) {
		int err;

		if (process)
			wait_for_link(link, round);
		send_link(link, round);
		err = node_wait(link->fd, link->timeline, round, vm_patience_ms());
		check(!err, "process %u, round %u: %s", process, round, strerror(-err));
		check(link_ended(link, round), "process %u, round %u: no status", process, round);
		check(!process || link_ended(link - 1, round),
		      "process %u did not wait in round %u", process, round);
	}
}

/* ---- all at once ---- */

static double seconds(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void run_processes(const char *name, void (*run)(uint32_t process), uint32_t count)
{
	double start = seconds();
	pid_t process[PROCESSES];
	int failed = 0;

	for (uint32_t p = 0; p < PROCESSES; p++) {
		process[p] = fork();
		check(process[p] >= 0, "fork: %s", strerror(errno));
		if (!process[p]) {
			run(p);
			_exit(VM_PASS);
		}
	}
	for (uint32_t p = 0; p < PROCESSES; p++) {
		int status = 1;

		waitpid(process[p], &status, 0);
		failed += status != 0;
	}
	check(!failed, "%s: %d of %d processes failed", name, failed, PROCESSES);
	VM_PRINT("%s: %u jobs of %d processes in %.1f s\n", name, count, PROCESSES,
		 seconds() - start);
}

int main(void)
{
	const int slow = atoi(vm_env("GLOSS_SLOW"));

	/* The scheduler's thread has a real-time priority on 6.1, and on a busy machine no rest. */
	vm_expect("RT throttling activated");
	jobs /= (uint32_t)slow;
	run_processes("storm", storm_main, PROCESSES * jobs);
	make_links();
	run_processes("chain", chain_main, PROCESSES * ROUNDS * (FILLERS + 1));
	return VM_PASS;
}
