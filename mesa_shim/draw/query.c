// SPDX-License-Identifier: MIT
/*
 * Occlusion queries. The library does not count what passes in a part of a frame, and says so by a
 * counter of 0 bits: a result is 0, and there at once.
 */
#include "draw/names.h"
#include "state/command.h"

/* What a name stands for: it was generated, or begun once and is a query. */
static GLboolean query_named = GL_FALSE, query_begun = GL_TRUE;

static bool query_is(const struct gloss_context *context, GLuint id)
{
	return gloss_names_find(&context->queries, id) == &query_begun;
}

void gl_GenQueries(GLsizei n, GLuint *ids)
{
	struct gloss_context *context = gloss_outside();
	GLuint first;

	if (!context)
		return;
	if (n < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	first = gloss_names_free_range(&context->queries, (GLuint)n);
	for (GLsizei i = 0; i < n; i++) {
		ids[i] = first + (GLuint)i;
		if (!first || !gloss_names_set(&context->queries, ids[i], &query_named)) {
			gloss_error(context, GL_OUT_OF_MEMORY);
			return;
		}
	}
}

void gl_DeleteQueries(GLsizei n, const GLuint *ids)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (n < 0)
		gloss_error(context, GL_INVALID_VALUE);
	for (GLsizei i = 0; i < n; i++) {
		if (ids[i] && ids[i] == context->query)
			context->query = 0;
		gloss_names_set(&context->queries, ids[i], NULL);
	}
}

GLboolean gl_IsQuery(GLuint id)
{
	struct gloss_context *context = gloss_outside();

	return context && query_is(context, id);
}

GLOSS_LISTED2(BeginQuery, GLenum, target, GLuint, id)
{
	if (target != GL_SAMPLES_PASSED)
		gloss_error(context, GL_INVALID_ENUM);
	else if (!id || context->query)
		gloss_error(context, GL_INVALID_OPERATION);
	else if (!gloss_names_set(&context->queries, id, &query_begun))
		gloss_error(context, GL_OUT_OF_MEMORY);
	else
		context->query = id;
}

GLOSS_LISTED1(EndQuery, GLenum, target)
{
	if (target != GL_SAMPLES_PASSED)
		gloss_error(context, GL_INVALID_ENUM);
	else if (!context->query)
		gloss_error(context, GL_INVALID_OPERATION);
	else
		context->query = 0;
}

void gl_GetQueryiv(GLenum target, GLenum pname, GLint *params)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (target == GL_SAMPLES_PASSED && pname == GL_CURRENT_QUERY)
		*params = (GLint)context->query;
	else if (target == GL_SAMPLES_PASSED && pname == GL_QUERY_COUNTER_BITS)
		*params = 0;
	else
		gloss_error(context, GL_INVALID_ENUM);
}

/* False: there is an error. */
static bool query_get(GLuint id, GLenum pname, GLuint *value)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return false;
	if (pname != GL_QUERY_RESULT && pname != GL_QUERY_RESULT_AVAILABLE) {
		gloss_error(context, GL_INVALID_ENUM);
		return false;
	}
	if (id == context->query || !query_is(context, id)) {
		gloss_error(context, GL_INVALID_OPERATION);
		return false;
	}
	*value = pname == GL_QUERY_RESULT_AVAILABLE ? GL_TRUE : 0;
	return true;
}

void gl_GetQueryObjectiv(GLuint id, GLenum pname, GLint *params)
{
	GLuint value;

	if (query_get(id, pname, &value))
		*params = (GLint)value;
}

void gl_GetQueryObjectuiv(GLuint id, GLenum pname, GLuint *params)
{
	GLuint value;

	if (query_get(id, pname, &value))
		*params = value;
}
