// SPDX-License-Identifier: MIT
/* The oracle against values worked out by hand, each beside the test of it. */
#include "oracle.h"

#include <math.h>

#include "accel_test.h"

#define SIDE 8
#define ROOT3 1.7320508075688772

static struct oracle_state gl;
static struct oracle_pixel pixels[SIDE * SIDE];
static struct oracle_picture picture = { SIDE, SIDE, pixels, false };

static const double z_axis[3] = { 0, 0, 1 };
static const double origin[4] = { 0, 0, 0, 1 };
static const double white[4] = { 1, 1, 1, 1 };

static int setup(void **state)
{
	(void)state;
	oracle_state_init(&gl, SIDE, SIDE);
	gl.lighting = true;
	gl.light[0].enabled = true;
	memset(pixels, 0, sizeof(pixels));
	picture.doubtful = false;
	return 0;
}

static void assert_near(double value, double wanted)
{
	if (!(fabs(value - wanted) < 1e-9))
		fail_msg("%.12g is not %.12g", value, wanted);
}

/* The red that a vertex at @eye gets with its normal along z; @part 1: of the second colour. */
static double red(enum oracle_side side, const double eye[4], int part)
{
	double colour[2][4];

	oracle_light(&gl, side, eye, z_axis, white, colour);
	return colour[part][0];
}

static void set3(double out[3], double x, double y, double z)
{
	out[0] = x;
	out[1] = y;
	out[2] = z;
}

/* Only the given terms of the equation. */
static void material(double diffuse, double specular, double shininess)
{
	memset(gl.material, 0, sizeof(gl.material));
	for (int side = 0; side < ORACLE_SIDES; side++) {
		gl.material[side].diffuse[0] = diffuse;
		gl.material[side].specular[0] = specular;
		gl.material[side].shininess = shininess;
	}
}

/* Light from 60 degrees beside the normal: 0.2 * 0.2 + 0.8 cos 60 = 0.04 + 0.4. */
static void diffuse_light_goes_by_the_cosine(void **state)
{
	(void)state;
	set3(gl.light[0].position, ROOT3, 0, 1);
	assert_near(red(ORACLE_FRONT, origin, 0), 0.44);
	/* From below it is 0.04 alone; its own ambient of 0.5 adds 0.5 * 0.2. */
	set3(gl.light[0].position, ROOT3, 0, -1);
	assert_near(red(ORACLE_FRONT, origin, 0), 0.04);
	gl.light[0].ambient[0] = 0.5;
	assert_near(red(ORACLE_FRONT, origin, 0), 0.14);
}

/* At 2: 1 / (1 + 0.5 * 2 + 0.25 * 4) = 1/3. A w of 2 halves the place. */
static void a_point_is_attenuated_and_a_direction_is_not(void **state)
{
	(void)state;
	material(1, 0, 0);
	set3(gl.light[0].attenuation, 1, 0.5, 0.25);
	set3(gl.light[0].position, 0, 0, 4);
	assert_near(red(ORACLE_FRONT, origin, 0), 1);
	gl.light[0].position[3] = 2;
	assert_near(red(ORACLE_FRONT, origin, 0), 1.0 / 3);
	/* So does a w of the vertex: from 1 / 2 to 2 it is 1.5, 1 / (1 + 0.75 + 0.5625) = 16/37. */
	assert_near(red(ORACLE_FRONT, (const double[4]){ 0, 0, 1, 2 }, 0), 16.0 / 37);
}

