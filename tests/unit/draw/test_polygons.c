/* SPDX-License-Identifier: MIT */
/*
 * Polygons as their outlines: the same pixels as points and lines that are drawn as such, whatever
 * the topology, and depth that is offset.
 */
#include <math.h>

#include "draw_fixture.h"

#define SIDE 64
#define PIXELS (SIDE * SIDE)

static uint32_t pixels[PIXELS], others[PIXELS], depths[PIXELS];

/* Positions are pixels, y up; depth is z. */
static int setup(void **state)
{
	const float projection[16] = { 2.0f / SIDE, 0, 0, 0, 0,  2.0f / SIDE, 0,  0,
				       0,           0, 2, 0, -1, -1,          -1, 1 };
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

static void finish(struct fixture *f, uint32_t *to)
{
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, to, SIDE * 4), 0);
}

struct drawing {
	float position[12][3], colour[12][4];
	uint8_t edge[12];
	bool flagged;
};

static void add(struct fixture *f, const struct drawing *drawing, enum accel_topology topology,
		const uint8_t *index, uint32_t count)
{
	const struct accel_primitive primitive = { topology, 0, count };
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &primitive,
							      .primitives = 1, .index = index,
							      .index_type = ACCEL_TYPE_UBYTE);
	const struct accel_arrays arrays = ACCEL_ARRAYS(
			.vertices = 12, .position = { .data = drawing->position, .components = 3 },
			.colour = { .data = drawing->colour },
			.edge = { .data = drawing->flagged ? drawing->edge : NULL,
				  .type = ACCEL_TYPE_UBYTE });

	assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
}

static void random_drawing(uint64_t *seed, struct drawing *drawing)
{
	drawing->flagged = test_below(seed, 2);
	for (int i = 0; i < 12; i++) {
		for (int j = 0; j < 2; j++)
			drawing->position[i][j] = (float)test_below(seed, 16 * SIDE) / 16;
		drawing->position[i][2] = (float)test_below(seed, 1000) / 1000;
		for (int j = 0; j < 4; j++)
			drawing->colour[i][j] = (float)test_below(seed, 256) / 255;
		drawing->edge[i] = (uint8_t)test_below(seed, 2);
	}
}

static void both_modes(struct fixture *f, enum accel_polygon_mode mode)
{
	accel_state_set_polygon_mode(f->state, mode, mode);
}

/* The polygons of a topology by their vertices (OpenGL 1.5, section 2.6.1), the flat one's first. */
static const struct topology {
	enum accel_topology topology;
	uint32_t count;
	bool separate; /* its edges have flags */
	int corners;
	int provoking;
	uint8_t polygon[4][12]; /* a row without two vertices that differ is none */
} topologies[] = {
	{ ACCEL_TOPOLOGY_TRIANGLES, 7, true, 3, 2, { { 0, 1, 2 }, { 3, 4, 5 } } },
	{ ACCEL_TOPOLOGY_TRIANGLE_STRIP,
	  5,
	  false,
	  3,
	  2,
	  { { 0, 1, 2 }, { 2, 1, 3 }, { 2, 3, 4 } } },
	{ ACCEL_TOPOLOGY_TRIANGLE_FAN, 5, false, 3, 2, { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 } } },
	{ ACCEL_TOPOLOGY_QUADS, 9, true, 4, 3, { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } } },
	{ ACCEL_TOPOLOGY_QUAD_STRIP, 7, false, 4, 2, { { 0, 1, 3, 2 }, { 2, 3, 5, 4 } } },
	{ ACCEL_TOPOLOGY_POLYGON, 12, true, 12, 0, { { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 } } },
};

/* By hand: lines, or points, one after the other. */
static void add_outline(struct fixture *f, const struct drawing *drawing,
			const struct topology *topology, const uint8_t *polygon,
			enum accel_polygon_mode mode, bool flat)
{
	for (int i = 0; i < topology->corners; i++) {
		const uint8_t a = polygon[i], b = polygon[(i + 1) % topology->corners];
		struct drawing two = *drawing;

		if (topology->separate && drawing->flagged && !drawing->edge[a])
			continue;
		for (int j = 0; j < 12 && flat; j++)
			memcpy(two.colour[j], drawing->colour[polygon[topology->provoking]],
			       sizeof(two.colour[j]));
		if (mode == ACCEL_POLYGON_LINES)
			add(f, &two, ACCEL_TOPOLOGY_LINES, (const uint8_t[2]){ a, b }, 2);
		else
			add(f, &two, ACCEL_TOPOLOGY_POINTS, &a, 1);
	}
}

