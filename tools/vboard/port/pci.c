// SPDX-License-Identifier: MIT
/* The PCI port: from a doorbell to a completion. */
#include "vboard/port/pci.h"

#include <string.h>

#define REG(port, name) PORT_REG(&(port)->base, name)

/* ---- events ---- */

static void port_level(struct port_pci *port)
{
	bool level = REG(port, INTERRUPT_STATUS) & REG(port, INTERRUPT_MASK);

	if (level == port->level)
		return;
	port->level = level;
	port->dma.host->level(port->dma.host->data, level);
}

static void port_event(struct port_pci *port, uint32_t events)
{
	REG(port, INTERRUPT_STATUS) |= events;
	port_level(port);
	if (events & REG(port, INTERRUPT_MASK))
		port->dma.host->event(port->dma.host->data);
}

/* The host refused an access: nothing more until a reset. */
static void port_stop(struct port_pci *port)
{
	port->state = PORT_STOPPED;
	REG(port, DMA_ERROR_LOW) = (uint32_t)port->dma.refused;
	REG(port, DMA_ERROR_HIGH) = (uint32_t)(port->dma.refused >> 32);
	REG(port, FAULT_CAUSE) = GLOSS_FAULT_DMA;
	REG(port, FAULT_OFFSET) = 0;
	REG(port, FAULT_SEQUENCE) = port->base.sequence;
	port_event(port, GLOSS_REG_INTERRUPT_STATUS_DMA);
}

/* ---- ring ---- */

static bool port_has_job(const struct port_pci *port)
{
	return (REG(port, CONTROL) & GLOSS_REG_CONTROL_ENABLE) &&
	       REG(port, HEAD) != REG(port, TAIL);
}

/* Address of the entry at HEAD of an array that is as long as the ring; @bytes: a power of 2. */
static uint64_t port_entry(const struct port_pci *port, uint32_t low, uint32_t high, uint32_t bytes)
{
	uint32_t log2 = REG(port, RING_LOG2);
	uint32_t entries = 1u << (log2 < GLOSS_RING_MAX_LOG2 ? log2 : GLOSS_RING_MAX_LOG2);

	return ((uint64_t)high << 32 | (low & ~(bytes - 1))) +
	       (uint64_t)bytes * (REG(port, HEAD) & (entries - 1));
}

static bool port_read_slots(struct port_pci *port, uint64_t address, struct accel_job *job)
{
	uint32_t words[GLOSS_SLOTS * GLOSS_SLOT_ENTRY_WORDS];

	if (port_dma_read(&port->dma, address, words, GLOSS_SLOTS * GLOSS_SLOT_ENTRY_WORDS) !=
	    GLOSS_DMA_DONE)
		return false;
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++)
		port_base_slot(job, n, words + (size_t)n * GLOSS_SLOT_ENTRY_WORDS);
	return true;
}

static bool port_read_job(struct port_pci *port, struct accel_job *job)
{
	uint64_t address = port_entry(port, REG(port, RING_LOW), REG(port, RING_HIGH),
				      4 * GLOSS_JOB_DESCRIPTOR_WORDS);
	uint32_t words[GLOSS_JOB_DESCRIPTOR_WORDS];
	struct gloss_job_descriptor d;

	port->base.sequence = 0;
	if (port_dma_read(&port->dma, address, words, GLOSS_JOB_DESCRIPTOR_WORDS) != GLOSS_DMA_DONE)
		return false;
	gloss_job_descriptor_unpack(words, &d);
	port->base.sequence = d.sequence;
	port_list_init(&port->stream, d.stream_list_low, d.stream_list_high, d.stream_words);
	port_list_init(&port->response, d.response_list_low, d.response_list_high,
		       d.response_words);
	*job = (struct accel_job){
		.stream_words = d.stream_words,
		.response_words = d.response_words,
	};
	return port_read_slots(port, (uint64_t)d.slot_table_high << 32 | (d.slot_table_low & ~63u),
			       job);
}

static void port_begin(struct port_pci *port)
{
	struct accel_job job;

	if (!port_read_job(port, &job)) {
		port_stop(port);
		return;
	}
	port->state = port_base_begin(&port->base, &job) ? PORT_RUNNING : PORT_ENDING;
}

/* ---- the job ---- */

/* Reads on until the window holds any packet. */
static bool port_fill(struct port_pci *port)
{
	struct port_base *base = &port->base;

	while (base->window_count < PORT_WINDOW_WORDS && port_list_left(&port->stream)) {
		uint32_t words = port_list_in_page(&port->stream);

		if (!port_list_read(&port->stream, &port->dma, port_base_room(base, words), words))
			return false;
		base->window_count += words;
	}
	return true;
}

/* Words that were worked on; 0: there are none, or an access was refused. */
static uint32_t port_step(struct port_pci *port)
{
	struct port_step step;

	if (!port_fill(port)) {
		port_stop(port);
		return 0;
	}
	if (!port->base.window_count)
		return 0;
	port_base_step(&port->base, &step);
	REG(port, PROGRESS) += step.taken;
	if (!port_list_write(&port->response, &port->dma, step.answer, step.answered)) {
		port_stop(port);
		return 0;
	}
	return step.taken + step.answered;
}

