/* SPDX-License-Identifier: MIT */
/* What a tile's stream consists of: its state, what it loads and stores, jobs and their borders. */
#include "draw_mesh.h"
#include "draw_test.h"

#define WIDTH 200
#define HEIGHT 100

struct fixture {
	struct messages messages;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_stream *stream;
	struct accel_state *state;
	struct accel_bin bin;
	struct accel_draw_stats stats;
	struct accel_bounds all;
};

static int setup(void **state)
{
	static struct fixture f;

	memset(&f, 0, sizeof(f));
	f.device = device_open("model:tile=64", &f.messages);
	assert_int_equal(accel_target_new(f.device, WIDTH, HEIGHT, &f.target), 0);
	assert_int_equal(accel_stream_new(f.device, &f.stream), 0);
	assert_int_equal(accel_state_new(&f.state), 0);
	accel_bin_init(&f.bin, 64);
	assert_int_equal(accel_bin_begin(&f.bin, WIDTH, HEIGHT), 0);
	f.all = (struct accel_bounds){ 0, 0, WIDTH, HEIGHT };
	accel_bin_state(&f.bin, f.state, &f.all);
	*state = &f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	accel_bin_free(&f->bin);
	accel_state_free(f->state);
	accel_stream_free(f->stream);
	accel_target_free(f->target);
	accel_device_free(f->device);
	return 0;
}

/* A flat square's lower left half, @side pixels at (x, y). */
static void draw_at(struct fixture *f, int x, int y, int side)
{
	const struct accel_vertex a = vertex_at(16 * x, 16 * y);
	const struct accel_vertex b = vertex_at(16 * (x + side), 16 * (y + side));
	const struct accel_vertex c = vertex_at(16 * x, 16 * (y + side));
	const struct accel_vertex *const vertex[3] = { &a, &b, &c };
	struct accel_triangle triangle;
	struct accel_depth_plane plane;

	assert_true(triangle_ready(&triangle, &plane, vertex));
	assert_int_equal(accel_bin_triangle(&f->bin, &triangle), 0);
}

/* ---- a board that shows what it is sent ---- */

static const struct accel_transport_ops *board;
static struct accel_transport_ops spy;
static uint32_t sent_words[65536];
static uint32_t sent_count, sent_jobs;
static uint32_t refused_job; /* the one that there is no memory for, 0: none */
static unsigned int waits;
static const uint32_t *sent_part[16]; /* the first ones of the last job */

static int spy_submit(void *state, const struct accel_transport_job *job, uint64_t *sequence)
{
	assert_true(sent_count + job->stream_words <= sizeof(sent_words) / sizeof(*sent_words));
	accel_transport_copy(job, sent_words + sent_count);
	for (size_t i = 0, words = 0; job->part && i < 16 && words < job->stream_words; i++) {
		sent_part[i] = job->part[i].words;
		words += job->part[i].count;
	}
	if (sent_jobs + 1 == refused_job)
		return -ENOMEM;
	sent_count += job->stream_words;
	sent_jobs++;
	return board->submit(state, job, sequence);
}

static int spy_wait(void *state, uint64_t sequence, int64_t timeout_ns, struct gloss_status *status)
{
	waits++;
	return board->wait(state, sequence, timeout_ns, status);
}

static void spy_begin(struct fixture *f)
{
	board = f->device->ops;
	spy = *board;
	spy.submit = spy_submit;
	spy.wait = spy_wait;
	f->device->ops = &spy;
	sent_count = sent_jobs = refused_job = waits = 0;
}

static void submit(struct fixture *f, size_t job_words)
{
	struct accel_fence *fence;
	bool sent;

	spy_begin(f);
	assert_int_equal(accel_frame_submit(&f->bin, f->stream, f->target, job_words, &f->stats,
					    &fence, &sent),
			 0);
	assert_int_equal(waits, 0);
	f->device->ops = board;
	assert_true(sent);
	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
	accel_fence_free(fence);
	assert_int_equal(f->stats.stream_words, sent_count);
}

