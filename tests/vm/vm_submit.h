/* SPDX-License-Identifier: MIT */
/*
 * A right job in which all that is optional is there, for tests of SUBMIT that change one thing in
 * it, and what they may put there; include this after cmocka.h.
 */
#ifndef VM_SUBMIT_H
#define VM_SUBMIT_H

#include <stdint.h>

#include "gloss_node.h"

#define SUBMIT_BOARD_BYTES (4 * NODE_PAGE)
#define SUBMIT_KERNEL_ADDRESS 0xffff888000001000

/* Handles and addresses; VALUE is none of them. */
enum submit_thing {
	VALUE,
	HOST,         /* the client's host object */
	BOARD,        /* its board object */
	CLOSED,       /* an object's handle that is no more */
	FOREIGN,      /* one of another file */
	SIGNALLED,    /* a syncobj that has signalled */
	FRESH,        /* one that never had a fence */
	SYNC_CLOSED,  /* a syncobj's handle that is no more */
	SYNC_FOREIGN, /* one of another file */
	UNMAPPED,     /* an address where nothing is */
	HALF_MAPPED,  /* one from which 8 bytes are mapped */
	THINGS
};

extern uint64_t submit_thing[THINGS];
extern struct client client;

void submit_prepare(struct client_job *job);
/* The next job runs, and the last has left neither an object nor a syncobj; fails test @name. */
void submit_nothing_is_left(const char *name);

/* Of the group: in the end no board memory is taken that was free before. */
int submit_setup(void **state);
int submit_teardown(void **state);

#endif
