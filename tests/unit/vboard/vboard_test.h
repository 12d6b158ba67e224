/* SPDX-License-Identifier: MIT */
/* What the unit tests of the virtual board share: a host with memory, and its driver. */
#ifndef VBOARD_TEST_H
#define VBOARD_TEST_H

#include <string.h>

#include "accel_test.h"
#include "vboard/pci/faults.h"
#include "gloss_regs.h"

#define TEST_HOST_BASE 0x100000000ull /* of its memory on the bus: both words count */
#define TEST_HOST_BYTES 0x10000u

/* Where the driver has its things in there. */
#define TEST_RING 0x0000u
#define TEST_COMPLETION 0x4000u
#define TEST_SLOTS 0x8000u
#define TEST_RING_LOG2 3u

#define TEST_BOARD_BYTES 65536u

struct test_host {
	uint8_t memory[TEST_HOST_BYTES];
	bool messages; /* MSI is on */
	bool level;
	unsigned int events, power_ons, accesses;
};

static inline bool test_host_has(uint64_t address, uint32_t bytes)
{
	return address >= TEST_HOST_BASE && address - TEST_HOST_BASE < TEST_HOST_BYTES &&
	       bytes <= TEST_HOST_BYTES - (address - TEST_HOST_BASE);
}

static inline enum gloss_dma test_host_read(void *data, uint64_t address, void *to, uint32_t bytes)
{
	struct test_host *host = data;

	host->accesses++;
	if (!test_host_has(address, bytes))
		return GLOSS_DMA_REFUSED;
	memcpy(to, host->memory + (address - TEST_HOST_BASE), bytes);
	return GLOSS_DMA_DONE;
}

static inline enum gloss_dma test_host_write(void *data, uint64_t address, const void *from,
					     uint32_t bytes)
{
	struct test_host *host = data;

	host->accesses++;
	if (!test_host_has(address, bytes))
		return GLOSS_DMA_REFUSED;
	memcpy(host->memory + (address - TEST_HOST_BASE), from, bytes);
	return GLOSS_DMA_DONE;
}

static inline void test_host_level(void *data, bool level)
{
	((struct test_host *)data)->level = level;
}

static inline void test_host_event(void *data)
{
	((struct test_host *)data)->events++;
}

static inline bool test_host_messages(void *data)
{
	return ((struct test_host *)data)->messages;
}

static inline void test_host_power_on(void *data)
{
	((struct test_host *)data)->power_ons++;
}

static inline uint32_t test_host_word(const struct test_host *host, uint32_t offset)
{
	uint32_t word;

	memcpy(&word, host->memory + offset, sizeof(word));
	return word;
}

static inline void test_host_set_word(struct test_host *host, uint32_t offset, uint32_t word)
{
	memcpy(host->memory + offset, &word, sizeof(word));
}

/* Sets a board up, whose registers @put writes, and enables it. */
static inline void test_host_drive(void (*put)(uint32_t offset, uint32_t value),
				   uint32_t interrupts)
{
	const uint64_t ring = TEST_HOST_BASE + TEST_RING;
	const uint64_t completion = TEST_HOST_BASE + TEST_COMPLETION;

	put(GLOSS_REG_RING_LOW, (uint32_t)ring);
	put(GLOSS_REG_RING_HIGH, (uint32_t)(ring >> 32));
	put(GLOSS_REG_RING_LOG2, TEST_RING_LOG2);
	put(GLOSS_REG_COMPLETION_LOW, (uint32_t)completion);
	put(GLOSS_REG_COMPLETION_HIGH, (uint32_t)(completion >> 32));
	put(GLOSS_REG_INTERRUPT_MASK, interrupts);
	put(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
}

/* An empty job in ring entry @entry. */
static inline void test_host_job(struct test_host *host, uint32_t entry, uint32_t sequence)
{
	const uint32_t at = TEST_RING + 4 * GLOSS_JOB_DESCRIPTOR_WORDS * entry;
	const uint64_t slots = TEST_HOST_BASE + TEST_SLOTS;

	memset(host->memory + at, 0, (size_t)4 * GLOSS_JOB_DESCRIPTOR_WORDS);
	test_host_set_word(host, at + 4 * GLOSS_JOB_DESCRIPTOR_SEQUENCE_WORD, sequence);
	test_host_set_word(host, at + 4 * GLOSS_JOB_DESCRIPTOR_SLOT_TABLE_LOW_WORD,
			   (uint32_t)slots);
	test_host_set_word(host, at + 4 * GLOSS_JOB_DESCRIPTOR_SLOT_TABLE_HIGH_WORD,
			   (uint32_t)(slots >> 32));
}

/* The sequence number in completion record @entry. */
static inline uint32_t test_host_completed(const struct test_host *host, uint32_t entry)
{
	return test_host_word(host, TEST_COMPLETION + 4 * GLOSS_COMPLETION_WORDS * entry);
}

#endif
