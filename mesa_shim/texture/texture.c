// SPDX-License-Identifier: MIT
/* Textures and their names: glGenTextures to glDeleteTextures, and which one a command is about. */
#include "texture/texture.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "draw/shared.h"
#include "state/command.h"

static const struct gloss_sampler texture_sampler = {
	.min = GL_NEAREST_MIPMAP_LINEAR,
	.mag = GL_LINEAR,
	.wrap = { GL_REPEAT, GL_REPEAT, GL_REPEAT },
	.depth_mode = GL_LUMINANCE,
	.compare_func = GL_LEQUAL,
	.priority = 1,
	.min_lod = -1000,
	.max_lod = 1000,
	.most = 1000,
};

/* A rectangle has no smaller images, and is not repeated. */
static void texture_set_kind(struct gloss_texture *texture, int kind)
{
	texture->kind = kind;
	if (kind != GLOSS_TEXTURE_RECTANGLE)
		return;
	texture->sampler.min = GL_LINEAR;
	for (int i = 0; i < 3; i++)
		texture->sampler.wrap[i] = GL_CLAMP_TO_EDGE;
}

static struct gloss_texture *texture_new(GLuint name, int kind)
{
	struct gloss_texture *texture = calloc(1, sizeof(*texture));

	if (!texture)
		return NULL;
	texture->references = 1;
	texture->name = name;
	texture->sampler = texture_sampler;
	texture_set_kind(texture, kind);
	return texture;
}

void gloss_texture_free(struct gloss_texture *texture)
{
	if (!texture)
		return;
	for (int face = 0; face < GLOSS_TEXTURE_FACES; face++)
		for (int level = 0; level < GLOSS_TEXTURE_LEVELS; level++)
			free(texture->image[face][level].texel);
	free(texture);
}

/* With the lock of the names. */
static void texture_unref(struct gloss_texture *texture)
{
	if (texture && !--texture->references)
		gloss_texture_free(texture);
}

/* ---- of a context ---- */

/* The context's place for the texture takes another, which has a reference for it. */
static void texture_bind(struct gloss_context *context, int unit, int kind,
			 struct gloss_texture *texture)
{
	struct gloss_texture **bound = &context->textures.bound[unit][kind];

	pthread_mutex_lock(&context->shared->lock);
	texture_unref(*bound);
	pthread_mutex_unlock(&context->shared->lock);
	*bound = texture;
	context->attributes.texturing.unit[unit].bound[kind] = (GLint)texture->name;
}

static struct gloss_texture *texture_initial(struct gloss_context *context, int kind)
{
	struct gloss_texture *texture = context->textures.initial[kind];

	pthread_mutex_lock(&context->shared->lock);
	texture->references++;
	pthread_mutex_unlock(&context->shared->lock);
	return texture;
}

bool gloss_textures_init(struct gloss_context *context)
{
	struct gloss_textures *textures = &context->textures;

	for (int kind = 0; kind < GLOSS_TEXTURE_KINDS; kind++) {
		textures->initial[kind] = texture_new(0, kind);
		textures->proxy[kind] = texture_new(0, kind);
		if (!textures->initial[kind] || !textures->proxy[kind])
			return false;
		for (int unit = 0; unit < GLOSS_UNITS; unit++)
			textures->bound[unit][kind] = texture_initial(context, kind);
	}
	return true;
}

void gloss_textures_fini(struct gloss_context *context)
{
	struct gloss_textures *textures = &context->textures;

	pthread_mutex_lock(&context->shared->lock);
	for (int kind = 0; kind < GLOSS_TEXTURE_KINDS; kind++) {
		texture_unref(textures->initial[kind]);
		texture_unref(textures->proxy[kind]);
		for (int unit = 0; unit < GLOSS_UNITS; unit++)
			texture_unref(textures->bound[unit][kind]);
	}
	pthread_mutex_unlock(&context->shared->lock);
}

/* The texture of this name with a reference, made if there is none, and of its kind from now on.
 * NULL: there is an error. */
static struct gloss_texture *texture_take(struct gloss_context *context, GLuint name, int kind)
{
	struct gloss_names *names = &context->shared->textures;
	struct gloss_texture *texture;
	GLenum error = GL_NO_ERROR;

