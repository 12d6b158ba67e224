// SPDX-License-Identifier: MIT
/* The equation of light, pixel by pixel. */
#include <errno.h>

#include "phong_square.h"

/* ---- light ---- */

static void a_directional_light_gives_what_the_equation_says(void **state)
{
	struct fixture *f = *state;
	const double cosine = 1 / sqrt(2), half = sqrt((1 + cosine) / 2);

	f->scene.light[0] = scene_light_direction(1, 0, 1);
	f->scene.light[0].ambient[0] = 0.5f;
	f->scene.material[0] = scene_material_grey(0.1f, 0.6f, 0.3f, 20);
	f->scene.material[0].emission[0] = 0.05f;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(covered(&f->frame), SIZE * SIZE);
	for (int i = 0; i < SIZE * SIZE; i++) {
		double lit = 0.1 + 0.6 * cosine + 0.3 * pow(half, 20);

		assert_close(f->frame.light[i][0], lit + 0.05 + 0.5 * 0.1, 1e-5);
		assert_close(f->frame.light[i][1], lit, 1e-5);
		assert_int_equal(f->frame.pixel[i] >> 8 & 0xff, lround(lit * 255));
		assert_int_equal(f->frame.pixel[i] >> 24, 255);
	}
}

static void a_light_from_behind_gives_neither_diffuse_nor_specular(void **state)
{
	struct fixture *f = *state;

	f->scene.light[0] = scene_light_direction(1, 0, -0.001f);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, 5, 5)[0], 0.1, 1e-6);
}

static void light_is_not_clamped_but_pixels_are(void **state)
{
	struct fixture *f = *state;

	f->scene.material[0] = scene_material_grey(0.9f, 0.9f, 0, 0);
	f->scene.material[0].diffuse[3] = 0.5f;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, 9, 9)[2], 1.8, 1e-6);
	assert_int_equal(f->frame.pixel[9 * SIZE + 9], 0x80ffffff);
}

/* The square, tilted in perspective: each pixel's own ray says where it is and how far the lamp. */
static void positions_are_interpolated_with_perspective(void **state)
{
	struct fixture *f = *state;
	const double tilt = 60 * M_PI / 180, half = tan(20 * M_PI / 180);
	struct accel_light *lamp = &f->scene.light[0];

	*lamp = scene_light_point(0.3f, 0.2f, -2);
	lamp->attenuation[0] = 0.2f;
	lamp->attenuation[1] = 0.3f;
	lamp->attenuation[2] = 0.5f;
	lamp->ambient[0] = 1;
	f->scene.material[0] = scene_material_grey(0.5f, 0, 0, 1);
	memset(f->scene.ambient, 0, sizeof(f->scene.ambient));
	matrix_perspective(f->scene.projection, 40, 1, 1, 8);
	matrix_translate(f->scene.modelview, 0, 0, -4);
	matrix_rotate_y(f->scene.modelview, 60);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_true(covered(&f->frame) > 600);
	for (int i = 0; i < SIZE * SIZE; i++) {
		double x = ((i % SIZE + 0.5) / SIZE * 2 - 1) * half;
		double y = (1 - (i / SIZE + 0.5) / SIZE * 2) * half;
		/* The plane is x sin(tilt) + (z + 4) cos(tilt) = 0; the ray t (x, y, -1). */
		double t = 4 * cos(tilt) / (cos(tilt) - x * sin(tilt));
		double d = sqrt(pow(t * x - 0.3, 2) + pow(t * y - 0.2, 2) + pow(2 - t, 2));

		/* Vertices are moved to 1/16 pixel, which shifts it a little. */
		if (phong_covered(&f->frame, i))
			assert_close(f->frame.light[i][0], 0.5 / (0.2 + 0.3 * d + 0.5 * d * d),
				     3e-3);
	}
}

static void a_spot_shines_inside_its_cone_only(void **state)
{
	struct fixture *f = *state;
	struct accel_light *spot = &f->scene.light[0];

	*spot = scene_light_point(0, 0, 1);
	spot->spot_cutoff = 20;
	spot->spot_exponent = 8;
	f->scene.material[0] = scene_material_grey(0, 1, 0, 1);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	for (int x = 0; x < SIZE; x++) {
		double away = hypot((x + 0.5) / SIZE * 2 - 1, 0.5 / SIZE * 2);
		double cosine = 1 / hypot(1, away);
		double wanted = cosine > cos(20 * M_PI / 180) ? cosine * pow(cosine, 8) : 0;

		assert_close(light_at(f, x, SIZE / 2)[0], wanted, 1e-5);
	}
}

