// SPDX-License-Identifier: MIT
/* Vertices that maps make: glEvalCoord, glEvalPoint, glEvalMesh. */
#include <math.h>
#include <string.h>

#include "draw/batch.h"
#include "draw/evaluator.h"
#include "state/command.h"

/* ---- polynomials ---- */

/* Bernstein's polynomials of one degree less than @order at @t, and their slopes. */
static void evaluate_basis(double t, GLint order, double basis[GLOSS_MAP_ORDER],
			   double slope[GLOSS_MAP_ORDER])
{
	for (GLint i = 0; i < order; i++)
		basis[i] = slope[i] = 0;
	basis[0] = 1;
	for (GLint degree = 1; degree < order; degree++)
		for (GLint i = degree; i >= 0; i--) {
			const double below = i ? basis[i - 1] : 0;

			/* Those of the degree before give the slopes of this one. */
			slope[i] = degree * (below - basis[i]);
			basis[i] = (1 - t) * basis[i] + t * below;
		}
}

void gloss_map_evaluate(const struct gloss_map *map, unsigned int components, const GLfloat at[2],
			GLfloat *value, GLfloat (*slope)[4])
{
	double basis[2][GLOSS_MAP_ORDER], slopes[2][GLOSS_MAP_ORDER], sum[3][4] = { { 0 } };
	const GLfloat *point = map->point;

	for (int i = 0; i < 2; i++) {
		const double first = (double)map->domain[i][0], end = (double)map->domain[i][1];

		evaluate_basis(((double)at[i] - first) / (end - first), map->order[i], basis[i],
			       slopes[i]);
	}
	for (GLint u = 0; u < map->order[0]; u++)
		for (GLint v = 0; v < map->order[1]; v++)
			for (unsigned int i = 0; i < components; i++, point++) {
				sum[0][i] += basis[0][u] * basis[1][v] * (double)*point;
				sum[1][i] += slopes[0][u] * basis[1][v] * (double)*point;
				sum[2][i] += basis[0][u] * slopes[1][v] * (double)*point;
			}
	for (unsigned int i = 0; i < components; i++)
		value[i] = (GLfloat)sum[0][i];
	for (unsigned int i = 0; slope && i < components; i++) {
		slope[0][i] = (GLfloat)sum[1][i];
		slope[1][i] = (GLfloat)sum[2][i];
	}
}

/* ---- vertices ---- */

enum {
	MAP_COLOUR = GL_MAP1_COLOR_4 - GL_MAP1_COLOR_4,
	MAP_NORMAL = GL_MAP1_NORMAL - GL_MAP1_COLOR_4,
	MAP_VERTEX_3 = GL_MAP1_VERTEX_3 - GL_MAP1_COLOR_4,
	MAP_VERTEX_4 = GL_MAP1_VERTEX_4 - GL_MAP1_COLOR_4,
};

/* The direction in which a surface looks, of its slopes; with w, of the surface that is seen. */
static void evaluate_normal(const GLfloat position[4], const GLfloat slope[2][4], bool w,
			    GLfloat normal[3])
{
	GLfloat along[2][3], length = 0;

	for (int i = 0; i < 2; i++)
		for (int j = 0; j < 3; j++)
			along[i][j] = w ? slope[i][j] * position[3] - position[j] * slope[i][3] :
					  slope[i][j];
	for (int i = 0; i < 3; i++) {
		const int j = (i + 1) % 3, k = (i + 2) % 3;

		normal[i] = along[0][j] * along[1][k] - along[0][k] * along[1][j];
		length += normal[i] * normal[i];
	}
	for (int i = 0; i < 3 && length > 0; i++)
		normal[i] /= sqrtf(length);
}

/* The maps of as many coordinates, and which are enabled. */
struct evaluate {
	const struct gloss_map *map;
	const GLboolean *enabled;
	bool normals; /* that are made of the surface */
};

/* The position, and a normal where it makes one. */
static void evaluate_position(const struct evaluate *with, const GLfloat at[2],
			      struct gloss_vertex *vertex)
{
	const bool four = with->enabled[MAP_VERTEX_4];
	const unsigned int kind = four ? MAP_VERTEX_4 : MAP_VERTEX_3;
	GLfloat slope[2][4] = { { 0 } };

