// SPDX-License-Identifier: MIT
#include "draw/buffer.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "draw/shared.h"
#include "state/command.h"

struct gloss_buffer *gloss_buffer_find(struct gloss_context *context, int name)
{
	struct gloss_buffer *buffer;

	pthread_mutex_lock(&context->shared->lock);
	buffer = gloss_names_find(&context->shared->buffers, (uint32_t)name);
	pthread_mutex_unlock(&context->shared->lock);
	return buffer;
}

void gloss_buffer_free(struct gloss_buffer *buffer)
{
	if (buffer)
		free(buffer->data);
	free(buffer);
}

/* An empty buffer of this name, unless there is one. False: out of memory. */
static bool buffer_make(struct gloss_shared *shared, GLuint name)
{
	struct gloss_buffer *made;
	bool ok = true;

	if (!name || gloss_names_find(&shared->buffers, name))
		return true;
	made = calloc(1, sizeof(*made));
	if (made) {
		made->usage = GL_STATIC_DRAW;
		ok = gloss_names_set(&shared->buffers, name, made);
	}
	if (!ok)
		free(made);
	return made && ok;
}

void gl_GenBuffers(GLsizei n, GLuint *buffers)
{
	struct gloss_context *context = gloss_outside();
	GLuint first;
	bool ok = true;

	if (!context)
		return;
	if (n < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	pthread_mutex_lock(&context->shared->lock);
	first = gloss_names_free_range(&context->shared->buffers, (GLuint)n);
	for (GLsizei i = 0; i < n; i++) {
		buffers[i] = first + (GLuint)i;
		ok = ok && buffer_make(context->shared, buffers[i]);
	}
	pthread_mutex_unlock(&context->shared->lock);
	if (!ok)
		gloss_error(context, GL_OUT_OF_MEMORY);
}

static void buffer_unbind(struct gloss_context *context, GLint name)
{
	struct gloss_arrays *arrays = &context->client.arrays;

	if (arrays->array_buffer == name)
		arrays->array_buffer = 0;
	if (arrays->element_buffer == name)
		arrays->element_buffer = 0;
}

void gl_DeleteBuffers(GLsizei n, const GLuint *buffers)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	if (n < 0)
		gloss_error(context, GL_INVALID_VALUE);
	for (GLsizei i = 0; i < n; i++) {
		struct gloss_buffer *buffer = gloss_buffer_find(context, (int)buffers[i]);

		if (!buffer)
			continue;
		buffer_unbind(context, (GLint)buffers[i]);
		pthread_mutex_lock(&context->shared->lock);
		gloss_names_set(&context->shared->buffers, buffers[i], NULL);
		pthread_mutex_unlock(&context->shared->lock);
		gloss_buffer_free(buffer);
	}
}

GLboolean gl_IsBuffer(GLuint buffer)
{
	struct gloss_context *context = gloss_outside();

	return context && gloss_buffer_find(context, (int)buffer);
}

static GLint *buffer_binding(struct gloss_context *context, GLenum target)
{
	if (target == GL_ARRAY_BUFFER)
		return &context->client.arrays.array_buffer;
	if (target == GL_ELEMENT_ARRAY_BUFFER)
		return &context->client.arrays.element_buffer;
	gloss_error(context, GL_INVALID_ENUM);
	return NULL;
}

void gl_BindBuffer(GLenum target, GLuint buffer)
{
	struct gloss_context *context = gloss_outside();
	GLint *binding = context ? buffer_binding(context, target) : NULL;
	bool made;

	if (!binding)
		return;
	pthread_mutex_lock(&context->shared->lock);
	made = buffer_make(context->shared, buffer);
	pthread_mutex_unlock(&context->shared->lock);
	if (made)
		*binding = (GLint)buffer;
	else
		gloss_error(context, GL_OUT_OF_MEMORY);
}

/* The buffer that is bound; NULL and an error: there is none. */
static struct gloss_buffer *buffer_bound(GLenum target, struct gloss_context **out)
{
	struct gloss_context *context = gloss_outside();
	const GLint *binding = context ? buffer_binding(context, target) : NULL;
	struct gloss_buffer *buffer;

