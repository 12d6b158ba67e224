/* SPDX-License-Identifier: MIT */
/* Points and lines: which pixels they are, in which colours, and what is cut. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>

#include "draw_fixture.h"

#define SIDE 64
#define WHITE 0xffffffffu

static uint32_t pixels[SIDE * SIDE];

/* Positions are pixels, y up. */
static int setup(void **state)
{
	const float projection[16] = { 2.0f / SIDE, 0, 0, 0, 0,  2.0f / SIDE, 0, 0,
				       0,           0, 1, 0, -1, -1,          0, 1 };
	struct accel_state *drawn;

	assert_int_equal(accel_state_new(&drawn), 0);
	accel_state_set_projection(drawn, projection);
	*state = fixture_new(SIDE, drawn);
	return 0;
}

static void begin(struct fixture *f)
{
	assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 0 }, 1), 0);
}

static void finish(struct fixture *f)
{
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4),
			 0);
}

static void draw(struct fixture *f, enum accel_topology topology, const float (*position)[2],
		 uint32_t count, const float (*colour)[4])
{
	const struct accel_primitive primitive = { topology, 0, count };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &primitive,
							      .primitives = 1);
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = count,
							.position = { .data = position,
								      .components = 2 },
							.colour = { .data = colour });

	begin(f);
	assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
	finish(f);
}

/* Of row @y, counted from below as OpenGL does. */
static uint32_t pixel(int x, int y)
{
	return pixels[(SIDE - 1 - y) * SIDE + x];
}

static int drawn(void)
{
	int count = 0;

	for (int i = 0; i < SIDE * SIDE; i++)
		count += pixels[i] != 0;
	return count;
}

static void line_width(struct fixture *f, float width, uint16_t stipple, uint16_t repeat)
{
	const struct accel_line_style style = ACCEL_LINE_STYLE(.width = width, .stipple = stipple,
							       .repeat = repeat);

	assert_int_equal(accel_state_set_line_style(f->state, &style), 0);
}

/* ---- lines ---- */

/* One pixel for each column, or row, from the first end to before the other; to a twentieth. */
static void a_line_has_a_pixel_for_each_step_along_its_major_axis(void **state)
{
	static const int ends[][4] = { { 3, 20, 40, 20 }, { 40, 20, 3, 20 }, { 7, 5, 7, 60 },
				       { 2, 3, 50, 30 },  { 2, 3, 30, 50 },  { 50, 3, 2, 30 },
				       { 5, 5, 45, 45 },  { 30, 50, 29, 2 } };

	for (size_t n = 0; n < sizeof(ends) / sizeof(ends[0]); n++) {
		const int *e = ends[n], across = abs(e[2] - e[0]), up = abs(e[3] - e[1]);
		const float position[2][2] = { { (float)e[0] + 0.5f, (float)e[1] + 0.5f },
					       { (float)e[2] + 0.5f, (float)e[3] + 0.5f } };
		int length = across > up ? across : up;

		draw(*state, ACCEL_TOPOLOGY_LINES, position, 2, NULL);
		assert_int_equal(drawn(), length);
		assert_int_equal(pixel(e[0], e[1]), WHITE);
		assert_int_equal(pixel(e[2], e[3]), 0);
		for (int i = 1; i < length; i++) {
			double x = e[0] + (double)(e[2] - e[0]) * i / length;
			double y = e[1] + (double)(e[3] - e[1]) * i / length;
			bool there = pixel((int)(x + 0.44), (int)(y + 0.44)) == WHITE ||
				     pixel((int)(x + 0.56), (int)(y + 0.56)) == WHITE;

			if (!there)
				fail_msg("line %zu has no pixel at step %d", n, i);
		}
	}
}

static void a_wide_line_is_wide_across_its_major_axis(void **state)
{
	static const float flat[2][2] = { { 10, 32 }, { 50, 40 } };
	static const float steep[2][2] = { { 30, 10 }, { 33, 50 } };

	for (int width = 1; width <= 9; width++) {
		line_width(*state, (float)width + 0.3f, 0, 0);
		draw(*state, ACCEL_TOPOLOGY_LINES, flat, 2, NULL);
		assert_int_equal(drawn(), 40 * width);
		draw(*state, ACCEL_TOPOLOGY_LINES, steep, 2, NULL);
		assert_int_equal(drawn(), 40 * width);
	}
}