/* From 2 above, 30 degrees off the axis: cos 30 squared is 0.75, times the diffuse cos 30. */
static void a_spot_fades_from_its_axis_and_ends_at_its_rim(void **state)
{
	const double eye[4] = { 2 / ROOT3, 0, 0, 1 };

	(void)state;
	material(1, 0, 0);
	set3(gl.light[0].position, 0, 0, 2);
	gl.light[0].position[3] = 1;
	gl.light[0].spot_exponent = 2;
	set3(gl.light[0].spot_direction, 0, 0, -5);
	gl.light[0].spot_cutoff = 31;
	assert_near(red(ORACLE_FRONT, eye, 0), 0.75 * ROOT3 / 2);
	gl.light[0].spot_cutoff = 29;
	assert_near(red(ORACLE_FRONT, eye, 0), 0);
	/* Not a spot, whatever its exponent. */
	gl.light[0].spot_cutoff = 180;
	assert_near(red(ORACLE_FRONT, eye, 0), ROOT3 / 2);
}

/*
 * At (-3, 0, -4) the way to the eye is (0.6, 0, 0.8), and the light comes from there: so does the
 * half vector, 0.8^2 = 0.64. Seen from (0, 0, 1) it is (0.6, 0, 1.8): 1.8^2 / 3.6 = 0.9.
 */
static void a_highlight_goes_by_the_half_vector(void **state)
{
	const double eye[4] = { -3, 0, -4, 1 };

	(void)state;
	material(0, 1, 2);
	set3(gl.light[0].position, 3, 0, 4);
	gl.local_viewer = true;
	assert_near(red(ORACLE_FRONT, eye, 0), 0.64);
	gl.local_viewer = false;
	assert_near(red(ORACLE_FRONT, eye, 0), 0.9);
	/* Where the light is behind there is none, though the half vector is not. */
	set3(gl.light[0].position, 4, 0, -3);
	assert_near(red(ORACLE_FRONT, eye, 0), 0);
}

static void separate_highlights_are_the_second_colour(void **state)
{
	(void)state;
	material(0.25, 0.5, 1);
	assert_near(red(ORACLE_FRONT, origin, 0), 0.75);
	gl.separate_specular = true;
	assert_near(red(ORACLE_FRONT, origin, 0), 0.25);
	assert_near(red(ORACLE_FRONT, origin, 1), 0.5);
}

/* The light is behind: front 0, back cos 60 of its own material. */
static void backs_have_their_material_and_the_normal_reversed(void **state)
{
	(void)state;
	material(1, 0, 0);
	gl.material[ORACLE_BACK].diffuse[0] = 0.5;
	set3(gl.light[0].position, ROOT3, 0, -1);
	assert_near(red(ORACLE_FRONT, origin, 0), 0);
	assert_near(red(ORACLE_BACK, origin, 0), 0.25);
}

/* Each part by what it is multiplied with: 1, scene 0.5, light's diffuse 0.25, specular 0.125. */
static void colours_take_the_place_of_the_parts_named(void **state)
{
	static const double wanted[4] = { 1, 0.5, 0.25, 0.125 };

	(void)state;
	gl.ambient[0] = 0.5;
	gl.light[0].diffuse[0] = 0.25;
	gl.light[0].specular[0] = 0.125;
	material(0, 0, 1);
	for (int i = 0; i < 4; i++) {
		gl.follow[ORACLE_FRONT] = 1u << i;
		assert_near(red(ORACLE_FRONT, origin, 0), wanted[i]);
		assert_near(red(ORACLE_BACK, origin, 0), 0);
	}
	gl.follow[ORACLE_FRONT] = ORACLE_AMBIENT | ORACLE_DIFFUSE;
	assert_near(red(ORACLE_FRONT, origin, 0), 0.75);
}

/* The inverse of a scale of 2 halves; of (2, 1, 1) it halves x alone. */
static void normals_go_by_the_inverse_and_are_scaled_as_asked(void **state)
{
	static const double wanted[3] = { 0.5, 1, 1 };
	const double slanted[3] = { 0.6, 0.8, 0 };
	double normal[3];

	(void)state;
	gl.modelview[0] = gl.modelview[5] = gl.modelview[10] = 2;
	for (int i = 0; i < 3; i++) {
		gl.normals = (enum oracle_normals)i;
		oracle_normal(&gl, z_axis, normal);
		assert_near(normal[2], wanted[i]);
	}
	gl.normals = ORACLE_AS_GIVEN;
	gl.modelview[5] = gl.modelview[10] = 1;
	oracle_normal(&gl, slanted, normal);
	assert_near(normal[0], 0.3);
	assert_near(normal[1], 0.8);
	/* Turned by 90 degrees around z: x becomes y. */
	gl.modelview[0] = gl.modelview[5] = 0;
	gl.modelview[1] = 1;
	gl.modelview[4] = -1;
	oracle_normal(&gl, slanted, normal);
	assert_near(normal[0], -0.8);
	assert_near(normal[1], 0.6);
}

