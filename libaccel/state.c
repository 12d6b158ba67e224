// SPDX-License-Identifier: MIT
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel_priv.h"

#define SHININESS_MAX 1000.0f
#define SPOT_EXPONENT_MAX 128.0f
#define SPOT_CUTOFF_MAX 90.0f
#define SPOT_NONE 180.0f

static const float identity[16] = {
	1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
};

static const struct accel_material default_material = ACCEL_MATERIAL(
		.emission = { 0, 0, 0, 1 }, .ambient = { 0.2f, 0.2f, 0.2f, 1 },
		.diffuse = { 0.8f, 0.8f, 0.8f, 1 }, .specular = { 0, 0, 0, 1 });

static const struct accel_light default_light = ACCEL_LIGHT(.position = { 0, 0, 1, 0 },
							    .ambient = { 0, 0, 0, 1 },
							    .diffuse = { 0, 0, 0, 1 },
							    .specular = { 0, 0, 0, 1 },
							    .attenuation = { 1, 0, 0 },
							    .spot_direction = { 0, 0, -1 },
							    .spot_cutoff = SPOT_NONE);

static const float white[4] = { 1, 1, 1, 1 };

/* The next number that no state has had. */
static uint64_t state_stamp(void)
{
	static _Atomic uint64_t last;

	return atomic_fetch_add_explicit(&last, 1, memory_order_relaxed) + 1;
}

/* What vertices' places and normals depend on was changed. */
static void state_touch_geometry(struct accel_state *state)
{
	state->geometry_stamp = state_stamp();
}

/* The same of light. */
static void state_touch_light(struct accel_state *state)
{
	state->light_stamp = state_stamp();
}

int accel_state_new(struct accel_state **out)
{
	struct accel_state *state = malloc(sizeof(*state));

	if (!state)
		return -ENOMEM;
	*state = (struct accel_state){
		.viewport = { .width = -1 },
		.scissor = { .width = -1 },
		.depth_far = 1,
		.depth_func = ACCEL_COMPARE_ALWAYS,
		.colour_mask = { true, true, true, true },
		.cull = ACCEL_CULL_NONE,
		.local_viewer = true,
		.ambient = { 0.2f, 0.2f, 0.2f, 1 },
		.material = { default_material, default_material },
		.shading = ACCEL_SHADING_ADAPTIVE,
		.line = { .width = 1 },
		.point = { .width = 1, .most = ACCEL_WIDTH_MAX, .attenuation = { 1, 0, 0 } },
	};
	accel_state_set_modelview(state, identity);
	accel_state_set_projection(state, identity);
	for (int i = 0; i < ACCEL_LIGHTS; i++)
		state->light[i] = default_light;
	state_touch_light(state);
	memcpy(state->light[0].diffuse, white, sizeof(white));
	memcpy(state->light[0].specular, white, sizeof(white));
	*out = state;
	return 0;
}

void accel_state_free(struct accel_state *state)
{
	free(state);
}

void accel_state_set_modelview(struct accel_state *state, const float matrix[16])
{
	memcpy(state->modelview, matrix, sizeof(state->modelview));
	state_touch_geometry(state);
}

void accel_state_set_projection(struct accel_state *state, const float matrix[16])
{
	memcpy(state->projection, matrix, sizeof(state->projection));
	state_touch_geometry(state);
}

void accel_state_set_viewport(struct accel_state *state, int x, int y, int width, int height)
{
	state->viewport.x = x;
	state->viewport.y = y;
	state->viewport.width = width;
	state->viewport.height = height;
	state_touch_geometry(state);
}

/* What is not a number becomes 0. */
static float state_clamp(float value)
{
	return fminf(fmaxf(value, 0), 1);
}

void accel_state_set_depth_range(struct accel_state *state, float near, float far)
{
	state->depth_near = state_clamp(near);
	state->depth_far = state_clamp(far);
	state_touch_geometry(state);
}

