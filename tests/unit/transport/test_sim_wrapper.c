/* SPDX-License-Identifier: MIT */
/* What sim_wrapper.cpp makes of a core that does one thing wrong: bad_core.sv. */
#include <dlfcn.h>

#include "accel_test.h"
#include "sim/sim.h"

#define LIMIT 100000u
#define SIZE 8192u

/* What the core does wrong, as there. */
enum {
	NOTHING,
	HANG,
	AR_CROSS,
	AW_CROSS,
	LAST_EARLY,
	LAST_NEVER,
	AW_CHANGE,
	AW_DROP,
	W_CHANGE,
	AR_CHANGE,
	RESPONSE_CHANGE,
	STATUS_CHANGE,
	COUNT_NONE,
	COUNT_MORE,
	STATUS_FEWER,
	STREAM_LEFT,
	WRITE_LEFT,
	READ_EARLY,
	BYTES = 256
};

static const struct gloss_sim_ops *ops;
static struct gloss_sim *sim;
static uint32_t memory[SIZE / 4], response[4];
static struct gloss_status status;
static struct gloss_sim_clocks clocks;

static int setup(void **state)
{
	uint32_t i;

	(void)state;
	for (i = 0; i < SIZE / 4; i++)
		memory[i] = i;
	memset(response, 0, sizeof(response));
	sim = ops->create(memory, SIZE);
	return sim ? 0 : -1;
}

static int teardown(void **state)
{
	(void)state;
	ops->destroy(sim);
	return 0;
}

static int run(uint32_t wrong, uint32_t base, uint32_t response_words, uint64_t limit)
{
	const uint32_t stream[] = { wrong, 11, 12 };
	const struct accel_job job = {
		.stream = stream,
		.stream_words = 3,
		.response = response,
		.response_words = response_words,
		.slot = { { .base = base, .size = 4096, .rights = GLOSS_RIGHTS_READ_WRITE } },
	};

	return ops->run(sim, &job, limit, &status, &clocks);
}

static void assert_works(void)
{
	assert_int_equal(run(NOTHING, 4096, 4, LIMIT), 0);
	assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	assert_int_equal(status.offset, 3);
	assert_int_equal(status.response_words, 4);
	assert_int_equal(response[0], 0);
	assert_int_equal(response[1], 256);
	assert_int_equal(response[2], 1026);
	assert_int_equal(response[3], 1027);
	assert_int_equal(memory[1024], 0);
	assert_int_equal(memory[1025], 256);
	assert_true(clocks.clocks > 12 && clocks.clocks < LIMIT);
}

static void a_core_that_does_nothing_wrong_works(void **state)
{
	uint64_t seed;

	(void)state;
	assert_works();
	for (seed = 1; seed < 50; seed++) {
		ops->stalls(sim, seed);
		assert_works();
	}
	ops->stalls(sim, 0);
	assert_works();
}

static void only_strobed_bytes_are_written(void **state)
{
	(void)state;
	memory[1025] = 0x12345678;
	assert_int_equal(run(BYTES, 4096, 4, LIMIT), 0);
	assert_int_equal(memory[1025], 0x12340278);
}

static void memory_ends_with_an_error(void **state)
{
	(void)state;
	assert_int_equal(run(NOTHING, SIZE - 4096, 4, LIMIT), 0);
	assert_int_equal(status.cause, GLOSS_FAULT_NONE);
	assert_int_equal(run(NOTHING, SIZE, 4, LIMIT), 0);
	assert_int_equal(status.cause, GLOSS_FAULT_MEMORY);
	assert_int_equal(response[0], 0);
	assert_int_equal(run(NOTHING, 0xfffff000, 4, LIMIT), 0);
	assert_int_equal(status.cause, GLOSS_FAULT_MEMORY);
	assert_works();
}

