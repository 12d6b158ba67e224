// SPDX-License-Identifier: MIT
/* From vertices to a picture. */
#include "oracle.h"

#include <math.h>
#include <string.h>

static const double identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

static void four(double out[4], double rgb)
{
	out[0] = out[1] = out[2] = rgb;
	out[3] = 1;
}

static void light_init(struct oracle_light *light, double first)
{
	four(light->ambient, 0);
	four(light->diffuse, first);
	four(light->specular, first);
	light->position[2] = 1;
	light->attenuation[0] = 1;
	light->spot_direction[2] = -1;
	light->spot_cutoff = 180;
}

void oracle_state_init(struct oracle_state *state, int width, int height)
{
	memset(state, 0, sizeof(*state));
	memcpy(state->modelview, identity, sizeof(identity));
	memcpy(state->projection, identity, sizeof(identity));
	state->viewport[2] = width;
	state->viewport[3] = height;
	state->far = 1;
	state->point_size = state->line_width = state->point_attenuation[0] = 1;
	state->point_most = 64;
	four(state->ambient, 0.2);
	for (int side = 0; side < ORACLE_SIDES; side++) {
		four(state->material[side].emission, 0);
		four(state->material[side].ambient, 0.2);
		four(state->material[side].diffuse, 0.8);
		four(state->material[side].specular, 0);
	}
	for (int i = 0; i < ORACLE_LIGHTS; i++)
		light_init(&state->light[i], i == 0);
}

static void multiply(const double m[16], const double v[4], double out[4])
{
	for (int row = 0; row < 4; row++) {
		out[row] = 0;
		for (int i = 0; i < 4; i++)
			out[row] += m[4 * i + row] * v[i];
	}
}

static void limit(double colour[2][4])
{
	for (int i = 0; i < 8; i++)
		colour[i / 4][i % 4] = fmin(fmax(colour[i / 4][i % 4], 0), 1);
}

bool oracle_transform(const struct oracle_state *state, const struct oracle_vertex *vertex,
		      struct oracle_corner *corner)
{
	bool doubt = false;

	memset(corner, 0, sizeof(*corner));
	multiply(state->modelview, vertex->position, corner->eye);
	multiply(state->projection, corner->eye, corner->clip);
	oracle_normal(state, vertex->normal, corner->normal);
	corner->length = sqrt(corner->normal[0] * corner->normal[0] +
			      corner->normal[1] * corner->normal[1] +
			      corner->normal[2] * corner->normal[2]);
	memcpy(corner->current, vertex->colour, sizeof(corner->current));
	for (int side = 0; side < ORACLE_SIDES; side++) {
		if (state->lighting)
			doubt |= oracle_light(state, side, corner->eye, corner->normal,
					      vertex->colour, corner->colour[side]);
		else
			memcpy(corner->colour[side][0], vertex->colour, sizeof(vertex->colour));
		limit(corner->colour[side]);
	}
	return doubt;
}

static bool finite4(const double v[4])
{
	return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]) && isfinite(v[3]);
}

/* A primitive with a vertex that is nowhere is not drawn: OpenGL leaves open what it would be. */
static void draw_primitive(const struct oracle_state *state, const struct oracle_vertex *vertex,
			   const struct oracle_primitive *primitive, int *stippled,
			   struct oracle_picture *picture)
{
	struct oracle_corner polygon[ORACLE_CORNERS], provoking;
	bool doubt = oracle_transform(state, &vertex[primitive->provoking], &provoking), cut;
	int corners;

	for (int i = 0; i < primitive->corners; i++) {
		doubt |= oracle_transform(state, &vertex[primitive->vertex[i]], &polygon[i]);
		if (!finite4(polygon[i].clip))
			return;
		/* Flat (2.14.7): before clipping, so that new corners have the colour too. */
		if (state->flat)
			memcpy(polygon[i].colour, provoking.colour, sizeof(provoking.colour));
	}
	picture->doubtful |= doubt;
	if (primitive->corners == 1) {
		oracle_point(state, polygon, picture);
	} else if (primitive->corners == 2) {
		oracle_line(state, polygon, stippled, picture);
	} else {
		corners = oracle_clip(state, polygon, primitive->corners, &cut);
		oracle_polygon(state, polygon, corners, cut, picture);
	}
}

void oracle_draw(const struct oracle_state *state, enum oracle_topology topology,
		 const struct oracle_vertex *vertex, int vertices, struct oracle_picture *picture)
{
	struct oracle_primitive primitive;
	int stippled = 0;

	for (int n = 0; oracle_assemble(topology, vertices, n, &primitive); n++) {
		if (topology == ORACLE_LINES)
			stippled = 0;
		draw_primitive(state, vertex, &primitive, &stippled, picture);
	}
}
