/* SPDX-License-Identifier: MIT */
/*
 * Where OpenGL has a choice of its own: normals of any length, which of a material the colours are,
 * which way front faces turn, where row 0 is, and planes of its own. What a colour is to be is worked out here from
 * the specification (1.5, sections 2.11.3 and 2.14), in double precision.
 */
#include <errno.h>
#include <math.h>

#include "draw/draw_priv.h"
#include "draw_fixture.h"

#define SIDE 32
#define PIXELS (SIDE * SIDE)

static uint32_t pixels[PIXELS], others[PIXELS];

/* Two triangles, counter-clockwise. */
static const float square[4][2] = { { -4, -4 }, { 4, -4 }, { 4, 4 }, { -4, 4 } };
static const float normal[3] = { 0.3f, 0.2f, 0.9f };
static const float colour[4] = { 0.9f, 0.4f, 1.5f, 0.6f };
static const float scale[3] = { 0.25f, 0.5f, 0.8f };

static const struct accel_material materials[2] = {
	ACCEL_MATERIAL(.emission = { 0.05f, 0, 0.1f, 1 }, .ambient = { 0.2f, 0.3f, 0.1f, 1 },
		       .diffuse = { 0.3f, 0.5f, 0.2f, 0.75f }, .specular = { 0.4f, 0.1f, 0.2f, 1 },
		       .shininess = 3),
	ACCEL_MATERIAL(.emission = { 0, 0.1f, 0, 1 }, .ambient = { 0.1f, 0.1f, 0.4f, 1 },
		       .diffuse = { 0.6f, 0.1f, 0.3f, 0.5f }, .specular = { 0.1f, 0.4f, 0.3f, 1 },
		       .shininess = 5),
};
static const struct accel_light light = ACCEL_LIGHT(.enabled = true,
						    .position = { 0, 0.6f, 0.8f, 0 },
						    .ambient = { 0.1f, 0.2f, 0.3f, 1 },
						    .diffuse = { 0.7f, 0.6f, 0.5f, 1 },
						    .specular = { 0.5f, 0.8f, 0.9f, 1 });
static const float ambient[4] = { 0.3f, 0.2f, 0.1f, 1 };

static int setup(void **state)
{
	const float modelview[16] = { scale[0], 0, 0,        0, 0, scale[1], 0, 0,
				      0,        0, scale[2], 0, 0, 0,        0, 1 };
	struct accel_state *drawn;

	assert_int_equal(accel_state_new(&drawn), 0);
	accel_state_set_modelview(drawn, modelview);
	accel_state_set_lighting(drawn, true);
	accel_state_set_local_viewer(drawn, false);
	assert_int_equal(accel_state_set_ambient(drawn, ambient), 0);
	assert_int_equal(accel_state_set_material(drawn, &materials[0], &materials[1]), 0);
	assert_int_equal(accel_state_set_light(drawn, 0, &light), 0);
	*state = fixture_new(SIDE, drawn);
	return 0;
}

static void draw(struct fixture *f, bool turned, uint32_t *to)
{
	static const uint8_t order[2][4] = { { 0, 1, 2, 3 }, { 3, 2, 1, 0 } };
	static const struct accel_primitive quad = { ACCEL_TOPOLOGY_QUADS, 0, 4 };
	const struct accel_arrays arrays = ACCEL_ARRAYS(
			.vertices = 4, .position = { .data = square, .components = 2 },
			.normal = { .data = normal, .constant = true },
			.colour = { .data = colour, .constant = true });
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &quad, .primitives = 1,
							      .index = order[turned],
							      .index_type = ACCEL_TYPE_UBYTE);

	assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 0 }, 1), 0);
	assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, to, SIDE * 4), 0);
}