	if (!name)
		return texture_initial(context, kind);
	pthread_mutex_lock(&context->shared->lock);
	texture = gloss_names_find(names, name);
	if (!texture) {
		texture = texture_new(name, kind);
		if (texture && !gloss_names_set(names, name, texture)) {
			gloss_texture_free(texture);
			texture = NULL;
		}
		error = texture ? GL_NO_ERROR : GL_OUT_OF_MEMORY;
	} else if (texture->kind < 0) {
		texture_set_kind(texture, kind);
	} else if (texture->kind != kind) {
		error = GL_INVALID_OPERATION;
	}
	if (error == GL_NO_ERROR)
		texture->references++;
	pthread_mutex_unlock(&context->shared->lock);
	gloss_error(context, error);
	return error == GL_NO_ERROR ? texture : NULL;
}

void gloss_textures_rebind(struct gloss_context *context)
{
	for (int unit = 0; unit < GLOSS_UNITS; unit++)
		for (int kind = 0; kind < GLOSS_TEXTURE_KINDS; kind++) {
			GLint *name = &context->attributes.texturing.unit[unit].bound[kind];
			struct gloss_texture *texture = context->textures.bound[unit][kind];

			if ((GLuint)*name == texture->name)
				continue;
			texture = texture_take(context, (GLuint)*name, kind);
			if (texture)
				texture_bind(context, unit, kind, texture);
			else
				*name = (GLint)context->textures.bound[unit][kind]->name;
		}
}

void gloss_texture_lock(struct gloss_context *context)
{
	pthread_mutex_lock(&context->shared->image_lock);
}

void gloss_texture_unlock(struct gloss_context *context)
{
	pthread_mutex_unlock(&context->shared->image_lock);
}

/* ---- targets ---- */

int gloss_texture_kind(GLenum target)
{
	switch (target) {
	case GL_TEXTURE_1D:
		return GLOSS_TEXTURE_1D;
	case GL_TEXTURE_2D:
		return GLOSS_TEXTURE_2D;
	case GL_TEXTURE_3D:
		return GLOSS_TEXTURE_3D;
	case GL_TEXTURE_CUBE_MAP:
		return GLOSS_TEXTURE_CUBE;
	case GL_TEXTURE_RECTANGLE:
		return GLOSS_TEXTURE_RECTANGLE;
	default:
		return -1;
	}
}

static int texture_proxy_kind(GLenum target)
{
	switch (target) {
	case GL_PROXY_TEXTURE_1D:
		return GLOSS_TEXTURE_1D;
	case GL_PROXY_TEXTURE_2D:
		return GLOSS_TEXTURE_2D;
	case GL_PROXY_TEXTURE_3D:
		return GLOSS_TEXTURE_3D;
	case GL_PROXY_TEXTURE_CUBE_MAP:
		return GLOSS_TEXTURE_CUBE;
	case GL_PROXY_TEXTURE_RECTANGLE:
		return GLOSS_TEXTURE_RECTANGLE;
	default:
		return -1;
	}
}

static int texture_dimensions(int kind)
{
	return kind == GLOSS_TEXTURE_1D ? 1 : kind == GLOSS_TEXTURE_3D ? 3 : 2;
}

bool gloss_texture_find(struct gloss_context *context, GLenum target, int dimensions,
			struct gloss_texture_place *place)
{
	const GLint unit = context->attributes.texturing.active;
	const GLuint face = target - GL_TEXTURE_CUBE_MAP_POSITIVE_X;
	int kind = target == GL_TEXTURE_CUBE_MAP ? -1 : gloss_texture_kind(target);

	*place = (struct gloss_texture_place){ 0 };
	if (face < GLOSS_TEXTURE_FACES) {
		place->face = (int)face;
		kind = GLOSS_TEXTURE_CUBE;
	} else if (kind < 0) {
		place->proxy = true;
		kind = texture_proxy_kind(target);
	}
	if (kind < 0 || (dimensions && texture_dimensions(kind) != dimensions))
		return false;
	place->texture = place->proxy ? context->textures.proxy[kind] :
					context->textures.bound[unit][kind];
	return true;
}

int gloss_texture_levels(int kind)
{
	switch (kind) {
	case GLOSS_TEXTURE_3D:
		return 8;
	case GLOSS_TEXTURE_CUBE:
		return 11;
	case GLOSS_TEXTURE_RECTANGLE:
		return 1;
	default:
		return GLOSS_TEXTURE_LEVELS;
	}
}

/* ---- commands ---- */

