/* SPDX-License-Identifier: MIT */
/* What the tests of boards of the models share: the core's model alone, and jobs for both. */
#ifndef BOARD_MODEL_TEST_H
#define BOARD_MODEL_TEST_H

#include "accel_test.h"
#include "model/model.h"
#include "stream_random.h"

static struct model model;
static struct stream_random job;
static uint8_t memory[STREAM_RANDOM_MEMORY], board_memory[STREAM_RANDOM_MEMORY];
static uint32_t response[STREAM_RANDOM_RESPONSE + 128];

/* Slots that leave memory. */
static const struct gloss_slot bad_slots[] = {
	{ sizeof(memory), 4, GLOSS_RIGHTS_READ },
	{ 0, sizeof(memory) + 1, GLOSS_RIGHTS_READ_WRITE },
	{ 0xfffff000, 0x2000, GLOSS_RIGHTS_NONE },
	{ 4096, 0xffffffff, GLOSS_RIGHTS_WRITE },
};

/* Runs the job without a port, on memory; its response goes to response. */
static inline struct gloss_status run_alone(int tile_size)
{
	struct gloss_status status;

	job.job.response = response;
	assert_int_equal(model_init(&model, tile_size, memory, sizeof(memory)), 0);
	assert_int_equal(model_run(&model, &job.job, &status), 0);
	return status;
}

#endif
