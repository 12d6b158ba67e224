/* SPDX-License-Identifier: MIT */
/* A tile that holds what it is to be cleared to is not sent, and only then. */
#include "accel_priv.h"
#include "draw_fixture.h"

#define SIDE 256
#define TILES ((SIDE / 64) * (SIDE / 64))
#define BOTH (ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH)

static const float corner[3][3] = { { -1, 1, 0 }, { -1, 0.8f, 0 }, { -0.8f, 1, 0 } };

static const struct accel_transport_ops *board;
static struct accel_transport_ops spy;
static int spy_fails; /* jobs yet to be waited for that fail */

static int spy_wait(void *state, uint64_t sequence, int64_t timeout_ns, struct gloss_status *status)
{
	int err = board->wait(state, sequence, timeout_ns, status);

	return err || !spy_fails ? err : (spy_fails--, -EIO);
}

static int setup(void **state)
{
	struct accel_state *drawn;
	struct fixture *f;

	assert_int_equal(accel_state_new(&drawn), 0);
	accel_state_set_depth(drawn, ACCEL_COMPARE_ALWAYS, true);
	f = fixture_new(SIDE, drawn);
	board = f->device->ops;
	spy = *board;
	spy.wait = spy_wait;
	spy_fails = 0;
	f->device->ops = &spy;
	*state = f;
	return 0;
}

static void begin(struct fixture *f, unsigned int mask, float red, float depth)
{
	const struct accel_clear clear = ACCEL_CLEAR(.mask = mask, .rgba = { red }, .depth = depth);

	assert_int_equal(accel_draw_begin(f->draw, f->target, mask ? &clear : NULL), 0);
}

static void draw_corner(struct fixture *f)
{
	const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						  .vertices = 3, .position = { .data = corner });

	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), 0);
}

/* Sends the frame; how many tiles it had. */
static uint64_t tiles(struct fixture *f)
{
	struct accel_draw_stats stats;

	assert_int_equal(accel_draw_finish(f->draw), 0);
	accel_draw_stats(f->draw, &stats, sizeof(stats));
	return stats.tiles;
}

/* Of a frame that is no more than a clear. */
static uint64_t tiles_of_clear(struct fixture *f, unsigned int mask, float red, float depth)
{
	begin(f, mask, red, depth);
	return tiles(f);
}

static uint32_t word_of(struct fixture *f, enum accel_plane plane, int x, int y)
{
	const struct accel_rectangle pixel = { x, y, 1, 1 };
	uint32_t word;

	assert_int_equal(accel_target_read(f->target, plane, &pixel, &word, 4), 0);
	return word;
}

static void a_clear_to_what_is_there_sends_no_tile(void **state)
{
	struct fixture *f = *state;

	assert_int_equal(tiles_of_clear(f, BOTH, 1, 0.5f), TILES);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 0.5f), 0);
	assert_int_equal(tiles_of_clear(f, ACCEL_CLEAR_DEPTH, 0, 0.5f), 0);
	assert_int_equal(tiles_of_clear(f, ACCEL_CLEAR_COLOUR, 1, 0), 0);
	assert_int_equal(tiles_of_clear(f, 0, 0, 0), 0);
	assert_int_equal(word_of(f, ACCEL_PLANE_COLOUR, 200, 200), 0xff);
	assert_int_equal(word_of(f, ACCEL_PLANE_DEPTH, 200, 200), 0x800000);
}

static void another_value_of_either_plane_sends_all(void **state)
{
	struct fixture *f = *state;

	assert_int_equal(tiles_of_clear(f, BOTH, 1, 0.5f), TILES);
	assert_int_equal(tiles_of_clear(f, BOTH, 0, 0.5f), TILES);
	assert_int_equal(tiles_of_clear(f, BOTH, 0, 1), TILES);
	assert_int_equal(word_of(f, ACCEL_PLANE_COLOUR, 200, 200), 0);
	assert_int_equal(word_of(f, ACCEL_PLANE_DEPTH, 200, 200), 0xffffff);
	assert_int_equal(tiles_of_clear(f, BOTH, 0, 1), 0);
	/* One plane is known, the other is not. */
	assert_int_equal(tiles_of_clear(f, ACCEL_CLEAR_DEPTH, 0, 0), TILES);
	assert_int_equal(tiles_of_clear(f, BOTH, 0, 0), 0);
}

