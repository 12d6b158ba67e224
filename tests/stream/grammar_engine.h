/* SPDX-License-Identifier: MIT */
/*
 * Those that are to do what the C model does: the Verilated core, and boards on USB, Verilated or
 * the C port's. A board gets some jobs at once and answers them later.
 */
#ifndef TESTS_STREAM_GRAMMAR_ENGINE_H
#define TESTS_STREAM_GRAMMAR_ENGINE_H

#include "grammar.h"
#include "sim/sim.h"
#include "usb_host.h"

/* Words behind the most room there is; none of them may be touched. */
#define GRAMMAR_BEHIND 64

struct grammar_result {
	struct gloss_status status;
	uint32_t response[GRAMMAR_RESPONSE + GRAMMAR_BEHIND];
};

struct grammar_engine {
	const char *name;
	uint32_t tile_size, pixels_per_clock;
	uint8_t *memory;                     /* GRAMMAR_MEMORY bytes, its own */
	const struct gloss_sim_ops *sim_ops; /* a core, or NULL: a board */
	struct gloss_sim *sim;
	struct usb_host usb;
	uint32_t nonce;
	uint64_t clocks;
};

/* Takes a plugin of either kind, or the C port's board for @tile_size if @plugin is NULL. False: it
 * was said why not. */
bool grammar_engine_init(struct grammar_engine *engine, const char *plugin, uint32_t tile_size);
void grammar_engine_fini(struct grammar_engine *engine);

static inline bool grammar_engine_is_board(const struct grammar_engine *engine)
{
	return !engine->sim_ops;
}

/* What is in @result before a job runs. */
void grammar_result_clear(struct grammar_result *result);

/* These return what went wrong, or NULL. */

/* A board: a reset, so that it takes jobs in pieces that follow from @seed. */
const char *grammar_engine_begin(struct grammar_engine *engine, uint64_t seed);
/* A core: runs the job of @g, with stalls that follow from @seed unless it is 0. */
const char *grammar_engine_run(struct grammar_engine *engine, struct grammar *g, uint64_t seed,
			       struct grammar_result *result);
/* A board: to be sent with others; sends them; the next answer. */
void grammar_engine_queue(struct grammar_engine *engine, const struct grammar *g,
			  uint32_t sequence);
const char *grammar_engine_send(struct grammar_engine *engine);
const char *grammar_engine_answer(struct grammar_engine *engine, uint32_t sequence,
				  struct grammar_result *result);

#endif
