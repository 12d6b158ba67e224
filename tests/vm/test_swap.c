// SPDX-License-Identifier: MIT
/*
 * Pages that no job uses are given back when memory is short, if they can be swapped out, and
 * come back with what was in them. As root: it makes swap space of a zram device.
 */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/swap.h>
#include <unistd.h>

#include <cmocka.h>

#include "gloss_node.h"
#include "vm_board.h"
#include "vm_test.h"

enum { OBJECTS = 8, OBJECT_PAGES = 1024 };

static struct client client;
static struct node_buffer buffer[OBJECTS];
static uint32_t words; /* of the stream in each page */

static uint64_t idle_pages(void)
{
	char path[128], line[256];
	unsigned long long idle = ~0ull;
	const char *at;
	FILE *file;

	snprintf(path, sizeof(path), "/sys/kernel/debug/dri/%d/memory",
		 board_minor(vm_env("GLOSS_PCI_MODEL")));
	file = fopen(path, "r");
	assert_non_null(file);
	while (fgets(line, sizeof(line), file)) {
		at = strstr(line, "; idle ");
		if (!strncmp(line, "host: ", 6) && at)
			idle = strtoull(at + 7, NULL, 10);
	}
	fclose(file);
	assert_int_not_equal(idle, ~0ull);
	return idle;
}

/* A job has used it, and has ended, but a moment passes until it is idle. */
static void wait_until_idle(uint64_t pages)
{
	for (int ms = 0; idle_pages() < pages; ms += 10) {
		assert_in_range(ms, 0, vm_patience_ms());
		usleep(10 * 1000);
	}
}

/* A job that reads its stream from page @page of object @n, and tells what is in there. */
static uint32_t read_back(unsigned int n, uint32_t page)
{
	struct client_job job;

	client_prepare(&client, &job, words, 1);
	job.submit.stream = buffer[n].handle;
	job.submit.stream_offset = page * NODE_PAGE;
	client.response[0] = ~0u;
	assert_int_equal(client_submit(&client, &job), 0);
	assert_int_equal(client_wait(&client, vm_patience_ms()), 0);
	return client.response[0];
}

static uint32_t value_of(unsigned int n, uint32_t page)
{
	return 0x51000000 + n * OBJECT_PAGES + page;
}

static void fill(unsigned int n)
{
	for (uint32_t page = 0; page < OBJECT_PAGES; page++) {
		uint32_t *at = (uint32_t *)buffer[n].map + page * NODE_PAGE / 4;
		uint32_t value = value_of(n, page);

		words = node_write(at, 0, 0, &value, 1);
		words += node_read(at + words, 0, 0, 1);
	}
}

static void reclaim(void)
{
	assert_int_equal(vm_write_file("/proc/sys/vm/drop_caches", "2"), 0);
}

static void idle_pages_stay_where_they_can_not_be_swapped_out(void **state)
{
	(void)state;
	assert_int_equal(read_back(0, 0), value_of(0, 0));
	wait_until_idle(OBJECT_PAGES);
	reclaim();
	assert_in_range(idle_pages(), OBJECT_PAGES, UINT32_MAX);
}

/* False if the kernel has it built in. */
static bool load_zram(void)
{
	if (!access("/sys/block/zram0", F_OK))
		return false;
	if (system("modprobe zram num_devices=1 2>/dev/null"))
		vm_skip("zram: the kernel has no such module");
	return true;
}

static void make_swap_space(void)
{
	if (vm_write_file("/sys/block/zram0/disksize", "67108864"))
		vm_fail("zram takes no size: %s", strerror(errno));
	if (system("mkswap /dev/zram0 >/dev/null") || swapon("/dev/zram0", 0))
		vm_fail("swap on zram: %s", strerror(errno));
}

static void end_swap_space(void)
{
	assert_int_equal(swapoff("/dev/zram0"), 0);
	assert_int_equal(vm_write_file("/sys/block/zram0/reset", "1"), 0);
}

static void idle_pages_are_given_back_with_swap_space(void **state)
{
	bool loaded = load_zram();

	(void)state;
	make_swap_space();
	for (unsigned int n = 0; n < OBJECTS; n++)
		assert_int_equal(read_back(n, n), value_of(n, n));
	wait_until_idle(OBJECTS * OBJECT_PAGES);
	reclaim();
	assert_in_range(idle_pages(), 0, OBJECT_PAGES);
	for (unsigned int n = 0; n < OBJECTS; n++)
		assert_int_equal(read_back(n, OBJECT_PAGES - 1 - n),
				 value_of(n, OBJECT_PAGES - 1 - n));
	end_swap_space();
	if (loaded)
		assert_int_equal(system("rmmod zram"), 0);
}

static int open_file(void **state)
{
	(void)state;
	if (client_open(&client, vm_env("GLOSS_NODE_MODEL"), NODE_PAGE))
		return -1;
	for (unsigned int n = 0; n < OBJECTS; n++) {
		if (node_buffer_new(client.fd, OBJECT_PAGES * NODE_PAGE, &buffer[n]))
			return -1;
		fill(n);
	}
	return 0;
}

static int close_file(void **state)
{
	(void)state;
	for (unsigned int n = 0; n < OBJECTS; n++)
		node_buffer_free(client.fd, &buffer[n]);
	client_close(&client);
	return 0;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(idle_pages_stay_where_they_can_not_be_swapped_out),
		cmocka_unit_test(idle_pages_are_given_back_with_swap_space),
	};

	return cmocka_run_group_tests(tests, open_file, close_file);
}