static void strips_and_loops_join_their_vertices(void **state)
{
	static const float corner[4][2] = {
		{ 10.5f, 10.5f }, { 40.5f, 10.5f }, { 40.5f, 40.5f }, { 10.5f, 40.5f }
	};
	static const float turned[4][2] = {
		{ 10.5f, 40.5f }, { 40.5f, 40.5f }, { 40.5f, 10.5f }, { 10.5f, 10.5f }
	};

	draw(*state, ACCEL_TOPOLOGY_LINE_LOOP, corner, 4, NULL);
	assert_int_equal(drawn(), 120);
	draw(*state, ACCEL_TOPOLOGY_LINE_STRIP, corner, 4, NULL);
	assert_int_equal(drawn(), 90);
	draw(*state, ACCEL_TOPOLOGY_LINES, corner, 4, NULL);
	assert_int_equal(drawn(), 60);
	draw(*state, ACCEL_TOPOLOGY_LINES, corner, 3, NULL);
	assert_int_equal(drawn(), 30);
	draw(*state, ACCEL_TOPOLOGY_LINE_STRIP, corner, 1, NULL);
	assert_int_equal(drawn(), 0);
	draw(*state, ACCEL_TOPOLOGY_LINE_LOOP, corner, 2, NULL);
	assert_int_equal(drawn(), 31);
	/* The other way round too. */
	draw(*state, ACCEL_TOPOLOGY_LINE_LOOP, turned, 4, NULL);
	assert_int_equal(drawn(), 120);
}

/* Pixel @i of the line is there if its bit is; a strip goes on counting, lines begin anew. */
static void a_stipple_is_counted_along_its_primitive(void **state)
{
	static const float line[4][2] = {
		{ 2, 30.5f }, { 22, 30.5f }, { 22, 30.5f }, { 62, 30.5f }
	};
	static const uint16_t stipple = 0x3c9f;

	for (int repeat = 1; repeat <= 3; repeat++) {
		for (int strip = 0; strip < 2; strip++) {
			line_width(*state, 1, stipple, (uint16_t)repeat);
			draw(*state, strip ? ACCEL_TOPOLOGY_LINE_STRIP : ACCEL_TOPOLOGY_LINES, line,
			     4, NULL);
			for (int x = 2; x < 62; x++) {
				int along = x - (strip || x < 22 ? 2 : 22);
				bool wanted = stipple >> along / repeat % 16 & 1;

				assert_int_equal(pixel(x, 30) != 0, wanted);
			}
		}
	}
}

static void a_stipple_without_a_bit_draws_nothing(void **state)
{
	static const float line[2][2] = { { 2, 30.5f }, { 62, 30.5f } };

	line_width(*state, 3, 0, 1);
	draw(*state, ACCEL_TOPOLOGY_LINES, line, 2, NULL);
	assert_int_equal(drawn(), 0);
	line_width(*state, 1, 0, 0);
	draw(*state, ACCEL_TOPOLOGY_LINES, line, 2, NULL);
	assert_int_equal(drawn(), 60);
}

static void colours_run_along_a_line_or_are_its_second_vertex_s(void **state)
{
	static const float line[2][2] = { { 0, 20.5f }, { 64, 20.5f } };
	static const float colour[2][4] = { { 0, 1, 0.25f, 1 }, { 1, 0.5f, 0.25f, 1 } };
	struct fixture *f = *state;

	for (int shading = 0; shading <= ACCEL_SHADING_FLAT; shading++) {
		accel_state_set_shading(f->state, (enum accel_shading)shading);
		draw(f, ACCEL_TOPOLOGY_LINES, line, 2, colour);
		for (int x = 0; x < SIDE; x++) {
			float t = shading == ACCEL_SHADING_FLAT ? 1 : ((float)x + 0.5f) / SIDE;
			float red = 255 * t, green = 255 * (1 - t / 2);

			assert_true(fabsf((float)(pixel(x, 20) & 0xff) - red) <= 1);
			assert_true(fabsf((float)(pixel(x, 20) >> 8 & 0xff) - green) <= 1);
		}
	}
}

