// SPDX-License-Identifier: MIT
/*
 * The jobs of grammar.h on the C model, on the Verilated core and on boards on USB, the C port's
 * and Verilated ones: status, answers, words behind the room, and all of board memory must be the
 * same. The decoder has to find the faults that it can.
 *
 * Board memory is filled once a group, so that a job finds what those before it left. A group only
 * depends on the seed and its number. A core runs job by job; a board gets a batch at once.
 */
#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "decode/decode.h"
#include "grammar_coverage.h"
#include "grammar_engine.h"
#include "model/model.h"

#define BATCH 4
#define GROUP 32
#define ENGINES 4

struct test {
	uint64_t seed, number; /* of the job */
	const char *failed;    /* where a failing stream goes */
	struct model model;
	uint8_t *memory; /* the model's */
	struct grammar grammar;
	struct grammar_result expected[BATCH], result;
	struct grammar_engine engine[ENGINES]; /* the C port first */
	uint32_t engines;
	struct grammar_coverage coverage;
};

/* In so many jobs each opcode and each reserved bit has its turn; whole groups. */
static uint64_t covering(void)
{
	uint64_t turns = grammar_reserved_bits() > 256 ? grammar_reserved_bits() : 256;
	uint64_t jobs = 0;

	while (grammar_turn(jobs, GRAMMAR_OPCODE) < turns ||
	       grammar_turn(jobs, GRAMMAR_RESERVED) < turns)
		jobs += GROUP;
	return jobs;
}

/* Says how to see it again, and leaves the stream for gloss-decode. */
static int fail(const struct test *test, uint64_t number, const char *engine, const char *what)
{
	static struct grammar g;
	FILE *file = fopen(test->failed, "wb");

	fprintf(stderr, "test_grammar: job %" PRIu64 ", %s: %s\n", number, engine, what);
	fprintf(stderr, "repeat: GLOSS_SEED=%" PRIu64 " test_grammar -g %" PRIu64 " -n %d",
		test->seed, number / GROUP, GROUP);
	for (uint32_t n = 1; n < test->engines; n++)
		fprintf(stderr, " %s", test->engine[n].name);
	fprintf(stderr, "\n");
	grammar_make(&g, test->seed, number, test->grammar.tile_size);
	if (file && fwrite(g.words, 4, g.job.stream_words, file) == g.job.stream_words)
		fprintf(stderr, "see: gloss-decode --tile %u %s\n", g.tile_size, test->failed);
	if (file)
		fclose(file);
	return 1;
}

/* ---- comparing ---- */

static int compare_memory(const struct test *test, uint64_t number,
			  const struct grammar_engine *engine)
{
	char what[96];
	uint32_t n = 0;

	if (!memcmp(test->memory, engine->memory, GRAMMAR_MEMORY))
		return 0;
	while (test->memory[n] == engine->memory[n])
		n++;
	snprintf(what, sizeof(what), "memory at 0x%x is %02x, the model's %02x", n,
		 engine->memory[n], test->memory[n]);
	return fail(test, number, engine->name, what);
}

static int compare(const struct test *test, uint64_t number, const struct grammar_engine *engine,
		   const struct grammar_result *model)
{
	const struct grammar_result *other = &test->result;
	char what[160];
	uint32_t n = 0;

	if (other->status.cause != model->status.cause ||
	    other->status.offset != model->status.offset ||
	    other->status.response_words != model->status.response_words) {
		snprintf(what, sizeof(what), "%s at %u, %u answered; the model: %s at %u, %u",
			 decode_fault_name(other->status.cause), other->status.offset,
			 other->status.response_words, decode_fault_name(model->status.cause),
			 model->status.offset, model->status.response_words);
		return fail(test, number, engine->name, what);
	}
	if (!memcmp(other->response, model->response, sizeof(model->response)))
		return 0;
	while (other->response[n] == model->response[n])
		n++;
	snprintf(what, sizeof(what), "response word %u is %08x, the model's %08x", n,
		 other->response[n], model->response[n]);
	return fail(test, number, engine->name, what);
}

