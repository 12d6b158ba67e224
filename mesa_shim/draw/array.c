// SPDX-License-Identifier: MIT
#include "draw/array.h"

#include "draw/buffer.h"
#include "state/command.h"

size_t gloss_array_type_size(GLenum type)
{
	switch (type) {
	case GL_BYTE:
	case GL_UNSIGNED_BYTE:
		return 1;
	case GL_SHORT:
	case GL_UNSIGNED_SHORT:
		return 2;
	case GL_INT:
	case GL_UNSIGNED_INT:
	case GL_FLOAT:
		return 4;
	case GL_DOUBLE:
		return 8;
	default:
		return 0;
	}
}

size_t gloss_array_stride(const struct gloss_client_array *array)
{
	if (array->stride)
		return (size_t)array->stride;
	return gloss_array_type_size(array->type) * (size_t)array->size;
}

const void *gloss_array_data(const struct gloss_context *context,
			     const struct gloss_client_array *array, size_t *end)
{
	const size_t offset = (size_t)array->pointer, stride = gloss_array_stride(array);
	const size_t element = gloss_array_type_size(array->type) * (size_t)array->size;
	const struct gloss_buffer *buffer;
	size_t elements = SIZE_MAX;
	const void *data = array->pointer;

	if (array->buffer) {
		buffer = gloss_buffer_find(context, array->buffer);
		elements = 0;
		data = NULL;
		if (buffer && buffer->data && offset <= buffer->size) {
			data = buffer->data + offset;
			if (stride && element <= buffer->size - offset)
				elements = (buffer->size - offset - element) / stride + 1;
		}
	}
	if (end)
		*end = elements;
	return elements ? data : NULL;
}

/* Bits of the types that an array may have. */
enum array_types {
	ARRAY_BYTE = 1 << 0,
	ARRAY_UBYTE = 1 << 1,
	ARRAY_SHORT = 1 << 2,
	ARRAY_USHORT = 1 << 3,
	ARRAY_INT = 1 << 4,
	ARRAY_UINT = 1 << 5,
	ARRAY_REAL = 1 << 6 | 1 << 10, /* GL_FLOAT and GL_DOUBLE */
	ARRAY_SIGNED = ARRAY_SHORT | ARRAY_INT | ARRAY_REAL,
	ARRAY_ALL = ARRAY_SIGNED | ARRAY_BYTE | ARRAY_UBYTE | ARRAY_USHORT | ARRAY_UINT
};

static void array_set(struct gloss_context *context, struct gloss_client_array *array,
		      unsigned int types, GLint least, GLint most, GLint size, GLenum type,
		      GLsizei stride, const void *pointer)
{
	if (type < GL_BYTE || type > GL_DOUBLE || !(types & 1u << (type - GL_BYTE))) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	if (stride < 0 || size < least || size > most) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	array->size = size;
	array->type = type;
	array->stride = stride;
	array->pointer = pointer;
	array->buffer = context->client.arrays.array_buffer;
}

void gl_VertexPointer(GLint size, GLenum type, GLsizei stride, const void *pointer)
{
	struct gloss_context *context = gloss_outside();

	if (context)
		array_set(context, &context->client.arrays.position, ARRAY_SIGNED, 2, 4, size, type,
			  stride, pointer);
}

void gl_NormalPointer(GLenum type, GLsizei stride, const void *pointer)
{
	struct gloss_context *context = gloss_outside();

	if (context)
		array_set(context, &context->client.arrays.normal, ARRAY_SIGNED | ARRAY_BYTE, 3, 3,
			  3, type, stride, pointer);
}

void gl_ColorPointer(GLint size, GLenum type, GLsizei stride, const void *pointer)
{
	struct gloss_context *context = gloss_outside();

	if (context)
		array_set(context, &context->client.arrays.colour, ARRAY_ALL, 3, 4, size, type,
			  stride, pointer);
}

