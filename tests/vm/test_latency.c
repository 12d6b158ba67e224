// SPDX-License-Identifier: MIT
/*
 * How long an empty job takes from SUBMIT to its fence, against the least that any driver
 * takes: the virtual board's doorbell, its interrupt, and the waiting thread's wake-up
 * (tests/vm/modules). Both in this run, on the same board, each across the system call. Then how
 * long it takes beside a client whose jobs all use board memory that has to be cleared first.
 */
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include "vm_board.h"
#include "gloss_node.h"
#include "vm_test.h"

enum {
	ROUNDS = 31,
	WARM = 20, /* in each round */
	TIMES = 100,
};

/* More than this many times the floor is too slow. */
#define RATIO_MOST 3.0

/* What the other client makes, uses and closes; and the longest that a job may take beside it. */
#define CLEARED_BYTES (8ull << 20)
#define BESIDE_MOST_MS 20.0

static double now_us(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
}

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

static double median(double *numbers, size_t count)
{
	qsort(numbers, count, sizeof(*numbers), compare);
	return numbers[count / 2];
}

/* Median of TIMES calls of @once. */
static double median_us(void (*once)(void *data), void *data)
{
	double took[TIMES];

	for (int n = 0; n < WARM; n++)
		once(data);
	for (int n = 0; n < TIMES; n++) {
		double start = now_us();

		once(data);
		took[n] = now_us() - start;
	}
	return median(took, TIMES);
}

/* ---- a job ---- */

struct job {
	int fd;
	uint32_t timeline;
	uint64_t point;
};

static void job_once(void *data)
{
	struct job *job = data;
	struct drm_gloss_sync out = { job->timeline, DRM_GLOSS_SYNC_TIMELINE, ++job->point };
	struct drm_gloss_submit submit = {
		.out_syncs = (uintptr_t)&out,
		.out_sync_count = 1,
		.sync_stride = sizeof(out),
	};
	int err = node_submit(job->fd, &submit);

	if (!err)
		err = node_wait(job->fd, job->timeline, job->point, vm_patience_ms());
	if (err)
		vm_fail("an empty job: %s", strerror(-err));
}

static void find_node(const char *pci, char path[BOARD_PATH])
{
	if (board_node(pci, vm_patience_ms(), path))
		vm_fail("%s has no render node", pci);
}

static double submit_us(const char *pci)
{
	char path[BOARD_PATH];
	struct job job = { .point = 0 };
	double took;

	find_node(pci, path);
	job.fd = node_open(path);
	if (job.fd < 0 || node_sync_new(job.fd, &job.timeline))
		vm_fail("%s: %s", path, strerror(errno));
	took = median_us(job_once, &job);
	close(job.fd);
	return took;
}

/* ---- the floor ---- */

static void floor_once(void *data)
{
	if (read(*(int *)data, NULL, 0))
		vm_fail("the doorbell: %s", strerror(errno));
}

/* A fresh devtmpfs entry is there when bind returns, udev or not. */
static double floor_us(void)
{
	int fd = open("/dev/gloss_floor", O_RDONLY | O_CLOEXEC);
	double took;

	if (fd < 0)
		vm_fail("/dev/gloss_floor: %s", strerror(errno));
	took = median_us(floor_once, &fd);
	close(fd);
	return took;
}

/* Hands the board from one driver to the other. */
static void hand_over(const char *pci, const char *driver)
{
	int err = board_unbind(pci);

	if (!err)
		err = board_write(pci, "driver_override", driver);
	if (!err)
		err = board_bind(pci, driver);
	if (err)
		vm_fail("bind %s to %s: %s", pci, driver, strerror(-err));
}

