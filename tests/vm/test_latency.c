// SPDX-License-Identifier: MIT
/*
 * How long an empty job takes from SUBMIT to its fence, against the least that any driver
 * takes: the virtual board's doorbell, its interrupt, and the waiting thread's wake-up
 * (tests/vm/modules). Both in this run, on the same board, each across the system call.
 */
#include "vm_board.h"
#include "gloss_node.h"
#include "vm_test.h"

enum {
	ROUNDS = 31,
	WARM = 20,			/* in each round */
	TIMES = 100,
};

/* More than this many times the floor is too slow. */
#define RATIO_MOST 3.0

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
		err = node_wait(job->fd, job->timeline, job->point, NODE_PATIENCE_MS);
	if (err)
		vm_fail("an empty job: %s", strerror(-err));
}

static double submit_us(const char *pci)
{
	char path[BOARD_PATH];
	struct job job = { .point = 0 };
	double took;

	if (board_node(pci, NODE_PATIENCE_MS, path))
		vm_fail("%s has no render node", pci);
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

/* ---- both, in turns, as other programs disturb some rounds and slow down others ---- */

int main(void)
{
	const char *pci = vm_env("GLOSS_PCI_MODEL");
	double submit[ROUNDS], floor[ROUNDS], ratio[ROUNDS], vs_floor;
	int err;

	if (atoi(vm_env("GLOSS_SLOW")) > 1)
		vm_skip("a kernel that does not check itself");
	err = board_load("gloss_floor", "");
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
	vs_floor = median(ratio, ROUNDS);
	VM_PRINT("an empty job takes %.1f us, a bare doorbell %.1f us\n", median(submit, ROUNDS),
		 median(floor, ROUNDS));
	vm_figures((struct vm_figure[]){ { "drm.submit_us", median(submit, ROUNDS) },
					 { "drm.submit_vs_floor", vs_floor } }, 2);
	if (vs_floor > RATIO_MOST)
		vm_fail("a job takes %.2f times the floor, more than %.1f", vs_floor, RATIO_MOST);
	return VM_PASS;
}
