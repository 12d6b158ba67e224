/* SPDX-License-Identifier: MIT */
/* Lighting against the formulas of the OpenGL specification in double precision. */
#include "draw/lighting_power.h"
#include "draw_mesh.h"
#include "draw_test.h"

#define RANDOM_SAMPLES 20000

static const float white[4] = { 1, 1, 1, 1 };

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(double v[3])
{
	double length = sqrt(dot(v, v));

	for (int i = 0; i < 3; i++)
		v[i] = length > 0 ? v[i] / length : 0;
}

/* att * spot of equation 2.3, and the unit vector towards the light. */
static double reference_reach(const struct accel_light *light, const double eye[3], double to[3])
{
	double distance, cosine, axis[3], factor;

	for (int i = 0; i < 3; i++) {
		to[i] = (double)light->position[i];
		if (light->position[3] != 0)
			to[i] = to[i] / (double)light->position[3] - eye[i];
		axis[i] = (double)light->spot_direction[i];
	}
	distance = sqrt(dot(to, to));
	unit(to);
	factor = 1;
	if (light->position[3] != 0)
		factor /= (double)light->attenuation[0] + (double)light->attenuation[1] * distance +
			  (double)light->attenuation[2] * distance * distance;
	if (light->spot_cutoff == 180)
		return factor;
	unit(axis);
	cosine = -dot(to, axis);
	if (cosine < cos((double)light->spot_cutoff * 3.14159265358979 / 180))
		return 0;
	return factor * pow(fmax(cosine, 0), (double)light->spot_exponent);
}

static void reference_sample(const struct accel_state *state, int side, const double eye[3],
			     const double normal[3], double colour[3])
{
	const struct accel_material *m = &state->material[side];
	double n[3], viewer[3] = { 0, 0, 1 };

	for (int i = 0; i < 3; i++) {
		n[i] = side ? -normal[i] : normal[i];
		if (state->local_viewer)
			viewer[i] = -eye[i];
		colour[i] = (double)m->emission[i] +
			    (double)state->ambient[i] * (double)m->ambient[i];
	}
	unit(n);
	unit(viewer);
	for (int l = 0; l < ACCEL_LIGHTS; l++) {
		const struct accel_light *light = &state->light[l];
		double to[3], half[3], factor, diffuse, highlight;

		if (!light->enabled)
			continue;
		factor = reference_reach(light, eye, to);
		for (int i = 0; i < 3; i++)
			half[i] = to[i] + viewer[i];
		unit(half);
		diffuse = fmax(dot(n, to), 0);
		highlight = diffuse > 0 ? pow(fmax(dot(n, half), 0), (double)m->shininess) : 0;
		for (int i = 0; i < 3; i++)
			colour[i] += factor *
				     ((double)light->ambient[i] * (double)m->ambient[i] +
				      diffuse * (double)light->diffuse[i] * (double)m->diffuse[i] +
				      highlight * (double)light->specular[i] *
					      (double)m->specular[i]);
	}
}

static void random_rgba(uint64_t *seed, float rgba[4])
{
	for (int i = 0; i < 4; i++)
		rgba[i] = test_unit(seed);
}

static void random_vector(uint64_t *seed, float v[3], float length)
{
	do
		for (int i = 0; i < 3; i++)
			v[i] = (2 * test_unit(seed) - 1) * length;
	while (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] < 0.01f * length * length);
}

static struct accel_light random_light(uint64_t *seed)
{
	struct accel_light light = ACCEL_LIGHT(.enabled = test_below(seed, 3) != 0,
					       .spot_cutoff = 180);

	random_vector(seed, light.position, 3);
	light.position[3] = test_below(seed, 2) ? 0.5f + test_unit(seed) : 0;
	random_rgba(seed, light.ambient);
	random_rgba(seed, light.diffuse);
	random_rgba(seed, light.specular);
	light.attenuation[0] = 0.5f + test_unit(seed);
	light.attenuation[1] = test_below(seed, 2) ? test_unit(seed) : 0;
	light.attenuation[2] = test_below(seed, 2) ? test_unit(seed) : 0;
	random_vector(seed, light.spot_direction, 1);
	if (test_below(seed, 2)) {
		light.spot_cutoff = 90 * test_unit(seed);
		light.spot_exponent = 128 * test_unit(seed);
	}
	return light;
}

static void random_state(uint64_t *seed, struct accel_state *state)
{
	struct accel_material material[2] = { ACCEL_MATERIAL(), ACCEL_MATERIAL() };

	for (int side = 0; side < 2; side++) {
		random_rgba(seed, material[side].emission);
		random_rgba(seed, material[side].ambient);
		random_rgba(seed, material[side].diffuse);
		random_rgba(seed, material[side].specular);
		material[side].shininess = test_below(seed, 8) ? 1000 * test_unit(seed) : 0;
	}
	assert_int_equal(accel_state_set_material(state, &material[0], &material[1]), 0);
	for (int i = 0; i < ACCEL_LIGHTS; i++) {
		struct accel_light light = random_light(seed);

		assert_int_equal(accel_state_set_light(state, i, &light), 0);
	}
	accel_state_set_local_viewer(state, test_below(seed, 2));
}

