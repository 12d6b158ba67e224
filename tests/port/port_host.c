// SPDX-License-Identifier: MIT
/* The host's memory and its driver; see port_host.h. */
#include "port_host.h"

#include <endian.h>
#include <stdlib.h>
#include <string.h>

/* Calls of work() for what no test has work enough for. */
#define WORK_FOR_EVER 5000

uint64_t port_host_random(uint64_t *state)
{
	*state += UINT64_C(0x9e3779b97f4a7c15);
	uint64_t z = (*state ^ *state >> 30) * UINT64_C(0xbf58476d1ce4e5b9);

	z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
	return z ^ z >> 31;
}

/* ---- the bus ---- */

static uint8_t *host_at(const struct port_host *host, uint64_t address, uint32_t bytes)
{
	uint64_t offset = address - PORT_HOST_BASE;

	return offset < PORT_HOST_BYTES && bytes <= PORT_HOST_BYTES - offset ?
		       host->memory + offset :
		       NULL;
}

static uint8_t *host_access(struct port_host *host, uint64_t address, uint32_t bytes, bool write)
{
	if (host->accesses < PORT_HOST_ACCESSES)
		host->access[host->accesses] = (struct port_access){ address, bytes, write };
	host->accesses++;
	if (host->accesses == host->refuse ||
	    (address < host->poison + host->poison_bytes && host->poison < address + bytes))
		return NULL;
	return host_at(host, address, bytes);
}

static enum gloss_dma host_read(void *data, uint64_t address, void *to, uint32_t bytes)
{
	const uint8_t *from = host_access(data, address, bytes, false);

	if (!from)
		return GLOSS_DMA_REFUSED;
	memcpy(to, from, bytes);
	return GLOSS_DMA_DONE;
}

static bool is_completion(const struct port_host *host, uint64_t address)
{
	return host->completion && address - host->completion < (uint64_t)4 * GLOSS_COMPLETION_WORDS
									<< host->log2;
}

static enum gloss_dma host_write(void *data, uint64_t address, const void *from, uint32_t bytes)
{
	struct port_host *host = data;
	uint8_t *to;

	if (host->later && is_completion(host, address)) {
		host->later--;
		return GLOSS_DMA_LATER;
	}
	to = host_access(host, address, bytes, true);
	if (!to)
		return GLOSS_DMA_REFUSED;
	memcpy(to, from, bytes);
	return GLOSS_DMA_DONE;
}

static void host_level(void *data, bool level)
{
	struct port_host *host = data;

	host->level = level;
	host->levels++;
}

static void host_event(void *data)
{
	struct port_host *host = data;

	host->events++;
	if (host->on_event)
		host->on_event(host);
}

/* ---- memory ---- */

static void shuffle(struct port_host *host, uint64_t *state)
{
	for (uint32_t n = 0; n < PORT_HOST_PAGES; n++) {
		uint32_t other = (uint32_t)(port_host_random(state) % (n + 1));

		host->page[n] = host->page[other];
		host->page[other] = n;
	}
}

bool port_host_init(struct port_host *host, const struct gloss_board_ops *ops, void *memory,
		    uint64_t size, uint64_t seed)
{
	memset(host, 0, sizeof(*host));
	host->host = (struct gloss_board_host){ host, host_read, host_write, host_level,
						host_event };
	host->ops = ops;
	host->memory = malloc(PORT_HOST_BYTES);
	if (!host->memory)
		return false;
	for (uint32_t n = 0; n < PORT_HOST_BYTES; n += 8) {
		uint64_t word = port_host_random(&seed);

		memcpy(host->memory + n, &word, sizeof(word));
	}
	shuffle(host, &seed);
	host->board = ops->create(&host->host, memory, size);
	if (!host->board)
		free(host->memory);
	return host->board;
}

void port_host_fini(struct port_host *host)
{
	host->ops->destroy(host->board);
	free(host->memory);
}

uint32_t port_host_read(struct port_host *host, uint32_t offset)
{
	return host->ops->read(host->board, offset);
}

void port_host_write(struct port_host *host, uint32_t offset, uint32_t value)
{
	host->ops->write(host->board, offset, value);
}

bool port_host_work(struct port_host *host)
{
	for (uint32_t n = 0; n < WORK_FOR_EVER; n++)
		if (!host->ops->work(host->board))
			return true;
	return false;
}

bool port_host_reset(struct port_host *host)
{
	host->later = 0;
	port_host_write(host, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET);
	for (uint32_t n = 0; n < WORK_FOR_EVER; n++) {
		if (!(port_host_read(host, GLOSS_REG_CONTROL) & GLOSS_REG_CONTROL_RESET))
			return true;
		host->ops->work(host->board);
	}
	return false;
}

uint32_t port_host_get(const struct port_host *host, uint64_t address)
{
	uint32_t word;

	memcpy(&word, host_at(host, address, sizeof(word)), sizeof(word));
	return le32toh(word);
}

void port_host_set(struct port_host *host, uint64_t address, uint32_t word)
{
	word = htole32(word);
	memcpy(host_at(host, address, sizeof(word)), &word, sizeof(word));
}

uint64_t port_host_take(struct port_host *host, uint32_t bytes, uint32_t align)
{
	uint32_t at = (host->arena_used + align - 1) & ~(align - 1);

	if (bytes > PORT_HOST_ARENA - at)
		abort();
	host->arena_used = at + bytes;
	return PORT_HOST_BASE + at;
}

