/* SPDX-License-Identifier: MIT */
/* What a tile's stream consists of: its state, what it loads and stores. */
#include "bin_test.h"

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

#define PARTS 3

/* Some of a mesh's triangles, in @bin. */
static void draw_random(struct accel_bin *bin, uint64_t *seed, uint32_t count)
{
	while (count--) {
		const int x = (int)test_below(seed, WIDTH), y = (int)test_below(seed, HEIGHT);

		draw_in(bin, x, y, 1 + (int)test_below(seed, 90));
	}
}

/* The same frame for the same seed; through @part, or without parts if that is NULL. */
static void draw_frame(struct fixture *f, struct accel_bin *part, uint64_t seed)
{
	accel_bin_reset(&f->bin);
	/* Frames of two sizes. */
	f->all.x1 = seed % 2 ? WIDTH : WIDTH / 2;
	assert_int_equal(accel_bin_begin(&f->bin, f->all.x1, HEIGHT), 0);
	for (int mesh = 0; mesh < 6; mesh++) {
		set_state(f, (enum accel_compare)test_below(&seed, 8), test_below(&seed, 2), true);
		if (mesh == 4)
			clear(f, ACCEL_CLEAR_COLOUR, 0x55667788, 0);
		for (int i = 0; i < 5; i++) {
			struct accel_bin *bin = part ? &part[i % PARTS] : &f->bin;

			if (part)
				assert_int_equal(accel_bin_part_begin(bin, &f->bin), 0);
			draw_random(bin, &seed, test_below(&seed, 30));
			if (part)
				assert_int_equal(accel_bin_append(&f->bin, bin), 0);
		}
	}
}

static void a_frame_in_parts_is_the_same_stream(void **state)
{
	static uint32_t whole[sizeof(sent_words) / sizeof(*sent_words)];
	struct fixture *f = *state;
	struct accel_bin part[PARTS];
	uint64_t seed = test_seed();
	uint64_t records;
	uint32_t count;

	for (int i = 0; i < PARTS; i++)
		accel_bin_init(&part[i], 64);
	for (int frame = 0; frame < 4; frame++) {
		draw_frame(f, NULL, seed + (uint64_t)frame);
		submit(f, ACCEL_JOB_WORDS);
		count = sent_count;
		records = f->stats.records;
		memcpy(whole, sent_words, count * sizeof(*whole));
		/* A target that knows as little, or tiles would be left out. */
		accel_target_free(f->target);
		assert_int_equal(accel_target_new(f->device, WIDTH, HEIGHT, &f->target), 0);
		draw_frame(f, part, seed + (uint64_t)frame);
		submit(f, ACCEL_JOB_WORDS);
		assert_int_equal(sent_count, count);
		assert_int_equal(f->stats.records, records);
		assert_memory_equal(sent_words, whole, count * sizeof(*whole));
		accel_target_free(f->target);
		assert_int_equal(accel_target_new(f->device, WIDTH, HEIGHT, &f->target), 0);
	}
	for (int i = 0; i < PARTS; i++)
		accel_bin_free(&part[i]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		bin_test(only_tiles_that_are_drawn_on_are_sent),
		bin_test(a_clear_sends_all_tiles_and_loads_none),
		bin_test(depth_is_loaded_and_stored_only_if_it_is_used),
		bin_test(colour_that_is_masked_out_is_neither_loaded_nor_stored),
		bin_test(state_is_sent_only_where_it_changes),
		bin_test(a_scissor_is_sent_relative_to_its_tile),
		bin_test(clearing_one_surface_draws_over_what_was_drawn),
		bin_test(clearing_both_forgets_what_was_drawn),
		bin_test(a_triangle_over_whole_tiles_is_sent_without_edges_there),
		bin_test(a_frame_in_parts_is_the_same_stream),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
