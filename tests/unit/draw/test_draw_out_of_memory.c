/* SPDX-License-Identifier: MIT */
/*
 * Draws a frame once for each allocation in it and lets that one fail: the call says so, nothing
 * is left behind, and the same draw can go on. The linker puts the functions below in place of the
 * C library's (-Wl,--wrap).
 */
#include "draw_mesh.h"

#define SIDE 256

static long calls, failing; /* the call that fails, from 1; 0: none */
static long blocks;         /* that are there now */

static bool fails(void)
{
	return ++calls == failing;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void __real_free(void *block);

void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);

void *__wrap_malloc(size_t size)
{
	void *block = fails() ? NULL : __real_malloc(size);

	blocks += block != NULL;
	return block;
}

void *__wrap_calloc(size_t count, size_t size)
{
	void *block = fails() ? NULL : __real_calloc(count, size);

	blocks += block != NULL;
	return block;
}

void *__wrap_realloc(void *block, size_t size)
{
	void *now = fails() ? NULL : __real_realloc(block, size);

	blocks += now && !block;
	return now;
}

void __wrap_free(void *block)
{
	blocks -= block != NULL;
	__real_free(block);
}

static struct shape shape;
static uint32_t wanted[SIDE * SIDE], got[SIDE * SIDE];

struct fixture {
	struct messages messages;
	struct accel_device *device;
	struct accel_target *target;
	struct accel_state *state;
};

/* A triangle of vertices that are far from each other, which are gathered. */
static int draw_few(const struct fixture *f, struct accel_draw *draw)
{
	static const uint16_t index[3] = { 0, 400, 1151 };
	static const struct accel_primitive triangle = { ACCEL_TOPOLOGY_TRIANGLES, 0, 3 };
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = shape.mesh.vertices,
							.position = { .data = shape.position,
								      .components = 3 },
							.normal = shape.mesh.normal);
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &triangle,
							      .primitives = 1, .index = index,
							      .index_type = ACCEL_TYPE_USHORT);

	return accel_draw_arrays(draw, f->state, &arrays, &elements);
}

/* The outline of a polygon, which has corners of its own. */
static int draw_outline(const struct fixture *f, struct accel_draw *draw)
{
	static const struct accel_primitive polygon = { ACCEL_TOPOLOGY_POLYGON, 0, 1152 };
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = shape.mesh.vertices,
							.position = { .data = shape.position,
								      .components = 3 });
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &polygon,
							      .primitives = 1);
	int err;

	accel_state_set_polygon_mode(f->state, ACCEL_POLYGON_LINES, ACCEL_POLYGON_LINES);
	err = accel_draw_arrays(draw, f->state, &arrays, &elements);
	accel_state_set_polygon_mode(f->state, ACCEL_POLYGON_FILL, ACCEL_POLYGON_FILL);
	return err;
}

static bool submitting; /* the frame is complete */

/* Every call of a frame, to the first error. */
static int frame(const struct fixture *f, struct accel_draw *draw)
{
	const float grey[4] = { 0.2f, 0.2f, 0.2f, 1 };
	const struct accel_clear depth = ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH, .depth = 1);
	struct accel_fence *fence;
	int err = draw_begin(draw, f->target, grey, 1);

	if (!err)
		err = accel_draw_mesh(draw, f->state, &shape.mesh);
	if (!err)
		err = accel_draw_clear(draw, &depth);
	if (!err)
		err = accel_draw_mesh(draw, f->state, &shape.mesh);
	if (!err)
		err = draw_few(f, draw);
	if (!err)
		err = draw_outline(f, draw);
	submitting = !err;
	if (!err)
		err = accel_draw_submit(draw, &fence);
	if (err)
		return err;
	err = accel_fence_wait(fence, -1, NULL, 0);
	accel_fence_free(fence);
	return err;
}

static void assert_picture(const struct fixture *f)
{
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, got, SIDE * 4), 0);
	assert_memory_equal(got, wanted, sizeof(got));
}

/* A frame that could not be sent is still there; one that could not be drawn is gone. */
static void check_after_error(const struct fixture *f, struct accel_draw *draw)
{
	struct accel_draw_stats stats;

	assert_int_equal(accel_draw_finish(draw), submitting ? 0 : -EINVAL);
	accel_draw_stats(draw, &stats, sizeof(stats));
	assert_int_equal(stats.records > 0, submitting);
	if (submitting)
		assert_picture(f);
}

/* The frame with the @fail'th allocation failing, then again without. */
static void check(const struct fixture *f, long fail)
{
	long before = blocks;
	struct accel_draw *draw = NULL;
	int err;

	calls = 0;
	failing = fail;
	err = accel_draw_new(f->device, &draw);
	if (!err)
		err = frame(f, draw);
	failing = 0;
	assert_int_equal(err, fail && calls >= fail ? -ENOMEM : 0);
	if (draw && err)
		check_after_error(f, draw);
	if (draw) {
		assert_int_equal(frame(f, draw), 0);
		assert_picture(f);
	}
	accel_draw_free(draw);
	assert_int_equal(blocks, before);
}

