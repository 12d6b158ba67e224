// SPDX-License-Identifier: MIT
/* glBegin, glEnd, and the current values between and around them. */
#include <string.h>

#include "draw/batch.h"
#include "state/command.h"

static void play_invalid_mode(struct gloss_context *context, const void *call)
{
	(void)call;
	gloss_error(context, GL_INVALID_ENUM);
}

void gl_Begin(GLenum mode)
{
	struct gloss_context *context = gloss_current();
	struct gloss_vertices *vertices;

	if (!context)
		return;
	vertices = context->vertices;
	if (mode > GL_POLYGON) {
		/* In a list it is an error each time that the list is played. */
		if (gloss_listed_inside(play_invalid_mode, NULL, 0))
			gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	if (vertices->inside) {
		gloss_error(context, GL_INVALID_OPERATION);
		return;
	}
	if (vertices == &context->immediate && vertices->vertices >= GLOSS_BATCH_MAX)
		gloss_batch_draw(context);
	gloss_vertices_begin(vertices, mode);
}

void gl_End(void)
{
	struct gloss_context *context = gloss_current();

	if (!context)
		return;
	if (context->vertices->inside)
		gloss_vertices_end(context->vertices);
	else if (context->compiling.list)
		gloss_list_end(context);
	else
		gloss_error(context, GL_INVALID_OPERATION);
}

void gl_Vertex4f(GLfloat x, GLfloat y, GLfloat z, GLfloat w)
{
	struct gloss_context *context = gloss_current();
	struct gloss_vertices *vertices;
	struct gloss_vertex *vertex;

	if (!context)
		return;
	vertices = context->vertices;
	/* In a list it may belong to a primitive that was begun elsewhere. */
	if (!vertices->inside && !gloss_list_is_loose(context))
		return;
	if (vertices->vertices == vertices->vertex_room && !gloss_vertices_reserve(vertices, 1))
		return;
	vertex = &vertices->vertex[vertices->vertices++];
	*vertex = vertices->current->vertex;
	vertex->position[0] = x;
	vertex->position[1] = y;
	vertex->position[2] = z;
	vertex->position[3] = w;
}

/* Where a current value goes; NULL: there is no context. */
static struct gloss_current *immediate_set(unsigned int set)
{
	const struct gloss_context *context = gloss_current();

	if (!context)
		return NULL;
	if (~context->vertices->set & set)
		gloss_list_set(context->vertices, set);
	return context->vertices->current;
}

static void immediate_four(GLfloat out[4], GLfloat x, GLfloat y, GLfloat z, GLfloat w)
{
	out[0] = x;
	out[1] = y;
	out[2] = z;
	out[3] = w;
}

void gl_Color4f(GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha)
{
	struct gloss_current *current = immediate_set(GLOSS_SET_COLOUR);

	if (current)
		immediate_four(current->vertex.colour, red, green, blue, alpha);
}

void gl_Normal3f(GLfloat nx, GLfloat ny, GLfloat nz)
{
	struct gloss_current *current = immediate_set(GLOSS_SET_NORMAL);

	if (!current)
		return;
	current->vertex.normal[0] = nx;
	current->vertex.normal[1] = ny;
	current->vertex.normal[2] = nz;
}

void gl_EdgeFlag(GLboolean flag)
{
	struct gloss_current *current = immediate_set(GLOSS_SET_EDGE);

	if (current)
		current->vertex.edge = flag ? 1 : 0;
}

void gl_SecondaryColor3f(GLfloat red, GLfloat green, GLfloat blue)
{
	struct gloss_current *current = immediate_set(GLOSS_SET_SECONDARY);

	if (current)
		immediate_four(current->secondary, red, green, blue, 1);
}

void gl_FogCoordf(GLfloat coord)
{
	struct gloss_current *current = immediate_set(GLOSS_SET_FOG);

	if (current)
		current->fog = coord;
}

void gl_Indexf(GLfloat c)
{
	struct gloss_current *current = immediate_set(GLOSS_SET_INDEX);

	if (current)
		current->index = c;
}

void gl_MultiTexCoord4f(GLenum target, GLfloat s, GLfloat t, GLfloat r, GLfloat q)
{
	GLuint unit = target - GL_TEXTURE0;
	struct gloss_current *current;

	if (unit >= GLOSS_UNITS)
		return;
	current = immediate_set(GLOSS_SET_TEXCOORD << unit);
	if (current)
		immediate_four(current->texcoord[unit], s, t, r, q);
}

void gl_TexCoord4f(GLfloat s, GLfloat t, GLfloat r, GLfloat q)
{
	gl_MultiTexCoord4f(GL_TEXTURE0, s, t, r, q);
}
