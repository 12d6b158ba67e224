/* SPDX-License-Identifier: MIT */
/*
 * A host with a board plugged in, for tests: memory at a bus address above 4 GiB, all
 * other addresses refused, and what a driver does to submit a job.
 */
#ifndef TESTS_PORT_HOST_H
#define TESTS_PORT_HOST_H

#include <stdbool.h>
#include <stdint.h>

#include "vboard/board/board.h"
#include "gloss_packets.h"
#include "gloss_regs.h"
#include "job.h"

/* Inside the arena an address' upper half has a carry. */
#define PORT_HOST_BASE UINT64_C(0x1fffff8000)
#define PORT_HOST_BYTES (4u << 20)
#define PORT_HOST_ARENA (64u << 10) /* of it, for rings, lists and slot tables */
#define PORT_HOST_PAGES ((PORT_HOST_BYTES - PORT_HOST_ARENA) / GLOSS_PAGE_BYTES)
#define PORT_HOST_ACCESSES 512

struct port_access {
	uint64_t address;
	uint32_t bytes;
	bool write;
};

struct port_host {
	struct gloss_board_host host;
	const struct gloss_board_ops *ops;
	struct gloss_board *board;
	uint8_t *memory;

	uint32_t arena_used, pages_used;
	uint32_t page[PORT_HOST_PAGES]; /* in random order */

	uint64_t ring, completion;
	uint32_t log2, tail;

	/* What the board did. */
	struct port_access access[PORT_HOST_ACCESSES]; /* the first ones */
	uint64_t accesses;
	bool level;
	uint32_t levels, events;

	/* What shall happen. */
	uint64_t refuse; /* the access, counted from 1, that is refused; 0: none */
	uint64_t poison; /* so are accesses that touch these bytes */
	uint32_t poison_bytes;
	uint32_t later; /* writes of completions that are to be asked again */
	void (*on_event)(struct port_host *host);
};

uint64_t port_host_random(uint64_t *state);

/* Memory of random content and a board of @ops with @memory. False: out of memory. */
bool port_host_init(struct port_host *host, const struct gloss_board_ops *ops, void *memory,
		    uint64_t size, uint64_t seed);
void port_host_fini(struct port_host *host);

uint32_t port_host_read(struct port_host *host, uint32_t offset);
void port_host_write(struct port_host *host, uint32_t offset, uint32_t value);
/* Until there is nothing left to do. False: that takes for ever. */
bool port_host_work(struct port_host *host);
/* Resets the board and waits for it. False: as above. */
bool port_host_reset(struct port_host *host);

/* Words of host memory. */
uint32_t port_host_get(const struct port_host *host, uint64_t address);
void port_host_set(struct port_host *host, uint64_t address, uint32_t word);

/* Memory that nobody has yet: a piece of the arena, a power of 2 apart; a page. */
uint64_t port_host_take(struct port_host *host, uint32_t bytes, uint32_t align);
uint64_t port_host_page(struct port_host *host);
/* A list of as many pages as @words take. */
uint64_t port_host_list(struct port_host *host, uint32_t words);
/* Where word @word is that the pages of @list have. */
uint64_t port_host_word(const struct port_host *host, uint64_t list, uint32_t word);

/* Takes a ring, sets the board up and enables it. A @log2 too large is written all the same. */
void port_host_start(struct port_host *host, uint32_t log2, uint32_t mask);
/* Puts @job with lists and pages of its own into memory and describes it; @job's response is not
 * looked at. */
struct gloss_job_descriptor port_host_describe(struct port_host *host, const struct accel_job *job,
					       uint32_t sequence);
/* Writes the next entry of the ring, without telling the board. */
void port_host_push(struct port_host *host, const struct gloss_job_descriptor *descriptor);
/* Tells the board of all jobs that were pushed. */
void port_host_ring(struct port_host *host);
/* The completion of the job with this number, counted from the reset. */
struct gloss_completion port_host_completion(const struct port_host *host, uint32_t job);

#endif
