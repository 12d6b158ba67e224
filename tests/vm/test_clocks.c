// SPDX-License-Identifier: MIT
/* What the board counts is told to the file whose jobs it was, and to nobody else. */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "accel.h"
#include "gloss_node.h"
#include "vm_test.h"

#define BOARD_BYTES (4 * NODE_PAGE)

static struct client client, other;

static int clocks_of(const struct client *of, struct drm_gloss_get_clocks *clocks)
{
	*clocks = (struct drm_gloss_get_clocks){ 0 };
	return node_ioctl(of->fd, DRM_IOCTL_GLOSS_GET_CLOCKS, clocks);
}

static void a_file_is_told_of_its_own_jobs(void **state)
{
	struct drm_gloss_get_clocks before, after, idle, others;

	(void)state;
	assert_int_equal(clocks_of(&client, &before), 0);
	assert_int_equal(clocks_of(&other, &others), 0);
	for (int i = 0; i < 4; i++)
		assert_true(client_works(&client));
	assert_int_equal(clocks_of(&client, &after), 0);
	assert_true(after.clocks > before.clocks);
	assert_true(after.stall_memory - before.stall_memory <= after.clocks - before.clocks);
	assert_int_equal(clocks_of(&client, &idle), 0);
	assert_memory_equal(&idle, &after, sizeof(idle));
	assert_int_equal(clocks_of(&other, &idle), 0);
	assert_memory_equal(&idle, &others, sizeof(idle));
}

/* A job waited for is a job of one file among the board's, so none is counted twice or lost. */
static void files_in_turns_are_told_apart(void **state)
{
	struct drm_gloss_get_clocks first[2], last[2];
	struct client *file[2] = { &client, &other };

	(void)state;
	for (int i = 0; i < 2; i++)
		assert_int_equal(clocks_of(file[i], &first[i]), 0);
	/* The other's jobs are empty ones: they cost next to nothing. */
	for (int i = 0; i < 8; i++) {
		assert_true(client_works(&client));
		assert_int_equal(client_run(&other, 0, 0), 0);
	}
	for (int i = 0; i < 2; i++)
		assert_int_equal(clocks_of(file[i], &last[i]), 0);
	assert_true(last[0].clocks - first[0].clocks > last[1].clocks - first[1].clocks);
}

static void a_board_without_a_clock_says_so(void **state)
{
	struct drm_gloss_get_clocks clocks;
	struct client model;

	(void)state;
	assert_int_equal(client_open(&model, vm_env("GLOSS_NODE_MODEL"), BOARD_BYTES), 0);
	assert_true(client_works(&model));
	assert_int_equal(clocks_of(&model, &clocks), -EOPNOTSUPP);
	client_close(&model);
}

static void the_library_tells_clocks_of_a_board_on_pci(void **state)
{
	uint32_t word = 7;
	struct accel_device_clocks before, after;
	struct accel_device *device;
	struct accel_buffer *buffer;
	char name[512];

	(void)state;
	snprintf(name, sizeof(name), "drm:%s", vm_env("GLOSS_NODE_RTL"));
	assert_int_equal(accel_device_new(name, NULL, NULL, &device), 0);
	assert_int_equal(accel_buffer_new(device, NODE_PAGE, &buffer), 0);
	assert_int_equal(accel_device_clocks(device, &before, sizeof(before)), 0);
	assert_int_equal(accel_buffer_write(buffer, 0, &word, sizeof(word)), 0);
	assert_int_equal(accel_buffer_read(buffer, 0, &word, sizeof(word)), 0);
	assert_int_equal(accel_device_clocks(device, &after, sizeof(after)), 0);
	assert_true(after.clocks > before.clocks);
	accel_buffer_free(buffer);
	accel_device_free(device);
}

static int open_files(void **state)
{
	(void)state;
	if (client_open(&client, vm_env("GLOSS_NODE_RTL"), BOARD_BYTES) ||
	    client_open(&other, vm_env("GLOSS_NODE_RTL"), 0))
		return -1;
	/* Clearing is the driver's own, and over when a job has used the memory. */
	return client_works(&client) ? 0 : -1;
}

static int close_files(void **state)
{
	(void)state;
	client_close(&client);
	client_close(&other);
	return 0;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_file_is_told_of_its_own_jobs),
		cmocka_unit_test(files_in_turns_are_told_apart),
		cmocka_unit_test(a_board_without_a_clock_says_so),
		cmocka_unit_test(the_library_tells_clocks_of_a_board_on_pci),
	};

	return cmocka_run_group_tests(tests, open_files, close_files);
}
