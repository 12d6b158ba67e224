// SPDX-License-Identifier: MIT
/* glTexParameter and glGetTexParameter. */
#include <math.h>
#include <string.h>

#include "draw/batch.h"
#include "state/command.h"
#include "state/get.h"
#include "state/parameter.h"
#include "texture/texture.h"

static bool parameter_is_filter(GLenum value, bool mips)
{
	if (value == GL_NEAREST || value == GL_LINEAR)
		return true;
	return mips && value >= GL_NEAREST_MIPMAP_NEAREST && value <= GL_LINEAR_MIPMAP_LINEAR;
}

static bool parameter_is_wrap(GLenum value)
{
	return value == GL_REPEAT || value == GL_CLAMP || value == GL_CLAMP_TO_EDGE ||
	       value == GL_CLAMP_TO_BORDER || value == GL_MIRRORED_REPEAT;
}

static bool parameter_is_depth_mode(GLenum value)
{
	return value == GL_LUMINANCE || value == GL_INTENSITY || value == GL_ALPHA;
}

/* Where a parameter that is an enum is kept, and whether it may have @value. NULL: it is none. */
static GLenum *parameter_enum(struct gloss_sampler *sampler, GLenum pname, GLenum value, bool *may)
{
	switch (pname) {
	case GL_TEXTURE_MIN_FILTER:
		*may = parameter_is_filter(value, true);
		return &sampler->min;
	case GL_TEXTURE_MAG_FILTER:
		*may = parameter_is_filter(value, false);
		return &sampler->mag;
	case GL_TEXTURE_WRAP_S:
		*may = parameter_is_wrap(value);
		return &sampler->wrap[0];
	case GL_TEXTURE_WRAP_T:
		*may = parameter_is_wrap(value);
		return &sampler->wrap[1];
	case GL_TEXTURE_WRAP_R:
		*may = parameter_is_wrap(value);
		return &sampler->wrap[2];
	case GL_DEPTH_TEXTURE_MODE:
		*may = parameter_is_depth_mode(value);
		return &sampler->depth_mode;
	case GL_TEXTURE_COMPARE_MODE:
		*may = value == GL_NONE || value == GL_COMPARE_R_TO_TEXTURE;
		return &sampler->compare_mode;
	case GL_TEXTURE_COMPARE_FUNC:
		*may = value >= GL_NEVER && value <= GL_ALWAYS;
		return &sampler->compare_func;
	default:
		return NULL;
	}
}

static GLint *parameter_level(struct gloss_sampler *sampler, GLenum pname)
{
	if (pname == GL_TEXTURE_BASE_LEVEL)
		return &sampler->base;
	return pname == GL_TEXTURE_MAX_LEVEL ? &sampler->most : NULL;
}

static GLfloat *parameter_float(struct gloss_sampler *sampler, GLenum pname)
{
	switch (pname) {
	case GL_TEXTURE_MIN_LOD:
		return &sampler->min_lod;
	case GL_TEXTURE_MAX_LOD:
		return &sampler->max_lod;
	case GL_TEXTURE_PRIORITY:
		return &sampler->priority;
	default:
		return NULL;
	}
}

/* Those in [0, 1]. */
static void parameter_clamp(GLfloat *value, unsigned int count)
{
	for (unsigned int i = 0; i < count; i++)
		value[i] = fminf(fmaxf(value[i], 0), 1);
}

/* What is no enum. */
static GLenum parameter_set_number(struct gloss_sampler *sampler, GLenum pname,
				   struct gloss_vector value)
{
	GLint *level = parameter_level(sampler, pname);
	GLfloat *number = parameter_float(sampler, pname);

	if (pname == GL_TEXTURE_BORDER_COLOR) {
		parameter_clamp(value.v, 4);
		memcpy(sampler->border, value.v, sizeof(sampler->border));
	} else if (pname == GL_GENERATE_MIPMAP) {
		sampler->generate = value.v[0] != 0;
	} else if (level) {
		if (!(value.v[0] >= 0))
			return GL_INVALID_VALUE;
		*level = (GLint)fminf(value.v[0] + 0.5f, 1000);
	} else if (number) {
		if (pname == GL_TEXTURE_PRIORITY)
			parameter_clamp(value.v, 1);
		*number = value.v[0];
	} else {
		return GL_INVALID_ENUM;
	}
	return GL_NO_ERROR;
}

/* What a rectangle can not be. */
static bool parameter_is_refused(GLenum target, GLenum pname, GLenum value)
{
	if (target != GL_TEXTURE_RECTANGLE)
		return false;
	return (pname == GL_TEXTURE_MIN_FILTER && value >= GL_NEAREST_MIPMAP_NEAREST) ||
	       value == GL_REPEAT || value == GL_MIRRORED_REPEAT;
}