/* In perspective, too, where half of a line on the screen is another part of it in space. */
static void a_stippled_line_has_the_colours_of_a_whole_one(void **state)
{
	static const float line[2][4] = { { 0, 20.5f, 0, 1 }, { 8 * 64, 8 * 20.5f, 0, 8 } };
	static const float colour[2][4] = { { 0, 1, 0.25f, 1 }, { 1, 0, 0.75f, 1 } };
	static const struct accel_primitive primitive = { ACCEL_TOPOLOGY_LINES, 0, 2 };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &primitive,
							      .primitives = 1);
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 2, .position = { .data = line },
							.colour = { .data = colour });
	struct fixture *f = *state;
	uint32_t whole[SIDE];

	for (int stippled = 0; stippled < 2; stippled++) {
		line_width(f, 1, 0x00ff, (uint16_t)stippled);
		begin(f);
		assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
		finish(f);
		for (int x = 0; x < SIDE; x++)
			for (int i = 0; i < 3 && x % 16 < 8 && stippled; i++) {
				int a = (int)(pixel(x, 20) >> 8 * i & 0xff);

				assert_true(abs(a - (int)(whole[x] >> 8 * i & 0xff)) <= 2);
			}
		for (int x = 0; x < SIDE; x++)
			whole[x] = pixel(x, 20);
	}
}

/* From in front of the eye to behind it: it leaves the view, and its colour there is in between. */
static void a_line_is_cut_where_it_leaves_the_view(void **state)
{
	static const float perspective[16] = {
		1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.2f, 0
	};
	static const float position[2][3] = { { -1, 0.01f, -2 }, { 3, 0.01f, 2 } };
	static const float colour[2][4] = { { 0, 0, 0, 1 }, { 1, 1, 1, 1 } };
	static const struct accel_primitive line = { ACCEL_TOPOLOGY_LINES, 0, 2 };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &line, .primitives = 1);
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 2,
							.position = { .data = position,
								      .components = 3 },
							.colour = { .data = colour });
	struct fixture *f = *state;

	accel_state_set_projection(f->state, perspective);
	begin(f);
	assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
	finish(f);
	/* x / -z is -1/2 at the beginning, and reaches the right border at z = -1/2, t = 3/8. */
	assert_int_equal(drawn(), SIDE * 3 / 4);
	assert_true((pixels[SIDE / 2 * SIDE - 1] & 0xff) > 80);
	assert_true((pixels[SIDE / 2 * SIDE - 1] & 0xff) < 110);
}

/* ---- points ---- */

static void a_point_is_a_square_around_its_place(void **state)
{
	static const float place[1][2] = { { 20.6f, 30.3f } };
	struct fixture *f = *state;

	for (int width = 1; width <= 8; width++) {
		const struct accel_point_style style = ACCEL_POINT_STYLE(.width = (float)width +
										  0.4f);
		/* OpenGL 1.5, section 3.3: around a centre of a pixel, or around a corner. */
		int x = width % 2 ? 20 - width / 2 : 21 - width / 2, y = 30 - width / 2;

		assert_int_equal(accel_state_set_point_style(f->state, &style), 0);
		draw(f, ACCEL_TOPOLOGY_POINTS, place, 1, NULL);
		assert_int_equal(drawn(), width * width);
		for (int i = 0; i < width * width; i++)
			assert_int_equal(pixel(x + i % width, y + i / width), WHITE);
	}
}

static void points_get_smaller_with_distance(void **state)
{
	static const float place[1][2] = { { 24, 32 } }; /* 40 from the eye */
	static const struct {
		float least, most, attenuation[3];
		int width;
	} cases[] = {
		{ 0, 0, { 4, 0, 0 }, 10 },       { 0, 0, { 0, 0.1f, 0 }, 10 },
		{ 0, 0, { 0, 0, 0.0025f }, 10 }, { 12, 0, { 4, 0, 0 }, 12 },
		{ 0, 7, { 4, 0, 0 }, 7 },        { 0, 0, { 0, 0, 1 }, 1 },
		{ 0, 0, { 0, 0, 0 }, 20 },
	};
	struct fixture *f = *state;

	for (size_t n = 0; n < sizeof(cases) / sizeof(cases[0]); n++) {
		struct accel_point_style style = ACCEL_POINT_STYLE(.width = 20,
								   .least = cases[n].least,
								   .most = cases[n].most);

		memcpy(style.attenuation, cases[n].attenuation, sizeof(style.attenuation));
		assert_int_equal(accel_state_set_point_style(f->state, &style), 0);
		draw(f, ACCEL_TOPOLOGY_POINTS, place, 1, NULL);
		assert_int_equal(drawn(), cases[n].width * cases[n].width);
	}
}