	vertex->position[3] = 1;
	gloss_map_evaluate(&with->map[kind], gloss_map_components(kind), at, vertex->position,
			   slope);
	if (with->normals)
		evaluate_normal(vertex->position, (const GLfloat(*)[4])slope, four, vertex->normal);
}

/* A vertex of what is being drawn. What is not mapped is current, and stays so. */
static void evaluate(struct gloss_context *context, unsigned int coordinates, const GLfloat at[2])
{
	const struct gloss_evaluating *evaluating = &context->attributes.evaluating;
	const struct evaluate with = {
		.map = coordinates == 1 ? context->evaluators.one : context->evaluators.two,
		.enabled = coordinates == 1 ? evaluating->map1 : evaluating->map2,
		.normals = coordinates == 2 && evaluating->auto_normal,
	};
	struct gloss_vertices *vertices = &context->immediate;
	struct gloss_vertex vertex = context->attributes.current.vertex;

	if (!vertices->inside || (!with.enabled[MAP_VERTEX_3] && !with.enabled[MAP_VERTEX_4]))
		return;
	if (!gloss_vertices_reserve(vertices, 1))
		return;
	if (with.enabled[MAP_COLOUR])
		gloss_map_evaluate(&with.map[MAP_COLOUR], 4, at, vertex.colour, NULL);
	if (with.enabled[MAP_NORMAL])
		gloss_map_evaluate(&with.map[MAP_NORMAL], 3, at, vertex.normal, NULL);
	evaluate_position(&with, at, &vertex);
	vertices->vertex[vertices->vertices++] = vertex;
}

GLOSS_LISTED_INSIDE3(EvalCoord, GLuint, coordinates, GLfloat, u, GLfloat, v)
{
	const GLfloat at[2] = { u, v };

	evaluate(context, coordinates, at);
}

void gl_EvalCoord1f(GLfloat u)
{
	gl_EvalCoord(1, u, 0);
}

void gl_EvalCoord2f(GLfloat u, GLfloat v)
{
	gl_EvalCoord(2, u, v);
}

void gl_EvalCoord1d(GLdouble u)
{
	gl_EvalCoord1f((GLfloat)u);
}

void gl_EvalCoord1dv(const GLdouble *u)
{
	gl_EvalCoord1f((GLfloat)u[0]);
}

void gl_EvalCoord1fv(const GLfloat *u)
{
	gl_EvalCoord1f(u[0]);
}

void gl_EvalCoord2d(GLdouble u, GLdouble v)
{
	gl_EvalCoord2f((GLfloat)u, (GLfloat)v);
}

void gl_EvalCoord2dv(const GLdouble *u)
{
	gl_EvalCoord2f((GLfloat)u[0], (GLfloat)u[1]);
}

void gl_EvalCoord2fv(const GLfloat *u)
{
	gl_EvalCoord2f(u[0], u[1]);
}

/* ---- grids ---- */

/* Point @i of a grid; its ends are exact. */
static GLfloat evaluate_grid(const GLfloat domain[2], GLint segments, GLint i)
{
	if (i == segments)
		return domain[1];
	return domain[0] + (GLfloat)i * ((domain[1] - domain[0]) / (GLfloat)segments);
}

static void evaluate_point(struct gloss_context *context, GLuint coordinates, GLint i, GLint j)
{
	const struct gloss_evaluating *evaluating = &context->attributes.evaluating;
	const GLint *segments = evaluating->segments2;
	GLfloat at[2] = { 0 };

	if (coordinates == 1) {
		at[0] = evaluate_grid(evaluating->grid1, evaluating->segments1, i);
	} else {
		at[0] = evaluate_grid(evaluating->grid2, segments[0], i);
		at[1] = evaluate_grid(evaluating->grid2 + 2, segments[1], j);
	}
	evaluate(context, coordinates, at);
}

GLOSS_LISTED_INSIDE3(EvalPoint, GLuint, coordinates, GLint, i, GLint, j)
{
	evaluate_point(context, coordinates, i, j);
}

