// SPDX-License-Identifier: MIT
#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>

#include "vboard/pci/message.h"
#include "vboard/pci/vboard.h"

/* ---- what the board asks ---- */

static bool door_may_dma(struct vboard *vboard, uint32_t bytes)
{
	if (!vboard_config_bus_master(&vboard->config)) {
		vboard->faults.bus_master_errors++;
		return false;
	}
	vboard->dma_bytes += bytes;
	return true;
}

static enum gloss_dma door_dma_read(void *data, uint64_t address, void *to, uint32_t bytes)
{
	struct vboard *vboard = data;

	if (!door_may_dma(vboard, bytes) ||
	    !vboard_memory_read(&vboard->memory, address, to, bytes))
		return GLOSS_DMA_REFUSED;
	return GLOSS_DMA_DONE;
}

static enum gloss_dma door_dma_write(void *data, uint64_t address, const void *from, uint32_t bytes)
{
	struct vboard *vboard = data;

	if (!door_may_dma(vboard, bytes) ||
	    !vboard_memory_write(&vboard->memory, address, from, bytes))
		return GLOSS_DMA_REFUSED;
	return GLOSS_DMA_DONE;
}

/*
 * A pin that a register write lowers must be low before the write is answered, or the
 * host takes the interrupt again. QEMU gives up its lock while a vCPU waits for the
 * answer, so its main loop can lower it; not when the main loop itself waits.
 */
static void door_update_pin(struct vboard *vboard)
{
	bool pin = vboard_config_intx(&vboard->config, vboard->level) && vboard->level;

	if (pin == vboard->pin)
		return;
	vboard->pin = pin;
	if (!vboard->qtest || vboard->slot == VBOARD_NO_SLOT)
		return;
	vboard->interrupts += pin;
	vboard_qtest_level(vboard->qtest, vboard->slot, pin, !pin && vboard->vcpu_waits);
}

static void door_level(void *data, bool level)
{
	struct vboard *vboard = data;

	vboard->level = level;
	door_update_pin(vboard);
}

static bool door_messages(void *data)
{
	const struct vboard *vboard = data;

	return vboard_config_msi(&vboard->config);
}

/* A message is a write of the board to the bus, and may not come without bus mastering. */
static void door_event(void *data)
{
	struct vboard *vboard = data;
	uint64_t address;
	uint16_t value;

	if (!vboard->qtest || !vboard_config_bus_master(&vboard->config))
		return;
	vboard_config_message(&vboard->config, &address, &value);
	vboard->interrupts++;
	vboard_qtest_message(vboard->qtest, address, value);
}

static void door_power_on(void *data)
{
	struct vboard *vboard = data;

	vboard_config_reset(&vboard->config);
	door_update_pin(vboard);
}

struct vboard_faults_door vboard_door_pci_host(struct vboard *vboard)
{
	return (struct vboard_faults_door){
		.host = {
			.data = vboard,
			.read = door_dma_read,
			.write = door_dma_write,
			.level = door_level,
			.event = door_event,
		},
		.messages = door_messages,
		.power_on = door_power_on,
	};
}

/* ---- what the host asks ---- */

/* A register access; only 32 bits reach the board. */
static uint32_t door_read_word(struct vboard *vboard, int bar, uint32_t offset)
{
	if (bar == VBOARD_BAR_FAULTS)
		return vboard_faults_window_read(&vboard->faults, offset);
	vboard->reads++;
	return vboard_faults_read(&vboard->faults, offset);
}

static void door_write_word(struct vboard *vboard, int bar, uint32_t offset, uint32_t value)
{
	if (bar == VBOARD_BAR_FAULTS) {
		vboard_faults_window_write(&vboard->faults, offset, value);
		return;
	}
	vboard->writes++;
	vboard_faults_write(&vboard->faults, offset, value);
}

/* 64 bits are two accesses, and less than 32 are a part of what is read. */
static uint64_t door_bar_read(struct vboard *vboard, const struct vboard_message_bar *access)
{
	uint32_t offset, bytes = access->bytes;
	uint64_t value;
	int bar = vboard_config_find(&vboard->config, access->address, bytes, &offset);

	if (bar < 0 || !bytes || bytes > 8 || (bytes & (bytes - 1)) || offset % bytes)
		return UINT64_MAX;
	value = door_read_word(vboard, bar, offset & ~3u);
	if (bytes == 8)
		return value | (uint64_t)door_read_word(vboard, bar, offset + 4) << 32;
	return value >> 8 * (offset & 3) & UINT64_MAX >> (64 - 8 * bytes);
}

