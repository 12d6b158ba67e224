/* SPDX-License-Identifier: MIT */
/*
 * The C model of the PCI port: registers, ring, DMA and events as rtl/gloss.xml has
 * them under <port>, around an engine that it does not know. What a job makes it hold
 * does not grow with the job: stream and response pass through windows.
 */
#ifndef VBOARD_PORT_PCI_H
#define VBOARD_PORT_PCI_H

#include <stdbool.h>
#include <stdint.h>

#include "board.h"
#include "job.h"
#include "port_dma.h"

/* Words of the stream an engine sees at least, unless fewer are left: the longest packet. */
#define PORT_WINDOW_WORDS (1 + GLOSS_LENGTH_MAX)
/* The most an engine answers in one step. */
#define PORT_ANSWER_WORDS 65536u

struct port_step {
	const uint32_t *words;		/* of the stream, from the first not taken */
	uint32_t count;			/* at least 1 */
	uint32_t *answer;		/* room for PORT_ANSWER_WORDS, which are the engine's */
	uint32_t taken;			/* out: at least 1 */
	uint32_t answered;		/* out: not more than the job has room for */
};

struct port_engine {
	void *data;
	/* A job starts; its stream and response are NULL. False: its slots leave board memory. */
	bool (*begin)(void *data, const struct gloss_job *job);
	/* Works for some microseconds; called until all words are taken. */
	void (*step)(void *data, struct port_step *step);
	/* All words are taken: how did the job end? */
	void (*end)(void *data, struct gloss_status *status);
	/* A job that was begun may also never be stepped again. */
};

/* What the port is doing. */
enum port_state {
	PORT_READY,			/* for the next job */
	PORT_RUNNING,
	PORT_ENDING,			/* the job has ended, its completion is to be written */
	PORT_STOPPED,			/* by a DMA error */
};

#define PORT_REGISTERS 32		/* words of BAR 0 there are registers in */

struct port_pci {
	struct port_engine engine;
	struct port_dma dma;
	uint32_t tile_size, pixels_per_clock, memory_pages;

	uint32_t reg[PORT_REGISTERS];	/* STATUS is made when it is read */
	bool level;			/* of INTx, as the host knows it */
	enum port_state state;

	/* The job under way. */
	uint32_t sequence;
	struct port_list stream, response;
	struct gloss_status status;

	/* Stream words that the engine has not taken: count of them, from first on. */
	uint32_t window[4 * PORT_WINDOW_WORDS];
	uint32_t window_first, window_count;
	uint32_t answer[PORT_ANSWER_WORDS];
};

/* Power on: fills all of @port. @host outlives it. */
void port_pci_init(struct port_pci *port, const struct gloss_board_host *host,
		   const struct port_engine *engine, uint32_t tile_size, uint32_t pixels_per_clock,
		   uint64_t memory_size);

/* As those of struct gloss_board_ops. */
uint32_t port_pci_read(const struct port_pci *port, uint32_t offset);
void port_pci_write(struct port_pci *port, uint32_t offset, uint32_t value);
bool port_pci_work(struct port_pci *port);
void port_pci_reset(struct port_pci *port);

#endif
