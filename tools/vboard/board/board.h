/* SPDX-License-Identifier: MIT */
/*
 * A PCI board without its plug: registers, DMA and an interrupt, on the C model
 * (pci_model.c) or on the Verilated port and core (pci_rtl.cpp, a plugin with the
 * one symbol gloss_board). A door (vboard/pci/door.c) puts it in front of a host.
 *
 * Calls of one board come from one thread at a time, and it calls its host only from
 * inside them.
 */
#ifndef VBOARD_BOARD_H
#define VBOARD_BOARD_H

#include <stdbool.h>
#include <stdint.h>

#define GLOSS_BOARD_ABI 1
#define GLOSS_BOARD_SYMBOL "gloss_board"

struct gloss_board;

/* What a host answers to DMA. */
enum gloss_dma {
	GLOSS_DMA_REFUSED, /* as a bus does with an address it does not know */
	GLOSS_DMA_DONE,
	/*
	 * Not done yet; only to the write of a completion record, by a host that makes
	 * a board slow or hang. The job is still running, nothing after the record has
	 * happened (HEAD, events), and later calls of work() ask again until there is
	 * another answer. Not after CONTROL.reset: then the record is dropped, or
	 * asked for once more.
	 */
	GLOSS_DMA_LATER,
};

/* What a board asks of the host it is plugged into. */
struct gloss_board_host {
	void *data;
	/* DMA. A completion record is one write of its 16 bytes. */
	enum gloss_dma (*read)(void *data, uint64_t address, void *to, uint32_t bytes);
	enum gloss_dma (*write)(void *data, uint64_t address, const void *from, uint32_t bytes);
	/* The level of INTx has changed. */
	void (*level)(void *data, bool level);
	/* An event whose mask bit is set has happened: an MSI is due. */
	void (*event)(void *data);
};

struct gloss_board_ops {
	uint32_t abi;     /* GLOSS_BOARD_ABI */
	uint32_t version; /* GLOSS_VERSION it was built from */
	uint32_t tile_size, pixels_per_clock;

	/*
	 * A board in its power-on state with @size bytes of board memory at @memory (a
	 * multiple of 4096), which stays the caller's and outlives it, as @host does.
	 * NULL: out of memory.
	 */
	struct gloss_board *(*create)(const struct gloss_board_host *host, void *memory,
				      uint64_t size);
	void (*destroy)(struct gloss_board *board);

	/* A 32-bit register access; @offset is a multiple of 4 in BAR 0. */
	uint32_t (*read)(struct gloss_board *board, uint32_t offset);
	void (*write)(struct gloss_board *board, uint32_t offset, uint32_t value);

	/*
	 * Works for about a millisecond: the host may be waiting to ask something.
	 * False: nothing is left to do until a register is written.
	 */
	bool (*work)(struct gloss_board *board);

	/* The power-on state again; board memory keeps its content. */
	void (*reset)(struct gloss_board *board);
};

/* The C model of the board, in tiles of 32 and of 64 pixels. */
extern const struct gloss_board_ops gloss_board_model_t32, gloss_board_model_t64;

#endif
