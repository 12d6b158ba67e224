// SPDX-License-Identifier: MIT
/* glGet of everything that has a row in the table, and of matrices. */
#include <limits.h>
#include <math.h>

#include "state/command.h"
#include "state/get.h"
#include "state/light.h"

void gloss_get_row(struct gloss_context *context, const struct gloss_row *row,
		   struct gloss_values *values)
{
	const void *at = gloss_row_at(context, row);

	values->kind = row->kind;
	values->count = row->count;
	for (unsigned int i = 0; i < row->count; i++) {
		switch ((enum gloss_kind)row->kind) {
		case GLOSS_CONSTANT:
			values->value[i] = row->offset;
			break;
		case GLOSS_INTEGER:
			values->value[i] = ((const GLint *)at)[i];
			break;
		case GLOSS_FLOAT:
		case GLOSS_UNIT_FLOAT:
			values->value[i] = (double)((const GLfloat *)at)[i];
			break;
		default:
			values->value[i] = ((const GLboolean *)at)[i];
			break;
		}
	}
}

static void get_matrix(struct gloss_values *values, const struct gloss_matrix *matrix,
		       bool transposed)
{
	values->kind = GLOSS_FLOAT;
	values->count = 16;
	for (int i = 0; i < 16; i++)
		values->value[i] = (double)matrix->m[transposed ? i % 4 * 4 + i / 4 : i];
}

static void get_two(struct gloss_values *values, enum gloss_kind kind, double first, double second)
{
	*values = (struct gloss_values){ .kind = kind, .count = 2, .value = { first, second } };
}

static void get_depth(struct gloss_values *values, GLint top)
{
	*values = (struct gloss_values){ .kind = GLOSS_INTEGER, .count = 1, .value = { top + 1 } };
}

/* What is no member of the context as it stands. */
static void get_computed(const struct gloss_context *context, GLenum name,
			 struct gloss_values *values)
{
	const struct gloss_matrices *matrices = &context->matrices;
	GLint unit = context->attributes.texturing.active;
	const struct gloss_matrix *texture = &matrices->texture[unit][matrices->texture_top[unit]];

	switch (name) {
	case GL_MODELVIEW_MATRIX:
	case GL_TRANSPOSE_MODELVIEW_MATRIX:
		get_matrix(values, gloss_matrix_modelview(context), name != GL_MODELVIEW_MATRIX);
		break;
	case GL_PROJECTION_MATRIX:
	case GL_TRANSPOSE_PROJECTION_MATRIX:
		get_matrix(values, gloss_matrix_projection(context), name != GL_PROJECTION_MATRIX);
		break;
	case GL_TEXTURE_MATRIX:
	case GL_TRANSPOSE_TEXTURE_MATRIX:
		get_matrix(values, texture, name != GL_TEXTURE_MATRIX);
		break;
	case GL_MODELVIEW_STACK_DEPTH:
		get_depth(values, matrices->modelview_top);
		break;
	case GL_PROJECTION_STACK_DEPTH:
		get_depth(values, matrices->projection_top);
		break;
	case GL_TEXTURE_STACK_DEPTH:
		get_depth(values, matrices->texture_top[unit]);
		break;
	case GL_ACTIVE_TEXTURE:
		get_depth(values, GL_TEXTURE0 + unit - 1);
		break;
	case GL_CLIENT_ACTIVE_TEXTURE:
		get_depth(values, GL_TEXTURE0 + context->client.arrays.active - 1);
		break;
	case GL_MAX_VIEWPORT_DIMS:
		get_two(values, GLOSS_INTEGER, ACCEL_TARGET_SIZE_MAX, ACCEL_TARGET_SIZE_MAX);
		break;
	case GL_POINT_SIZE_RANGE:
	case GL_ALIASED_POINT_SIZE_RANGE:
	case GL_LINE_WIDTH_RANGE:
	case GL_ALIASED_LINE_WIDTH_RANGE:
		get_two(values, GLOSS_FLOAT, 1, GLOSS_WIDTH_MAX);
		break;
	case GL_POINT_SIZE_GRANULARITY:
	case GL_LINE_WIDTH_GRANULARITY:
		*values = (struct gloss_values){ .kind = GLOSS_FLOAT,
						 .count = 1,
						 .value = { 1.0 / 16 } };
		break;
	default:
		values->count = 0;
		break;
	}
}

void gloss_get(struct gloss_context *context, GLenum name, struct gloss_values *values)
{
	const struct gloss_row *row = gloss_table_find(name);

	if (row)
		gloss_get_row(context, row, values);
	else
		get_computed(context, name, values);
}

GLint gloss_get_integer(enum gloss_kind kind, double value)
{
	if (kind == GLOSS_UNIT_FLOAT)
		value = floor((4294967295.0 * value - 1) / 2 + 0.5);
	else
		value = floor(value + 0.5);
	if (!(value > INT_MIN))
		return INT_MIN;
	return value >= INT_MAX ? INT_MAX : (GLint)value;
}

/* False: there is an error, and nothing to answer. */
static bool get_begin(GLenum name, struct gloss_values *values)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return false;
	gloss_get(context, name, values);
	if (!values->count)
		gloss_error(context, GL_INVALID_ENUM);
	return values->count;
}

void gl_GetBooleanv(GLenum pname, GLboolean *data)
{
	struct gloss_values values;

	if (!get_begin(pname, &values))
		return;
	for (unsigned int i = 0; i < values.count; i++)
		data[i] = values.value[i] != 0;
}

void gl_GetIntegerv(GLenum pname, GLint *data)
{
	struct gloss_values values;

	if (!get_begin(pname, &values))
		return;
	for (unsigned int i = 0; i < values.count; i++)
		data[i] = gloss_get_integer(values.kind, values.value[i]);
}

void gl_GetFloatv(GLenum pname, GLfloat *data)
{
	struct gloss_values values;

	if (!get_begin(pname, &values))
		return;
	for (unsigned int i = 0; i < values.count; i++)
		data[i] = (GLfloat)values.value[i];
}

void gl_GetDoublev(GLenum pname, GLdouble *data)
{
	struct gloss_values values;

	if (!get_begin(pname, &values))
		return;
	for (unsigned int i = 0; i < values.count; i++)
		data[i] = values.value[i];
}