static void a_local_viewer_sees_the_highlight_from_the_eye(void **state)
{
	struct fixture *f = *state;
	double viewer[3], half[3], x = 10.5 / SIZE * 2 - 1, y = 1 - 50.5 / SIZE * 2, length;

	matrix_translate(f->scene.modelview, 0, 0, -0.5f);
	f->scene.material[0] = scene_material_grey(0, 0, 1, 15);
	f->scene.local_viewer = true;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	length = sqrt(x * x + y * y + 0.25);
	viewer[0] = -x / length;
	viewer[1] = -y / length;
	viewer[2] = 0.5 / length;
	memcpy(half, viewer, sizeof(half));
	half[2] += 1;
	length = sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
	assert_close(light_at(f, 10, 50)[0], pow(half[2] / length, 15), 1e-4);
}

static void normals_are_made_unit_length_at_each_pixel(void **state)
{
	struct fixture *f = *state;

	/* From the left to the right edge they turn by 90 degrees; their lengths do not count. */
	for (int i = 0; i < 4; i++) {
		f->normal[i][0] = square[i][0] * 5;
		f->normal[i][2] = 5;
	}
	f->scene.material[0] = scene_material_grey(0, 1, 0, 1);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	for (int x = 0; x < SIZE; x++) {
		double at = (x + 0.5) / SIZE * 2 - 1;

		assert_close(light_at(f, x, 3)[0], 1 / hypot(1, at), 1e-5);
	}
}

/* ---- faces ---- */

static void turn_round(struct fixture *f)
{
	matrix_rotate_y(f->scene.modelview, 180);
	f->scene.material[1] = scene_material_grey(0, 0.25f, 0, 1);
}

static void back_faces_have_their_own_material_and_turned_normals(void **state)
{
	struct fixture *f = *state;

	turn_round(f);
	f->scene.two_sided = true;
	f->scene.cull = ACCEL_CULL_NONE;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, 5, 5)[0], 0.25, 1e-6);
	f->scene.two_sided = false;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, 5, 5)[0], 0.1, 1e-6);
}

static void culled_faces_are_not_drawn(void **state)
{
	struct fixture *f = *state;

	f->scene.cull = ACCEL_CULL_FRONT;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(covered(&f->frame), 0);
	turn_round(f);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(covered(&f->frame), SIZE * SIZE);
	f->scene.cull = ACCEL_CULL_BACK;
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_int_equal(covered(&f->frame), 0);
}

static void strips_fans_and_lists_are_the_same_square(void **state)
{
	static const uint32_t strip[4] = { 0, 1, 3, 2 };
	static const enum accel_topology topology[] = { ACCEL_TOPOLOGY_TRIANGLE_STRIP,
							ACCEL_TOPOLOGY_TRIANGLE_FAN };
	struct fixture *f = *state;

	f->scene.mesh.indices = 4;
	f->scene.mesh.index = strip;
	for (int i = 0; i < 2; i++) {
		f->scene.mesh.topology = topology[i];
		assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
		assert_int_equal(covered(&f->frame), SIZE * SIZE);
		f->scene.mesh.index = NULL;
	}
}

static void an_index_out_of_range_is_refused(void **state)
{
	static const uint32_t bad[3] = { 0, 1, 4 };
	struct fixture *f = *state;

	f->scene.mesh.indices = 3;
	f->scene.mesh.index = bad;
	assert_int_equal(phong_draw(&f->scene, &f->frame), -EINVAL);
}

static void without_normals_a_face_has_its_own(void **state)
{
	struct fixture *f = *state;

	f->scene.mesh.normal.data = NULL;
	matrix_rotate_x(f->scene.modelview, 60);
	f->scene.material[0] = scene_material_grey(0, 1, 0, 1);
	assert_int_equal(phong_draw(&f->scene, &f->frame), 0);
	assert_close(light_at(f, SIZE / 2, SIZE / 2)[0], 0.5, 1e-5);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		CASE(a_directional_light_gives_what_the_equation_says),
		CASE(a_light_from_behind_gives_neither_diffuse_nor_specular),
		CASE(light_is_not_clamped_but_pixels_are),
		CASE(positions_are_interpolated_with_perspective),
		CASE(a_spot_shines_inside_its_cone_only),
		CASE(a_local_viewer_sees_the_highlight_from_the_eye),
		CASE(normals_are_made_unit_length_at_each_pixel),
		CASE(back_faces_have_their_own_material_and_turned_normals),
		CASE(culled_faces_are_not_drawn),
		CASE(strips_fans_and_lists_are_the_same_square),
		CASE(an_index_out_of_range_is_refused),
		CASE(without_normals_a_face_has_its_own),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