static void a_tile_that_was_drawn_on_is_cleared_again(void **state)
{
	struct fixture *f = *state;

	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), TILES);
	begin(f, BOTH, 1, 1);
	draw_corner(f);
	assert_int_equal(tiles(f), 1);
	assert_int_equal(word_of(f, ACCEL_PLANE_COLOUR, 2, 2), 0xffffffff);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 1);
	assert_int_equal(word_of(f, ACCEL_PLANE_COLOUR, 2, 2), 0xff);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 0);
	/* And one that was drawn on without a clear. */
	begin(f, 0, 0, 0);
	draw_corner(f);
	assert_int_equal(tiles(f), 1);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 1);
}

static void what_is_discarded_is_not_taken_for_cleared(void **state)
{
	struct fixture *f = *state;

	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), TILES);
	begin(f, BOTH, 1, 0.5f);
	assert_int_equal(accel_draw_discard(f->draw, ACCEL_CLEAR_DEPTH), 0);
	assert_int_equal(tiles(f), 0);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 0.5f), TILES);
	assert_int_equal(word_of(f, ACCEL_PLANE_DEPTH, 200, 200), 0x800000);
}

static void what_a_program_writes_is_cleared_again(void **state)
{
	struct fixture *f = *state;
	struct accel_buffer *const plane[] = { f->target->colour, f->target->depth };
	uint32_t words[4], word = 7;
	struct accel_stream *stream;

	assert_int_equal(accel_stream_new(f->device, &stream), 0);
	for (int i = 0; i < 2; i++) {
		tiles_of_clear(f, BOTH, 1, 1);
		assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 0);
		assert_int_equal(accel_buffer_write(plane[i], 0, &word, 4), 0);
		assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), TILES);
		assert_int_not_equal(word_of(f, (enum accel_plane)i, 0, 0), 7);
		assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 0);

		assert_int_equal(accel_stream_slot(stream, plane[i], ACCEL_SLOT_WRITE), 0);
		accel_stream_emit(stream, words, packet_write(words, 0, 0, 7));
		assert_int_equal(accel_stream_finish(stream, NULL, 0), 0);
		assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), TILES);
		assert_int_not_equal(word_of(f, (enum accel_plane)i, 0, 0), 7);
		/* A job that may only read leaves it. */
		assert_int_equal(accel_buffer_read(plane[i], 0, &word, 4), 0);
		word = 7;
		assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 0);
	}
	accel_stream_free(stream);
}

static void a_clear_that_failed_is_sent_again(void **state)
{
	struct fixture *f = *state;

	begin(f, BOTH, 1, 1);
	spy_fails = 1;
	assert_int_equal(accel_draw_finish(f->draw), -EIO);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), TILES);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 0);
	/* What was there before a frame that failed is there after it. */
	begin(f, BOTH, 1, 1);
	draw_corner(f);
	spy_fails = 1;
	assert_int_equal(accel_draw_finish(f->draw), -EIO);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 1);
}

static void a_clear_counts_when_its_frame_is_known_to_be_done(void **state)
{
	struct fixture *f = *state;
	struct accel_fence *fence[3];
	struct accel_draw_stats stats;

	for (int i = 0; i < 3; i++) {
		begin(f, BOTH, 1, 1);
		assert_int_equal(accel_draw_submit(f->draw, &fence[i]), 0);
		accel_draw_stats(f->draw, &stats, sizeof(stats));
		assert_int_equal(stats.tiles, TILES);
	}
	/* The first is enough: the others cleared to the same. */
	assert_int_equal(accel_fence_wait(fence[0], -1, NULL, 0), 0);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 0);
	for (int i = 0; i < 3; i++)
		accel_fence_free(fence[i]);
}

static void a_clear_does_not_count_by_another_frames_end(void **state)
{
	struct fixture *f = *state;
	struct accel_fence *first, *second;

	begin(f, BOTH, 1, 1);
	assert_int_equal(accel_draw_submit(f->draw, &first), 0);
	begin(f, BOTH, 0, 1);
	assert_int_equal(accel_draw_submit(f->draw, &second), 0);
	assert_int_equal(accel_fence_wait(first, -1, NULL, 0), 0);
	spy_fails = 1;
	assert_int_equal(accel_fence_wait(second, -1, NULL, 0), -EIO);
	assert_int_equal(tiles_of_clear(f, BOTH, 0, 1), TILES);
	accel_fence_free(first);
	accel_fence_free(second);
}

static void frames_that_nobody_waits_for_settle_too(void **state)
{
	struct fixture *f = *state;

	begin(f, BOTH, 1, 1);
	assert_int_equal(accel_draw_submit(f->draw, NULL), 0);
	assert_int_equal(accel_device_finish(f->device), 0);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 0);
}

