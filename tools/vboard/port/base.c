// SPDX-License-Identifier: MIT
#include "vboard/port/base.h"

#include <string.h>

void port_base_init(struct port_base *base, const struct port_engine *engine,
		    const struct port_build *build)
{
	base->engine = *engine;
	base->build = *build;
}

void port_base_reset(struct port_base *base, uint32_t ring_max_log2)
{
	memset(base->reg, 0, sizeof(base->reg));
	PORT_REG(base, IDENTITY) = GLOSS_IDENTITY;
	PORT_REG(base, VERSION) = GLOSS_VERSION;
	PORT_REG(base, CAPABILITIES) = base->build.tile_size | base->build.pixels_per_clock << 8 |
				       ring_max_log2 << 16;
	PORT_REG(base, MEMORY_PAGES) = base->build.memory_pages;
}

uint32_t port_base_read(const struct port_base *base, uint32_t offset, uint32_t status)
{
	if (offset == GLOSS_REG_STATUS)
		return status;
	return offset / 4 < PORT_REGISTERS ? base->reg[offset / 4] : 0;
}

void port_base_slot(struct accel_job *job, uint32_t n, const uint32_t *words)
{
	struct gloss_slot_entry entry;

	gloss_slot_entry_unpack(words, &entry);
	job->slot[n] = (struct gloss_slot){
		.base = entry.base & ~(GLOSS_PAGE_BYTES - 1),
		.size = entry.size,
		.rights = entry.rights,
	};
}

bool port_base_begin(struct port_base *base, const struct accel_job *job)
{
	base->window_first = 0;
	base->window_count = 0;
	if (base->engine.begin(base->engine.data, job))
		return true;
	base->status = (struct gloss_status){ .cause = GLOSS_FAULT_MEMORY };
	return false;
}

uint32_t *port_base_room(struct port_base *base, uint32_t words)
{
	const uint32_t size = sizeof(base->window) / sizeof(base->window[0]);

	if (base->window_first + base->window_count + words > size) {
		memmove(base->window, base->window + base->window_first,
			4 * (size_t)base->window_count);
		base->window_first = 0;
	}
	return base->window + base->window_first + base->window_count;
}

void port_base_step(struct port_base *base, struct port_step *step)
{
	*step = (struct port_step){
		.words = base->window + base->window_first,
		.count = base->window_count,
		.answer = base->answer,
	};
	base->engine.step(base->engine.data, step);
	base->window_first += step->taken;
	base->window_count -= step->taken;
	PORT_REG(base, PROGRESS) += step->answered;
}

void port_base_count(struct port_base *base)
{
	PORT_REG(base, JOBS)++;
	if (!base->status.cause)
		return;
	PORT_REG(base, FAULT_CAUSE) = base->status.cause;
	PORT_REG(base, FAULT_OFFSET) = base->status.offset;
	PORT_REG(base, FAULT_SEQUENCE) = base->sequence;
}