/* ---- the specification ---- */

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void eye_normal(enum accel_normals normals, int side, double n[3])
{
	double factor = 1;

	for (int i = 0; i < 3; i++)
		n[i] = (double)normal[i] / (double)scale[i];
	if (normals == ACCEL_NORMALS_UNIT)
		factor = 1 / sqrt(dot(n, n));
	if (normals == ACCEL_NORMALS_RESCALE)
		factor = (double)scale[2];
	for (int i = 0; i < 3; i++)
		n[i] *= side ? -factor : factor;
}

static struct accel_material tracked(enum accel_tracks tracks, int side)
{
	struct accel_material material = materials[side];

	if (tracks == ACCEL_TRACKS_EMISSION)
		memcpy(material.emission, colour, sizeof(colour));
	if (tracks == ACCEL_TRACKS_AMBIENT || tracks == ACCEL_TRACKS_AMBIENT_DIFFUSE)
		memcpy(material.ambient, colour, sizeof(colour));
	if (tracks == ACCEL_TRACKS_DIFFUSE || tracks == ACCEL_TRACKS_AMBIENT_DIFFUSE)
		memcpy(material.diffuse, colour, sizeof(colour));
	if (tracks == ACCEL_TRACKS_SPECULAR)
		memcpy(material.specular, colour, sizeof(colour));
	return material;
}

static void wanted_colour(enum accel_normals normals, enum accel_tracks tracks, int side,
			  double rgba[4])
{
	const struct accel_material m = tracked(tracks, side);
	const double to[3] = { 0, 0.6, 0.8 };
	double half[3] = { 0, 0.6, 1.8 }, n[3], length = sqrt(dot(half, half));
	double diffuse, highlight;

	for (int i = 0; i < 3; i++)
		half[i] /= length;
	eye_normal(normals, side, n);
	diffuse = fmax(dot(n, to), 0);
	highlight = diffuse > 0 ? pow(fmax(dot(n, half), 0), (double)m.shininess) : 0;
	for (int i = 0; i < 3; i++)
		rgba[i] = (double)m.emission[i] + (double)m.ambient[i] * (double)ambient[i] +
			  (double)m.ambient[i] * (double)light.ambient[i] +
			  diffuse * (double)m.diffuse[i] * (double)light.diffuse[i] +
			  highlight * (double)m.specular[i] * (double)light.specular[i];
	rgba[3] = (double)m.diffuse[3];
}

/* All pixels are of that colour, to a step. */
static void check_colour(const double rgba[4], const char *what)
{
	for (int channel = 0; channel < 4; channel++) {
		double wanted = fmin(fmax(rgba[channel], 0), 1) * 255;

		for (int i = 0; i < PIXELS; i++) {
			int got = (int)(pixels[i] >> 8 * channel & 0xff);

			if (fabs(got - wanted) > 1)
				fail_msg("%s: channel %d is %d, not %f", what, channel, got,
					 wanted);
		}
	}
}

/* The same in every shading, as the light is the same everywhere; front and back. */
static void check_light(struct fixture *f, enum accel_normals normals, enum accel_tracks tracks)
{
	double rgba[4];
	char what[64];

	for (int n = 0; n < 8; n++) {
		const int side = n / 4;
		const enum accel_tracks other = (enum accel_tracks)((tracks + 1) % 6);

		accel_state_set_shading(f->state, (enum accel_shading)(n % 4));
		accel_state_set_two_sided(f->state, true);
		accel_state_set_normals(f->state, normals);
		accel_state_set_colour_material(f->state, side ? other : tracks,
						side ? tracks : other);
		snprintf(what, sizeof(what), "normals %d, tracks %d, shading %d, side %d", normals,
			 tracks, n % 4, side);
		wanted_colour(normals, tracks, side, rgba);
		draw(f, side, pixels);
		check_colour(rgba, what);
	}
}

static void colours_are_what_of_the_material_is_asked_for(void **state)
{
	for (int tracks = ACCEL_TRACKS_NONE; tracks <= ACCEL_TRACKS_AMBIENT_DIFFUSE; tracks++)
		check_light(*state, ACCEL_NORMALS_UNIT, (enum accel_tracks)tracks);
}

