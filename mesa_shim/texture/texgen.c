// SPDX-License-Identifier: MIT
/* glTexGen and glGetTexGen: texture coordinates that are made of positions and normals. */
#include <string.h>

#include "draw/batch.h"
#include "state/command.h"
#include "state/get.h"
#include "state/parameter.h"

/* Of the active unit; NULL: there is an error. */
static struct gloss_texgen *texgen_find(struct gloss_context *context, GLenum coord)
{
	struct gloss_texturing *texturing = &context->attributes.texturing;

	if (coord - GL_S < 4)
		return &texturing->unit[texturing->active].texgen[coord - GL_S];
	gloss_error(context, GL_INVALID_ENUM);
	return NULL;
}

static bool texgen_is_mode(GLenum coord, GLenum mode)
{
	switch (mode) {
	case GL_OBJECT_LINEAR:
	case GL_EYE_LINEAR:
		return true;
	case GL_SPHERE_MAP:
		return coord == GL_S || coord == GL_T;
	case GL_NORMAL_MAP:
	case GL_REFLECTION_MAP:
		return coord != GL_Q;
	default:
		return false;
	}
}

GLOSS_LISTED3(TexGenVector, GLenum, coord, GLenum, pname, struct gloss_vector, value)
{
	struct gloss_texgen *texgen = texgen_find(context, coord);
	const GLenum mode = gloss_parameter_enum(value.v[0]);

	if (!texgen)
		return;
	gloss_batch_draw(context);
	if (pname == GL_TEXTURE_GEN_MODE && texgen_is_mode(coord, mode))
		texgen->mode = mode;
	else if (pname == GL_OBJECT_PLANE)
		memcpy(texgen->object, value.v, sizeof(texgen->object));
	else if (pname == GL_EYE_PLANE)
		gloss_matrix_apply_inverse(gloss_matrix_modelview(context), value.v, texgen->eye);
	else
		gloss_error(context, GL_INVALID_ENUM);
}

static unsigned int texgen_count(GLenum pname)
{
	return pname == GL_OBJECT_PLANE || pname == GL_EYE_PLANE ? 4 : 1;
}

void gl_TexGenfv(GLenum coord, GLenum pname, const GLfloat *params)
{
	gl_TexGenVector(coord, pname, gloss_parameter_floats(params, texgen_count(pname)));
}

void gl_TexGeniv(GLenum coord, GLenum pname, const GLint *params)
{
	gl_TexGenVector(coord, pname, gloss_parameter_integers(params, texgen_count(pname), false));
}

void gl_TexGendv(GLenum coord, GLenum pname, const GLdouble *params)
{
	struct gloss_vector vector = { { 0 } };

	for (unsigned int i = 0; i < texgen_count(pname); i++)
		vector.v[i] = (GLfloat)params[i];
	gl_TexGenVector(coord, pname, vector);
}

void gl_TexGenf(GLenum coord, GLenum pname, GLfloat param)
{
	gl_TexGenVector(coord, texgen_count(pname) == 1 ? pname : GL_NONE,
			gloss_parameter_floats(&param, 1));
}

void gl_TexGeni(GLenum coord, GLenum pname, GLint param)
{
	gl_TexGenf(coord, pname, (GLfloat)param);
}

void gl_TexGend(GLenum coord, GLenum pname, GLdouble param)
{
	gl_TexGenf(coord, pname, (GLfloat)param);
}

static struct gloss_values texgen_get(GLenum coord, GLenum pname)
{
	struct gloss_context *context = gloss_outside();
	const struct gloss_texgen *texgen = context ? texgen_find(context, coord) : NULL;
	struct gloss_values values = { .kind = GLOSS_FLOAT };
	const GLfloat *plane;

	if (!texgen)
		return values;
	values.count = texgen_count(pname);
	plane = pname == GL_OBJECT_PLANE ? texgen->object : texgen->eye;
	for (unsigned int i = 0; i < values.count; i++)
		values.value[i] = (double)plane[i];
	if (pname == GL_TEXTURE_GEN_MODE) {
		values.value[0] = texgen->mode;
	} else if (values.count == 1) {
		gloss_error(context, GL_INVALID_ENUM);
		values.count = 0;
	}
	return values;
}

void gl_GetTexGenfv(GLenum coord, GLenum pname, GLfloat *params)
{
	const struct gloss_values values = texgen_get(coord, pname);

	for (unsigned int i = 0; i < values.count; i++)
		params[i] = (GLfloat)values.value[i];
}

void gl_GetTexGeniv(GLenum coord, GLenum pname, GLint *params)
{
	const struct gloss_values values = texgen_get(coord, pname);

	for (unsigned int i = 0; i < values.count; i++)
		params[i] = gloss_get_integer(values.kind, values.value[i]);
}

void gl_GetTexGendv(GLenum coord, GLenum pname, GLdouble *params)
{
	const struct gloss_values values = texgen_get(coord, pname);

	for (unsigned int i = 0; i < values.count; i++)
		params[i] = values.value[i];
}