static void a_point_is_there_if_its_middle_is_in_view(void **state)
{
	static const float place[4][2] = { { -0.6f, 32 }, { 32, 64.6f }, { 0.6f, 10 }, { NAN, 1 } };
	const struct accel_point_style style = ACCEL_POINT_STYLE(.width = 5);
	struct fixture *f = *state;

	assert_int_equal(accel_state_set_point_style(f->state, &style), 0);
	draw(f, ACCEL_TOPOLOGY_POINTS, place, 4, NULL);
	assert_int_equal(drawn(), 3 * 5);
}

/* ---- in one call ---- */

static void figures_are_drawn_in_the_order_of_the_call(void **state)
{
	static const float place[6][2] = { { 0, 0 },  { 64, 0 },        { 64, 64 },
					   { 0, 64 }, { 10.5f, 32.5f }, { 50.5f, 32.5f } };
	static const float colour[6][4] = { { 1, 0, 0, 1 }, { 1, 0, 0, 1 }, { 1, 0, 0, 1 },
					    { 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 1, 0, 1 } };
	static const struct accel_primitive order[2][3] = {
		{ { ACCEL_TOPOLOGY_LINES, 4, 2 },
		  { ACCEL_TOPOLOGY_POLYGON, 0, 4 },
		  { ACCEL_TOPOLOGY_POINTS, 5, 1 } },
		{ { ACCEL_TOPOLOGY_POLYGON, 0, 4 },
		  { ACCEL_TOPOLOGY_LINES, 4, 2 },
		  { ACCEL_TOPOLOGY_POINTS, 5, 1 } },
	};
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 6,
							.position = { .data = place,
								      .components = 2 },
							.colour = { .data = colour });
	struct fixture *f = *state;

	for (int i = 0; i < 2; i++) {
		const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = order[i],
								      .primitives = 3);
		int green = 0;

		begin(f);
		assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
		finish(f);
		for (int j = 0; j < SIDE * SIDE; j++)
			green += pixels[j] == 0xff00ff00;
		assert_int_equal(green, i ? 41 : 1);
	}
}

/* A lit line has the light of its vertices, as of front sides. */
static void lines_are_lit_as_front_sides(void **state)
{
	static const float line[2][2] = { { 0, 20.5f }, { 64, 20.5f } };
	static const struct accel_material green = ACCEL_MATERIAL(.emission = { 0, 1, 0, 1 },
								  .diffuse = { 0, 0, 0, 1 });
	static const struct accel_material red = ACCEL_MATERIAL(.emission = { 1, 0, 0, 1 },
								.diffuse = { 0, 0, 0, 1 });
	struct fixture *f = *state;

	assert_int_equal(accel_state_set_material(f->state, &green, &red), 0);
	accel_state_set_lighting(f->state, true);
	accel_state_set_two_sided(f->state, true);
	accel_state_set_cull(f->state, ACCEL_CULL_FRONT);
	for (int shading = 0; shading <= ACCEL_SHADING_FLAT; shading++) {
		accel_state_set_shading(f->state, (enum accel_shading)shading);
		draw(f, ACCEL_TOPOLOGY_LINES, line, 2, NULL);
		assert_int_equal(drawn(), SIDE);
		assert_int_equal(pixel(5, 20), 0xff00ff00);
	}
}

/* Triangles that clipping cuts to parts of no pixel, more than a group has room for. */
static void parts_of_no_pixel_are_many(void **state)
{
	enum { TRIANGLES = 20000 };
	static float position[3 * TRIANGLES][3];
	static const struct accel_primitive all = { ACCEL_TOPOLOGY_TRIANGLES, 0, 3 * TRIANGLES };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &all, .primitives = 1);
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 3 * TRIANGLES,
							.position = { .data = position,
								      .components = 3 });
	struct accel_draw_stats stats;
	struct fixture *f = *state;

	for (int i = 0; i < 3 * TRIANGLES; i++) {
		position[i][0] = 20.1f + (i % 3 == 1 ? 0.3f : 0);
		position[i][1] = 20.1f + (i % 3 == 2 ? 0.3f : 0);
		position[i][2] = i % 3 ? 0 : 3;
	}
	begin(f);
	assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
	finish(f);
	accel_draw_stats(f->draw, &stats, sizeof(stats));
	assert_int_equal(stats.culled, TRIANGLES);
	assert_int_equal(drawn(), 0);
}