void gl_SecondaryColorPointer(GLint size, GLenum type, GLsizei stride, const void *pointer)
{
	struct gloss_context *context = gloss_outside();

	if (context)
		array_set(context, &context->client.arrays.secondary, ARRAY_ALL, 3, 3, size, type,
			  stride, pointer);
}

void gl_FogCoordPointer(GLenum type, GLsizei stride, const void *pointer)
{
	struct gloss_context *context = gloss_outside();

	if (context)
		array_set(context, &context->client.arrays.fog, ARRAY_REAL, 1, 1, 1, type, stride,
			  pointer);
}

void gl_IndexPointer(GLenum type, GLsizei stride, const void *pointer)
{
	struct gloss_context *context = gloss_outside();

	if (context)
		array_set(context, &context->client.arrays.index, ARRAY_SIGNED | ARRAY_UBYTE, 1, 1,
			  1, type, stride, pointer);
}

void gl_EdgeFlagPointer(GLsizei stride, const void *pointer)
{
	struct gloss_context *context = gloss_outside();

	if (context)
		array_set(context, &context->client.arrays.edge, ARRAY_UBYTE, 1, 1, 1,
			  GL_UNSIGNED_BYTE, stride, pointer);
}

void gl_TexCoordPointer(GLint size, GLenum type, GLsizei stride, const void *pointer)
{
	struct gloss_context *context = gloss_outside();
	struct gloss_arrays *arrays;

	if (!context)
		return;
	arrays = &context->client.arrays;
	array_set(context, &arrays->texcoord[arrays->active], ARRAY_SIGNED, 1, 4, size, type,
		  stride, pointer);
}

void gl_ClientActiveTexture(GLenum texture)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (texture - GL_TEXTURE0 < GLOSS_UNITS)
		context->client.arrays.active = (GLint)(texture - GL_TEXTURE0);
	else
		gloss_error(context, GL_INVALID_ENUM);
}

void gl_GetPointerv(GLenum pname, void **params)
{
	struct gloss_context *context = gloss_outside();
	const struct gloss_arrays *arrays;

	if (!context)
		return;
	arrays = &context->client.arrays;
	switch (pname) {
	case GL_VERTEX_ARRAY_POINTER:
		*params = (void *)arrays->position.pointer;
		break;
	case GL_NORMAL_ARRAY_POINTER:
		*params = (void *)arrays->normal.pointer;
		break;
	case GL_COLOR_ARRAY_POINTER:
		*params = (void *)arrays->colour.pointer;
		break;
	case GL_INDEX_ARRAY_POINTER:
		*params = (void *)arrays->index.pointer;
		break;
	case GL_EDGE_FLAG_ARRAY_POINTER:
		*params = (void *)arrays->edge.pointer;
		break;
	case GL_SECONDARY_COLOR_ARRAY_POINTER:
		*params = (void *)arrays->secondary.pointer;
		break;
	case GL_FOG_COORDINATE_ARRAY_POINTER:
		*params = (void *)arrays->fog.pointer;
		break;
	case GL_SELECTION_BUFFER_POINTER:
		*params = context->selection.buffer;
		break;
	case GL_FEEDBACK_BUFFER_POINTER:
		*params = context->feedback.buffer;
		break;
	case GL_TEXTURE_COORD_ARRAY_POINTER:
		*params = (void *)arrays->texcoord[arrays->active].pointer;
		break;
	default:
		gloss_error(context, GL_INVALID_ENUM);
		break;
	}
}

