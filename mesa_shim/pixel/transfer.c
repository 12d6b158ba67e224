// SPDX-License-Identifier: MIT
#include "pixel/transfer.h"

#include <math.h>
#include <string.h>

#include "api/convert.h"
#include "state/command.h"
#include "state/table.h"

void gloss_pixel_maps_init(struct gloss_pixel_maps *maps)
{
	memset(maps, 0, sizeof(*maps));
	for (int i = 0; i < GLOSS_PIXEL_MAPS; i++)
		maps->size[i] = 1;
}

/* ---- pixels ---- */

static float transfer_clamp(float value)
{
	return fminf(fmaxf(value, 0), 1);
}

/* The map of indices has a size that is a power of two. */
static float transfer_look_up(const struct gloss_context *context, GLenum map, float index)
{
	const struct gloss_pixel_maps *maps = &context->maps;
	const GLuint i = map - GL_PIXEL_MAP_I_TO_I;

	return maps->value[i][(GLint)index & (maps->size[i] - 1)];
}

void gloss_transfer_colour(const struct gloss_context *context, float (*pixel)[4], size_t count)
{
	const struct gloss_transfer *transfer = &context->attributes.transfer;
	const struct gloss_pixel_maps *maps = &context->maps;

	for (size_t n = 0; n < count; n++)
		for (int i = 0; i < 4; i++) {
			const int map = GL_PIXEL_MAP_R_TO_R - GL_PIXEL_MAP_I_TO_I + i;
			float value = pixel[n][i] * transfer->scale[i] + transfer->bias[i];

			value = transfer_clamp(value);
			if (transfer->map_colour)
				value = maps->value[map][(
					int)(value * (float)(maps->size[map] - 1) + 0.5f)];
			pixel[n][i] = value;
		}
}

bool gloss_transfer_is_plain(const struct gloss_context *context)
{
	const struct gloss_transfer *transfer = &context->attributes.transfer;

	for (int i = 0; i < 4; i++)
		if (transfer->scale[i] != 1 || transfer->bias[i] != 0)
			return false;
	return !transfer->map_colour;
}

static float transfer_shift(const struct gloss_transfer *transfer, float index)
{
	return floorf(ldexpf(index, transfer->index_shift)) + (float)transfer->index_offset;
}

/* What is no integer of 24 bits is one that is. */
static float transfer_limit(float index)
{
	const float most = 16777215;

	return fminf(fmaxf(index, -most), most);
}

void gloss_transfer_index(const struct gloss_context *context, float (*pixel)[4], size_t count)
{
	for (size_t n = 0; n < count; n++) {
		const float index = transfer_limit(
			transfer_shift(&context->attributes.transfer, pixel[n][0]));

		for (unsigned int i = 0; i < 4; i++)
			pixel[n][i] = transfer_look_up(context, GL_PIXEL_MAP_I_TO_R + i, index);
	}
}

void gloss_transfer_depth(const struct gloss_context *context, float (*pixel)[4], size_t count)
{
	const struct gloss_transfer *transfer = &context->attributes.transfer;

	for (size_t n = 0; n < count; n++)
		pixel[n][0] = transfer_clamp(pixel[n][0] * transfer->depth_scale +
					     transfer->depth_bias);
}

void gloss_transfer_stencil(const struct gloss_context *context, float (*pixel)[4], size_t count)
{
	const struct gloss_transfer *transfer = &context->attributes.transfer;

	for (size_t n = 0; n < count; n++) {
		pixel[n][0] = transfer_limit(transfer_shift(transfer, pixel[n][0]));
		if (transfer->map_stencil)
			pixel[n][0] = transfer_look_up(context, GL_PIXEL_MAP_S_TO_S, pixel[n][0]);
	}
}

void gloss_transfer_pixels(const struct gloss_context *context, GLenum format, float (*pixel)[4],
			   size_t count)
{
	switch (format) {
	case GL_DEPTH_COMPONENT:
		gloss_transfer_depth(context, pixel, count);
		break;
	case GL_STENCIL_INDEX:
		gloss_transfer_stencil(context, pixel, count);
		break;
	case GL_COLOR_INDEX:
		gloss_transfer_index(context, pixel, count);
		break;
	default:
		gloss_transfer_colour(context, pixel, count);
		break;
	}
}

/* ---- state ---- */

GLOSS_LISTED2(PixelTransferf, GLenum, pname, GLfloat, param)
{
	const struct gloss_row *row = gloss_table_find(pname);
	const int limit = 1 << 24;
	void *at;

	if (pname < GL_MAP_COLOR || pname > GL_DEPTH_BIAS || pname == GL_ZOOM_X ||
	    pname == GL_ZOOM_Y) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	at = gloss_row_at(context, row);
	if (row->kind == GLOSS_BOOLEAN)
		*(GLboolean *)at = param != 0;
	else if (row->kind == GLOSS_INTEGER)
		*(GLint *)at = (GLint)roundf(fminf(fmaxf(param, (float)-limit), (float)limit));
	else
		*(GLfloat *)at = param;
}