/* Less than 32 bits are not written. */
static void door_bar_write(struct vboard *vboard, const struct vboard_message_bar *access)
{
	uint32_t offset, bytes = access->bytes;
	int bar = vboard_config_find(&vboard->config, access->address, bytes, &offset);

	if (bar < 0 || (bytes != 4 && bytes != 8) || offset % bytes)
		return;
	door_write_word(vboard, bar, offset, (uint32_t)access->value);
	if (bytes == 8)
		door_write_word(vboard, bar, offset + 4, (uint32_t)(access->value >> 32));
}

/* Requests do not overtake register writes, and a dead board answers with ones. */
static uint32_t door_config_read(struct vboard *vboard, const struct vboard_message_config *access)
{
	if (vboard->faults.dead)
		return UINT32_MAX;
	vboard_faults_push(&vboard->faults);
	return vboard_config_read(&vboard->config, access->address, access->bytes);
}

static void door_config_write(struct vboard *vboard, const struct vboard_message_config *access)
{
	if (vboard->faults.dead)
		return;
	vboard_faults_push(&vboard->faults);
	vboard_config_write(&vboard->config, access->address, access->value, access->bytes);
	door_update_pin(vboard);
}

/* QEMU tells all of its memory each time a part has changed. */
static void door_sysmem(struct vboard *vboard, const struct vboard_message *message)
{
	const struct vboard_message_sysmem *all = &message->sysmem;
	int err;

	vboard_memory_clear(&vboard->memory);
	for (unsigned int i = 0; i < message->fds; i++) {
		err = vboard_memory_add(&vboard->memory, all->address[i], all->bytes[i],
					message->fd[i], all->offset[i]);
		if (err)
			fprintf(stderr, "vboard-pci: %s: memory at 0x%llx: %s\n", vboard->name,
				(unsigned long long)all->address[i], strerror(-err));
	}
}

/* The main loop may be the one who waits for the answer to a reset. */
static void door_reset(struct vboard *vboard)
{
	vboard_config_reset(&vboard->config);
	if (!vboard->faults.dead)
		vboard_faults_reset(&vboard->faults);
	door_update_pin(vboard);
}

static uint64_t door_answer(struct vboard *vboard, const struct vboard_message *message)
{
	switch (message->command) {
	case VBOARD_CONFIG_READ:
		return door_config_read(vboard, &message->config);
	case VBOARD_CONFIG_WRITE:
		door_config_write(vboard, &message->config);
		return 0;
	case VBOARD_BAR_READ:
		return door_bar_read(vboard, &message->bar);
	case VBOARD_BAR_WRITE:
		door_bar_write(vboard, &message->bar);
		return 0;
	default:
		door_reset(vboard);
		return 0;
	}
}

/* Waits for a message and does what it says. */
static int door_serve(void *data)
{
	struct vboard *vboard = data;
	struct vboard_message message;
	uint64_t value;
	int ret = vboard_message_receive(vboard->loop.socket, &message);

	if (ret <= 0)
		return ret;
	if (message.command == VBOARD_SYNC_SYSMEM)
		door_sysmem(vboard, &message);
	/* An irqfd is for KVM, and interrupts are injected without. */
	if (message.command != VBOARD_SYNC_SYSMEM && message.command != VBOARD_SET_IRQFD) {
		vboard->vcpu_waits = message.command != VBOARD_DEVICE_RESET;
		value = door_answer(vboard, &message);
		vboard->vcpu_waits = false;
		ret = vboard_message_reply(vboard->loop.socket, value);
		ret = ret == -EPIPE || ret == -ECONNRESET ? 0 : ret ? ret : 1;
	}
	vboard_message_release(&message);
	return ret;
}

static bool door_work(void *data)
{
	return vboard_faults_work(&((struct vboard *)data)->faults);
}

static uint64_t door_due(const void *data)
{
	return vboard_faults_due(&((const struct vboard *)data)->faults);
}

static short door_events(const void *data)
{
	(void)data;
	return POLLIN;
}

const struct vboard_loop_ops vboard_door_pci_loop = {
	.serve = door_serve,
	.work = door_work,
	.due = door_due,
	.events = door_events,
};
