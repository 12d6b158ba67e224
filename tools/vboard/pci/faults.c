// SPDX-License-Identifier: MIT
#include <string.h>
#include <time.h>

#include "vboard/pci/faults.h"
#include "gloss_regs.h"

#define COMPLETION_BYTES (4u * GLOSS_COMPLETION_WORDS)

static uint64_t now(void)
{
	struct timespec time;

	clock_gettime(CLOCK_MONOTONIC, &time);
	return (uint64_t)time.tv_sec * 1000000000 + (uint64_t)time.tv_nsec;
}

/* ---- interrupts ---- */

static bool faults_lose(struct vboard_faults *faults)
{
	if (!faults->armed.lose_interrupts)
		return false;
	faults->armed.lose_interrupts--;
	return true;
}

static void faults_event(void *data)
{
	struct vboard_faults *faults = data;

	if (!faults->dead && faults->door.messages(faults->door.host.data) && !faults_lose(faults))
		faults->door.host.event(faults->door.host.data);
}

static void faults_show_level(struct vboard_faults *faults)
{
	faults->door.host.level(faults->door.host.data,
				faults->level && !faults->level_lost && !faults->dead);
}

static void faults_level(void *data, bool level)
{
	struct vboard_faults *faults = data;

	faults->level = level;
	faults->level_lost = level && !faults->dead &&
			     !faults->door.messages(faults->door.host.data) && faults_lose(faults);
	faults_show_level(faults);
}

/* ---- life and death ---- */

static void faults_forget(struct vboard_faults *faults)
{
	faults->hung = false;
	faults->ends = 0;
	faults->writes = 0;
	faults->completion = 0;
	faults->ring_log2 = 0;
}

static void faults_die(struct vboard_faults *faults)
{
	faults->dead = true;
	faults->writes = 0;
	faults_show_level(faults);
}

void vboard_faults_reset(struct vboard_faults *faults)
{
	faults_forget(faults);
	faults->ops->reset(faults->board);
	faults->level = false;
	faults->level_lost = false;
	faults_show_level(faults);
}

static void faults_revive(struct vboard_faults *faults)
{
	faults->dead = false;
	vboard_faults_reset(faults);
	faults->jobs = 0;
	faults->door.power_on(faults->door.host.data);
}

/* ---- DMA, and the end of a job ---- */

/* Whether an access may go on to the host. */
static bool faults_dma(struct vboard_faults *faults)
{
	if (faults->armed.die == 1)
		faults_die(faults);
	if (faults->dead)
		return false;
	if (!faults->armed.refuse_dma)
		return true;
	return --faults->armed.refuse_dma;
}

static bool faults_is_completion(const struct vboard_faults *faults, uint64_t address)
{
	uint64_t offset = address - faults->completion;

	return offset < (uint64_t)COMPLETION_BYTES << faults->ring_log2 &&
	       offset % COMPLETION_BYTES == 0;
}

/* Whether the job that wants to write its completion record may. */
static bool faults_may_end(struct vboard_faults *faults)
{
	if (faults->armed.hang == 1) {
		faults->armed.hang = 0;
		faults->hung = true;
	}
	if (faults->hung)
		return false;
	if (faults->armed.slow && !faults->ends)
		faults->ends = now() + 1000ull * faults->armed.slow;
	return !faults->ends || now() >= faults->ends;
}

static void faults_job_ended(struct vboard_faults *faults)
{
	faults->ends = 0;
	faults->jobs++;
	if (faults->armed.hang)
		faults->armed.hang--;
	if (faults->armed.die > 1 && faults->armed.die != VBOARD_FAULT_DIE_NOW)
		faults->armed.die--;
}

static enum gloss_dma faults_dma_read(void *data, uint64_t address, void *to, uint32_t bytes)
{
	struct vboard_faults *faults = data;

	if (!faults_dma(faults))
		return GLOSS_DMA_REFUSED;
	return faults->door.host.read(faults->door.host.data, address, to, bytes);
}

static enum gloss_dma faults_dma_write(void *data, uint64_t address, const void *from,
				       uint32_t bytes)
{
	struct vboard_faults *faults = data;
	bool completion = faults_is_completion(faults, address);
	enum gloss_dma ret;

	if (!faults->dead && completion && !faults_may_end(faults))
		return GLOSS_DMA_LATER;
	if (!faults_dma(faults))
		return GLOSS_DMA_REFUSED;
	ret = faults->door.host.write(faults->door.host.data, address, from, bytes);
	if (completion && ret == GLOSS_DMA_DONE)
		faults_job_ended(faults);
	return ret;
}

/* ---- registers ---- */

/* What a driver writes that tells where jobs end. */
static void faults_watch(struct vboard_faults *faults, uint32_t offset, uint32_t value)
{
	switch (offset) {
	case GLOSS_REG_CONTROL:
		if (!(value & GLOSS_REG_CONTROL_RESET))
			break;
		faults->armed.hang = 0;
		faults_forget(faults);
		break;
	case GLOSS_REG_COMPLETION_LOW:
		faults->completion = (faults->completion & ~0xffffffffull) | value;
		break;
	case GLOSS_REG_COMPLETION_HIGH:
		faults->completion = (faults->completion & 0xffffffffull) | (uint64_t)value << 32;
		break;
	case GLOSS_REG_RING_LOG2:
		value &= GLOSS_REG_RING_LOG2_LOG2;
		faults->ring_log2 = value < GLOSS_RING_MAX_LOG2 ? value : GLOSS_RING_MAX_LOG2;
		break;
	default:
		break;
	}
}

