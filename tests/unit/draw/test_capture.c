/* SPDX-License-Identifier: MIT */
/* What is captured instead of drawn: where it is, in which colours, and what is not. */
#include <math.h>

#include "draw_fixture.h"

#define SIDE 64
#define CAPTURED 64
#define CORNERS 64

/* What came. */
static struct captured {
	enum accel_captured what;
	uint32_t vertices;
	struct accel_captured_vertex vertex[CORNERS];
} captured[CAPTURED];
static int count;

static void take(void *data, enum accel_captured what, const struct accel_captured_vertex *vertex,
		 uint32_t vertices)
{
	assert_ptr_equal(data, captured);
	assert_true(count < CAPTURED && vertices <= CORNERS);
	captured[count].what = what;
	captured[count].vertices = vertices;
	memcpy(captured[count++].vertex, vertex, vertices * sizeof(*vertex));
}

/* Clip space is that of positions: x, y, z of -1 to 1 are in view. */
static int setup(void **state)
{
	struct accel_state *drawn;

	assert_int_equal(accel_state_new(&drawn), 0);
	*state = fixture_new(SIDE, drawn);
	return 0;
}

static void capture(struct fixture *f, enum accel_topology topology, const float (*position)[4],
		    uint32_t vertices, const float (*colour)[4])
{
	const struct accel_primitive primitive = { topology, 0, vertices };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &primitive,
							      .primitives = 1);
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = vertices,
							.position = { .data = position },
							.colour = { .data = colour });
	struct accel_draw_stats stats;

	count = 0;
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(accel_draw_capture(f->draw, take, captured), 0);
	assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
	assert_int_equal(accel_draw_capture(f->draw, NULL, NULL), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	accel_draw_stats(f->draw, &stats, sizeof(stats));
	assert_int_equal(stats.records, 0);
}

static void assert_near(float a, double b, double by)
{
	if (!(fabs((double)a - b) <= by))
		fail_msg("%f is not %f", (double)a, b);
}

/* ---- a second clipping, in double precision ---- */

struct corner {
	double clip[4], colour[4];
};

static double inside(const struct corner *corner, int plane)
{
	return corner->clip[3] + (plane % 2 ? -1 : 1) * corner->clip[plane / 2];
}

static int cut(struct corner *polygon, int corners, int plane)
{
	struct corner out[CORNERS];
	int kept = 0;

	for (int i = 0; i < corners; i++) {
		const struct corner *a = &polygon[i], *b = &polygon[(i + 1) % corners];
		const double from = inside(a, plane), to = inside(b, plane), t = from / (from - to);

		if (from >= 0)
			out[kept++] = *a;
		if ((from >= 0) == (to >= 0))
			continue;
		for (int j = 0; j < 4; j++) {
			out[kept].clip[j] = a->clip[j] + t * (b->clip[j] - a->clip[j]);
			out[kept].colour[j] = a->colour[j] + t * (b->colour[j] - a->colour[j]);
		}
		kept++;
	}
	memcpy(polygon, out, (size_t)kept * sizeof(*out));
	return kept;
}

static void corner_window(const struct corner *corner, double window[4])
{
	const double *clip = corner->clip;

	window[0] = (clip[0] / clip[3] + 1) * SIDE / 2;
	window[1] = (1 - clip[1] / clip[3]) * SIDE / 2;
	window[2] = (clip[2] / clip[3] + 1) / 2;
	window[3] = clip[3];
}

/* Is there a corner of @polygon where the vertex is, with its colour? */
static bool has_vertex(const struct corner *polygon, int corners,
		       const struct accel_captured_vertex *vertex)
{
	for (int i = 0; i < corners; i++) {
		double window[4], far = 0;

		corner_window(&polygon[i], window);
		for (int j = 0; j < 4; j++) {
			far = fmax(far, fabs(window[j] - (double)vertex->window[j]));
			far = fmax(far, fabs(polygon[i].colour[j] - (double)vertex->colour[j]));
		}
		if (far < 1e-3)
			return true;
	}
	return false;
}

static void random_corners(uint64_t *seed, int corners, float (*position)[4], float (*colour)[4],
			   struct corner *polygon)
{
	for (int i = 0; i < corners; i++)
		for (int j = 0; j < 4; j++) {
			position[i][j] = (float)test_below(seed, 4001) / 1000 - 2;
			if (j == 3)
				position[i][j] = 0.5f + (float)test_below(seed, 1000) / 1000;
			colour[i][j] = (float)test_below(seed, 256) / 255;
			polygon[i].clip[j] = (double)position[i][j];
			polygon[i].colour[j] = (double)colour[i][j];
		}
}

