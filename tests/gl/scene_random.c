// SPDX-License-Identifier: MIT
#include "scene_random.h"

#include <math.h>

int scene_count(int usual)
{
	const char *given = getenv("GL_SCENES");
	int count = given ? atoi(given) : 0;

	return count > 0 ? count : usual;
}

static double unit(uint64_t *seed)
{
	return (double)(test_random(seed) >> 40) * 0x1p-24;
}

double scene_between(uint64_t *seed, double low, double high)
{
	return (double)(float)(low + (high - low) * unit(seed));
}

void scene_random_colour(uint64_t *seed, double most, double out[4])
{
	for (int i = 0; i < 4; i++)
		out[i] = scene_between(seed, 0, most);
}

void scene_random_direction(uint64_t *seed, double out[3])
{
	double length;

	do {
		for (int i = 0; i < 3; i++)
			out[i] = scene_between(seed, -1, 1);
		length = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
	} while (length > 1 || length < 0.01);
}

/* Turned around two axes, scaled, and away from the eye. */
static void random_modelview(uint64_t *seed, double away, double out[16])
{
	double a = scene_between(seed, 0, 6.3), b = scene_between(seed, 0, 6.3);
	const double turned[9] = { cos(b), sin(b) * sin(a),  -sin(b) * cos(a), 0, cos(a), sin(a),
				   sin(b), -cos(b) * sin(a), cos(b) * cos(a) };
	double scale = scene_between(seed, 0.5, 1.5);

	memset(out, 0, 16 * sizeof(*out));
	for (int column = 0; column < 3; column++) {
		double own = test_below(seed, 4) ? scale : scene_between(seed, 0.5, 1.5);

		for (int row = 0; row < 3; row++)
			out[4 * column + row] = (double)(float)(own * turned[3 * column + row]);
	}
	out[12] = scene_between(seed, -0.5, 0.5);
	out[13] = scene_between(seed, -0.5, 0.5);
	out[14] = -away;
	out[15] = 1;
}

/* Boxes and frusta whose near and far planes cut some of what is drawn. */
static void random_projection(uint64_t *seed, bool perspective, double out[16])
{
	double near = scene_between(seed, 1.5, 2.5), far = scene_between(seed, 3.5, 5), wide = 1.2;

	memset(out, 0, 16 * sizeof(*out));
	if (perspective) {
		out[0] = out[5] = (double)2.2f;
		out[10] = (double)(float)((far + near) / (near - far));
		out[11] = -1;
		out[14] = (double)(float)(2 * far * near / (near - far));
		return;
	}
	out[0] = out[5] = (double)(float)(1 / wide);
	out[10] = (double)(float)(2 / (near - far));
	out[14] = (double)(float)((far + near) / (near - far));
	out[15] = 1;
}

static void random_light(uint64_t *seed, struct oracle_light *light)
{
	bool point = test_below(seed, 2);

	light->enabled = true;
	scene_random_direction(seed, light->position);
	scene_random_colour(seed, 0.2, light->ambient);
	scene_random_colour(seed, 1, light->diffuse);
	scene_random_colour(seed, 1, light->specular);
	if (point) {
		for (int i = 0; i < 3; i++)
			light->position[i] = (double)(float)(3 * light->position[i]);
		light->position[3] = 1;
		light->attenuation[0] = scene_between(seed, 0.5, 1);
		light->attenuation[1] = scene_between(seed, 0, 0.5);
		light->attenuation[2] = scene_between(seed, 0, 0.2);
	}
	if (test_below(seed, 2))
		return;
	light->spot_cutoff = scene_between(seed, 20, 90);
	light->spot_exponent = scene_between(seed, 0, 20);
	/* About towards the middle of what is drawn. */
	for (int i = 0; i < 3; i++)
		light->spot_direction[i] = (double)(float)((i == 2 ? -3 : 0) - light->position[i]);
}

static void random_material(uint64_t *seed, struct oracle_material *material)
{
	scene_random_colour(seed, 0.2, material->emission);
	scene_random_colour(seed, 1, material->ambient);
	scene_random_colour(seed, 1, material->diffuse);
	scene_random_colour(seed, 1, material->specular);
	material->shininess = test_below(seed, 2) ? scene_between(seed, 1, 128) :
						    scene_between(seed, 1, 8);
}

/* COLOR_MATERIAL names one mode, for the front, the back or both. */
static void random_follow(uint64_t *seed, unsigned int follow[ORACLE_SIDES])
{
	static const unsigned int modes[] = { ORACLE_EMISSION, ORACLE_AMBIENT, ORACLE_DIFFUSE,
					      ORACLE_SPECULAR, ORACLE_AMBIENT | ORACLE_DIFFUSE };
	unsigned int mode = modes[test_below(seed, 5)];

	if (test_below(seed, 2))
		return;
	for (int i = 0; i < ORACLE_SIDES; i++)
		follow[i] = test_below(seed, 4) ? mode : 0;
}

/* Through about the middle of what is drawn. */
static void random_plane(uint64_t *seed, struct oracle_state *gl)
{
	uint32_t i = test_below(seed, ORACLE_PLANES);

	gl->planes |= 1u << i;
	scene_random_direction(seed, gl->plane[i]);
	gl->plane[i][3] = (double)(float)(3 * gl->plane[i][2] + scene_between(seed, -0.3, 0.5));
}

void scene_random_state(uint64_t *seed, bool perspective, struct oracle_state *gl)
{
	random_modelview(seed, 3, gl->modelview);
	random_projection(seed, perspective, gl->projection);
	gl->lighting = test_below(seed, 8);
	gl->local_viewer = test_below(seed, 2);
	gl->two_sided = test_below(seed, 2);
	gl->flat = !test_below(seed, 6);
	gl->cull = (enum oracle_cull)(test_below(seed, 4) ? 0 : 1 + test_below(seed, 2));
	gl->normals = (enum oracle_normals)test_below(seed, 3);
	gl->front_clockwise = test_below(seed, 2);
	random_follow(seed, gl->follow);
	for (uint32_t i = test_below(seed, 3) ? 0 : test_below(seed, 4); i; i--)
		random_plane(seed, gl);
	scene_random_colour(seed, 0.5, gl->ambient);
	for (int i = 0; i < ORACLE_SIDES; i++)
		random_material(seed, &gl->material[i]);
	for (uint32_t i = test_below(seed, 4); i < 4; i++)
		random_light(seed, &gl->light[test_below(seed, ORACLE_LIGHTS)]);
	if (!test_below(seed, 4)) {
		gl->viewport[0] = 10;
		gl->viewport[1] = 7;
		gl->viewport[2] = 61;
		gl->viewport[3] = 77;
	}
}