void accel_state_set_scissor(struct accel_state *state, int x, int y, int width, int height)
{
	state->scissor.x = x;
	state->scissor.y = y;
	state->scissor.width = width;
	state->scissor.height = height;
	state_touch_geometry(state);
}

void accel_state_set_depth(struct accel_state *state, enum accel_compare func, bool write)
{
	state->depth_func = func;
	state->depth_write = write;
}

void accel_state_set_colour_mask(struct accel_state *state, bool red, bool green, bool blue,
				 bool alpha)
{
	state->colour_mask[0] = red;
	state->colour_mask[1] = green;
	state->colour_mask[2] = blue;
	state->colour_mask[3] = alpha;
}

void accel_state_set_cull(struct accel_state *state, enum accel_cull cull)
{
	state->cull = cull;
}

void accel_state_set_polygon_mode(struct accel_state *state, enum accel_polygon_mode front,
				  enum accel_polygon_mode back)
{
	state->polygon_mode[0] = front;
	state->polygon_mode[1] = back;
}

int accel_state_set_polygon_offset(struct accel_state *state, float factor, float units,
				   unsigned int modes)
{
	if (!isfinite(factor) || !isfinite(units) || modes >> (ACCEL_POLYGON_POINTS + 1))
		return -EINVAL;
	state->offset_factor = factor;
	state->offset_units = units;
	state->offset_modes = factor != 0 || units != 0 ? modes : 0;
	return 0;
}

void accel_state_set_front_face(struct accel_state *state, bool clockwise)
{
	state->clockwise = clockwise;
}

void accel_state_set_origin(struct accel_state *state, bool bottom)
{
	state->bottom = bottom;
	state_touch_geometry(state);
}

void accel_state_set_normals(struct accel_state *state, enum accel_normals normals)
{
	state->normals = normals;
	state_touch_geometry(state);
	state_touch_light(state);
}

void accel_state_set_lighting(struct accel_state *state, bool enabled)
{
	state->lighting = enabled;
	state_touch_geometry(state);
}

void accel_state_set_two_sided(struct accel_state *state, bool enabled)
{
	state->two_sided = enabled;
}

void accel_state_set_local_viewer(struct accel_state *state, bool enabled)
{
	state->local_viewer = enabled;
	state_touch_light(state);
}

void accel_state_set_colour_material(struct accel_state *state, enum accel_tracks front,
				     enum accel_tracks back)
{
	state->tracks[0] = front;
	state->tracks[1] = back;
	state_touch_light(state);
}

static bool state_finite(const float *value, int count)
{
	for (int i = 0; i < count; i++)
		if (!isfinite(value[i]))
			return false;
	return true;
}

int accel_state_set_clip_plane(struct accel_state *state, int index, const float plane[4])
{
	if (index < 0 || index >= ACCEL_USER_CLIP_PLANES || (plane && !state_finite(plane, 4)))
		return -EINVAL;
	state_touch_geometry(state);
	state->clip_planes &= ~(1u << index);
	if (!plane)
		return 0;
	state->clip_planes |= 1u << index;
	memcpy(state->clip_plane[index], plane, sizeof(state->clip_plane[index]));
	return 0;
}

int accel_state_set_ambient(struct accel_state *state, const float rgba[4])
{
	if (!state_finite(rgba, 4))
		return -EINVAL;
	memcpy(state->ambient, rgba, sizeof(state->ambient));
	state_touch_light(state);
	return 0;
}

static bool state_material_valid(const struct accel_material *material)
{
	return state_finite(material->emission, 4) && state_finite(material->ambient, 4) &&
	       state_finite(material->diffuse, 4) && state_finite(material->specular, 4) &&
	       !material->reserved && material->shininess >= 0 &&
	       material->shininess <= SHININESS_MAX;
}

