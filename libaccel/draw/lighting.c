// SPDX-License-Identifier: MIT
/*
 * OpenGL's fixed-function lighting (specification 1.5, section 2.14.1) at a point of a surface, in
 * eye space. The highlight is Blinn's: by the half vector between viewer and light.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "draw/draw_priv.h"

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

static void lighting_product(float out[3], const float a[4], const float b[4])
{
	for (int i = 0; i < 3; i++)
		out[i] = a[i] * b[i];
}

static float lighting_brightest(const float rgb[3])
{
	return fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
}

/* log2 of a normal number: exponent, and the series of atanh on the rest, sqrt(1/2) to sqrt(2). */
static float lighting_log2_of(float x)
{
	uint32_t bits;
	int exponent;
	float t, t2;

	memcpy(&bits, &x, sizeof(bits));
	exponent = (int32_t)(bits - 0x3f3504f3) >> 23;
	bits -= (uint32_t)exponent << 23;
	memcpy(&x, &bits, sizeof(x));
	t = (x - 1) / (x + 1);
	t2 = t * t;
	return (float)exponent +
	       t * (2.885390082f + t2 * (0.961796694f + t2 * (0.577078016f + t2 * 0.412198583f)));
}

/* 2^y for -126 <= y <= 0: the exponent, and Taylor's series on the rest, -1/2 to 1/2. */
static float lighting_exp2_of(float y)
{
	int whole = (int)(y - 0.5f);
	float f = y - (float)whole;
	uint32_t bits = (uint32_t)(whole + 127) << 23;
	float scale;

	memcpy(&scale, &bits, sizeof(scale));
	return scale *
	       (1 +
		f * (0.693147181f +
		     f * (0.240226507f +
			  f * (0.0555041087f + f * (0.00961812911f +
						    f * (0.00133335581f + f * 0.000154035304f))))));
}

/* The C library's powf is exact to the last bit, slower, and not the same in all of them. */
float accel_lighting_power(float x, float n)
{
	float y;

	if (n == 0)
		return 1;
	if (!(x >= 0x1p-126f))
		return 0;
	y = n * lighting_log2_of(x);
	if (!(y > -126))
		return 0;
	return y < 0 ? lighting_exp2_of(y) : 1;
}

static const float white[4] = { 1, 1, 1, 1 };

