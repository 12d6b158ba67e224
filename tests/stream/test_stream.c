// SPDX-License-Identifier: MIT
/*
 * Whole jobs on the Verilated core and on the model: status, answers and all of board memory must
 * be the same, byte for byte, whatever the ports do, within a bound of clocks. The model draws the tiles
 * of every second job on threads.
 *
 * Jobs run in groups on one simulator: memory is filled once a group, so that a job finds what
 * those before it left, and every sixth job is a damaged one. A group only depends on the seed and
 * its number, so that a failure can be repeated alone.
 */
#include <dlfcn.h>
#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "decode/decode.h"
#include "model/model.h"
#include "sim/sim.h"
#include "stream_random.h"
#include "transport/tile_threads.h"

#define GROUP 12
#define DAMAGED_EVERY 6
#define THREADS 3 /* that draw tiles */
#define FAULTS (GLOSS_FAULT_MEMORY + 1)

struct test {
	const char *plugin, *failed; /* paths; failed is where a failing stream goes */
	const struct gloss_sim_ops *ops;
	struct gloss_sim *sim;
	struct model model;
	struct accel_tile_threads threads;
	struct stream_random random;
	uint8_t *sim_memory, *model_memory;
	uint32_t *sim_response, *model_response;
	uint64_t seed, group;

	/* What was run. */
	uint64_t valid, damaged, faults[FAULTS], clocks;
	double slowest; /* most of the bound that a job took */
};

/* Says how to repeat the failure, and leaves the stream for gloss-decode. */
static int fail(const struct test *test, int job, const char *what)
{
	const struct accel_job *j = &test->random.job;
	FILE *file = fopen(test->failed, "wb");

	fprintf(stderr, "test_stream: job %d of group %" PRIu64 ": %s\n", job, test->group, what);
	fprintf(stderr, "repeat: GLOSS_SEED=%" PRIu64 " test_stream -g %" PRIu64 " -n 1 %s\n",
		test->seed, test->group, test->plugin);
	if (file && fwrite(j->stream, 4, j->stream_words, file) == j->stream_words)
		fprintf(stderr, "see: gloss-decode --tile %u %s\n", test->ops->tile_size,
			test->failed);
	if (file)
		fclose(file);
	return 1;
}

/*
 * A generous bound without stalls: each word is read, each triangle may cover the tile, each tile
 * is loaded and stored twice over at a row each, with memory's latency for each of its bursts.
 */
static uint64_t bound(const struct test *test, const struct accel_job *job, bool stalls)
{
	uint64_t size = test->ops->tile_size, rows = size * size / test->ops->pixels_per_clock;
	uint64_t clocks = 1000 + 4ull * job->stream_words + job->response_words;

	for (uint32_t at = 0; at < job->stream_words;
	     at += 1 + gloss_header_length(job->stream[at])) {
		switch (gloss_header_opcode(job->stream[at])) {
		case GLOSS_OP_TRIANGLE:
		case GLOSS_OP_TRIANGLE_SMALL:
			clocks += rows + 3 * size + 100;
			break;
		case GLOSS_OP_TILE_BEGIN:
		case GLOSS_OP_TILE_END:
			clocks += 2 * rows + 2 * size * 8 + 200;
			break;
		case GLOSS_OP_WRITE_MEMORY:
		case GLOSS_OP_READ_MEMORY:
			clocks += 2 * GLOSS_LENGTH_MAX;
			break;
		default:
			clocks += 20;
		}
	}
	return stalls ? 20 * clocks : clocks;
}

static int run_sim(struct test *test, int job, bool stalls, struct gloss_status *status)
{
	uint64_t limit = bound(test, &test->random.job, stalls);
	struct gloss_sim_clocks clocks;
	int err;

	test->random.job.response = test->sim_response;
	err = test->ops->run(test->sim, &test->random.job, limit, status, &clocks);
	if (err == -ETIME)
		return fail(test, job, "the job did not end in the clocks it may take");
	if (err)
		return fail(test, job, test->ops->violation(test->sim));
	test->clocks += clocks.clocks;
	if (!stalls && (double)clocks.clocks / (double)limit > test->slowest)
		test->slowest = (double)clocks.clocks / (double)limit;
	return 0;
}

/* One job in its order, the next with its tiles on threads. */
static int run_model(struct test *test, int job, struct gloss_status *status)
{
	int err;

	test->random.job.response = test->model_response;
	if ((test->group + (uint64_t)job) % 2)
		err = model_run_parallel(&test->model, &test->random.job, &accel_tile_drawer,
					 &test->threads, status);
	else
		err = model_run(&test->model, &test->random.job, status);
	return err ? fail(test, job, "the model takes it for no job") : 0;
}

/* The decoder finds the faults that are in the stream itself, and no others. */
static int check_decoder(struct test *test, int job, const struct gloss_status *status)
{
	struct decode_packet last;
	enum gloss_fault fault = decode_stream(test->random.words, test->random.job.stream_words,
					       test->ops->tile_size, &last);
	bool known = status->cause != GLOSS_FAULT_SLOT && status->cause != GLOSS_FAULT_RESPONSE;

	if (known && (fault != status->cause || (fault && last.fault_offset != status->offset)))
		return fail(test, job, "gloss-decode finds another fault");
	return 0;
}

