// SPDX-License-Identifier: MIT
/* Tiles that are handed out together may be drawn in any order: the job is the same to the byte. */
#include "model_test.h"
#include "stream_random.h"

#define PIECES 512
#define ANSWERS (STREAM_RANDOM_RESPONSE + 128)

/* Draws what it was handed out when it has to, and in an order of its own. */
struct drawer {
	struct model model;
	struct model_piece piece[PIECES];
	uint32_t pieces, most;
	uint64_t seed;
};

static void draw_later(void *data, const struct model_piece *piece)
{
	struct drawer *drawer = data;

	assert_true(drawer->pieces < PIECES);
	drawer->piece[drawer->pieces++] = *piece;
	if (drawer->pieces > drawer->most)
		drawer->most = drawer->pieces;
}

static void draw_in_any_order(void *data, struct model_counters *counters)
{
	struct drawer *drawer = data;

	drawer->model.counters = (struct model_counters){ 0 };
	while (drawer->pieces) {
		uint32_t next = test_below(&drawer->seed, drawer->pieces);

		model_draw_piece(&drawer->model, &drawer->piece[next]);
		drawer->piece[next] = drawer->piece[--drawer->pieces];
	}
	counters->triangles += drawer->model.counters.triangles;
	counters->covered += drawer->model.counters.covered;
	counters->passed += drawer->model.counters.passed;
	counters->tiles += drawer->model.counters.tiles;
}

static const struct model_drawer any_order = { draw_later, draw_in_any_order };

/* A job run in two ways, each with its memory and response. */
static struct {
	struct model model;
	struct gloss_status status;
	uint8_t memory[STREAM_RANDOM_MEMORY];
	uint32_t response[ANSWERS];
} one, other;
static struct drawer drawer;

/* Returns how many tiles were handed out together at most. */
static uint32_t run_both(struct accel_job *job, int tile_size, uint64_t seed)
{
	stream_random_memory(one.memory, sizeof(one.memory), seed);
	memcpy(other.memory, one.memory, sizeof(one.memory));
	memset(one.response, 0xee, sizeof(one.response));
	memset(other.response, 0xee, sizeof(other.response));
	model_init(&one.model, tile_size, one.memory, sizeof(one.memory));
	model_init(&other.model, tile_size, other.memory, sizeof(other.memory));
	model_init(&drawer.model, tile_size, other.memory, sizeof(other.memory));
	drawer.most = 0;
	drawer.seed = seed;
	job->response = one.response;
	assert_int_equal(model_run(&one.model, job, &one.status), 0);
	job->response = other.response;
	assert_int_equal(model_run_parallel(&other.model, job, &any_order, &drawer, &other.status),
			 0);
	assert_int_equal(drawer.pieces, 0);
	assert_memory_equal(&one.status, &other.status, sizeof(one.status));
	assert_memory_equal(one.memory, other.memory, sizeof(one.memory));
	assert_memory_equal(one.response, other.response, sizeof(one.response));
	return drawer.most;
}

static void random_jobs_are_the_same(void **state)
{
	static struct stream_random job;
	uint64_t seed = test_seed();

	(void)state;
	for (int n = 0; n < 1500; n++) {
		int tile_size = n % 2 ? 32 : 64;

		stream_random_valid(&job, seed + (uint64_t)n, tile_size);
		if (n % 3 == 0)
			stream_random_damage(&job);
		run_both(&job.job, tile_size, seed + (uint64_t)n);
	}
}

/* ---- frames ---- */

#define T 32
#define COLUMNS 4
#define ROWS 8
#define PITCH (COLUMNS * T * 4u)
#define PLANE (PITCH * T * ROWS)

/* Of a frame, one time in so many; 0: never. */
struct oddities {
	uint32_t back, off_grid, elsewhere, other_load, other_surface, memory, inside;
	bool slots_meet;
};

static bool one_in(uint64_t *seed, uint32_t n)
{
	return n && !test_below(seed, n);
}

static uint32_t place(uint32_t tile)
{
	return tile / COLUMNS * T * PITCH + tile % COLUMNS * T * 4;
}

static uint32_t random_place(uint64_t *seed, const struct oddities *odd, uint32_t tile)
{
	if (one_in(seed, odd->elsewhere))
		return place(test_below(seed, COLUMNS * ROWS));
	return place(tile) + (one_in(seed, odd->off_grid) && tile < COLUMNS ? PITCH : 0);
}

static void put_surfaces(struct model_test *t, uint64_t *seed, bool odd)
{
	/* Half the pitch: other rows of the same memory. */
	uint32_t pitch = odd && !test_below(seed, 6) ? PITCH / 2 : PITCH;

	put_colour_surface(t, (struct gloss_colour_surface){ odd ? 2 : 0, pitch });
	put_depth_surface(t, (struct gloss_depth_surface){ 1, PITCH });
}

