/* SPDX-License-Identifier: MIT */
#include <math.h>

#include "accel_priv.h"
#include "accel_test.h"

static int setup(void **state)
{
	return accel_state_new((struct accel_state **)state);
}

static int teardown(void **state)
{
	accel_state_free(*state);
	return 0;
}

#define assert_float_exact(a, b) assert_true((a) == (b))

static void defaults_are_those_of_the_header(void **state)
{
	const struct accel_state *s = *state;
	int i;

	for (i = 0; i < 16; i++) {
		assert_float_exact(s->modelview[i], i % 5 == 0);
		assert_float_exact(s->projection[i], i % 5 == 0);
	}
	assert_true(s->viewport.width < 0);
	assert_true(s->scissor.width < 0);
	assert_float_exact(s->depth_near, 0);
	assert_float_exact(s->depth_far, 1);
	assert_int_equal(s->depth_func, ACCEL_COMPARE_ALWAYS);
	assert_false(s->depth_write);
	for (i = 0; i < 4; i++)
		assert_true(s->colour_mask[i]);
	assert_int_equal(s->cull, ACCEL_CULL_NONE);
	assert_false(s->lighting);
	assert_false(s->two_sided);
	assert_true(s->local_viewer);
	assert_int_equal(s->shading, ACCEL_SHADING_ADAPTIVE);
	assert_float_exact(s->ambient[1], 0.2f);
	for (i = 0; i < 2; i++) {
		assert_float_exact(s->material[i].diffuse[0], 0.8f);
		assert_float_exact(s->material[i].shininess, 0);
	}
	for (i = 0; i < ACCEL_LIGHTS; i++) {
		assert_false(s->light[i].enabled);
		assert_float_exact(s->light[i].diffuse[0], i == 0);
		assert_float_exact(s->light[i].position[2], 1);
		assert_float_exact(s->light[i].position[3], 0);
		assert_float_exact(s->light[i].spot_cutoff, 180);
	}
}

static void setters_keep_what_they_are_given(void **state)
{
	struct accel_state *s = *state;
	float matrix[16], rgba[4] = { 0.1f, 0.2f, 0.3f, 0.4f };
	int i;

	for (i = 0; i < 16; i++)
		matrix[i] = (float)i;
	accel_state_set_modelview(s, matrix);
	matrix[0] = 99;
	accel_state_set_projection(s, matrix);
	accel_state_set_viewport(s, 1, 2, 3, 4);
	accel_state_set_scissor(s, 5, 6, 7, 8);
	accel_state_set_depth(s, ACCEL_COMPARE_LEQUAL, true);
	accel_state_set_colour_mask(s, true, false, false, true);
	accel_state_set_cull(s, ACCEL_CULL_FRONT);
	accel_state_set_lighting(s, true);
	accel_state_set_two_sided(s, true);
	accel_state_set_local_viewer(s, false);
	assert_int_equal(accel_state_set_ambient(s, rgba), 0);
	accel_state_set_shading(s, ACCEL_SHADING_FLAT);
	assert_float_exact(s->modelview[0], 0);
	assert_float_exact(s->modelview[15], 15);
	assert_float_exact(s->projection[0], 99);
	assert_int_equal(s->viewport.x, 1);
	assert_int_equal(s->viewport.y, 2);
	assert_int_equal(s->viewport.width, 3);
	assert_int_equal(s->viewport.height, 4);
	assert_int_equal(s->scissor.x, 5);
	assert_int_equal(s->scissor.y, 6);
	assert_int_equal(s->scissor.width, 7);
	assert_int_equal(s->scissor.height, 8);
	assert_int_equal(s->depth_func, ACCEL_COMPARE_LEQUAL);
	assert_true(s->depth_write);
	assert_true(s->colour_mask[0] && s->colour_mask[3]);
	assert_false(s->colour_mask[1] || s->colour_mask[2]);
	assert_int_equal(s->cull, ACCEL_CULL_FRONT);
	assert_true(s->lighting);
	assert_true(s->two_sided);
	assert_false(s->local_viewer);
	assert_float_exact(s->ambient[3], 0.4f);
	assert_int_equal(s->shading, ACCEL_SHADING_FLAT);
}

static void depth_range_is_clamped(void **state)
{
	struct accel_state *s = *state;

	accel_state_set_depth_range(s, -1, 2);
	assert_float_exact(s->depth_near, 0);
	assert_float_exact(s->depth_far, 1);
	accel_state_set_depth_range(s, 0.75f, 0.25f);
	assert_float_exact(s->depth_near, 0.75f);
	assert_float_exact(s->depth_far, 0.25f);
	accel_state_set_depth_range(s, NAN, INFINITY);
	assert_float_exact(s->depth_near, 0);
	assert_float_exact(s->depth_far, 1);
}

