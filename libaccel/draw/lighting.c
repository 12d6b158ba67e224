// SPDX-License-Identifier: MIT
/*
 * OpenGL's fixed-function lighting (specification 1.5, section 2.14.1) at a point of a surface, in
 * eye space. The highlight is Blinn's: by the half vector between viewer and light.
 */
#include <math.h>
#include <string.h>

#include "draw/kernel.h"

/* Fractions of full scale: less of a highlight is not worth a split, or even its power function. */
#define HIGHLIGHT_VISIBLE (2 / 255.0f)
#define HIGHLIGHT_FAINT (1 / 2048.0f)

/* Returns the length that @v had; a vector without length stays so. */
static float lighting_normalise(float v[3])
{
	float length = sqrtf(number_dot(v, v));
	float scale = length > 0 ? 1 / length : 0;

	for (int i = 0; i < 3; i++)
		v[i] *= scale;
	return length;
}

static void lighting_product(float out[3], const float a[4], const float b[4], float strength)
{
	for (int i = 0; i < 3; i++)
		out[i] = a[i] * b[i] * strength;
}

static float lighting_brightest(const float rgb[3])
{
	return fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
}

/* The material of a side, with white for what is painted. */
static struct accel_material lighting_material(const struct accel_finish *finish,
					       const struct accel_state *state, int side)
{
	static const float white[4] = { 1, 1, 1, 1 };
	struct accel_material material = state->material[side];

	if (finish->paints_ambient)
		memcpy(material.ambient, white, sizeof(white));
	if (finish->paints_diffuse)
		memcpy(material.diffuse, white, sizeof(white));
	if (finish->paints_specular)
		memcpy(material.specular, white, sizeof(white));
	return material;
}

/* What of a directional light's cone arrives, which is the same everywhere. */
static float lighting_cone(const struct accel_lamp *lamp)
{
	const float cosine = -number_dot(lamp->position, lamp->cone_axis);

	return cosine < lamp->cone_cosine ? 0 : powf(fmaxf(cosine, 0), lamp->cone_exponent);
}

static void lighting_lamp_place(struct accel_lamp *lamp, const struct accel_light *light)
{
	static const float ahead[3] = { 0, 0, 1 };

	lamp->point = light->position[3] != 0;
	lamp->spot = lamp->point && light->spot_cutoff <= 90;
	lamp->cone_exponent = light->spot_exponent;
	lamp->cone_cosine = cosf(light->spot_cutoff * (float)(3.14159265358979 / 180));
	for (int i = 0; i < 3; i++) {
		lamp->position[i] = light->position[i];
		if (lamp->point)
			lamp->position[i] /= light->position[3];
		lamp->attenuation[i] = light->attenuation[i];
		lamp->cone_axis[i] = light->spot_direction[i];
	}
	lighting_normalise(lamp->cone_axis);
	if (!lamp->point)
		lighting_normalise(lamp->position);
	for (int i = 0; i < 3; i++)
		lamp->half[i] = lamp->position[i] + ahead[i];
	lighting_normalise(lamp->half);
}

static void lighting_lamp_init(struct accel_lamp *lamp, const struct accel_state *state,
			       const struct accel_light *light, const struct accel_finish finish[2])
{
	float strength = 1;

	lighting_lamp_place(lamp, light);
	if (!lamp->point && light->spot_cutoff <= 90)
		strength = lighting_cone(lamp);
	lamp->shines = false;
	for (int side = 0; side < 2; side++) {
		const struct accel_material material = lighting_material(&finish[side], state,
									 side);

		lighting_product(lamp->ambient[side], light->ambient, material.ambient, strength);
		lighting_product(lamp->diffuse[side], light->diffuse, material.diffuse, strength);
		lighting_product(lamp->specular[side], light->specular, material.specular,
				 strength);
		lamp->shines |= lighting_brightest(lamp->specular[side]) > 0;
	}
}

/* The cosine at which @strength * cosine^n is @level; above 1 if it never is so bright. */
static float lighting_fall_cosine(float strength, float n, float level)
{
	if (strength <= level)
		return 2;
	return n > 0 ? (float)pow((double)(level / strength), 1 / (double)n) : 0;
}

static void lighting_paints(struct accel_finish *finish, enum accel_tracks tracks)
{
	finish->paints_ambient = tracks == ACCEL_TRACKS_AMBIENT ||
				 tracks == ACCEL_TRACKS_AMBIENT_DIFFUSE;
	finish->paints_diffuse = tracks == ACCEL_TRACKS_DIFFUSE ||
				 tracks == ACCEL_TRACKS_AMBIENT_DIFFUSE;
	finish->paints_specular = tracks == ACCEL_TRACKS_SPECULAR;
}

/* What is the same everywhere is the sum of the ambient light, @base so far, and the emission. */
static void lighting_same_everywhere(struct accel_finish *finish, const float emission[3],
				     enum accel_tracks tracks, bool painted)
{
	for (int i = 0; i < 3; i++) {
		const float ambient = finish->base[i];

		finish->plain[i] = 0;
		if (tracks == ACCEL_TRACKS_EMISSION) {
			finish->base[i] = 1;
			finish->plain[i] = ambient;
		} else if (finish->paints_ambient) {
			finish->plain[i] = emission[i];
		} else if (painted) {
			finish->base[i] = 0;
			finish->plain[i] = ambient + emission[i];
		}
	}
}