/* Both, in turns, as other programs disturb some rounds and slow down others. */
static void measure_alone(const char *pci, double *us, double *vs_floor)
{
	double submit[ROUNDS], floor[ROUNDS], ratio[ROUNDS];
	int err = board_load("gloss_floor", "");

	if (err)
		vm_fail("load gloss_floor.ko: %s", strerror(-err));
	for (int n = 0; n < ROUNDS; n++) {
		submit[n] = submit_us(pci);
		hand_over(pci, "gloss_floor");
		floor[n] = floor_us();
		hand_over(pci, "gloss");
		ratio[n] = submit[n] / floor[n];
	}
	board_write(pci, "driver_override", "\n");
	err = board_unload("gloss_floor");
	if (err)
		vm_fail("unload gloss_floor: %s", strerror(-err));
	*us = median(submit, ROUNDS);
	*vs_floor = median(ratio, ROUNDS);
	VM_PRINT("an empty job takes %.1f us, a bare doorbell %.1f us\n", *us,
		 median(floor, ROUNDS));
}

/* ---- beside a client that has much cleared ---- */

/* The board object of the next job: when there is room, while some jobs are still queued. */
static int new_object(struct client *client)
{
	const uint64_t queued = 8;
	int err, waited = 0;

	do {
		err = node_create(client->fd, DRM_GLOSS_GEM_BOARD, CLEARED_BYTES, &client->board);
		if (err == -ENOSPC && client->point > queued)
			waited = node_wait(client->fd, client->timeline, client->point - queued,
					   vm_patience_ms());
	} while (err == -ENOSPC && !waited);
	return waited ? waited : err;
}

/* Makes an object, has a job write to it, and closes it. */
static int use_object(struct client *client)
{
	struct client_job job;
	uint32_t words;
	int err = new_object(client);

	if (err)
		return err;
	client->board_size = CLEARED_BYTES;
	words = node_write(client->stream, 0, 0, &(uint32_t){ 1 }, 1);
	client_prepare(client, &job, words, 0);
	err = client_submit(client, &job);
	node_destroy(client->fd, client->board);
	return err;
}

/* Always has jobs queued. Counts its objects. */
__attribute__((noreturn)) static void use_objects(const char *path, volatile unsigned int *objects)
{
	struct client client;
	int err;

	prctl(PR_SET_PDEATHSIG, SIGKILL);
	err = client_open(&client, path, 0);
	while (!err) {
		err = use_object(&client);
		++*objects;
	}
	vm_fail("to use an object: %s", strerror(-err));
}

/* Milliseconds that an empty job takes meanwhile. */
static double beside_clears_ms(const char *pci)
{
	volatile unsigned int *objects = mmap(NULL, sizeof(*objects), PROT_READ | PROT_WRITE,
					      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	char path[BOARD_PATH];
	unsigned int before;
	double took;
	pid_t other;

	if (objects == MAP_FAILED)
		vm_fail("mmap: %s", strerror(errno));
	find_node(pci, path);
	other = fork();
	if (other < 0)
		vm_fail("fork: %s", strerror(errno));
	if (!other)
		use_objects(path, objects);
	/* More than the board has room for: from now on the other one waits for its jobs. */
	while (*objects < 64 && !waitpid(other, NULL, WNOHANG))
		usleep(10000);
	before = *objects;
	took = submit_us(pci);
	VM_PRINT("an empty job takes %.1f ms beside a client that used %u objects meanwhile\n",
		 took / 1000, *objects - before);
	if (kill(other, SIGKILL) || waitpid(other, NULL, 0) != other || *objects == before)
		vm_fail("the other client used no objects meanwhile");
	return took / 1000;
}

int main(void)
{
	const char *pci = vm_env("GLOSS_PCI_MODEL");
	double us, vs_floor, beside_ms;

	if (atoi(vm_env("GLOSS_SLOW")) > 1)
		vm_skip("a kernel that does not check itself");
	measure_alone(pci, &us, &vs_floor);
	beside_ms = beside_clears_ms(pci);
	vm_figures((struct vm_figure[]){ { "drm.submit_us", us },
					 { "drm.submit_vs_floor", vs_floor },
					 { "drm.small_job_beside_clears_ms", beside_ms } },
		   3);
	if (vs_floor > RATIO_MOST)
		vm_fail("a job takes %.2f times the floor, more than %.1f", vs_floor, RATIO_MOST);
	if (beside_ms > BESIDE_MOST_MS)
		vm_fail("a job takes %.1f ms beside clears, more than %.1f", beside_ms,
			BESIDE_MOST_MS);
	return VM_PASS;
}
