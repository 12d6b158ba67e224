/* SPDX-License-Identifier: MIT */
/* The C model of the core as the engine of a port. */
#ifndef VBOARD_BOARD_ENGINE_H
#define VBOARD_BOARD_ENGINE_H

#include "model/model.h"
#include "vboard/port/base.h"

struct board_engine {
	struct model model;
	struct accel_job job; /* under way; its stream and response are the windows */
};

/* @memory outlives @board, as @board does @engine. */
void board_engine_init(struct board_engine *board, void *memory, uint64_t size, uint32_t tile_size,
		       struct port_engine *engine, struct port_build *build);

#endif