static void lighting_finish_init(struct accel_lighting *lighting, const struct accel_state *state,
				 int side, enum accel_tracks tracks, bool painted)
{
	struct accel_finish *finish = &lighting->finish[side];
	const struct accel_material of = lighting_material(finish, state, side), *material = &of;
	float diffuse[3] = { 0 }, specular[3] = { 0 };

	lighting_product(finish->base, state->ambient, material->ambient, 1);
	for (int i = 0; i < 3; i++) {
		finish->base[i] += painted ? 0 : material->emission[i];
		for (int j = 0; j < lighting->lamps; j++) {
			const struct accel_lamp *lamp = &lighting->lamp[j];

			if (!lamp->point)
				finish->base[i] += lamp->ambient[side][i];
			diffuse[i] += lamp->diffuse[side][i];
			specular[i] += lamp->specular[side][i];
		}
	}
	lighting_same_everywhere(finish, material->emission, tracks, painted);
	finish->alpha = fminf(fmaxf(material->diffuse[3], 0), 1);
	finish->shininess = material->shininess;
	finish->diffuse = lighting_brightest(diffuse);
	finish->specular = lighting_brightest(specular);
	finish->faint_cosine = lighting_fall_cosine(finish->specular, finish->shininess,
						    HIGHLIGHT_FAINT);
	finish->visible_cosine = lighting_fall_cosine(finish->specular, finish->shininess,
						      HIGHLIGHT_VISIBLE);
	finish->visible_sine = sqrtf(fmaxf(1 - finish->visible_cosine * finish->visible_cosine, 0));
}

void accel_lighting_init(struct accel_lighting *lighting, const struct accel_state *state,
			 bool painted)
{
	const enum accel_tracks tracks[2] = { painted ? state->tracks[0] : ACCEL_TRACKS_NONE,
					      painted ? state->tracks[1] : ACCEL_TRACKS_NONE };

	for (int side = 0; side < 2; side++)
		lighting_paints(&lighting->finish[side], tracks[side]);
	lighting->local_viewer = state->local_viewer;
	lighting->unit = state->normals == ACCEL_NORMALS_UNIT;
	lighting->cone_exponent = 0;
	lighting->lamps = 0;
	for (int i = 0; i < ACCEL_LIGHTS; i++) {
		struct accel_lamp *lamp = &lighting->lamp[lighting->lamps];

		if (!state->light[i].enabled)
			continue;
		lighting_lamp_init(lamp, state, &state->light[i], lighting->finish);
		lamp->bit = (uint8_t)(1 << i);
		if (lamp->spot)
			lighting->cone_exponent = fmaxf(lighting->cone_exponent,
							lamp->cone_exponent);
		lighting->lamps++;
	}
	lighting_finish_init(lighting, state, 0, tracks[0], painted);
	lighting_finish_init(lighting, state, 1, tracks[1], painted);
}

static void lighting_put(struct accel_light_batch *batch, int i, const float eye[3],
			 const float normal[3], float length, const float paint[4])
{
	batch->length[i] = length;
	for (int j = 0; j < 3; j++) {
		batch->eye[j][i] = eye[j];
		batch->normal[j][i] = normal[j];
	}
	for (int j = 0; j < 4; j++)
		batch->paint[j][i] = paint[j];
}

static void lighting_take(const struct accel_light_batch *batch, int i, struct accel_sample *sample)
{
	for (int j = 0; j < 4; j++)
		sample->colour[j] = batch->colour[j][i];
	sample->shine = batch->shine[i];
	sample->near = batch->near[i];
	sample->near_lamp = batch->near_lamp[i];
	sample->facing = (uint8_t)batch->facing[i];
	sample->in_cone = (uint8_t)batch->in_cone[i];
}

void accel_lighting_vertices(const struct accel_lighting *lighting, int side,
			     struct accel_vertex *const *vertex, int count)
{
	struct accel_light_batch batch;

	for (int i = 0; i < count; i++)
		lighting_put(&batch, i, vertex[i]->eye, vertex[i]->normal, vertex[i]->length,
			     vertex[i]->paint);
	accel_kernel()->light(lighting, side, &batch, count);
	for (int i = 0; i < count; i++)
		lighting_take(&batch, i, &vertex[i]->sample);
}

void accel_lighting_sample(const struct accel_lighting *lighting, int side, const float eye[3],
			   const float normal[3], const float paint[4], struct accel_sample *sample)
{
	struct accel_light_batch batch;

	lighting_put(&batch, 0, eye, normal, 1, paint);
	accel_kernel()->light(lighting, side, &batch, 1);
	lighting_take(&batch, 0, sample);
}

void accel_lighting_lamp(const struct accel_lighting *lighting, int side,
			 const struct accel_lamp *lamp, const struct accel_vertex *vertex,
			 float colour[3])
{
	struct accel_light_batch batch;

	lighting_put(&batch, 0, vertex->eye, vertex->normal, vertex->length, vertex->paint);
	accel_kernel()->light_lamp(lighting, lamp, side, &batch, 1);
	for (int i = 0; i < 3; i++)
		colour[i] = batch.colour[i][0];
}
