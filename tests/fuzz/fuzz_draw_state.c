// SPDX-License-Identifier: MIT
/* States of anything: matrices, lights, surfaces, and where on the target is drawn. */
#include "fuzz_draw_state.h"

#include <string.h>

#include "fuzz_draw_numbers.h"

static void set_matrices(struct accel_state *state)
{
	float matrix[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

	if (one_in(3))
		any_floats(matrix, 16);
	else
		any_floats(matrix + 12, 3);
	accel_state_set_modelview(state, matrix);
	/* Perspective from 0.1 to 20, orthographic, or anything. */
	memset(matrix, 0, sizeof(matrix));
	matrix[0] = matrix[5] = 1;
	matrix[10] = one_in(2) ? -1.01f : 1;
	matrix[11] = matrix[10] < 0 ? -1 : 0;
	matrix[14] = matrix[10] < 0 ? -0.201f : 0;
	matrix[15] = matrix[10] < 0 ? 0 : 1;
	if (one_in(6))
		any_floats(matrix, 16);
	accel_state_set_projection(state, matrix);
}

static void set_light(struct accel_state *state)
{
	struct accel_light light = ACCEL_LIGHT(.enabled = !one_in(5));

	any_floats(light.position, 4);
	if (one_in(2))
		light.position[3] = 0;
	any_floats(light.ambient, 4);
	any_floats(light.diffuse, 4);
	any_floats(light.specular, 4);
	any_floats(light.spot_direction, 3);
	for (int i = 0; i < 3; i++)
		light.attenuation[i] = one_in(2) ? float_to(1) : 0;
	light.spot_exponent = one_in(2) ? 0 : float_to(128);
	light.spot_cutoff = one_in(2) ? 180 : float_to(90);
	accel_state_set_light(state, below(ACCEL_LIGHTS + 1), &light);
}

static struct accel_material any_material(void)
{
	struct accel_material material = ACCEL_MATERIAL();

	any_floats(material.emission, 4);
	any_floats(material.ambient, 4);
	any_floats(material.diffuse, 4);
	any_floats(material.specular, 4);
	material.shininess = one_in(4) ? 0 : float_to(1000);
	return material;
}

static void set_surfaces(struct accel_state *state)
{
	struct accel_material front = any_material(), back = any_material();
	float ambient[4];

	any_floats(ambient, 4);
	accel_state_set_ambient(state, ambient);
	accel_state_set_material(state, &front, one_in(2) ? &back : NULL);
	accel_state_set_lighting(state, !one_in(3));
	accel_state_set_colour_material(state, (enum accel_tracks)below(6),
					(enum accel_tracks)below(6));
	accel_state_set_normals(state, (enum accel_normals)below(3));
	accel_state_set_front_face(state, one_in(2));
	accel_state_set_origin(state, one_in(4));
	accel_state_set_two_sided(state, one_in(2));
	accel_state_set_local_viewer(state, one_in(2));
	accel_state_set_shading(state, (enum accel_shading)below(4));
}

static void set_window(struct accel_state *state)
{
	if (one_in(3))
		accel_state_set_viewport(state, any_int(), any_int(), any_int(), any_int());
	else
		accel_state_set_viewport(state, 0, 0, -1, 0);
	if (one_in(3))
		accel_state_set_scissor(state, any_int(), any_int(), any_int(), any_int());
	else
		accel_state_set_scissor(state, 0, 0, -1, 0);
	accel_state_set_depth_range(state, float_to(1), float_to(1));
	accel_state_set_depth(state, (enum accel_compare)below(8), one_in(2));
	accel_state_set_colour_mask(state, one_in(2), !one_in(4), one_in(2), !one_in(4));
	accel_state_set_cull(state, (enum accel_cull)below(4));
}

static void set_planes(struct accel_state *state)
{
	float plane[4];

	any_floats(plane, 4);
	accel_state_set_clip_plane(state, below(ACCEL_USER_CLIP_PLANES), one_in(3) ? NULL : plane);
}

static void set_strokes(struct accel_state *state)
{
	struct accel_line_style line = ACCEL_LINE_STYLE(.width = float_to(70),
							.stipple = (uint16_t)random_word(),
							.repeat = (uint16_t)below(300));
	struct accel_point_style point = ACCEL_POINT_STYLE(.width = float_to(70),
							   .least = float_to(3));

	if (one_in(2))
		line.repeat = 0;
	for (int i = 0; i < 3; i++)
		point.attenuation[i] = one_in(2) ? float_to(1) : 0;
	accel_state_set_line_style(state, &line);
	accel_state_set_point_style(state, &point);
}

static void set_polygons(struct accel_state *state)
{
	accel_state_set_polygon_mode(state, (enum accel_polygon_mode)below(3),
				     (enum accel_polygon_mode)below(3));
	accel_state_set_polygon_offset(state, any_float(), any_float(), (unsigned int)below(8));
}

void fuzz_draw_state(struct accel_state *state)
{
	if (one_in(6))
		set_polygons(state);
	if (one_in(6))
		set_planes(state);
	if (one_in(4))
		set_strokes(state);
	if (one_in(2))
		set_matrices(state);
	for (int i = below(4); i > 0; i--)
		set_light(state);
	if (one_in(2))
		set_surfaces(state);
	if (one_in(2))
		set_window(state);
}
