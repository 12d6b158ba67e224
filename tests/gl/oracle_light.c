// SPDX-License-Identifier: MIT
/* Normals (2.10.3) and lighting (2.14.1), term by term as the specification has them. */
#include "oracle.h"

#include <math.h>
#include <string.h>

#define DEGREE (3.14159265358979323846 / 180)
/* Cosines nearer than this to where light begins may fall on either side in single precision. */
#define UNSURE 1e-5

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The specification's circled dot. */
static double facing(const double a[3], const double b[3])
{
	return fmax(dot(a, b), 0);
}

static void unit(double v[3])
{
	double length = sqrt(dot(v, v));

	for (int i = 0; i < 3 && length > 0; i++)
		v[i] /= length;
}

/* The inverse of the upper left 3x3 of a matrix, by columns; false: there is none. */
static bool inverse(const double m[16], double out[3][3])
{
	double determinant = 0;

	for (int row = 0; row < 3; row++)
		for (int column = 0; column < 3; column++) {
			int r1 = (column + 1) % 3, r2 = (column + 2) % 3;
			int c1 = (row + 1) % 3, c2 = (row + 2) % 3;

			out[column][row] = m[4 * c1 + r1] * m[4 * c2 + r2] -
					   m[4 * c1 + r2] * m[4 * c2 + r1];
		}
	for (int i = 0; i < 3; i++)
		determinant += m[i] * out[i][0];
	for (int i = 0; i < 9 && determinant != 0; i++)
		out[i / 3][i % 3] /= determinant;
	return determinant != 0;
}

void oracle_normal(const struct oracle_state *state, const double normal[3], double out[3])
{
	double m[3][3], scale = 1;

	memcpy(out, normal, 3 * sizeof(*out));
	if (inverse(state->modelview, m)) {
		/* A row vector times the inverse; its last row is what rescaling looks at. */
		for (int i = 0; i < 3; i++)
			out[i] = dot(normal, m[i]);
		if (state->normals == ORACLE_RESCALED)
			scale = 1 / sqrt(m[0][2] * m[0][2] + m[1][2] * m[1][2] + m[2][2] * m[2][2]);
	}
	for (int i = 0; i < 3; i++)
		out[i] *= scale;
	if (state->normals == ORACLE_NORMALISED)
		unit(out);
}

/* The unit vector from a point to another, either of which may be at infinity; returns how far. */
static double towards(const double from[4], const double to[4], double out[3])
{
	double length;

	for (int i = 0; i < 3; i++) {
		if (to[3] == 0 && from[3] != 0)
			out[i] = to[i];
		else if (from[3] == 0 && to[3] != 0)
			out[i] = -from[i];
		else if (from[3] == 0)
			out[i] = to[i] - from[i];
		else
			out[i] = to[i] / to[3] - from[i] / from[3];
	}
	length = sqrt(dot(out, out));
	unit(out);
	return length;
}

static double attenuation(const struct oracle_light *light, double distance)
{
	const double *k = light->attenuation;

	return light->position[3] != 0 ? 1 / (k[0] + k[1] * distance + k[2] * distance * distance) :
					 1;
}

/* @to_light: from the vertex. */
static double spot(const struct oracle_light *light, const double to_light[3], bool *doubt)
{
	double from[3], axis[3], cosine, rim = cos(light->spot_cutoff * DEGREE);

	if (light->spot_cutoff == 180)
		return 1;
	for (int i = 0; i < 3; i++) {
		from[i] = -to_light[i];
		axis[i] = light->spot_direction[i];
	}
	unit(axis);
	cosine = facing(from, axis);
	*doubt |= fabs(cosine - rim) < UNSURE;
	return cosine >= rim ? pow(cosine, light->spot_exponent) : 0;
}

/* The half vector between the ways to the light and to the viewer. */
static void half(const struct oracle_state *state, const double eye[4], const double to_light[3],
		 double out[3])
{
	static const double origin[4] = { 0, 0, 0, 1 };
	double viewer[3] = { 0, 0, 1 };

	if (state->local_viewer)
		towards(eye, origin, viewer);
	for (int i = 0; i < 3; i++)
		out[i] = to_light[i] + viewer[i];
	unit(out);
}

static bool light_add(const struct oracle_state *state, const struct oracle_material *material,
		      const struct oracle_light *light, const double eye[4], const double normal[3],
		      double colour[2][4])
{
	double to_light[3], h[3], strength, diffuse, specular;
	bool doubt = false;

	strength = attenuation(light, towards(eye, light->position, to_light));
	strength *= spot(light, to_light, &doubt);
	diffuse = facing(normal, to_light);
	doubt |= fabs(dot(normal, to_light)) < UNSURE;
	half(state, eye, to_light, h);
	specular = diffuse != 0 ? pow(facing(normal, h), material->shininess) : 0;
	for (int i = 0; i < 3; i++) {
		colour[0][i] += strength * (material->ambient[i] * light->ambient[i] +
					    diffuse * material->diffuse[i] * light->diffuse[i]);
		colour[state->separate_specular][i] += strength * specular * material->specular[i] *
						       light->specular[i];
	}
	return doubt;
}

/* COLOR_MATERIAL (2.14.3). */
static struct oracle_material material_of(const struct oracle_state *state, enum oracle_side side,
					  const double current[4])
{
	struct oracle_material material = state->material[side];
	double *part[4] = { material.emission, material.ambient, material.diffuse,
			    material.specular };

	for (int i = 0; i < 4; i++)
		if (state->follow[side] >> i & 1)
			memcpy(part[i], current, 4 * sizeof(*current));
	return material;
}

bool oracle_light(const struct oracle_state *state, enum oracle_side side, const double eye[4],
		  const double normal[3], const double current[4], double colour[2][4])
{
	const struct oracle_material material = material_of(state, side, current);
	double n[3];
	bool doubt = false;

	/* Two-sided light (2.14.1): the back is lit with the normal reversed. */
	for (int i = 0; i < 3; i++)
		n[i] = side == ORACLE_BACK ? -normal[i] : normal[i];
	memset(colour, 0, 2 * sizeof(*colour));
	for (int i = 0; i < 3; i++)
		colour[0][i] = material.emission[i] + material.ambient[i] * state->ambient[i];
	for (int i = 0; i < ORACLE_LIGHTS; i++)
		if (state->light[i].enabled)
			doubt |= light_add(state, &material, &state->light[i], eye, n, colour);
	colour[0][3] = material.diffuse[3];
	return doubt;
}
