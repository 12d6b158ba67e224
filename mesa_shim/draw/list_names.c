// SPDX-License-Identifier: MIT
/* Lists by their names, which contexts share: glNewList to glDeleteLists. */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "draw/list_priv.h"
#include "draw/names.h"
#include "draw/shared.h"
#include "state/command.h"
#include "state/get.h"

/* The list, which is the caller's to give back; NULL: there is none. */
static struct gloss_list *list_take(struct gloss_shared *shared, GLuint name)
{
	struct gloss_list *list;

	pthread_mutex_lock(&shared->lock);
	list = gloss_names_find(&shared->lists, name);
	if (list)
		list->references++;
	pthread_mutex_unlock(&shared->lock);
	return list;
}

static void list_give(struct gloss_shared *shared, struct gloss_list *list)
{
	pthread_mutex_lock(&shared->lock);
	gloss_list_unref(list);
	pthread_mutex_unlock(&shared->lock);
}

/* False: out of memory. @list may be NULL. */
static bool list_name(struct gloss_shared *shared, GLuint name, struct gloss_list *list)
{
	struct gloss_list *old;
	bool named;

	pthread_mutex_lock(&shared->lock);
	old = gloss_names_find(&shared->lists, name);
	named = gloss_names_set(&shared->lists, name, list);
	if (named)
		gloss_list_unref(old);
	pthread_mutex_unlock(&shared->lock);
	return named;
}

void gl_NewList(GLuint list, GLenum mode)
{
	struct gloss_context *context = gloss_outside();
	struct gloss_compiling *compiling;

	if (!context)
		return;
	compiling = &context->compiling;
	if (mode != GL_COMPILE && mode != GL_COMPILE_AND_EXECUTE) {
		gloss_error(context, GL_INVALID_ENUM);
	} else if (!list) {
		gloss_error(context, GL_INVALID_VALUE);
	} else if (compiling->list) {
		gloss_error(context, GL_INVALID_OPERATION);
	} else {
		compiling->list = gloss_list_new();
		if (!compiling->list) {
			gloss_error(context, GL_OUT_OF_MEMORY);
			return;
		}
		compiling->name = (GLint)list;
		compiling->mode = mode;
		compiling->vertices.current = &compiling->current;
		context->vertices = &compiling->vertices;
	}
}

void gloss_list_abandon(struct gloss_context *context)
{
	if (context->compiling.list)
		list_give(context->shared, context->compiling.list);
	context->compiling.list = NULL;
	context->compiling.name = 0;
	context->compiling.mode = 0;
	context->vertices = &context->immediate;
}

void gl_EndList(void)
{
	struct gloss_context *context = gloss_current();
	struct gloss_compiling *compiling;

	if (!context)
		return;
	/* What was executed on the way may have begun a primitive. */
	gloss_list_settle(context);
	compiling = &context->compiling;
	if (!compiling->list || context->immediate.inside) {
		gloss_error(context, GL_INVALID_OPERATION);
		return;
	}
	if (list_name(context->shared, (GLuint)compiling->name, compiling->list))
		compiling->list = NULL;
	else
		gloss_error(context, GL_OUT_OF_MEMORY);
	gloss_list_abandon(context);
}

static void list_call(struct gloss_context *context, GLuint name)
{
	struct gloss_list *list;

	if (context->nesting == GLOSS_LIST_NESTING)
		return;
	list = list_take(context->shared, name);
	if (!list)
		return;
	context->nesting++;
	gloss_list_play(context, list);
	context->nesting--;
	list_give(context->shared, list);
}

GLOSS_LISTED_INSIDE1(CallList, GLuint, list)
{
	list_call(context, list);
}

/* One of glCallLists: the base is that of when it is played. */
GLOSS_LISTED_INSIDE1(CallListOffset, GLint, offset)
{
	list_call(context, (GLuint)context->attributes.list_base + (GLuint)offset);
}

static GLint list_offset(GLenum type, const void *lists, GLsizei i)
{
	const GLubyte *bytes = lists;

	switch (type) {
	case GL_BYTE:
		return ((const GLbyte *)lists)[i];
	case GL_UNSIGNED_BYTE:
		return bytes[i];
	case GL_SHORT:
		return ((const GLshort *)lists)[i];
	case GL_UNSIGNED_SHORT:
		return ((const GLushort *)lists)[i];
	case GL_FLOAT:
		return gloss_get_integer(GLOSS_FLOAT, floor((double)((const GLfloat *)lists)[i]));
	case GL_2_BYTES:
		return bytes[2 * i] << 8 | bytes[2 * i + 1];
	case GL_3_BYTES:
		return bytes[3 * i] << 16 | bytes[3 * i + 1] << 8 | bytes[3 * i + 2];
	case GL_4_BYTES:
		return (GLint)((GLuint)bytes[4 * i] << 24 | (GLuint)bytes[4 * i + 1] << 16 |
			       (GLuint)bytes[4 * i + 2] << 8 | bytes[4 * i + 3]);
	default:
		return ((const GLint *)lists)[i];
	}
}

void gl_CallLists(GLsizei n, GLenum type, const void *lists)
{
	struct gloss_context *context = gloss_current();

	if (!context)
		return;
	if (type < GL_BYTE || type > GL_4_BYTES)
		gloss_error(context, GL_INVALID_ENUM);
	else if (n < 0)
		gloss_error(context, GL_INVALID_VALUE);
	for (GLsizei i = 0; type >= GL_BYTE && type <= GL_4_BYTES && i < n; i++)
		gl_CallListOffset(list_offset(type, lists, i));
}

GLOSS_LISTED1(ListBase, GLuint, base)
{
	context->attributes.list_base = (GLint)base;
}

GLuint gl_GenLists(GLsizei range)
{
	struct gloss_context *context = gloss_outside();
	GLuint first = 0;

	if (!context)
		return 0;
	if (range < 0)
		gloss_error(context, GL_INVALID_VALUE);
	if (range <= 0)
		return 0;
	pthread_mutex_lock(&context->shared->lock);
	first = gloss_names_free_range(&context->shared->lists, (GLuint)range);
	pthread_mutex_unlock(&context->shared->lock);
	/* They are empty lists until they are made. */
	for (GLuint i = 0; first && i < (GLuint)range; i++) {
		struct gloss_list *list = gloss_list_new();

		if (!list || !list_name(context->shared, first + i, list)) {
			gloss_error(context, GL_OUT_OF_MEMORY);
			gloss_list_unref(list);
			return 0;
		}
	}
	return first;
}

void gl_DeleteLists(GLuint list, GLsizei range)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (range < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	for (GLuint i = 0; i < (GLuint)range; i++)
		list_name(context->shared, list + i, NULL);
}

GLboolean gl_IsList(GLuint list)
{
	struct gloss_context *context = gloss_outside();
	bool is;

	if (!context)
		return GL_FALSE;
	pthread_mutex_lock(&context->shared->lock);
	is = gloss_names_find(&context->shared->lists, list);
	pthread_mutex_unlock(&context->shared->lock);
	return is;
}