uint64_t port_host_page(struct port_host *host)
{
	if (host->pages_used == PORT_HOST_PAGES)
		abort();
	return PORT_HOST_BASE + PORT_HOST_ARENA +
	       (uint64_t)host->page[host->pages_used++] * GLOSS_PAGE_BYTES;
}

uint64_t port_host_list(struct port_host *host, uint32_t words)
{
	uint32_t pages = (words + GLOSS_PAGE_BYTES / 4 - 1) / (GLOSS_PAGE_BYTES / 4);
	uint64_t list = port_host_take(host, 8 * pages, 8);

	for (uint32_t n = 0; n < pages; n++) {
		uint64_t page = port_host_page(host);

		port_host_set(host, list + (uint64_t)8 * n, (uint32_t)page);
		port_host_set(host, list + (uint64_t)8 * n + 4, (uint32_t)(page >> 32));
	}
	return list;
}

uint64_t port_host_word(const struct port_host *host, uint64_t list, uint32_t word)
{
	uint64_t entry = list + (uint64_t)8 * (word / (GLOSS_PAGE_BYTES / 4));
	uint64_t page = (uint64_t)port_host_get(host, entry + 4) << 32 | port_host_get(host, entry);

	return (page & ~(uint64_t)(GLOSS_PAGE_BYTES - 1)) + 4 * (word % (GLOSS_PAGE_BYTES / 4));
}

/* ---- the driver ---- */

void port_host_start(struct port_host *host, uint32_t log2, uint32_t mask)
{
	host->log2 = log2 < GLOSS_RING_MAX_LOG2 ? log2 : GLOSS_RING_MAX_LOG2;
	host->tail = 0;
	host->ring = port_host_take(host, 4 * GLOSS_JOB_DESCRIPTOR_WORDS << host->log2, 64);
	host->completion = port_host_take(host, 4 * GLOSS_COMPLETION_WORDS << host->log2, 16);
	port_host_write(host, GLOSS_REG_RING_LOW, (uint32_t)host->ring);
	port_host_write(host, GLOSS_REG_RING_HIGH, (uint32_t)(host->ring >> 32));
	port_host_write(host, GLOSS_REG_RING_LOG2, log2);
	port_host_write(host, GLOSS_REG_COMPLETION_LOW, (uint32_t)host->completion);
	port_host_write(host, GLOSS_REG_COMPLETION_HIGH, (uint32_t)(host->completion >> 32));
	port_host_write(host, GLOSS_REG_INTERRUPT_MASK, mask);
	port_host_write(host, GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_ENABLE);
}

static uint64_t put_slots(struct port_host *host, const struct accel_job *job)
{
	uint64_t address = port_host_take(host, 4 * GLOSS_SLOTS * GLOSS_SLOT_ENTRY_WORDS, 64);

	for (uint32_t n = 0; n < GLOSS_SLOTS; n++) {
		struct gloss_slot_entry entry = { job->slot[n].base, job->slot[n].size,
						  job->slot[n].rights };
		uint32_t words[GLOSS_SLOT_ENTRY_WORDS];

		gloss_slot_entry_pack(words, &entry);
		for (uint32_t w = 0; w < GLOSS_SLOT_ENTRY_WORDS; w++)
			port_host_set(host, address + 4 * (n * GLOSS_SLOT_ENTRY_WORDS + w),
				      words[w]);
	}
	return address;
}

struct gloss_job_descriptor port_host_describe(struct port_host *host, const struct accel_job *job,
					       uint32_t sequence)
{
	uint64_t stream = port_host_list(host, job->stream_words);
	uint64_t response = port_host_list(host, job->response_words);
	uint64_t slots = put_slots(host, job);

	for (uint32_t n = 0; n < job->stream_words; n++)
		port_host_set(host, port_host_word(host, stream, n), job->stream[n]);
	return (struct gloss_job_descriptor){
		.sequence = sequence,
		.stream_words = job->stream_words,
		.stream_list_low = (uint32_t)stream,
		.stream_list_high = (uint32_t)(stream >> 32),
		.response_words = job->response_words,
		.response_list_low = (uint32_t)response,
		.response_list_high = (uint32_t)(response >> 32),
		.slot_table_low = (uint32_t)slots,
		.slot_table_high = (uint32_t)(slots >> 32),
	};
}

void port_host_push(struct port_host *host, const struct gloss_job_descriptor *descriptor)
{
	uint32_t entry = host->tail++ & ((1u << host->log2) - 1);
	uint64_t address = host->ring + (uint64_t)4 * GLOSS_JOB_DESCRIPTOR_WORDS * entry;
	uint32_t words[GLOSS_JOB_DESCRIPTOR_WORDS];

	gloss_job_descriptor_pack(words, descriptor);
	for (uint32_t n = 0; n < GLOSS_JOB_DESCRIPTOR_WORDS; n++)
		port_host_set(host, address + 4 * n, words[n]);
}

void port_host_ring(struct port_host *host)
{
	port_host_write(host, GLOSS_REG_TAIL, host->tail);
}

struct gloss_completion port_host_completion(const struct port_host *host, uint32_t job)
{
	uint32_t entry = job & ((1u << host->log2) - 1);
	uint64_t address = host->completion + (uint64_t)4 * GLOSS_COMPLETION_WORDS * entry;
	uint32_t words[GLOSS_COMPLETION_WORDS];
	struct gloss_completion completion;

	for (uint32_t n = 0; n < GLOSS_COMPLETION_WORDS; n++)
		words[n] = port_host_get(host, address + 4 * n);
	gloss_completion_unpack(words, &completion);
	return completion;
}
