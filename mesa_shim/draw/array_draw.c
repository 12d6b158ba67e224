// SPDX-License-Identifier: MIT
/*
 * Draws of vertex arrays. They go to libaccel as they lie in memory; those that a list records are
 * its vertices.
 */
#include <string.h>

#include "api/convert.h"
#include "draw/array.h"
#include "draw/batch.h"
#include "draw/buffer.h"
#include "draw/emit.h"
#include "state/command.h"

/* Number @i at @at. @unit: integers stand for -1 to 1, or 0 to 1. */
static GLfloat array_number(const void *at, GLenum type, size_t i, bool unit)
{
	switch (type) {
	case GL_BYTE:
		return unit ? gloss_from_b(((const GLbyte *)at)[i]) : ((const GLbyte *)at)[i];
	case GL_UNSIGNED_BYTE:
		return unit ? gloss_from_ub(((const GLubyte *)at)[i]) : ((const GLubyte *)at)[i];
	case GL_SHORT:
		return unit ? gloss_from_s(((const GLshort *)at)[i]) : ((const GLshort *)at)[i];
	case GL_UNSIGNED_SHORT:
		return unit ? gloss_from_us(((const GLushort *)at)[i]) : ((const GLushort *)at)[i];
	case GL_INT:
		return unit ? gloss_from_i(((const GLint *)at)[i]) :
			      (GLfloat)((const GLint *)at)[i];
	case GL_UNSIGNED_INT:
		return unit ? gloss_from_ui(((const GLuint *)at)[i]) :
			      (GLfloat)((const GLuint *)at)[i];
	case GL_DOUBLE:
		return (GLfloat)((const GLdouble *)at)[i];
	default:
		return ((const GLfloat *)at)[i];
	}
}

/* Element @i; what an array has not is 0, and the last 1. False: the array is off. */
static bool array_fetch(struct gloss_context *context, const struct gloss_client_array *array,
			GLint i, bool unit, GLfloat out[4])
{
	size_t end;
	const char *data = array->enabled ? gloss_array_data(context, array, &end) : NULL;

	out[0] = out[1] = out[2] = 0;
	out[3] = 1;
	if (!data || (array->buffer && (i < 0 || (size_t)i >= end)))
		return false;
	data += (ptrdiff_t)i * (ptrdiff_t)gloss_array_stride(array);
	for (size_t j = 0; j < (size_t)array->size; j++)
		out[j] = array_number(data, array->type, j, unit);
	return true;
}

void gl_ArrayElement(GLint i)
{
	struct gloss_context *context = gloss_current();
	const struct gloss_arrays *arrays;
	GLfloat v[4];

	if (!context)
		return;
	arrays = &context->client.arrays;
	for (GLenum unit = 0; unit < GLOSS_UNITS; unit++)
		if (array_fetch(context, &arrays->texcoord[unit], i, false, v))
			gl_MultiTexCoord4f(GL_TEXTURE0 + unit, v[0], v[1], v[2], v[3]);
	if (array_fetch(context, &arrays->edge, i, false, v))
		gl_EdgeFlag(v[0] != 0);
	if (array_fetch(context, &arrays->fog, i, false, v))
		gl_FogCoordf(v[0]);
	if (array_fetch(context, &arrays->index, i, false, v))
		gl_Indexf(v[0]);
	if (array_fetch(context, &arrays->secondary, i, true, v))
		gl_SecondaryColor3f(v[0], v[1], v[2]);
	if (array_fetch(context, &arrays->colour, i, true, v))
		gl_Color4f(v[0], v[1], v[2], v[3]);
	if (array_fetch(context, &arrays->normal, i, true, v))
		gl_Normal3f(v[0], v[1], v[2]);
	if (array_fetch(context, &arrays->position, i, false, v))
		gl_Vertex4f(v[0], v[1], v[2], v[3]);
}