/* The packet of @opcode that comes after @skip others of it; NULL if there is none. */
static const uint32_t *packet(unsigned int opcode, int skip)
{
	for (uint32_t i = 0; i < sent_count; i += packet_words(sent_words[i]))
		if (gloss_header_opcode(sent_words[i]) == opcode && skip-- == 0)
			return &sent_words[i];
	return NULL;
}

static int packets(unsigned int opcode)
{
	int count = 0;

	while (packet(opcode, count))
		count++;
	return count;
}

static struct gloss_tile_begin begin_of(int tile)
{
	struct gloss_tile_begin begin;

	assert_non_null(packet(GLOSS_OP_TILE_BEGIN, tile));
	gloss_tile_begin_unpack(packet(GLOSS_OP_TILE_BEGIN, tile), &begin);
	return begin;
}

static struct gloss_tile_end end_of(int tile)
{
	struct gloss_tile_end end;

	assert_non_null(packet(GLOSS_OP_TILE_END, tile));
	gloss_tile_end_unpack(packet(GLOSS_OP_TILE_END, tile), &end);
	return end;
}

static void clear(struct fixture *f, unsigned int mask, uint32_t colour, uint32_t depth)
{
	const struct accel_tile_clear values = { mask, colour, depth };

	assert_int_equal(accel_bin_clear(&f->bin, &values), 0);
}

static void set_state(struct fixture *f, enum accel_compare func, bool write, bool colours)
{
	accel_state_set_depth(f->state, func, write);
	accel_state_set_colour_mask(f->state, colours, colours, colours, colours);
	accel_bin_state(&f->bin, f->state, &f->all);
}

/* ---- tests ---- */

static void only_tiles_that_are_drawn_on_are_sent(void **state)
{
	struct fixture *f = *state;

	draw_at(f, 70, 10, 20);
	draw_at(f, 130, 70, 20);
	submit(f, ACCEL_JOB_WORDS);
	assert_int_equal(packets(GLOSS_OP_TILE_BEGIN), 2);
	assert_int_equal(begin_of(0).colour, 64 * 4);
	assert_int_equal(begin_of(1).colour, 64 * f->target->pitch + 128 * 4);
	assert_int_equal(f->stats.tiles, 2);
	assert_int_equal(f->stats.records, 2);
}

static void a_clear_sends_all_tiles_and_loads_none(void **state)
{
	struct fixture *f = *state;

	clear(f, ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH, 0x11223344, 77);
	draw_at(f, 70, 10, 20);
	submit(f, ACCEL_JOB_WORDS);
	assert_int_equal(packets(GLOSS_OP_TILE_BEGIN), 8);
	for (int i = 0; i < 8; i++) {
		assert_false(begin_of(i).colour_load || begin_of(i).depth_load);
		assert_int_equal(begin_of(i).colour, 0x11223344);
		assert_int_equal(begin_of(i).depth, 77);
		assert_int_equal(end_of(i).colour_output, GLOSS_TILE_OUTPUT_STORE);
		assert_int_equal(end_of(i).depth_output, GLOSS_TILE_OUTPUT_STORE);
	}
}

static void depth_is_loaded_and_stored_only_if_it_is_used(void **state)
{
	struct fixture *f = *state;
	static const struct {
		enum accel_compare func;
		bool write, load, store;
	} cases[] = {
		{ ACCEL_COMPARE_ALWAYS, false, false, false },
		{ ACCEL_COMPARE_LESS, false, true, false },
		{ ACCEL_COMPARE_LESS, true, true, true },
		{ ACCEL_COMPARE_ALWAYS, true, true, true },
	};

	for (int i = 0; i < 4; i++) {
		accel_bin_reset(&f->bin);
		assert_int_equal(accel_bin_begin(&f->bin, WIDTH, HEIGHT), 0);
		set_state(f, cases[i].func, cases[i].write, true);
		draw_at(f, 10, 10, 20);
		submit(f, ACCEL_JOB_WORDS);
		assert_int_equal(begin_of(0).depth_load, cases[i].load);
		assert_int_equal(end_of(0).depth_output,
				 cases[i].store ? GLOSS_TILE_OUTPUT_STORE : GLOSS_TILE_OUTPUT_DROP);
		assert_true(begin_of(0).colour_load);
	}
}

