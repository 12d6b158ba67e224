// SPDX-License-Identifier: MIT
/* Points, lines, polygons and flat shading. */
#include <string.h>

#include "state/command.h"
#include "state/parameter.h"
#include "state/pixel_store.h"

static bool raster_is_face(struct gloss_context *context, GLenum face)
{
	if (face == GL_FRONT || face == GL_BACK || face == GL_FRONT_AND_BACK)
		return true;
	gloss_error(context, GL_INVALID_ENUM);
	return false;
}

GLOSS_LISTED1(CullFace, GLenum, mode)
{
	if (!raster_is_face(context, mode))
		return;
	gloss_assign(context, GLOSS_DIRTY_RASTER, &context->attributes.polygon.cull_face, &mode,
		     sizeof(mode));
}

GLOSS_LISTED1(FrontFace, GLenum, mode)
{
	if (mode != GL_CW && mode != GL_CCW) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	gloss_assign(context, GLOSS_DIRTY_RASTER, &context->attributes.polygon.front_face, &mode,
		     sizeof(mode));
}

GLOSS_LISTED2(PolygonMode, GLenum, face, GLenum, mode)
{
	if (!raster_is_face(context, face))
		return;
	if (mode != GL_FILL && mode != GL_LINE && mode != GL_POINT) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	gloss_change(context, GLOSS_DIRTY_RASTER);
	if (face != GL_BACK)
		context->attributes.polygon.mode[0] = mode;
	if (face != GL_FRONT)
		context->attributes.polygon.mode[1] = mode;
}

GLOSS_LISTED2(PolygonOffset, GLfloat, factor, GLfloat, units)
{
	gloss_change(context, GLOSS_DIRTY_RASTER);
	context->attributes.polygon.factor = factor;
	context->attributes.polygon.units = units;
}

GLOSS_LISTED1(ShadeModel, GLenum, mode)
{
	if (mode != GL_FLAT && mode != GL_SMOOTH) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	if (context->attributes.lighting.shade_model == mode)
		return;
	gloss_assign(context, GLOSS_DIRTY_RASTER, &context->attributes.lighting.shade_model, &mode,
		     sizeof(mode));
}

GLOSS_LISTED1(LineWidth, GLfloat, width)
{
	if (!(width > 0)) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	gloss_assign(context, GLOSS_DIRTY_RASTER, &context->attributes.line.width, &width,
		     sizeof(width));
}

GLOSS_LISTED2(LineStipple, GLint, factor, GLushort, pattern)
{
	gloss_change(context, GLOSS_DIRTY_RASTER);
	context->attributes.line.repeat = factor < 1 ? 1 : factor > 256 ? 256 : factor;
	context->attributes.line.pattern = pattern;
}

GLOSS_LISTED1(PointSize, GLfloat, size)
{
	if (!(size > 0)) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	gloss_assign(context, GLOSS_DIRTY_RASTER, &context->attributes.point.size, &size,
		     sizeof(size));
}

GLOSS_LISTED2(PointParameterVector, GLenum, pname, struct gloss_vector, value)
{
	struct gloss_point *point = &context->attributes.point;

	if (pname >= GL_POINT_SIZE_MIN && pname <= GL_POINT_FADE_THRESHOLD_SIZE && value.v[0] < 0) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	gloss_change(context, GLOSS_DIRTY_RASTER);
	switch (pname) {
	case GL_POINT_SIZE_MIN:
		point->least = value.v[0];
		break;
	case GL_POINT_SIZE_MAX:
		point->most = value.v[0];
		break;
	case GL_POINT_FADE_THRESHOLD_SIZE:
		point->fade = value.v[0];
		break;
	case GL_POINT_DISTANCE_ATTENUATION:
		memcpy(point->attenuation, value.v, sizeof(point->attenuation));
		break;
	default:
		gloss_error(context, GL_INVALID_ENUM);
		break;
	}
}

static unsigned int raster_point_count(GLenum pname)
{
	return pname == GL_POINT_DISTANCE_ATTENUATION ? 3 : 1;
}

void gl_PointParameterfv(GLenum pname, const GLfloat *params)
{
	gl_PointParameterVector(pname, gloss_parameter_floats(params, raster_point_count(pname)));
}

void gl_PointParameteriv(GLenum pname, const GLint *params)
{
	gl_PointParameterVector(pname,
				gloss_parameter_integers(params, raster_point_count(pname), false));
}

void gl_PointParameterf(GLenum pname, GLfloat param)
{
	gl_PointParameterVector(raster_point_count(pname) == 1 ? pname : GL_NONE,
				gloss_parameter_floats(&param, 1));
}

void gl_PointParameteri(GLenum pname, GLint param)
{
	gl_PointParameterf(pname, (GLfloat)param);
}

struct gloss_stipple {
	GLubyte row[128];
};

GLOSS_LISTED1(PolygonStipplePattern, struct gloss_stipple, stipple)
{
	gloss_change(context, GLOSS_DIRTY_RASTER);
	memcpy(context->attributes.polygon_stipple, stipple.row, sizeof(stipple.row));
}

void gl_PolygonStipple(const GLubyte *mask)
{
	const struct gloss_context *context = gloss_current();
	struct gloss_stipple stipple = { { 0 } };

	if (!context)
		return;
	for (int i = 0; i < 32 * 32; i++)
		if (gloss_pixel_store_bit(&context->client.unpack, mask, 32, i % 32, i / 32))
			stipple.row[i / 8] |= (GLubyte)(0x80 >> i % 8);
	gl_PolygonStipplePattern(stipple);
}

void gl_GetPolygonStipple(GLubyte *mask)
{
	struct gloss_context *context = gloss_outside();

	if (!context)
		return;
	for (int i = 0; i < 32 * 32; i++)
		gloss_pixel_store_put_bit(&context->client.pack, mask, 32, i % 32, i / 32,
					  context->attributes.polygon_stipple[i / 8] >>
							  (7 - i % 8) &
						  1);
}
