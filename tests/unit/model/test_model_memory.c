// SPDX-License-Identifier: MIT
/*
 * No job reaches outside its slots. All of memory that a job may not write must
 * be as it was; under AddressSanitizer what it may not read is poisoned too.
 */
#include "accel_test.h"
#include "model/model.h"
#include "stream_random.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(address, size) ((void)(address), (void)(size))
#define ASAN_UNPOISON_MEMORY_REGION(address, size) ((void)(address), (void)(size))
#endif

#define CANARY 0x5ca1ab1e

struct memory_test {
	struct model model;
	struct stream_random random;
	uint8_t memory[STREAM_RANDOM_MEMORY], before[STREAM_RANDOM_MEMORY];
	uint32_t response[STREAM_RANDOM_RESPONSE + 128];
};

static int setup(void **state)
{
	*state = malloc(sizeof(struct memory_test));
	return *state ? 0 : -1;
}

static int teardown(void **state)
{
	free(*state);
	return 0;
}

/* Only what some slot lets the job read or write may be touched at all. */
static void poison(struct memory_test *t)
{
	ASAN_POISON_MEMORY_REGION(t->memory, sizeof(t->memory));
	for (int n = 0; n < (int)GLOSS_SLOTS; n++)
		if (t->random.job.slot[n].rights)
			ASAN_UNPOISON_MEMORY_REGION(t->memory + t->random.job.slot[n].base,
						    t->random.job.slot[n].size);
}

/* Makes memory as before wherever the job may have written: the rest must be so by itself. */
static void forget_writes(struct memory_test *t)
{
	for (int n = 0; n < (int)GLOSS_SLOTS; n++) {
		const struct gloss_slot *slot = &t->random.job.slot[n];

		if (slot->rights & GLOSS_RIGHTS_WRITE)
			memcpy(t->memory + slot->base, t->before + slot->base, slot->size);
	}
}

static void run_job(struct memory_test *t, uint64_t seed)
{
	struct gloss_status status;

	t->random.job.response = t->response;
	for (size_t n = 0; n < sizeof(t->response) / 4; n++)
		t->response[n] = CANARY;
	stream_random_memory(t->memory, sizeof(t->memory), seed);
	memcpy(t->before, t->memory, sizeof(t->memory));
	poison(t);
	assert_int_equal(model_run(&t->model, &t->random.job, &status), 0);
	ASAN_UNPOISON_MEMORY_REGION(t->memory, sizeof(t->memory));
	forget_writes(t);
	assert_memory_equal(t->memory, t->before, sizeof(t->memory));
	assert_true(status.response_words <= t->random.job.response_words);
	assert_true(status.offset <= t->random.job.stream_words);
	for (size_t n = status.response_words; n < sizeof(t->response) / 4; n++)
		assert_int_equal(t->response[n], CANARY);
}

static void random_jobs_stay_in_their_slots(void **state)
{
	struct memory_test *t = *state;
	uint64_t seed = test_seed();

	for (int n = 0; n < 400; n++, seed++) {
		int tile_size = n % 2 ? 32 : 64;

		model_init(&t->model, tile_size, t->memory, sizeof(t->memory));
		stream_random_valid(&t->random, seed, tile_size);
		run_job(t, seed);
		stream_random_damage(&t->random);
		run_job(t, seed);
	}
}

/* Packets with random fields, so that most of them are faults of their own. */
static void random_words_stay_in_their_slots(void **state)
{
	static const uint32_t opcodes[] = { 0x00, 0x01, 0x02, 0x03, 0x08, 0x09,
					    0x10, 0x11, 0x20, 0x21, 0x22, 0x30 };
	struct memory_test *t = *state;
	uint64_t seed = test_seed();

	model_init(&t->model, 64, t->memory, sizeof(t->memory));
	for (int n = 0; n < 400; n++) {
		stream_random_valid(&t->random, seed, 64);
		for (uint32_t w = 0; w < t->random.job.stream_words; w++) {
			uint32_t opcode = opcodes[test_below(&seed, 12)];

			if (test_below(&seed, 8) == 0)
				t->random.words[w] = (uint32_t)test_random(&seed) >> 8 >>
							     test_below(&seed, 24) |
						     opcode << 24;
		}
		run_job(t, seed);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(random_jobs_stay_in_their_slots, setup, teardown),
		cmocka_unit_test_setup_teardown(random_words_stay_in_their_slots, setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