static void put_tile(struct model_test *t, uint64_t *seed, const struct oddities *odd,
		     uint32_t tile)
{
	uint32_t colour = random_place(seed, odd, tile), depth = random_place(seed, odd, tile);
	bool load = test_below(seed, 2), answer = test_below(seed, 40) == 0;
	uint32_t from = one_in(seed, odd->other_load) ? place(test_below(seed, COLUMNS * ROWS)) :
							colour;

	put_tile_begin(t, (struct gloss_tile_begin){ load, load, load ? from : tile,
						     load ? depth : 0xffffff });
	put_depth_state(t, (struct gloss_depth_state){ .func = GLOSS_COMPARE_LEQUAL,
						       .write = test_below(seed, 2) });
	put_scissor(t, (struct gloss_scissor){ test_below(seed, T), test_below(seed, T), T, T });
	put_cover(t, test_below(seed, 1 << 24), tile, test_below(seed, 1 << 24));
	if (one_in(seed, odd->inside))
		put_surfaces(t, seed, true);
	put_tile_end(t, (struct gloss_tile_end){
				answer ? GLOSS_TILE_OUTPUT_ANSWER : GLOSS_TILE_OUTPUT_STORE,
				tile % 5 ? GLOSS_TILE_OUTPUT_STORE : GLOSS_TILE_OUTPUT_DROP,
				answer ? 0 : colour, tile % 5 ? depth : 0 });
}

static void put_between(struct model_test *t, uint64_t *seed, const struct oddities *odd)
{
	if (one_in(seed, odd->other_surface))
		put_surfaces(t, seed, test_below(seed, 2));
	if (!one_in(seed, odd->memory))
		return;
	switch (test_below(seed, 3)) {
	case 0:
		put_write_memory(t, 0, 4 * test_below(seed, PLANE / 4), 1);
		put(t, (uint32_t)*seed);
		break;
	case 1:
		put_read_memory(t, (struct gloss_read_memory){ test_below(seed, 2), 256,
							       4 * test_below(seed, PLANE / 8) });
		break;
	default:
		put_counters(t);
	}
}

static uint32_t run_frame(struct model_test *t, uint64_t *seed, const struct oddities *odd)
{
	uint32_t tile = 0;

	t->job.stream_words = 0;
	t->job.response_words = ANSWERS - 128;
	set_slot(t, 0, 0, PLANE, GLOSS_RIGHTS_READ | GLOSS_RIGHTS_WRITE);
	set_slot(t, 1, odd->slots_meet ? PLANE / 2 : 2 * PLANE, PLANE,
		 GLOSS_RIGHTS_READ | GLOSS_RIGHTS_WRITE);
	set_slot(t, 2, PLANE / 4, PLANE, GLOSS_RIGHTS_READ | GLOSS_RIGHTS_WRITE);
	put_surfaces(t, seed, false);
	while (tile < COLUMNS * ROWS && t->job.stream_words < MODEL_TEST_WORDS - 100) {
		put_between(t, seed, odd);
		put_tile(t, seed, odd, tile);
		tile = one_in(seed, odd->back) ? test_below(seed, COLUMNS * ROWS) :
						 tile + 1 + test_below(seed, 2);
	}
	return run_both(&t->job, T, *seed);
}

static void a_frames_tiles_are_handed_out_together(void **state)
{
	static const struct oddities none = { 0 };
	struct model_test *t = *state;
	uint64_t seed = test_seed();

	assert_true(run_frame(t, &seed, &none) > 10);
	assert_int_equal(one.status.cause, GLOSS_FAULT_NONE);
}

static void what_tiles_have_in_common_keeps_its_order(void **state)
{
	static const struct oddities odd[] = {
		{ .back = 4 },
		{ .off_grid = 3 },
		{ .elsewhere = 6 },
		{ .other_load = 4 },
		{ .memory = 5 },
		{ .slots_meet = 1 },
		{ .other_surface = 4 },
		{ .inside = 1, .other_surface = 1 },
		{ .back = 9,
		  .off_grid = 9,
		  .elsewhere = 9,
		  .other_load = 9,
		  .other_surface = 9,
		  .memory = 9,
		  .inside = 9 },
	};
	struct model_test *t = *state;
	uint64_t seed = test_seed();

	for (uint32_t i = 0; i < 60 * sizeof(odd) / sizeof(*odd); i++)
		run_frame(t, &seed, &odd[i / 60]);
}

/* Tiles before the fault are drawn, the one that it is in and those after it are not. */
static void a_fault_ends_the_job_where_it_would_have(void **state)
{
	static const struct oddities none = { 0 };
	struct model_test *t = *state;
	uint64_t seed = test_seed();

	for (int i = 0; i < 40; i++) {
		uint32_t words;

		run_frame(t, &seed, &none);
		words = t->job.stream_words;
		t->words[test_below(&seed, words)] ^= 1u << test_below(&seed, 32);
		run_both(&t->job, T, seed);
		t->job.stream_words = test_below(&seed, words);
		run_both(&t->job, T, seed);
	}
}

static void a_job_without_words_ends(void **state)
{
	struct model_test *t = *state;

	t->job.stream = NULL;
	run_both(&t->job, T, 1);
	assert_int_equal(other.status.cause, GLOSS_FAULT_NONE);
	assert_int_equal(other.status.offset, 0);
}

static void what_is_no_job_is_refused(void **state)
{
	struct model_test *t = *state;

	t->job.stream = NULL;
	t->job.stream_words = 1;
	assert_int_equal(model_run_parallel(&t->model, &t->job, &any_order, &drawer, &t->status),
			 -EINVAL);
	t->job.stream_words = 0;
	set_slot(t, 3, 4, 4096, GLOSS_RIGHTS_READ);
	assert_int_equal(model_run_parallel(&t->model, &t->job, &any_order, &drawer, &t->status),
			 -EINVAL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		model_test_32(a_frames_tiles_are_handed_out_together),
		model_test_32(what_tiles_have_in_common_keeps_its_order),
		model_test_32(a_fault_ends_the_job_where_it_would_have),
		model_test_32(a_job_without_words_ends),
		model_test_32(what_is_no_job_is_refused),
		cmocka_unit_test(random_jobs_are_the_same),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