void gl_GenTextures(GLsizei n, GLuint *textures)
{
	struct gloss_context *context = gloss_outside();
	struct gloss_texture *texture;
	GLuint first;
	bool ok;

	if (!context)
		return;
	if (n < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	pthread_mutex_lock(&context->shared->lock);
	first = gloss_names_free_range(&context->shared->textures, (GLuint)n);
	ok = first;
	for (GLsizei i = 0; i < n && ok; i++) {
		textures[i] = first + (GLuint)i;
		texture = texture_new(textures[i], -1);
		ok = texture && gloss_names_set(&context->shared->textures, textures[i], texture);
		if (!ok)
			gloss_texture_free(texture);
	}
	pthread_mutex_unlock(&context->shared->lock);
	if (!ok)
		gloss_error(context, GL_OUT_OF_MEMORY);
}

GLOSS_LISTED2(BindTexture, GLenum, target, GLuint, name)
{
	const GLint unit = context->attributes.texturing.active;
	const int kind = gloss_texture_kind(target);
	struct gloss_texture *texture;

	if (kind < 0) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	texture = texture_take(context, name, kind);
	if (!texture)
		return;
	if (texture != context->textures.bound[unit][kind])
		gloss_change(context, GLOSS_DIRTY_FRAGMENT);
	texture_bind(context, unit, kind, texture);
}

/* What this context has bound; another one keeps it until it binds something else. */
static void texture_unbind(struct gloss_context *context, const struct gloss_texture *texture)
{
	for (int unit = 0; unit < GLOSS_UNITS; unit++)
		for (int kind = 0; kind < GLOSS_TEXTURE_KINDS; kind++)
			if (context->textures.bound[unit][kind] == texture)
				texture_bind(context, unit, kind, texture_initial(context, kind));
}

void gl_DeleteTextures(GLsizei n, const GLuint *textures)
{
	struct gloss_context *context = gloss_outside_ordered();
	struct gloss_texture *texture;

	if (!context)
		return;
	if (n < 0)
		gloss_error(context, GL_INVALID_VALUE);
	for (GLsizei i = 0; i < n; i++) {
		pthread_mutex_lock(&context->shared->lock);
		texture = gloss_names_find(&context->shared->textures, textures[i]);
		if (texture)
			gloss_names_set(&context->shared->textures, textures[i], NULL);
		pthread_mutex_unlock(&context->shared->lock);
		if (!texture)
			continue;
		texture_unbind(context, texture);
		pthread_mutex_lock(&context->shared->lock);
		texture_unref(texture);
		pthread_mutex_unlock(&context->shared->lock);
	}
}

/* Whether there is a texture of this name, which it is once it was bound. */
static bool texture_is(struct gloss_context *context, GLuint name)
{
	const struct gloss_texture *texture;
	bool is;

	pthread_mutex_lock(&context->shared->lock);
	texture = gloss_names_find(&context->shared->textures, name);
	is = texture && texture->kind >= 0;
	pthread_mutex_unlock(&context->shared->lock);
	return is;
}

GLboolean gl_IsTexture(GLuint texture)
{
	struct gloss_context *context = gloss_outside();

	return context && texture_is(context, texture);
}

/* All are in the memory of the library. */
GLboolean gl_AreTexturesResident(GLsizei n, const GLuint *textures, GLboolean *residences)
{
	struct gloss_context *context = gloss_outside();

	(void)residences; /* it is written if one is not */
	if (!context)
		return GL_FALSE;
	if (n < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return GL_FALSE;
	}
	for (GLsizei i = 0; i < n; i++)
		if (!texture_is(context, textures[i])) {
			gloss_error(context, GL_INVALID_VALUE);
			return GL_FALSE;
		}
	return GL_TRUE;
}

GLOSS_LISTED2(PrioritizeTexture, GLuint, name, GLclampf, priority)
{
	struct gloss_texture *texture;

	pthread_mutex_lock(&context->shared->lock);
	texture = gloss_names_find(&context->shared->textures, name);
	if (texture && texture->kind >= 0)
		texture->sampler.priority = fminf(fmaxf(priority, 0), 1);
	pthread_mutex_unlock(&context->shared->lock);
}

void gl_PrioritizeTextures(GLsizei n, const GLuint *textures, const GLfloat *priorities)
{
	struct gloss_context *context = gloss_current();

	if (!context)
		return;
	if (n < 0)
		gloss_error(context,
			    context->vertices->inside ? GL_INVALID_OPERATION : GL_INVALID_VALUE);
	for (GLsizei i = 0; i < n; i++)
		gl_PrioritizeTexture(textures[i], priorities[i]);
}
