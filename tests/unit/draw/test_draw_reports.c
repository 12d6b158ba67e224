/* SPDX-License-Identifier: MIT */
/* Faults that were reported of other renderers in public: the same conditions here. */
#include "draw_mesh.h"

#define SIDE 64
#define WHITE 0xffffffffu

static struct messages messages;
static struct accel_device *device;
static struct accel_target *target;
static struct accel_draw *draw;
static struct accel_state *state;
static uint32_t pixels[SIDE * SIDE];

static const float square[4][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { -1, 1, 0 }, { 1, 1, 0 } };

static struct accel_mesh strip(const float (*position)[3], uint32_t vertices)
{
	return (struct accel_mesh)ACCEL_MESH(.topology = ACCEL_TOPOLOGY_TRIANGLE_STRIP,
					     .vertices = vertices,
					     .position = { .data = position });
}

/* Draws on black, and returns how many pixels the mesh has. */
static int drawn(const struct accel_mesh *mesh)
{
	int count = 0;

	assert_int_equal(draw_begin(draw, target, (const float[4]){ 0 }, 1), 0);
	assert_int_equal(accel_draw_mesh(draw, state, mesh), 0);
	assert_int_equal(accel_draw_finish(draw), 0);
	assert_int_equal(accel_target_read(target, ACCEL_PLANE_COLOUR, NULL, pixels, SIDE * 4), 0);
	for (int i = 0; i < SIDE * SIDE; i++)
		count += pixels[i] != 0;
	return count;
}

static struct accel_light lamp(void)
{
	return (struct accel_light)ACCEL_LIGHT(.enabled = true, .position = { 0, 0, 1, 1 },
					       .diffuse = { 1, 1, 1, 1 },
					       .specular = { 1, 1, 1, 1 },
					       .attenuation = { 1, 0, 0 },
					       .spot_direction = { 0, 0, -1 }, .spot_cutoff = 180);
}

static void huge_coordinates_cover_the_window(void)
{
	for (int power = 0; power <= 90; power += 5) {
		float position[4][3], far = ldexpf(1, power);
		struct accel_mesh mesh = strip(position, 4);

		for (int i = 0; i < 12; i++)
			position[i / 3][i % 3] = far * square[i / 3][i % 3];
		assert_int_equal(drawn(&mesh), SIDE * SIDE);
		/* An edge through the middle of the window, from far to far. */
		position[0][0] = position[2][0] = 0;
		assert_int_equal(drawn(&mesh), SIDE * SIDE / 2);
	}
}

static void coordinates_to_the_end_of_float_are_taken(void)
{
	const float position[3][3] = { { -3e38f, -3e38f, 0 },
				       { 3e38f, -3e38f, 0 },
				       { 0, 3e38f, 0 } };
	struct accel_mesh mesh = strip(position, 3);

	assert_in_range(drawn(&mesh), 0, SIDE * SIDE);
}

static void less_than_a_triangle_is_nothing(void)
{
	struct accel_mesh mesh;

	for (int topology = ACCEL_TOPOLOGY_TRIANGLES; topology <= ACCEL_TOPOLOGY_TRIANGLE_FAN;
	     topology++)
		for (uint32_t n = 0; n < 3; n++) {
			const uint32_t index[3] = { 0, 1, 2 };

			mesh = strip(square, n);
			mesh.topology = (enum accel_topology)topology;
			assert_int_equal(drawn(&mesh), 0);
			mesh.vertices = 4;
			mesh.index = index;
			mesh.indices = n;
			assert_int_equal(drawn(&mesh), 0);
		}
}

static void a_restart_index_is_an_index_out_of_range(void)
{
	const uint32_t index[5] = { 0, 1, 2, 0xffffffff, 3 };
	struct accel_mesh mesh = strip(square, 4);

	mesh.index = index;
	mesh.indices = 5;
	assert_int_equal(accel_draw_begin(draw, target, NULL), 0);
	assert_int_equal(accel_draw_mesh(draw, state, &mesh), -EINVAL);
	assert_message(&messages, "index 3 is of vertex 4294967295");
}

/* What was bright enough to see, with a normal, a light and a shininess that are all at an end. */
static void lit(struct accel_light light, float shininess, const float normal[3], int low, int high)
{
	float normals[4][3];
	struct accel_mesh mesh = strip(square, 4);
	const struct accel_material material = ACCEL_MATERIAL(.emission = { 0.2f, 0.2f, 0.2f, 1 },
							      .diffuse = { 0.4f, 0.4f, 0.4f, 1 },
							      .specular = { 0.2f, 0.2f, 0.2f, 1 },
							      .shininess = shininess);

	mesh.normal.data = normals;
	for (int i = 0; i < 12; i++)
		normals[i / 3][i % 3] = normal[i % 3];
	accel_state_set_lighting(state, true);
	assert_int_equal(accel_state_set_material(state, &material, NULL), 0);
	assert_int_equal(accel_state_set_light(state, 0, &light), 0);
	for (int shading = 0; shading < 4; shading++) {
		accel_state_set_shading(state, (enum accel_shading)shading);
		assert_int_equal(drawn(&mesh), SIDE * SIDE);
		for (int i = 0; i < SIDE * SIDE; i++)
			assert_in_range(pixels[i] & 0xff, low, high);
	}
}

