// SPDX-License-Identifier: MIT
#include "pair.h"

#include <dlfcn.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "port_host.h"

#define PAGE_WORDS (GLOSS_PAGE_BYTES / 4)

uint32_t pair_below(struct pair *pair, uint32_t n)
{
	return (uint32_t)(port_host_random(&pair->random) % n);
}

int pair_differ(const struct pair *pair, const char *format, ...)
{
	va_list arguments;

	fprintf(stderr, "%s: %s: ", pair->program, pair->plugin);
	va_start(arguments, format);
	vfprintf(stderr, format, arguments);
	va_end(arguments);
	fprintf(stderr, "; repeat with GLOSS_SEED=%" PRIu64 " -n 1\n", pair->seed);
	return 1;
}

int pair_compare_bytes(const struct pair *pair, const char *what, const uint8_t *model,
		       const uint8_t *other, uint32_t bytes)
{
	for (uint32_t n = 0; n < bytes; n++)
		if (model[n] != other[n])
			return pair_differ(pair,
					   "%s differs at byte 0x%x: 0x%02x, the model's 0x%02x",
					   what, n, other[n], model[n]);
	return 0;
}

int pair_compare_memory(const struct pair *pair)
{
	return pair_compare_bytes(pair, "board memory", pair->memory[0], pair->memory[1],
				  STREAM_RANDOM_MEMORY);
}

void pair_forgive_slots(struct pair *pair, const struct gloss_slot *slot)
{
	for (uint32_t n = 0; n < GLOSS_SLOTS; n++)
		if (slot[n].rights & GLOSS_RIGHTS_WRITE)
			memcpy(pair->memory[1] + slot[n].base, pair->memory[0] + slot[n].base,
			       slot[n].size);
}

/* Too little room, a stream that ends too early, either of them at the border of half a page. */
static void cut_words(struct pair *pair, struct accel_job *job)
{
	switch (pair_below(pair, 8)) {
	case 0:
		job->response_words = pair_below(pair, job->response_words + 1);
		break;
	case 1:
		job->stream_words = pair_below(pair, job->stream_words + 1);
		break;
	case 2:
		job->response_words -= job->response_words % (PAGE_WORDS / 2);
		break;
	case 3:
		job->stream_words -= job->stream_words % (PAGE_WORDS / 2);
		break;
	}
}

void pair_make_job(struct pair *pair, uint32_t tile_size)
{
	stream_random_valid(&pair->stream, port_host_random(&pair->random), (int)tile_size);
	if (pair_below(pair, 4) == 0)
		stream_random_damage(&pair->stream);
	cut_words(pair, &pair->stream.job);
}

static int load(struct pair *pair, const struct pair_test *test)
{
	void *plugin = dlopen(pair->plugin, RTLD_NOW | RTLD_LOCAL);
	const void *ops;

	if (!plugin) {
		fprintf(stderr, "%s: %s\n", test->program, dlerror());
		return 1;
	}
	ops = dlsym(plugin, test->symbol);
	if (!ops || !test->load(pair, ops)) {
		fprintf(stderr, "%s: %s is no board of this tree\n", test->program, pair->plugin);
		return 1;
	}
	return 0;
}

static int run(struct pair *pair, const struct pair_test *test, uint64_t rounds)
{
	const char *given = getenv("GLOSS_SEED");
	uint64_t seed = given && *given ? strtoull(given, NULL, 0) : (uint64_t)time(NULL);
	int failed = 0;

	printf("GLOSS_SEED=%" PRIu64 "\n", seed);
	for (uint64_t n = 0; n < rounds && !failed; n++) {
		pair->seed = seed + n;
		pair->random = pair->seed;
		for (uint32_t side = 0; side < 2; side++)
			stream_random_memory(pair->memory[side], STREAM_RANDOM_MEMORY, pair->seed);
		failed = test->round(pair);
	}
	test->report(pair, rounds);
	return failed;
}

int pair_main(struct pair *pair, const struct pair_test *test, int argc, char **argv)
{
	uint64_t rounds = 100;
	int option, failed = 1;

	while ((option = getopt(argc, argv, "n:")) >= 0) {
		if (option != 'n')
			return 2;
		rounds = strtoull(optarg, NULL, 0);
	}
	if (optind + 1 != argc) {
		fprintf(stderr, "usage: %s [-n ROUNDS] PLUGIN\n", test->program);
		return 2;
	}
	pair->program = test->program;
	pair->plugin = argv[optind];
	for (uint32_t side = 0; side < 2; side++)
		pair->memory[side] = malloc(STREAM_RANDOM_MEMORY);
	if (pair->memory[0] && pair->memory[1] && !load(pair, test))
		failed = run(pair, test, rounds);
	for (uint32_t side = 0; side < 2; side++)
		free(pair->memory[side]);
	return failed;
}