	*out = context;
	if (!binding)
		return NULL;
	buffer = gloss_buffer_find(context, *binding);
	if (!buffer)
		gloss_error(context, GL_INVALID_OPERATION);
	return buffer;
}

void gl_BufferData(GLenum target, GLsizeiptr size, const void *data, GLenum usage)
{
	struct gloss_context *context;
	struct gloss_buffer *buffer = buffer_bound(target, &context);
	uint8_t *copy;

	if (!buffer)
		return;
	if (size < 0 || usage < GL_STREAM_DRAW || usage > GL_DYNAMIC_COPY || usage % 4 == 3) {
		gloss_error(context, size < 0 ? GL_INVALID_VALUE : GL_INVALID_ENUM);
		return;
	}
	copy = calloc(1, (size_t)size + 1);
	if (!copy) {
		gloss_error(context, GL_OUT_OF_MEMORY);
		return;
	}
	if (data)
		memcpy(copy, data, (size_t)size);
	free(buffer->data);
	*buffer = (struct gloss_buffer){ .data = copy, .size = (size_t)size, .usage = usage };
}

/* Bytes of a buffer that is not mapped; NULL and an error: they are not there. */
static uint8_t *buffer_part(GLenum target, GLintptr offset, GLsizeiptr size)
{
	struct gloss_context *context;
	struct gloss_buffer *buffer = buffer_bound(target, &context);

	if (!buffer)
		return NULL;
	if (offset < 0 || size < 0 || (size_t)offset > buffer->size ||
	    (size_t)size > buffer->size - (size_t)offset) {
		gloss_error(context, GL_INVALID_VALUE);
		return NULL;
	}
	if (buffer->access) {
		gloss_error(context, GL_INVALID_OPERATION);
		return NULL;
	}
	return buffer->data ? buffer->data + offset : NULL;
}

void gl_BufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, const void *data)
{
	uint8_t *part = buffer_part(target, offset, size);

	if (part)
		memcpy(part, data, (size_t)size);
}

void gl_GetBufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, void *data)
{
	const uint8_t *part = buffer_part(target, offset, size);

	if (part)
		memcpy(data, part, (size_t)size);
}

void *gl_MapBuffer(GLenum target, GLenum access)
{
	struct gloss_context *context;
	struct gloss_buffer *buffer = buffer_bound(target, &context);

	if (!buffer)
		return NULL;
	if (access != GL_READ_ONLY && access != GL_WRITE_ONLY && access != GL_READ_WRITE) {
		gloss_error(context, GL_INVALID_ENUM);
		return NULL;
	}
	if (buffer->access) {
		gloss_error(context, GL_INVALID_OPERATION);
		return NULL;
	}
	buffer->access = access;
	return buffer->data;
}

GLboolean gl_UnmapBuffer(GLenum target)
{
	struct gloss_context *context;
	struct gloss_buffer *buffer = buffer_bound(target, &context);

	if (!buffer)
		return GL_FALSE;
	if (!buffer->access) {
		gloss_error(context, GL_INVALID_OPERATION);
		return GL_FALSE;
	}
	buffer->access = 0;
	return GL_TRUE;
}

void gl_GetBufferParameteriv(GLenum target, GLenum pname, GLint *params)
{
	struct gloss_context *context;
	const struct gloss_buffer *buffer = buffer_bound(target, &context);

	if (!buffer)
		return;
	if (pname == GL_BUFFER_SIZE)
		*params = (GLint)buffer->size;
	else if (pname == GL_BUFFER_USAGE)
		*params = (GLint)buffer->usage;
	else if (pname == GL_BUFFER_ACCESS)
		*params = (GLint)(buffer->access ? buffer->access : GL_READ_WRITE);
	else if (pname == GL_BUFFER_MAPPED)
		*params = buffer->access != 0;
	else
		gloss_error(context, GL_INVALID_ENUM);
}

void gl_GetBufferPointerv(GLenum target, GLenum pname, void **params)
{
	struct gloss_context *context;
	const struct gloss_buffer *buffer = buffer_bound(target, &context);

	if (!buffer)
		return;
	if (pname == GL_BUFFER_MAP_POINTER)
		*params = buffer->access ? buffer->data : NULL;
	else
		gloss_error(context, GL_INVALID_ENUM);
}