static enum accel_type array_accel_type(GLenum type)
{
	switch (type) {
	case GL_BYTE:
		return ACCEL_TYPE_BYTE;
	case GL_UNSIGNED_BYTE:
		return ACCEL_TYPE_UBYTE;
	case GL_SHORT:
		return ACCEL_TYPE_SHORT;
	case GL_UNSIGNED_SHORT:
		return ACCEL_TYPE_USHORT;
	case GL_INT:
		return ACCEL_TYPE_INT;
	case GL_UNSIGNED_INT:
		return ACCEL_TYPE_UINT;
	case GL_DOUBLE:
		return ACCEL_TYPE_DOUBLE;
	default:
		return ACCEL_TYPE_FLOAT;
	}
}

/* An array for libaccel, or the current value for all vertices where there is none. */
static struct accel_array array_describe(struct gloss_context *context,
					 const struct gloss_client_array *array, bool unit,
					 const GLfloat *current, uint32_t *vertices)
{
	size_t end = 0;
	const void *data = array->enabled ? gloss_array_data(context, array, &end) : NULL;

	if (!array->enabled)
		return (struct accel_array){ .data = current, .constant = true };
	if (end < *vertices)
		*vertices = (uint32_t)end;
	return (struct accel_array){
		.data = data,
		.stride = (uint32_t)gloss_array_stride(array),
		.type = array_accel_type(array->type),
		.components = (uint8_t)array->size,
		.normalised = unit && array->type != GL_FLOAT && array->type != GL_DOUBLE,
	};
}

/* Draws @primitives of the arrays; @vertices is how many of them may be read. */
static void array_send(struct gloss_context *context, const struct accel_elements *elements,
		       uint32_t vertices)
{
	const struct gloss_arrays *arrays = &context->client.arrays;
	const struct gloss_vertex *current = &context->attributes.current.vertex;
	struct accel_arrays to = ACCEL_ARRAYS(0);

	if (!arrays->position.enabled)
		return;
	to.position = array_describe(context, &arrays->position, false, NULL, &vertices);
	to.colour = array_describe(context, &arrays->colour, true, current->colour, &vertices);
	if (context->attributes.lighting.enabled)
		to.normal = array_describe(context, &arrays->normal, true, current->normal,
					   &vertices);
	to.vertices = vertices;
	if (vertices && to.position.data)
		gloss_emit_draw(context, &to, elements);
}

/* The context, in which the draw is done now; NULL: it is an error, or nothing. */
static struct gloss_context *array_begin_draw(GLenum mode, GLsizei count)
{
	struct gloss_context *context = gloss_current();

	if (!context)
		return NULL;
	if (context->vertices->inside)
		gloss_error(context, GL_INVALID_OPERATION);
	else if (mode > GL_POLYGON)
		gloss_error(context, GL_INVALID_ENUM);
	else if (count < 0)
		gloss_error(context, GL_INVALID_VALUE);
	else if (count)
		return context;
	return NULL;
}

static void array_record(GLenum mode, GLint first, GLsizei count)
{
	gl_Begin(mode);
	for (GLint i = first; i < first + count; i++)
		gl_ArrayElement(i);
	gl_End();
}

void gl_DrawArrays(GLenum mode, GLint first, GLsizei count)
{
	gl_MultiDrawArrays(mode, &first, &count, 1);
}

/* Whether there are such vertices. */
static bool array_ranges_valid(const GLint *first, const GLsizei *count, GLsizei drawcount)
{
	for (GLsizei i = 0; i < drawcount; i++)
		if (first[i] < 0 || count[i] < 0 || first[i] > INT32_MAX - count[i])
			return false;
	return true;
}

#define ARRAY_PRIMITIVES 64

