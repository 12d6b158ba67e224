// SPDX-License-Identifier: MIT
/*
 * Files and processes go away in the middle of a job: nobody else's jobs suffer, memory is clear
 * before it is another's, and the module stays until all that is its own has gone. As root.
 */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/syscall.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "vboard/pci/faults.h"
#include "vm_pair.h"
#include "vm_test.h"
#include "vm_victim.h"

static bool queue_jobs(uint32_t *told)
{
	struct client victim;

	(void)told;
	if (client_open(&victim, pair_node, PAIR_BOARD_BYTES))
		return false;
	for (uint32_t n = 0; n < CLIENT_QUEUE; n++)
		if (client_queue(&victim, n))
			return false;
	return true;
}

static void a_killed_process_takes_nobody_with_it(void **state)
{
	(void)state;
	for (int n = 0; n < 3; n++) {
		pid_t victim;

		pair_arm(VBOARD_FAULT_SLOW, 50000);
		victim = victim_start(queue_jobs, NULL);
		pair_queue(&client);
		victim_kill(victim);
		pair_arm(VBOARD_FAULT_SLOW, 0);
		pair_ends_well(&client);
	}
}

/* The memory of a job under way is not given to the next who asks. */
static void memory_of_a_killed_process_is_clear(void **state)
{
	(void)state;
	for (int n = 0; n < 3; n++) {
		struct client next;

		pair_arm(VBOARD_FAULT_SLOW, 20000);
		victim_kill(victim_start(queue_jobs, NULL));
		assert_int_equal(client_open(&next, pair_node, PAIR_BOARD_BYTES), 0);
		assert_int_equal(client_run(&next,
					    node_read(next.stream, 0, 0, PAIR_BOARD_BYTES / 4),
					    PAIR_BOARD_BYTES / 4),
				 0);
		for (uint32_t i = 0; i < PAIR_BOARD_BYTES / 4; i++)
			assert_int_equal(next.response[i], 0);
		client_close(&next);
	}
}

/* A syncobj that another file holds tells what became of a job whose file was closed. */
static void jobs_of_a_closed_file_end(void **state)
{
	uint32_t last;
	int file, err;

	(void)state;
	pair_arm(VBOARD_FAULT_SLOW, 50000);
	pair_queue(&client);
	assert_int_equal(drmSyncobjHandleToFD(client.fd, client.queued[CLIENT_QUEUE - 1], &file),
			 0);
	assert_int_equal(drmSyncobjFDToHandle(other.fd, file, &last), 0);
	close(file);
	client_close(&client);
	assert_int_equal(node_wait(other.fd, last, 0, vm_patience_ms()), 0);
	err = node_fence_error(other.fd, last);
	assert_true(err == 0 || err == -ECANCELED);
	pair_arm(VBOARD_FAULT_SLOW, 0);
	assert_true(client_works(&other));
}

static void the_module_stays_while_files_are_open(void **state)
{
	(void)state;
	assert_int_equal(syscall(SYS_delete_module, "gloss", O_NONBLOCK), -1);
	assert_in_set(errno, ((unsigned long[]){ EWOULDBLOCK, EBUSY }), 2);
	assert_true(client_works(&client));
}

/* Its fence is the scheduler's, which holds the driver's. */
static void the_module_stays_while_a_sync_file_is_open(void **state)
{
	int file;

	(void)state;
	assert_int_equal(client_queue(&client, 0), 0);
	assert_int_equal(client_queue_wait(&client, 0), 0);
	assert_int_equal(drmSyncobjExportSyncFile(client.fd, client.queued[0], &file), 0);
	client_close(&client);
	client_close(&other);
	/* Until all else that they had is gone. */
	sleep(1);
	assert_int_equal(syscall(SYS_delete_module, "gloss", O_NONBLOCK), -1);
	assert_in_set(errno, ((unsigned long[]){ EWOULDBLOCK, EBUSY }), 2);
	assert_int_equal(node_file_wait(file, 0), 0);
	close(file);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		pair_test(a_killed_process_takes_nobody_with_it),
		pair_test(memory_of_a_killed_process_is_clear),
		pair_test(jobs_of_a_closed_file_end),
		pair_test(the_module_stays_while_files_are_open),
		pair_test(the_module_stays_while_a_sync_file_is_open),
	};

	return cmocka_run_group_tests(tests, pair_setup, pair_teardown);
}