static void check_outlines(struct fixture *f, const struct drawing *drawing,
			   const struct topology *topology, enum accel_polygon_mode mode, bool flat)
{
	accel_state_set_shading(f->state, flat ? ACCEL_SHADING_FLAT : ACCEL_SHADING_ADAPTIVE);
	both_modes(f, mode);
	begin(f);
	add(f, drawing, topology->topology, NULL, topology->count);
	finish(f, pixels);
	begin(f);
	for (int i = 0; i < 4 && topology->polygon[i][0] != topology->polygon[i][1]; i++)
		add_outline(f, drawing, topology, topology->polygon[i], mode, flat);
	finish(f, others);
	assert_memory_equal(pixels, others, sizeof(pixels));
}

static void an_outline_is_what_its_lines_or_points_are(void **state)
{
	uint64_t seed = test_seed();
	struct fixture *f = *state;
	struct drawing drawing;

	for (int n = 0; n < 40; n++) {
		random_drawing(&seed, &drawing);
		for (size_t i = 0; i < sizeof(topologies) / sizeof(topologies[0]); i++) {
			check_outlines(f, &drawing, &topologies[i], ACCEL_POLYGON_LINES, n % 2);
			check_outlines(f, &drawing, &topologies[i], ACCEL_POLYGON_POINTS, n % 2);
		}
	}
}

static const struct drawing square = {
	.position = { { 8, 8, 0.5f }, { 56, 8, 0.5f }, { 56, 56, 0.5f }, { 8, 56, 0.5f } },
	.colour = { { 1, 1, 1, 1 }, { 1, 1, 1, 1 }, { 1, 1, 1, 1 }, { 1, 1, 1, 1 } },
};
static const uint8_t turned[4] = { 0, 3, 2, 1 };

/* Of a square whose flags are all off only what clipping made is left. */
static void an_edge_that_clipping_makes_is_an_outline(void **state)
{
	const float plane[4] = { -1, 0, 0, 30.5f };
	struct drawing drawing = square;
	struct fixture *f = *state;

	drawing.flagged = true;
	both_modes(f, ACCEL_POLYGON_LINES);
	assert_int_equal(accel_state_set_clip_plane(f->state, 0, plane), 0);
	begin(f);
	add(f, &drawing, ACCEL_TOPOLOGY_QUADS, NULL, 4);
	finish(f, pixels);
	assert_int_equal(accel_state_set_clip_plane(f->state, 0, NULL), 0);
	for (int i = 0; i < PIXELS; i++)
		assert_int_equal(pixels[i] != 0, i % SIDE == 30 && i / SIDE >= 8 && i / SIDE < 56);
}

/* The same, and the flags of what it cuts stay. */
static void an_edge_that_is_cut_keeps_its_flag(void **state)
{
	const float plane[4] = { -1, 0, 0, 30.5f };
	struct drawing drawing = square;
	struct fixture *f = *state;

	drawing.flagged = true;
	drawing.edge[2] = 1;
	both_modes(f, ACCEL_POLYGON_LINES);
	assert_int_equal(accel_state_set_clip_plane(f->state, 0, plane), 0);
	begin(f);
	add(f, &drawing, ACCEL_TOPOLOGY_QUADS, NULL, 4);
	finish(f, pixels);
	assert_int_equal(accel_state_set_clip_plane(f->state, 0, NULL), 0);
	/* From (56, 56) to (8, 56); the target's row 0 is at the top. */
	assert_int_not_equal(pixels[8 * SIDE + 12] | pixels[7 * SIDE + 12], 0);
	assert_int_equal(pixels[8 * SIDE + 40] | pixels[7 * SIDE + 40], 0);
	assert_int_equal(pixels[55 * SIDE + 12] | pixels[56 * SIDE + 12], 0);
}

static void what_is_behind_the_eye_has_a_side_too(void **state)
{
	/* w is z, so that the square reaches from behind the eye to in front of it. */
	const float projection[16] = { 2.0f / SIDE, 0, 0, 0, 0, 2.0f / SIDE, 0, 0,
				       0,           0, 1, 1, 0, 0,           0, 0 };
	const float flat[16] = { 2.0f / SIDE, 0, 0, 0, 0,  2.0f / SIDE, 0,  0,
				 0,           0, 2, 0, -1, -1,          -1, 1 };
	struct drawing drawing = {
		.position = { { -8, -20, 1 }, { 8, -20, 1 }, { 8, 1, -1 }, { -8, 1, -1 } }
	};
	struct fixture *f = *state;

	for (int i = 0; i < 12; i++)
		drawing.colour[i][0] = drawing.colour[i][3] = 1;
	accel_state_set_projection(f->state, projection);
	for (int back = 0; back < 2; back++) {
		accel_state_set_polygon_mode(f->state, ACCEL_POLYGON_LINES, ACCEL_POLYGON_LINES);
		accel_state_set_cull(f->state, back ? ACCEL_CULL_FRONT : ACCEL_CULL_BACK);
		begin(f);
		add(f, &drawing, ACCEL_TOPOLOGY_QUADS, NULL, 4);
		finish(f, pixels);
		both_modes(f, ACCEL_POLYGON_FILL);
		begin(f);
		add(f, &drawing, ACCEL_TOPOLOGY_QUADS, NULL, 4);
		finish(f, others);
		bool outlined = false, filled = false;

		for (int i = 0; i < PIXELS; i++) {
			outlined |= pixels[i] != 0;
			filled |= others[i] != 0;
		}
		assert_int_equal(outlined, filled);
	}
	accel_state_set_cull(f->state, ACCEL_CULL_NONE);
	accel_state_set_projection(f->state, flat);
}