/* Of each format of glInterleavedArrays: sizes, offsets in bytes, and the stride. */
static const struct {
	GLint texcoord, colour, position;
	GLenum colour_type;
	bool normal;
	GLuint colour_at, normal_at, position_at;
	GLsizei stride;
} array_interleaved[] = {
	{ 0, 0, 2, 0, false, 0, 0, 0, 8 },                  /* V2F */
	{ 0, 0, 3, 0, false, 0, 0, 0, 12 },                 /* V3F */
	{ 0, 4, 2, GL_UNSIGNED_BYTE, false, 0, 0, 4, 12 },  /* C4UB_V2F */
	{ 0, 4, 3, GL_UNSIGNED_BYTE, false, 0, 0, 4, 16 },  /* C4UB_V3F */
	{ 0, 3, 3, GL_FLOAT, false, 0, 0, 12, 24 },         /* C3F_V3F */
	{ 0, 0, 3, 0, true, 0, 0, 12, 24 },                 /* N3F_V3F */
	{ 0, 4, 3, GL_FLOAT, true, 0, 16, 28, 40 },         /* C4F_N3F_V3F */
	{ 2, 0, 3, 0, false, 0, 0, 8, 20 },                 /* T2F_V3F */
	{ 4, 0, 4, 0, false, 0, 0, 16, 32 },                /* T4F_V4F */
	{ 2, 4, 3, GL_UNSIGNED_BYTE, false, 8, 0, 12, 24 }, /* T2F_C4UB_V3F */
	{ 2, 3, 3, GL_FLOAT, false, 8, 0, 20, 32 },         /* T2F_C3F_V3F */
	{ 2, 0, 3, 0, true, 0, 8, 20, 32 },                 /* T2F_N3F_V3F */
	{ 2, 4, 3, GL_FLOAT, true, 8, 24, 36, 48 },         /* T2F_C4F_N3F_V3F */
	{ 4, 4, 4, GL_FLOAT, true, 16, 32, 44, 60 },        /* T4F_C4F_N3F_V4F */
};

static void array_interleave(struct gloss_context *context, struct gloss_client_array *array,
			     GLint size, GLenum type, GLsizei stride, const void *pointer,
			     size_t offset)
{
	array->enabled = size != 0;
	if (size)
		array_set(context, array, ARRAY_ALL, 1, 4, size, type, stride,
			  (const char *)pointer + offset);
}

void gl_InterleavedArrays(GLenum format, GLsizei stride, const void *pointer)
{
	struct gloss_context *context = gloss_outside();
	GLuint i = format - GL_V2F;
	struct gloss_arrays *arrays;

	if (!context)
		return;
	if (i >= sizeof(array_interleaved) / sizeof(array_interleaved[0])) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	if (stride < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	arrays = &context->client.arrays;
	if (!stride)
		stride = array_interleaved[i].stride;
	array_interleave(context, &arrays->texcoord[arrays->active], array_interleaved[i].texcoord,
			 GL_FLOAT, stride, pointer, 0);
	array_interleave(context, &arrays->colour, array_interleaved[i].colour,
			 array_interleaved[i].colour_type, stride, pointer,
			 array_interleaved[i].colour_at);
	array_interleave(context, &arrays->normal, array_interleaved[i].normal ? 3 : 0, GL_FLOAT,
			 stride, pointer, array_interleaved[i].normal_at);
	array_interleave(context, &arrays->position, array_interleaved[i].position, GL_FLOAT,
			 stride, pointer, array_interleaved[i].position_at);
	arrays->index.enabled = GL_FALSE;
	arrays->edge.enabled = GL_FALSE;
	arrays->secondary.enabled = GL_FALSE;
	arrays->fog.enabled = GL_FALSE;
}

void gl_LockArraysEXT(GLint first, GLsizei count)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (context->client.arrays.lock_count) {
		gloss_error(context, GL_INVALID_OPERATION);
	} else if (first < 0 || count <= 0) {
		gloss_error(context, GL_INVALID_VALUE);
	} else {
		context->client.arrays.lock_first = first;
		context->client.arrays.lock_count = count;
	}
}

void gl_UnlockArraysEXT(void)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (!context->client.arrays.lock_count)
		gloss_error(context, GL_INVALID_OPERATION);
	context->client.arrays.lock_first = 0;
	context->client.arrays.lock_count = 0;
}
