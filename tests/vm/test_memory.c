// SPDX-License-Identifier: MIT
/*
 * Memory that programs share: nobody waits for another's pages, nobody gets all of the board's
 * memory or of the machine's, and what is given back is there for the next.
 */
#define _GNU_SOURCE
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <sys/wait.h>

#include <cmocka.h>

#include "gloss_node.h"
#include "vm_test.h"

#define MIB (1ull << 20)
#define OBJECT (4 * MIB)

static struct client client;

/* Makes a host object and has an empty job use it, which pins it. */
static int pin(struct client *by, uint64_t size, uint32_t *handle)
{
	struct client_job job;
	int err = node_create(by->fd, DRM_GLOSS_GEM_HOST, size, handle);

	if (err)
		return err;
	client_prepare(by, &job, 0, 1);
	job.submit.response = *handle;
	job.submit.response_offset = 0;
	err = client_submit(by, &job);
	if (err)
		node_destroy(by->fd, *handle);
	return err;
}

static uint64_t machine_bytes(void)
{
	struct sysinfo info;

	assert_int_equal(sysinfo(&info), 0);
	return (uint64_t)info.totalram * info.mem_unit;
}

/* ---- nobody waits for another's pages ---- */

enum { PIN_BYTES = 64 << 20, PINNERS = 2, SUBMITS = 100 };

__attribute__((noreturn)) static void pin_for_ever(volatile uint32_t *rounds)
{
	struct client own;
	uint32_t handle;

	if (client_open(&own, vm_env("GLOSS_NODE_MODEL"), 0))
		_exit(1);
	for (;;) {
		int err = pin(&own, PIN_BYTES, &handle);

		/* The last one's job may not have ended yet. */
		if (err && err != -ENOMEM)
			_exit(1);
		if (err)
			continue;
		++*rounds;
		node_destroy(own.fd, handle);
	}
}

static long times_slept(void)
{
	struct rusage usage;

	assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
	return usage.ru_nvcsw;
}

static double now_us(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec * 1e6 + (double)now.tv_nsec / 1e3;
}

static int compare(const void *a, const void *b)
{
	const double *left = a, *right = b;

	return (*left > *right) - (*left < *right);
}

/* Submits an empty job and waits for it; how long the former took, and how often it slept. */
static double submit_us(long *slept)
{
	struct client_job job;
	long before;
	double start;

	client_prepare(&client, &job, 0, 0);
	before = times_slept();
	start = now_us();
	assert_int_equal(client_submit(&client, &job), 0);
	start = now_us() - start;
	*slept += times_slept() - before;
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	return start;
}

static double median_submit_us(void)
{
	double us[SUBMITS];
	long slept = 0;

	for (int i = 0; i < SUBMITS; i++)
		us[i] = submit_us(&slept);
	qsort(us, SUBMITS, sizeof(us[0]), compare);
	return us[SUBMITS / 2];
}

/*
 * A count, and no time: whoever waits for a lock goes to sleep, whoever waits for a processor
 * does not.
 */
static void a_submit_waits_for_nobodys_pages(void **state)
{
	volatile uint32_t *rounds = mmap(NULL, NODE_PAGE, PROT_READ | PROT_WRITE,
					 MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	pid_t pinner[PINNERS];
	double alone = median_submit_us();
	uint32_t submits = 0;
	long slept = 0;

	(void)state;
	assert_ptr_not_equal(rounds, MAP_FAILED);
	for (int i = 0; i < PINNERS; i++) {
		pinner[i] = fork();
		assert_int_not_equal(pinner[i], -1);
		if (!pinner[i])
			pin_for_ever(rounds + i);
	}
	while (submits < SUBMITS || rounds[0] < 3 || rounds[1] < 3) {
		submit_us(&slept);
		submits++;
		usleep(1000);
	}
	print_message("a submit takes %.1f times as long as alone\n", median_submit_us() / alone);
	for (int i = 0; i < PINNERS; i++) {
		assert_int_equal(kill(pinner[i], SIGKILL), 0);
		assert_int_equal(waitpid(pinner[i], NULL, 0), pinner[i]);
	}
	print_message("%u submits slept %ld times, beside %u and %u pins of 64 MiB\n", submits,
		      slept, rounds[0], rounds[1]);
	assert_true(slept <= submits / 10);
	munmap((void *)(uintptr_t)rounds, NODE_PAGE);
}

/* ---- the machine's memory ---- */

/* Pins as much as a file gets; in bytes. */
static uint64_t pin_all(struct client *by)
{
	uint64_t bytes = 0;
	uint32_t handle;
	int err;

	while (!(err = pin(by, OBJECT, &handle)))
		bytes += OBJECT;
	assert_int_equal(err, -ENOMEM);
	if (bytes)
		assert_int_equal(client_wait(by, vm_patience_ms()), 0);
	return bytes;
}

/* Without the bound the OOM killer would end somebody: its message alone fails this. */
static void files_together_pin_half_of_the_machine(void **state)
{
	uint64_t bytes[4], sum = 0;
	struct client file[4];

	(void)state;
	for (int i = 0; i < 4; i++) {
		assert_int_equal(client_open(&file[i], vm_env("GLOSS_NODE_MODEL"), 0), 0);
		bytes[i] = pin_all(&file[i]);
		sum += bytes[i];
		print_message("file %d pinned %llu MiB\n", i, (unsigned long long)(bytes[i] / MIB));
	}
	assert_in_range(sum, machine_bytes() * 2 / 5, machine_bytes() / 2);
	assert_in_range(bytes[0], machine_bytes() / 3, machine_bytes() * 9 / 20);
	assert_in_range(bytes[1], OBJECT, bytes[0]);
	for (int i = 0; i < 4; i++) {
		assert_true(client_works(&file[i]));
		client_close(&file[i]);
	}
}

/* Jobs that have ended are freed a moment later, and only then their pages. */
static void what_is_closed_can_be_pinned_again(void **state)
{
	uint64_t first = 0, again;

	(void)state;
	for (int round = 0; round < 3; round++) {
		struct client file;
		int waited = 0;

		do {
			assert_int_equal(client_open(&file, vm_env("GLOSS_NODE_MODEL"), 0), 0);
			again = pin_all(&file);
			client_close(&file);
			assert_in_range(waited++, 0, 100);
		} while (again < first);
		first = again;
	}
}

static uint64_t own_shared_bytes(void)
{
	char line[128];
	unsigned long long kib = 0;
	FILE *file = fopen("/proc/self/status", "r");

	assert_non_null(file);
	while (fgets(line, sizeof(line), file))
		if (sscanf(line, "RssShmem: %llu", &kib) == 1)
			break;
	fclose(file);
	return kib * 1024;
}

/* So the OOM killer sees who has them. */
static void mapped_pages_count_in_the_process(void **state)
{
	struct node_buffer buffer;
	uint64_t before = own_shared_bytes();

	(void)state;
	assert_int_equal(node_buffer_new(client.fd, 4 * OBJECT, &buffer), 0);
	assert_in_range(own_shared_bytes(), 0, before + OBJECT);
	memset(buffer.map, 1, 4 * OBJECT);
	/* The kernel counts some pages late. */
	assert_in_range(own_shared_bytes(), before + 3 * OBJECT, before + 5 * OBJECT);
	node_buffer_free(client.fd, &buffer);
	assert_in_range(own_shared_bytes(), 0, before + OBJECT);
}

static void what_a_program_maps_outlives_its_handle(void **state)
{
	struct node_buffer buffer;
	uint32_t other;

	(void)state;
	assert_int_equal(node_buffer_new(client.fd, NODE_PAGE, &buffer), 0);
	memset(buffer.map, 0x5a, NODE_PAGE);
	assert_int_equal(node_destroy(client.fd, buffer.handle), 0);
	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_HOST, NODE_PAGE, &other), 0);
	for (uint32_t i = 0; i < NODE_PAGE; i++)
		assert_int_equal(((uint8_t *)buffer.map)[i], 0x5a);
	munmap(buffer.map, NODE_PAGE);
	assert_int_equal(node_destroy(client.fd, other), 0);
}