static const struct accel_material material = ACCEL_MATERIAL(.emission = { 0, 0, 0, 1 },
							     .ambient = { 0.1f, 0, 0, 1 },
							     .diffuse = { 0.5f, 0, 0, 1 },
							     .specular = { 1, 1, 1, 1 },
							     .shininess = 1000);

static void a_material_is_for_one_side_or_both(void **state)
{
	struct accel_state *s = *state;
	struct accel_material back = material;

	back.shininess = 0;
	assert_int_equal(accel_state_set_material(s, &material, &back), 0);
	assert_memory_equal(&s->material[0], &material, sizeof(material));
	assert_memory_equal(&s->material[1], &back, sizeof(back));
	assert_int_equal(accel_state_set_material(s, &material, NULL), 0);
	assert_memory_equal(&s->material[1], &material, sizeof(material));
}

/* Puts @value into each float of @object in turn; the state must refuse all of them. */
static void a_material_that_is_not_finite_changes_nothing(void **state)
{
	static const float wrong[] = { NAN, INFINITY, -INFINITY };
	struct accel_state *s = *state;
	struct accel_state before = *s;
	size_t i, at;

	for (at = offsetof(struct accel_material, emission) / sizeof(float);
	     at <= offsetof(struct accel_material, shininess) / sizeof(float); at++) {
		for (i = 0; i < 3; i++) {
			struct accel_material bad = material;

			memcpy((float *)&bad + at, &wrong[i], sizeof(float));
			assert_int_equal(accel_state_set_material(s, &bad, NULL), -EINVAL);
			assert_int_equal(accel_state_set_material(s, &material, &bad), -EINVAL);
		}
	}
	assert_memory_equal(s, &before, sizeof(before));
}

static void shininess_has_its_range(void **state)
{
	struct accel_material bad = material;

	bad.shininess = 1000.5f;
	assert_int_equal(accel_state_set_material(*state, &bad, NULL), -EINVAL);
	bad.shininess = -0.5f;
	assert_int_equal(accel_state_set_material(*state, &bad, NULL), -EINVAL);
	bad = material;
	bad.reserved = 1;
	assert_int_equal(accel_state_set_material(*state, &bad, NULL), -EINVAL);
}

static const struct accel_light spot = ACCEL_LIGHT(.enabled = true, .position = { 1, 2, 3, 1 },
						   .diffuse = { 1, 1, 1, 1 },
						   .attenuation = { 1, 0.5f, 0.25f },
						   .spot_direction = { 0, 0, -1 },
						   .spot_exponent = 128, .spot_cutoff = 90);

static void a_light_has_an_index(void **state)
{
	struct accel_state *s = *state;

	assert_int_equal(accel_state_set_light(s, -1, &spot), -EINVAL);
	assert_int_equal(accel_state_set_light(s, ACCEL_LIGHTS, &spot), -EINVAL);
	assert_int_equal(accel_state_set_light(s, ACCEL_LIGHTS - 1, &spot), 0);
	assert_memory_equal(&s->light[ACCEL_LIGHTS - 1], &spot, sizeof(spot));
}

static void a_light_out_of_range_changes_nothing(void **state)
{
	static const struct accel_light good = ACCEL_LIGHT(.position = { 0, 0, 1, 1 },
							   .attenuation = { 1, 0, 0 },
							   .spot_cutoff = 180);
	struct accel_state *s = *state, before;
	struct accel_light bad;

#define refuse(field, value)                                                  \
	do {                                                                  \
		bad = good;                                                   \
		bad.field = (value);                                          \
		assert_int_equal(accel_state_set_light(s, 0, &bad), -EINVAL); \
	} while (0)

	before = *s;
	refuse(position[3], NAN);
	refuse(ambient[0], INFINITY);
	refuse(diffuse[1], NAN);
	refuse(specular[2], -INFINITY);
	refuse(attenuation[1], -1);
	refuse(attenuation[2], NAN);
	refuse(spot_direction[2], NAN);
	refuse(spot_exponent, -1);
	refuse(spot_exponent, 129);
	refuse(spot_exponent, NAN);
	refuse(spot_cutoff, 91);
	refuse(spot_cutoff, -1);
	refuse(spot_cutoff, NAN);
	refuse(reserved, 1);
#undef refuse
	assert_memory_equal(s, &before, sizeof(before));
	assert_int_equal(accel_state_set_light(s, 0, &good), 0);
}

static void an_ambient_light_that_is_not_finite_changes_nothing(void **state)
{
	static const float wrong[] = { NAN, INFINITY, -INFINITY };
	struct accel_state *s = *state, before = *s;

	for (int n = 0; n < 12; n++) {
		float rgba[4] = { 0.5f, 0.5f, 0.5f, 1 };

		rgba[n / 3] = wrong[n % 3];
		assert_int_equal(accel_state_set_ambient(s, rgba), -EINVAL);
	}
	assert_memory_equal(s, &before, sizeof(before));
}

