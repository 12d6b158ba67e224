/* SPDX-License-Identifier: MIT */
/*
 * A USB board behind its bridge: registers, a channel of words each way and events, on the
 * C model (usb_model.c) or on the Verilated port and core (usb_rtl.cpp, a plugin
 * with the one symbol gloss_usb_board). A door (vboard/usb/door.c) is the bridge, and the cable.
 *
 * Calls of one board come from one thread at a time. It never calls back: who has a board
 * offers it words, takes those it has, and lets it work, until none of that moves anything.
 */
#ifndef VBOARD_BOARD_USB_H
#define VBOARD_BOARD_USB_H

#include <stdbool.h>
#include <stdint.h>

#include "gloss_regs.h"

#define GLOSS_USB_BOARD_ABI 1
#define GLOSS_USB_BOARD_SYMBOL "gloss_usb_board"

struct gloss_usb_board;

struct gloss_usb_board_ops {
	uint32_t abi;     /* GLOSS_USB_BOARD_ABI */
	uint32_t version; /* GLOSS_VERSION it was built from */
	uint32_t tile_size, pixels_per_clock;

	/*
	 * A board in its power-on state with @size bytes of board memory at @memory (a
	 * multiple of 4096), which stays the caller's and outlives it. NULL: out of memory.
	 */
	struct gloss_usb_board *(*create)(void *memory, uint64_t size);
	void (*destroy)(struct gloss_usb_board *board);

	/* A 32-bit register access; @offset is a multiple of 4. */
	uint32_t (*read)(struct gloss_usb_board *board, uint32_t offset);
	void (*write)(struct gloss_usb_board *board, uint32_t offset, uint32_t value);

	/* Offers @count words of the OUT channel; how many of them it took. */
	uint32_t (*out)(struct gloss_usb_board *board, const uint32_t *words, uint32_t count);
	/*
	 * Takes up to @room words of the IN channel, none past the end of a burst; how many.
	 * *@flush: the last of them ends a burst.
	 */
	uint32_t (*in)(struct gloss_usb_board *board, uint32_t *words, uint32_t room, bool *flush);
	/* Takes the oldest event; false: there is none. */
	bool (*event)(struct gloss_usb_board *board, uint32_t words[2]);

	/*
	 * Works for about a millisecond. False: nothing that its host can see has moved, room
	 * for OUT words included, and nothing will until words are offered or taken, or a
	 * register is written.
	 */
	bool (*work)(struct gloss_usb_board *board);

	/* The power-on state again; board memory keeps its content. */
	void (*reset)(struct gloss_usb_board *board);
};

/* The C model of the board, in tiles of 32 and of 64 pixels. */
extern const struct gloss_usb_board_ops gloss_usb_board_model_t32, gloss_usb_board_model_t64;

#endif
