// SPDX-License-Identifier: MIT
/*
 * Draws of vertex arrays. They go to libaccel as they lie in memory; those that a list records are
 * its vertices.
 */
#include <pthread.h>
#include <string.h>

#include "api/convert.h"
#include "draw/array.h"
#include "draw/batch.h"
#include "draw/buffer.h"
#include "draw/emit.h"
#include "draw/shared.h"
#include "state/command.h"

/* The number at @at, which may be odd. @unit: integers stand for -1 to 1, or 0 to 1. */
static GLfloat array_number(const void *at, GLenum type, bool unit)
{
	union {
		GLbyte b;
		GLubyte ub;
		GLshort s;
		GLushort us;
		GLint i;
		GLuint ui;
		GLfloat f;
		GLdouble d;
	} number = { 0 };

	memcpy(&number, at, gloss_array_type_size(type));
	switch (type) {
	case GL_BYTE:
		return unit ? gloss_from_b(number.b) : number.b;
	case GL_UNSIGNED_BYTE:
		return unit ? gloss_from_ub(number.ub) : number.ub;
	case GL_SHORT:
		return unit ? gloss_from_s(number.s) : number.s;
	case GL_UNSIGNED_SHORT:
		return unit ? gloss_from_us(number.us) : number.us;
	case GL_INT:
		return unit ? gloss_from_i(number.i) : (GLfloat)number.i;
	case GL_UNSIGNED_INT:
		return unit ? gloss_from_ui(number.ui) : (GLfloat)number.ui;
	case GL_DOUBLE:
		return (GLfloat)number.d;
	default:
		return number.f;
	}
}

/* Element @i; what an array has not is 0, and the last 1. False: the array is off. */
static bool array_fetch(const struct gloss_context *context, const struct gloss_client_array *array,
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
		out[j] = array_number(data + j * gloss_array_type_size(array->type), array->type,
				      unit);
	return true;
}

static void array_element(struct gloss_context *context, GLint i)
{
	const struct gloss_arrays *arrays = &context->client.arrays;
	GLfloat v[4];

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

void gl_ArrayElement(GLint i)
{
	struct gloss_context *context = gloss_current();

	if (!context)
		return;
	pthread_rwlock_rdlock(&context->shared->buffer_lock);
	array_element(context, i);
	pthread_rwlock_unlock(&context->shared->buffer_lock);
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
static struct accel_array array_describe(const struct gloss_context *context,
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
	if (gloss_emit_has_outlines(context))
		to.edge = array_describe(context, &arrays->edge, false, &current->edge, &vertices);
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

/* Whether a buffer that is drawn from is in the program's hands. */
static bool array_is_mapped(const struct gloss_context *context,
			    const struct gloss_client_array *array)
{
	const GLint name = array->enabled ? array->buffer : 0;
	const struct gloss_buffer *buffer = gloss_buffer_find(context, name);

	return buffer && buffer->access;
}

/* Before a draw looks into buffers: nobody else changes them until array_unlock. False: an error. */
static bool array_lock(struct gloss_context *context)
{
	const struct gloss_arrays *arrays = &context->client.arrays;

	pthread_rwlock_rdlock(&context->shared->buffer_lock);
	if (!array_is_mapped(context, &arrays->position) &&
	    !array_is_mapped(context, &arrays->colour) &&
	    !array_is_mapped(context, &arrays->normal) && !array_is_mapped(context, &arrays->edge))
		return true;
	pthread_rwlock_unlock(&context->shared->buffer_lock);
	gloss_error(context, GL_INVALID_OPERATION);
	return false;
}

static void array_unlock(struct gloss_context *context)
{
	pthread_rwlock_unlock(&context->shared->buffer_lock);
}

static void array_record(struct gloss_context *context, GLenum mode, GLint first, GLsizei count)
{
	gl_Begin(mode);
	for (GLint i = first; i < first + count; i++)
		array_element(context, i);
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
	if (!array_lock(context))
		return;
	if (!context->compiling.list)
		gloss_batch_draw(context);
	for (GLsizei i = 0, some; i < drawcount; i += some) {
		some = 1;
		if (context->compiling.list) {
			array_record(context, mode, first[i], count[i]);
			continue;
		}
		some = drawcount - i < ARRAY_PRIMITIVES ? drawcount - i : ARRAY_PRIMITIVES;
		array_send_ranges(context, mode, first + i, count + i, some);
	}
	array_unlock(context);
}

static GLuint array_index(GLenum type, const GLubyte *indices, GLsizei i)
{
	GLushort two;
	GLuint four;

	if (type == GL_UNSIGNED_BYTE)
		return indices[i];
	if (type == GL_UNSIGNED_SHORT) {
		memcpy(&two, indices + (size_t)i * sizeof(two), sizeof(two));
		return two;
	}
	memcpy(&four, indices + (size_t)i * sizeof(four), sizeof(four));
	return four;
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
	if (buffer->access) {
		gloss_error(context, GL_INVALID_OPERATION);
		return NULL;
	}
	return buffer->data + offset;
}

static void array_draw_indexed(struct gloss_context *context, GLenum mode, GLsizei count,
			       GLenum type, const void *indices)
{
	const struct accel_primitive primitive = { (enum accel_topology)mode, 0, (uint32_t)count };
	GLuint greatest = 0;

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
		array_element(context, (GLint)array_index(type, indices, i));
	gl_End();
}

void gl_DrawElements(GLenum mode, GLsizei count, GLenum type, const void *indices)
{
	struct gloss_context *context = array_begin_draw(mode, count);

	if (!context)
		return;
	if (type != GL_UNSIGNED_BYTE && type != GL_UNSIGNED_SHORT && type != GL_UNSIGNED_INT) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	if (!array_lock(context))
		return;
	indices = array_indices(context, type, count, indices);
	if (indices)
		array_draw_indexed(context, mode, count, type, indices);
	array_unlock(context);
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
	if (!array_begin_draw(mode, drawcount))
		return;
	for (GLsizei i = 0; i < drawcount; i++)
		gl_DrawElements(mode, count[i], type, indices[i]);
}
