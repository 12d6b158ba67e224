// SPDX-License-Identifier: MIT
/* A USB board whose core is the C model. */
#include <stdlib.h>

#include "vboard/board/engine.h"
#include "vboard/board/usb.h"
#include "vboard/port/usb.h"

struct gloss_usb_board {
	struct port_usb port;
	struct board_engine engine;
};

static struct gloss_usb_board *board_create(void *memory, uint64_t size, uint32_t tile_size)
{
	struct gloss_usb_board *board = calloc(1, sizeof(*board));
	struct port_engine engine;
	struct port_build build;

	if (!board)
		return NULL;
	board_engine_init(&board->engine, memory, size, tile_size, &engine, &build);
	port_usb_init(&board->port, &engine, &build);
	return board;
}

static struct gloss_usb_board *board_create_t32(void *memory, uint64_t size)
{
	return board_create(memory, size, 32);
}

static struct gloss_usb_board *board_create_t64(void *memory, uint64_t size)
{
	return board_create(memory, size, 64);
}

static void board_destroy(struct gloss_usb_board *board)
{
	free(board);
}

static uint32_t board_read(struct gloss_usb_board *board, uint32_t offset)
{
	return port_usb_read(&board->port, offset);
}

static void board_write(struct gloss_usb_board *board, uint32_t offset, uint32_t value)
{
	port_usb_write(&board->port, offset, value);
}

static uint32_t board_out(struct gloss_usb_board *board, const uint32_t *words, uint32_t count)
{
	return port_usb_out(&board->port, words, count);
}

static uint32_t board_in(struct gloss_usb_board *board, uint32_t *words, uint32_t room, bool *flush)
{
	return port_usb_in(&board->port, words, room, flush);
}

static bool board_event(struct gloss_usb_board *board, uint32_t words[2])
{
	return port_usb_event(&board->port, words);
}

static bool board_work(struct gloss_usb_board *board)
{
	return port_usb_work(&board->port);
}

static void board_reset(struct gloss_usb_board *board)
{
	port_usb_reset(&board->port);
}

#define BOARD_OPS(size)                                                                  \
	.abi = GLOSS_USB_BOARD_ABI, .version = GLOSS_VERSION, .tile_size = (size),       \
	.pixels_per_clock = 1, .create = board_create_t##size, .destroy = board_destroy, \
	.read = board_read, .write = board_write, .out = board_out, .in = board_in,      \
	.event = board_event, .work = board_work, .reset = board_reset

const struct gloss_usb_board_ops gloss_usb_board_model_t32 = { BOARD_OPS(32) };
const struct gloss_usb_board_ops gloss_usb_board_model_t64 = { BOARD_OPS(64) };
