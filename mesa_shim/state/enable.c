// SPDX-License-Identifier: MIT
/* Capabilities, of the server and of the client. */
#include "state/command.h"
#include "state/light.h"
#include "state/table.h"

static GLboolean *enable_find(struct gloss_context *context, GLenum name, enum gloss_kind kind)
{
	const struct gloss_row *row = gloss_table_find(name);

	if (row && row->kind == kind)
		return gloss_row_at(context, row);
	gloss_error(context, GL_INVALID_ENUM);
	return NULL;
}

/* What libaccel has to be told. */
static unsigned int enable_dirty(GLenum name)
{
	switch (name) {
	case GL_LIGHTING:
	case GL_COLOR_MATERIAL:
	case GL_NORMALIZE:
	case GL_RESCALE_NORMAL:
		return GLOSS_DIRTY_LIGHTING;
	case GL_SCISSOR_TEST:
		return GLOSS_DIRTY_VIEWPORT;
	case GL_CULL_FACE:
	case GL_LINE_STIPPLE:
	case GL_POLYGON_OFFSET_FILL:
	case GL_POLYGON_OFFSET_LINE:
	case GL_POLYGON_OFFSET_POINT:
		return GLOSS_DIRTY_RASTER;
	default:
		if (name - GL_LIGHT0 < GLOSS_LIGHTS)
			return GLOSS_DIRTY_LIGHTING;
		if (name - GL_CLIP_PLANE0 < GLOSS_CLIP_PLANES)
			return GLOSS_DIRTY_VIEWPORT;
		return GLOSS_DIRTY_FRAGMENT;
	}
}

static void enable_set(struct gloss_context *context, GLenum name, GLboolean on)
{
	const struct gloss_row *row = gloss_table_find(name);
	GLboolean *at;

	/* Programs for GL_EXT_vertex_array, older than OpenGL 1.1, enable arrays so. */
	if (row && row->kind == GLOSS_CLIENT_CAPABILITY)
		at = gloss_row_at(context, row);
	else
		at = enable_find(context, name, GLOSS_CAPABILITY);
	if (!at || *at == on)
		return;
	gloss_change(context, enable_dirty(name));
	if (name == GL_COLOR_MATERIAL)
		gloss_light_track(context);
	*at = on;
}

GLOSS_LISTED1(Enable, GLenum, cap)
{
	enable_set(context, cap, GL_TRUE);
}

GLOSS_LISTED1(Disable, GLenum, cap)
{
	enable_set(context, cap, GL_FALSE);
}

GLboolean gl_IsEnabled(GLenum cap)
{
	struct gloss_context *context = gloss_outside();
	const struct gloss_row *row = gloss_table_find(cap);

	if (!context)
		return GL_FALSE;
	if (row && (row->kind == GLOSS_CAPABILITY || row->kind == GLOSS_CLIENT_CAPABILITY))
		return *(const GLboolean *)gloss_row_at(context, row);
	gloss_error(context, GL_INVALID_ENUM);
	return GL_FALSE;
}

static void enable_client(GLenum name, GLboolean on)
{
	struct gloss_context *context = gloss_outside();
	GLboolean *at = context ? enable_find(context, name, GLOSS_CLIENT_CAPABILITY) : NULL;

	if (at)
		*at = on;
}

void gl_EnableClientState(GLenum array)
{
	enable_client(array, GL_TRUE);
}

void gl_DisableClientState(GLenum array)
{
	enable_client(array, GL_FALSE);
}