int accel_state_set_material(struct accel_state *state, const struct accel_material *front,
			     const struct accel_material *back)
{
	struct accel_material material[2];
	int err = accel_sized_in(&material[0], sizeof(material[0]), front);

	if (!err)
		err = accel_sized_in(&material[1], sizeof(material[1]), back ? back : front);
	if (err)
		return err;
	if (!state_material_valid(&material[0]) || !state_material_valid(&material[1]))
		return -EINVAL;
	memcpy(state->material, material, sizeof(material));
	state_touch_light(state);
	return 0;
}

/* Of a directional light it says nothing, and need only be numbers. */
static bool state_attenuation_valid(const struct accel_light *light)
{
	const float *factor = light->attenuation;

	if (!state_finite(factor, 3))
		return false;
	return light->position[3] == 0 || (factor[0] >= 0 && factor[1] >= 0 && factor[2] >= 0);
}

static bool state_spot_valid(const struct accel_light *light)
{
	return state_finite(light->spot_direction, 3) && light->spot_exponent >= 0 &&
	       light->spot_exponent <= SPOT_EXPONENT_MAX &&
	       ((light->spot_cutoff >= 0 && light->spot_cutoff <= SPOT_CUTOFF_MAX) ||
		light->spot_cutoff == SPOT_NONE);
}

static bool state_zero(const float value[3])
{
	return value[0] == 0 && value[1] == 0 && value[2] == 0;
}

/* What a plain light leaves at zero, as OpenGL has it. */
static void state_light_complete(struct accel_light *light)
{
	if (state_zero(light->attenuation))
		light->attenuation[0] = 1;
	if (light->spot_cutoff == 0)
		light->spot_cutoff = SPOT_NONE;
	if (state_zero(light->spot_direction))
		light->spot_direction[2] = -1;
}

int accel_state_set_light(struct accel_state *state, int index, const struct accel_light *given)
{
	struct accel_light light;
	int err;

	if (index < 0 || index >= ACCEL_LIGHTS)
		return -EINVAL;
	err = accel_sized_in(&light, sizeof(light), given);
	if (err)
		return err;
	if (!state_finite(light.position, 4) || !state_finite(light.ambient, 4) ||
	    !state_finite(light.diffuse, 4) || !state_finite(light.specular, 4) ||
	    !state_attenuation_valid(&light) || !state_spot_valid(&light) || light.reserved)
		return -EINVAL;
	state_light_complete(&light);
	state->light[index] = light;
	state_touch_light(state);
	return 0;
}

void accel_state_set_shading(struct accel_state *state, enum accel_shading shading)
{
	state->shading = shading;
}

/* Up to the widest, and 0 is @otherwise. */
static float state_width(float width, float otherwise)
{
	width = width > 0 ? width : otherwise;
	return width < ACCEL_WIDTH_MAX ? width : ACCEL_WIDTH_MAX;
}

int accel_state_set_line_style(struct accel_state *state, const struct accel_line_style *given)
{
	struct accel_line_style style;
	int err = accel_sized_in(&style, sizeof(style), given);

	if (err)
		return err;
	if (!(style.width >= 0))
		return -EINVAL;
	style.width = state_width(style.width, 1);
	state->line = style;
	return 0;
}

int accel_state_set_point_style(struct accel_state *state, const struct accel_point_style *given)
{
	struct accel_point_style style;
	int err = accel_sized_in(&style, sizeof(style), given);

	if (err)
		return err;
	if (!(style.width >= 0 && style.least >= 0 && style.most >= 0) ||
	    !state_finite(style.attenuation, 3) || style.attenuation[0] < 0 ||
	    style.attenuation[1] < 0 || style.attenuation[2] < 0)
		return -EINVAL;
	style.width = state_width(style.width, 1);
	style.most = state_width(style.most, ACCEL_WIDTH_MAX);
	if (state_zero(style.attenuation))
		style.attenuation[0] = 1;
	state->point = style;
	return 0;
}
