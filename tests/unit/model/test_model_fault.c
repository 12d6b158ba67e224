// SPDX-License-Identifier: MIT
/*
 * Every fault and the word it is reported at, one check before another, and what
 * is left of a job after its fault: what came before, and nothing else.
 */
#include "fault_cases.h"
#include "model_test.h"
#include "stream_random.h"

#define TILE_BYTES (64u * 256u)

static void default_slots(struct model_test *t)
{
	memset(t->job.slot, 0, sizeof(t->job.slot));
	set_slot(t, WHOLE, 4096, TILE_BYTES, GLOSS_RIGHTS_READ_WRITE);
	set_slot(t, READ, 4096, TILE_BYTES, GLOSS_RIGHTS_READ);
	set_slot(t, WRITE, 4096, TILE_BYTES, GLOSS_RIGHTS_WRITE);
	set_slot(t, SMALL, 4096, 100, GLOSS_RIGHTS_READ_WRITE);
	set_slot(t, ODD, 4096, 103, GLOSS_RIGHTS_READ_WRITE);
	set_slot(t, LATE, 4096, TILE_BYTES - 4, GLOSS_RIGHTS_READ_WRITE);
}

/* The case's words, between a write and others that must and must not happen. */
static uint32_t put_case(struct model_test *t, const struct fault_case *c, bool more)
{
	uint32_t first;

	t->job.stream_words = 0;
	put_write_memory(t, WHOLE, 0x100, 1);
	put(t, 0x600d);
	first = t->job.stream_words;
	for (size_t n = 0; n < c->count; n++)
		put(t, c->words[n]);
	if (more) {
		put_write_memory(t, WHOLE, 0x104, 1);
		put(t, 0xbad);
		put_counters(t);
	}
	return first;
}

static bool needs_the_end(const struct fault_case *c)
{
	return c->fault == GLOSS_FAULT_LENGTH || strstr(c->name, "end in a tile");
}

static void run_case(const struct fault_case *c, bool more)
{
	struct model_test *t = model_test_new(c->tile_size ? c->tile_size : 64);
	uint32_t first;

	default_slots(t);
	if (c->room)
		t->job.response_words = c->room;
	first = put_case(t, c, more);
	run(t);
	if (t->status.cause != c->fault || t->status.offset != first + c->at)
		fail_msg("%s: fault %d at word %d, not %d at %d", c->name, t->status.cause,
			 (int)(t->status.offset - first), c->fault, (int)c->at);
	for (uint32_t a = 0; a < sizeof(t->memory); a += 4)
		assert_int_equal(memory_word(t, a), a == 4096 + 0x100 ? 0x600d : 0);
	for (uint32_t n = t->status.response_words; n < MODEL_TEST_RESPONSE; n++)
		assert_int_equal(t->response[n], 0);
	assert_true(t->status.response_words <= t->job.response_words);
	free(t);
}

static void fault_is_reported_at_its_word(void **state)
{
	(void)state;
	for (size_t n = 0; n < fault_cases_count; n++)
		run_case(&fault_cases[n], false);
}

static void nothing_after_a_fault_is_executed(void **state)
{
	(void)state;
	for (size_t n = 0; n < fault_cases_count; n++)
		if (!needs_the_end(&fault_cases[n]))
			run_case(&fault_cases[n], true);
}

/* Cases that lack but one word of room. */
static void room_that_is_just_enough_is_no_fault(void **state)
{
	(void)state;
	for (size_t n = 0; n < fault_cases_count; n++) {
		struct fault_case c = fault_cases[n];
		struct model_test *t = model_test_new(c.tile_size ? c.tile_size : 64);

		if (c.fault == GLOSS_FAULT_RESPONSE && c.room > 1) {
			default_slots(t);
			t->job.response_words = c.room + 1;
			put_case(t, &c, false);
			run_whole(t);
			assert_int_equal(t->status.response_words, c.room + 1);
		}
		free(t);
	}
}

static void tile_is_dropped_at_a_fault(void **state)
{
	struct model_test *t = *state;

	default_slots(t);
	put_colour_surface(t, (struct gloss_colour_surface){ .slot = WHOLE, .pitch = 256 });
	put_tile_begin(t, (struct gloss_tile_begin){ .colour = 0x12345678 });
	put(t, 0xff000000);
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_STORE });
	run(t);
	assert_int_equal(t->status.cause, GLOSS_FAULT_OPCODE);
	for (uint32_t a = 0; a < sizeof(t->memory); a += 4)
		assert_int_equal(memory_word(t, a), 0);
}

static void answers_before_a_fault_are_valid(void **state)
{
	struct model_test *t = *state;

	put_counters(t);
	put_tile_begin(t, (struct gloss_tile_begin){ .colour = 0x12345678 });
	put_tile_end(t, (struct gloss_tile_end){ .colour_output = GLOSS_TILE_OUTPUT_ANSWER });
	put_tile_begin(t, (struct gloss_tile_begin){ 0 });
	run(t);
	assert_int_equal(t->status.cause, GLOSS_FAULT_ORDER);
	assert_int_equal(t->status.offset, 10);
	assert_int_equal(t->status.response_words, 4 + 64 * 64);
	assert_int_equal(t->response[4 + 64 * 64 - 1], 0x12345678);
}

/* A valid job gives the same on a model that ran damaged ones and on one that never ran. */
static void next_job_is_not_changed_by_a_fault(void **state)
{
	static struct stream_random damaged, valid;
	static struct model_test used, fresh;
	uint64_t seed = test_seed();

	(void)state;
	assert_int_equal(model_init(&used.model, 64, used.memory, MODEL_TEST_MEMORY), 0);
	for (int n = 0; n < 200; n++, seed++) {
		uint32_t *response = malloc(4 * STREAM_RANDOM_RESPONSE * 2 + 800);

		assert_non_null(response);
		stream_random_valid(&damaged, seed, 64);
		stream_random_damage(&damaged);
		damaged.job.response = response;
		model_run(&used.model, &damaged.job, &used.status);
		stream_random_valid(&valid, seed + 1000, 64);
		memcpy(fresh.memory, used.memory, MODEL_TEST_MEMORY);
		model_init(&fresh.model, 64, fresh.memory, MODEL_TEST_MEMORY);
		valid.job.response = response;
		model_run(&used.model, &valid.job, &used.status);
		valid.job.response = response + STREAM_RANDOM_RESPONSE + 100;
		model_run(&fresh.model, &valid.job, &fresh.status);
		assert_memory_equal(&used.status, &fresh.status, sizeof(used.status));
		assert_int_equal(used.status.cause, GLOSS_FAULT_NONE);
		assert_memory_equal(response, valid.job.response, 4 * used.status.response_words);
		assert_memory_equal(used.memory, fresh.memory, MODEL_TEST_MEMORY);
		free(response);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(fault_is_reported_at_its_word),
		cmocka_unit_test(nothing_after_a_fault_is_executed),
		cmocka_unit_test(room_that_is_just_enough_is_no_fault),
		model_test(tile_is_dropped_at_a_fault),
		model_test(answers_before_a_fault_are_valid),
		cmocka_unit_test(next_job_is_not_changed_by_a_fault),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
