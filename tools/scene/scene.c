// SPDX-License-Identifier: MIT
#include <string.h>

#include "scene/matrix.h"
#include "scene/scene.h"

static void grey(float rgba[4], float value)
{
	rgba[0] = rgba[1] = rgba[2] = value;
	rgba[3] = 1;
}

static struct accel_light light_white(void)
{
	struct accel_light light = ACCEL_LIGHT(.enabled = true, .attenuation = { 1, 0, 0 },
					       .spot_direction = { 0, 0, -1 });

	grey(light.ambient, 0);
	grey(light.diffuse, 1);
	grey(light.specular, 1);
	return light;
}

struct accel_light scene_light_direction(float x, float y, float z)
{
	struct accel_light light = light_white();

	light.position[0] = x;
	light.position[1] = y;
	light.position[2] = z;
	return light;
}

struct accel_light scene_light_point(float x, float y, float z)
{
	struct accel_light light = scene_light_direction(x, y, z);

	light.position[3] = 1;
	return light;
}

struct accel_material scene_material_grey(float ambient, float diffuse, float specular,
					  float shininess)
{
	struct accel_material material = ACCEL_MATERIAL(.shininess = shininess);

	grey(material.emission, 0);
	grey(material.ambient, ambient);
	grey(material.diffuse, diffuse);
	grey(material.specular, specular);
	return material;
}

void scene_init(struct scene *scene, int width, int height)
{
	memset(scene, 0, sizeof(*scene));
	scene->width = width;
	scene->height = height;
	matrix_identity(scene->modelview);
	matrix_identity(scene->projection);
	scene->cull = ACCEL_CULL_BACK;
	scene->local_viewer = true;
	grey(scene->background, 0);
	grey(scene->ambient, 1);
	for (int side = 0; side < 2; side++)
		scene->material[side] = scene_material_grey(0.1f, 0.6f, 0.3f, 30);
	scene->light[0] = scene_light_direction(0, 0, 1);
}

int scene_apply(const struct scene *scene, struct accel_state *state)
{
	const enum accel_tracks tracks = scene->painted ? ACCEL_TRACKS_AMBIENT_DIFFUSE :
							  ACCEL_TRACKS_NONE;
	int ret;

	accel_state_set_modelview(state, scene->modelview);
	accel_state_set_projection(state, scene->projection);
	accel_state_set_cull(state, scene->cull);
	accel_state_set_depth(state, ACCEL_COMPARE_LESS, true);
	accel_state_set_lighting(state, true);
	accel_state_set_two_sided(state, scene->two_sided);
	accel_state_set_local_viewer(state, scene->local_viewer);
	accel_state_set_colour_material(state, tracks, tracks);
	ret = accel_state_set_ambient(state, scene->ambient);
	if (!ret)
		ret = accel_state_set_material(state, &scene->material[0], &scene->material[1]);
	for (int i = 0; i < ACCEL_LIGHTS && !ret; i++)
		if (scene->light[i].enabled)
			ret = accel_state_set_light(state, i, &scene->light[i]);
	return ret;
}

int scene_draw(const struct scene *scene, enum accel_shading shading, struct accel_draw *draw,
	       struct accel_target *target, struct accel_draw_stats *stats)
{
	struct accel_clear clear = ACCEL_CLEAR(.mask = ACCEL_CLEAR_COLOUR | ACCEL_CLEAR_DEPTH,
					       .depth = 1);
	struct accel_state *state;
	int ret;

	ret = accel_state_new(&state);
	if (ret)
		return ret;
	ret = scene_apply(scene, state);
	accel_state_set_shading(state, shading);
	accel_state_set_viewport(state, -scene->left, -scene->top, scene->width, scene->height);
	memcpy(clear.rgba, scene->background, sizeof(clear.rgba));
	if (!ret)
		ret = accel_draw_begin(draw, target, &clear);
	if (!ret)
		ret = accel_draw_mesh(draw, state, &scene->mesh);
	if (!ret && !scene->keeps_depth)
		ret = accel_draw_discard(draw, ACCEL_CLEAR_DEPTH);
	if (!ret)
		ret = accel_draw_finish(draw);
	if (!ret && stats)
		accel_draw_stats(draw, stats, sizeof(*stats));
	accel_state_free(state);
	return ret;
}
