// SPDX-License-Identifier: MIT
/* Materials, which may change between glBegin and glEnd, and GL_COLOR_MATERIAL. */
#include <string.h>

#include "draw/batch.h"
#include "state/command.h"
#include "state/get.h"
#include "state/light.h"
#include "state/parameter.h"

static GLfloat *material_parameter(struct gloss_material *material, GLenum pname,
				   unsigned int *count)
{
	*count = 4;
	switch (pname) {
	case GL_AMBIENT:
		return material->ambient;
	case GL_DIFFUSE:
		return material->diffuse;
	case GL_SPECULAR:
		return material->specular;
	case GL_EMISSION:
		return material->emission;
	case GL_SHININESS:
		*count = 1;
		return &material->shininess;
	case GL_COLOR_INDEXES:
		*count = 3;
		return material->indexes;
	default:
		*count = 0;
		return NULL;
	}
}

static bool material_has_face(GLenum face, int side)
{
	return face == GL_FRONT_AND_BACK || face == (side ? GL_BACK : GL_FRONT);
}

static void material_set(struct gloss_context *context, GLenum face, GLenum pname,
			 const GLfloat *value)
{
	struct gloss_lighting *lighting = &context->attributes.lighting;
	unsigned int count;

	for (int side = 0; side < 2; side++) {
		GLfloat *at = material_parameter(&lighting->material[side], pname, &count);

		if (material_has_face(face, side) && memcmp(at, value, count * sizeof(*at)) != 0) {
			gloss_batch_break(context, GLOSS_DIRTY_LIGHTING);
			memcpy(at, value, count * sizeof(*at));
		}
	}
}

/* What the colour follows stays as it is. */
static bool material_is_tracked(const struct gloss_lighting *lighting, GLenum pname)
{
	return lighting->track &&
	       (pname == lighting->track_mode || (lighting->track_mode == GL_AMBIENT_AND_DIFFUSE &&
						  (pname == GL_AMBIENT || pname == GL_DIFFUSE)));
}

static void material_set_untracked(struct gloss_context *context, GLenum face, GLenum pname,
				   const GLfloat *value)
{
	const struct gloss_lighting *lighting = &context->attributes.lighting;

	for (int side = 0; side < 2; side++) {
		GLenum name = side ? GL_BACK : GL_FRONT;

		if (material_has_face(face, side) &&
		    !(material_is_tracked(lighting, pname) &&
		      material_has_face(lighting->track_face, side)))
			material_set(context, name, pname, value);
	}
}

static void material_play(struct gloss_context *context, GLenum face, GLenum pname,
			  const GLfloat *value)
{
	struct gloss_material any;
	unsigned int count;

	if (face != GL_FRONT && face != GL_BACK && face != GL_FRONT_AND_BACK) {
		gloss_error(context, GL_INVALID_ENUM);
	} else if (pname == GL_AMBIENT_AND_DIFFUSE) {
		material_set_untracked(context, face, GL_AMBIENT, value);
		material_set_untracked(context, face, GL_DIFFUSE, value);
	} else if (!material_parameter(&any, pname, &count)) {
		gloss_error(context, GL_INVALID_ENUM);
	} else if (pname == GL_SHININESS && !(value[0] >= 0 && value[0] <= 128)) {
		gloss_error(context, GL_INVALID_VALUE);
	} else {
		material_set_untracked(context, face, pname, value);
	}
}

GLOSS_LISTED_INSIDE3(MaterialVector, GLenum, face, GLenum, pname, struct gloss_vector, value)
{
	material_play(context, face, pname, value.v);
}

static unsigned int material_count(GLenum pname)
{
	struct gloss_material any;
	unsigned int count;

	if (pname == GL_AMBIENT_AND_DIFFUSE)
		return 4;
	material_parameter(&any, pname, &count);
	return count;
}

void gl_Materialfv(GLenum face, GLenum pname, const GLfloat *params)
{
	gl_MaterialVector(face, pname, gloss_parameter_floats(params, material_count(pname)));
}

void gl_Materialiv(GLenum face, GLenum pname, const GLint *params)
{
	gl_MaterialVector(face, pname,
			  gloss_parameter_integers(params, material_count(pname),
						   pname != GL_SHININESS &&
							   pname != GL_COLOR_INDEXES));
}

void gl_Materialf(GLenum face, GLenum pname, GLfloat param)
{
	gl_MaterialVector(face, pname == GL_SHININESS ? pname : GL_NONE,
			  gloss_parameter_floats(&param, 1));
}

void gl_Materiali(GLenum face, GLenum pname, GLint param)
{
	gl_Materialf(face, pname, (GLfloat)param);
}

void gloss_light_track(struct gloss_context *context)
{
	const struct gloss_lighting *lighting = &context->attributes.lighting;
	const GLfloat *colour = context->attributes.current.vertex.colour;
	GLenum face = lighting->track_face;

	if (!lighting->track)
		return;
	if (lighting->track_mode == GL_AMBIENT_AND_DIFFUSE) {
		material_set(context, face, GL_AMBIENT, colour);
		material_set(context, face, GL_DIFFUSE, colour);
	} else {
		material_set(context, face, lighting->track_mode, colour);
	}
}

GLOSS_LISTED2(ColorMaterial, GLenum, face, GLenum, mode)
{
	struct gloss_lighting *lighting = &context->attributes.lighting;

	if ((face != GL_FRONT && face != GL_BACK && face != GL_FRONT_AND_BACK) ||
	    (mode != GL_AMBIENT && mode != GL_DIFFUSE && mode != GL_SPECULAR &&
	     mode != GL_EMISSION && mode != GL_AMBIENT_AND_DIFFUSE)) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	if (face == lighting->track_face && mode == lighting->track_mode)
		return;
	gloss_change(context, GLOSS_DIRTY_LIGHTING);
	gloss_light_track(context);
	lighting->track_face = face;
	lighting->track_mode = mode;
}

static void material_get(GLenum face, GLenum pname, struct gloss_values *values)
{
	struct gloss_context *context = gloss_outside();
	const GLfloat *at = NULL;

	values->count = 0;
	if (!context)
		return;
	gloss_light_track(context);
	if (face == GL_FRONT || face == GL_BACK)
		at = material_parameter(&context->attributes.lighting.material[face == GL_BACK],
					pname, &values->count);
	if (!at)
		gloss_error(context, GL_INVALID_ENUM);
	values->kind = values->count == 4 ? GLOSS_UNIT_FLOAT : GLOSS_FLOAT;
	for (unsigned int i = 0; i < values->count; i++)
		values->value[i] = (double)at[i];
}

void gl_GetMaterialfv(GLenum face, GLenum pname, GLfloat *params)
{
	struct gloss_values values;

	material_get(face, pname, &values);
	for (unsigned int i = 0; i < values.count; i++)
		params[i] = (GLfloat)values.value[i];
}

void gl_GetMaterialiv(GLenum face, GLenum pname, GLint *params)
{
	struct gloss_values values;

	material_get(face, pname, &values);
	for (unsigned int i = 0; i < values.count; i++)
		params[i] = gloss_get_integer(values.kind, values.value[i]);
}