static void a_triangle_is_captured_as_it_is_clipped_to_the_view(void **state)
{
	uint64_t seed = test_seed();
	int clipped = 0;

	for (int n = 0; n < 2000; n++) {
		float position[3][4], colour[3][4];
		struct corner polygon[CORNERS];
		int corners = 3;

		random_corners(&seed, 3, position, colour, polygon);
		capture(*state, ACCEL_TOPOLOGY_TRIANGLES, position, 3, colour);
		for (int plane = 0; plane < 6 && corners; plane++)
			corners = cut(polygon, corners, plane);
		assert_int_equal(count, corners > 0);
		if (!corners)
			continue;
		assert_int_equal(captured[0].what, ACCEL_CAPTURED_POLYGON);
		assert_int_equal(captured[0].vertices, corners);
		for (int i = 0; i < corners; i++)
			assert_true(has_vertex(polygon, corners, &captured[0].vertex[i]));
		clipped += corners > 3;
	}
	assert_true(clipped > 200);
}

/* The part of the sixteenth of a pixel is there, too. */
static void a_point_has_its_place_to_the_last_digit(void **state)
{
	static const float position[2][4] = { { 0.123456f, -0.654321f, 0.25f, 1 },
					      { 1.0001f, 0, 0, 1 } };
	static const float colour[2][4] = { { 0.1f, 0.2f, 1.5f, 0.4f } };
	const struct accel_captured_vertex *vertex = captured[0].vertex;

	capture(*state, ACCEL_TOPOLOGY_POINTS, position, 2, colour);
	assert_int_equal(count, 1);
	assert_int_equal(captured[0].what, ACCEL_CAPTURED_POINT);
	assert_int_equal(captured[0].vertices, 1);
	assert_near(vertex->window[0], (1 + 0.123456) * SIDE / 2, 1e-5);
	assert_near(vertex->window[1], (1 + 0.654321) * SIDE / 2, 1e-5);
	assert_near(vertex->window[2], 0.625, 1e-6);
	assert_near(vertex->window[3], 1, 0);
	assert_near(vertex->colour[1], 0.2, 1e-6);
	assert_near(vertex->colour[2], 1, 0);
}

static void lines_are_cut_and_the_first_of_a_strip_is_marked(void **state)
{
	static const float position[3][4] = { { -2, 0, 0, 1 }, { 0, 0, 0, 1 }, { 0, 0.5f, 0, 1 } };

	capture(*state, ACCEL_TOPOLOGY_LINE_STRIP, position, 3, NULL);
	assert_int_equal(count, 2);
	assert_int_equal(captured[0].what, ACCEL_CAPTURED_LINE_FIRST);
	assert_int_equal(captured[1].what, ACCEL_CAPTURED_LINE);
	assert_near(captured[0].vertex[0].window[0], 0, 1e-5);
	assert_near(captured[0].vertex[1].window[0], SIDE / 2, 1e-5);
	assert_near(captured[1].vertex[1].window[1], SIDE / 4, 1e-5);
}

static const float quad[4][4] = {
	{ -0.5f, -0.5f, 0, 1 }, { 0.5f, -0.5f, 0, 1 }, { 0.5f, 0.5f, 0, 1 }, { -0.5f, 0.5f, 0, 1 }
};

static void a_quad_is_one_polygon_or_its_outline_or_culled(void **state)
{
	struct fixture *f = *state;

	capture(f, ACCEL_TOPOLOGY_QUADS, quad, 4, NULL);
	assert_int_equal(count, 1);
	assert_int_equal(captured[0].vertices, 4);
	accel_state_set_polygon_mode(f->state, ACCEL_POLYGON_LINES, ACCEL_POLYGON_LINES);
	capture(f, ACCEL_TOPOLOGY_QUADS, quad, 4, NULL);
	assert_int_equal(count, 4);
	for (int i = 0; i < 4; i++)
		assert_int_equal(captured[i].what,
				 i ? ACCEL_CAPTURED_LINE : ACCEL_CAPTURED_LINE_FIRST);
	accel_state_set_polygon_mode(f->state, ACCEL_POLYGON_POINTS, ACCEL_POLYGON_POINTS);
	capture(f, ACCEL_TOPOLOGY_QUADS, quad, 4, NULL);
	assert_int_equal(count, 4);
	assert_int_equal(captured[3].what, ACCEL_CAPTURED_POINT);
	accel_state_set_polygon_mode(f->state, ACCEL_POLYGON_FILL, ACCEL_POLYGON_FILL);
	accel_state_set_cull(f->state, ACCEL_CULL_FRONT);
	capture(f, ACCEL_TOPOLOGY_QUADS, quad, 4, NULL);
	accel_state_set_cull(f->state, ACCEL_CULL_NONE);
	assert_int_equal(count, 0);
}

