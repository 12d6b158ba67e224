/* SPDX-License-Identifier: MIT */
/* A frame: when there is one, what it counts, and what it forgets. */
#include "draw_square.h"

static void nothing_is_drawn_before_a_frame_was_begun(void **state)
{
	static const struct accel_clear depth = ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH);
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();
	struct accel_fence *fence = NULL;

	/* One was begun by setup. */
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(mesh_draw(f, &mesh), -EINVAL);
	assert_message(&f->messages, "a mesh without a frame: call accel_draw_begin first");
	assert_int_equal(accel_draw_clear(f->draw, &depth), -EINVAL);
	assert_message(&f->messages, "a clear without a frame");
	assert_int_equal(accel_draw_submit(f->draw, &fence), -EINVAL);
	assert_message(&f->messages, "a submit without a frame");
	assert_int_equal(accel_draw_finish(f->draw), -EINVAL);
	assert_null(fence);
}

static void a_frame_that_is_begun_forgets_the_one_before(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();
	struct accel_target *other;

	assert_int_equal(accel_target_new(f->device, 20, SIDE, &other), 0);
	assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(accel_draw_begin(f->draw, other, NULL), 0);
	assert_int_equal(stats_of(f).triangles_in, 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	/* The only reference to the target is that of the frame before. */
	accel_target_free(other);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	assert_all(0);
}

static void a_target_of_another_device_is_refused(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();
	struct messages messages;
	struct accel_device *device = device_open("model:", &messages);
	struct accel_target *other;

	assert_int_equal(accel_target_new(device, SIDE, SIDE, &other), 0);
	assert_int_equal(accel_draw_begin(f->draw, other, NULL), -EINVAL);
	assert_message(&f->messages, "another device");
	/* The frame that was begun before is still there. */
	assert_int_equal(mesh_draw(f, &mesh), 0);
	accel_target_free(other);
	accel_device_free(device);
}

static void a_frame_without_anything_is_sent_and_does_nothing(void **state)
{
	struct fixture *f = *state;
	struct accel_fence *fence = NULL;
	struct accel_fence_status status;

	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(accel_draw_submit(f->draw, &fence), 0);
	assert_non_null(fence);
	assert_int_equal(accel_fence_wait(fence, -1, &status, sizeof(status)), 0);
	assert_int_equal(status.fault, 0);
	accel_fence_free(fence);
	assert_int_equal(stats_of(f).tiles, 0);
}

static void a_clear_happens_without_a_mesh(void **state)
{
	const float red[4] = { 1, 0, 0, 1 };
	struct fixture *f = *state;

	assert_int_equal(draw_begin(f->draw, f->target, red, 1), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	assert_all(RED);
}

static uint32_t depth_of(struct fixture *f, int x, int y)
{
	const struct accel_rectangle pixel = { x, y, 1, 1 };
	uint32_t depth;

	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_DEPTH, &pixel, &depth, 4), 0);
	return depth;
}

static void a_plane_that_is_discarded_is_not_stored(void **state)
{
	static const struct accel_clear near = ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH,
							   .depth = 0.125f);
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();
	uint32_t before;

	assert_int_equal(draw_begin(f->draw, f->target, black, 0.75f), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	before = depth_of(f, 50, 50);
	assert_true(before);
	accel_state_set_depth(f->state, ACCEL_COMPARE_ALWAYS, true);
	/* What was drawn is there, and depth as it was. */
	assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
	assert_int_equal(accel_draw_discard(f->draw, ACCEL_CLEAR_DEPTH), 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
	assert_all(WHITE);
	assert_int_equal(depth_of(f, 50, 50), before);
	/* Nothing is left of a clear; and of the next frame all is. */
	assert_int_equal(accel_draw_begin(f->draw, f->target, &near), 0);
	assert_int_equal(accel_draw_discard(f->draw, ACCEL_CLEAR_DEPTH), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(stats_of(f).tiles, 0);
	assert_int_equal(depth_of(f, 50, 50), before);
	assert_int_equal(accel_draw_begin(f->draw, f->target, &near), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(stats_of(f).tiles, 4);
	assert_true(depth_of(f, 50, 50) < before);
}

static void what_is_discarded_is_drawn_with_all_the_same(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();

	/* The square is at 0.5: in front of what depth was cleared to, and then behind. */
	for (int behind = 0; behind < 2; behind++) {
		assert_int_equal(draw_begin(f->draw, f->target, black, behind ? 0.25f : 0.75f), 0);
		accel_state_set_depth(f->state, ACCEL_COMPARE_LESS, true);
		assert_int_equal(mesh_draw(f, &mesh), 0);
		assert_int_equal(accel_draw_discard(f->draw, ACCEL_CLEAR_DEPTH), 0);
		assert_int_equal(accel_draw_finish(f->draw), 0);
		assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels,
						   SIDE * 4),
				 0);
		assert_all(behind ? 0 : WHITE);
	}
}

static void a_discard_of_no_plane_or_without_a_frame_is_refused(void **state)
{
	struct fixture *f = *state;

	assert_int_equal(accel_draw_discard(f->draw, 0), -EINVAL);
	assert_message(&f->messages, "a discard of the planes 0");
	assert_int_equal(accel_draw_discard(f->draw, 4), -EINVAL);
	assert_message(&f->messages, "a discard of the planes 0x4");
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_draw_discard(f->draw, ACCEL_CLEAR_DEPTH), -EINVAL);
	assert_message(&f->messages, "a discard without a frame");
}

