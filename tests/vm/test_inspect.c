// SPDX-License-Identifier: MIT
/*
 * What the module tells an operator, in debugfs, fdinfo and tracepoints, is true of jobs
 * that this program sends. As root.
 */
#include <dlfcn.h>
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <xf86drm.h>

#include "vboard/pci/faults.h"
#include "gloss_node.h"
#include "vm_board.h"
#include "vm_test.h"

#define BOARD_BYTES (64 * NODE_PAGE)
#define TRACING "/sys/kernel/tracing"

static const char *pci;
static struct client client;

/* ---- files ---- */

static void read_text(const char *path, char *text, size_t size)
{
	FILE *file = fopen(path, "r");
	size_t length;

	if (!file) {
		fail_msg("%s: %s", path, strerror(errno));
		return;
	}
	length = fread(text, 1, size - 1, file);
	text[length] = '\0';
	fclose(file);
}

static const char *debugfs(const char *name)
{
	static char text[8192];
	char path[128];

	snprintf(path, sizeof(path), "/sys/kernel/debug/dri/%d/%s", board_minor(pci), name);
	read_text(path, text, sizeof(text));
	return text;
}

static const char *fdinfo(void)
{
	static char text[2048];
	char path[64];

	snprintf(path, sizeof(path), "/proc/self/fdinfo/%d", client.fd);
	read_text(path, text, sizeof(text));
	return text;
}

/* The number behind @key. */
static uint64_t number(const char *text, const char *key)
{
	const char *at = strstr(text, key);

	if (!at)
		fail_msg("no \"%s\" in: %s", key, text);
	return strtoull(at + strlen(key), NULL, 0);
}

static void assert_says(const char *text, const char *part)
{
	if (!strstr(text, part))
		fail_msg("no \"%s\" in: %s", part, text);
}

static void run_faulty_job(void)
{
	client.stream[0] = 0;
	client.stream[1] = 0xff000000;
	assert_int_equal(client_run(&client, 2, 0), -EIO);
}

/* ---- debugfs ---- */

static void the_ring_counts_jobs(void **state)
{
	uint64_t ended = number(debugfs("ring"), "ended "),
		 faults = number(debugfs("ring"), "with a fault ");

	(void)state;
	assert_true(client_works(&client));
	assert_true(client_works(&client));
	run_faulty_job();
	assert_int_equal(number(debugfs("ring"), "ended "), ended + 3);
	assert_int_equal(number(debugfs("ring"), "with a fault "), faults + 1);
}

/* Whether a job is shown before it has ended, which takes a while to come into the ring. */
static bool ring_shows_job(const char *pid)
{
	uint64_t ended = number(debugfs("ring"), "ended ");
	bool shown;

	assert_int_equal(client_queue(&client, 0), 0);
	do
		shown = strstr(debugfs("ring"), pid) != NULL;
	while (!shown && number(debugfs("ring"), "ended ") == ended);
	assert_int_equal(client_queue_wait(&client, 0), 0);
	return shown;
}

static void the_ring_shows_who_runs(void **state)
{
	volatile uint32_t *window = vm_faults("GLOSS_PCI_MODEL");
	bool shown = false;
	char pid[32];

	(void)state;
	snprintf(pid, sizeof(pid), "pid %d", getpid());
	/* Not as long as a hang; a busy machine may sleep through one or the other. */
	window[VBOARD_FAULT_SLOW / 4] = 400000;
	for (int i = 0; i < 10 && !shown; i++)
		shown = ring_shows_job(pid);
	assert_true(shown);
	window[VBOARD_FAULT_SLOW / 4] = 0;
	assert_null(strstr(debugfs("ring"), pid));
}

static void the_last_fault_is_told_in_names(void **state)
{
	char pid[32];

	(void)state;
	snprintf(pid, sizeof(pid), "pid %d", getpid());
	run_faulty_job();
	assert_says(debugfs("fault"), pid);
	assert_says(debugfs("fault"), "cause opcode");
	assert_says(debugfs("fault"), "word 1 ");
}

static void registers_and_counters_are_shown(void **state)
{
	uint64_t jobs = number(debugfs("counters"), "JOBS = ");

	(void)state;
	assert_int_equal(number(debugfs("registers"), "IDENTITY = "), 0x534f4c47);
	assert_int_equal(number(debugfs("registers"), "VERSION = "), GLOSS_VERSION);
	assert_true(client_works(&client));
	assert_int_equal(number(debugfs("counters"), "JOBS = "), jobs + 1);
}