/* At the rim of a cone, or in a light's plane, rounding decides whether there is light. */
static bool at_a_step(const struct accel_state *state, const double eye[3], double normal[3])
{
	unit(normal);
	for (int i = 0; i < ACCEL_LIGHTS; i++) {
		struct accel_light light = state->light[i];
		double inside, outside, to[3];

		light.spot_exponent = 0;
		light.spot_cutoff *= 0.999f;
		inside = reference_reach(&light, eye, to);
		light.spot_cutoff *= 1.002f;
		outside = light.spot_cutoff > 180 ? inside : reference_reach(&light, eye, to);
		if (inside != outside || fabs(dot(normal, to)) < 1e-5)
			return true;
	}
	return false;
}

static void lights_are_as_the_specification_says(void **unused)
{
	uint64_t seed = test_seed();
	struct accel_lighting lighting;
	struct accel_state *state;

	(void)unused;
	assert_int_equal(accel_state_new(&state), 0);
	for (int n = 0; n < RANDOM_SAMPLES; n++) {
		int side = (int)test_below(&seed, 2);
		struct accel_sample sample;
		float eye[3], normal[3];
		double wide_eye[3], wide_normal[3], colour[3];

		random_state(&seed, state);
		random_vector(&seed, eye, 4);
		random_vector(&seed, normal, 2);
		for (int i = 0; i < 3; i++) {
			wide_eye[i] = (double)eye[i];
			wide_normal[i] = (double)normal[i];
		}
		if (at_a_step(state, wide_eye, wide_normal))
			continue;
		accel_lighting_init(&lighting, state, false);
		accel_lighting_sample(&lighting, side, eye, normal, white, &sample);
		reference_sample(state, side, wide_eye, wide_normal, colour);
		for (int i = 0; i < 3; i++) {
			double wanted = fmin(colour[i], (double)ACCEL_COLOUR_MAX);

			/* Half a thousandth a light is what may be left out of a highlight. */
			if (fabs((double)sample.colour[i] - wanted) > 0.004)
				fail_msg("sample %d: %g is not %g", n, (double)sample.colour[i],
					 wanted);
		}
		assert_true(sample.colour[3] == state->material[side].diffuse[3]);
	}
	accel_state_free(state);
}

static void the_power_is_that_of_the_c_library(void **unused)
{
	uint64_t seed = test_seed();

	(void)unused;
	for (int n = 0; n < 1000000; n++) {
		float x = test_below(&seed, 2) ? test_unit(&seed) : 1 - test_unit(&seed) / 1024;
		float exponent = 1000 * test_unit(&seed) * test_unit(&seed);
		double wanted = pow((double)x, (double)exponent);
		double got = (double)loop_power(x, exponent);

		if (fabs(got - wanted) > 1e-6 + 1e-4 * wanted)
			fail_msg("%a to the %a is %g, not %g", (double)x, (double)exponent, got,
				 wanted);
	}
	assert_true(loop_power(1, 1000) == 1);
	assert_true(loop_power(0, 1000) == 0);
	assert_true(loop_power(0, 0) == 1);
	assert_true(loop_power(-1, 3) == 0);
	assert_true(loop_power(0x1p-149f, 1) == 0);
}

static void what_is_not_a_number_is_black(void **unused)
{
	struct accel_state *state = state_shiny(20);
	struct accel_lighting lighting;
	struct accel_sample sample;

	(void)unused;
	/* The way to the light is too long for a float. */
	state->light[0].position[0] = 3e38f;
	state->light[0].position[3] = 1;
	accel_lighting_init(&lighting, state, false);
	accel_lighting_sample(&lighting, 0, (const float[3]){ -3e38f, 1, 1 },
			      (const float[3]){ 1, 1, 1 }, white, &sample);
	for (int i = 0; i < 3; i++)
		assert_true(sample.colour[i] >= 0 && sample.colour[i] <= ACCEL_COLOUR_MAX);
	/* A normal without length, at the light itself. */
	accel_lighting_sample(&lighting, 0, state->light[0].position, (const float[3]){ 0, 0, 0 },
			      white, &sample);
	for (int i = 0; i < 3; i++)
		assert_true(sample.colour[i] >= 0 && sample.colour[i] <= ACCEL_COLOUR_MAX);
	accel_state_free(state);
}

static void sums_are_kept_above_one_but_not_above_what_surfaces_hold(void **unused)
{
	struct accel_state *state = state_shiny(20);
	struct accel_lighting lighting;
	struct accel_sample sample;

	(void)unused;
	state->local_viewer = false;
	state->material[0].emission[0] = 0.9f;
	state->material[0].emission[1] = 900;
	state->material[0].emission[2] = -900;
	accel_lighting_init(&lighting, state, false);
	accel_lighting_sample(&lighting, 0, (const float[3]){ 0, 0, -1 },
			      (const float[3]){ 0.3f, 0.4f, 0.866f }, white, &sample);
	assert_true(sample.colour[0] > 1.5f && sample.colour[0] < ACCEL_COLOUR_MAX);
	assert_true(sample.colour[1] == ACCEL_COLOUR_MAX);
	assert_true(sample.colour[2] == 0);
	accel_state_free(state);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(lights_are_as_the_specification_says),
		cmocka_unit_test(the_power_is_that_of_the_c_library),
		cmocka_unit_test(what_is_not_a_number_is_black),
		cmocka_unit_test(sums_are_kept_above_one_but_not_above_what_surfaces_hold),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