static void colour_that_is_masked_out_is_neither_loaded_nor_stored(void **state)
{
	struct fixture *f = *state;

	set_state(f, ACCEL_COMPARE_LESS, true, false);
	draw_at(f, 10, 10, 20);
	submit(f, ACCEL_JOB_WORDS);
	assert_false(begin_of(0).colour_load);
	assert_int_equal(end_of(0).colour_output, GLOSS_TILE_OUTPUT_DROP);
	assert_int_equal(end_of(0).depth_output, GLOSS_TILE_OUTPUT_STORE);
}

static void state_is_sent_only_where_it_changes(void **state)
{
	struct fixture *f = *state;

	/* As a job begins. */
	draw_at(f, 10, 10, 20);
	submit(f, ACCEL_JOB_WORDS);
	assert_int_equal(packets(GLOSS_OP_DEPTH_STATE), 0);
	assert_int_equal(packets(GLOSS_OP_COLOUR_MASK), 0);
	assert_int_equal(packets(GLOSS_OP_SCISSOR), 0);
	/* Once for both tiles, then once in the second. */
	accel_bin_reset(&f->bin);
	assert_int_equal(accel_bin_begin(&f->bin, WIDTH, HEIGHT), 0);
	set_state(f, ACCEL_COMPARE_LESS, true, true);
	draw_at(f, 10, 10, 20);
	draw_at(f, 70, 10, 20);
	draw_at(f, 70, 10, 10);
	set_state(f, ACCEL_COMPARE_GREATER, true, true);
	draw_at(f, 70, 10, 20);
	submit(f, ACCEL_JOB_WORDS);
	assert_int_equal(packets(GLOSS_OP_DEPTH_STATE), 2);
	assert_int_equal(packets(GLOSS_OP_COLOUR_MASK), 0);
	assert_int_equal(packets(GLOSS_OP_TRIANGLE), 4);
}

static void a_scissor_is_sent_relative_to_its_tile(void **state)
{
	struct fixture *f = *state;
	struct gloss_scissor scissor;

	f->all = (struct accel_bounds){ 5, 6, 75, HEIGHT };
	accel_bin_state(&f->bin, f->state, &f->all);
	draw_at(f, 0, 0, 90);
	draw_at(f, 130, 0, 20);
	submit(f, ACCEL_JOB_WORDS);
	assert_int_equal(packets(GLOSS_OP_TILE_BEGIN), 3);
	gloss_scissor_unpack(packet(GLOSS_OP_SCISSOR, 0), &scissor);
	assert_int_equal(scissor.x0, 5);
	assert_int_equal(scissor.y0, 6);
	assert_int_equal(scissor.x1, 64);
	assert_int_equal(scissor.y1, 64);
	gloss_scissor_unpack(packet(GLOSS_OP_SCISSOR, 1), &scissor);
	assert_int_equal(scissor.x0, 5);
	assert_int_equal(scissor.y0, 0);
	gloss_scissor_unpack(packet(GLOSS_OP_SCISSOR, 2), &scissor);
	assert_int_equal(scissor.x0, 0);
	assert_int_equal(scissor.x1, 11);
}

