/* SPDX-License-Identifier: MIT */
/* A mesh's colours as the material's. */
#include "draw_fixture.h"
#include "draw_mesh.h"
#include "draw_test.h"

#define SIDE 96

static struct shape shape;
static float colours[SHAPE_VERTICES][4];

static int setup(void **state)
{
	struct accel_state *drawn = state_shiny(20);

	accel_state_set_local_viewer(drawn, false);
	shape_sphere(&shape, 6);
	memset(colours, 0, sizeof(colours));
	shape.mesh.colour.data = colours;
	*state = fixture_new(SIDE, drawn);
	return 0;
}

static void draw(struct fixture *f, uint32_t *pixel)
{
	const float black[4] = { 0 };

	assert_int_equal(draw_begin(f->draw, f->target, black, 1), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &shape.mesh), 0);
	assert_int_equal(accel_draw_finish(f->draw), 0);
	assert_int_equal(accel_target_read(f->target, ACCEL_PLANE_COLOUR, NULL, pixel, SIDE * 4),
			 0);
}

static void assert_same(const uint32_t *a, const uint32_t *b, int step)
{
	unsigned int drawn = 0;

	for (int i = 0; i < SIDE * SIDE; i++) {
		drawn += a[i] != 0;
		for (int bit = 0; bit < 32; bit += 8)
			assert_true(abs((int)(a[i] >> bit & 255) - (int)(b[i] >> bit & 255)) <=
				    step);
	}
	assert_true(drawn > 1000);
}

static void paint(float red, float green, float blue, float alpha)
{
	for (int i = 0; i < SHAPE_VERTICES; i++)
		memcpy(colours[i], (float[4]){ red, green, blue, alpha }, sizeof(colours[i]));
}

/* One colour everywhere is what the same material is, in all shadings. */
static void colours_are_the_ambient_and_diffuse_reflectance_and_alpha(void **state)
{
	static uint32_t painted[SIDE * SIDE], plain[SIDE * SIDE];
	struct fixture *f = *state;
	struct accel_material material = f->state->material[0];
	const struct accel_material before = material;
	const float colour[4] = { 0.75f, 0.25f, 0.5f, 0.5f };

	material.emission[1] = 0.125f;
	paint(colour[0], colour[1], colour[2], colour[3]);
	for (int shading = 0; shading <= ACCEL_SHADING_FLAT; shading++) {
		accel_state_set_shading(f->state, shading);
		material = before;
		accel_state_set_colour_material(f->state, ACCEL_TRACKS_AMBIENT_DIFFUSE,
						ACCEL_TRACKS_AMBIENT_DIFFUSE);
		assert_int_equal(accel_state_set_material(f->state, &material, NULL), 0);
		draw(f, painted);
		memcpy(material.ambient, colour, sizeof(colour));
		memcpy(material.diffuse, colour, sizeof(colour));
		accel_state_set_colour_material(f->state, ACCEL_TRACKS_NONE, ACCEL_TRACKS_NONE);
		assert_int_equal(accel_state_set_material(f->state, &material, NULL), 0);
		draw(f, plain);
		assert_same(painted, plain, 1);
	}
}

static void colours_are_nothing_unless_asked_for(void **state)
{
	static uint32_t with[SIDE * SIDE], without[SIDE * SIDE];
	struct fixture *f = *state;

	paint(1, 0, 0, 1);
	draw(f, with);
	shape.mesh.colour.data = NULL;
	draw(f, without);
	assert_memory_equal(with, without, sizeof(with));
	/* Asked for and not there: the material. */
	accel_state_set_colour_material(f->state, ACCEL_TRACKS_AMBIENT_DIFFUSE,
					ACCEL_TRACKS_AMBIENT_DIFFUSE);
	draw(f, with);
	assert_memory_equal(with, without, sizeof(with));
}

/* Under light that is the same everywhere they are what they are without light, also when cut. */
static void colours_run_from_vertex_to_vertex(void **state)
{
	/* The nearest and the farthest quarter are cut off. */
	static const float slab[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, 0, 0, 0, -6.4f, 1 };
	static uint32_t lit[SIDE * SIDE], unlit[SIDE * SIDE];
	const float ambient[4] = { 1, 1, 1, 1 };
	struct fixture *f = *state;
	struct accel_material material = ACCEL_MATERIAL(.shininess = 1);
	struct accel_light off = f->state->light[0];

	off.enabled = false;
	for (int i = 0; i < ACCEL_LIGHTS; i++)
		assert_int_equal(accel_state_set_light(f->state, i, &off), 0);
	assert_int_equal(accel_state_set_material(f->state, &material, NULL), 0);
	accel_state_set_ambient(f->state, ambient);
	accel_state_set_colour_material(f->state, ACCEL_TRACKS_AMBIENT_DIFFUSE,
					ACCEL_TRACKS_AMBIENT_DIFFUSE);
	accel_state_set_projection(f->state, slab);
	for (uint32_t i = 0; i < shape.mesh.vertices; i++)
		for (int j = 0; j < 3; j++)
			colours[i][j] = (shape.position[i][j] + 1) / 2;
	for (int shading = 0; shading <= ACCEL_SHADING_FLAT; shading++) {
		accel_state_set_shading(f->state, shading);
		accel_state_set_lighting(f->state, true);
		draw(f, lit);
		accel_state_set_lighting(f->state, false);
		draw(f, unlit);
		for (int i = 0; i < SIDE * SIDE; i++)
			unlit[i] = (unlit[i] & 0xffffff) | (lit[i] & 0xff000000);
		assert_same(lit, unlit, 1);
	}
}

static void colours_that_are_no_numbers_are_refused(void **state)
{
	struct fixture *f = *state;

	accel_state_set_colour_material(f->state, ACCEL_TRACKS_AMBIENT_DIFFUSE,
					ACCEL_TRACKS_AMBIENT_DIFFUSE);
	colours[3][1] = NAN;
	assert_int_equal(accel_draw_begin(f->draw, f->target, NULL), 0);
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &shape.mesh), -EINVAL);
	/* Others are taken, whatever they are. */
	colours[3][1] = 1e30f;
	assert_int_equal(accel_draw_mesh(f->draw, f->state, &shape.mesh), 0);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, fixture_free)

int main(void)
{
	const struct CMUnitTest tests[] = {
		CASE(colours_are_the_ambient_and_diffuse_reflectance_and_alpha),
		CASE(colours_are_nothing_unless_asked_for),
		CASE(colours_run_from_vertex_to_vertex),
		CASE(colours_that_are_no_numbers_are_refused),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
