// SPDX-License-Identifier: MIT
/* Tiles on threads: the same bytes with any number of them, and with none that the system gives. */
#include "model/model_test.h"
#include "stream_random.h"
#include "transport/tile_threads.h"

#define T 32
#define COLUMNS 4
#define ROWS 8
#define PITCH (COLUMNS * T * 4u)
#define PLANE (PITCH * T * ROWS)
#define ANSWERS (STREAM_RANDOM_RESPONSE + 128)
#define THREADS_MOST 5

/* Threads that the system will still give. */
static int threads_left;

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
			  void *(*start)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
			  void *(*start)(void *), void *argument);

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
			  void *(*start)(void *), void *argument)
{
	if (!threads_left)
		return EAGAIN;
	threads_left--;
	return __real_pthread_create(thread, attributes, start, argument);
}

/* A job with no threads, and with some; each with its memory and response. */
static struct {
	struct model model;
	struct gloss_status status;
	uint8_t memory[STREAM_RANDOM_MEMORY];
	uint32_t response[ANSWERS];
} one, other;
static struct accel_tile_threads threads;

static void threads_begin(unsigned int count, int tile_size)
{
	threads_left = THREADS_MOST;
	accel_tile_threads_init(&threads, count, tile_size, other.memory, sizeof(other.memory));
}

static void run_both(struct accel_job *job, int tile_size, uint64_t seed)
{
	stream_random_memory(one.memory, sizeof(one.memory), seed);
	memcpy(other.memory, one.memory, sizeof(one.memory));
	memset(one.response, 0xee, sizeof(one.response));
	memset(other.response, 0xee, sizeof(other.response));
	model_init(&one.model, tile_size, one.memory, sizeof(one.memory));
	model_init(&other.model, tile_size, other.memory, sizeof(other.memory));
	job->response = one.response;
	assert_int_equal(model_run(&one.model, job, &one.status), 0);
	job->response = other.response;
	assert_int_equal(model_run_parallel(&other.model, job, &accel_tile_drawer, &threads,
					    &other.status),
			 0);
	assert_memory_equal(&one.status, &other.status, sizeof(one.status));
	assert_memory_equal(one.memory, other.memory, sizeof(one.memory));
	assert_memory_equal(one.response, other.response, sizeof(one.response));
}

/* @tiles of a frame, of which some are drawn on, and what was counted. */
static void put_frame(struct model_test *t, uint64_t *seed, uint32_t tiles)
{
	t->job.stream_words = 0;
	t->job.response_words = ANSWERS - 128;
	set_slot(t, 0, 0, PLANE, GLOSS_RIGHTS_READ | GLOSS_RIGHTS_WRITE);
	set_slot(t, 1, PLANE, PLANE, GLOSS_RIGHTS_READ | GLOSS_RIGHTS_WRITE);
	put_colour_surface(t, (struct gloss_colour_surface){ 0, PITCH });
	put_depth_surface(t, (struct gloss_depth_surface){ 1, PITCH });
	for (uint32_t tile = 0; tile < tiles; tile++) {
		uint32_t at = tile / COLUMNS * T * PITCH + tile % COLUMNS * T * 4;

		put_tile_begin(t, (struct gloss_tile_begin){ tile % 3, tile % 2, at, at });
		for (uint32_t n = test_below(seed, 5); n; n--)
			put_cover(t, test_below(seed, 1 << 24), tile, test_below(seed, 1 << 24));
		put_tile_end(t, (struct gloss_tile_end){ GLOSS_TILE_OUTPUT_STORE,
							 GLOSS_TILE_OUTPUT_STORE, at, at });
	}
	put_counters(t);
}