static void port_run(struct port_pci *port)
{
	uint32_t words = 0;

	while (words < PORT_WORK_WORDS) {
		uint32_t more = port_step(port);

		if (port->state == PORT_STOPPED)
			return;
		if (!more) {
			port->base.engine.end(port->base.engine.data, &port->base.status);
			port->state = PORT_ENDING;
			return;
		}
		words += more;
	}
}

static void port_end(struct port_pci *port)
{
	uint64_t address = port_entry(port, REG(port, COMPLETION_LOW), REG(port, COMPLETION_HIGH),
				      4 * GLOSS_COMPLETION_WORDS);
	uint32_t words[GLOSS_COMPLETION_WORDS];
	uint32_t events = GLOSS_REG_INTERRUPT_STATUS_DONE;

	gloss_completion_pack(words, &(struct gloss_completion){
					     .sequence = port->base.sequence,
					     .cause = port->base.status.cause,
					     .offset = port->base.status.offset,
					     .response_words = port->base.status.response_words,
				     });
	switch (port_dma_write(&port->dma, address, words, GLOSS_COMPLETION_WORDS)) {
	case GLOSS_DMA_LATER:
		return;
	case GLOSS_DMA_REFUSED:
		port_stop(port);
		return;
	case GLOSS_DMA_DONE:
		break;
	}
	REG(port, HEAD) = (REG(port, HEAD) + 1) & GLOSS_REG_HEAD_JOBS;
	port_base_count(&port->base);
	if (port->base.status.cause)
		events |= GLOSS_REG_INTERRUPT_STATUS_FAULT;
	port->state = PORT_READY;
	port_event(port, events);
}

bool port_pci_work(struct port_pci *port)
{
	if (port->state == PORT_READY && port_has_job(port))
		port_begin(port);
	if (port->state == PORT_RUNNING)
		port_run(port);
	if (port->state == PORT_ENDING)
		port_end(port);
	return port->state == PORT_RUNNING || port->state == PORT_ENDING ||
	       (port->state == PORT_READY && port_has_job(port));
}

/* ---- registers ---- */

/* Bits of what is written that a register keeps. */
static const uint32_t writable[PORT_REGISTERS] = {
	[GLOSS_REG_CONTROL / 4] = GLOSS_REG_CONTROL_ENABLE,
	[GLOSS_REG_INTERRUPT_MASK / 4] = GLOSS_REG_INTERRUPT_MASK_DONE |
					 GLOSS_REG_INTERRUPT_MASK_FAULT |
					 GLOSS_REG_INTERRUPT_MASK_DMA,
	[GLOSS_REG_RING_LOW / 4] = 0xffffffffu,
	[GLOSS_REG_RING_HIGH / 4] = 0xffffffffu,
	[GLOSS_REG_RING_LOG2 / 4] = GLOSS_REG_RING_LOG2_LOG2,
	[GLOSS_REG_TAIL / 4] = GLOSS_REG_TAIL_JOBS,
	[GLOSS_REG_COMPLETION_LOW / 4] = 0xffffffffu,
	[GLOSS_REG_COMPLETION_HIGH / 4] = 0xffffffffu,
};

static uint32_t port_status(const struct port_pci *port)
{
	switch (port->state) {
	case PORT_READY:
		return port_has_job(port) ? 0 : GLOSS_REG_STATUS_IDLE;
	case PORT_STOPPED:
		return GLOSS_REG_STATUS_DMA_ERROR;
	default:
		return GLOSS_REG_STATUS_RUNNING;
	}
}

uint32_t port_pci_read(const struct port_pci *port, uint32_t offset)
{
	return port_base_read(&port->base, offset, port_status(port));
}

void port_pci_write(struct port_pci *port, uint32_t offset, uint32_t value)
{
	if (offset / 4 >= PORT_REGISTERS)
		return;
	if (offset == GLOSS_REG_CONTROL && (value & GLOSS_REG_CONTROL_RESET)) {
		port_pci_reset(port);
		return;
	}
	if (offset == GLOSS_REG_INTERRUPT_STATUS)
		REG(port, INTERRUPT_STATUS) &= ~value;
	else if (writable[offset / 4])
		port->base.reg[offset / 4] = value & writable[offset / 4];
	port_level(port);
}

void port_pci_reset(struct port_pci *port)
{
	port_base_reset(&port->base, GLOSS_RING_MAX_LOG2);
	port->state = PORT_READY;
	port_level(port);
}

void port_pci_init(struct port_pci *port, const struct gloss_board_host *host,
		   const struct port_engine *engine, const struct port_build *build)
{
	memset(port, 0, sizeof(*port));
	port->dma.host = host;
	port_base_init(&port->base, engine, build);
	port_pci_reset(port);
}