void gl_PixelTransferi(GLenum pname, GLint param)
{
	gl_PixelTransferf(pname, (GLfloat)param);
}

GLOSS_LISTED2(PixelZoom, GLfloat, x, GLfloat, y)
{
	context->attributes.transfer.zoom[0] = x;
	context->attributes.transfer.zoom[1] = y;
}

struct gloss_map_values {
	GLfloat value[GLOSS_PIXEL_MAP_MAX];
};

/* Indices are kept as they are. */
static bool transfer_is_of_index(GLenum map)
{
	return map == GL_PIXEL_MAP_I_TO_I || map == GL_PIXEL_MAP_S_TO_S;
}

GLOSS_LISTED3(PixelMapValues, GLenum, map, GLsizei, size, struct gloss_map_values, values)
{
	const GLuint i = map - GL_PIXEL_MAP_I_TO_I;

	if (i >= GLOSS_PIXEL_MAPS) {
		gloss_error(context, GL_INVALID_ENUM);
		return;
	}
	if (size < 1 || size > GLOSS_PIXEL_MAP_MAX ||
	    (map < GL_PIXEL_MAP_R_TO_R && (size & (size - 1)))) {
		gloss_error(context, GL_INVALID_VALUE);
		return;
	}
	context->maps.size[i] = size;
	for (GLsizei n = 0; n < size; n++)
		context->maps.value[i][n] = transfer_is_of_index(map) ?
						    transfer_limit(values.value[n]) :
						    transfer_clamp(values.value[n]);
}

static GLsizei transfer_count(GLsizei size)
{
	return size < GLOSS_PIXEL_MAP_MAX ? size : GLOSS_PIXEL_MAP_MAX;
}

void gl_PixelMapfv(GLenum map, GLsizei mapsize, const GLfloat *values)
{
	struct gloss_map_values given = { { 0 } };

	for (GLsizei i = 0; i < transfer_count(mapsize); i++)
		given.value[i] = values[i];
	gl_PixelMapValues(map, mapsize, given);
}

void gl_PixelMapuiv(GLenum map, GLsizei mapsize, const GLuint *values)
{
	struct gloss_map_values given = { { 0 } };

	for (GLsizei i = 0; i < transfer_count(mapsize); i++)
		given.value[i] = transfer_is_of_index(map) ? (GLfloat)values[i] :
							     gloss_from_ui(values[i]);
	gl_PixelMapValues(map, mapsize, given);
}

void gl_PixelMapusv(GLenum map, GLsizei mapsize, const GLushort *values)
{
	struct gloss_map_values given = { { 0 } };

	for (GLsizei i = 0; i < transfer_count(mapsize); i++)
		given.value[i] = transfer_is_of_index(map) ? (GLfloat)values[i] :
							     gloss_from_us(values[i]);
	gl_PixelMapValues(map, mapsize, given);
}

/* The values of a map, and how many; NULL: it is none. */
static const GLfloat *transfer_map(GLenum map, GLint *size)
{
	struct gloss_context *context = gloss_outside();
	const GLuint i = map - GL_PIXEL_MAP_I_TO_I;

	if (!context)
		return NULL;
	if (i >= GLOSS_PIXEL_MAPS) {
		gloss_error(context, GL_INVALID_ENUM);
		return NULL;
	}
	*size = context->maps.size[i];
	return context->maps.value[i];
}

void gl_GetPixelMapfv(GLenum map, GLfloat *values)
{
	GLint size = 0;
	const GLfloat *from = transfer_map(map, &size);

	for (GLint i = 0; from && i < size; i++)
		values[i] = from[i];
}

void gl_GetPixelMapuiv(GLenum map, GLuint *values)
{
	GLint size = 0;
	const GLfloat *from = transfer_map(map, &size);

	for (GLint i = 0; from && i < size; i++)
		values[i] = transfer_is_of_index(map) ? (GLuint)(GLint)from[i] :
							(GLuint)((double)from[i] * 4294967295.0);
}

void gl_GetPixelMapusv(GLenum map, GLushort *values)
{
	GLint size = 0;
	const GLfloat *from = transfer_map(map, &size);

	for (GLint i = 0; from && i < size; i++)
		values[i] = transfer_is_of_index(map) ? (GLushort)(GLint)from[i] :
							(GLushort)lroundf(from[i] * 65535);
}