/* Of seven vertices: figures 2.1 to 2.4 and table 2.11 of the specification. Digits are vertices, the
 * provoking one comes behind the colon. */
static void primitives_are_of_the_vertices_in_the_figures(void **state)
{
	static const char *const wanted[ORACLE_TOPOLOGIES] = {
		"0:0 1:1 2:2 3:3 4:4 5:5 6:6 ",
		"01:1 23:3 45:5 ",
		"01:1 12:2 23:3 34:4 45:5 56:6 60:0 ",
		"01:1 12:2 23:3 34:4 45:5 56:6 ",
		"012:2 345:5 ",
		"012:2 213:3 234:4 435:5 456:6 ",
		"012:2 023:3 034:4 045:5 056:6 ",
		"0123:3 ",
		"0132:3 2354:5 ",
		"0123456:0 ",
	};

	(void)state;
	for (int topology = 0; topology < ORACLE_TOPOLOGIES; topology++) {
		struct oracle_primitive p;
		char text[128] = "", *end = text;

		for (int n = 0; oracle_assemble((enum oracle_topology)topology, 7, n, &p); n++) {
			for (int i = 0; i < p.corners; i++)
				*end++ = (char)('0' + p.vertex[i]);
			end += sprintf(end, ":%d ", p.provoking);
		}
		assert_string_equal(text, wanted[topology]);
	}
}

/* Of (0, 0, -2), (0, 0, 0) and (1, 0, 0) the first edge is cut in its middle, the last one too. */
static void new_corners_are_mixed_from_the_ends_of_their_edge(void **state)
{
	struct oracle_corner polygon[ORACLE_CORNERS] = {
		{ .clip = { 0, 0, -2, 1 }, .colour = { { { 1, 0, 0, 1 } } } },
		{ .clip = { 0, 0, 0, 1 }, .colour = { { { 0, 1, 0, 1 } } } },
		{ .clip = { 1, 0, 0, 1 }, .colour = { { { 0, 0, 1, 0 } } } },
	};
	bool cut;

	(void)state;
	assert_int_equal(oracle_clip(&gl, polygon, 3, &cut), 4);
	assert_true(cut);
	assert_near(polygon[0].clip[2], -1);
	assert_near(polygon[0].colour[0][0][0], 0.5);
	assert_near(polygon[0].colour[0][0][1], 0.5);
	assert_near(polygon[3].clip[0], 0.5);
	assert_near(polygon[3].colour[0][0][2], 0.5);
	assert_near(polygon[3].colour[0][0][3], 0.5);
	/* A user's plane of x <= 0.25, in eye space, then cuts three more edges' ends off. */
	gl.planes = 4;
	gl.plane[2][0] = -1;
	gl.plane[2][3] = 0.25;
	for (int i = 0; i < 4; i++)
		polygon[i].eye[0] = polygon[i].clip[0];
	assert_int_equal(oracle_clip(&gl, polygon, 4, &cut), 4);
	for (int i = 0; i < 4; i++)
		assert_true(polygon[i].eye[0] <= 0.25);
}

