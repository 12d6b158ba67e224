// SPDX-License-Identifier: MIT
/* A board whose core is the C model. */
#include <stdlib.h>

#include "model/model.h"
#include "port_pci.h"

struct gloss_board {
	struct port_pci port;
	struct model model;
	struct gloss_job job;		/* under way; its stream and response are the windows */
};

static bool board_begin(void *data, const struct gloss_job *job)
{
	struct gloss_board *board = data;

	board->job = *job;
	return !model_begin(&board->model, &board->job);
}

static void board_step(void *data, struct port_step *step)
{
	struct gloss_board *board = data;
	struct model *model = &board->model;

	board->job.stream = step->words;
	board->job.response = step->answer;
	model->stream_from = model->at;
	model->response_from = model->response_used;
	/* After a fault the rest of the stream is read and ignored. */
	step->taken = model_step(model) ? model->at - model->stream_from : step->count;
	step->answered = model->response_used - model->response_from;
}

static void board_end(void *data, struct gloss_status *status)
{
	struct gloss_board *board = data;

	model_end(&board->model, status);
}

static struct gloss_board *board_create(const struct gloss_board_host *host, void *memory,
					uint64_t size, uint32_t tile_size)
{
	struct gloss_board *board = calloc(1, sizeof(*board));
	struct port_engine engine = { board, board_begin, board_step, board_end };

	if (!board)
		return NULL;
	model_init(&board->model, (int)tile_size, memory, size);
	port_pci_init(&board->port, host, &engine, tile_size, 1, size);
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

#define BOARD_OPS(size)				\
	.abi = GLOSS_BOARD_ABI,			\
	.version = GLOSS_VERSION,		\
	.tile_size = (size),			\
	.pixels_per_clock = 1,			\
	.create = board_create_t##size,		\
	.destroy = board_destroy,		\
	.read = board_read,			\
	.write = board_write,			\
	.work = board_work,			\
	.reset = board_reset

const struct gloss_board_ops gloss_board_model_t32 = { BOARD_OPS(32) };
const struct gloss_board_ops gloss_board_model_t64 = { BOARD_OPS(64) };