/* What the generator knows of the end of a job. */
static int check_expected(const struct test *test, const struct gloss_status *status)
{
	const struct grammar *g = &test->grammar;
	uint32_t turn = (uint32_t)(grammar_turn(test->number, g->kind) % 256), count;
	const struct table_packet *packet = grammar_packets(&count);

	if (g->kind == GRAMMAR_SOUND && status->cause)
		return fail(test, test->number, "the model", "a job without a fault has one");
	if (g->kind == GRAMMAR_RESERVED &&
	    (status->cause != GLOSS_FAULT_VALUE || status->offset != g->damaged_at))
		return fail(test, test->number, "the model", "a reserved bit is not its VALUE");
	while (count && packet->opcode != turn)
		count--, packet++;
	if (g->kind == GRAMMAR_OPCODE && !count &&
	    (status->cause != GLOSS_FAULT_OPCODE || status->offset != g->damaged_at))
		return fail(test, test->number, "the model", "an unknown opcode is not its OPCODE");
	return 0;
}

/* What a stream shows without its slots and the room for answers, the decoder finds too. */
static int check_decoder(const struct test *test, const struct gloss_status *status)
{
	const struct grammar *g = &test->grammar;
	struct decode_packet last;
	bool agrees;

	decode_stream(g->words, g->job.stream_words, g->tile_size, &last);
	if (status->cause == GLOSS_FAULT_SLOT || status->cause == GLOSS_FAULT_RESPONSE)
		agrees = !last.fault || last.fault_offset > status->offset;
	else
		agrees = last.fault == status->cause &&
			 (!last.fault || last.fault_offset == status->offset);
	return agrees ? 0 : fail(test, test->number, "gloss-decode", "not the model's fault");
}

/* ---- running ---- */

static int run_cores(struct test *test, const struct grammar_result *model)
{
	for (uint32_t n = 0; n < test->engines; n++) {
		struct grammar_engine *engine = &test->engine[n];
		uint64_t stalls = test->number % 8 ?
					  test->seed ^ (test->number * 0x9e3779b97f4a7c15) :
					  0;
		const char *wrong;

		if (grammar_engine_is_board(engine))
			continue;
		grammar_result_clear(&test->result);
		wrong = grammar_engine_run(engine, &test->grammar, stalls, &test->result);
		if (wrong)
			return fail(test, test->number, engine->name, wrong);
		if (compare(test, test->number, engine, model) ||
		    compare_memory(test, test->number, engine))
			return 1;
	}
	return 0;
}

static int run_job(struct test *test, struct grammar_result *model)
{
	struct grammar *g = &test->grammar;

	grammar_make(g, test->seed, test->number, g->tile_size);
	grammar_result_clear(model);
	g->job.response = model->response;
	if (model_run(&test->model, &g->job, &model->status))
		return fail(test, test->number, "the model", "it takes this for no job");
	grammar_coverage_add(&test->coverage, g, &model->status);
	for (uint32_t n = 0; n < test->engines; n++)
		if (grammar_engine_is_board(&test->engine[n]))
			grammar_engine_queue(&test->engine[n], g, (uint32_t)test->number);
	return check_expected(test, &model->status) || check_decoder(test, &model->status) ||
	       run_cores(test, model);
}

static int check_board(struct test *test, struct grammar_engine *board, uint64_t first)
{
	const char *wrong = grammar_engine_send(board);

	if (wrong)
		return fail(test, first, board->name, wrong);
	for (uint32_t n = 0; n < BATCH; n++) {
		grammar_result_clear(&test->result);
		wrong = grammar_engine_answer(board, (uint32_t)(first + n), &test->result);
		if (wrong)
			return fail(test, first + n, board->name, wrong);
		if (compare(test, first + n, board, &test->expected[n]))
			return 1;
	}
	if (!usb_host_empty(&board->usb))
		return fail(test, first, board->name, "it says more than it was asked");
	return compare_memory(test, first, board);
}

static int run_batch(struct test *test)
{
	uint64_t first = test->number;

	for (uint32_t n = 0; n < BATCH; n++, test->number++)
		if (run_job(test, &test->expected[n]))
			return 1;
	for (uint32_t n = 0; n < test->engines; n++)
		if (grammar_engine_is_board(&test->engine[n]) &&
		    check_board(test, &test->engine[n], first))
			return 1;
	return 0;
}