static void faults_write_now(struct vboard_faults *faults, uint32_t offset, uint32_t value)
{
	faults_watch(faults, offset, value);
	faults->ops->write(faults->board, offset, value);
}

/* Writes that are due at @time take effect; a reset among them drops those behind it. */
static void faults_push_due(struct vboard_faults *faults, uint64_t time)
{
	while (faults->writes && faults->write[0].due <= time) {
		struct vboard_faults_write write = faults->write[0];

		faults->writes--;
		memmove(faults->write, faults->write + 1, faults->writes * sizeof(write));
		faults_write_now(faults, write.offset, write.value);
	}
}

void vboard_faults_push(struct vboard_faults *faults)
{
	faults_push_due(faults, UINT64_MAX);
}

uint32_t vboard_faults_read(struct vboard_faults *faults, uint32_t offset)
{
	if (faults->dead)
		return UINT32_MAX;
	vboard_faults_push(faults);
	return faults->ops->read(faults->board, offset);
}

void vboard_faults_write(struct vboard_faults *faults, uint32_t offset, uint32_t value)
{
	if (faults->dead)
		return;
	if (!faults->armed.delay_writes || faults->writes == VBOARD_FAULTS_WRITES)
		vboard_faults_push(faults);
	if (!faults->armed.delay_writes) {
		faults_write_now(faults, offset, value);
		return;
	}
	faults->write[faults->writes++] = (struct vboard_faults_write){
		.due = now() + 1000ull * faults->armed.delay_writes,
		.offset = offset,
		.value = value,
	};
}

bool vboard_faults_work(struct vboard_faults *faults)
{
	uint64_t time = faults->writes || faults->ends ? now() : 0;

	faults_push_due(faults, time);
	if (faults->dead || faults->hung || faults->ends > time)
		return false;
	return faults->ops->work(faults->board) && !faults->dead && !faults->hung;
}

uint64_t vboard_faults_due(const struct vboard_faults *faults)
{
	uint64_t due = UINT64_MAX;

	if (faults->ends && !faults->hung && !faults->dead)
		due = faults->ends;
	if (faults->writes && faults->write[0].due < due)
		due = faults->write[0].due;
	return due;
}

/* ---- the window ---- */

uint32_t vboard_faults_window_read(const struct vboard_faults *faults, uint32_t offset)
{
	switch (offset) {
	case VBOARD_FAULT_IDENTITY:
		return VBOARD_FAULT_IDENTITY_VALUE;
	case VBOARD_FAULT_DELAY_WRITES:
		return faults->armed.delay_writes;
	case VBOARD_FAULT_LOSE_INTERRUPTS:
		return faults->armed.lose_interrupts;
	case VBOARD_FAULT_HANG:
		return faults->armed.hang;
	case VBOARD_FAULT_REFUSE_DMA:
		return faults->armed.refuse_dma;
	case VBOARD_FAULT_DIE:
		return faults->armed.die;
	case VBOARD_FAULT_SLOW:
		return faults->armed.slow;
	case VBOARD_FAULT_JOBS:
		return faults->jobs;
	case VBOARD_FAULT_BUS_MASTER_ERRORS:
		return faults->bus_master_errors;
	default:
		return 0;
	}
}

static void faults_arm_hang(struct vboard_faults *faults, uint32_t jobs)
{
	faults->armed.hang = jobs;
	faults->hung = false;
}

static void faults_arm_die(struct vboard_faults *faults, uint32_t jobs)
{
	faults->armed.die = jobs;
	if (jobs == VBOARD_FAULT_DIE_NOW)
		faults_die(faults);
	else if (!jobs && faults->dead)
		faults_revive(faults);
}

void vboard_faults_window_write(struct vboard_faults *faults, uint32_t offset, uint32_t value)
{
	switch (offset) {
	case VBOARD_FAULT_DELAY_WRITES:
		faults->armed.delay_writes = value;
		break;
	case VBOARD_FAULT_LOSE_INTERRUPTS:
		faults->armed.lose_interrupts = value;
		break;
	case VBOARD_FAULT_HANG:
		faults_arm_hang(faults, value);
		break;
	case VBOARD_FAULT_REFUSE_DMA:
		faults->armed.refuse_dma = value;
		break;
	case VBOARD_FAULT_DIE:
		faults_arm_die(faults, value);
		break;
	case VBOARD_FAULT_DOORBELL:
		faults_event(faults);
		break;
	case VBOARD_FAULT_SLOW:
		faults->armed.slow = value;
		break;
	default:
		break;
	}
}

/* ---- beginning and end ---- */

bool vboard_faults_init(struct vboard_faults *faults, const struct gloss_board_ops *ops,
			const struct vboard_faults_door *door, void *memory, uint64_t size,
			const struct vboard_faults_armed *armed)
{
	*faults = (struct vboard_faults){
		.ops = ops,
		.door = *door,
		.armed = *armed,
		.dead = armed->die == VBOARD_FAULT_DIE_NOW,
		.host = {
			.data = faults,
			.read = faults_dma_read,
			.write = faults_dma_write,
			.level = faults_level,
			.event = faults_event,
		},
	};
	faults->board = ops->create(&faults->host, memory, size);
	return faults->board;
}

void vboard_faults_fini(struct vboard_faults *faults)
{
	faults->ops->destroy(faults->board);
}
