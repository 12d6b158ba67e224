/* SPDX-License-Identifier: MIT */
/* "sim:" with the Verilated core gives the bytes of "model:" on simple streams. */
#include "accel_test.h"

#define WORDS 1024u
#define RESPONSE (2 * 64 * 64 + 1024)

/* A device with a buffer of random words, and what a job answered. */
struct side {
	struct messages messages;
	struct accel_device *device;
	struct accel_stream *stream;
	struct accel_buffer *buffer;
	uint32_t response[RESPONSE], memory[WORDS];
	struct accel_fence_status status;
	int result;
};

static void side_open(struct side *side, const char *name, const uint32_t *words)
{
	side->device = device_open(name, &side->messages);
	assert_int_equal(accel_stream_new(side->device, &side->stream), 0);
	assert_int_equal(accel_buffer_new(side->device, WORDS * 4, &side->buffer), 0);
	assert_int_equal(accel_buffer_write(side->buffer, 0, words, WORDS * 4), 0);
}

static void side_close(struct side *side)
{
	accel_buffer_free(side->buffer);
	accel_stream_free(side->stream);
	accel_device_free(side->device);
}

static void side_run(struct side *side, const uint32_t *words, size_t count)
{
	struct accel_fence *fence;

	memset(side->response, 0, sizeof(side->response));
	accel_stream_slot(side->stream, side->buffer, ACCEL_SLOT_READ | ACCEL_SLOT_WRITE);
	assert_int_equal(accel_stream_emit(side->stream, words, count), 0);
	assert_int_equal(accel_stream_submit(side->stream, side->response, RESPONSE, &fence), 0);
	side->result = accel_fence_wait(fence, -1, &side->status, sizeof(side->status));
	accel_fence_free(fence);
	assert_int_equal(accel_buffer_read(side->buffer, 0, side->memory, WORDS * 4), 0);
}

static void compare(struct side *sim, struct side *model, const uint32_t *words, size_t count)
{
	side_run(sim, words, count);
	side_run(model, words, count);
	if (sim->result != model->result)
		fail_msg("the core: %d (%s); the model: %d (%s)", sim->result, sim->messages.last,
			 model->result, model->messages.last);
	assert_int_equal(sim->status.fault, model->status.fault);
	assert_int_equal(sim->status.offset, model->status.offset);
	assert_int_equal(sim->status.response_words, model->status.response_words);
	assert_memory_equal(sim->response, model->response, sizeof(model->response));
	assert_memory_equal(sim->memory, model->memory, sizeof(model->memory));
}

/* Random copies, tiles without triangles, counters; now and then a wrong slot or offset. */
static size_t random_packet(uint64_t *seed, uint32_t *words)
{
	const struct gloss_tile_begin begin = {
		.colour = (uint32_t)test_random(seed),
		.depth = (uint32_t)test_random(seed),
	};
	const struct gloss_tile_end end = {
		.colour_output = test_below(seed, 8) ? GLOSS_TILE_OUTPUT_DROP :
						       GLOSS_TILE_OUTPUT_ANSWER,
	};
	uint32_t slot = test_below(seed, 200) == 0, count = 1 + test_below(seed, 40), i;
	uint32_t offset = test_below(seed, WORDS - 40 + (test_below(seed, 100) == 0) * 60) * 4;

	switch (test_below(seed, 4)) {
	case 0:
		gloss_tile_begin_pack(words, &begin);
		gloss_tile_end_pack(words + 3, &end);
		return 6;
	case 1:
		gloss_counters_pack(words);
		return 1;
	case 2:
		return packet_read(words, slot, offset, count);
	default:
		packet_write(words, slot, offset, 0);
		words[0] += count - 1;
		for (i = 0; i < count; i++)
			words[3 + i] = (uint32_t)test_random(seed);
		return 3 + count;
	}
}

static void random_jobs(const char *sim_name, const char *model_name)
{
	static struct side sim, model;
	uint32_t words[600], memory[WORDS], i;
	uint64_t seed = test_seed();
	int job;

	for (i = 0; i < WORDS; i++)
		memory[i] = (uint32_t)test_random(&seed);
	side_open(&sim, sim_name, memory);
	side_open(&model, model_name, memory);
	for (job = 0; job < 40; job++) {
		uint32_t packets = test_below(&seed, 12);
		size_t count = 0;

		for (i = 0; i < packets; i++)
			count += random_packet(&seed, words + count);
		compare(&sim, &model, words, count);
	}
	side_close(&sim);
	side_close(&model);
}

static void the_largest_core_is_the_model(void **state)
{
	(void)state;
	random_jobs("sim:", "model:");
}

static void the_smallest_core_is_the_model(void **state)
{
	(void)state;
	random_jobs("sim:tile=32,lanes=1", "model:tile=32");
}

static void a_core_whose_ports_stall_is_the_model(void **state)
{
	uint64_t seed = test_seed();
	char name[64];

	(void)state;
	snprintf(name, sizeof(name), "sim:stalls=%u", 1 + test_below(&seed, 1000000));
	random_jobs(name, "model:");
	snprintf(name, sizeof(name), "sim:tile=32,lanes=1,stalls=%u",
		 1 + test_below(&seed, 1000000));
	random_jobs(name, "model:tile=32");
}

static void cores_of_two_kinds_run_in_one_program(void **state)
{
	struct messages messages;
	struct accel_device *large, *small;
	struct accel_device_info info;

	(void)state;
	large = device_open("sim:", &messages);
	small = device_open("sim:tile=32,lanes=1", &messages);
	accel_device_info(large, &info, sizeof(info));
	assert_int_equal(info.pixels_per_clock, 8);
	accel_device_info(small, &info, sizeof(info));
	assert_int_equal(info.pixels_per_clock, 1);
	random_jobs("sim:", "model:");
	accel_device_free(large);
	random_jobs("sim:tile=32,lanes=1", "model:tile=32");
	accel_device_free(small);
}

static void the_core_counts_its_clocks(void **state)
{
	struct accel_device_clocks before, after;
	struct messages messages;
	struct accel_device *device;
	struct accel_buffer *buffer;
	uint32_t words[256] = { 0 };

	(void)state;
	device = device_open("sim:", &messages);
	assert_int_equal(accel_buffer_new(device, sizeof(words), &buffer), 0);
	assert_int_equal(accel_device_clocks(device, &before, sizeof(before)), 0);
	assert_int_equal(before.clocks, 0);
	assert_int_equal(accel_buffer_write(buffer, 0, words, sizeof(words)), 0);
	assert_int_equal(accel_device_clocks(device, &after, sizeof(after)), 0);
	assert_true(after.clocks >= 256 && after.clocks < 10000);
	accel_buffer_free(buffer);
	accel_device_free(device);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_largest_core_is_the_model),
		cmocka_unit_test(the_smallest_core_is_the_model),
		cmocka_unit_test(a_core_whose_ports_stall_is_the_model),
		cmocka_unit_test(cores_of_two_kinds_run_in_one_program),
		cmocka_unit_test(the_core_counts_its_clocks),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