static void a_light_of_a_place_and_a_colour_shines(void)
{
	const struct accel_light plain = ACCEL_LIGHT(.enabled = true, .position = { 0, 0, 1, 1 },
						     .diffuse = { 1, 1, 1, 1 });

	lit(plain, 0, (const float[3]){ 0, 0, 1 }, 0x5f, 0x9a);
}

static void a_highlight_of_shininess_0_is_everywhere(void)
{
	struct accel_light light = lamp();

	light.position[3] = 0;
	lit(light, 0, (const float[3]){ 0, 0, 1 }, 203, 205);
}

static void no_highlight_where_the_light_is_behind(void)
{
	struct accel_light light = lamp();

	light.position[2] = -1;
	light.position[3] = 0;
	lit(light, 0, (const float[3]){ 0, 0, 1 }, 51, 51);
	light.position[0] = 1;
	light.position[2] = 0;
	lit(light, 30, (const float[3]){ 0, 0, 1 }, 51, 51);
}

static void a_normal_without_length_and_a_light_in_the_surface_are_no_nan(void)
{
	struct accel_light light = lamp();

	lit(light, 30, (const float[3]){ 0, 0, 0 }, 51, 51);
	light.position[0] = -1;
	light.position[1] = -1;
	light.position[2] = 0;
	light.attenuation[0] = 0;
	light.attenuation[1] = 1;
	lit(light, 30, (const float[3]){ 0, 0, 1 }, 51, 255);
}

static void a_spot_of_no_angle_or_of_all_is_lit_or_not(void)
{
	struct accel_light light = lamp();

	light.position[0] = 0.01f;
	light.spot_cutoff = 1e-3f;
	lit(light, 30, (const float[3]){ 0, 0, 1 }, 51, 51);
	light.spot_cutoff = 90;
	light.spot_direction[2] = 1;
	lit(light, 30, (const float[3]){ 0, 0, 1 }, 51, 51);
}

static void a_mirror_turns_the_front_over(void)
{
	const float mirror[16] = { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
	struct accel_mesh mesh = strip(square, 4);

	accel_state_set_cull(state, ACCEL_CULL_BACK);
	assert_int_equal(drawn(&mesh), SIDE * SIDE);
	accel_state_set_modelview(state, mirror);
	assert_int_equal(drawn(&mesh), 0);
	accel_state_set_cull(state, ACCEL_CULL_FRONT);
	assert_int_equal(drawn(&mesh), SIDE * SIDE);
}

static const struct {
	const char *report;
	void (*check)(void);
} reports[] = {
	{ "xemu-project/xemu#2510, dkfans/keeperfx#4668", huge_coordinates_cover_the_window },
	{ "xemu-project/xemu#2510", coordinates_to_the_end_of_float_are_taken },
	{ "SerenityOS/serenity#11830", less_than_a_triangle_is_nothing },
	{ "SerenityOS/serenity#12858", a_light_of_a_place_and_a_colour_shines },
	{ "hedge-dev/UnleashedRecomp#428", a_restart_index_is_an_index_out_of_range },
	{ "mrdoob/three.js#5222", a_highlight_of_shininess_0_is_everywhere },
	{ "glslify/glsl-specular-phong#3", no_highlight_where_the_light_is_behind },
	{ "hrydgard/ppsspp#11567, #14231",
	  a_normal_without_length_and_a_light_in_the_surface_are_no_nan },
	{ "godotengine/godot#34527", a_spot_of_no_angle_or_of_all_is_lit_or_not },
	{ "castle-engine/castle-engine#336, godotengine/godot#29317",
	  a_mirror_turns_the_front_over },
};

static void public_reports(void **unused)
{
	(void)unused;
	device = device_open("model:", &messages);
	assert_int_equal(accel_target_new(device, SIDE, SIDE, &target), 0);
	assert_int_equal(accel_draw_new(device, &draw), 0);
	for (size_t i = 0; i < sizeof(reports) / sizeof(reports[0]); i++) {
		print_message("%s\n", reports[i].report);
		assert_int_equal(accel_state_new(&state), 0);
		accel_state_set_local_viewer(state, false);
		reports[i].check();
		accel_state_free(state);
	}
	accel_draw_free(draw);
	accel_target_free(target);
	accel_device_free(device);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(public_reports),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
