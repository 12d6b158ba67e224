/* SPDX-License-Identifier: MIT */
/* Errors of states and draws. */
#include <math.h>

#include "errors.h"

/* ---- state ---- */

static int ambient_of_nothing(void)
{
	const float rgba[4] = { 0, NAN, 0, 1 };

	return accel_state_set_ambient(test.state, rgba);
}

static int material_too_shiny(void)
{
	return accel_state_set_material(test.state,
					&(struct accel_material)ACCEL_MATERIAL(.shininess = 1001),
					NULL);
}

static int light_number_eight(void)
{
	return accel_state_set_light(test.state, 8,
				     &(struct accel_light)ACCEL_LIGHT(.enabled = false));
}

static int material_of_a_later_version(void)
{
	struct {
		struct accel_material now;
		uint64_t later;
	} material = { ACCEL_MATERIAL(), 1 };

	material.now.size = sizeof(material);
	return accel_state_set_material(test.state, &material.now, NULL);
}

static int light_of_a_later_version(void)
{
	struct {
		struct accel_light now;
		uint64_t later;
	} light = { ACCEL_LIGHT(), 1 };

	light.now.size = sizeof(light);
	return accel_state_set_light(test.state, 0, &light.now);
}

static int clip_plane_number_six(void)
{
	return accel_state_set_clip_plane(test.state, ACCEL_USER_CLIP_PLANES, NULL);
}

static int offset_without_end(void)
{
	return accel_state_set_polygon_offset(test.state, INFINITY, 0, 1u << ACCEL_POLYGON_FILL);
}

static int line_of_no_size(void)
{
	return accel_state_set_line_style(test.state, &(struct accel_line_style){ .width = 1 });
}

static int point_of_no_size(void)
{
	return accel_state_set_point_style(test.state, &(struct accel_point_style){ .width = 1 });
}

static int line_of_a_later_version(void)
{
	struct {
		struct accel_line_style now;
		uint64_t later;
	} style = { ACCEL_LINE_STYLE(), 1 };

	style.now.size = sizeof(style);
	return accel_state_set_line_style(test.state, &style.now);
}

static int point_of_a_later_version(void)
{
	struct {
		struct accel_point_style now;
		uint64_t later;
	} style = { ACCEL_POINT_STYLE(), 1 };

	style.now.size = sizeof(style);
	return accel_state_set_point_style(test.state, &style.now);
}

/* ---- draws ---- */

static const float corner[3][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 0, 1, 0 } };
static const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
						 .vertices = 3, .position = { .data = corner });

static int draw_mesh(void)
{
	assert_int_equal(accel_draw_begin(test.draw, test.target, NULL), 0);
	return accel_draw_mesh(test.draw, test.state, &mesh);
}

static int begin_and(const struct accel_clear *clear)
{
	return accel_draw_begin(test.draw, test.target, clear);
}

static int begin_with_a_clear_of_what_is_not_there(void)
{
	static const struct accel_clear odd = ACCEL_CLEAR(.mask = 4);

	return begin_and(&odd);
}

/* A clear of a later version. */
static const struct {
	struct accel_clear now;
	uint64_t later;
} later_clear = { { .size = sizeof(later_clear), .mask = ACCEL_CLEAR_DEPTH }, 1 };

static int begin_with_a_clear_of_a_later_version(void)
{
	return begin_and(&later_clear.now);
}

static int clear_before_a_frame(void)
{
	static const struct accel_clear depth = ACCEL_CLEAR(.mask = ACCEL_CLEAR_DEPTH);

	return accel_draw_clear(test.draw, &depth);
}

static int discard_before_a_frame(void)
{
	return accel_draw_discard(test.draw, ACCEL_CLEAR_DEPTH);
}

static int capture_before_a_frame(void)
{
	return accel_draw_capture(test.draw, NULL, NULL);
}

static int clear_of_a_later_version(void)
{
	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_clear(test.draw, &later_clear.now);
}

static int masked_clear_of_no_colour(void)
{
	static const struct accel_clear odd = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR,
							  .rgba = { NAN });

	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_clear_masked(test.draw, test.state, &odd);
}

static int masked_clear_of_a_later_version(void)
{
	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_clear_masked(test.draw, test.state, &later_clear.now);
}

static int rectangle_behind_the_far_plane(void)
{
	static const struct accel_fill far = { { 0, 0, 1, 1 }, { 0, 0, 0, 0 }, 1.5f };

	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_rectangles(test.draw, test.state, &far, 1);
}

static int mesh_without_positions(void)
{
	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_mesh(test.draw, test.state,
			       &(struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLES,
							      .vertices = 3));
}