static void a_light_is_finite_whether_its_kind_needs_the_number_or_not(void **state)
{
	static const float wrong[] = { NAN, INFINITY, -INFINITY };
	struct accel_state *s = *state, before = *s;

	for (int n = 0; n < 3; n++) {
		for (int i = 0; i < 3; i++) {
			struct accel_light light = ACCEL_LIGHT(.position = { 0, 0, 1, 0 },
							       .spot_cutoff = 180);

			light.attenuation[i] = wrong[n];
			assert_int_equal(accel_state_set_light(s, 0, &light), -EINVAL);
			light.attenuation[i] = 0;
			light.spot_direction[i] = wrong[n];
			assert_int_equal(accel_state_set_light(s, 0, &light), -EINVAL);
		}
	}
	assert_memory_equal(s, &before, sizeof(before));
}

static void a_directional_light_needs_no_attenuation(void **state)
{
	static const struct accel_light light = ACCEL_LIGHT(.position = { 0, 0, 1, 0 },
							    .spot_cutoff = 180);

	assert_int_equal(accel_state_set_light(*state, 0, &light), 0);
}

static void a_plain_light_needs_no_more_than_a_place_and_colours(void **state)
{
	static const struct accel_light plain = ACCEL_LIGHT(.enabled = true,
							    .position = { 0, 0, 1, 1 },
							    .diffuse = { 1, 1, 1, 1 });
	static const struct accel_light whole = ACCEL_LIGHT(.enabled = true,
							    .position = { 0, 0, 1, 1 },
							    .diffuse = { 1, 1, 1, 1 },
							    .attenuation = { 1, 0, 0 },
							    .spot_direction = { 0, 0, -1 },
							    .spot_cutoff = 180);
	struct accel_state *s = *state;

	assert_int_equal(accel_state_set_light(s, 2, &plain), 0);
	assert_memory_equal(&s->light[2], &whole, sizeof(whole));
}

static void a_struct_without_its_size_changes_nothing(void **state)
{
	static const struct accel_material no_size = { .shininess = 1 };
	static const struct accel_light dark = { .enabled = true };
	struct accel_state *s = *state, before = *s;

	assert_int_equal(accel_state_set_light(s, 0, &dark), -EINVAL);
	assert_int_equal(accel_state_set_material(s, &no_size, NULL), -EINVAL);
	assert_int_equal(accel_state_set_material(s, &material, &no_size), -EINVAL);
	assert_memory_equal(s, &before, sizeof(before));
}

/* Structs of a version to come. */
struct later_light {
	struct accel_light light;
	double hue;
};

struct later_material {
	struct accel_material material;
	double roughness;
};

static void a_later_struct_is_taken_if_all_that_is_new_is_zero(void **state)
{
	struct later_light light = { .light = spot };
	struct later_material later = { .material = material };
	struct accel_state *s = *state, before;

	light.light.size = sizeof(light);
	later.material.size = sizeof(later);
	assert_int_equal(accel_state_set_light(s, 0, &light.light), 0);
	assert_memory_equal(&s->light[0], &spot, sizeof(spot));
	assert_int_equal(accel_state_set_material(s, &later.material, &material), 0);
	assert_memory_equal(&s->material[0], &material, sizeof(material));
	before = *s;
	light.hue = later.roughness = 1;
	assert_int_equal(accel_state_set_light(s, 0, &light.light), -E2BIG);
	assert_int_equal(accel_state_set_material(s, &later.material, &material), -E2BIG);
	assert_int_equal(accel_state_set_material(s, &material, &later.material), -E2BIG);
	assert_memory_equal(s, &before, sizeof(before));
}

#define state_test(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
	const struct CMUnitTest tests[] = {
		state_test(defaults_are_those_of_the_header),
		state_test(setters_keep_what_they_are_given),
		state_test(depth_range_is_clamped),
		state_test(a_material_is_for_one_side_or_both),
		state_test(a_material_that_is_not_finite_changes_nothing),
		state_test(shininess_has_its_range),
		state_test(a_light_has_an_index),
		state_test(a_light_out_of_range_changes_nothing),
		state_test(an_ambient_light_that_is_not_finite_changes_nothing),
		state_test(a_light_is_finite_whether_its_kind_needs_the_number_or_not),
		state_test(a_directional_light_needs_no_attenuation),
		state_test(a_plain_light_needs_no_more_than_a_place_and_colours),
		state_test(a_struct_without_its_size_changes_nothing),
		state_test(a_later_struct_is_taken_if_all_that_is_new_is_zero),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
