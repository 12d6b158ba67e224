// SPDX-License-Identifier: MIT
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "vboard/pci/faults.h"
#include "vm_pair.h"
#include "vm_test.h"

const char *pair_pci;
char pair_node[BOARD_PATH];
struct client client, other;

static volatile uint32_t *window;

void pair_arm(uint32_t fault, uint32_t value)
{
	window[fault / 4] = value;
}

void pair_queue(struct client *of)
{
	for (uint32_t n = 0; n < CLIENT_QUEUE; n++)
		assert_int_equal(client_queue(of, n), 0);
}

void pair_ends_well(struct client *of)
{
	for (uint32_t n = 0; n < CLIENT_QUEUE; n++)
		assert_int_equal(client_queue_wait(of, n), 0);
}

void pair_find_again(void)
{
	assert_int_equal(board_rescan(), 0);
	assert_int_equal(board_node(pair_pci, vm_patience_ms(), pair_node), 0);
	window = vm_faults("GLOSS_PCI_MODEL");
	assert_int_equal(window[VBOARD_FAULT_IDENTITY / 4], VBOARD_FAULT_IDENTITY_VALUE);
}

int pair_setup(void **state)
{
	(void)state;
	pair_pci = vm_env("GLOSS_PCI_MODEL");
	window = vm_faults("GLOSS_PCI_MODEL");
	return board_node(pair_pci, vm_patience_ms(), pair_node);
}

int pair_open(void **state)
{
	(void)state;
	assert_int_equal(client_open(&client, pair_node, PAIR_BOARD_BYTES), 0);
	assert_int_equal(client_open(&other, pair_node, PAIR_BOARD_BYTES), 0);
	/* Both, so that the jobs which clear their memory are not among those that a test counts. */
	assert_true(client_works(&client));
	assert_true(client_works(&other));
	return 0;
}

/* Whatever went, the board is back and works for a new file. */
int pair_close(void **state)
{
	struct client next;

	(void)state;
	pair_arm(VBOARD_FAULT_SLOW, 0);
	pair_arm(VBOARD_FAULT_HANG, 0);
	client_close(&client);
	client_close(&other);
	assert_int_equal(client_open(&next, pair_node, PAIR_BOARD_BYTES), 0);
	assert_true(client_works(&next));
	client_close(&next);
	return 0;
}

/* Other programs look for the board at the node it had: the lowest free, once all are closed. */
int pair_teardown(void **state)
{
	(void)state;
	if (strcmp(pair_node, vm_env("GLOSS_NODE_MODEL")) != 0 &&
	    (board_unbind(pair_pci) || board_bind(pair_pci, "gloss") ||
	     board_node(pair_pci, vm_patience_ms(), pair_node)))
		return -1;
	assert_string_equal(pair_node, vm_env("GLOSS_NODE_MODEL"));
	return 0;
}
