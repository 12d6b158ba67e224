// SPDX-License-Identifier: MIT
#include "vboard/board/engine.h"

static bool board_begin(void *data, const struct accel_job *job)
{
	struct board_engine *board = data;

	board->job = *job;
	return !model_begin(&board->model, &board->job);
}

static void board_step(void *data, struct port_step *step)
{
	struct board_engine *board = data;
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
	struct board_engine *board = data;

	model_end(&board->model, status);
}

void board_engine_init(struct board_engine *board, void *memory, uint64_t size, uint32_t tile_size,
		       struct port_engine *engine, struct port_build *build)
{
	model_init(&board->model, (int)tile_size, memory, size);
	*engine = (struct port_engine){ board, board_begin, board_step, board_end };
	*build = (struct port_build){
		.tile_size = tile_size,
		.pixels_per_clock = 1,
		.memory_pages = (uint32_t)(size / GLOSS_PAGE_BYTES),
	};
}