/* A clear of one surface in the middle of a frame keeps what was drawn on the other. */
static void clearing_one_surface_draws_over_what_was_drawn(void **state)
{
	struct fixture *f = *state;
	uint32_t colour[WIDTH], depth[WIDTH];

	set_state(f, ACCEL_COMPARE_ALWAYS, true, true);
	clear(f, ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH, 0x01020304, 1000);
	draw_at(f, 0, 0, 64);
	clear(f, ACCEL_CLEAR_COLOUR, 0x55667788, 0);
	draw_at(f, 64, 0, 64);
	clear(f, ACCEL_CLEAR_DEPTH, 0, 2000);
	submit(f, ACCEL_JOB_WORDS);
	assert_int_equal(packets(GLOSS_OP_TILE_BEGIN), 8);
	for (int y = 0; y < HEIGHT; y++) {
		assert_int_equal(accel_buffer_read(f->target->colour,
						   (uint64_t)y * f->target->pitch, colour,
						   sizeof(colour)),
				 0);
		assert_int_equal(accel_buffer_read(f->target->depth, (uint64_t)y * f->target->pitch,
						   depth, sizeof(depth)),
				 0);
		for (int x = 0; x < WIDTH; x++) {
			bool drawn = y < 64 && x >= 64 && x - 64 < y;

			assert_int_equal(colour[x], drawn ? 0xffffffff : 0x55667788);
			assert_int_equal(depth[x], 2000);
		}
	}
}

static void clearing_both_forgets_what_was_drawn(void **state)
{
	struct fixture *f = *state;

	draw_at(f, 0, 0, 64);
	clear(f, ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH, 0, 0);
	submit(f, ACCEL_JOB_WORDS);
	assert_int_equal(packets(GLOSS_OP_TRIANGLE), 0);
	assert_int_equal(f->stats.records, 0);
}

static void a_triangle_over_whole_tiles_is_sent_without_edges_there(void **state)
{
	struct fixture *f = *state;
	struct gloss_triangle header;
	int covering = 0;

	draw_at(f, -300, -300, 1000);
	submit(f, ACCEL_JOB_WORDS);
	for (int i = 0; i < packets(GLOSS_OP_TRIANGLE); i++) {
		gloss_triangle_unpack(packet(GLOSS_OP_TRIANGLE, i), &header);
		covering += header.geometry == GLOSS_GEOMETRY_COVERING;
	}
	/* Below the diagonal; the last row of tiles ends outside of the target. */
	assert_int_equal(covering, 0);
	accel_bin_reset(&f->bin);
	assert_int_equal(accel_bin_begin(&f->bin, WIDTH, 128), 0);
	f->all.y1 = 128;
	accel_bin_state(&f->bin, f->state, &f->all);
	draw_at(f, -300, -300, 1000);
	submit(f, ACCEL_JOB_WORDS);
	covering = 0;
	for (int i = 0; i < packets(GLOSS_OP_TRIANGLE); i++) {
		gloss_triangle_unpack(packet(GLOSS_OP_TRIANGLE, i), &header);
		covering += header.geometry == GLOSS_GEOMETRY_COVERING;
	}
	assert_int_equal(covering, 1);
}

static void many_records_keep_their_order(void **state)
{
	struct fixture *f = *state;
	struct gloss_triangle header;

	for (int i = 0; i < 2000; i++) {
		const struct accel_vertex a = vertex_at(0, 0), b = vertex_at(160, 160);
		const struct accel_vertex c = vertex_at(0, 160);
		const struct accel_vertex *const vertex[3] = { &a, &b, &c };
		struct accel_triangle triangle;
		struct accel_depth_plane plane;

		assert_true(triangle_ready(&triangle, &plane, vertex));
		triangle.constant[3] = (uint8_t)i;
		assert_int_equal(accel_bin_triangle(&f->bin, &triangle), 0);
	}
	submit(f, ACCEL_JOB_WORDS);
	for (int i = 0; i < 2000; i += 37) {
		gloss_triangle_unpack(packet(GLOSS_OP_TRIANGLE, i), &header);
		assert_int_equal(header.alpha, i & 0xff);
	}
	assert_int_equal(packets(GLOSS_OP_TRIANGLE), 2000);
}

