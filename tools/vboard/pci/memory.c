// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include <errno.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include "vboard/pci/memory.h"

/* A file that is shorter than its mapping would kill this process, not the host. */
static int memory_check(uint64_t address, uint64_t bytes, int file, uint64_t offset)
{
	struct stat stat;

	if (!bytes || bytes > UINT64_MAX - address)
		return -EINVAL;
	if (fstat(file, &stat))
		return -errno;
	if (stat.st_size < 0 || offset > (uint64_t)stat.st_size ||
	    bytes > (uint64_t)stat.st_size - offset)
		return -EINVAL;
	return 0;
}

int vboard_memory_add(struct vboard_memory *memory, uint64_t address, uint64_t bytes, int file,
		      uint64_t offset)
{
	void *map;
	int err;

	if (memory->regions == VBOARD_REGIONS)
		return -EINVAL;
	err = memory_check(address, bytes, file, offset);
	if (err)
		return err;
	map = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, (off_t)offset);
	if (map == MAP_FAILED)
		return -errno;
	memory->region[memory->regions++] = (struct vboard_region){
		.address = address,
		.bytes = bytes,
		.map = map,
	};
	return 0;
}

void vboard_memory_clear(struct vboard_memory *memory)
{
	while (memory->regions) {
		const struct vboard_region *region = &memory->region[--memory->regions];

		munmap(region->map, region->bytes);
	}
}

/* Where @address is mapped; *@part of @bytes bytes are there. NULL: none are. */
static uint8_t *memory_find(const struct vboard_memory *memory, uint64_t address, uint32_t bytes,
			    uint32_t *part)
{
	for (unsigned int i = 0; i < memory->regions; i++) {
		const struct vboard_region *region = &memory->region[i];
		uint64_t offset = address - region->address;

		if (address < region->address || offset >= region->bytes)
			continue;
		*part = region->bytes - offset < bytes ? (uint32_t)(region->bytes - offset) : bytes;
		return region->map + offset;
	}
	*part = 0;
	return NULL;
}

static bool memory_has(const struct vboard_memory *memory, uint64_t address, uint32_t bytes)
{
	uint32_t part;

	for (; bytes; bytes -= part, address += part)
		if (!memory_find(memory, address, bytes, &part))
			return false;
	return true;
}

bool vboard_memory_read(const struct vboard_memory *memory, uint64_t address, void *to,
			uint32_t bytes)
{
	uint8_t *next = to;
	uint32_t part;

	if (!memory_has(memory, address, bytes))
		return false;
	for (; bytes; bytes -= part, address += part, next += part) {
		const uint8_t *from = memory_find(memory, address, bytes, &part);

		memcpy(next, from, part);
	}
	return true;
}

bool vboard_memory_write(const struct vboard_memory *memory, uint64_t address, const void *from,
			 uint32_t bytes)
{
	const uint8_t *next = from;
	uint32_t part;

	if (!memory_has(memory, address, bytes))
		return false;
	for (; bytes; bytes -= part, address += part, next += part) {
		uint8_t *to = memory_find(memory, address, bytes, &part);

		memcpy(to, next, part);
	}
	return true;
}