/* One call and many calls, of which each has one side only. */
static void sides_of_different_modes_are_drawn_in_order(void **state)
{
	uint64_t seed = test_seed();
	struct fixture *f = *state;
	struct drawing drawing;

	accel_state_set_shading(f->state, ACCEL_SHADING_ADAPTIVE);
	for (int n = 0; n < 60; n++) {
		const enum accel_polygon_mode other = n % 2 ? ACCEL_POLYGON_LINES :
							      ACCEL_POLYGON_POINTS;

		random_drawing(&seed, &drawing);
		accel_state_set_polygon_mode(f->state, n % 4 < 2 ? other : ACCEL_POLYGON_FILL,
					     n % 4 < 2 ? ACCEL_POLYGON_FILL : other);
		begin(f);
		add(f, &drawing, ACCEL_TOPOLOGY_TRIANGLES, NULL, 12);
		finish(f, pixels);
		begin(f);
		for (uint8_t i = 0; i < 12; i += 3)
			add(f, &drawing, ACCEL_TOPOLOGY_TRIANGLES,
			    (const uint8_t[3]){ i, (uint8_t)(i + 1), (uint8_t)(i + 2) }, 3);
		finish(f, others);
		assert_memory_equal(pixels, others, sizeof(pixels));
	}
}

static void the_mode_is_that_of_the_side_that_is_seen(void **state)
{
	static const int corner = 20 * SIDE + 20; /* inside, off the outline */
	struct fixture *f = *state;

	accel_state_set_polygon_mode(f->state, ACCEL_POLYGON_FILL, ACCEL_POLYGON_LINES);
	for (int way = 0; way < 4; way++) {
		const bool back = way & 1;

		accel_state_set_front_face(f->state, way & 2);
		begin(f);
		add(f, &square, ACCEL_TOPOLOGY_QUADS, back != (way >> 1 & 1) ? turned : NULL, 4);
		finish(f, pixels);
		assert_int_equal(pixels[corner] != 0, !back);
	}
	accel_state_set_front_face(f->state, false);
}

static void nothing_is_drawn_of_polygons_that_are_culled_on_both_sides(void **state)
{
	struct fixture *f = *state;

	accel_state_set_cull(f->state, ACCEL_CULL_BOTH);
	for (int mode = 0; mode < 3; mode++) {
		both_modes(f, (enum accel_polygon_mode)mode);
		begin(f);
		add(f, &square, ACCEL_TOPOLOGY_QUADS, NULL, 4);
		add(f, &square, ACCEL_TOPOLOGY_QUADS, turned, 4);
		finish(f, pixels);
		for (int i = 0; i < PIXELS; i++)
			assert_int_equal(pixels[i], 0);
	}
	begin(f);
	add(f, &square, ACCEL_TOPOLOGY_LINES, NULL, 2);
	finish(f, pixels);
	accel_state_set_cull(f->state, ACCEL_CULL_NONE);
	assert_int_not_equal(pixels[55 * SIDE + 20] | pixels[56 * SIDE + 20], 0);
}

/* ---- offset ---- */

static void read_depths(struct fixture *f)
{
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_DEPTH, NULL, depths, SIDE * 4),
			 0);
}

static uint32_t limited(double depth)
{
	return depth < 0 ? 0 : depth > 0xffffff ? 0xffffff : (uint32_t)(depth + 0.5);
}

