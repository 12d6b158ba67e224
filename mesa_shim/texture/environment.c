// SPDX-License-Identifier: MIT
/* glTexEnv and glGetTexEnv: what becomes of texels, of each unit. */
#include <math.h>
#include <string.h>

#include "draw/batch.h"
#include "state/command.h"
#include "state/get.h"
#include "state/parameter.h"

/* A name of glTexEnv of this target. */
static bool environment_has(GLenum target, GLenum pname)
{
	switch (target) {
	case GL_TEXTURE_ENV:
		return pname != GL_TEXTURE_LOD_BIAS && pname != GL_COORD_REPLACE;
	case GL_TEXTURE_FILTER_CONTROL:
		return pname == GL_TEXTURE_LOD_BIAS;
	case GL_POINT_SPRITE:
		return pname == GL_COORD_REPLACE;
	default:
		return false;
	}
}

static bool environment_is_mode(GLenum value)
{
	return value == GL_MODULATE || value == GL_REPLACE || value == GL_DECAL ||
	       value == GL_BLEND || value == GL_ADD || value == GL_COMBINE;
}

static bool environment_is_combine(GLenum value, bool alpha)
{
	switch (value) {
	case GL_REPLACE:
	case GL_MODULATE:
	case GL_ADD:
	case GL_ADD_SIGNED:
	case GL_INTERPOLATE:
	case GL_SUBTRACT:
		return true;
	default:
		return !alpha && (value == GL_DOT3_RGB || value == GL_DOT3_RGBA);
	}
}

static bool environment_is_source(GLenum value)
{
	return value == GL_TEXTURE || value == GL_CONSTANT || value == GL_PRIMARY_COLOR ||
	       value == GL_PREVIOUS || value - GL_TEXTURE0 < GLOSS_UNITS;
}

static bool environment_is_operand(GLenum value, bool alpha)
{
	if (value == GL_SRC_ALPHA || value == GL_ONE_MINUS_SRC_ALPHA)
		return true;
	return !alpha && (value == GL_SRC_COLOR || value == GL_ONE_MINUS_SRC_COLOR);
}

/* Where a parameter that is an enum is kept, and whether it may have @value. NULL: it is none. */
static GLenum *environment_enum(struct gloss_environment *environment, GLenum pname, GLenum value,
				bool *may)
{
	const bool alpha = pname == GL_COMBINE_ALPHA ||
			   (pname >= GL_SOURCE0_ALPHA && pname <= GL_SOURCE2_ALPHA) ||
			   (pname >= GL_OPERAND0_ALPHA && pname <= GL_OPERAND2_ALPHA);

	if (pname == GL_TEXTURE_ENV_MODE) {
		*may = environment_is_mode(value);
		return &environment->mode;
	}
	if (pname == GL_COMBINE_RGB || pname == GL_COMBINE_ALPHA) {
		*may = environment_is_combine(value, alpha);
		return &environment->combine[alpha];
	}
	/* RGB's three and alpha's three, eight apart. */
	if ((pname >= GL_SOURCE0_RGB && pname <= GL_SOURCE2_RGB) ||
	    (pname >= GL_SOURCE0_ALPHA && pname <= GL_SOURCE2_ALPHA)) {
		*may = environment_is_source(value);
		return &environment->source[alpha][(pname - GL_SOURCE0_RGB) & 7];
	}
	if ((pname >= GL_OPERAND0_RGB && pname <= GL_OPERAND2_RGB) ||
	    (pname >= GL_OPERAND0_ALPHA && pname <= GL_OPERAND2_ALPHA)) {
		*may = environment_is_operand(value, alpha);
		return &environment->operand[alpha][(pname - GL_OPERAND0_RGB) & 7];
	}
	return NULL;
}

static GLenum environment_set_number(struct gloss_environment *environment, GLenum pname,
				     struct gloss_vector value)
{
	switch (pname) {
	case GL_RGB_SCALE:
	case GL_ALPHA_SCALE:
		if (value.v[0] != 1 && value.v[0] != 2 && value.v[0] != 4)
			return GL_INVALID_VALUE;
		environment->scale[pname == GL_ALPHA_SCALE] = value.v[0];
		return GL_NO_ERROR;
	case GL_TEXTURE_ENV_COLOR:
		for (int i = 0; i < 4; i++)
			environment->colour[i] = fminf(fmaxf(value.v[i], 0), 1);
		return GL_NO_ERROR;
	case GL_TEXTURE_LOD_BIAS:
		environment->lod_bias = value.v[0];
		return GL_NO_ERROR;
	case GL_COORD_REPLACE:
		environment->coord_replace = value.v[0] != 0;
		return GL_NO_ERROR;
	default:
		return GL_INVALID_ENUM;
	}
}

