// SPDX-License-Identifier: MIT
#include "draw/buffer.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "draw/shared.h"
#include "state/command.h"

struct gloss_buffer *gloss_buffer_find(const struct gloss_context *context, int name)
{
	return gloss_names_find(&context->shared->buffers, (uint32_t)name);
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
	bool ok;

	if (!context)
		return;
	if (n < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	pthread_rwlock_wrlock(&context->shared->buffer_lock);
	first = gloss_names_free_range(&context->shared->buffers, (GLuint)n);
	ok = first;
	for (GLsizei i = 0; ok && i < n; i++) {
		buffers[i] = first + (GLuint)i;
		ok = buffer_make(context->shared, buffers[i]);
	}
	pthread_rwlock_unlock(&context->shared->buffer_lock);
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
		struct gloss_buffer *buffer;

		buffer_unbind(context, (GLint)buffers[i]);
		pthread_rwlock_wrlock(&context->shared->buffer_lock);
		buffer = gloss_buffer_find(context, (int)buffers[i]);
		gloss_names_set(&context->shared->buffers, buffers[i], NULL);
		pthread_rwlock_unlock(&context->shared->buffer_lock);
		gloss_buffer_free(buffer);
	}
}

GLboolean gl_IsBuffer(GLuint buffer)
{
	struct gloss_context *context = gloss_outside();
	bool is;

	if (!context)
		return GL_FALSE;
	pthread_rwlock_rdlock(&context->shared->buffer_lock);
	is = gloss_buffer_find(context, (int)buffer);
	pthread_rwlock_unlock(&context->shared->buffer_lock);
	return is;
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
	pthread_rwlock_wrlock(&context->shared->buffer_lock);
	made = buffer_make(context->shared, buffer);
	pthread_rwlock_unlock(&context->shared->buffer_lock);
	if (made)
		*binding = (GLint)buffer;
	else
		gloss_error(context, GL_OUT_OF_MEMORY);
}

/*
 * The buffer that is bound, in @out, for this thread alone until buffer_close; NULL and an error:
 * there is none.
 */
static struct gloss_context *buffer_open(GLenum target, struct gloss_buffer **out)
{
	struct gloss_context *context = gloss_outside();
	const GLint *binding = context ? buffer_binding(context, target) : NULL;

	if (!binding)
		return NULL;
	pthread_rwlock_wrlock(&context->shared->buffer_lock);
	*out = gloss_buffer_find(context, *binding);
	if (*out)
		return context;
	pthread_rwlock_unlock(&context->shared->buffer_lock);
	gloss_error(context, GL_INVALID_OPERATION);
	return NULL;
}

static void buffer_close(struct gloss_context *context)
{
	pthread_rwlock_unlock(&context->shared->buffer_lock);
}

/* False: out of memory, and the buffer is as it was. @data NULL: zeroes. */
static bool buffer_fill(struct gloss_buffer *buffer, size_t size, const void *data, GLenum usage)
{
	/* Its address says that there is data also where the size is 0. */
	uint8_t *copy = data ? malloc(size + 1) : calloc(1, size + 1);

	if (!copy)
		return false;
	if (data)
		memcpy(copy, data, size);
	free(buffer->data);
	*buffer = (struct gloss_buffer){ .data = copy, .size = size, .usage = usage };
	return true;
}

void gl_BufferData(GLenum target, GLsizeiptr size, const void *data, GLenum usage)
{
	struct gloss_buffer *buffer;
	struct gloss_context *context = buffer_open(target, &buffer);

	if (!context)
		return;
	if (usage < GL_STREAM_DRAW || usage > GL_DYNAMIC_COPY || usage % 4 == 3)
		gloss_error(context, GL_INVALID_ENUM);
	else if (size < 0)
		gloss_error(context, GL_INVALID_VALUE);
	else if (!buffer_fill(buffer, (size_t)size, data, usage))
		gloss_error(context, GL_OUT_OF_MEMORY);
	buffer_close(context);
}

/* Those bytes; NULL and an error: they are not there, or mapped. */
static uint8_t *buffer_part(struct gloss_context *context, const struct gloss_buffer *buffer,
			    GLintptr offset, GLsizeiptr size)
{
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
	struct gloss_buffer *buffer;
	struct gloss_context *context = buffer_open(target, &buffer);
	uint8_t *part;

	if (!context)
		return;
	part = buffer_part(context, buffer, offset, size);
	if (part && size)
		memcpy(part, data, (size_t)size);
	buffer_close(context);
}

void gl_GetBufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, void *data)
{
	struct gloss_buffer *buffer;
	struct gloss_context *context = buffer_open(target, &buffer);
	const uint8_t *part;

	if (!context)
		return;
	part = buffer_part(context, buffer, offset, size);
	if (part && size)
		memcpy(data, part, (size_t)size);
	buffer_close(context);
}

void *gl_MapBuffer(GLenum target, GLenum access)
{
	struct gloss_buffer *buffer;
	struct gloss_context *context = buffer_open(target, &buffer);
	void *data = NULL;

	if (!context)
		return NULL;
	if (access != GL_READ_ONLY && access != GL_WRITE_ONLY && access != GL_READ_WRITE) {
		gloss_error(context, GL_INVALID_ENUM);
	} else if (buffer->access || !buffer->data) {
		gloss_error(context, buffer->access ? GL_INVALID_OPERATION : GL_OUT_OF_MEMORY);
	} else {
		buffer->access = access;
		data = buffer->data;
	}
	buffer_close(context);
	return data;
}

GLboolean gl_UnmapBuffer(GLenum target)
{
	struct gloss_buffer *buffer;
	struct gloss_context *context = buffer_open(target, &buffer);
	bool mapped;

	if (!context)
		return GL_FALSE;
	mapped = buffer->access;
	if (!mapped)
		gloss_error(context, GL_INVALID_OPERATION);
	buffer->access = 0;
	buffer_close(context);
	return mapped;
}

void gl_GetBufferParameteriv(GLenum target, GLenum pname, GLint *params)
{
	struct gloss_buffer *buffer;
	struct gloss_context *context = buffer_open(target, &buffer);

	if (!context)
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
	buffer_close(context);
}

void gl_GetBufferPointerv(GLenum target, GLenum pname, void **params)
{
	struct gloss_buffer *buffer;
	struct gloss_context *context = buffer_open(target, &buffer);

	if (!context)
		return;
	if (pname == GL_BUFFER_MAP_POINTER)
		*params = buffer->access ? buffer->data : NULL;
	else
		gloss_error(context, GL_INVALID_ENUM);
	buffer_close(context);
}
