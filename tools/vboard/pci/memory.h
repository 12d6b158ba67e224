/* SPDX-License-Identifier: MIT */
/* The memory of the host that a board reaches by DMA: parts of files, mapped here. */
#ifndef VBOARD_MEMORY_H
#define VBOARD_MEMORY_H

#include <stdbool.h>
#include <stdint.h>

#define VBOARD_REGIONS 8

struct vboard_region {
	uint64_t address, bytes; /* on the bus, whose last byte is in none */
	uint8_t *map;
};

struct vboard_memory {
	struct vboard_region region[VBOARD_REGIONS];
	unsigned int regions;
};

/*
 * Adds @bytes bytes of @file from @offset on, at bus address @address; @file may be
 * closed afterwards. -EINVAL: a range that overflows or that the file does not have,
 * or a region too many; else what fstat or mmap said.
 */
int vboard_memory_add(struct vboard_memory *memory, uint64_t address, uint64_t bytes, int file,
		      uint64_t offset);

/* Takes everything away. */
void vboard_memory_clear(struct vboard_memory *memory);

/* False, and nothing is moved: not all bytes are memory. A range may span regions. */
bool vboard_memory_read(const struct vboard_memory *memory, uint64_t address, void *to,
			uint32_t bytes);
bool vboard_memory_write(const struct vboard_memory *memory, uint64_t address, const void *from,
			 uint32_t bytes);

#endif
