// SPDX-License-Identifier: MIT
#include "grammar_engine.h"

#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define UNTOUCHED 0xa5a5a5a5u

static bool init_core(struct grammar_engine *engine, const struct gloss_sim_ops *ops)
{
	if (ops->abi != GLOSS_SIM_ABI || ops->version != GLOSS_VERSION)
		return false;
	engine->sim_ops = ops;
	engine->tile_size = ops->tile_size;
	engine->pixels_per_clock = ops->pixels_per_clock;
	engine->sim = ops->create(engine->memory, GRAMMAR_MEMORY);
	return engine->sim;
}

static bool init_board(struct grammar_engine *engine, const struct gloss_usb_board_ops *ops)
{
	if (ops->abi != GLOSS_USB_BOARD_ABI || ops->version != GLOSS_VERSION)
		return false;
	engine->tile_size = ops->tile_size;
	engine->pixels_per_clock = ops->pixels_per_clock;
	return usb_host_init(&engine->usb, ops, engine->memory, GRAMMAR_MEMORY);
}

static bool init_plugin(struct grammar_engine *engine, const char *path)
{
	void *plugin = dlopen(path, RTLD_NOW | RTLD_LOCAL);
	const void *core = plugin ? dlsym(plugin, GLOSS_SIM_SYMBOL) : NULL;
	const void *board = plugin ? dlsym(plugin, GLOSS_USB_BOARD_SYMBOL) : NULL;

	if (core)
		return init_core(engine, core);
	return board && init_board(engine, board);
}

bool grammar_engine_init(struct grammar_engine *engine, const char *plugin, uint32_t tile_size)
{
	bool done;

	*engine = (struct grammar_engine){ .name = plugin ? plugin : "the C port" };
	engine->memory = malloc(GRAMMAR_MEMORY);
	if (!engine->memory)
		done = false;
	else if (plugin)
		done = init_plugin(engine, plugin);
	else
		done = init_board(engine, tile_size == 32 ? &gloss_usb_board_model_t32 :
							    &gloss_usb_board_model_t64);
	if (!done) {
		fprintf(stderr, "test_grammar: %s is no core and no USB board of this tree\n",
			engine->name);
		free(engine->memory);
		engine->memory = NULL;
	}
	return done;
}

void grammar_engine_fini(struct grammar_engine *engine)
{
	if (engine->sim)
		engine->sim_ops->destroy(engine->sim);
	else
		usb_host_fini(&engine->usb);
	free(engine->memory);
}

void grammar_result_clear(struct grammar_result *result)
{
	for (uint32_t n = 0; n < GRAMMAR_RESPONSE + GRAMMAR_BEHIND; n++)
		result->response[n] = UNTOUCHED;
}

/* Generous: each word and each tile many times over, as stalls make it. */
static uint64_t bound(const struct grammar *g)
{
	uint64_t packets = 1, rows = g->tile_size * g->tile_size;

	for (uint32_t at = 0; at < g->job.stream_words; packets++)
		at += 1 + gloss_header_length(g->words[at]);
	return 20 * (1000 + 8ull * g->job.stream_words + 4ull * g->job.response_words +
		     packets * (4 * rows + 8ull * GLOSS_LENGTH_MAX));
}

const char *grammar_engine_run(struct grammar_engine *engine, struct grammar *g, uint64_t seed,
			       struct grammar_result *result)
{
	struct gloss_sim_clocks clocks;
	int err;

	g->job.response = result->response;
	engine->sim_ops->stalls(engine->sim, seed);
	err = engine->sim_ops->run(engine->sim, &g->job, bound(g), &result->status, &clocks);
	if (err == -ETIME)
		return "the job did not end in the clocks it may take";
	if (err)
		return engine->sim_ops->violation(engine->sim);
	engine->clocks += clocks.clocks;
	return NULL;
}

const char *grammar_engine_begin(struct grammar_engine *engine, uint64_t seed)
{
	engine->nonce = (uint32_t)seed | 1;
	engine->usb.offer = seed % 3 ? 1 + (uint32_t)(seed >> 8) % 600 : ~0u;
	engine->usb.take = seed % 5 ? 1 + (uint32_t)(seed >> 20) % 600 : 65536;
	if (!usb_host_reset(&engine->usb, engine->nonce))
		return "the reset does not end";
	usb_host_sync(&engine->usb, engine->nonce);
	if (!usb_host_run(&engine->usb) || !usb_host_echo(&engine->usb, engine->nonce))
		return "no echo";
	return NULL;
}

void grammar_engine_queue(struct grammar_engine *engine, const struct grammar *g, uint32_t sequence)
{
	usb_host_job(&engine->usb, &g->job, g->slots, sequence);
}

const char *grammar_engine_send(struct grammar_engine *engine)
{
	return usb_host_run(&engine->usb) ? NULL : "the jobs do not end";
}

const char *grammar_engine_answer(struct grammar_engine *engine, uint32_t sequence,
				  struct grammar_result *result)
{
	struct usb_host *usb = &engine->usb;

	if (!usb_host_answer(usb))
		return "no answer that is right in itself";
	if (usb->completion.sequence != sequence)
		return "the answer is another job's";
	if (usb->response.count > GRAMMAR_RESPONSE)
		return "the answer is longer than any";
	memcpy(result->response, usb->response.word, 4 * (size_t)usb->response.count);
	result->status = (struct gloss_status){
		.cause = usb->completion.cause,
		.offset = usb->completion.offset,
		.response_words = usb->completion.response_words,
	};
	return NULL;
}