GLOSS_LISTED3(TexEnvVector, GLenum, target, GLenum, pname, struct gloss_vector, value)
{
	struct gloss_texturing *texturing = &context->attributes.texturing;
	struct gloss_environment *environment = &texturing->unit[texturing->active].environment;
	const GLenum given = gloss_parameter_enum(value.v[0]);
	bool may = false;
	GLenum *at;

	if (!environment_has(target, pname)) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	at = environment_enum(environment, pname, given, &may);
	gloss_batch_draw(context);
	if (!at)
		gloss_error(context, environment_set_number(environment, pname, value));
	else if (may)
		*at = given;
	else
		gloss_error(context, GL_INVALID_ENUM);
}

static unsigned int environment_count(GLenum pname)
{
	return pname == GL_TEXTURE_ENV_COLOR ? 4 : 1;
}

void gl_TexEnvfv(GLenum target, GLenum pname, const GLfloat *params)
{
	gl_TexEnvVector(target, pname, gloss_parameter_floats(params, environment_count(pname)));
}

void gl_TexEnviv(GLenum target, GLenum pname, const GLint *params)
{
	gl_TexEnvVector(target, pname,
			gloss_parameter_integers(params, environment_count(pname),
						 pname == GL_TEXTURE_ENV_COLOR));
}

void gl_TexEnvf(GLenum target, GLenum pname, GLfloat param)
{
	gl_TexEnvVector(target, environment_count(pname) == 1 ? pname : GL_NONE,
			gloss_parameter_floats(&param, 1));
}

void gl_TexEnvi(GLenum target, GLenum pname, GLint param)
{
	gl_TexEnvf(target, pname, (GLfloat)param);
}

static struct gloss_values environment_values(struct gloss_environment *environment, GLenum pname)
{
	struct gloss_values values = { .kind = GLOSS_FLOAT, .count = 1 };
	bool may;
	const GLenum *at = environment_enum(environment, pname, 0, &may);

	if (at) {
		values.value[0] = *at;
	} else if (pname == GL_RGB_SCALE || pname == GL_ALPHA_SCALE) {
		values.value[0] = (double)environment->scale[pname == GL_ALPHA_SCALE];
	} else if (pname == GL_TEXTURE_LOD_BIAS) {
		values.value[0] = (double)environment->lod_bias;
	} else if (pname == GL_COORD_REPLACE) {
		values.value[0] = environment->coord_replace;
	} else if (pname == GL_TEXTURE_ENV_COLOR) {
		values.kind = GLOSS_UNIT_FLOAT;
		values.count = 4;
		for (int i = 0; i < 4; i++)
			values.value[i] = (double)environment->colour[i];
	} else {
		values.count = 0;
	}
	return values;
}

static struct gloss_values environment_get(GLenum target, GLenum pname)
{
	struct gloss_context *context = gloss_outside();
	struct gloss_values values = { .count = 0 };
	struct gloss_texturing *texturing;

	if (!context)
		return values;
	texturing = &context->attributes.texturing;
	if (environment_has(target, pname))
		values = environment_values(&texturing->unit[texturing->active].environment, pname);
	if (!values.count)
		gloss_error(context, GL_INVALID_ENUM);
	return values;
}

void gl_GetTexEnvfv(GLenum target, GLenum pname, GLfloat *params)
{
	const struct gloss_values values = environment_get(target, pname);

	for (unsigned int i = 0; i < values.count; i++)
		params[i] = (GLfloat)values.value[i];
}

void gl_GetTexEnviv(GLenum target, GLenum pname, GLint *params)
{
	const struct gloss_values values = environment_get(target, pname);

	for (unsigned int i = 0; i < values.count; i++)
		params[i] = gloss_get_integer(values.kind, values.value[i]);
}
