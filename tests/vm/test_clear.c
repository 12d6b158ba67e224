// SPDX-License-Identifier: MIT
/*
 * Board memory whose clearing fails: nobody reads what it held, and the next job that names it has
 * it cleared anew. As root, for the board's fault window, and for the names of objects that other
 * programs open, which only primary nodes have.
 */
#include <dirent.h>
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <xf86drm.h>

#include <cmocka.h>

#include "vboard/pci/faults.h"
#include "gloss_node.h"
#include "vm_test.h"
#include "vm_victim.h"

enum {
	/* So many jobs clear it that it takes longer than to kill a process, if they are slow. */
	BYTES = 24 << 20,
	SLOW_US = 100000,
	/* What is looked at is cleared by the last of them. */
	WORDS = 4096,
	OFFSET = BYTES - 4 * WORDS,
};

static char card[512];
static volatile uint32_t *window;
static struct client client;

static void arm(uint32_t fault, uint32_t value)
{
	window[fault / 4] = value;
}

/* The error of a job that reads the end of the client's object, which has to be zero. */
static int read_zeros(void)
{
	int err = client_run(&client, node_read(client.stream, 0, OFFSET, WORDS), WORDS);

	for (uint32_t i = 0; i < WORDS && !err; i++)
		assert_int_equal(client.response[i], 0);
	return err;
}

/* Leaves something else where an object of that size comes to lie next. */
static void make_dirty(void)
{
	static uint32_t words[1000];

	memset(words, 0xa5, sizeof(words));
	assert_int_equal(client_run(&client, node_write(client.stream, 0, OFFSET, words, 1000), 0),
			 0);
	assert_int_equal(node_destroy(client.fd, client.board), 0);
	client.board = 0;
}

static void an_object_whose_clearing_hung_the_board_is_cleared_anew(void **state)
{
	(void)state;
	make_dirty();
	assert_int_equal(node_create(client.fd, DRM_GLOSS_GEM_BOARD, BYTES, &client.board), 0);
	vm_expect("gloss ");
	arm(VBOARD_FAULT_HANG, 1);
	assert_int_equal(read_zeros(), -EIO);
	vm_expect_end();
	assert_int_equal(read_zeros(), 0);
	assert_true(client_works(&client));
}

/* Has an object cleared, and tells its name. */
static bool use_object(uint32_t *told)
{
	struct drm_gem_flink flink = { .handle = 0 };
	struct client victim;

	if (client_open(&victim, card, BYTES))
		return false;
	flink.handle = victim.board;
	if (node_ioctl(victim.fd, DRM_IOCTL_GEM_FLINK, &flink) || client_queue(&victim, 0))
		return false;
	*told = flink.name;
	return true;
}

static void an_object_of_a_killed_client_is_cleared_for_another(void **state)
{
	struct drm_gem_open open = { .name = 0 };
	pid_t victim;

	(void)state;
	make_dirty();
	arm(VBOARD_FAULT_SLOW, SLOW_US);
	victim = victim_start(use_object, &open.name);
	assert_int_equal(node_ioctl(client.fd, DRM_IOCTL_GEM_OPEN, &open), 0);
	victim_kill(victim);
	arm(VBOARD_FAULT_SLOW, 0);
	client.board = open.handle;
	assert_int_equal(read_zeros(), 0);
	assert_true(client_works(&client));
}

/* ---- set up ---- */

/* The board's primary node. */
static int setup(void **state)
{
	char path[256];
	struct dirent *entry;
	DIR *dir;

	(void)state;
	window = vm_faults("GLOSS_PCI_MODEL");
	snprintf(path, sizeof(path), "%s/drm", vm_env("GLOSS_PCI_MODEL"));
	dir = opendir(path);
	assert_non_null(dir);
	while ((entry = readdir(dir)) && strncmp(entry->d_name, "card", 4) != 0)
		;
	assert_non_null(entry);
	snprintf(card, sizeof(card), "/dev/dri/%s", entry->d_name);
	closedir(dir);
	return 0;
}

static int open_file(void **state)
{
	(void)state;
	return client_open(&client, card, BYTES);
}

static int close_file(void **state)
{
	(void)state;
	arm(VBOARD_FAULT_SLOW, 0);
	arm(VBOARD_FAULT_HANG, 0);
	client_close(&client);
	return 0;
}

#define clear_test(name) cmocka_unit_test_setup_teardown(name, open_file, close_file)

int main(void)
{
	const struct CMUnitTest tests[] = {
		clear_test(an_object_whose_clearing_hung_the_board_is_cleared_anew),
		clear_test(an_object_of_a_killed_client_is_cleared_for_another),
	};

	return cmocka_run_group_tests(tests, setup, NULL);
}