static void board_memory_is_shown(void **state)
{
	uint64_t used = number(debugfs("memory"), "used ");

	(void)state;
	assert_in_range(used, BOARD_BYTES, UINT32_MAX);
	assert_int_equal(node_destroy(client.fd, client.board), 0);
	/* Its jobs have ended, but may not be freed yet. */
	for (int ms = 0; number(debugfs("memory"), "used ") > used - BOARD_BYTES; ms += 10) {
		assert_in_range(ms, 0, vm_patience_ms());
		usleep(10 * 1000);
	}
}

/* ---- fdinfo ---- */

static void fdinfo_names_driver_and_board(void **state)
{
	(void)state;
	assert_says(fdinfo(), "drm-driver:\tgloss\n");
	assert_says(fdinfo(), strrchr(pci, '/') + 1);
	assert_int_not_equal(number(fdinfo(), "drm-client-id:\t"), 0);
}

static void fdinfo_counts_memory(void **state)
{
	uint64_t total = number(fdinfo(), "drm-total-memory:\t");
	uint32_t handle;

	(void)state;
	assert_int_equal(total, CLIENT_HOST_BYTES / 1024);
	assert_int_equal(number(fdinfo(), "drm-total-board:\t"), BOARD_BYTES / 1024);
	assert_int_equal(number(fdinfo(), "drm-resident-board:\t"), BOARD_BYTES / 1024);
	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, 1 << 20, &handle), 0);
	assert_int_equal(number(fdinfo(), "drm-total-memory:\t"), total + 1024);
	assert_int_equal(node_destroy(client.fd, handle), 0);
	assert_int_equal(number(fdinfo(), "drm-total-memory:\t"), total);
}

/* A page is there when it is first touched, all of an object's when a job uses it. */
static void fdinfo_counts_pages_that_are_there(void **state)
{
	uint64_t before = number(fdinfo(), "drm-resident-memory:\t");
	struct node_buffer buffer;

	(void)state;
	assert_int_equal(before, CLIENT_HOST_BYTES / 1024);
	assert_int_equal(node_buffer_new(client.fd, 1 << 20, &buffer), 0);
	assert_int_equal(number(fdinfo(), "drm-resident-memory:\t"), before);
	memset(buffer.map, 1, 2 * NODE_PAGE);
	assert_int_equal(number(fdinfo(), "drm-resident-memory:\t"), before + 2 * NODE_PAGE / 1024);
	node_buffer_free(client.fd, &buffer);
}

static void fdinfo_counts_what_other_files_share(void **state)
{
	struct client other;
	uint32_t handle;
	int file;

	(void)state;
	assert_int_equal(client_open(&other, vm_env("GLOSS_NODE_MODEL"), 0), 0);
	assert_int_equal(number(fdinfo(), "drm-shared-memory:\t"), 0);
	assert_int_equal(drmPrimeHandleToFD(client.fd, client.host.handle, DRM_CLOEXEC, &file), 0);
	assert_int_equal(drmPrimeFDToHandle(other.fd, file, &handle), 0);
	assert_int_equal(number(fdinfo(), "drm-shared-memory:\t"), CLIENT_HOST_BYTES / 1024);
	close(file);
	client_close(&other);
	assert_int_equal(number(fdinfo(), "drm-shared-memory:\t"), 0);
}

static uint64_t now_ns(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (uint64_t)now.tv_sec * 1000000000 + (uint64_t)now.tv_nsec;
}

/* At least what the jobs last, and not more than has passed. */
static void fdinfo_counts_engine_time(void **state)
{
	volatile uint32_t *window = vm_faults("GLOSS_PCI_MODEL");
	uint64_t start = now_ns(), before = number(fdinfo(), "drm-engine-render:\t"), worked;

	(void)state;
	window[VBOARD_FAULT_SLOW / 4] = 50000;
	assert_true(client_works(&client));
	assert_true(client_works(&client));
	window[VBOARD_FAULT_SLOW / 4] = 0;
	worked = number(fdinfo(), "drm-engine-render:\t") - before;
	assert_in_range(worked, 90000000, now_ns() - start);
	assert_int_equal(number(fdinfo(), "drm-engine-capacity-render:\t"), 1);
}

/* Whether the time of a job that hangs, and what it uses, were seen before it had ended. */
static bool fdinfo_moves(uint64_t *last)
{
	uint64_t first = number(fdinfo(), "drm-engine-render:\t"), active;
	bool runs;

	assert_int_equal(client_queue(&client, 0), 0);
	active = number(fdinfo(), "drm-active-board:\t");
	do {
		*last = number(fdinfo(), "drm-engine-render:\t");
		runs = node_fence_error(client.fd, client.queued[0]) == -EBUSY;
	} while (runs && *last <= first);
	assert_int_equal(client_queue_wait(&client, 0), -EIO);
	if (runs)
		assert_int_not_equal(active, 0);
	return runs;
}