static void normals_keep_the_length_that_is_asked_for(void **state)
{
	for (int normals = ACCEL_NORMALS_UNIT; normals <= ACCEL_NORMALS_AS_GIVEN; normals++)
		check_light(*state, (enum accel_normals)normals, ACCEL_TRACKS_SPECULAR);
}

/* A matrix that turns, stretches and mirrors, in general place. */
static void any_modelview_takes_normals_by_its_inverse(void **state)
{
	static const float m[16] = { 0.5f, 0.2f, -0.1f, 0, 0.1f, -0.6f, 0.2f, 0,
				     0.3f, 0.1f, 0.4f,  0, 0,    0,     0,    1 };
	struct accel_state *drawn = ((struct fixture *)*state)->state;
	struct accel_transform transform;
	const float given[3] = { 0.3f, -0.2f, 0.9f }, origin[3] = { 0 };
	struct accel_vertex vertex;

	accel_state_set_modelview(drawn, m);
	accel_state_set_normals(drawn, ACCEL_NORMALS_AS_GIVEN);
	accel_geometry_init(&transform, drawn, SIDE, SIDE);
	assert_int_equal(accel_geometry_vertex(&transform, origin, given, &vertex), 0);
	/* The inverse's transpose takes the normal to n with (transpose of m) n = normal. */
	for (int column = 0; column < 3; column++) {
		double sum = 0;

		for (int row = 0; row < 3; row++)
			sum += (double)m[4 * column + row] * (double)vertex.normal[row] *
			       (double)vertex.length;
		assert_float_equal(sum, given[column], 1e-6);
	}
}

/* ---- planes ---- */

/* Of the square, which is 2 wide and 4 high to the eye, what two planes leave; a line and a point. */
static void planes_of_the_eye_cut_off_what_is_behind_them(void **state)
{
	static const float planes[2][4] = { { 1, 0, 0, 0.25f }, { 0, -2, 0, 1 } };
	static const struct accel_primitive figures[] = { { ACCEL_TOPOLOGY_QUADS, 0, 4 },
							  { ACCEL_TOPOLOGY_LINES, 0, 2 },
							  { ACCEL_TOPOLOGY_POINTS, 0, 4 } };
	static const float figure[3][4][2] = {
		{ { -4, -4 }, { 4, -4 }, { 4, 4 }, { -4, 4 } },
		{ { -4, 0.01f }, { 4, 0.01f } },
		{ { -2, 0.1f }, { 0, 0.1f }, { 2, 0.1f }, { 0, 1.9f } },
	};
	static const int drawn[3] = { SIDE * SIDE * 5 / 8 * 3 / 4, SIDE * 5 / 8, 2 };
	struct fixture *f = *state;

	accel_state_set_lighting(f->state, false);
	for (int i = 0; i < 2; i++)
		assert_int_equal(accel_state_set_clip_plane(f->state, 3 * i + 1, planes[i]), 0);
	for (int n = 0; n < 6; n++) {
		const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &figures[n % 3],
								      .primitives = 1);
		const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 4,
								.position = { .data = figure[n % 3],
									      .components = 2 });
		int count = 0;

		accel_state_set_shading(f->state,
					n < 3 ? ACCEL_SHADING_GOURAUD : ACCEL_SHADING_ADAPTIVE);
		assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 0 }, 1), 0);
		assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
		assert_int_equal(accel_draw_finish(f->draw), 0);
		assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels,
						   SIDE * 4),
				 0);
		for (int i = 0; i < PIXELS; i++)
			count += pixels[i] != 0;
		assert_int_equal(count, drawn[n % 3]);
	}
	/* Without them it is whole. */
	for (int i = 0; i < 2; i++)
		assert_int_equal(accel_state_set_clip_plane(f->state, 3 * i + 1, NULL), 0);
	draw(f, false, pixels);
	assert_true(pixels[0] != 0 && pixels[PIXELS - 1] != 0);
}