static int compare(struct test *test, int job, const struct gloss_status *sim,
		   const struct gloss_status *model)
{
	char what[128];

	if (sim->cause != model->cause || sim->offset != model->offset ||
	    sim->response_words != model->response_words) {
		snprintf(what, sizeof(what), "core: %s at %u, %u answered; model: %s at %u, %u",
			 decode_fault_name(sim->cause), sim->offset, sim->response_words,
			 decode_fault_name(model->cause), model->offset, model->response_words);
		return fail(test, job, what);
	}
	for (uint32_t n = 0; n < STREAM_RANDOM_RESPONSE; n++) {
		if (test->sim_response[n] == test->model_response[n])
			continue;
		snprintf(what, sizeof(what), "response word %u: core %08x, model %08x", n,
			 test->sim_response[n], test->model_response[n]);
		return fail(test, job, what);
	}
	if (!memcmp(test->sim_memory, test->model_memory, STREAM_RANDOM_MEMORY))
		return 0;
	for (uint32_t n = 0; n < STREAM_RANDOM_MEMORY; n++) {
		if (test->sim_memory[n] == test->model_memory[n])
			continue;
		snprintf(what, sizeof(what), "memory at %x: core %02x, model %02x", n,
			 test->sim_memory[n], test->model_memory[n]);
		return fail(test, job, what);
	}
	return 0;
}

static int run_job(struct test *test, int job, uint64_t seed)
{
	bool damage = job % DAMAGED_EVERY == DAMAGED_EVERY - 2, stalls = seed % 8 != 0;
	struct gloss_status sim, model;

	stream_random_valid(&test->random, seed, (int)test->ops->tile_size);
	if (damage)
		stream_random_damage(&test->random);
	test->ops->stalls(test->sim, stalls ? seed : 0);
	if (run_sim(test, job, stalls, &sim) || run_model(test, job, &model) ||
	    compare(test, job, &sim, &model) || check_decoder(test, job, &model))
		return 1;
	if (!damage && model.cause)
		return fail(test, job, "a valid stream has a fault");
	test->valid += !damage;
	test->damaged += damage;
	test->faults[model.cause]++;
	return 0;
}

static int run_group(struct test *test)
{
	uint64_t seed = test->seed * 0x9e3779b97f4a7c15 + test->group * 0xd1342543de82ef95;
	int failed = 0;

	stream_random_memory(test->sim_memory, STREAM_RANDOM_MEMORY, seed);
	memcpy(test->model_memory, test->sim_memory, STREAM_RANDOM_MEMORY);
	for (int job = 0; job < GROUP && !failed; job++)
		failed = run_job(test, job, seed + (uint64_t)job * 0xbf58476d1ce4e5b9);
	return failed;
}

/*
 * A slot past the end of memory is the kernel's mistake, not the stream's: the job ends with MEMORY
 * whether it reads, writes, loads or stores there, and the next one is not affected.
 */
static int memory_error_ends_job(struct test *test)
{
	static const uint32_t streams[][8] = {
		{ GLOSS_OP_READ_MEMORY << 24 | 2, 1 << 16, 0 },
		{ GLOSS_OP_WRITE_MEMORY << 24 | 3, 0, 0, 1 },
		{ GLOSS_OP_COLOUR_SURFACE << 24 | 1, 0x100 << 16,
		  GLOSS_OP_TILE_BEGIN << 24 | 1 << 11 | 2, 0, 0, GLOSS_OP_TILE_END << 24 | 2, 0,
		  0 },
		{ GLOSS_OP_DEPTH_SURFACE << 24 | 1, 0x100 << 16, GLOSS_OP_TILE_BEGIN << 24 | 2, 0,
		  0, GLOSS_OP_TILE_END << 24 | 1 << 13 | 2, 0, 0 },
	};
	static const uint32_t words[] = { 3, 4, 8, 8 };
	struct gloss_status status;

	for (int n = 0; n < 4; n++) {
		memcpy(test->random.words, streams[n], sizeof(streams[n]));
		test->random.job = (struct accel_job){
			.stream = test->random.words,
			.stream_words = words[n],
			.response_words = 1,
			.slot[0] = { STREAM_RANDOM_MEMORY, 1 << 20, GLOSS_RIGHTS_READ_WRITE },
		};
		test->ops->stalls(test->sim, 0);
		if (run_sim(test, n, false, &status))
			return 1;
		if (status.cause != GLOSS_FAULT_MEMORY || status.offset > words[n])
			return fail(test, n, "an error of memory is not the job's fault MEMORY");
		memcpy(test->model_response, test->sim_response, sizeof(*test->model_response));
		test->group = (uint64_t)n;
		if (run_group(test))
			return 1;
	}
	return 0;
}

/*
 * Found by a random job: when memory acknowledged the rows of two tiles back to back, a tile between
 * them that drops both its parts was never done, and the core hung.
 */