void gl_EvalPoint1(GLint i)
{
	gl_EvalPoint(1, i, 0);
}

void gl_EvalPoint2(GLint i, GLint j)
{
	gl_EvalPoint(2, i, j);
}

/* The part of a grid that a mesh is of. */
struct mesh {
	GLint i1, i2, j1, j2;
};

#define MESH_POINTS_MAX (1 << 22)

/* Whether there is anything of it, and it is not absurdly large, which is told. */
static bool evaluate_has_mesh(struct gloss_context *context, const struct mesh *mesh)
{
	const int64_t along = (int64_t)mesh->i2 - mesh->i1 + 1;
	const int64_t across = (int64_t)mesh->j2 - mesh->j1 + 1;

	if (along < 1 || across < 1)
		return false;
	if (along <= MESH_POINTS_MAX && across <= MESH_POINTS_MAX &&
	    along * across <= MESH_POINTS_MAX)
		return true;
	gloss_error(context, GL_OUT_OF_MEMORY);
	return false;
}

/* A new primitive; false: out of memory. */
static bool evaluate_begin(struct gloss_context *context, GLenum mode)
{
	if (context->immediate.vertices >= GLOSS_BATCH_MAX)
		gloss_batch_draw(context);
	gloss_vertices_begin(&context->immediate, mode);
	return context->immediate.inside;
}

GLOSS_LISTED3(EvalMesh1, GLenum, mode, GLint, i1, GLint, i2)
{
	const struct mesh mesh = { i1, i2, 0, 0 };

	if (mode != GL_POINT && mode != GL_LINE) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	if (!evaluate_has_mesh(context, &mesh) ||
	    !evaluate_begin(context, mode == GL_POINT ? GL_POINTS : GL_LINE_STRIP))
		return;
	for (GLint i = i1; i <= i2; i++)
		evaluate_point(context, 1, i, 0);
	gloss_vertices_end(&context->immediate);
}

static void evaluate_mesh_points(struct gloss_context *context, const struct mesh *mesh)
{
	if (!evaluate_begin(context, GL_POINTS))
		return;
	for (GLint j = mesh->j1; j <= mesh->j2; j++)
		for (GLint i = mesh->i1; i <= mesh->i2; i++)
			evaluate_point(context, 2, i, j);
	gloss_vertices_end(&context->immediate);
}

static void evaluate_mesh_lines(struct gloss_context *context, const struct mesh *mesh)
{
	for (GLint j = mesh->j1; j <= mesh->j2 && evaluate_begin(context, GL_LINE_STRIP); j++) {
		for (GLint i = mesh->i1; i <= mesh->i2; i++)
			evaluate_point(context, 2, i, j);
		gloss_vertices_end(&context->immediate);
	}
	for (GLint i = mesh->i1; i <= mesh->i2 && evaluate_begin(context, GL_LINE_STRIP); i++) {
		for (GLint j = mesh->j1; j <= mesh->j2; j++)
			evaluate_point(context, 2, i, j);
		gloss_vertices_end(&context->immediate);
	}
}

static void evaluate_mesh_faces(struct gloss_context *context, const struct mesh *mesh)
{
	for (GLint j = mesh->j1; j < mesh->j2 && evaluate_begin(context, GL_QUAD_STRIP); j++) {
		for (GLint i = mesh->i1; i <= mesh->i2; i++) {
			evaluate_point(context, 2, i, j);
			evaluate_point(context, 2, i, j + 1);
		}
		gloss_vertices_end(&context->immediate);
	}
}

GLOSS_LISTED5(EvalMesh2, GLenum, mode, GLint, i1, GLint, i2, GLint, j1, GLint, j2)
{
	const struct mesh mesh = { i1, i2, j1, j2 };

	if (mode != GL_POINT && mode != GL_LINE && mode != GL_FILL)
		gloss_error(context, GL_INVALID_ENUM);
	else if (!evaluate_has_mesh(context, &mesh))
		return;
	else if (mode == GL_POINT)
		evaluate_mesh_points(context, &mesh);
	else if (mode == GL_LINE)
		evaluate_mesh_lines(context, &mesh);
	else
		evaluate_mesh_faces(context, &mesh);
}
