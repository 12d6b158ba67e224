// SPDX-License-Identifier: MIT
/* The command stage: a job from its first packet to its end or fault. */
#include <errno.h>
#include <string.h>

#include "model.h"

static void run_write_memory(struct model *model, const uint32_t *packet)
{
	struct gloss_write_memory p;

	gloss_write_memory_unpack(packet, &p);
	model_memory_write(model, p.slot, p.offset, packet + 1 + GLOSS_WRITE_MEMORY_WORDS,
			   gloss_header_length(packet[0]) - GLOSS_WRITE_MEMORY_WORDS);
}

static void run_read_memory(struct model *model, const uint32_t *packet)
{
	struct gloss_read_memory p;

	gloss_read_memory_unpack(packet, &p);
	model_memory_read(model, p.slot, p.offset, model_memory_answer(model, p.count), p.count);
}

static void run_counters(struct model *model, const uint32_t *packet)
{
	uint32_t *words = model_memory_answer(model, GLOSS_COUNTER_WORDS);

	(void)packet;
	words[0] = model->counters.triangles;
	words[1] = model->counters.covered;
	words[2] = model->counters.passed;
	words[3] = model->counters.tiles;
}

static void run_colour_surface(struct model *model, const uint32_t *packet)
{
	struct gloss_colour_surface p;

	gloss_colour_surface_unpack(packet, &p);
	model->state.colour_surface = (struct model_target){ p.slot, p.pitch };
}

static void run_depth_surface(struct model *model, const uint32_t *packet)
{
	struct gloss_depth_surface p;

	gloss_depth_surface_unpack(packet, &p);
	model->state.depth_surface = (struct model_target){ p.slot, p.pitch };
}

static void run_tile_begin(struct model *model, const uint32_t *packet)
{
	struct gloss_tile_begin p;

	gloss_tile_begin_unpack(packet, &p);
	model_tile_begin(model, &p);
	model->in_tile = true;
}

static void run_tile_end(struct model *model, const uint32_t *packet)
{
	struct gloss_tile_end p;

	gloss_tile_end_unpack(packet, &p);
	model_tile_end(model, &p);
	model->counters.tiles++;
	model->in_tile = false;
}

static void run_depth_state(struct model *model, const uint32_t *packet)
{
	struct gloss_depth_state p;

	gloss_depth_state_unpack(packet, &p);
	model->state.depth_func = p.func;
	model->state.depth_write = p.write;
}

static void run_colour_mask(struct model *model, const uint32_t *packet)
{
	struct gloss_colour_mask p;

	gloss_colour_mask_unpack(packet, &p);
	model->state.colour_mask = (p.red ? 0x000000ffu : 0) | (p.green ? 0x0000ff00u : 0) |
				   (p.blue ? 0x00ff0000u : 0) | (p.alpha ? 0xff000000u : 0);
}

static void run_scissor(struct model *model, const uint32_t *packet)
{
	struct gloss_scissor p;

	gloss_scissor_unpack(packet, &p);
	model->state.scissor = (struct model_scissor){ (int)p.x0, (int)p.y0, (int)p.x1, (int)p.y1 };
}

static void run_triangle(struct model *model, const uint32_t *packet)
{
	struct model_triangle triangle;

	model_triangle_unpack(packet, model->tile_size, &triangle);
	model_draw_triangle(model, &triangle);
}

static void run_triangle_small(struct model *model, const uint32_t *packet)
{
	struct model_triangle triangle;

	model_triangle_small_unpack(packet, &triangle);
	model_draw_small(model, &triangle);
}

/* Executes a packet that was checked. NULL: it does nothing. */
static void (*const run[])(struct model *model, const uint32_t *packet) = {
	[GLOSS_OP_NOP] = NULL,
	[GLOSS_OP_WRITE_MEMORY] = run_write_memory,
	[GLOSS_OP_READ_MEMORY] = run_read_memory,
	[GLOSS_OP_COUNTERS] = run_counters,
	[GLOSS_OP_COLOUR_SURFACE] = run_colour_surface,
	[GLOSS_OP_DEPTH_SURFACE] = run_depth_surface,
	[GLOSS_OP_TILE_BEGIN] = run_tile_begin,
	[GLOSS_OP_TILE_END] = run_tile_end,
	[GLOSS_OP_DEPTH_STATE] = run_depth_state,
	[GLOSS_OP_COLOUR_MASK] = run_colour_mask,
	[GLOSS_OP_SCISSOR] = run_scissor,
	[GLOSS_OP_TRIANGLE] = run_triangle,
	[GLOSS_OP_TRIANGLE_SMALL] = run_triangle_small,
};

int model_init(struct model *model, int tile_size, void *memory, size_t memory_size)
{
	if (tile_size != 32 && tile_size != 64)
		return -EINVAL;
	memset(model, 0, sizeof(*model));
	model->tile_size = tile_size;
	model->memory = memory;
	model->memory_size = memory_size;
	return 0;
}

static bool slot_valid(const struct model *model, const struct gloss_slot *slot)
{
	return !slot->size ||
	       (slot->base % 4096 == 0 && (uint64_t)slot->base + slot->size <= model->memory_size);
}

static bool slots_valid(const struct model *model, const struct accel_job *job)
{
	for (unsigned int n = 0; n < GLOSS_SLOTS; n++)
		if (!slot_valid(model, &job->slot[n]))
			return false;
	return true;
}

/* What every job starts from. */
int model_begin(struct model *model, const struct accel_job *job)
{
	if (!slots_valid(model, job))
		return -EINVAL;
	model->job = job;
	model->at = 0;
	model->stream_from = 0;
	model->response_from = 0;
	model->fault = GLOSS_FAULT_NONE;
	model->fault_word = 0;
	model->state = (struct model_state){
		.depth_func = GLOSS_COMPARE_ALWAYS,
		.depth_write = false,
		.colour_mask = 0xffffffffu,
		.scissor = { 0, 0, model->tile_size, model->tile_size },
	};
	model->counters = (struct model_counters){ 0 };
	model->response_used = 0;
	model->in_tile = false;
	return 0;
}

int model_begin_whole(struct model *model, const struct accel_job *job)
{
	if ((job->stream_words && !job->stream) || (job->response_words && !job->response))
		return -EINVAL;
	return model_begin(model, job);
}

bool model_check_next(struct model *model)
{
	if (model->fault || model->at == model->job->stream_words)
		return false;
	model->fault = model_command_check(model, model->at, &model->fault_word);
	return !model->fault;
}

void model_execute(struct model *model, const uint32_t *packet)
{
	if (run[gloss_header_opcode(packet[0])])
		run[gloss_header_opcode(packet[0])](model, packet);
}

bool model_step(struct model *model)
{
	const uint32_t *packet;

	if (!model_check_next(model))
		return false;
	packet = model->job->stream + (model->at - model->stream_from);
	model_execute(model, packet);
	model->at += 1 + gloss_header_length(packet[0]);
	return true;
}

void model_end(struct model *model, struct gloss_status *status)
{
	if (!model->fault) {
		model->fault = model->in_tile ? GLOSS_FAULT_ORDER : GLOSS_FAULT_NONE;
		model->fault_word = 0;
	}
	model->job = NULL;
	*status = (struct gloss_status){ model->fault, model->at + model->fault_word,
					 model->response_used };
}

int model_run(struct model *model, const struct accel_job *job, struct gloss_status *status)
{
	int err = model_begin_whole(model, job);

	if (err)
		return err;
	while (model_step(model))
		;
	model_end(model, status);
	return 0;
}