static void draw_square(double near_w, double far_w)
{
	const double corner[4][3] = {
		{ -1, -1, near_w }, { 0, -1, far_w }, { 0, 0, far_w }, { -1, 0, near_w }
	};
	struct oracle_vertex vertex[4] = { 0 };

	gl.lighting = false;
	for (int i = 0; i < 4; i++) {
		double w = corner[i][2];

		vertex[i].position[0] = corner[i][0] * w;
		vertex[i].position[1] = corner[i][1] * w;
		vertex[i].position[3] = w;
		vertex[i].colour[0] = i == 1 || i == 2;
	}
	oracle_draw(&gl, ORACLE_QUADS, vertex, 4, &picture);
}

/* The lower left quarter of 8 pixels a side: 4 by 4, and its depth is half the depth range. */
static void pixels_are_those_whose_centres_are_inside(void **state)
{
	(void)state;
	gl.near = 0.25;
	gl.far = 0.5;
	draw_square(1, 1);
	for (int i = 0; i < SIDE * SIDE; i++) {
		int x = i % SIDE, y = i / SIDE;

		assert_int_equal(pixels[i].drawn, x < 4 && y < 4);
		if (pixels[i].drawn) {
			assert_near(pixels[i].depth, 0.375);
			/* Straight across: 1/8, 3/8, ... */
			assert_near(pixels[i].colour[0], (x + 0.5) / 4);
		}
	}
	assert_near(pixels[0].inside, 0.5);
	assert_near(pixels[SIDE + 1].inside, 1.5);
	assert_false(picture.doubtful);
}

/* With w 1 and 3, at 1/8 across: (1/8 / 3) / (7/8 / 1 + 1/8 / 3) = 1/22. */
static void colours_are_in_perspective(void **state)
{
	(void)state;
	draw_square(1, 3);
	assert_near(pixels[0].colour[0], 1.0 / 22);
}

/* Beyond the far plane, at 1, nothing is left. */
static void what_is_beyond_the_far_plane_is_cut(void **state)
{
	struct oracle_corner polygon[ORACLE_CORNERS] = {
		{ .clip = { 0, 0, 2, 1 } },
		{ .clip = { 1, 0, 2, 1 } },
		{ .clip = { 0, 1, 3, 1 } },
	};
	bool cut;

	(void)state;
	assert_int_equal(oracle_clip(&gl, polygon, 3, &cut), 0);
}

/* 1/24 pixel to the right is nearer to 1/16 than to 0: the right edge is at 4 + 1/16. */
static void corners_are_rounded_to_sixteenths(void **state)
{
	(void)state;
	gl.viewport[0] = 1.0 / 24;
	draw_square(1, 1);
	assert_near(pixels[SIDE + 3].inside, 0.5 + 1.0 / 16);
}

/* Red of 2 and -1 are 1 and 0; alpha too. */
static void colours_are_limited(void **state)
{
	struct oracle_vertex vertex = { { 0, 0, 0, 1 }, { 0, 0, 1 }, { 2, -1, 0.5, 3 } };
	struct oracle_corner corner;

	(void)state;
	gl.lighting = false;
	oracle_transform(&gl, &vertex, &corner);
	assert_near(corner.colour[0][0][0], 1);
	assert_near(corner.colour[0][0][1], 0);
	assert_near(corner.colour[0][0][2], 0.5);
	assert_near(corner.colour[0][0][3], 1);
}

/* The fourth vertex of the square is black. */
static void flat_squares_have_the_colour_of_their_fourth_vertex(void **state)
{
	(void)state;
	gl.flat = true;
	draw_square(1, 1);
	assert_true(pixels[3].drawn);
	assert_near(pixels[3].colour[0], 0);
}

/* Though three of its vertices would make a triangle. */
static void squares_with_a_corner_at_infinity_are_not_drawn(void **state)
{
	static const struct oracle_vertex square[4] = {
		{ .position = { -1, -1, 0, 1 } },
		{ .position = { 1, -1, 0, 1 } },
		{ .position = { (double)INFINITY, 1, 0, 1 } },
		{ .position = { -1, 1, 0, 1 } },
	};

	(void)state;
	oracle_draw(&gl, ORACLE_QUADS, square, 4, &picture);
	for (int i = 0; i < SIDE * SIDE; i++)
		assert_false(pixels[i].drawn);
}