/* Draws up to ARRAY_PRIMITIVES of them. */
static void array_send_ranges(struct gloss_context *context, GLenum mode, const GLint *first,
			      const GLsizei *count, GLsizei drawcount)
{
	struct accel_primitive primitive[ARRAY_PRIMITIVES];
	const struct accel_elements elements = ACCEL_ELEMENTS(.primitive = primitive,
							      .primitives = (uint32_t)drawcount);
	uint32_t end = 0;

	for (GLsizei i = 0; i < drawcount; i++) {
		primitive[i] = (struct accel_primitive){ (enum accel_topology)mode,
							 (uint32_t)first[i], (uint32_t)count[i] };
		if ((uint32_t)(first[i] + count[i]) > end)
			end = (uint32_t)(first[i] + count[i]);
	}
	array_send(context, &elements, end);
}

void gl_MultiDrawArrays(GLenum mode, const GLint *first, const GLsizei *count, GLsizei drawcount)
{
	struct gloss_context *context = array_begin_draw(mode, drawcount);

	if (!context)
		return;
	if (!array_ranges_valid(first, count, drawcount)) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	if (!context->compiling.list)
		gloss_batch_draw(context);
	for (GLsizei i = 0, some; i < drawcount; i += some) {
		some = 1;
		if (context->compiling.list) {
			array_record(mode, first[i], count[i]);
			continue;
		}
		some = drawcount - i < ARRAY_PRIMITIVES ? drawcount - i : ARRAY_PRIMITIVES;
		array_send_ranges(context, mode, first + i, count + i, some);
	}
}

static GLuint array_index(GLenum type, const void *indices, GLsizei i)
{
	if (type == GL_UNSIGNED_BYTE)
		return ((const GLubyte *)indices)[i];
	if (type == GL_UNSIGNED_SHORT)
		return ((const GLushort *)indices)[i];
	return ((const GLuint *)indices)[i];
}

/* The indices, which may be in a buffer; NULL: they are not all there. */
static const void *array_indices(struct gloss_context *context, GLenum type, GLsizei count,
				 const void *indices)
{
	const size_t size = (size_t)count * gloss_array_type_size(type), offset = (size_t)indices;
	const struct gloss_buffer *buffer;

	if (!context->client.arrays.element_buffer)
		return indices;
	buffer = gloss_buffer_find(context, context->client.arrays.element_buffer);
	if (!buffer || !buffer->data || offset > buffer->size || size > buffer->size - offset)
		return NULL;
	return buffer->data + offset;
}

void gl_DrawElements(GLenum mode, GLsizei count, GLenum type, const void *indices)
{
	struct gloss_context *context = array_begin_draw(mode, count);
	const struct accel_primitive primitive = { (enum accel_topology)mode, 0, (uint32_t)count };
	GLuint greatest = 0;

	if (!context)
		return;
	if (type != GL_UNSIGNED_BYTE && type != GL_UNSIGNED_SHORT && type != GL_UNSIGNED_INT) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	indices = array_indices(context, type, count, indices);
	if (!indices)
		return;
	if (!context->compiling.list) {
		const struct accel_elements elements = ACCEL_ELEMENTS(
				.primitive = &primitive, .primitives = 1,
				.index_type = array_accel_type(type), .index = indices);

		for (GLsizei i = 0; i < count; i++)
			if (array_index(type, indices, i) > greatest)
				greatest = array_index(type, indices, i);
		gloss_batch_draw(context);
		array_send(context, &elements, greatest == UINT32_MAX ? greatest : greatest + 1);
		return;
	}
	gl_Begin(mode);
	for (GLsizei i = 0; i < count; i++)
		gl_ArrayElement((GLint)array_index(type, indices, i));
	gl_End();
}

void gl_DrawRangeElements(GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type,
			  const void *indices)
{
	struct gloss_context *context = gloss_current();

	/* What lies outside of the range is undefined; here it is drawn. */
	if (context && end < start)
		gloss_error(context, GL_INVALID_VALUE);
	else
		gl_DrawElements(mode, count, type, indices);
}

void gl_MultiDrawElements(GLenum mode, const GLsizei *count, GLenum type,
			  const void *const *indices, GLsizei drawcount)
{
	for (GLsizei i = 0; i < drawcount; i++)
		gl_DrawElements(mode, count[i], type, indices[i]);
}
