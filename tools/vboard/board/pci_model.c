// SPDX-License-Identifier: MIT
/* A PCI board whose core is the C model. */
#include <stdlib.h>

#include "vboard/board/engine.h"
#include "vboard/port/pci.h"

struct gloss_board {
	struct port_pci port;
	struct board_engine engine;
};

static struct gloss_board *board_create(const struct gloss_board_host *host, void *memory,
					uint64_t size, uint32_t tile_size)
{
	struct gloss_board *board = calloc(1, sizeof(*board));
	struct port_engine engine;
	struct port_build build;

	if (!board)
		return NULL;
	board_engine_init(&board->engine, memory, size, tile_size, &engine, &build);
	port_pci_init(&board->port, host, &engine, &build);
	return board;
}

static struct gloss_board *board_create_t32(const struct gloss_board_host *host, void *memory,
					    uint64_t size)
{
	return board_create(host, memory, size, 32);
}

static struct gloss_board *board_create_t64(const struct gloss_board_host *host, void *memory,
					    uint64_t size)
{
	return board_create(host, memory, size, 64);
}

static void board_destroy(struct gloss_board *board)
{
	free(board);
}

static uint32_t board_read(struct gloss_board *board, uint32_t offset)
{
	return port_pci_read(&board->port, offset);
}

static void board_write(struct gloss_board *board, uint32_t offset, uint32_t value)
{
	port_pci_write(&board->port, offset, value);
}

static bool board_work(struct gloss_board *board)
{
	return port_pci_work(&board->port);
}

static void board_reset(struct gloss_board *board)
{
	port_pci_reset(&board->port);
}

#define BOARD_OPS(size)                                                                  \
	.abi = GLOSS_BOARD_ABI, .version = GLOSS_VERSION, .tile_size = (size),           \
	.pixels_per_clock = 1, .create = board_create_t##size, .destroy = board_destroy, \
	.read = board_read, .write = board_write, .work = board_work, .reset = board_reset

const struct gloss_board_ops gloss_board_model_t32 = { BOARD_OPS(32) };
const struct gloss_board_ops gloss_board_model_t64 = { BOARD_OPS(64) };
