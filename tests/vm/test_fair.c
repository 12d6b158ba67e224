// SPDX-License-Identifier: MIT
/*
 * Greedy clients: what others wait for, counted in jobs, and what ends. As root, for the
 * board's fault window, which makes every job last, for the module's parameters and for a
 * priority above the usual.
 */
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <linux/sync_file.h>
#include <sys/time.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "vboard/pci/faults.h"
#include "gloss_node.h"
#include "vm_test.h"
#include "vm_victim.h"

#define MIB (1ull << 20)

enum {
	QUEUED = 128, /* jobs of the greedy client */
	/* That each lasts at least: longer than the kernel's threads wait on a busy machine. */
	JOB_US = 150000,
	/* Jobs that together last far longer than a test may, and move all the time. */
	LONG_JOBS = 64,
	LONG_BYTES = 24 << 20,
};

static const char *node;
static volatile uint32_t *window;
static struct client greedy, small;

static void slow(uint32_t microseconds)
{
	window[VBOARD_FAULT_SLOW / 4] = microseconds;
}

static uint64_t now_ns(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (uint64_t)now.tv_sec * 1000000000 + (uint64_t)now.tv_nsec;
}

/* When the last fence of a binary syncobj signalled; UINT64_MAX: it has not. */
static uint64_t signalled_ns(int fd, uint32_t sync)
{
	struct sync_fence_info fence = { .status = 0 };
	struct sync_file_info info = { .num_fences = 1, .sync_fence_info = (uintptr_t)&fence };
	int file;

	assert_int_equal(drmSyncobjExportSyncFile(fd, sync, &file), 0);
	assert_int_equal(node_ioctl(file, SYNC_IOC_FILE_INFO, &info), 0);
	close(file);
	return fence.status ? fence.timestamp_ns : UINT64_MAX;
}

/* ---- turns ---- */

/* Jobs of the greedy client, each with a syncobj that it signals. */
static uint32_t queued[QUEUED];

static void queue_empty(struct client *by, uint32_t sync, uint32_t board, uint32_t priority)
{
	struct drm_gloss_slot slot = {
		.handle = board,
		.rights = DRM_GLOSS_SLOT_WRITE,
		.size = NODE_PAGE,
	};
	struct drm_gloss_sync out = { .handle = sync };
	struct drm_gloss_submit submit = {
		.priority = priority,
		.slots = (uintptr_t)&slot,
		.slot_count = board ? 1 : 0,
		.slot_stride = board ? sizeof(slot) : 0,
		.out_syncs = (uintptr_t)&out,
		.out_sync_count = 1,
		.sync_stride = sizeof(out),
	};

	assert_int_equal(node_submit(by->fd, &submit), 0);
}

/*
 * Runs an empty job of @priority; how many of the first @count of queued[] ended while it
 * waited. Fences tell when they signalled, so it does not matter when this process runs.
 */
static int ended_meanwhile(int count, uint32_t priority)
{
	uint64_t begun, done;
	int ended = 0;

	queue_empty(&small, small.done, 0, priority);
	begun = now_ns();
	assert_int_equal(node_wait(small.fd, small.done, 0, vm_patience_ms()), 0);
	done = signalled_ns(small.fd, small.done);
	for (int n = 0; n < count; n++) {
		uint64_t at = signalled_ns(greedy.fd, queued[n]);

		ended += at > begun && at < done;
	}
	return ended;
}

/* The most of three times that a small job waited for while a greedy client had all queued. */
static int most_waited_for(uint32_t greedy_priority, uint32_t small_priority)
{
	int most = 0;

	slow(JOB_US);
	for (int n = 0; n < QUEUED; n++)
		queue_empty(&greedy, queued[n], 0, greedy_priority);
	for (int times = 0; times < 3; times++) {
		int waited = ended_meanwhile(QUEUED, small_priority);

		most = waited > most ? waited : most;
	}
	/* Else it was no test. */
	assert_int_equal(signalled_ns(greedy.fd, queued[QUEUED - 1]), UINT64_MAX);
	slow(0);
	assert_int_equal(node_wait(greedy.fd, queued[QUEUED - 1], 0, vm_patience_ms()), 0);
	return most;
}

static void a_small_job_waits_for_three_of_a_greedy_client(void **state)
{
	int most = most_waited_for(DRM_GLOSS_PRIORITY_NORMAL, DRM_GLOSS_PRIORITY_NORMAL);

	(void)state;
	vm_figures((struct vm_figure[]){ { "drm.fair_jobs", most } }, 1);
	assert_in_range(most, 0, 3);
}