/*
 * Light along z on normals turned by 60 degrees to the left and to the right: cos 60 at the corners.
 * At the third pixel's centre, 5/8 across, it is (sin 60 / 4, 1/2), whose cosine is
 * 0.5 / sqrt(3/64 + 16/64) = 4 / sqrt 19.
 */
static void pixels_are_lit_by_the_normals_between(void **state)
{
	struct oracle_vertex vertex[4] = {
		{ .position = { -1, -1, 0, 1 }, .normal = { -ROOT3 / 2, 0, 0.5 } },
		{ .position = { 0, -1, 0, 1 }, .normal = { ROOT3 / 2, 0, 0.5 } },
		{ .position = { 0, 0, 0, 1 }, .normal = { ROOT3 / 2, 0, 0.5 } },
		{ .position = { -1, 0, 0, 1 }, .normal = { -ROOT3 / 2, 0, 0.5 } },
	};

	(void)state;
	material(1, 0, 0);
	oracle_draw(&gl, ORACLE_QUADS, vertex, 4, &picture);
	assert_near(pixels[2].colour[0], 0.5);
	gl.lit_pixels = true;
	oracle_draw(&gl, ORACLE_QUADS, vertex, 4, &picture);
	assert_near(pixels[2].colour[0], 4 / sqrt(19));
}

/* Counter-clockwise is front, until it is said to be back; backs are culled, or fronts. */
static void faces_are_told_by_how_they_turn(void **state)
{
	(void)state;
	gl.cull = ORACLE_CULL_BACK;
	draw_square(1, 1);
	assert_true(pixels[0].drawn);
	memset(pixels, 0, sizeof(pixels));
	gl.front_clockwise = true;
	draw_square(1, 1);
	assert_false(pixels[0].drawn);
	gl.cull = ORACLE_CULL_FRONT;
	draw_square(1, 1);
	assert_true(pixels[0].drawn);
}

/* Centres at 0.5 of a square from 0.5 to 2.5: the left ones and the top ones are its own. */
static void centres_on_left_and_top_edges_are_inside(void **state)
{
	(void)state;
	gl.viewport[0] = gl.viewport[1] = 0.5;
	gl.viewport[2] = gl.viewport[3] = 4;
	draw_square(1, 1);
	for (int i = 0; i < SIDE * SIDE; i++) {
		int x = i % SIDE, y = i / SIDE;

		/* The viewport's own lower left pixel is cut, as whole pixels count. */
		assert_int_equal(pixels[i].drawn, x == 1 && y >= 1 && y <= 2);
	}
}

#define TEST(name) cmocka_unit_test_setup(name, setup)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(diffuse_light_goes_by_the_cosine),
		TEST(a_point_is_attenuated_and_a_direction_is_not),
		TEST(a_spot_fades_from_its_axis_and_ends_at_its_rim),
		TEST(a_highlight_goes_by_the_half_vector),
		TEST(separate_highlights_are_the_second_colour),
		TEST(backs_have_their_material_and_the_normal_reversed),
		TEST(colours_take_the_place_of_the_parts_named),
		TEST(normals_go_by_the_inverse_and_are_scaled_as_asked),
		TEST(primitives_are_of_the_vertices_in_the_figures),
		TEST(new_corners_are_mixed_from_the_ends_of_their_edge),
		TEST(pixels_are_those_whose_centres_are_inside),
		TEST(colours_are_in_perspective),
		TEST(what_is_beyond_the_far_plane_is_cut),
		TEST(corners_are_rounded_to_sixteenths),
		TEST(colours_are_limited),
		TEST(flat_squares_have_the_colour_of_their_fourth_vertex),
		TEST(squares_with_a_corner_at_infinity_are_not_drawn),
		TEST(pixels_are_lit_by_the_normals_between),
		TEST(faces_are_told_by_how_they_turn),
		TEST(centres_on_left_and_top_edges_are_inside),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