static void a_flat_primitive_is_captured_in_one_colour(void **state)
{
	static const float colour[4][4] = {
		{ 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 }, { 1, 1, 0, 1 }
	};
	struct fixture *f = *state;

	accel_state_set_shading(f->state, ACCEL_SHADING_FLAT);
	capture(f, ACCEL_TOPOLOGY_QUADS, quad, 4, colour);
	accel_state_set_shading(f->state, ACCEL_SHADING_ADAPTIVE);
	assert_int_equal(count, 1);
	for (int i = 0; i < 4; i++)
		assert_memory_equal(captured[0].vertex[i].colour, colour[3], sizeof(colour[3]));
}

/* The ambient light 0.2 on the reflectance 0.2, and the first light from the front on 0.8. */
static void what_is_captured_is_lit(void **state)
{
	static const float normal[3] = { 0, 0, 1 };
	static const struct accel_primitive point = { ACCEL_TOPOLOGY_POINTS, 0, 1 };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &point, .primitives = 1);
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 1, .position = { .data = quad },
							.normal = { .data = normal });
	const struct accel_light light = ACCEL_LIGHT(.enabled = true, .position = { 0, 0, 1, 0 },
						     .diffuse = { 1, 0.5f, 0, 1 });
	struct fixture *f = *state;

	count = 0;
	accel_state_set_lighting(f->state, true);
	assert_int_equal(accel_state_set_light(f->state, 0, &light), 0);
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(accel_draw_capture(f->draw, take, captured), 0);
	assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
	accel_state_set_lighting(f->state, false);
	assert_int_equal(count, 1);
	assert_near(captured[0].vertex[0].colour[0], 0.84, 1e-5);
	assert_near(captured[0].vertex[0].colour[1], 0.44, 1e-5);
	assert_near(captured[0].vertex[0].colour[2], 0.04, 1e-5);
	assert_near(captured[0].vertex[0].colour[3], 1, 1e-6);
}

static void a_capture_ends_with_its_frame_and_needs_one(void **state)
{
	static const struct accel_mesh mesh = ACCEL_MESH(.topology = ACCEL_TOPOLOGY_QUADS,
							 .vertices = 4,
							 .position = { .data = quad,
								       .components = 4 });
	struct accel_draw_stats stats;
	struct fixture *f = *state;

	count = 0;
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(accel_draw_capture(f->draw, take, captured), 0);
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	accel_draw_stats(f->draw, &stats, sizeof(stats));
	assert_int_equal(count, 0);
	assert_true(stats.records > 0);
	assert_int_equal(accel_draw_capture(f->draw, take, captured), -EINVAL);
}

/* Coordinates that no target has are no reason to leave what numbers hold. */
static void a_viewport_far_away_captures_nothing(void **state)
{
	struct fixture *f = *state;

	accel_state_set_viewport(f->state, INT32_MAX - 10, INT32_MIN, INT32_MAX, INT32_MAX);
	capture(f, ACCEL_TOPOLOGY_QUADS, quad, 4, NULL);
	assert_int_equal(count, 0);
	accel_state_set_viewport(f->state, 0, 0, -1, -1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_triangle_is_captured_as_it_is_clipped_to_the_view),
		cmocka_unit_test(a_point_has_its_place_to_the_last_digit),
		cmocka_unit_test(lines_are_cut_and_the_first_of_a_strip_is_marked),
		cmocka_unit_test(a_quad_is_one_polygon_or_its_outline_or_culled),
		cmocka_unit_test(a_flat_primitive_is_captured_in_one_colour),
		cmocka_unit_test(what_is_captured_is_lit),
		cmocka_unit_test(a_capture_ends_with_its_frame_and_needs_one),
		cmocka_unit_test(a_viewport_far_away_captures_nothing),
	};

	return cmocka_run_group_tests(tests, setup, fixture_free);
}