static void a_small_job_of_a_higher_priority_waits_for_two(void **state)
{
	(void)state;
	assert_in_range(most_waited_for(DRM_GLOSS_PRIORITY_NORMAL, DRM_GLOSS_PRIORITY_HIGH), 0, 2);
	assert_in_range(most_waited_for(DRM_GLOSS_PRIORITY_LOW, DRM_GLOSS_PRIORITY_NORMAL), 0, 2);
}

/*
 * Objects that are made, used and closed: each of these jobs comes after eight that clear a
 * MiB, which are turns of the same client. Three turns have at most one such job.
 */
static void clearing_does_not_hold_up_a_small_job(void **state)
{
	enum { OBJECTS = 12 };

	(void)state;
	slow(JOB_US / 2);
	for (int n = 0; n < OBJECTS; n++) {
		uint32_t board;

		assert_int_equal(node_create(greedy.fd, DRM_GLOSS_GEM_BOARD, 8 * MIB, &board), 0);
		queue_empty(&greedy, queued[n], board, DRM_GLOSS_PRIORITY_NORMAL);
		assert_int_equal(node_destroy(greedy.fd, board), 0);
	}
	for (int times = 0; times < 3; times++)
		assert_in_range(ended_meanwhile(OBJECTS, DRM_GLOSS_PRIORITY_NORMAL), 0, 1);
	assert_int_equal(signalled_ns(greedy.fd, queued[OBJECTS - 1]), UINT64_MAX);
	slow(0);
	assert_int_equal(node_wait(greedy.fd, queued[OBJECTS - 1], 0, vm_patience_ms()), 0);
}

/* ---- bounds ---- */

static void set_job_limit(uint64_t milliseconds)
{
	char text[32];

	snprintf(text, sizeof(text), "%llu", (unsigned long long)milliseconds);
	vm_parameter("job_limit_ms", text);
}

static void a_job_that_runs_too_long_ends_with_etime(void **state)
{
	const uint64_t limit = 300;
	uint64_t usual, value, begun;

	(void)state;
	assert_int_equal(node_param(greedy.fd, DRM_GLOSS_PARAM_JOB_LIMIT, &usual), 0);
	vm_expect("gloss .* ran for more than");
	set_job_limit(limit);
	assert_int_equal(node_param(greedy.fd, DRM_GLOSS_PARAM_JOB_LIMIT, &value), 0);
	assert_int_equal(value, limit);
	/* Until the reset, and the limit is below the time after which the board would hang. */
	window[VBOARD_FAULT_HANG / 4] = 1;
	begun = now_ns();
	assert_int_equal(client_run(&greedy, 0, 0), -ETIME);
	assert_true(now_ns() - begun >= limit * 1000000);
	assert_int_equal(greedy.status->error, -ETIME);
	set_job_limit(usual);
	vm_expect_end();
	assert_int_equal(node_param(greedy.fd, DRM_GLOSS_PARAM_JOBS_LOST, &value), 0);
	assert_int_equal(value, 1);
	assert_true(client_works(&small));
	assert_true(client_works(&greedy));
}

/* Queues LONG_JOBS; -errno. */
static int queue_long(const struct client *by, uint32_t board)
{
	struct drm_gloss_slot slot = {
		.handle = board,
		.rights = DRM_GLOSS_SLOT_WRITE,
		.size = NODE_PAGE,
	};
	struct drm_gloss_submit submit = {
		.slots = (uintptr_t)&slot,
		.slot_count = board ? 1 : 0,
		.slot_stride = board ? sizeof(slot) : 0,
	};
	struct node_buffer buffer;
	int err = node_buffer_new(by->fd, LONG_BYTES, &buffer);

	if (err)
		return err;
	submit.stream = buffer.handle;
	submit.stream_words = node_long(buffer.map, LONG_BYTES / 4);
	for (int n = 0; n < LONG_JOBS && !err; n++)
		err = node_submit(by->fd, &submit);
	node_buffer_free(by->fd, &buffer);
	return err;
}

/* Larger than what is left, if somebody has as much. */
static uint64_t large_object(int fd)
{
	uint64_t memory;

	assert_int_equal(node_param(fd, DRM_GLOSS_PARAM_MEMORY_SIZE, &memory), 0);
	return memory / 8 * 5;
}

static bool take_memory_for_ever(uint32_t *told)
{
	struct client victim;
	uint32_t board;

	(void)told;
	return !client_open(&victim, node, 0) &&
	       !node_create(victim.fd, DRM_GLOSS_GEM_BOARD, large_object(victim.fd), &board) &&
	       !queue_long(&victim, board);
}

