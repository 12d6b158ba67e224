// SPDX-License-Identifier: MIT
/*
 * Boards, files and processes that go away in the middle of a job: every fence signals,
 * nobody waits for ever, and what is left goes on. As root.
 */
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/syscall.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "vboard/pci/faults.h"
#include "gloss_node.h"
#include "vm_board.h"
#include "vm_test.h"
#include "vm_victim.h"

#define BOARD_BYTES (4 * NODE_PAGE)

static const char *pci;
static char node[BOARD_PATH];
static struct client client, other;
static volatile uint32_t *window;

static void arm(uint32_t fault, uint32_t value)
{
	window[fault / 4] = value;
}

static void queue_all(struct client *of)
{
	for (uint32_t n = 0; n < CLIENT_QUEUE; n++)
		assert_int_equal(client_queue(of, n), 0);
}

/* The fences of a file's queued jobs, as files of their own: the board may go before they end. */
struct fences {
	int file[CLIENT_QUEUE];
};

static struct fences queue_fences(struct client *of)
{
	struct fences fences;

	queue_all(of);
	for (uint32_t n = 0; n < CLIENT_QUEUE; n++)
		assert_int_equal(drmSyncobjExportSyncFile(of->fd, of->queued[n], &fences.file[n]),
				 0);
	return fences;
}

/* All end with 0, or from some job on all with @error. The number of the latter. */
static int count_from(const struct fences *fences, int error)
{
	int failed = 0;

	for (uint32_t n = 0; n < CLIENT_QUEUE; n++) {
		int err = node_file_wait(fences->file[n], vm_patience_ms());

		assert_int_equal(err, failed || err ? error : 0);
		failed += err != 0;
		close(fences->file[n]);
	}
	return failed;
}

/* For boards that stay: what the jobs did is looked at too. */
static void all_end_well(struct client *of)
{
	for (uint32_t n = 0; n < CLIENT_QUEUE; n++)
		assert_int_equal(client_queue_wait(of, n), 0);
}

/* ---- a board that goes ---- */

static void find_board_again(void)
{
	assert_int_equal(board_rescan(), 0);
	assert_int_equal(board_node(pci, vm_patience_ms(), node), 0);
	window = vm_faults("GLOSS_PCI_MODEL");
	assert_int_equal(window[VBOARD_FAULT_IDENTITY / 4], VBOARD_FAULT_IDENTITY_VALUE);
}

/* What files of a board that has gone are told, whatever they ask. */
static void everything_is_enodev(struct client *of)
{
	struct client_job job;
	uint32_t handle;
	uint64_t value;

	client_prepare(of, &job, 0, 0);
	assert_int_equal(client_submit(of, &job), -ENODEV);
	assert_int_equal(node_create(of->fd, DRM_GLOSS_GEM_HOST, 1, &handle), -ENODEV);
	assert_int_equal(node_param(of->fd, DRM_GLOSS_PARAM_VERSION, &value), -ENODEV);
}

static void a_dead_board_fails_its_jobs(void **state)
{
	struct fences mine, others;
	struct client_job job;

	(void)state;
	vm_expect("gloss |pci");
	arm(VBOARD_FAULT_DIE, 3);
	mine = queue_fences(&client);
	others = queue_fences(&other);
	assert_in_range(count_from(&mine, -ENODEV) + count_from(&others, -ENODEV), 1,
			2 * CLIENT_QUEUE - 2);
	client_prepare(&client, &job, 0, 0);
	assert_int_equal(client_submit(&client, &job), -ENODEV);
	client_close(&other);
	arm(VBOARD_FAULT_DIE, 0);
	assert_int_equal(board_remove(pci), 0);
	everything_is_enodev(&client);
	find_board_again();
	vm_expect_end();
}

static void a_board_that_dies_idle_is_noticed(void **state)
{
	struct client_job job;
	int err;

	(void)state;
	vm_expect("gloss |pci");
	arm(VBOARD_FAULT_DIE, VBOARD_FAULT_DIE_NOW);
	client_prepare(&client, &job, 0, 0);
	err = client_submit(&client, &job);
	if (!err)
		err = client_wait(&client, vm_patience_ms());
	assert_int_equal(err, -ENODEV);
	assert_int_equal(client_submit(&client, &job), -ENODEV);
	arm(VBOARD_FAULT_DIE, 0);
	assert_int_equal(board_remove(pci), 0);
	find_board_again();
	vm_expect_end();
}

/* The other board is none of its business. */
static void the_other_board_works(void)
{
	struct client rtl;

	assert_int_equal(client_open(&rtl, vm_env("GLOSS_NODE_RTL"), NODE_PAGE), 0);
	assert_true(client_works(&rtl));
	client_close(&rtl);
}