/* Of any length, also where vertices of it are none. */
static void a_long_strip_is_its_segments(void **state)
{
	enum { VERTICES = 200 };
	static float strip[VERTICES + 1][2], pairs[2 * VERTICES][2];
	static float colour[VERTICES + 1][4], of_pairs[2 * VERTICES][4];
	static uint32_t wanted[SIDE * SIDE];
	uint64_t seed = test_seed();

	for (uint32_t count = 2; count <= VERTICES; count += count < 60 ? 29 : 1) {
		for (uint32_t i = 0; i < count; i++) {
			strip[i][0] = (float)test_below(&seed, 16 * SIDE) / 16;
			strip[i][1] = test_below(&seed, 20) ?
					      (float)test_below(&seed, 16 * SIDE) / 16 :
					      NAN;
			for (int j = 0; j < 4; j++)
				colour[i][j] = (float)test_below(&seed, 256) / 255;
		}
		for (uint32_t i = 0; i < 2 * count; i++) {
			const uint32_t of = (i / 2 + i % 2) % count;

			memcpy(pairs[i], strip[of], sizeof(pairs[i]));
			memcpy(of_pairs[i], colour[of], sizeof(of_pairs[i]));
		}
		for (uint32_t loop = 0; loop < 2; loop++) {
			draw(*state, ACCEL_TOPOLOGY_LINES, (const float(*)[2])pairs,
			     2 * (count - 1 + loop), (const float(*)[4])of_pairs);
			memcpy(wanted, pixels, sizeof(wanted));
			draw(*state, loop ? ACCEL_TOPOLOGY_LINE_LOOP : ACCEL_TOPOLOGY_LINE_STRIP,
			     (const float(*)[2])strip, count, (const float(*)[4])colour);
			assert_memory_equal(pixels, wanted, sizeof(wanted));
		}
	}
}

/* They have vertices and no triangle, and a group holds only so many. */
static void segments_of_no_length_are_many(void **state)
{
	enum { VERTICES = 100000 };
	static float position[VERTICES][2];

	for (int i = 0; i < VERTICES; i++)
		position[i][0] = position[i][1] = i < VERTICES / 2 ? 20.5f : 30.5f;
	line_width(*state, 1, 0, 0);
	draw(*state, ACCEL_TOPOLOGY_LINE_STRIP, position, VERTICES, NULL);
	assert_int_equal(drawn(), 10);
}

static void styles_that_are_none_are_refused(void **state)
{
	static const struct accel_line_style line[] = { { .width = 1 },
							ACCEL_LINE_STYLE(.width = -1),
							ACCEL_LINE_STYLE(.width = NAN) };
	static const struct accel_point_style point[] = {
		{ .width = 1 },
		ACCEL_POINT_STYLE(.width = -1),
		ACCEL_POINT_STYLE(.least = NAN),
		ACCEL_POINT_STYLE(.most = -1),
		ACCEL_POINT_STYLE(.attenuation = { 1, -1, 0 }),
		ACCEL_POINT_STYLE(.attenuation = { INFINITY, 0, 0 }),
	};
	struct fixture *f = *state;

	for (size_t i = 0; i < sizeof(line) / sizeof(line[0]); i++)
		assert_int_equal(accel_state_set_line_style(f->state, &line[i]), -EINVAL);
	for (size_t i = 0; i < sizeof(point) / sizeof(point[0]); i++)
		assert_int_equal(accel_state_set_point_style(f->state, &point[i]), -EINVAL);
}

#define strokes_test(name) cmocka_unit_test_setup_teardown(name, setup, fixture_free)

int main(void)
{
	const struct CMUnitTest tests[] = {
		strokes_test(a_line_has_a_pixel_for_each_step_along_its_major_axis),
		strokes_test(a_wide_line_is_wide_across_its_major_axis),
		strokes_test(strips_and_loops_join_their_vertices),
		strokes_test(a_stipple_is_counted_along_its_primitive),
		strokes_test(a_stipple_without_a_bit_draws_nothing),
		strokes_test(colours_run_along_a_line_or_are_its_second_vertex_s),
		strokes_test(a_stippled_line_has_the_colours_of_a_whole_one),
		strokes_test(a_line_is_cut_where_it_leaves_the_view),
		strokes_test(a_point_is_a_square_around_its_place),
		strokes_test(points_get_smaller_with_distance),
		strokes_test(a_point_is_there_if_its_middle_is_in_view),
		strokes_test(figures_are_drawn_in_the_order_of_the_call),
		strokes_test(lines_are_lit_as_front_sides),
		strokes_test(parts_of_no_pixel_are_many),
		strokes_test(a_long_strip_is_its_segments),
		strokes_test(segments_of_no_length_are_many),
		strokes_test(styles_that_are_none_are_refused),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
