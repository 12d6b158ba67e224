// SPDX-License-Identifier: MIT
/* Lights and the light model. */
#include "state/light.h"

#include <string.h>

#include "state/command.h"
#include "state/get.h"
#include "state/parameter.h"

/* A parameter of lights: where it is, and how many numbers. */
static GLfloat *light_parameter(struct gloss_light *light, GLenum pname, unsigned int *count)
{
	*count = pname <= GL_POSITION ? 4 : 1;
	switch (pname) {
	case GL_AMBIENT:
		return light->ambient;
	case GL_DIFFUSE:
		return light->diffuse;
	case GL_SPECULAR:
		return light->specular;
	case GL_POSITION:
		return light->position;
	case GL_SPOT_DIRECTION:
		*count = 3;
		return light->direction;
	case GL_SPOT_EXPONENT:
		return &light->exponent;
	case GL_SPOT_CUTOFF:
		return &light->cutoff;
	case GL_CONSTANT_ATTENUATION:
	case GL_LINEAR_ATTENUATION:
	case GL_QUADRATIC_ATTENUATION:
		return &light->attenuation[pname - GL_CONSTANT_ATTENUATION];
	default:
		*count = 0;
		return NULL;
	}
}

static bool light_in_range(GLenum pname, GLfloat value)
{
	switch (pname) {
	case GL_SPOT_EXPONENT:
		return value >= 0 && value <= 128;
	case GL_SPOT_CUTOFF:
		return (value >= 0 && value <= 90) || value == 180;
	case GL_CONSTANT_ATTENUATION:
	case GL_LINEAR_ATTENUATION:
	case GL_QUADRATIC_ATTENUATION:
		return value >= 0;
	default:
		return true;
	}
}

/* Positions and directions are taken to eye space by the matrix of now. */
static struct gloss_vector light_to_eye(const struct gloss_context *context, GLenum pname,
					struct gloss_vector value)
{
	struct gloss_matrix matrix = *gloss_matrix_modelview(context);

	if (pname == GL_SPOT_DIRECTION) {
		value.v[3] = 0;
		gloss_matrix_apply(&matrix, value.v, value.v);
	} else if (pname == GL_POSITION) {
		gloss_matrix_apply(&matrix, value.v, value.v);
	}
	return value;
}

static struct gloss_light *light_find(struct gloss_context *context, GLenum light)
{
	if (light >= GL_LIGHT0 && light < GL_LIGHT0 + GLOSS_LIGHTS)
		return &context->attributes.lighting.light[light - GL_LIGHT0];
	gloss_error(context, GL_INVALID_ENUM);
	return NULL;
}

GLOSS_LISTED3(LightVector, GLenum, light, GLenum, pname, struct gloss_vector, value)
{
	struct gloss_light *found = light_find(context, light);
	unsigned int count;
	GLfloat *at;

	if (!found)
		return;
	at = light_parameter(found, pname, &count);
	if (!at) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	if (!light_in_range(pname, value.v[0])) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	value = light_to_eye(context, pname, value);
	if (!memcmp(at, value.v, count * sizeof(*at)))
		return;
	gloss_change(context, GLOSS_DIRTY_LIGHTING);
	memcpy(at, value.v, count * sizeof(*at));
}

static unsigned int light_count(GLenum pname)
{
	struct gloss_light light;
	unsigned int count;

	light_parameter(&light, pname, &count);
	return count;
}

void gl_Lightfv(GLenum light, GLenum pname, const GLfloat *params)
{
	gl_LightVector(light, pname, gloss_parameter_floats(params, light_count(pname)));
}

void gl_Lightiv(GLenum light, GLenum pname, const GLint *params)
{
	gl_LightVector(light, pname,
		       gloss_parameter_integers(params, light_count(pname), pname <= GL_SPECULAR));
}

void gl_Lightf(GLenum light, GLenum pname, GLfloat param)
{
	/* Those of several numbers have no such form. */
	gl_LightVector(light, light_count(pname) == 1 ? pname : GL_NONE,
		       gloss_parameter_floats(&param, 1));
}

void gl_Lighti(GLenum light, GLenum pname, GLint param)
{
	gl_Lightf(light, pname, (GLfloat)param);
}

GLOSS_LISTED2(LightModelVector, GLenum, pname, struct gloss_vector, value)
{
	struct gloss_lighting *lighting = &context->attributes.lighting;
	const GLenum control = gloss_parameter_enum(value.v[0]);

	gloss_change(context, GLOSS_DIRTY_LIGHTING);
	switch (pname) {
	case GL_LIGHT_MODEL_AMBIENT:
		memcpy(lighting->ambient, value.v, sizeof(value.v));
		break;
	case GL_LIGHT_MODEL_LOCAL_VIEWER:
		lighting->local_viewer = value.v[0] != 0;
		break;
	case GL_LIGHT_MODEL_TWO_SIDE:
		lighting->two_side = value.v[0] != 0;
		break;
	case GL_LIGHT_MODEL_COLOR_CONTROL:
		if (control == GL_SINGLE_COLOR || control == GL_SEPARATE_SPECULAR_COLOR)
			lighting->colour_control = control;
		else
			gloss_error(context, GL_INVALID_ENUM);
		break;
	default:
		gloss_error(context, GL_INVALID_ENUM);
		break;
	}
}

static unsigned int light_model_count(GLenum pname)
{
	return pname == GL_LIGHT_MODEL_AMBIENT ? 4 : 1;
}

void gl_LightModelfv(GLenum pname, const GLfloat *params)
{
	gl_LightModelVector(pname, gloss_parameter_floats(params, light_model_count(pname)));
}

void gl_LightModeliv(GLenum pname, const GLint *params)
{
	gl_LightModelVector(pname, gloss_parameter_integers(params, light_model_count(pname),
							    pname == GL_LIGHT_MODEL_AMBIENT));
}

void gl_LightModelf(GLenum pname, GLfloat param)
{
	gl_LightModelVector(light_model_count(pname) == 1 ? pname : GL_NONE,
			    gloss_parameter_floats(&param, 1));
}

void gl_LightModeli(GLenum pname, GLint param)
{
	gl_LightModelf(pname, (GLfloat)param);
}

static void light_get(GLenum name, GLenum pname, struct gloss_values *values)
{
	struct gloss_context *context = gloss_outside();
	struct gloss_light *light = context ? light_find(context, name) : NULL;
	const GLfloat *at;

	values->count = 0;
	if (!light)
		return;
	at = light_parameter(light, pname, &values->count);
	values->kind = pname <= GL_SPECULAR ? GLOSS_UNIT_FLOAT : GLOSS_FLOAT;
	if (!at)
		gloss_error(context, GL_INVALID_ENUM);
	for (unsigned int i = 0; i < values->count; i++)
		values->value[i] = (double)at[i];
}

void gl_GetLightfv(GLenum light, GLenum pname, GLfloat *params)
{
	struct gloss_values values;

	light_get(light, pname, &values);
	for (unsigned int i = 0; i < values.count; i++)
		params[i] = (GLfloat)values.value[i];
}

void gl_GetLightiv(GLenum light, GLenum pname, GLint *params)
{
	struct gloss_values values;

	light_get(light, pname, &values);
	for (unsigned int i = 0; i < values.count; i++)
		params[i] = gloss_get_integer(values.kind, values.value[i]);
}