static void lighting_lamp_init(struct accel_lamp *lamp, const struct accel_state *state,
			       const struct accel_light *light, bool painted)
{
	static const float ahead[3] = { 0, 0, 1 };

	lamp->point = light->position[3] != 0;
	lamp->spot = lamp->point && light->spot_cutoff <= 90;
	lamp->shines = false;
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
	for (int side = 0; side < 2; side++) {
		const struct accel_material *material = &state->material[side];

		lighting_product(lamp->ambient[side], light->ambient,
				 painted ? white : material->ambient);
		lighting_product(lamp->diffuse[side], light->diffuse,
				 painted ? white : material->diffuse);
		lighting_product(lamp->specular[side], light->specular, material->specular);
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

static void lighting_finish_init(struct accel_lighting *lighting, const struct accel_state *state,
				 int side, bool painted)
{
	const struct accel_material *material = &state->material[side];
	struct accel_finish *finish = &lighting->finish[side];
	float diffuse[3] = { 0 }, specular[3] = { 0 };

	lighting_product(finish->base, state->ambient, painted ? white : material->ambient);
	for (int i = 0; i < 3; i++) {
		finish->emission[i] = painted ? material->emission[i] : 0;
		finish->base[i] += painted ? 0 : material->emission[i];
		for (int j = 0; j < lighting->lamps; j++) {
			const struct accel_lamp *lamp = &lighting->lamp[j];

			if (!lamp->point)
				finish->base[i] += lamp->ambient[side][i];
			diffuse[i] += lamp->diffuse[side][i];
			specular[i] += lamp->specular[side][i];
		}
	}
	finish->alpha = painted ? 1 : fminf(fmaxf(material->diffuse[3], 0), 1);
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
	lighting->local_viewer = state->local_viewer;
	lighting->cone_exponent = 0;
	lighting->lamps = 0;
	for (int i = 0; i < ACCEL_LIGHTS; i++) {
		struct accel_lamp *lamp = &lighting->lamp[lighting->lamps];

		if (!state->light[i].enabled)
			continue;
		lighting_lamp_init(lamp, state, &state->light[i], painted);
		lamp->bit = (uint8_t)(1 << i);
		if (lamp->spot)
			lighting->cone_exponent = fmaxf(lighting->cone_exponent,
							lamp->cone_exponent);
		lighting->lamps++;
	}
	lighting_finish_init(lighting, state, 0, painted);
	lighting_finish_init(lighting, state, 1, painted);
}

/* A point of a surface and the directions there, all of unit length. */
struct point {
	const float *eye, *paint;
	float normal[3], viewer[3];
};

/* The direction towards a lamp that is a point; returns how much of its light arrives. */
static float lighting_reach(const struct accel_lamp *lamp, const float eye[3], float to[3],
			    struct accel_sample *sample)
{
	float distance, near, cosine, factor;

	for (int i = 0; i < 3; i++)
		to[i] = lamp->position[i] - eye[i];
	distance = lighting_normalise(to);
	near = 1 / (distance * distance);
	if (near > sample->near_lamp)
		sample->near_lamp = near;
	/* In the lamp itself there may be no attenuation; what is dark stays so there too. */
	factor = fminf(1 / (lamp->attenuation[0] +
			    distance * (lamp->attenuation[1] + distance * lamp->attenuation[2])),
		       FLT_MAX);
	if (!lamp->spot)
		return factor;
	cosine = -number_dot(to, lamp->cone_axis);
	if (cosine < lamp->cone_cosine)
		return 0;
	sample->in_cone |= lamp->bit;
	return factor * accel_lighting_power(cosine, lamp->cone_exponent);
}

static float lighting_half_cosine(const struct accel_lighting *lighting,
				  const struct accel_lamp *lamp, const struct point *point,
				  const float to[3])
{
	float half[3];

	if (!lamp->point && !lighting->local_viewer)
		return number_dot(point->normal, lamp->half);
	for (int i = 0; i < 3; i++)
		half[i] = to[i] + point->viewer[i];
	lighting_normalise(half);
	return number_dot(point->normal, half);
}

static void lighting_add_lamp(const struct accel_lighting *lighting, const struct accel_lamp *lamp,
			      int side, const struct point *point, struct accel_sample *sample)
{
	const struct accel_finish *finish = &lighting->finish[side];
	float away[3], cosine, shine, highlight = 0, factor = 1;
	const float *to = lamp->position;

	if (lamp->point) {
		factor = lighting_reach(lamp, point->eye, away, sample);
		to = away;
		for (int i = 0; i < 3; i++)
			sample->colour[i] += factor * lamp->ambient[side][i] * point->paint[i];
	}
	cosine = number_dot(point->normal, to);
	if (lamp->shines) {
		shine = lighting_half_cosine(lighting, lamp, point, to);
		if (shine > sample->shine)
			sample->shine = shine;
		if (cosine > 0 && (shine > finish->faint_cosine || finish->shininess == 0))
			highlight = factor * accel_lighting_power(shine, finish->shininess);
	}
	if (!(cosine > 0))
		return;
	sample->facing |= lamp->bit;
	cosine *= factor;
	for (int i = 0; i < 3; i++)
		sample->colour[i] += cosine * lamp->diffuse[side][i] * point->paint[i] +
				     highlight * lamp->specular[side][i];
}

/* Returns 1/distance^2 of the viewer, 0 if it is far away. */
static float lighting_point_init(const struct accel_lighting *lighting, int side,
				 const float eye[3], const float normal[3], const float paint[4],
				 struct point *point)
{
	float sign = side ? -1 : 1, distance;

	*point = (struct point){ .eye = eye, .paint = paint, .viewer = { 0, 0, 1 } };
	for (int i = 0; i < 3; i++)
		point->normal[i] = sign * normal[i];
	lighting_normalise(point->normal);
	if (!lighting->local_viewer)
		return 0;
	for (int i = 0; i < 3; i++)
		point->viewer[i] = -eye[i];
	distance = lighting_normalise(point->viewer);
	return 1 / (distance * distance);
}

static void lighting_clamp_colour(float colour[3])
{
	for (int i = 0; i < 3; i++) {
		/* Also turns what is not a number into 0. */
		float value = colour[i] > 0 ? colour[i] : 0;

		colour[i] = value < ACCEL_COLOUR_MAX ? value : ACCEL_COLOUR_MAX;
	}
}

void accel_lighting_sample(const struct accel_lighting *lighting, int side, const float eye[3],
			   const float normal[3], const float paint[4], struct accel_sample *sample)
{
	const struct accel_finish *finish = &lighting->finish[side];
	struct point point;

	*sample = (struct accel_sample){ .shine = -1 };
	sample->near = lighting_point_init(lighting, side, eye, normal, paint, &point);
	for (int i = 0; i < 3; i++)
		sample->colour[i] = finish->base[i] * paint[i] + finish->emission[i];
	for (int i = 0; i < lighting->lamps; i++)
		lighting_add_lamp(lighting, &lighting->lamp[i], side, &point, sample);
	sample->near = sample->near_lamp > sample->near ? sample->near_lamp : sample->near;
	lighting_clamp_colour(sample->colour);
	sample->colour[3] = finish->alpha * paint[3];
}

void accel_lighting_lamp(const struct accel_lighting *lighting, int side,
			 const struct accel_lamp *lamp, const float eye[3], const float normal[3],
			 const float paint[4], float colour[3])
{
	struct accel_sample sample = { .shine = -1 };
	struct point point;

	lighting_point_init(lighting, side, eye, normal, paint, &point);
	lighting_add_lamp(lighting, lamp, side, &point, &sample);
	lighting_clamp_colour(sample.colour);
	for (int i = 0; i < 3; i++)
		colour[i] = sample.colour[i];
}