static void maps_are_shared_and_do_not_grow(void **state)
{
	struct node_buffer buffer;
	uint64_t offset;

	(void)state;
	assert_int_equal(node_buffer_new(client.fd, 2 * NODE_PAGE, &buffer), 0);
	assert_int_equal(node_mmap_offset(client.fd, buffer.handle, &offset), 0);
	assert_ptr_equal(mmap(NULL, NODE_PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE, client.fd,
			      (off_t)offset),
			 MAP_FAILED);
	assert_ptr_equal(mremap(buffer.map, 2 * NODE_PAGE, 4 * NODE_PAGE, MREMAP_MAYMOVE),
			 MAP_FAILED);
	node_buffer_free(client.fd, &buffer);
}

/* ---- the board's memory ---- */

static uint64_t take_board_memory(int fd, uint64_t chunk)
{
	uint64_t bytes = 0;
	uint32_t handle;
	int err;

	while (!(err = node_create(fd, DRM_GLOSS_GEM_BOARD, chunk, &handle)))
		bytes += chunk;
	assert_int_equal(err, -ENOSPC);
	return bytes;
}

/* share_percent, as it is without being set, of what the others leave. */
static void no_file_gets_all_board_memory(void **state)
{
	uint64_t size, left, chunk;
	int fd[3];

	(void)state;
	assert_int_equal(node_param(client.fd, DRM_GLOSS_PARAM_MEMORY_SIZE, &size), 0);
	chunk = size / 256;
	left = size;
	for (int i = 0; i < 3; i++) {
		uint64_t had;

		fd[i] = node_open(vm_env("GLOSS_NODE_MODEL"));
		assert_in_range(fd[i], 0, 1024);
		had = take_board_memory(fd[i], chunk);
		print_message("file %d has %llu of %llu KiB\n", i, (unsigned long long)had / 1024,
			      (unsigned long long)left / 1024);
		assert_in_range(had, left * 85 / 100 - 2 * chunk, left * 85 / 100);
		left -= had;
	}
	for (int i = 0; i < 3; i++)
		close(fd[i]);
	fd[0] = node_open(vm_env("GLOSS_NODE_MODEL"));
	assert_in_range(take_board_memory(fd[0], chunk), size * 85 / 100 - 2 * chunk, size);
	close(fd[0]);
}

/* ---- set up ---- */

static int open_file(void **state)
{
	(void)state;
	return client_open(&client, vm_env("GLOSS_NODE_MODEL"), 0);
}

static int close_file(void **state)
{
	(void)state;
	client_close(&client);
	return 0;
}

#define memory_test(name) cmocka_unit_test_setup_teardown(name, open_file, close_file)

int main(void)
{
	const struct CMUnitTest tests[] = {
		memory_test(a_submit_waits_for_nobodys_pages),
		memory_test(files_together_pin_half_of_the_machine),
		memory_test(what_is_closed_can_be_pinned_again),
		memory_test(mapped_pages_count_in_the_process),
		memory_test(what_a_program_maps_outlives_its_handle),
		memory_test(maps_are_shared_and_do_not_grow),
		memory_test(no_file_gets_all_board_memory),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
