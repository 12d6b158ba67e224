// SPDX-License-Identifier: MIT
/* Maps and grids: what glMap and glMapGrid are given, and what glGetMap tells. */
#include "draw/evaluator.h"

#include <string.h>

#include "state/command.h"
#include "state/get.h"

unsigned int gloss_map_components(unsigned int kind)
{
	static const unsigned char components[GLOSS_MAP_KINDS] = { 4, 1, 3, 1, 2, 3, 4, 3, 4 };

	return components[kind];
}

static void evaluator_init(struct gloss_map *map, unsigned int kind)
{
	static const GLfloat initial[GLOSS_MAP_KINDS][4] = {
		{ 1, 1, 1, 1 }, { 1 },          { 0, 0, 1 }, { 0 },          { 0, 0 },
		{ 0, 0, 0 },    { 0, 0, 0, 1 }, { 0, 0, 0 }, { 0, 0, 0, 1 },
	};

	*map = (struct gloss_map){ .order = { 1, 1 }, .domain = { { 0, 1 }, { 0, 1 } } };
	memcpy(map->point, initial[kind], sizeof(initial[kind]));
}

void gloss_maps_init(struct gloss_maps *maps)
{
	for (unsigned int kind = 0; kind < GLOSS_MAP_KINDS; kind++) {
		evaluator_init(&maps->one[kind], kind);
		evaluator_init(&maps->two[kind], kind);
	}
}

/* The map of a target; NULL: it is none. */
static struct gloss_map *evaluator_find(struct gloss_context *context, GLenum target,
					unsigned int *kind, unsigned int *coordinates)
{
	*coordinates = 1;
	*kind = target - GL_MAP1_COLOR_4;
	if (*kind < GLOSS_MAP_KINDS)
		return &context->evaluators.one[*kind];
	*coordinates = 2;
	*kind = target - GL_MAP2_COLOR_4;
	if (*kind < GLOSS_MAP_KINDS)
		return &context->evaluators.two[*kind];
	return NULL;
}

/* A map as it is given, with what is wrong with it. */
struct evaluator_given {
	GLenum target, error;
	struct gloss_map map;
};

GLOSS_LISTED1(MapPoints, struct evaluator_given, given)
{
	unsigned int kind, coordinates;
	struct gloss_map *map = evaluator_find(context, given.target, &kind, &coordinates);

	if (given.error)
		gloss_error(context, given.error);
	else if (context->attributes.texturing.active)
		gloss_error(context, GL_INVALID_OPERATION);
	else if (map)
		*map = given.map;
}

/* Where control points are in a program's memory, floats or doubles. */
struct evaluator_source {
	const GLfloat *floats;
	const GLdouble *doubles;
	GLint stride[2];
};

static GLfloat evaluator_number(const struct evaluator_source *source, size_t i)
{
	return source->floats ? source->floats[i] : (GLfloat)source->doubles[i];
}

static void evaluator_copy(struct gloss_map *map, unsigned int components,
			   const struct evaluator_source *source)
{
	GLfloat *to = map->point;

	for (GLint u = 0; u < map->order[0]; u++)
		for (GLint v = 0; v < map->order[1]; v++)
			for (size_t i = 0; i < components; i++)
				*to++ = evaluator_number(
					source, (size_t)u * (size_t)source->stride[0] +
							(size_t)v * (size_t)source->stride[1] + i);
}

static GLenum evaluator_error(const struct gloss_map *map, unsigned int components,
			      unsigned int coordinates, const struct evaluator_source *source)
{
	for (unsigned int i = 0; i < coordinates; i++)
		if (map->order[i] < 1 || map->order[i] > GLOSS_MAP_ORDER ||
		    source->stride[i] < (GLint)components || map->domain[i][0] == map->domain[i][1])
			return GL_INVALID_VALUE;
	return GL_NO_ERROR;
}

static void evaluator_give(struct evaluator_given *given, unsigned int coordinates,
			   const struct evaluator_source *source)
{
	const GLuint first = coordinates == 1 ? GL_MAP1_COLOR_4 : GL_MAP2_COLOR_4;
	const unsigned int kind = given->target - first;

	if (kind >= GLOSS_MAP_KINDS)
		given->error = GL_INVALID_ENUM;
	else
		given->error = evaluator_error(&given->map, gloss_map_components(kind), coordinates,
					       source);
	if (!given->error)
		evaluator_copy(&given->map, gloss_map_components(kind), source);
	gl_MapPoints(*given);
}

void gl_Map1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order,
	      const GLfloat *points)
{
	struct evaluator_given given = { .target = target,
					 .map = { { order, 1 }, { { u1, u2 }, { 0, 1 } }, { 0 } } };
	const struct evaluator_source source = { .floats = points, .stride = { stride, 0 } };

	evaluator_give(&given, 1, &source);
}

