/* SPDX-License-Identifier: MIT */
/* A board in its slot: what the files of vboard-pci share. */
#ifndef VBOARD_VBOARD_H
#define VBOARD_VBOARD_H

#include <pthread.h>

#include "config.h"
#include "faults.h"
#include "memory.h"
#include "qtest.h"

#define VBOARD_NO_SLOT UINT32_MAX

struct vboard {
	const char *name;		/* for messages */
	int socket;			/* to QEMU */
	struct vboard_qtest *qtest;	/* NULL: interrupts go nowhere */
	uint32_t slot;			/* of the bus; VBOARD_NO_SLOT: INTx goes nowhere */

	struct vboard_config config;
	struct vboard_memory memory;
	struct vboard_faults faults;
	void *board_memory;
	uint64_t board_memory_size;

	bool level;			/* that the board wants at INTx */
	bool pin;			/* the level there is */
	bool vcpu_waits;		/* for an answer, and QEMU's main loop does not */

	uint64_t reads, writes;		/* of registers */
	uint64_t dma_bytes;
	uint64_t interrupts;

	pthread_t thread;
	int ended;			/* eventfd that is told when the thread has ended */
	int error;			/* that ended it */
};

/* ---- door_pci.c: the board's side of its PCI slot ---- */

/* What a board asks of its host. */
struct vboard_faults_door vboard_door_pci_host(struct vboard *vboard);

/* Waits for a message and does what it says. 1; 0: QEMU is gone; -errno. */
int vboard_door_pci_serve(struct vboard *vboard);

/* ---- loop.c ---- */

/* Starts the board's thread; ->ended, ->socket and all above are set. 0, or -errno. */
int vboard_loop_start(struct vboard *vboard);
/* Ends it if it has not ended yet. */
void vboard_loop_stop(struct vboard *vboard);

#endif