/* A busy machine may sleep through it. What was seen is not lost at the job's end. */
static void fdinfo_moves_while_a_job_runs(void **state)
{
	volatile uint32_t *window = vm_faults("GLOSS_PCI_MODEL");
	bool moves = false;
	uint64_t last = 0;

	(void)state;
	vm_expect("hung the board");
	for (int i = 0; i < 10 && !moves; i++) {
		window[VBOARD_FAULT_HANG / 4] = 1;
		moves = fdinfo_moves(&last);
	}
	window[VBOARD_FAULT_HANG / 4] = 0;
	vm_expect_end();
	assert_true(moves);
	assert_in_range(number(fdinfo(), "drm-engine-render:\t"), last, UINT64_MAX);
	assert_int_equal(number(fdinfo(), "drm-active-board:\t"), 0);
}

/* The parser of IGT's tools, gputop among them, if it is installed. */
static void igts_parser_reads_fdinfo(void **state)
{
	enum { KEYS = 4 }; /* driver, device, client, engine with its capacity */
	static char info[1 << 16];
	unsigned int (*parse)(int fd, void *info, const char **engines, unsigned int engine_count,
			      const char **regions, unsigned int region_count);
	void *igt = dlopen("libigt.so.0", RTLD_LAZY);

	(void)state;
	if (!igt) {
		print_message("no libigt.so.0; install intel-gpu-tools (make deps)\n");
		skip();
	}
	*(void **)&parse = dlsym(igt, "igt_parse_drm_fdinfo");
	assert_non_null(parse);
	assert_in_range(parse(client.fd, info, NULL, 0, NULL, 0), KEYS, 64);
	assert_string_equal(info, "gloss");
}

/* ---- tracepoints ---- */

static void a_jobs_life_can_be_traced(void **state)
{
	static const char *const events[] = {
		"gloss_submit: ",
		"gloss_run: ",
		"gloss_done: ",
		"gloss_fault: ",
	};
	static char text[1 << 16];
	char name[64];
	const char *at = text;

	(void)state;
	snprintf(name, sizeof(name), " client=%llu ",
		 (unsigned long long)number(fdinfo(), "drm-client-id:\t"));
	assert_int_equal(vm_write_file(TRACING "/trace", "\n"), 0);
	assert_int_equal(vm_write_file(TRACING "/events/gloss/enable", "1"), 0);
	run_faulty_job();
	assert_int_equal(vm_write_file(TRACING "/events/gloss/enable", "0"), 0);
	read_text(TRACING "/trace", text, sizeof(text));
	for (size_t i = 0; i < sizeof(events) / sizeof(events[0]); i++)
		assert_says(text, events[i]);
	for (int lines = 0; (at = strstr(at, name)); at++)
		assert_in_range(++lines, 1, 8);
	assert_says(text, "error=0 cause=1 offset=1 ");
}

/* ---- set up ---- */

static int open_file(void **state)
{
	(void)state;
	pci = vm_env("GLOSS_PCI_MODEL");
	if (client_open(&client, vm_env("GLOSS_NODE_MODEL"), BOARD_BYTES))
		return -1;
	/* Its memory is cleared by a job of the driver's, before the first that uses it. */
	return client_works(&client) ? 0 : -1;
}

static int close_file(void **state)
{
	(void)state;
	client_close(&client);
	return 0;
}

#define inspect_test(name) cmocka_unit_test_setup_teardown(name, open_file, close_file)

int main(void)
{
	const struct CMUnitTest tests[] = {
		inspect_test(the_ring_counts_jobs),
		inspect_test(the_ring_shows_who_runs),
		inspect_test(the_last_fault_is_told_in_names),
		inspect_test(registers_and_counters_are_shown),
		inspect_test(board_memory_is_shown),
		inspect_test(fdinfo_names_driver_and_board),
		inspect_test(fdinfo_counts_memory),
		inspect_test(fdinfo_counts_pages_that_are_there),
		inspect_test(fdinfo_counts_what_other_files_share),
		inspect_test(fdinfo_counts_engine_time),
		inspect_test(fdinfo_moves_while_a_job_runs),
		inspect_test(igts_parser_reads_fdinfo),
		inspect_test(a_jobs_life_can_be_traced),
	};

	return cmocka_run_group_tests(tests, open_file, NULL);
}