/* Before anything of the mesh is looked at, and when the target's tiles find no room. */
static void a_frame_that_runs_out_of_memory_early_is_forgotten(void **unused)
{
	const float grey[4] = { 0.2f, 0.2f, 0.2f, 1 };
	struct accel_mesh endless;
	struct accel_draw_stats stats;
	struct accel_draw *draw;
	struct fixture f;

	(void)unused;
	shape_torus(&shape, 24);
	endless = shape.mesh;
	endless.vertices = UINT32_MAX;
	endless.index = NULL;
	f.device = device_open("model:tile=32", &f.messages);
	assert_int_equal(accel_target_new(f.device, SIDE, SIDE, &f.target), 0);
	f.state = state_shiny(60);
	assert_int_equal(accel_draw_new(f.device, &draw), 0);
	assert_int_equal(draw_begin(draw, f.target, grey, 1), 0);
	assert_int_equal(accel_draw_mesh(draw, f.state, &shape.mesh), 0);
	calls = 0;
	failing = 1;
	assert_int_equal(accel_draw_mesh(draw, f.state, &endless), -ENOMEM);
	failing = 0;
	accel_draw_stats(draw, &stats, sizeof(stats));
	assert_int_equal(stats.triangles_in, 0);
	assert_int_equal(accel_draw_finish(draw), -EINVAL);
	assert_message(&f.messages, "without a frame");
	accel_draw_free(draw);
	assert_int_equal(accel_draw_new(f.device, &draw), 0);
	calls = 0;
	failing = 1;
	assert_int_equal(draw_begin(draw, f.target, grey, 1), -ENOMEM);
	failing = 0;
	assert_int_equal(accel_draw_finish(draw), -EINVAL);
	accel_draw_free(draw);
	accel_state_free(f.state);
	accel_target_free(f.target);
	accel_device_free(f.device);
}

static int draw_rectangle(const struct fixture *f, struct accel_draw *draw)
{
	static const struct accel_fill fill = { { 0, 0, 5, 5 }, { 1, 1, 1, 1 }, 0.5f };

	return accel_draw_rectangles(draw, f->state, &fill, 1);
}

static int clear_under_a_mask(const struct fixture *f, struct accel_draw *draw)
{
	const struct accel_clear grey = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR);

	accel_state_set_colour_mask(f->state, true, false, true, true);
	return accel_draw_clear_masked(draw, f->state, &grey);
}

static void a_tile_that_finds_no_memory_for_a_rectangle_loses_the_frame(void **unused)
{
	static int (*const call[])(const struct fixture *, struct accel_draw *) = {
		draw_rectangle,
		clear_under_a_mask,
	};
	struct fixture f;

	(void)unused;
	f.device = device_open("model:tile=32", &f.messages);
	assert_int_equal(accel_target_new(f.device, SIDE, SIDE, &f.target), 0);
	f.state = state_shiny(60);
	for (size_t i = 0; i < sizeof(call) / sizeof(call[0]); i++) {
		struct accel_draw *draw;

		assert_int_equal(accel_draw_new(f.device, &draw), 0);
		assert_int_equal(accel_draw_begin(draw, f.target, NULL), 0);
		calls = 0;
		failing = 1;
		assert_int_equal(call[i](&f, draw), -ENOMEM);
		failing = 0;
		assert_int_equal(accel_draw_finish(draw), -EINVAL);
		accel_draw_free(draw);
	}
	accel_state_free(f.state);
	accel_target_free(f.target);
	accel_device_free(f.device);
}

static void a_failed_allocation_is_reported_and_leaves_a_draw_that_works(void **unused)
{
	struct fixture f;
	struct accel_draw *draw;
	long count;

	(void)unused;
	shape_torus(&shape, 24);
	f.device = device_open("model:tile=32", &f.messages);
	assert_int_equal(accel_target_new(f.device, SIDE, SIDE, &f.target), 0);
	f.state = state_shiny(60);
	calls = 0;
	assert_int_equal(accel_draw_new(f.device, &draw), 0);
	assert_int_equal(frame(&f, draw), 0);
	count = calls;
	assert_int_equal(accel_target_read(f.target, ACCEL_PLANE_COLOUR, NULL, wanted, SIDE * 4),
			 0);
	accel_draw_free(draw);
	assert_true(count > 10);
	/* 0: none fails. */
	for (long fail = 0; fail <= count; fail++)
		check(&f, fail);
	accel_state_free(f.state);
	accel_target_free(f.target);
	accel_device_free(f.device);
	print_message("%ld allocations\n", count);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_frame_that_runs_out_of_memory_early_is_forgotten),
		cmocka_unit_test(a_tile_that_finds_no_memory_for_a_rectangle_loses_the_frame),
		cmocka_unit_test(a_failed_allocation_is_reported_and_leaves_a_draw_that_works),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