static void jobs_are_the_same_with_any_number_of_threads(void **state)
{
	static struct stream_random job;
	struct model_test *t = *state;
	uint64_t seed = test_seed();

	for (unsigned int count = 1; count <= THREADS_MOST; count++) {
		threads_begin(count, T);
		for (int n = 0; n < 40; n++) {
			put_frame(t, &seed, COLUMNS * ROWS);
			run_both(&t->job, T, seed);
			assert_int_equal(one.status.cause, GLOSS_FAULT_NONE);
			/* With a word that is wrong somewhere. */
			t->words[test_below(&seed, t->job.stream_words)] ^= 1u << (n % 32);
			run_both(&t->job, T, seed);
			stream_random_valid(&job, seed, T);
			if (n % 2)
				stream_random_damage(&job);
			run_both(&job.job, T, seed);
		}
		accel_tile_threads_fini(&threads);
	}
}

static void threads_start_when_two_tiles_wait_for_them(void **state)
{
	struct model_test *t = *state;
	uint64_t seed = test_seed();

	threads_begin(3, T);
	put_frame(t, &seed, 0);
	run_both(&t->job, T, seed);
	put_frame(t, &seed, 1);
	run_both(&t->job, T, seed);
	assert_int_equal(threads.threads, 0);
	put_frame(t, &seed, 2);
	run_both(&t->job, T, seed);
	assert_int_equal(threads.threads, 1);
	accel_tile_threads_fini(&threads);
}

static void there_are_never_more_threads_than_wanted(void **state)
{
	struct model_test *t = *state;
	uint64_t seed = test_seed();

	threads_begin(1, T);
	put_frame(t, &seed, COLUMNS * ROWS);
	run_both(&t->job, T, seed);
	assert_int_equal(threads.threads, 0);
	accel_tile_threads_fini(&threads);
	threads_begin(3, T);
	for (int n = 0; n < 20; n++) {
		put_frame(t, &seed, COLUMNS * ROWS);
		run_both(&t->job, T, seed);
	}
	assert_in_range(threads.threads, 1, 2);
	accel_tile_threads_fini(&threads);
}

static void jobs_are_drawn_by_as_many_threads_as_there_are(void **state)
{
	struct model_test *t = *state;
	uint64_t seed = test_seed();

	threads_begin(4, T);
	threads_left = 0;
	put_frame(t, &seed, COLUMNS * ROWS);
	run_both(&t->job, T, seed);
	assert_int_equal(threads.threads, 0);
	/* The next job asks again. */
	threads_left = 1;
	run_both(&t->job, T, seed);
	assert_int_equal(threads.threads, 1);
	run_both(&t->job, T, seed);
	assert_int_equal(threads.threads, 1);
	accel_tile_threads_fini(&threads);
}

static void a_device_may_go_while_its_frame_is_drawn(void **state)
{
	static const float corner[3][3] = { { -1, 3, 0 }, { -1, -1, 0 }, { 3, -1, 0 } };
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = 3, .position = { .data = corner });
	struct messages messages;

	(void)state;
	for (int n = 0; n < 5; n++) {
		struct accel_device *device;
		struct accel_target *target;
		struct accel_draw *draw;
		struct accel_state *drawn;

		threads_left = 1 + THREADS_MOST;
		device = device_open("model:threads=4,tile=32", &messages);
		assert_int_equal(accel_target_new(device, 512, 512, &target), 0);
		assert_int_equal(accel_draw_new(device, &draw), 0);
		assert_int_equal(accel_state_new(&drawn), 0);
		assert_int_equal(accel_draw_begin(draw, target, NULL), 0);
		assert_int_equal(accel_draw_mesh(draw, drawn, &mesh), 0);
		assert_int_equal(accel_draw_submit(draw, NULL), 0);
		accel_state_free(drawn);
		accel_draw_free(draw);
		accel_target_free(target);
		accel_device_free(device);
		assert_int_equal(messages.count, 0);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		model_test_32(jobs_are_the_same_with_any_number_of_threads),
		model_test_32(threads_start_when_two_tiles_wait_for_them),
		model_test_32(there_are_never_more_threads_than_wanted),
		model_test_32(jobs_are_drawn_by_as_many_threads_as_there_are),
		cmocka_unit_test(a_device_may_go_while_its_frame_is_drawn),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
