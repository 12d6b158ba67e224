/* SPDX-License-Identifier: MIT */
/*
 * What can go wrong with a board, on demand: a door talks to its board through here,
 * so every engine and every door has all faults. Armed on the command line or, while
 * the host runs, in the fault window (BAR 1 of the PCI door).
 */
#ifndef VBOARD_FAULTS_H
#define VBOARD_FAULTS_H

#include "vboard/board/board.h"

/* Registers of the fault window, 32 bits each. */
#define VBOARD_FAULT_IDENTITY 0x00 /* ro: VBOARD_FAULT_IDENTITY_VALUE */
/* Register writes take effect so many microseconds late, or before the next read. */
#define VBOARD_FAULT_DELAY_WRITES 0x04
#define VBOARD_FAULT_LOSE_INTERRUPTS 0x08 /* how many interrupts are yet to be lost */
/*
 * The engine stops for ever before it ends the n-th job from now, the running one
 * being the first. CONTROL.reset ends that, and the count; 0 does too.
 */
#define VBOARD_FAULT_HANG 0x0c
#define VBOARD_FAULT_REFUSE_DMA 0x10 /* the n-th DMA access from now is refused */
/*
 * The board goes away when the n-th job from now begins to use DMA, the running one
 * being the first; 0xffffffff: now. Then it is gone for everything but this window,
 * until 0 is written: it is back in its power-on state.
 */
#define VBOARD_FAULT_DIE 0x14
/* Any write sends an MSI, if enabled, and does nothing else. Reads 0. */
#define VBOARD_FAULT_DOORBELL 0x18
#define VBOARD_FAULT_SLOW 0x1c              /* each job takes so many microseconds longer */
#define VBOARD_FAULT_JOBS 0x20              /* ro: jobs that have ended since power on */
#define VBOARD_FAULT_BUS_MASTER_ERRORS 0x24 /* ro: DMA tried with bus mastering off */

#define VBOARD_FAULT_IDENTITY_VALUE 0x544c4146
#define VBOARD_FAULT_DIE_NOW 0xffffffff

/* What stands on the other side of a board: its door. */
struct vboard_faults_door {
	struct gloss_board_host host;
	/* Whether interrupts are messages (host.event) and not a level (host.level). */
	bool (*messages)(void *data);
	/* The board was dead and has power again. */
	void (*power_on)(void *data);
};

/* Values of the window's registers that can be armed; all zero: nothing is. */
struct vboard_faults_armed {
	uint32_t delay_writes, lose_interrupts, hang, refuse_dma, die, slow;
};

struct vboard_faults_write {
	uint64_t due;
	uint32_t offset, value;
};

#define VBOARD_FAULTS_WRITES 64

struct vboard_faults {
	const struct gloss_board_ops *ops;
	struct gloss_board *board;
	struct gloss_board_host host; /* what the board sees */
	struct vboard_faults_door door;
	struct vboard_faults_armed armed;
	uint32_t jobs, bus_master_errors;

	bool dead;
	bool hung;
	uint64_t ends; /* when the job that is slow ends; 0: none is */
	bool level, level_lost;

	struct vboard_faults_write write[VBOARD_FAULTS_WRITES];
	unsigned int writes; /* that have not taken effect */

	uint64_t completion; /* where the driver wants the records, */
	uint32_t ring_log2;  /* and how many */
};

/* See gloss_board_ops.create; false: out of memory. */
bool vboard_faults_init(struct vboard_faults *faults, const struct gloss_board_ops *ops,
			const struct vboard_faults_door *door, void *memory, uint64_t size,
			const struct vboard_faults_armed *armed);
void vboard_faults_fini(struct vboard_faults *faults);

/* Registers of the board. */
uint32_t vboard_faults_read(struct vboard_faults *faults, uint32_t offset);
void vboard_faults_write(struct vboard_faults *faults, uint32_t offset, uint32_t value);

/* The fault window. */
uint32_t vboard_faults_window_read(const struct vboard_faults *faults, uint32_t offset);
void vboard_faults_window_write(struct vboard_faults *faults, uint32_t offset, uint32_t value);

/* Delayed writes take effect now: the host does something that pushes them. */
void vboard_faults_push(struct vboard_faults *faults);

/* See gloss_board_ops.work. False: nothing to do until a register is written, or @due. */
bool vboard_faults_work(struct vboard_faults *faults);

/* When there is something to do next, in ns of CLOCK_MONOTONIC; UINT64_MAX: never. */
uint64_t vboard_faults_due(const struct vboard_faults *faults);

/* The host resets the board; what is armed stays. */
void vboard_faults_reset(struct vboard_faults *faults);

#endif