static void planes_that_are_none_are_refused(void **state)
{
	static const float wrong[2][4] = { { 1, 0, NAN, 0 }, { 0, INFINITY, 0, 0 } };
	struct accel_state *drawn = ((struct fixture *)*state)->state;

	assert_int_equal(accel_state_set_clip_plane(drawn, -1, NULL), -EINVAL);
	assert_int_equal(accel_state_set_clip_plane(drawn, ACCEL_USER_CLIP_PLANES, NULL), -EINVAL);
	for (int i = 0; i < 2; i++)
		assert_int_equal(accel_state_set_clip_plane(drawn, 0, wrong[i]), -EINVAL);
}

/* ---- sides ---- */

static bool drawn_at_all(struct fixture *f, bool turned)
{
	draw(f, turned, pixels);
	return pixels[PIXELS / 2] != 0;
}

static void front_faces_turn_as_asked_for_on_either_origin(void **state)
{
	struct fixture *f = *state;

	accel_state_set_cull(f->state, ACCEL_CULL_BACK);
	for (int n = 0; n < 4; n++) {
		bool clockwise = n & 1;

		accel_state_set_front_face(f->state, clockwise);
		accel_state_set_origin(f->state, n & 2);
		assert_int_equal(drawn_at_all(f, false), !clockwise);
		assert_int_equal(drawn_at_all(f, true), clockwise);
	}
}

/* And a triangle without normals is lit on that side. */
static void a_face_without_normals_looks_where_its_front_is(void **state)
{
	static const struct accel_primitive quad = { ACCEL_TOPOLOGY_QUADS, 0, 4 };
	const struct accel_arrays arrays = ACCEL_ARRAYS(.vertices = 4,
							.position = { .data = square,
								      .components = 2 });
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = &quad, .primitives = 1);
	struct fixture *f = *state;
	uint32_t lit[2];

	for (int clockwise = 0; clockwise < 2; clockwise++) {
		accel_state_set_front_face(f->state, clockwise);
		assert_int_equal(draw_begin(f->draw, f->target, (const float[4]){ 0 }, 1), 0);
		assert_int_equal(accel_draw_arrays(f->draw, f->state, &arrays, &elements), 0);
		assert_int_equal(accel_draw_finish(f->draw), 0);
		assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixels,
						   SIDE * 4),
				 0);
		lit[clockwise] = pixels[0] & 0xff;
	}
	/* Turned away from the light it has what is ambient alone. */
	assert_true(lit[0] > lit[1] + 20);
}

static void the_origin_turns_the_picture_over(void **state)
{
	static const float half[16] = { 0.1f, 0.05f, 0, 0, 0,    0.1f, 0, 0,
					0,    0,     1, 0, 0.2f, 0.3f, 0, 1 };
	struct fixture *f = *state;

	accel_state_set_modelview(f->state, half);
	accel_state_set_viewport(f->state, 4, 8, 20, 16);
	draw(f, false, pixels);
	accel_state_set_origin(f->state, true);
	draw(f, false, others);
	assert_true(pixels[12 * SIDE + 16] != 0);
	/* Rows of the viewport, the first with the last; centres of pixels are on no edge. */
	for (int y = 8; y < 24; y++)
		assert_memory_equal(&pixels[y * SIDE], &others[(31 - y) * SIDE], SIDE * 4);
	assert_true(memcmp(pixels, others, sizeof(pixels)) != 0);
}

#define gl_test(name) cmocka_unit_test_setup_teardown(name, setup, fixture_free)

int main(void)
{
	const struct CMUnitTest tests[] = {
		gl_test(colours_are_what_of_the_material_is_asked_for),
		gl_test(normals_keep_the_length_that_is_asked_for),
		gl_test(any_modelview_takes_normals_by_its_inverse),
		gl_test(planes_of_the_eye_cut_off_what_is_behind_them),
		gl_test(planes_that_are_none_are_refused),
		gl_test(front_faces_turn_as_asked_for_on_either_origin),
		gl_test(a_face_without_normals_looks_where_its_front_is),
		gl_test(the_origin_turns_the_picture_over),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