static void counts_are_those_of_the_frame(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();

	picture(f, &mesh, pixels);
	assert_int_equal(stats_of(f).triangles_in, 2);
	assert_int_equal(stats_of(f).tiles, 4);
	assert_true(stats_of(f).records >= 4);
	assert_true(stats_of(f).stream_words > stats_of(f).records);
	/* Until the next frame begins. */
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(stats_of(f).triangles_in, 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(stats_of(f).triangles_in, 2);
	assert_int_equal(stats_of(f).tiles, 0);
	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(stats_of(f).triangles_in, 4);
}

/* The near plane cuts it, and what is left is between four pixels. */
static void a_triangle_that_clipping_leaves_nothing_of_counts_as_culled_once(void **state)
{
	static const float sliver[3][3] = { { 0.001f, 0.001f, -2 },
					    { 0.009f, 0.001f, 0 },
					    { 0.001f, 0.009f, 0 } };
	struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES, .vertices = 3,
					    .position = { .data = sliver });
	struct fixture *f = *state;

	assert_int_equal(mesh_draw(f, &mesh), 0);
	assert_int_equal(stats_of(f).triangles_in, 1);
	assert_int_equal(stats_of(f).culled, 1);
	assert_int_equal(stats_of(f).clipped, 0);
}

static void a_target_may_go_before_its_frame_is_sent(void **state)
{
	struct fixture *f = *state;
	struct accel_mesh mesh = square_mesh();
	struct accel_target *other;
	struct accel_fence *fence;

	assert_int_equal(accel_target_new(f->device, 300, 20, &other), 0);
	assert_int_equal(accel_draw_begin(f->draw, other, NULL), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), 0);
	accel_target_free(other);
	assert_int_equal(accel_draw_submit(f->draw, &fence), 0);
	assert_int_equal(accel_fence_wait(fence, -1, NULL, 0), 0);
	accel_fence_free(fence);
	/* And a draw may go with a frame in it. */
	assert_int_equal(accel_target_new(f->device, 300, 20, &other), 0);
	assert_int_equal(accel_draw_begin(f->draw, other, NULL), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), 0);
	accel_target_free(other);
}

static void free_takes_null(void **state)
{
	(void)state;
	accel_draw_free(NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		square_test(nothing_is_drawn_before_a_frame_was_begun),
		square_test(a_frame_that_is_begun_forgets_the_one_before),
		square_test(a_target_of_another_device_is_refused),
		square_test(a_frame_without_anything_is_sent_and_does_nothing),
		square_test(a_clear_happens_without_a_mesh),
		square_test(a_plane_that_is_discarded_is_not_stored),
		square_test(what_is_discarded_is_drawn_with_all_the_same),
		square_test(a_discard_of_no_plane_or_without_a_frame_is_refused),
		square_test(counts_are_those_of_the_frame),
		square_test(a_triangle_that_clipping_leaves_nothing_of_counts_as_culled_once),
		square_test(a_target_may_go_before_its_frame_is_sent),
		square_test(free_takes_null),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