/* z = 0.2 + x / 200 + y / 400, of the pixel's middle. */
static void check_offset(struct fixture *f, float factor, float units)
{
	struct drawing drawing = square;

	for (int i = 0; i < 4; i++)
		drawing.position[i][2] = 0.2f + drawing.position[i][0] / 200 +
					 drawing.position[i][1] / 400;
	assert_int_equal(accel_state_set_polygon_offset(f->state, factor, units,
							1u << ACCEL_POLYGON_FILL),
			 0);
	begin(f);
	add(f, &drawing, ACCEL_TOPOLOGY_QUADS, NULL, 4);
	finish(f, pixels);
	read_depths(f);
	for (int y = 8; y < 56; y++)
		for (int x = 8; x < 56; x++) {
			double z = 0.2 + (x + 0.5) / 200 + (SIDE - 1 - y + 0.5) / 400;
			uint32_t wanted = limited((z + (double)factor / 200) * 0xffffff +
						  (double)units);
			uint32_t got = depths[y * SIDE + x];

			/* z is single precision. */
			assert_true((got > wanted ? got - wanted : wanted - got) <= 3);
		}
}

static void depth_is_offset_by_the_steeper_way_and_by_units(void **state)
{
	static const float offsets[][2] = { { 0, 0 },     { 0, 1000 }, { 1, 0 },   { -2, -70000 },
					    { 1e30f, 0 }, { -50, 0 },  { 0, 9e6f } };
	struct fixture *f = *state;

	both_modes(f, ACCEL_POLYGON_FILL);
	accel_state_set_depth(f->state, ACCEL_COMPARE_ALWAYS, true);
	for (size_t i = 0; i < sizeof(offsets) / sizeof(offsets[0]); i++)
		check_offset(f, offsets[i][0], offsets[i][1]);
	assert_int_equal(accel_state_set_polygon_offset(f->state, 0, 0, 0), 0);
	accel_state_set_depth(f->state, ACCEL_COMPARE_ALWAYS, false);
}

/* Which it would not be by its depth alone, that of the polygon. */
static void an_outline_with_an_offset_is_over_its_polygon(void **state)
{
	uint64_t seed = test_seed();
	struct fixture *f = *state;
	struct drawing drawing;

	for (int n = 0; n < 200; n++) {
		const enum accel_polygon_mode mode = n % 2 ? ACCEL_POLYGON_LINES :
							     ACCEL_POLYGON_POINTS;

		random_drawing(&seed, &drawing);
		accel_state_set_depth(f->state, ACCEL_COMPARE_ALWAYS, false);
		both_modes(f, mode);
		begin(f);
		add(f, &drawing, ACCEL_TOPOLOGY_TRIANGLES, NULL, 3);
		finish(f, others);
		accel_state_set_depth(f->state, ACCEL_COMPARE_LESS, true);
		both_modes(f, ACCEL_POLYGON_FILL);
		begin(f);
		add(f, &drawing, ACCEL_TOPOLOGY_TRIANGLES, NULL, 3);
		both_modes(f, mode);
		accel_state_set_depth(f->state, ACCEL_COMPARE_LESS, false);
		assert_int_equal(accel_state_set_polygon_offset(f->state, -1.2f, -4, 1u << mode),
				 0);
		add(f, &drawing, ACCEL_TOPOLOGY_TRIANGLES, NULL, 3);
		finish(f, pixels);
		assert_int_equal(accel_state_set_polygon_offset(f->state, 0, 0, 0), 0);
		for (int i = 0; i < PIXELS; i++)
			if (others[i])
				assert_int_equal(pixels[i], others[i]);
	}
	accel_state_set_depth(f->state, ACCEL_COMPARE_ALWAYS, false);
}

static void offsets_that_are_none_are_refused(void **state)
{
	struct fixture *f = *state;

	assert_int_equal(accel_state_set_polygon_offset(f->state, NAN, 0, 1), -EINVAL);
	assert_int_equal(accel_state_set_polygon_offset(f->state, 0, INFINITY, 1), -EINVAL);
	assert_int_equal(accel_state_set_polygon_offset(f->state, 0, 0, 8), -EINVAL);
}

#define polygons_test(name) cmocka_unit_test(name)

int main(void)
{
	const struct CMUnitTest tests[] = {
		polygons_test(an_outline_is_what_its_lines_or_points_are),
		polygons_test(an_edge_that_clipping_makes_is_an_outline),
		polygons_test(an_edge_that_is_cut_keeps_its_flag),
		polygons_test(what_is_behind_the_eye_has_a_side_too),
		polygons_test(sides_of_different_modes_are_drawn_in_order),
		polygons_test(the_mode_is_that_of_the_side_that_is_seen),
		polygons_test(nothing_is_drawn_of_polygons_that_are_culled_on_both_sides),
		polygons_test(depth_is_offset_by_the_steeper_way_and_by_units),
		polygons_test(an_outline_with_an_offset_is_over_its_polygon),
		polygons_test(offsets_that_are_none_are_refused),
	};

	return cmocka_run_group_tests(tests, setup, fixture_free);
}
