// SPDX-License-Identifier: MIT
#include <math.h>

#include "state/command.h"
#include "state/parameter.h"

static GLfloat *fog_number(struct gloss_fog *fog, GLenum pname)
{
	switch (pname) {
	case GL_FOG_DENSITY:
		return &fog->density;
	case GL_FOG_START:
		return &fog->start;
	case GL_FOG_END:
		return &fog->end;
	case GL_FOG_INDEX:
		return &fog->index;
	default:
		return NULL;
	}
}

static bool fog_set_enum(struct gloss_fog *fog, GLenum pname, GLenum value)
{
	if (pname == GL_FOG_MODE && (value == GL_LINEAR || value == GL_EXP || value == GL_EXP2))
		fog->mode = value;
	else if (pname == GL_FOG_COORDINATE_SOURCE &&
		 (value == GL_FOG_COORDINATE || value == GL_FRAGMENT_DEPTH))
		fog->source = value;
	else
		return false;
	return true;
}

GLOSS_LISTED2(FogVector, GLenum, pname, struct gloss_vector, value)
{
	struct gloss_fog *fog = &context->attributes.fog;
	GLfloat *number = fog_number(fog, pname);

	gloss_change(context, GLOSS_DIRTY_FRAGMENT);
	if (number && pname == GL_FOG_DENSITY && value.v[0] < 0)
		gloss_error(context, GL_INVALID_VALUE);
	else if (number)
		*number = value.v[0];
	else if (pname == GL_FOG_COLOR)
		for (int i = 0; i < 4; i++)
			fog->colour[i] = fminf(fmaxf(value.v[i], 0), 1);
	else if (!fog_set_enum(fog, pname, gloss_parameter_enum(value.v[0])))
		gloss_error(context, GL_INVALID_ENUM);
}

static unsigned int fog_count(GLenum pname)
{
	return pname == GL_FOG_COLOR ? 4 : 1;
}

void gl_Fogfv(GLenum pname, const GLfloat *params)
{
	gl_FogVector(pname, gloss_parameter_floats(params, fog_count(pname)));
}

void gl_Fogiv(GLenum pname, const GLint *params)
{
	gl_FogVector(pname,
		     gloss_parameter_integers(params, fog_count(pname), pname == GL_FOG_COLOR));
}

void gl_Fogf(GLenum pname, GLfloat param)
{
	gl_FogVector(fog_count(pname) == 1 ? pname : GL_NONE, gloss_parameter_floats(&param, 1));
}

void gl_Fogi(GLenum pname, GLint param)
{
	gl_Fogf(pname, (GLfloat)param);
}
