// SPDX-License-Identifier: MIT
/*
 * A board sleeps, is reset, loses power or has no MSI while jobs are queued: all of them end well.
 * As root.
 */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "vboard/pci/faults.h"
#include "vm_pair.h"
#include "vm_test.h"

static void sleep_and_wake(bool without_power)
{
	char parameters[64];

	snprintf(parameters, sizeof(parameters), "device=%.32s", strrchr(pair_pci, '/') + 1);
	assert_int_equal(board_load("gloss_sleep", parameters), 0);
	if (without_power) {
		pair_arm(VBOARD_FAULT_DIE, VBOARD_FAULT_DIE_NOW);
		pair_arm(VBOARD_FAULT_DIE, 0);
	}
	assert_int_equal(board_unload("gloss_sleep"), 0);
}

static void reset_with_jobs_queued(const char *how)
{
	uint64_t lost;
	char parameters[64];

	snprintf(parameters, sizeof(parameters), "device=%.32s error=%s",
		 strrchr(pair_pci, '/') + 1, how);
	pair_arm(VBOARD_FAULT_SLOW, 10000);
	pair_queue(&client);
	assert_int_equal(board_load("gloss_reset", parameters), 0);
	/* What stops it: nothing of the board's may be asked for meanwhile. */
	pair_queue(&other);
	assert_int_equal(board_unload("gloss_reset"), 0);
	pair_ends_well(&client);
	pair_ends_well(&other);
	assert_true(client_works(&client));
	assert_int_equal(node_param(client.fd, DRM_GLOSS_PARAM_JOBS_LOST, &lost), 0);
	assert_int_not_equal(lost, 0);
}

static void a_reset_of_the_function_loses_no_job(void **state)
{
	(void)state;
	reset_with_jobs_queued("0");
}

static void an_error_of_the_bus_loses_no_job(void **state)
{
	(void)state;
	reset_with_jobs_queued("1");
}

static void a_board_sleeps_with_jobs_queued(void **state)
{
	(void)state;
	for (int n = 0; n < 3; n++) {
		pair_arm(VBOARD_FAULT_SLOW, 10000);
		pair_queue(&client);
		pair_queue(&other);
		sleep_and_wake(false);
		pair_ends_well(&client);
		pair_ends_well(&other);
		assert_true(client_works(&client));
	}
}

/* It comes back as if it had just been put in, and has forgotten what was in its memory. */
static void a_board_without_power_meanwhile_wakes_up(void **state)
{
	(void)state;
	pair_queue(&client);
	pair_queue(&other);
	sleep_and_wake(true);
	pair_ends_well(&client);
	pair_ends_well(&other);
	assert_true(client_works(&client));
	assert_int_equal(client_run(&other, node_read(other.stream, 0, NODE_PAGE, 1), 1), 0);
	assert_int_equal(other.response[0], 0);
}

static long module_users(void)
{
	char text[32] = "";
	int fd = open("/sys/module/gloss/refcnt", O_RDONLY | O_CLOEXEC);

	assert_in_range(fd, 0, 1 << 20);
	assert_in_range(read(fd, text, sizeof(text) - 1), 1, sizeof(text) - 1);
	close(fd);
	return strtol(text, NULL, 10);
}

/* The driver's own jobs, which clear memory after a sleep, hold it no longer than they take. */
static void after_a_sleep_nothing_holds_the_module(void **state)
{
	(void)state;
	sleep_and_wake(false);
	assert_true(client_works(&client));
	assert_int_not_equal(module_users(), 0);
	client_close(&client);
	client_close(&other);
	for (int ms = 0; module_users(); ms += 10) {
		assert_in_range(ms, 0, vm_patience_ms());
		usleep(10 * 1000);
	}
}

static void bind_with_msi(const char *allowed)
{
	client_close(&client);
	client_close(&other);
	assert_int_equal(board_unbind(pair_pci), 0);
	assert_int_equal(board_write(pair_pci, "msi_bus", allowed), 0);
	assert_int_equal(board_bind(pair_pci, "gloss"), 0);
	assert_int_equal(board_node(pair_pci, vm_patience_ms(), pair_node), 0);
	assert_int_equal(client_open(&client, pair_node, PAIR_BOARD_BYTES), 0);
	assert_int_equal(client_open(&other, pair_node, PAIR_BOARD_BYTES), 0);
}

static bool has_msi(void)
{
	char path[256];

	snprintf(path, sizeof(path), "%s/msi_irqs", pair_pci);
	return !access(path, F_OK);
}

static void jobs_end_without_msi(void **state)
{
	(void)state;
	assert_true(has_msi());
	bind_with_msi("0");
	assert_false(has_msi());
	for (int n = 0; n < 20; n++) {
		pair_queue(&client);
		pair_queue(&other);
		pair_ends_well(&client);
		pair_ends_well(&other);
	}
	vm_expect("gloss ");
	pair_arm(VBOARD_FAULT_LOSE_INTERRUPTS, 1);
	assert_true(client_works(&client));
	pair_arm(VBOARD_FAULT_HANG, 1);
	assert_int_equal(client_run(&client, 0, 0), -EIO);
	vm_expect_end();
	assert_true(client_works(&other));
	bind_with_msi("1");
	assert_true(has_msi());
	assert_true(client_works(&client));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		pair_test(jobs_end_without_msi),
		pair_test(a_board_sleeps_with_jobs_queued),
		pair_test(a_reset_of_the_function_loses_no_job),
		pair_test(an_error_of_the_bus_loses_no_job),
		pair_test(a_board_without_power_meanwhile_wakes_up),
		pair_test(after_a_sleep_nothing_holds_the_module),
	};

	return cmocka_run_group_tests(tests, pair_setup, pair_teardown);
}