static void a_board_is_removed_under_its_jobs(void **state)
{
	struct fences mine, others;

	(void)state;
	vm_expect("gloss |pci");
	arm(VBOARD_FAULT_SLOW, 400000);
	mine = queue_fences(&client);
	others = queue_fences(&other);
	assert_int_equal(client_queue_wait(&client, 0), 0);
	assert_int_equal(board_remove(pci), 0);
	assert_in_range(count_from(&mine, -ENODEV), 1, CLIENT_QUEUE - 1);
	assert_in_range(count_from(&others, -ENODEV), 1, CLIENT_QUEUE);
	everything_is_enodev(&client);
	the_other_board_works();
	find_board_again();
	arm(VBOARD_FAULT_SLOW, 0);
	vm_expect_end();
	/* Files of the board that went stay what they are. */
	everything_is_enodev(&other);
}

static jmp_buf no_memory;

static void on_sigbus(int number)
{
	(void)number;
	siglongjmp(no_memory, 1);
}

/* Memory of a host object stays, or is refused by a signal; it is not someone else's. */
static void maps_outlive_their_board(void **state)
{
	const struct sigaction action = { .sa_handler = on_sigbus };
	volatile uint32_t *word = client.stream;

	(void)state;
	*word = 0x0dd;
	assert_int_equal(board_remove(pci), 0);
	sigaction(SIGBUS, &action, NULL);
	if (!sigsetjmp(no_memory, 1)) {
		assert_int_equal(*word, 0x0dd);
		*word = 0x0de;
	}
	signal(SIGBUS, SIG_DFL);
	find_board_again();
}

static void a_driver_is_taken_off_and_put_back(void **state)
{
	(void)state;
	for (int n = 0; n < 3; n++) {
		struct fences fences = queue_fences(&client);

		assert_int_equal(board_unbind(pci), 0);
		count_from(&fences, -ENODEV);
		client_close(&client);
		assert_int_equal(board_bind(pci, "gloss"), 0);
		assert_int_equal(board_node(pci, vm_patience_ms(), node), 0);
		assert_int_equal(client_open(&client, node, BOARD_BYTES), 0);
		assert_true(client_works(&client));
	}
}

/* ---- processes and files that go ---- */

static bool queue_jobs(uint32_t *told)
{
	struct client victim;

	(void)told;
	if (client_open(&victim, node, BOARD_BYTES))
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

		arm(VBOARD_FAULT_SLOW, 50000);
		victim = victim_start(queue_jobs, NULL);
		queue_all(&client);
		victim_kill(victim);
		arm(VBOARD_FAULT_SLOW, 0);
		all_end_well(&client);
	}
}