/* The sampler of the texture that is bound; NULL: there is an error. */
static struct gloss_sampler *parameter_sampler(struct gloss_context *context, GLenum target)
{
	const GLint unit = context->attributes.texturing.active;
	const int kind = gloss_texture_kind(target);

	if (kind >= 0)
		return &context->textures.bound[unit][kind]->sampler;
	gloss_error(context, GL_INVALID_ENUM);
	return NULL;
}

GLOSS_LISTED3(TexParameterVector, GLenum, target, GLenum, pname, struct gloss_vector, value)
{
	struct gloss_sampler *sampler = parameter_sampler(context, target);
	const GLenum given = gloss_parameter_enum(value.v[0]);
	bool may = false;
	GLenum *at;

	if (!sampler)
		return;
	gloss_batch_draw(context);
	at = parameter_enum(sampler, pname, given, &may);
	if (!at)
		gloss_error(context, parameter_set_number(sampler, pname, value));
	else if (may && !parameter_is_refused(target, pname, given))
		*at = given;
	else
		gloss_error(context, GL_INVALID_ENUM);
}

static unsigned int parameter_count(GLenum pname)
{
	return pname == GL_TEXTURE_BORDER_COLOR ? 4 : 1;
}

void gl_TexParameterfv(GLenum target, GLenum pname, const GLfloat *params)
{
	gl_TexParameterVector(target, pname,
			      gloss_parameter_floats(params, parameter_count(pname)));
}

void gl_TexParameteriv(GLenum target, GLenum pname, const GLint *params)
{
	const bool unit = pname == GL_TEXTURE_BORDER_COLOR || pname == GL_TEXTURE_PRIORITY;

	gl_TexParameterVector(target, pname,
			      gloss_parameter_integers(params, parameter_count(pname), unit));
}

void gl_TexParameterf(GLenum target, GLenum pname, GLfloat param)
{
	gl_TexParameterVector(target, parameter_count(pname) == 1 ? pname : GL_NONE,
			      gloss_parameter_floats(&param, 1));
}

void gl_TexParameteri(GLenum target, GLenum pname, GLint param)
{
	gl_TexParameterVector(target, parameter_count(pname) == 1 ? pname : GL_NONE,
			      gloss_parameter_integers(&param, 1, pname == GL_TEXTURE_PRIORITY));
}

static struct gloss_values parameter_values(struct gloss_sampler *sampler, GLenum pname)
{
	struct gloss_values values = { .kind = GLOSS_INTEGER, .count = 1 };
	bool may;
	const GLenum *at = parameter_enum(sampler, pname, 0, &may);
	const GLint *level = parameter_level(sampler, pname);
	const GLfloat *number = parameter_float(sampler, pname);

	if (at) {
		values.value[0] = *at;
	} else if (level) {
		values.value[0] = *level;
	} else if (number) {
		values.kind = pname == GL_TEXTURE_PRIORITY ? GLOSS_UNIT_FLOAT : GLOSS_FLOAT;
		values.value[0] = (double)*number;
	} else if (pname == GL_GENERATE_MIPMAP || pname == GL_TEXTURE_RESIDENT) {
		values.value[0] = pname == GL_TEXTURE_RESIDENT || sampler->generate;
	} else if (pname == GL_TEXTURE_BORDER_COLOR) {
		values.kind = GLOSS_UNIT_FLOAT;
		values.count = 4;
		for (int i = 0; i < 4; i++)
			values.value[i] = (double)sampler->border[i];
	} else {
		values.count = 0;
	}
	return values;
}

static struct gloss_values parameter_get(GLenum target, GLenum pname)
{
	struct gloss_context *context = gloss_outside();
	struct gloss_sampler *sampler = context ? parameter_sampler(context, target) : NULL;
	struct gloss_values values = { .count = 0 };

	if (!sampler)
		return values;
	values = parameter_values(sampler, pname);
	if (!values.count)
		gloss_error(context, GL_INVALID_ENUM);
	return values;
}

void gl_GetTexParameterfv(GLenum target, GLenum pname, GLfloat *params)
{
	const struct gloss_values values = parameter_get(target, pname);

	for (unsigned int i = 0; i < values.count; i++)
		params[i] = (GLfloat)values.value[i];
}

void gl_GetTexParameteriv(GLenum target, GLenum pname, GLint *params)
{
	const struct gloss_values values = parameter_get(target, pname);

	for (unsigned int i = 0; i < values.count; i++)
		params[i] = gloss_get_integer(values.kind, values.value[i]);
}