static void a_frame_in_many_jobs_is_the_same_picture(void **state)
{
	struct fixture *f = *state;
	static uint32_t picture[2][128 * 256], depth[2][128 * 256];
	const size_t sizes[] = { ACCEL_JOB_WORDS, 1 };

	set_state(f, ACCEL_COMPARE_LESS, true, true);
	clear(f, ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH, 0, 0xffffff);
	for (int i = 0; i < 40; i++)
		draw_at(f, i * 5, i * 2, 60);
	for (int i = 0; i < 2; i++) {
		submit(f, sizes[i]);
		assert_int_equal(accel_buffer_read(f->target->colour, 0, picture[i],
						   sizeof(picture[i])),
				 0);
		assert_int_equal(accel_buffer_read(f->target->depth, 0, depth[i], sizeof(depth[i])),
				 0);
		assert_true(i ? sent_jobs == 8 : sent_jobs == 1);
	}
	assert_memory_equal(picture[0], picture[1], sizeof(picture[0]));
	assert_memory_equal(depth[0], depth[1], sizeof(depth[0]));
}

/* A word is copied once: from where it was binned to where the board has it from. */
static void records_are_sent_from_their_bins(void **state)
{
	struct fixture *f = *state;
	const struct accel_chunk *chunk = NULL;
	int found = 0;

	set_state(f, ACCEL_COMPARE_ALWAYS, false, true);
	draw_at(f, 5, 5, 20);
	for (int i = 0; i < f->bin.columns * f->bin.rows; i++)
		if (f->bin.tile[i].drawn)
			chunk = f->bin.tile[i].chunk;
	assert_non_null(chunk);
	submit(f, ACCEL_JOB_WORDS);
	for (int i = 0; i < 16; i++)
		found += sent_part[i] == chunk->words;
	assert_int_equal(found, 1);
}

static void memory_that_is_short_is_told_from_a_part_that_was_drawn(void **state)
{
	struct fixture *f = *state;
	struct accel_fence *fence = NULL;
	bool sent;

	clear(f, ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH, 0, 0xffffff);
	for (uint32_t job = 1; job <= 8; job++) {
		spy_begin(f);
		refused_job = job;
		assert_int_equal(accel_frame_submit(&f->bin, f->stream, f->target, 1, &f->stats,
						    &fence, &sent),
				 job == 1 ? -ENOMEM : -EIO);
		assert_int_equal(sent, job > 1);
		assert_int_equal(sent_jobs, job - 1);
		f->device->ops = board;
		assert_null(fence);
	}
	submit(f, 1);
	assert_int_equal(sent_jobs, 8);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(only_tiles_that_are_drawn_on_are_sent, setup,
						teardown),
		cmocka_unit_test_setup_teardown(a_clear_sends_all_tiles_and_loads_none, setup,
						teardown),
		cmocka_unit_test_setup_teardown(depth_is_loaded_and_stored_only_if_it_is_used,
						setup, teardown),
		cmocka_unit_test_setup_teardown(
			colour_that_is_masked_out_is_neither_loaded_nor_stored, setup, teardown),
		cmocka_unit_test_setup_teardown(state_is_sent_only_where_it_changes, setup,
						teardown),
		cmocka_unit_test_setup_teardown(a_scissor_is_sent_relative_to_its_tile, setup,
						teardown),
		cmocka_unit_test_setup_teardown(clearing_one_surface_draws_over_what_was_drawn,
						setup, teardown),
		cmocka_unit_test_setup_teardown(clearing_both_forgets_what_was_drawn, setup,
						teardown),
		cmocka_unit_test_setup_teardown(
			a_triangle_over_whole_tiles_is_sent_without_edges_there, setup, teardown),
		cmocka_unit_test_setup_teardown(many_records_keep_their_order, setup, teardown),
		cmocka_unit_test_setup_teardown(a_frame_in_many_jobs_is_the_same_picture, setup,
						teardown),
		cmocka_unit_test_setup_teardown(records_are_sent_from_their_bins, setup, teardown),
		cmocka_unit_test_setup_teardown(
			memory_that_is_short_is_told_from_a_part_that_was_drawn, setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