static int dropped_tile_between_stores_ends(struct test *test)
{
	uint32_t row = 4 * test->ops->tile_size, words = 0, *stream = test->random.words;
	struct gloss_status sim, model;

	stream[words++] = GLOSS_OP_COLOUR_SURFACE << 24 | 1;
	stream[words++] = row << 16;
	for (uint32_t tile = 0; tile < 12; tile++) {
		bool store = tile % 3 != 1;
		uint32_t packets[] = { GLOSS_OP_TILE_BEGIN << 24 | 2,
				       tile,
				       0,
				       GLOSS_OP_TILE_END << 24 | (uint32_t)store << 11 | 2,
				       0,
				       0 };

		memcpy(stream + words, packets, sizeof(packets));
		words += 6;
	}
	test->random.job = (struct accel_job){
		.stream = stream,
		.stream_words = words,
		.slot[0] = { 0, row * test->ops->tile_size, GLOSS_RIGHTS_READ_WRITE },
	};
	for (uint64_t seed = 1; seed <= 300; seed++) {
		test->ops->stalls(test->sim, seed);
		if (run_sim(test, 0, true, &sim) || run_model(test, 0, &model) ||
		    compare(test, 0, &sim, &model))
			return 1;
	}
	return 0;
}

static int load_plugin(struct test *test)
{
	void *plugin = dlopen(test->plugin, RTLD_NOW | RTLD_LOCAL);

	if (!plugin) {
		fprintf(stderr, "test_stream: %s\n", dlerror());
		return 1;
	}
	test->ops = dlsym(plugin, GLOSS_SIM_SYMBOL);
	if (!test->ops || test->ops->abi != GLOSS_SIM_ABI || test->ops->version != GLOSS_VERSION) {
		fprintf(stderr, "test_stream: %s is no plugin of this tree\n", test->plugin);
		return 1;
	}
	return 0;
}

static int setup(struct test *test)
{
	if (load_plugin(test))
		return 1;
	test->sim_memory = malloc(STREAM_RANDOM_MEMORY);
	test->model_memory = malloc(STREAM_RANDOM_MEMORY);
	test->sim_response = calloc(STREAM_RANDOM_RESPONSE, 4);
	test->model_response = calloc(STREAM_RANDOM_RESPONSE, 4);
	if (!test->sim_memory || !test->model_memory || !test->sim_response ||
	    !test->model_response)
		return 1;
	accel_tile_threads_init(&test->threads, THREADS, (int)test->ops->tile_size,
				test->model_memory, STREAM_RANDOM_MEMORY);
	test->sim = test->ops->create(test->sim_memory, STREAM_RANDOM_MEMORY);
	return !test->sim || model_init(&test->model, (int)test->ops->tile_size, test->model_memory,
					STREAM_RANDOM_MEMORY);
}

static void teardown(struct test *test)
{
	if (test->sim) {
		test->ops->destroy(test->sim);
		accel_tile_threads_fini(&test->threads);
	}
	free(test->sim_memory);
	free(test->model_memory);
	free(test->sim_response);
	free(test->model_response);
}

static void report(const struct test *test, uint64_t groups)
{
	printf("test_stream: T=%u K=%u: %" PRIu64 " valid and %" PRIu64 " damaged jobs in %" PRIu64
	       " groups, %" PRIu64 " clocks, at most %.2f of the bound; faults",
	       test->ops->tile_size, test->ops->pixels_per_clock, test->valid, test->damaged,
	       groups, test->clocks, test->slowest);
	for (unsigned int n = 1; n < GLOSS_FAULT_MEMORY; n++)
		printf(" %s %" PRIu64, decode_fault_name((enum gloss_fault)n), test->faults[n]);
	printf("\n");
}

int main(int argc, char **argv)
{
	static struct test test;
	const char *seed = getenv("GLOSS_SEED");
	uint64_t first = 0, groups = 1000;
	int option, failed;

	test.failed = "failed-stream.bin";
	test.seed = seed && *seed ? strtoull(seed, NULL, 0) : (uint64_t)time(NULL);
	while ((option = getopt(argc, argv, "n:g:o:")) >= 0) {
		if (option == 'n')
			groups = strtoull(optarg, NULL, 0);
		else if (option == 'g')
			first = strtoull(optarg, NULL, 0);
		else if (option == 'o')
			test.failed = optarg;
		else
			return 2;
	}
	if (optind + 1 != argc) {
		fprintf(stderr, "usage: test_stream [-n GROUPS] [-g FIRST] [-o FAILED] PLUGIN\n");
		return 2;
	}
	test.plugin = argv[optind];
	printf("seed %" PRIu64 " (GLOSS_SEED=%" PRIu64 " repeats this run)\n", test.seed,
	       test.seed);
	failed = setup(&test);
	for (test.group = first; !failed && test.group < first + groups; test.group++)
		failed = run_group(&test);
	if (!failed && first == 0)
		failed = memory_error_ends_job(&test) || dropped_tile_between_stores_ends(&test);
	if (!failed)
		report(&test, groups);
	teardown(&test);
	return failed;
}