static int mesh_of_a_later_version(void)
{
	struct {
		struct accel_mesh now;
		uint64_t later;
	} later = { mesh, 1 };

	later.now.size = sizeof(later);
	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_mesh(test.draw, test.state, &later.now);
}

static const struct accel_primitive triangle = { ACCEL_TOPOLOGY_TRIANGLES, 0, 3 };
static const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &triangle,
							     .primitives = 1);

static int arrays_without_positions(void)
{
	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_arrays(test.draw, test.state,
				 &(struct accel_arrays)ACCEL_ARRAYS(.vertices = 3), &elements);
}

static int arrays_of_a_later_version(void)
{
	struct {
		struct accel_arrays now;
		uint64_t later;
	} later = { ACCEL_ARRAYS(.vertices = 3, .position = { .data = corner, .components = 3 }),
		    1 };

	later.now.size = sizeof(later);
	assert_int_equal(begin_and(NULL), 0);
	return accel_draw_arrays(test.draw, test.state, &later.now, &elements);
}

static int submit_draw(void)
{
	return accel_draw_submit(test.draw, NULL);
}

static int finish_draw(void)
{
	return accel_draw_finish(test.draw);
}

static int finish_a_frame_on_a_board_that_fails(void)
{
	assert_int_equal(draw_mesh(), 0);
	fail_board();
	return finish_draw();
}

static int submit_a_frame_to_no_board(void)
{
	assert_int_equal(draw_mesh(), 0);
	unplug();
	/* The board is missed when it is to do something. */
	assert_int_equal(accel_stream_finish(test.stream, NULL, 0), -ENODEV);
	return submit_draw();
}

static int finish_a_frame_on_no_board(void)
{
	assert_int_equal(draw_mesh(), 0);
	unplug();
	return finish_draw();
}

static int finish_a_frame_without_memory(void)
{
	assert_int_equal(draw_mesh(), 0);
	refuse_memory();
	return finish_draw();
}

const struct reached errors_draw[] = {
	{ "accel_state_set_ambient", -EINVAL, ambient_of_nothing },
	{ "accel_state_set_material", -EINVAL, material_too_shiny },
	{ "accel_state_set_light", -EINVAL, light_number_eight },
	{ "accel_state_set_material", -E2BIG, material_of_a_later_version },
	{ "accel_state_set_light", -E2BIG, light_of_a_later_version },
	{ "accel_state_set_clip_plane", -EINVAL, clip_plane_number_six },
	{ "accel_state_set_polygon_offset", -EINVAL, offset_without_end },
	{ "accel_state_set_line_style", -EINVAL, line_of_no_size },
	{ "accel_state_set_line_style", -E2BIG, line_of_a_later_version },
	{ "accel_state_set_point_style", -EINVAL, point_of_no_size },
	{ "accel_state_set_point_style", -E2BIG, point_of_a_later_version },
	{ "accel_draw_begin", -EINVAL, begin_with_a_clear_of_what_is_not_there },
	{ "accel_draw_begin", -E2BIG, begin_with_a_clear_of_a_later_version },
	{ "accel_draw_clear", -EINVAL, clear_before_a_frame },
	{ "accel_draw_capture", -EINVAL, capture_before_a_frame },
	{ "accel_draw_discard", -EINVAL, discard_before_a_frame },
	{ "accel_draw_clear", -E2BIG, clear_of_a_later_version },
	{ "accel_draw_clear_masked", -EINVAL, masked_clear_of_no_colour },
	{ "accel_draw_clear_masked", -E2BIG, masked_clear_of_a_later_version },
	{ "accel_draw_rectangles", -EINVAL, rectangle_behind_the_far_plane },
	{ "accel_draw_mesh", -EINVAL, mesh_without_positions },
	{ "accel_draw_mesh", -E2BIG, mesh_of_a_later_version },
	{ "accel_draw_arrays", -EINVAL, arrays_without_positions },
	{ "accel_draw_arrays", -E2BIG, arrays_of_a_later_version },
	{ "accel_draw_submit", -EINVAL, submit_draw },
	{ "accel_draw_submit", -ENODEV, submit_a_frame_to_no_board },
	{ "accel_draw_finish", -EINVAL, finish_draw },
	{ "accel_draw_finish", -EIO, finish_a_frame_on_a_board_that_fails },
	{ "accel_draw_finish", -ENODEV, finish_a_frame_on_no_board },
	{ "accel_draw_finish", -ENOMEM, finish_a_frame_without_memory },
	{ .function = NULL },
};