static int begin_group(struct test *test)
{
	struct grammar *g = &test->grammar;

	g->state = test->seed ^ (test->number << 32);
	for (uint32_t n = 0; n < GRAMMAR_MEMORY; n++)
		test->memory[n] = (uint8_t)grammar_random(g);
	for (uint32_t n = 0; n < test->engines; n++) {
		struct grammar_engine *engine = &test->engine[n];
		uint64_t seed = (uint64_t)grammar_random(g) << 32 | grammar_random(g);
		const char *wrong = NULL;

		memcpy(engine->memory, test->memory, GRAMMAR_MEMORY);
		if (grammar_engine_is_board(engine))
			wrong = grammar_engine_begin(engine, seed);
		if (wrong)
			return fail(test, test->number, engine->name, wrong);
	}
	return 0;
}

static int run(struct test *test, uint64_t first, uint64_t jobs)
{
	int failed = 0;

	test->number = first * GROUP;
	while (!failed && test->number < first * GROUP + jobs) {
		if (test->number % GROUP == 0)
			failed = begin_group(test);
		if (!failed)
			failed = run_batch(test);
	}
	return failed;
}

/* ---- from the beginning to the end ---- */

/* False: it was said why not. */
static bool setup(struct test *test, int count, char **plugins)
{
	if (count < 1 || count >= ENGINES) {
		fprintf(stderr,
			"usage: test_grammar [-n JOBS] [-g FIRST] [-o FAILED] PLUGIN...\n"
			"PLUGIN: a core or a USB board, up to %d, all of one tile size\n",
			ENGINES - 1);
		return false;
	}
	for (int n = 0; n < count; n++, test->engines++)
		if (!grammar_engine_init(&test->engine[1 + n], plugins[n], 0))
			return false;
	test->grammar.tile_size = test->engine[1].tile_size;
	if (!grammar_engine_init(&test->engine[0], NULL, test->grammar.tile_size))
		return false;
	test->engines++;
	for (uint32_t n = 1; n < test->engines; n++)
		if (test->engine[n].tile_size != test->grammar.tile_size) {
			fprintf(stderr, "test_grammar: %s has another tile size\n",
				test->engine[n].name);
			return false;
		}
	test->memory = malloc(GRAMMAR_MEMORY);
	return test->memory && !model_init(&test->model, (int)test->grammar.tile_size, test->memory,
					   GRAMMAR_MEMORY);
}

static void teardown(struct test *test)
{
	for (uint32_t n = 0; n < ENGINES; n++)
		if (test->engine[n].memory)
			grammar_engine_fini(&test->engine[n]);
	free(test->memory);
}

static int report(const struct test *test, uint64_t jobs)
{
	printf("test_grammar: %" PRIu64 " jobs, T=%u, on the model, %s", jobs,
	       test->grammar.tile_size, test->engine[0].name);
	for (uint32_t n = 1; n < test->engines; n++)
		printf(", a %s of K=%u",
		       grammar_engine_is_board(&test->engine[n]) ? "USB board" : "core",
		       test->engine[n].pixels_per_clock);
	printf("\n");
	grammar_coverage_print(&test->coverage);
	return jobs >= covering() && !grammar_coverage_check(&test->coverage);
}

int main(int argc, char **argv)
{
	static struct test test;
	const char *seed = getenv("GLOSS_SEED");
	uint64_t first = 0, jobs = covering();
	int option, failed = 1;

	test.failed = "failed-grammar.bin";
	test.seed = seed && *seed ? strtoull(seed, NULL, 0) : (uint64_t)time(NULL);
	while ((option = getopt(argc, argv, "n:g:o:")) >= 0) {
		if (option == 'n')
			jobs = strtoull(optarg, NULL, 0);
		else if (option == 'g')
			first = strtoull(optarg, NULL, 0);
		else if (option == 'o')
			test.failed = optarg;
		else
			return 2;
	}
	printf("seed %" PRIu64 " (GLOSS_SEED=%" PRIu64 " repeats this run)\n", test.seed,
	       test.seed);
	if (setup(&test, argc - optind, argv + optind))
		failed = run(&test, first, jobs);
	if (!failed)
		failed = report(&test, jobs);
	teardown(&test);
	return failed;
}
