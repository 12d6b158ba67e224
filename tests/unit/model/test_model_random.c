// SPDX-License-Identifier: MIT
/* The random jobs are what stream_random.h says, and the same on every machine. */
#include "accel_test.h"
#include "model/model.h"
#include "stream_random.h"

static struct model model;
static struct stream_random job, other;
static uint8_t memory[STREAM_RANDOM_MEMORY];
static uint32_t response[STREAM_RANDOM_RESPONSE + 128];

static struct gloss_status run(int tile_size)
{
	struct gloss_status status;

	job.job.response = response;
	model_init(&model, tile_size, memory, sizeof(memory));
	assert_int_equal(model_run(&model, &job.job, &status), 0);
	return status;
}

static void valid_jobs_run_to_their_end(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	for (int n = 0; n < 4000; n++) {
		struct gloss_status status;

		stream_random_valid(&job, seed + (uint64_t)n, n % 2 ? 32 : 64);
		status = run(n % 2 ? 32 : 64);
		if (status.cause)
			fail_msg("job %d: fault %d at word %u", n, status.cause, status.offset);
		assert_true(job.job.stream_words <= STREAM_RANDOM_WORDS);
		assert_true(job.job.response_words <= STREAM_RANDOM_RESPONSE + 100);
	}
}

static void damaged_jobs_have_every_fault_and_none(void **state)
{
	uint64_t seed = test_seed();
	int faults[GLOSS_FAULT_MEMORY + 1] = { 0 };

	(void)state;
	for (int n = 0; n < 4000; n++) {
		stream_random_valid(&job, seed + (uint64_t)n, 64);
		stream_random_damage(&job);
		assert_true(job.job.stream_words <= STREAM_RANDOM_WORDS);
		faults[run(64).cause]++;
	}
	for (int fault = GLOSS_FAULT_NONE; fault < GLOSS_FAULT_MEMORY; fault++)
		assert_true(faults[fault] > 40);
}

static void same_seed_gives_the_same_job(void **state)
{
	uint64_t seed = test_seed();

	(void)state;
	for (int n = 0; n < 100; n++, seed++) {
		stream_random_valid(&job, seed, 32);
		stream_random_damage(&job);
		stream_random_valid(&other, seed, 32);
		stream_random_damage(&other);
		assert_int_equal(job.job.stream_words, other.job.stream_words);
		assert_int_equal(job.job.response_words, other.job.response_words);
		assert_memory_equal(job.words, other.words, 4 * job.job.stream_words);
		assert_memory_equal(job.job.slot, other.job.slot, sizeof(job.job.slot));
	}
}

/* FNV-1a over the words of a thousand jobs; changes with the generator, not with the compiler. */
static void same_seed_gives_the_same_job_everywhere(void **state)
{
	uint64_t hash = 0xcbf29ce484222325;

	(void)state;
	for (uint64_t seed = 0; seed < 1000; seed++) {
		stream_random_valid(&job, seed, 64);
		stream_random_damage(&job);
		for (uint32_t n = 0; n < job.job.stream_words; n++)
			hash = (hash ^ job.words[n]) * 0x100000001b3;
	}
	if (hash != 0x991d51db644c6037)
		fail_msg("the jobs' hash is 0x%016llx", (unsigned long long)hash);
}

/* Every packet and every form of triangle, often; pixels that pass and that do not. */
static void jobs_use_the_whole_interface(void **state)
{
	uint64_t seed = test_seed();
	unsigned int packets[256] = { 0 }, forms[3][3][2] = { 0 }, small[3][5] = { 0 };
	uint64_t covered = 0, passed = 0, triangles = 0;

	(void)state;
	for (int n = 0; n < 1000; n++) {
		stream_random_valid(&job, seed + (uint64_t)n, 64);
		for (uint32_t at = 0; at < job.job.stream_words;) {
			uint32_t opcode = gloss_header_opcode(job.words[at]);
			struct gloss_triangle_small q;
			struct gloss_triangle p;

			packets[opcode]++;
			gloss_triangle_unpack(&job.words[at], &p);
			gloss_triangle_small_unpack(&job.words[at], &q);
			if (opcode == GLOSS_OP_TRIANGLE)
				forms[p.geometry][p.shading][p.alpha_linear]++;
			else if (opcode == GLOSS_OP_TRIANGLE_SMALL)
				small[q.shading][q.row_words]++;
			at += 1 + gloss_header_length(job.words[at]);
		}
		run(64);
		covered += model.counters.covered;
		passed += model.counters.passed;
		triangles += model.counters.triangles;
	}
	for (unsigned int opcode = 0; opcode < 256; opcode++)
		assert_true(!gloss_opcode_known(opcode) || packets[opcode] > 200);
	for (int n = 0; n < 18; n++)
		assert_true(forms[n / 6][n / 2 % 3][n % 2] > 20);
	for (int n = 0; n < 15; n++)
		assert_true(small[n / 5][n % 5] > 20);
	assert_true(passed > 50 * triangles);
	assert_true(covered - passed > 20 * triangles);
}

/* No word of the stream in memory but what a step may ask for, the answers taken away each time. */
static void run_in_steps(uint32_t *answers, struct gloss_status *status)
{
	static uint32_t stream[MODEL_PACKET_WORDS], answer[MODEL_ANSWER_WORDS];
	bool more = true;

	job.job.stream = stream;
	job.job.response = answer;
	assert_int_equal(model_begin(&model, &job.job), 0);
	while (more) {
		uint32_t words = job.job.stream_words - model.at;

		words = words < MODEL_PACKET_WORDS ? words : MODEL_PACKET_WORDS;
		memset(stream, 0xee, sizeof(stream));
		memcpy(stream, job.words + model.at, 4 * (size_t)words);
		model.stream_from = model.at;
		model.response_from = model.response_used;
		more = model_step(&model);
		memcpy(answers + model.response_from, answer,
		       4 * (size_t)(model.response_used - model.response_from));
	}
	model_end(&model, status);
}

static void jobs_in_steps_end_as_whole_ones(void **state)
{
	static uint8_t whole_memory[STREAM_RANDOM_MEMORY];
	static uint32_t answers[STREAM_RANDOM_RESPONSE + 128];
	uint64_t seed = test_seed();

	(void)state;
	for (uint64_t n = 0; n < 1000; n++) {
		int tile_size = n % 2 ? 32 : 64;
		struct gloss_status whole, steps;

		stream_random_valid(&job, seed + n, tile_size);
		if (n % 4 > 1)
			stream_random_damage(&job);
		stream_random_memory(memory, sizeof(memory), seed + n);
		whole = run(tile_size);
		memcpy(whole_memory, memory, sizeof(memory));
		stream_random_memory(memory, sizeof(memory), seed + n);
		run_in_steps(answers, &steps);
		assert_memory_equal(&whole, &steps, sizeof(whole));
		assert_memory_equal(whole_memory, memory, sizeof(memory));
		assert_memory_equal(response, answers, 4 * (size_t)whole.response_words);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(valid_jobs_run_to_their_end),
		cmocka_unit_test(damaged_jobs_have_every_fault_and_none),
		cmocka_unit_test(same_seed_gives_the_same_job),
		cmocka_unit_test(same_seed_gives_the_same_job_everywhere),
		cmocka_unit_test(jobs_use_the_whole_interface),
		cmocka_unit_test(jobs_in_steps_end_as_whole_ones),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
