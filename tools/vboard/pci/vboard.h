/* SPDX-License-Identifier: MIT */
/* A board in its slot: what the files of vboard-pci share. */
#ifndef VBOARD_VBOARD_H
#define VBOARD_VBOARD_H

#include "vboard/pci/config.h"
#include "vboard/pci/faults.h"
#include "vboard/loop.h"
#include "vboard/pci/memory.h"
#include "vboard/pci/qtest.h"

#define VBOARD_NO_SLOT UINT32_MAX

struct vboard {
	const char *name; /* for messages */
	struct vboard_loop loop;
	struct vboard_qtest *qtest; /* NULL: interrupts go nowhere */
	uint32_t slot;              /* of the bus; VBOARD_NO_SLOT: INTx goes nowhere */

	struct vboard_config config;
	struct vboard_memory memory;
	struct vboard_faults faults;

	bool level;      /* that the board wants at INTx */
	bool pin;        /* the level there is */
	bool vcpu_waits; /* for an answer, and QEMU's main loop does not */

	uint64_t reads, writes; /* of registers */
	uint64_t dma_bytes;
	uint64_t interrupts;
};

/* ---- door.c: the board's side of its PCI slot ---- */

/* What a board asks of its host. */
struct vboard_faults_door vboard_door_pci_host(struct vboard *vboard);

/* Its side of the loop: with it, the vboard as data, and a socket, a loop can start. */
extern const struct vboard_loop_ops vboard_door_pci_loop;

#endif