/* The memory of a job under way is not given to the next who asks. */
static void memory_of_a_killed_process_is_clear(void **state)
{
	(void)state;
	for (int n = 0; n < 3; n++) {
		struct client next;

		arm(VBOARD_FAULT_SLOW, 20000);
		victim_kill(victim_start(queue_jobs, NULL));
		assert_int_equal(client_open(&next, node, BOARD_BYTES), 0);
		assert_int_equal(client_run(&next, node_read(next.stream, 0, 0, BOARD_BYTES / 4),
					    BOARD_BYTES / 4),
				 0);
		for (uint32_t i = 0; i < BOARD_BYTES / 4; i++)
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
	arm(VBOARD_FAULT_SLOW, 50000);
	queue_all(&client);
	assert_int_equal(drmSyncobjHandleToFD(client.fd, client.queued[CLIENT_QUEUE - 1], &file),
			 0);
	assert_int_equal(drmSyncobjFDToHandle(other.fd, file, &last), 0);
	close(file);
	client_close(&client);
	assert_int_equal(node_wait(other.fd, last, 0, vm_patience_ms()), 0);
	err = node_fence_error(other.fd, last);
	assert_true(err == 0 || err == -ECANCELED);
	arm(VBOARD_FAULT_SLOW, 0);
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

/* ---- power and interrupts ---- */

static void sleep_and_wake(bool without_power)
{
	char parameters[64];

	snprintf(parameters, sizeof(parameters), "device=%.32s", strrchr(pci, '/') + 1);
	assert_int_equal(board_load("gloss_sleep", parameters), 0);
	if (without_power) {
		arm(VBOARD_FAULT_DIE, VBOARD_FAULT_DIE_NOW);
		arm(VBOARD_FAULT_DIE, 0);
	}
	assert_int_equal(board_unload("gloss_sleep"), 0);
}

static void reset_with_jobs_queued(const char *how)
{
	uint64_t lost;
	char parameters[64];

	snprintf(parameters, sizeof(parameters), "device=%.32s error=%s", strrchr(pci, '/') + 1,
		 how);
	arm(VBOARD_FAULT_SLOW, 10000);
	queue_all(&client);
	assert_int_equal(board_load("gloss_reset", parameters), 0);
	/* What stops it: nothing of the board's may be asked for meanwhile. */
	queue_all(&other);
	assert_int_equal(board_unload("gloss_reset"), 0);
	all_end_well(&client);
	all_end_well(&other);
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
		arm(VBOARD_FAULT_SLOW, 10000);
		queue_all(&client);
		queue_all(&other);
		sleep_and_wake(false);
		all_end_well(&client);
		all_end_well(&other);
		assert_true(client_works(&client));
	}
}

/* It comes back as if it had just been put in, and has forgotten what was in its memory. */
static void a_board_without_power_meanwhile_wakes_up(void **state)
{
	(void)state;
	queue_all(&client);
	queue_all(&other);
	sleep_and_wake(true);
	all_end_well(&client);
	all_end_well(&other);
	assert_true(client_works(&client));
	assert_int_equal(client_run(&other, node_read(other.stream, 0, NODE_PAGE, 1), 1), 0);
	assert_int_equal(other.response[0], 0);
}

static void bind_with_msi(const char *allowed)
{
	client_close(&client);
	client_close(&other);
	assert_int_equal(board_unbind(pci), 0);
	assert_int_equal(board_write(pci, "msi_bus", allowed), 0);
	assert_int_equal(board_bind(pci, "gloss"), 0);
	assert_int_equal(board_node(pci, vm_patience_ms(), node), 0);
	assert_int_equal(client_open(&client, node, BOARD_BYTES), 0);
	assert_int_equal(client_open(&other, node, BOARD_BYTES), 0);
}

static bool has_msi(void)
{
	char path[256];

	snprintf(path, sizeof(path), "%s/msi_irqs", pci);
	return !access(path, F_OK);
}

static void jobs_end_without_msi(void **state)
{
	(void)state;
	assert_true(has_msi());
	bind_with_msi("0");
	assert_false(has_msi());
	for (int n = 0; n < 20; n++) {
		queue_all(&client);
		queue_all(&other);
		all_end_well(&client);
		all_end_well(&other);
	}
	vm_expect("gloss ");
	arm(VBOARD_FAULT_LOSE_INTERRUPTS, 1);
	assert_true(client_works(&client));
	arm(VBOARD_FAULT_HANG, 1);
	assert_int_equal(client_run(&client, 0, 0), -EIO);
	vm_expect_end();
	assert_true(client_works(&other));
	bind_with_msi("1");
	assert_true(has_msi());
	assert_true(client_works(&client));
}

/* ---- set up ---- */

static int setup(void **state)
{
	(void)state;
	pci = vm_env("GLOSS_PCI_MODEL");
	window = vm_faults("GLOSS_PCI_MODEL");
	return board_node(pci, vm_patience_ms(), node);
}

static int open_files(void **state)
{
	(void)state;
	assert_int_equal(client_open(&client, node, BOARD_BYTES), 0);
	assert_int_equal(client_open(&other, node, BOARD_BYTES), 0);
	/* Both, so that the jobs which clear their memory are not among those that a test counts. */
	assert_true(client_works(&client));
	assert_true(client_works(&other));
	return 0;
}

/* Whatever went, the board is back and works for a new file. */
static int close_files(void **state)
{
	struct client next;

	(void)state;
	arm(VBOARD_FAULT_SLOW, 0);
	arm(VBOARD_FAULT_HANG, 0);
	client_close(&client);
	client_close(&other);
	assert_int_equal(client_open(&next, node, BOARD_BYTES), 0);
	assert_true(client_works(&next));
	client_close(&next);
	return 0;
}

/* Other programs look for the board at the node it had: the lowest free, once all are closed. */
static int teardown(void **state)
{
	(void)state;
	if (strcmp(node, vm_env("GLOSS_NODE_MODEL")) != 0 &&
	    (board_unbind(pci) || board_bind(pci, "gloss") ||
	     board_node(pci, vm_patience_ms(), node)))
		return -1;
	assert_string_equal(node, vm_env("GLOSS_NODE_MODEL"));
	return 0;
}

#define unplug_test(name) cmocka_unit_test_setup_teardown(name, open_files, close_files)

int main(void)
{
	const struct CMUnitTest tests[] = {
		unplug_test(a_killed_process_takes_nobody_with_it),
		unplug_test(memory_of_a_killed_process_is_clear),
		unplug_test(jobs_of_a_closed_file_end),
		unplug_test(the_module_stays_while_files_are_open),
		unplug_test(the_module_stays_while_a_sync_file_is_open),
		unplug_test(jobs_end_without_msi),
		unplug_test(a_board_sleeps_with_jobs_queued),
		unplug_test(a_reset_of_the_function_loses_no_job),
		unplug_test(an_error_of_the_bus_loses_no_job),
		unplug_test(a_board_without_power_meanwhile_wakes_up),
		unplug_test(a_driver_is_taken_off_and_put_back),
		unplug_test(a_board_is_removed_under_its_jobs),
		unplug_test(maps_outlive_their_board),
		unplug_test(a_dead_board_fails_its_jobs),
		unplug_test(a_board_that_dies_idle_is_noticed),
	};

	return cmocka_run_group_tests(tests, setup, teardown);
}
