// SPDX-License-Identifier: MIT
/*
 * A board goes away in the middle of a job, or its driver does: every fence signals, nobody waits
 * for ever, and what is left goes on. As root.
 */
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "vboard/pci/faults.h"
#include "vm_pair.h"
#include "vm_test.h"

/*
 * Of each job. In so many all are queued long before the last has ended, and yet a busy machine that
 * sleeps over it takes none for a hang, which is after 500 ms.
 */
#define SLOW_US 200000

/* The fences of a file's queued jobs, as files of their own: the board may go before they end. */
struct fences {
	int file[CLIENT_QUEUE];
};

static struct fences queue_fences(struct client *of)
{
	struct fences fences;

	pair_queue(of);
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
	/* So slow that all are queued before it dies: afterwards none are taken. */
	pair_arm(VBOARD_FAULT_SLOW, SLOW_US);
	mine = queue_fences(&client);
	others = queue_fences(&other);
	pair_arm(VBOARD_FAULT_DIE, 3);
	assert_in_range(count_from(&mine, -ENODEV) + count_from(&others, -ENODEV), 1,
			2 * CLIENT_QUEUE - 2);
	client_prepare(&client, &job, 0, 0);
	assert_int_equal(client_submit(&client, &job), -ENODEV);
	client_close(&other);
	pair_arm(VBOARD_FAULT_DIE, 0);
	assert_int_equal(board_remove(pair_pci), 0);
	everything_is_enodev(&client);
	pair_find_again();
	vm_expect_end();
}

static void a_board_that_dies_idle_is_noticed(void **state)
{
	struct client_job job;
	int err;

	(void)state;
	vm_expect("gloss |pci");
	pair_arm(VBOARD_FAULT_DIE, VBOARD_FAULT_DIE_NOW);
	client_prepare(&client, &job, 0, 0);
	err = client_submit(&client, &job);
	if (!err)
		err = client_wait(&client, vm_patience_ms());
	assert_int_equal(err, -ENODEV);
	assert_int_equal(client_submit(&client, &job), -ENODEV);
	pair_arm(VBOARD_FAULT_DIE, 0);
	assert_int_equal(board_remove(pair_pci), 0);
	pair_find_again();
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
	pair_arm(VBOARD_FAULT_SLOW, SLOW_US);
	mine = queue_fences(&client);
	others = queue_fences(&other);
	assert_int_equal(client_queue_wait(&client, 0), 0);
	assert_int_equal(board_remove(pair_pci), 0);
	assert_in_range(count_from(&mine, -ENODEV), 1, CLIENT_QUEUE - 1);
	assert_in_range(count_from(&others, -ENODEV), 1, CLIENT_QUEUE);
	everything_is_enodev(&client);
	the_other_board_works();
	pair_find_again();
	pair_arm(VBOARD_FAULT_SLOW, 0);
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
	assert_int_equal(board_remove(pair_pci), 0);
	sigaction(SIGBUS, &action, NULL);
	if (!sigsetjmp(no_memory, 1)) {
		assert_int_equal(*word, 0x0dd);
		*word = 0x0de;
	}
	signal(SIGBUS, SIG_DFL);
	pair_find_again();
}

static void a_driver_is_taken_off_and_put_back(void **state)
{
	(void)state;
	for (int n = 0; n < 3; n++) {
		struct fences fences = queue_fences(&client);

		assert_int_equal(board_unbind(pair_pci), 0);
		count_from(&fences, -ENODEV);
		client_close(&client);
		assert_int_equal(board_bind(pair_pci, "gloss"), 0);
		assert_int_equal(board_node(pair_pci, vm_patience_ms(), pair_node), 0);
		assert_int_equal(client_open(&client, pair_node, PAIR_BOARD_BYTES), 0);
		assert_true(client_works(&client));
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		pair_test(a_driver_is_taken_off_and_put_back),
		pair_test(a_board_is_removed_under_its_jobs),
		pair_test(maps_outlive_their_board),
		pair_test(a_dead_board_fails_its_jobs),
		pair_test(a_board_that_dies_idle_is_noticed),
	};

	return cmocka_run_group_tests(tests, pair_setup, pair_teardown);
}