/* Each draw knows what the other has done. */
static void two_draws_share_what_is_known(void **state)
{
	struct fixture *f = *state;
	struct accel_draw *first = f->draw, *second;

	assert_int_equal(accel_draw_new(f->device, &second), 0);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), TILES);
	f->draw = second;
	begin(f, BOTH, 1, 1);
	draw_corner(f);
	assert_int_equal(tiles(f), 1);
	f->draw = first;
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), 1);
	accel_draw_free(second);
}

static void a_target_that_is_new_is_cleared_where_another_was(void **state)
{
	struct fixture *f = *state;

	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), TILES);
	accel_target_free(f->target);
	assert_int_equal(accel_target_new(f->device, SIDE, SIDE, &f->target), 0);
	assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), TILES);
	assert_int_equal(word_of(f, ACCEL_PLANE_COLOUR, 200, 200), 0xff);
}

static void a_board_whose_memory_may_change_gets_every_clear(void **state)
{
	struct fixture *f = *state;

	spy.memory_keeps = false;
	accel_target_free(f->target);
	assert_int_equal(accel_target_new(f->device, SIDE, SIDE, &f->target), 0);
	for (int i = 0; i < 3; i++)
		assert_int_equal(tiles_of_clear(f, BOTH, 1, 1), TILES);
	assert_false(accel_transport_drm.memory_keeps || accel_transport_usb.memory_keeps);
}

/* Some frame; the same for the same seed. */
static void random_frame(struct fixture *f, uint64_t seed)
{
	static const unsigned int masks[] = { 0, ACCEL_CLEAR_COLOUR, ACCEL_CLEAR_DEPTH, BOTH };
	struct accel_fence *fence;

	begin(f, masks[test_below(&seed, 4)], (float)test_below(&seed, 2),
	      (float)test_below(&seed, 2));
	accel_state_set_viewport(f->state, (int)test_below(&seed, SIDE),
				 (int)test_below(&seed, SIDE), (int)test_below(&seed, 2 * SIDE),
				 (int)test_below(&seed, 2 * SIDE));
	accel_state_set_depth(f->state, ACCEL_COMPARE_LEQUAL, test_below(&seed, 2));
	if (test_below(&seed, 2))
		draw_corner(f);
	assert_int_equal(accel_draw_submit(f->draw, &fence), 0);
	if (test_below(&seed, 2))
		assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
	accel_fence_free(fence);
}

static void random_frames_are_those_without_any_knowledge(void **state)
{
	static uint32_t knowing[2][SIDE * SIDE], plain[SIDE * SIDE];
	struct fixture *f = *state;
	struct accel_target *target[2] = { f->target, NULL };
	uint64_t seed = test_seed();

	spy.memory_keeps = false;
	assert_int_equal(accel_target_new(f->device, SIDE, SIDE, &target[1]), 0);
	for (int i = 0; i < 300; i++) {
		uint64_t frame = test_random(&seed);

		for (int k = 0; k < 2; k++) {
			f->target = target[k];
			random_frame(f, frame);
		}
		for (int plane = 0; i % 4 == 0 && plane < 2; plane++) {
			accel_target_read(target[0], (enum accel_plane)plane, NULL, knowing[plane],
					  SIDE * 4);
			accel_target_read(target[1], (enum accel_plane)plane, NULL, plain,
					  SIDE * 4);
			assert_memory_equal(knowing[plane], plain, sizeof(plain));
		}
	}
	f->target = target[0];
	accel_target_free(target[1]);
}

#define content_test(name) cmocka_unit_test_setup_teardown(name, setup, fixture_free)

int main(void)
{
	const struct CMUnitTest tests[] = {
		content_test(a_clear_to_what_is_there_sends_no_tile),
		content_test(another_value_of_either_plane_sends_all),
		content_test(a_tile_that_was_drawn_on_is_cleared_again),
		content_test(what_is_discarded_is_not_taken_for_cleared),
		content_test(what_a_program_writes_is_cleared_again),
		content_test(a_clear_that_failed_is_sent_again),
		content_test(a_clear_counts_when_its_frame_is_known_to_be_done),
		content_test(a_clear_does_not_count_by_another_frames_end),
		content_test(frames_that_nobody_waits_for_settle_too),
		content_test(two_draws_share_what_is_known),
		content_test(a_target_that_is_new_is_cleared_where_another_was),
		content_test(a_board_whose_memory_may_change_gets_every_clear),
		content_test(random_frames_are_those_without_any_knowledge),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