void gl_Map1d(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
	      const GLdouble *points)
{
	struct evaluator_given given = {
		.target = target,
		.map = { { order, 1 }, { { (GLfloat)u1, (GLfloat)u2 }, { 0, 1 } }, { 0 } }
	};
	const struct evaluator_source source = { .doubles = points, .stride = { stride, 0 } };

	evaluator_give(&given, 1, &source);
}

void gl_Map2f(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1,
	      GLfloat v2, GLint vstride, GLint vorder, const GLfloat *points)
{
	struct evaluator_given given = {
		.target = target, .map = { { uorder, vorder }, { { u1, u2 }, { v1, v2 } }, { 0 } }
	};
	const struct evaluator_source source = { .floats = points, .stride = { ustride, vstride } };

	evaluator_give(&given, 2, &source);
}

void gl_Map2d(GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
	      GLdouble v2, GLint vstride, GLint vorder, const GLdouble *points)
{
	struct evaluator_given given = { .target = target,
					 .map = { { uorder, vorder },
						  { { (GLfloat)u1, (GLfloat)u2 },
						    { (GLfloat)v1, (GLfloat)v2 } },
						  { 0 } } };
	const struct evaluator_source source = { .doubles = points,
						 .stride = { ustride, vstride } };

	evaluator_give(&given, 2, &source);
}

/* ---- grids ---- */

GLOSS_LISTED3(MapGrid1f, GLint, un, GLfloat, u1, GLfloat, u2)
{
	struct gloss_evaluating *evaluating = &context->attributes.evaluating;
	const GLfloat domain[2] = { u1, u2 };

	if (un < 1) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	evaluating->segments1 = un;
	memcpy(evaluating->grid1, domain, sizeof(domain));
}

void gl_MapGrid1d(GLint un, GLdouble u1, GLdouble u2)
{
	gl_MapGrid1f(un, (GLfloat)u1, (GLfloat)u2);
}

GLOSS_LISTED6(MapGrid2f, GLint, un, GLfloat, u1, GLfloat, u2, GLint, vn, GLfloat, v1, GLfloat, v2)
{
	struct gloss_evaluating *evaluating = &context->attributes.evaluating;
	const GLfloat domain[4] = { u1, u2, v1, v2 };

	if (un < 1 || vn < 1) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	evaluating->segments2[0] = un;
	evaluating->segments2[1] = vn;
	memcpy(evaluating->grid2, domain, sizeof(domain));
}

void gl_MapGrid2d(GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2)
{
	gl_MapGrid2f(un, (GLfloat)u1, (GLfloat)u2, vn, (GLfloat)v1, (GLfloat)v2);
}

/* ---- what is asked ---- */

/* The numbers of a query about a map, and how many; NULL: there is an error. */
static const GLfloat *evaluator_get(GLenum target, GLenum query, GLfloat order[2],
				    unsigned int *count)
{
	struct gloss_context *context = gloss_outside();
	unsigned int kind, coordinates;
	const struct gloss_map *map;

	if (!context)
		return NULL;
	map = evaluator_find(context, target, &kind, &coordinates);
	*count = coordinates;
	if (map && query == GL_ORDER) {
		order[0] = (GLfloat)map->order[0];
		order[1] = (GLfloat)map->order[1];
		return order;
	}
	if (map && query == GL_DOMAIN) {
		*count = 2 * coordinates;
		return map->domain[0];
	}
	if (map && query == GL_COEFF) {
		*count = gloss_map_components(kind) * (unsigned int)(map->order[0] * map->order[1]);
		return map->point;
	}
	gloss_error(context, GL_INVALID_ENUM);
	return NULL;
}

void gl_GetMapfv(GLenum target, GLenum query, GLfloat *v)
{
	GLfloat order[2];
	unsigned int count;
	const GLfloat *from = evaluator_get(target, query, order, &count);

	for (unsigned int i = 0; from && i < count; i++)
		v[i] = from[i];
}

void gl_GetMapdv(GLenum target, GLenum query, GLdouble *v)
{
	GLfloat order[2];
	unsigned int count;
	const GLfloat *from = evaluator_get(target, query, order, &count);

	for (unsigned int i = 0; from && i < count; i++)
		v[i] = (GLdouble)from[i];
}

void gl_GetMapiv(GLenum target, GLenum query, GLint *v)
{
	GLfloat order[2];
	unsigned int count;
	const GLfloat *from = evaluator_get(target, query, order, &count);

	for (unsigned int i = 0; from && i < count; i++)
		v[i] = gloss_get_integer(GLOSS_FLOAT, (double)from[i]);
}