static void memory_of_a_killed_client_is_free_soon(void **state)
{
	const uint64_t until = now_ns() + vm_patience_ms() * 1000000ull;
	uint32_t board;
	int err;

	(void)state;
	victim_kill(victim_start(take_memory_for_ever, NULL));
	while ((err = node_create(small.fd, DRM_GLOSS_GEM_BOARD, large_object(small.fd), &board)) ==
		       -ENOSPC &&
	       now_ns() < until)
		usleep(10000);
	assert_int_equal(err, 0);
	assert_int_equal(node_destroy(small.fd, board), 0);
	assert_true(client_works(&small));
}

/* Submits empty jobs until SUBMIT says something else than 0, but not more than @most. */
static int fill(struct client *by, uint64_t most, uint64_t *count)
{
	int err = 0;

	for (*count = 0; *count <= most && !err; (*count)++)
		err = node_submit(by->fd, &(struct drm_gloss_submit){ .flags = 0 });
	return err;
}

static void on_alarm(int number)
{
	(void)number;
}

static void a_file_has_no_more_jobs_than_it_may(void **state)
{
	const struct sigaction action = { .sa_handler = on_alarm };
	const struct itimerval often = { .it_interval = { .tv_usec = 100000 },
					 .it_value = { .tv_usec = 100000 } };
	const struct itimerval never = { .it_value = { .tv_sec = 0 } };
	uint64_t most, count;

	(void)state;
	assert_int_equal(node_param(greedy.fd, DRM_GLOSS_PARAM_JOBS_QUEUED, &most), 0);
	assert_int_equal(queue_long(&greedy, 0), 0);
	assert_int_equal(fcntl(greedy.fd, F_SETFL, O_RDWR | O_NONBLOCK), 0);
	assert_int_equal(fill(&greedy, 200000, &count), -EAGAIN);
	assert_in_range(count, most - LONG_JOBS, most + 1);

	/* Who waits can be interrupted. */
	assert_int_equal(fcntl(greedy.fd, F_SETFL, O_RDWR), 0);
	assert_int_equal(sigaction(SIGALRM, &action, NULL), 0);
	assert_int_equal(setitimer(ITIMER_REAL, &often, NULL), 0);
	assert_int_equal(fill(&greedy, 200000, &count), -EINTR);
	assert_int_equal(setitimer(ITIMER_REAL, &never, NULL), 0);

	/* The board is not held up by what is queued for a file that is closed. */
	client_close(&greedy);
	assert_true(client_works(&small));
}

/* Its wait ends when a job does. */
static void who_waits_for_room_gets_it(void **state)
{
	uint64_t most, count;

	(void)state;
	assert_int_equal(node_param(greedy.fd, DRM_GLOSS_PARAM_JOBS_QUEUED, &most), 0);
	assert_int_equal(fill(&greedy, 4 * most, &count), 0);
	assert_true(client_works(&greedy));
}

/* ---- set up ---- */

static int setup(void **state)
{
	(void)state;
	node = vm_env("GLOSS_NODE_MODEL");
	window = vm_faults("GLOSS_PCI_MODEL");
	assert_int_equal(window[VBOARD_FAULT_IDENTITY / 4], VBOARD_FAULT_IDENTITY_VALUE);
	return 0;
}

static int open_files(void **state)
{
	(void)state;
	assert_int_equal(client_open(&greedy, node, NODE_PAGE), 0);
	assert_int_equal(client_open(&small, node, NODE_PAGE), 0);
	assert_true(client_works(&greedy));
	assert_true(client_works(&small));
	for (int n = 0; n < QUEUED; n++)
		assert_int_equal(node_sync_new(greedy.fd, &queued[n]), 0);
	return 0;
}

static int close_files(void **state)
{
	(void)state;
	slow(0);
	window[VBOARD_FAULT_HANG / 4] = 0;
	client_close(&greedy);
	client_close(&small);
	return 0;
}

#define fair_test(name) cmocka_unit_test_setup_teardown(name, open_files, close_files)

int main(void)
{
	const struct CMUnitTest tests[] = {
		fair_test(a_small_job_waits_for_three_of_a_greedy_client),
		fair_test(a_small_job_of_a_higher_priority_waits_for_two),
		fair_test(clearing_does_not_hold_up_a_small_job),
		fair_test(a_job_that_runs_too_long_ends_with_etime),
		fair_test(memory_of_a_killed_client_is_free_soon),
		fair_test(a_file_has_no_more_jobs_than_it_may),
		fair_test(who_waits_for_room_gets_it),
	};

	return cmocka_run_group_tests(tests, setup, NULL);
}