static void what_is_read_before_its_write_is_answered_is_old(void **state)
{
	(void)state;
	assert_int_equal(run(READ_EARLY, 4096, 4, LIMIT), 0);
	assert_int_equal(response[0], 1024);
	assert_int_equal(response[1], 1025);
	assert_int_equal(memory[1024], READ_EARLY);
}

static void a_core_that_hangs_is_reset(void **state)
{
	(void)state;
	assert_int_equal(run(HANG, 4096, 4, LIMIT), -ETIME);
	assert_works();
	assert_int_equal(run(NOTHING, 4096, 4, 20), -ETIME);
	assert_works();
	/* Nothing moves, so there is no need to wait for the limit. */
	assert_int_equal(run(HANG, 4096, 4, UINT64_MAX), -ETIME);
	assert_works();
}

static void a_broken_rule_is_named_and_the_core_reset(void **state)
{
	static const struct {
		uint32_t wrong;
		const char *violation;
	} cases[] = {
		{ AR_CROSS, "a burst crosses a 4 KiB boundary" },
		{ AW_CROSS, "a burst crosses a 4 KiB boundary" },
		{ LAST_EARLY, "WLAST is not at the burst's last beat" },
		{ LAST_NEVER, "WLAST is not at the burst's last beat" },
		{ COUNT_NONE, "a response beat of no words, or of too many" },
		{ COUNT_MORE, "a response beat of no words, or of too many" },
		{ STATUS_FEWER, "the response had another length than the status says" },
		{ STREAM_LEFT, "the status came before the end of the stream" },
		{ WRITE_LEFT, "the status came before the end of a memory transfer" },
	};
	size_t i;

	(void)state;
	for (i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		assert_int_equal(run(cases[i].wrong, 4096, 4, LIMIT), -EPROTO);
		assert_string_equal(ops->violation(sim), cases[i].violation);
		assert_works();
	}
}

static void a_response_past_its_room_is_not_stored(void **state)
{
	(void)state;
	response[3] = 77;
	assert_int_equal(run(NOTHING, 4096, 3, LIMIT), -EPROTO);
	assert_string_equal(ops->violation(sim), "more response words than there is room for");
	assert_int_equal(response[3], 77);
	assert_works();
}

/* These show only when the port stalls: for some seed it does. */
static void what_waits_must_not_change(void **state)
{
	static const struct {
		uint32_t wrong;
		const char *violation;
	} cases[] = {
		{ AW_CHANGE, "AW changed before it was taken" },
		{ AW_DROP, "AW changed before it was taken" },
		{ W_CHANGE, "W changed before it was taken" },
		{ AR_CHANGE, "AR changed before it was taken" },
		{ RESPONSE_CHANGE, "the response changed before it was taken" },
		{ STATUS_CHANGE, "the status changed before it was taken" },
	};
	size_t i;

	(void)state;
	for (i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		uint64_t seed = 0;

		do {
			ops->stalls(sim, ++seed);
			assert_true(seed < 100);
		} while (!run(cases[i].wrong, 4096, 4, LIMIT));
		assert_string_equal(ops->violation(sim), cases[i].violation);
		assert_works();
	}
}

#define wrapper_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		wrapper_test(a_core_that_does_nothing_wrong_works),
		wrapper_test(only_strobed_bytes_are_written),
		wrapper_test(memory_ends_with_an_error),
		wrapper_test(what_is_read_before_its_write_is_answered_is_old),
		wrapper_test(a_core_that_hangs_is_reset),
		wrapper_test(a_broken_rule_is_named_and_the_core_reset),
		wrapper_test(a_response_past_its_room_is_not_stored),
		wrapper_test(what_waits_must_not_change),
	};
	const char *path = getenv("BAD_CORE");
	void *plugin = path ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;

	ops = plugin ? dlsym(plugin, GLOSS_SIM_SYMBOL) : NULL;
	if (!ops) {
		fprintf(stderr, "BAD_CORE names no plugin: see libaccel.mk\n");
		return 77;
	}
	return cmocka_run_group_tests(tests, NULL, NULL);
}
