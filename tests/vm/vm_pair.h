/* SPDX-License-Identifier: MIT */
/*
 * Two files of the model board that queue jobs on it while something happens to the board, to its
 * driver or to one of them; include this after cmocka.h. As root.
 */
#ifndef VM_PAIR_H
#define VM_PAIR_H

#include <stdint.h>

#include "gloss_node.h"
#include "vm_board.h"

#define PAIR_BOARD_BYTES (4 * NODE_PAGE)

extern const char *pair_pci;        /* the board in sysfs */
extern char pair_node[BOARD_PATH];  /* its node, which is another after it was put back */
extern struct client client, other; /* open while a test runs */

/* Sets a word of the fault window. */
void pair_arm(uint32_t fault, uint32_t value);
/* Puts the board back that board_remove() has taken, with its node and its faults. */
void pair_find_again(void);

/* As many jobs as there may be under way; for boards that stay: each has ended, and did its work. */
void pair_queue(struct client *of);
void pair_ends_well(struct client *of);

/* Of the group, and of each test: in the end the board is back, at its node, and works. */
int pair_setup(void **state);
int pair_teardown(void **state);
int pair_open(void **state);
int pair_close(void **state);

#define pair_test(name) cmocka_unit_test_setup_teardown(name, pair_open, pair_close)

#endif
